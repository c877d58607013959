#include "signweave/backup/part_file.h"

#include <fmt/format.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <memory>

namespace signweave::backup_files {
namespace {

constexpr std::string_view kMagic = "signweave part 1";
constexpr std::size_t kLongestKey = 4096;  // longer than any engine allows

using File = std::unique_ptr<std::FILE, int (*)(std::FILE*)>;

}  // namespace

PartWriter::PartWriter(const std::filesystem::path& path) : file_(path) {
  write(bytes_of(kMagic));
}

void PartWriter::write(ByteSpan bytes) {
  file_.write(text_of(bytes));
  checksum_.add(bytes);
  bytes_ += bytes.size();
}

void PartWriter::add(ByteSpan key, ByteSpan value) {
  ByteWriter head;
  head.number(static_cast<std::uint32_t>(key.size()));
  head.number(static_cast<std::uint64_t>(value.size()));
  write(head.bytes());
  write(key);
  write(value);
}

Stamp PartWriter::commit() {
  file_.commit();
  return {bytes_, checksum_.value()};
}

std::string fault_of_part(const std::filesystem::path& path, const Stamp& stamp) {
  std::error_code error;
  const std::uintmax_t bytes = std::filesystem::file_size(path, error);
  if (error) return error == std::errc::no_such_file_or_directory ? "it is missing" : error.message();
  if (bytes != stamp.bytes) return fmt::format("it has {} bytes instead of {}", bytes, stamp.bytes);
  try {
    return file_checksum(path) == stamp.checksum ? "" : "its checksum does not fit";
  } catch (const Error& fault) {
    return fault.what();
  }
}

void read_part(const std::filesystem::path& path, const std::function<void(ByteSpan key, ByteSpan value)>& see) {
  const auto refuse = [&](const char* what) {
    throw Error(ErrorCode::corrupt,
                fmt::format("{}: {}; restore an older state, or this file from a copy", path.string(), what));
  };
  std::error_code error;
  std::uint64_t left = std::filesystem::file_size(path, error);
  const File file(error ? nullptr : std::fopen(path.c_str(), "rb"), &std::fclose);
  if (!file) throw Error(ErrorCode::io, fmt::format("{}: cannot be read: {}", path.string(), std::strerror(errno)));
  Bytes buffer;
  const auto take = [&](std::uint64_t size) -> ByteSpan {
    if (size > left) refuse("the file ends too early");  // checked before anything so large is allocated
    if (buffer.size() < size) buffer.resize(size);
    if (std::fread(buffer.data(), 1, size, file.get()) != size) {
      if (std::ferror(file.get()) != 0) {
        throw Error(ErrorCode::io, fmt::format("{}: cannot be read: {}", path.string(), std::strerror(errno)));
      }
      refuse("the file ends too early");
    }
    left -= size;
    return ByteSpan(buffer).first(size);
  };
  if (left < kMagic.size() || text_of(take(kMagic.size())) != kMagic) refuse("this is not a part of a backup");
  Bytes key;
  while (left > 0) {
    ByteReader head(take(sizeof(std::uint32_t) + sizeof(std::uint64_t)), path.string());
    const auto key_size = head.number<std::uint32_t>();
    const auto value_size = head.number<std::uint64_t>();
    if (key_size == 0 || key_size > kLongestKey) refuse("a key has an impossible length");
    const ByteSpan name = take(key_size);
    key.assign(name.begin(), name.end());
    see(key, take(value_size));
  }
}

}  // namespace signweave::backup_files
