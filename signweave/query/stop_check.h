#pragma once

#include <atomic>
#include <chrono>
#include <cstddef>
#include <optional>

#include "signweave/core/error.h"

namespace signweave {

/// When to stop a search.
struct FindLimits {
  std::optional<std::size_t> limit;  ///< maximum number of segments: the first in the order of the answer
  std::optional<std::chrono::steady_clock::time_point> deadline;
  const std::atomic<bool>* cancel = nullptr;  ///< borrowed; set to true from any thread
};

/// Polls the deadline and the cancel flag. Belongs to one search.
class StopCheck {
 public:
  explicit StopCheck(const FindLimits& limits = {}) : limits_(limits) {}
  /// Restarts for another search.
  void begin(const FindLimits& limits) {
    limits_ = limits;
    ticks_ = 0;
  }

  /// To be called for each row examined. Throws Error{cancelled}.
  void tick() {
    if ((++ticks_ & 0x3FF) == 0) check();
  }
  void check() const {
    if (limits_.cancel != nullptr && limits_.cancel->load(std::memory_order_relaxed)) {
      throw Error(ErrorCode::cancelled, "query: stopped on request; run it again to start over");
    }
    if (limits_.deadline && std::chrono::steady_clock::now() >= *limits_.deadline) {
      throw Error(ErrorCode::cancelled, "query: timed out; allow more time, or narrow the query");
    }
  }

 private:
  FindLimits limits_;
  std::size_t ticks_ = 0;
};

}  // namespace signweave
