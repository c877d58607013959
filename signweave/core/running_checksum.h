#pragma once

#include <cstdint>
#include <memory>

#include "signweave/core/bytes.h"

namespace signweave {

/// Computes `checksum` of bytes that arrive in pieces.
class RunningChecksum {
 public:
  RunningChecksum();
  void add(ByteSpan bytes) noexcept;
  /// The checksum of all bytes added so far; more may be added afterwards.
  std::uint64_t value() const noexcept;

 private:
  struct Free {
    void operator()(void* state) const noexcept;
  };
  std::unique_ptr<void, Free> state_;
};

}  // namespace signweave
