#pragma once

#include <cstdint>
#include <memory>

#include "signweave/core/bytes.h"

namespace signweave {

/// `checksum` of bytes that come piece by piece.
class RunningChecksum {
 public:
  RunningChecksum();
  void add(ByteSpan bytes) noexcept;
  /// Of all that was added; more may be added afterwards.
  std::uint64_t value() const noexcept;

 private:
  struct Free {
    void operator()(void* state) const noexcept;
  };
  std::unique_ptr<void, Free> state_;
};

}  // namespace signweave
