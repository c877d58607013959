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

/// What a selection's joins cost: the weights, and the time that a transition is given.
struct JoinScale {
  JoinWeights weights;
  Seconds transition{0.5};
};

/// Both ends of each candidate of one gloss, placed out so that one candidate is compared with many at once. Immutable
/// once made; places of one gloss share it.
class JoinEnds {
 public:
  /// How many are compared at once.
  static constexpr std::size_t kLanes = 16;

  /// [candidate] the first stroke's begin and the last stroke's end.
  JoinEnds(std::span<const JoinPoint> begins, std::span<const JoinPoint> ends);

  std::size_t size() const noexcept { return begins_.size(); }
  const JoinPoint& begin(std::size_t candidate) const noexcept { return begins_[candidate]; }
  const JoinPoint& end(std::size_t candidate) const noexcept { return ends_[candidate]; }
  /// What is known at the begins and ends of all of them alike; none where they differ.
  const std::uint8_t* known() const noexcept { return alike_ ? &known_ : nullptr; }

 private:
  std::vector<JoinPoint> begins_;
  std::vector<JoinPoint> ends_;
  std::uint8_t known_ = 0;
  bool alike_ = true;
};

/// The ends of some candidates in an order that the caller chooses, to be compared with one begin after another. Used
/// again and again it allocates only to grow.
class JoinLanes {
 public:
  /// `order` names candidates of `ends`; lanes beyond them hold the last one again.
  void place(const JoinEnds& ends, std::span<const std::uint32_t> order, const JoinScale& scale);
  std::size_t blocks() const noexcept { return values_.size(); }
  /// The begin that `costs` is about from now on.
  void compare_with(const JoinPoint& begin) noexcept;
  /// What leads to a block's ends, `before`, with `to` and with their joins to that begin, which are
  /// cost_of(join_terms()) but for rounding. The least of them.
  float costs(std::size_t block, std::span<const float, JoinEnds::kLanes> before, float to,
              std::span<float, JoinEnds::kLanes> out) const noexcept;

 private:
  /// Ends of kLanes candidates, times their roots. A value's lanes do not straddle two lines of the cache.
  struct alignas(64) Block {
    float values[JoinPoint::kSize][JoinEnds::kLanes];
  };
  std::vector<Block> values_;
  std::array<float, JoinPoint::kSize> roots_{};  ///< of the weights
  std::array<float, JoinPoint::kSize> begin_{};  ///< times the roots
  float place_ = 0;
  float speed_ = 0;
  float per_way_ = 0;  ///< 1 / (the way that a hand goes at the limit, shoulder widths)²
};

}  // namespace signweave
