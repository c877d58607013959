#pragma once

#include <cstdint>
#include <deque>
#include <optional>
#include <string>
#include <unordered_map>
#include <vector>

#include "signweave/core/bytes.h"

/// Inside this module only.
namespace signweave::kv {

/// What changes replaced or took away, for as long as a snapshot needs it. Changes are numbered upwards; the snapshot s
/// sees what changes up to and with s left. Not locked: the owner does that.
class OldValues {
 public:
  /// Until change `number`, the key had this value, or none. Numbers never fall; a key once a number.
  void keep(std::uint64_t number, ByteSpan key, std::optional<ByteSpan> value);

  /// What the key had for a snapshot; null where the store itself tells.
  const std::optional<Bytes>* find(ByteSpan key, std::uint64_t snapshot) const;

  /// Lets go of what no snapshot from `oldest` on needs. Returned, so that the memory can be freed out of the lock.
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
    const std::string* key = nullptr;  ///< the map's own
  };

  std::unordered_map<std::string, std::deque<Old>, Hash, std::equal_to<>> values_;  ///< each oldest first
  std::deque<Kept> order_;
};

}  // namespace signweave::kv
