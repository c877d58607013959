#pragma once

#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <streambuf>
#include <string>
#include <string_view>

#include "signweave/core/bytes.h"

namespace signweave {

/// A file that is written atomically: bytes go to a temporary file in the same folder, and `commit` flushes it to disk
/// and renames it into place. Without `commit` nothing is left behind. Failures throw Error{io, "PATH: …"}.
class AtomicFile {
 public:
  explicit AtomicFile(std::filesystem::path path);
  ~AtomicFile();
  AtomicFile(const AtomicFile&) = delete;
  AtomicFile& operator=(const AtomicFile&) = delete;

  void write(std::string_view text);
  void commit();

 private:
  [[noreturn]] void fail(const char* what);

  std::filesystem::path path_;
  std::filesystem::path temporary_;
  std::FILE* file_ = nullptr;
};

/// A stream buffer that forwards to an AtomicFile what a library writes to a stream. The file must outlive the buffer.
/// Its errors pass through a stream whose exceptions include badbit.
class AtomicFileBuffer : public std::streambuf {
 public:
  explicit AtomicFileBuffer(AtomicFile& file) : file_(file) {}
  /// The number of bytes written.
  std::uint64_t bytes() const noexcept { return bytes_; }

 private:
  std::streamsize xsputn(const char* text, std::streamsize count) override;
  int_type overflow(int_type c) override;

  AtomicFile& file_;
  std::uint64_t bytes_ = 0;
};

/// Returns the content of a file. Throws Error{not_found} or Error{io} if it cannot be read, Error{bad_input} if it is
/// larger than `most` bytes.
std::string read_file(const std::filesystem::path& path, std::size_t most = std::size_t{1} << 32);

/// The checksum of a file's bytes, which are read in pieces. Throws as read_file does.
std::uint64_t file_checksum(const std::filesystem::path& path);

}  // namespace signweave
