#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "signweave/core/time.h"
#include "signweave/features/join.h"

namespace signweave {

/// Parameters of join costs: the weights, and the duration of a transition.
struct JoinScale {
  JoinWeights weights;
  Seconds transition{0.5};
};

/// Both ends of each candidate of one gloss. Immutable; places of the same gloss share it.
class JoinEnds {
 public:
  /// Number of candidates compared at once.
  static constexpr std::size_t kLanes = 16;

  /// [candidate] the first stroke's begin and the last stroke's end.
  JoinEnds(std::span<const JoinPoint> begins, std::span<const JoinPoint> ends);

  std::size_t size() const noexcept { return begins_.size(); }
  const JoinPoint& begin(std::size_t candidate) const noexcept { return begins_[candidate]; }
  const JoinPoint& end(std::size_t candidate) const noexcept { return ends_[candidate]; }
  /// The values known at the begins and ends of all candidates; null if they differ.
  const std::uint8_t* known() const noexcept { return alike_ ? &known_ : nullptr; }

 private:
  std::vector<JoinPoint> begins_;
  std::vector<JoinPoint> ends_;
  std::uint8_t known_ = 0;
  bool alike_ = true;
};

/// The ends of candidates in an order chosen by the caller, laid out to compare many with one begin at once. Reused, it
/// allocates only to grow.
class JoinLanes {
 public:
  /// `order` lists candidates of `ends`; the remaining lanes repeat the last one.
  void place(const JoinEnds& ends, std::span<const std::uint32_t> order, const JoinScale& scale);
  std::size_t blocks() const noexcept { return values_.size(); }
  /// Sets the begin for the following calls of `costs`.
  void compare_with(const JoinPoint& begin) noexcept;
  /// Writes path costs through a block's ends: `before` + `to` + the cost of the join to that begin, which is
  /// cost_of(join_terms()) except for rounding. Returns the least of them.
  float costs(std::size_t block, std::span<const float, JoinEnds::kLanes> before, float to,
              std::span<float, JoinEnds::kLanes> out) const noexcept;

 private:
  /// Ends of kLanes candidates, multiplied by the roots of the weights. The lanes of a value do not straddle cache
  /// lines.
  struct alignas(64) Block {
    float values[JoinPoint::kSize][JoinEnds::kLanes];
  };
  std::vector<Block> values_;
  std::array<float, JoinPoint::kSize> roots_{};  ///< of the weights
  std::array<float, JoinPoint::kSize> begin_{};  ///< times the roots
  float place_ = 0;
  float speed_ = 0;
  float per_distance_ = 0;  ///< 1 / (distance of a hand at the speed limit, shoulder widths)²
};

}  // namespace signweave
