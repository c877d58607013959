#pragma once

#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <streambuf>
#include <string>
#include <string_view>

#include "signweave/core/bytes.h"

namespace signweave {

/// A file that appears whole or not at all: bytes go to a temporary file beside it, and `commit` flushes that to disk
/// and renames it into place. Without `commit` nothing is left behind. Faults are Error{io, "PATH: …"}.
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

/// Sends what a library writes to a stream on to such a file. It must outlive this; its faults pass through a stream
/// whose exceptions include badbit.
class AtomicFileBuffer : public std::streambuf {
 public:
  explicit AtomicFileBuffer(AtomicFile& file) : file_(file) {}
  /// How many were written.
  std::uint64_t bytes() const noexcept { return bytes_; }

 private:
  std::streamsize xsputn(const char* text, std::streamsize count) override;
  int_type overflow(int_type c) override;

  AtomicFile& file_;
  std::uint64_t bytes_ = 0;
};

/// The whole of a file. Error{not_found} or Error{io} where it cannot be read; Error{bad_input} where it has more than
/// `most` bytes.
std::string read_file(const std::filesystem::path& path, std::size_t most = std::size_t{1} << 32);

/// Checksum of a file's bytes, read through a window. Throws as read_file does.
std::uint64_t file_checksum(const std::filesystem::path& path);

}  // namespace signweave
