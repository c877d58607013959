#pragma once

#include <cstdint>
#include <deque>
#include <optional>
#include <string>
#include <unordered_map>
#include <vector>

#include "signweave/core/bytes.h"

/// Internal to this module.
namespace signweave::kv {

/// Values that changes replaced or erased, stored as long as a snapshot needs them. Changes are numbered upwards;
/// snapshot s sees the state after change s. Not thread-safe: the owner locks.
class OldValues {
 public:
  /// Records the value, if any, that the key had until change `number`. Numbers never decrease; a key is recorded once
  /// per number.
  void keep(std::uint64_t number, ByteSpan key, std::optional<ByteSpan> value);

  /// The value that a snapshot sees for the key; null if the store itself has the answer.
  const std::optional<Bytes>* find(ByteSpan key, std::uint64_t snapshot) const;

  /// Removes the values that no snapshot from `oldest` on needs. They are returned, so that the caller can free the
  /// memory outside its lock.
  std::vector<std::optional<Bytes>> forget(std::uint64_t oldest);

  bool empty() const noexcept { return order_.empty(); }

 private:
  struct Old {
    std::uint64_t until = 0;
    std::optional<Bytes> value;
  };
  struct Hash {
    using is_transparent = void;
    std::size_t operator()(std::string_view key) const noexcept { return std::hash<std::string_view>{}(key); }
  };
  struct Kept {
    std::uint64_t number = 0;
    const std::string* key = nullptr;  ///< points to the map's key
  };

  std::unordered_map<std::string, std::deque<Old>, Hash, std::equal_to<>> values_;  ///< each oldest first
  std::deque<Kept> order_;
};

}  // namespace signweave::kv
