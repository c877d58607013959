#include "signweave/core/atomic_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>
#include <xxhash.h>

#include <cerrno>
#include <cstring>
#include <memory>

namespace signweave {

AtomicFile::AtomicFile(std::filesystem::path path) : path_(std::move(path)) {
  temporary_ = path_;
  temporary_ += fmt::format(".{}.part", ::getpid());
  file_ = std::fopen(temporary_.c_str(), "wb");
  if (file_ == nullptr) fail("cannot be written");
}

AtomicFile::~AtomicFile() {
  if (file_ != nullptr) {
    std::fclose(file_);
    std::error_code ignored;
    std::filesystem::remove(temporary_, ignored);
  }
}

void AtomicFile::write(std::string_view text) {
  if (std::fwrite(text.data(), 1, text.size(), file_) != text.size()) fail("cannot be written");
}

void AtomicFile::commit() {
  if (std::fflush(file_) != 0 || ::fsync(::fileno(file_)) != 0) fail("cannot be written");
  if (std::rename(temporary_.c_str(), path_.c_str()) != 0) fail("cannot be moved into place");
  std::fclose(file_);
  file_ = nullptr;
}

void AtomicFile::fail(const char* what) {
  throw Error(ErrorCode::io, fmt::format("{}: {}: {}", path_.string(), what, std::strerror(errno)));
}

std::streamsize AtomicFileBuffer::xsputn(const char* text, std::streamsize count) {
  file_.write({text, static_cast<std::size_t>(count)});
  bytes_ += static_cast<std::uint64_t>(count);
  return count;
}

AtomicFileBuffer::int_type AtomicFileBuffer::overflow(int_type c) {
  const char one = traits_type::to_char_type(c);
  xsputn(&one, 1);
  return c;
}

std::string read_file(const std::filesystem::path& path, std::size_t most) {
  std::FILE* file = std::fopen(path.c_str(), "rb");
  if (file == nullptr) {
    const ErrorCode code = errno == ENOENT ? ErrorCode::not_found : ErrorCode::io;
    throw Error(code, fmt::format("{}: cannot be read: {}", path.string(), std::strerror(errno)));
  }
  std::string text;
  char block[1 << 16];
  std::size_t got = 0;
  while (text.size() <= most && (got = std::fread(block, 1, sizeof block, file)) > 0) text.append(block, got);
  const int fault = std::ferror(file) != 0 ? errno : 0;
  std::fclose(file);
  if (fault != 0)
    throw Error(ErrorCode::io, fmt::format("{}: cannot be read: {}", path.string(), std::strerror(fault)));
  if (text.size() > most) {
    throw Error(ErrorCode::bad_input,
                fmt::format("{}: larger than {} bytes, the limit for such a file", path.string(), most));
  }
  return text;
}

std::uint64_t file_checksum(const std::filesystem::path& path) {
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> file(std::fopen(path.c_str(), "rb"), &std::fclose);
  const std::unique_ptr<XXH3_state_t, XXH_errorcode (*)(XXH3_state_t*)> state(XXH3_createState(), &XXH3_freeState);
  const auto fail = [&] {
    const ErrorCode code = errno == ENOENT ? ErrorCode::not_found : ErrorCode::io;
    throw Error(code, fmt::format("{}: cannot be read: {}", path.string(), std::strerror(errno)));
  };
  if (!file) fail();
  XXH3_64bits_reset(state.get());
  char block[1 << 16];
  std::size_t got = 0;
  while ((got = std::fread(block, 1, sizeof block, file.get())) > 0) XXH3_64bits_update(state.get(), block, got);
  if (std::ferror(file.get()) != 0) fail();
  return XXH3_64bits_digest(state.get());
}

}  // namespace signweave
