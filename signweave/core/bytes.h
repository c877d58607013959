#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "signweave/core/error.h"

namespace signweave {

// The only place that depends on byte order: everything stored is little-endian. (On a big-endian machine the build
// fails instead of storing wrong bytes.)
static_assert(std::endian::native == std::endian::little, "signweave stores little-endian and does not swap yet");

using Bytes = std::vector<std::byte>;
using ByteSpan = std::span<const std::byte>;

inline ByteSpan bytes_of(std::string_view text) noexcept {
  return std::as_bytes(std::span(text));
}
inline std::string_view text_of(ByteSpan bytes) noexcept {
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

/// The 64-bit XXH3 of some bytes: the checksum of everything stored. Not a cryptographic hash.
std::uint64_t checksum(ByteSpan bytes) noexcept;

/// Appends numbers and texts to a byte string. A text is stored as a u32 length and its bytes.
class ByteWriter {
 public:
  template <typename T>
  requires(std::is_arithmetic_v<T> || std::is_enum_v<T>) void number(T value) {
    bytes_.resize(bytes_.size() + sizeof(T));
    std::memcpy(bytes_.data() + bytes_.size() - sizeof(T), &value, sizeof(T));
  }
  void raw(ByteSpan bytes) { bytes_.insert(bytes_.end(), bytes.begin(), bytes.end()); }
  void text(std::string_view text) {
    number(static_cast<std::uint32_t>(text.size()));
    raw(bytes_of(text));
  }
  std::size_t size() const noexcept { return bytes_.size(); }
  const Bytes& bytes() const noexcept { return bytes_; }
  Bytes take() noexcept { return std::move(bytes_); }

 private:
  Bytes bytes_;
};

/// Reads what a ByteWriter wrote. Every read is bounds-checked and throws Error{corrupt, "WHERE: …"} on failure.
class ByteReader {
 public:
  /// Borrows `bytes`; `where` identifies them in an error.
  ByteReader(ByteSpan bytes, std::string where) : bytes_(bytes), where_(std::move(where)) {}

  template <typename T>
  requires(std::is_arithmetic_v<T> || std::is_enum_v<T>) T number() {
    T value;
    std::memcpy(&value, take(sizeof(T)).data(), sizeof(T));
    return value;
  }
  std::string text() {
    const auto size = number<std::uint32_t>();
    return std::string(text_of(take(size)));
  }
  /// Reads a count of items that take at least `smallest` bytes each. Throws if the remaining bytes cannot hold them,
  /// so that a damaged count never causes a huge allocation.
  std::size_t count(std::size_t smallest) {
    const auto count = number<std::uint32_t>();
    if (static_cast<std::uint64_t>(count) * smallest > bytes_.size()) fail("a count larger than the record");
    return count;
  }
  ByteSpan take(std::size_t size) {
    if (size > bytes_.size()) fail("it ends too early");
    const ByteSpan result = bytes_.first(size);
    bytes_ = bytes_.subspan(size);
    return result;
  }
  std::size_t left() const noexcept { return bytes_.size(); }
  /// Throws if any bytes are left.
  void finish() {
    if (!bytes_.empty()) fail("bytes are left over");
  }
  [[noreturn]] void fail(const std::string& what) const {
    throw Error(ErrorCode::corrupt, where_ + ": stored record is damaged (" + what +
                                        "); restore it from a copy or "
                                        "import the recording again");
  }

 private:
  ByteSpan bytes_;
  std::string where_;
};

}  // namespace signweave
