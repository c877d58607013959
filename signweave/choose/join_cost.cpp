#include "signweave/choose/join_cost.h"

#include <algorithm>
#include <cmath>
#include <cstring>

namespace signweave {
namespace {

constexpr std::size_t kHands =
    JoinPoint::kVelocity;  // the values before it are positions: three of the left hand, three of the right

/// Additional inputs of the costs of a block.
struct Weights {
  const float* before;  ///< [lane]
  float to;
  float place;
  float speed;
  float per_distance;
};

/// Lanes of a value, as many as a vector register holds.
using Lanes4 = float __attribute__((vector_size(16)));
using Lanes8 = float __attribute__((vector_size(32)));
using Lanes16 = float __attribute__((vector_size(64)));

/// Compares halves, to avoid a chain of dependent comparisons.
[[gnu::always_inline]] inline float least_of(const Lanes4& lanes) noexcept {
  const float even = std::min(lanes[0], lanes[2]);
  const float odd = std::min(lanes[1], lanes[3]);
  return std::min(even, odd);
}
[[gnu::always_inline]] inline float least_of(const Lanes8& lanes) noexcept {
  const Lanes4 low = __builtin_shufflevector(lanes, lanes, 0, 1, 2, 3);
  const Lanes4 high = __builtin_shufflevector(lanes, lanes, 4, 5, 6, 7);
  const Lanes4 less = low < high ? low : high;
  return least_of(less);
}
[[gnu::always_inline]] inline float least_of(const Lanes16& lanes) noexcept {
  const Lanes8 low = __builtin_shufflevector(lanes, lanes, 0, 1, 2, 3, 4, 5, 6, 7);
  const Lanes8 high = __builtin_shufflevector(lanes, lanes, 8, 9, 10, 11, 12, 13, 14, 15);
  const Lanes8 less = low < high ? low : high;
  return least_of(less);
}

/// `ends` is [value][lane]. Two independent sums hide the latency of additions.
template <typename Lanes>
[[gnu::always_inline]] inline float costs_by(const float* ends, const float* begin, const Weights& weights,
                                             float* out) noexcept {
  Lanes least = {};
  for (std::size_t lane = 0; lane < JoinEnds::kLanes; lane += sizeof(Lanes) / sizeof(float)) {
    Lanes at[kHands];
    for (std::size_t value = 0; value < kHands; ++value) {
      std::memcpy(&at[value], ends + value * JoinEnds::kLanes + lane, sizeof(Lanes));
      at[value] -= begin[value];
    }
    const Lanes left = at[0] * at[0] + at[1] * at[1] + at[2] * at[2];
    const Lanes right = at[3] * at[3] + at[4] * at[4] + at[5] * at[5];
    const Lanes none = {};
    const Lanes fast_left = left * weights.per_distance - 1.0f;
    const Lanes fast_right = right * weights.per_distance - 1.0f;
    Lanes sum = weights.place * (left + right) + weights.speed * (fast_left > none ? fast_left : none);
    Lanes other = weights.speed * (fast_right > none ? fast_right : none);
    static_assert(JoinPoint::kSize % 2 == 0 && kHands % 2 == 0);
    for (std::size_t value = kHands; value < JoinPoint::kSize; value += 2) {
      Lanes one;
      Lanes next;
      std::memcpy(&one, ends + value * JoinEnds::kLanes + lane, sizeof(Lanes));
      std::memcpy(&next, ends + (value + 1) * JoinEnds::kLanes + lane, sizeof(Lanes));
      one -= begin[value];
      next -= begin[value + 1];
      sum += one * one;
      other += next * next;
    }
    Lanes all;
    std::memcpy(&all, weights.before + lane, sizeof(Lanes));
    all += weights.to;
    all += sum + other;
    std::memcpy(out + lane, &all, sizeof(Lanes));
    least = lane == 0 ? all : (all < least ? all : least);
  }
  return least_of(least);
}

// Compiled for each vector width. All give the same bits, because the order of each lane's sum is fixed and operations
// are not fused (-ffp-contract=off).
using BlockCosts = float (*)(const float* ends, const float* begin, const Weights& weights, float* out) noexcept;

#if defined(__x86_64__)
__attribute__((target("avx512f"))) float costs_by_sixteens(const float* ends, const float* begin,
                                                           const Weights& weights, float* out) noexcept {
  return costs_by<Lanes16>(ends, begin, weights, out);
}
__attribute__((target("avx2"))) float costs_by_eights(const float* ends, const float* begin, const Weights& weights,
                                                      float* out) noexcept {
  return costs_by<Lanes8>(ends, begin, weights, out);
}
#endif
float costs_by_fours(const float* ends, const float* begin, const Weights& weights, float* out) noexcept {
  return costs_by<Lanes4>(ends, begin, weights, out);
}

/// The version for the widest vectors of this machine.
BlockCosts widest() noexcept {
#if defined(__x86_64__)
  if (__builtin_cpu_supports("avx512f")) return costs_by_sixteens;
  if (__builtin_cpu_supports("avx2")) return costs_by_eights;
#endif
  return costs_by_fours;
}

}  // namespace

JoinEnds::JoinEnds(std::span<const JoinPoint> begins, std::span<const JoinPoint> ends)
    : begins_(begins.begin(), begins.end()), ends_(ends.begin(), ends.end()) {
  if (!begins_.empty()) known_ = begins_.front().known;
  for (const std::vector<JoinPoint>* points : {&begins_, &ends_}) {
    for (const JoinPoint& point : *points) alike_ = alike_ && point.known == known_;
  }
}

void JoinLanes::place(const JoinEnds& ends, std::span<const std::uint32_t> order, const JoinScale& scale) {
  const JoinTerms& terms = scale.weights.weights;
  const auto fill = [&](std::size_t from, std::size_t to, JoinTerm term, float parts) {
    const float root = std::sqrt(terms[static_cast<std::size_t>(term)] / parts);
    std::fill(roots_.begin() + static_cast<std::ptrdiff_t>(from), roots_.begin() + static_cast<std::ptrdiff_t>(to),
              root);
  };
  std::fill(roots_.begin(), roots_.end(), 1.0f);  // of the positions, which two terms need
  fill(JoinPoint::kVelocity, JoinPoint::kDirection, JoinTerm::velocity, 1);
  fill(JoinPoint::kDirection, JoinPoint::kHandshape, JoinTerm::direction, 1);
  fill(JoinPoint::kHandshape, JoinPoint::kArms, JoinTerm::handshape, Handshape::kSize);
  fill(JoinPoint::kArms, JoinPoint::kTrunk, JoinTerm::arms, 1);
  fill(JoinPoint::kTrunk, JoinPoint::kSize, JoinTerm::trunk, 1);
  place_ = terms[static_cast<std::size_t>(JoinTerm::place)];
  speed_ = terms[static_cast<std::size_t>(JoinTerm::speed)];
  const float distance =
      static_cast<float>(std::max(scale.transition, kShortestJoin).count()) * scale.weights.speed_limit;
  per_distance_ = 1.0f / (distance * distance);
  values_.resize((order.size() + JoinEnds::kLanes - 1) / JoinEnds::kLanes);
  for (std::size_t at = 0; at < values_.size() * JoinEnds::kLanes; ++at) {
    const JoinPoint& point = ends.end(order[std::min(at, order.size() - 1)]);
    Block& block = values_[at / JoinEnds::kLanes];
    for (std::size_t value = 0; value < JoinPoint::kSize; ++value) {
      block.values[value][at % JoinEnds::kLanes] = roots_[value] * point.values[value];
    }
  }
}

void JoinLanes::compare_with(const JoinPoint& begin) noexcept {
  for (std::size_t value = 0; value < JoinPoint::kSize; ++value) begin_[value] = roots_[value] * begin.values[value];
}

float JoinLanes::costs(std::size_t block, std::span<const float, JoinEnds::kLanes> before, float to,
                       std::span<float, JoinEnds::kLanes> out) const noexcept {
  static const BlockCosts block_costs = widest();
  return block_costs(
      values_[block].values[0], begin_.data(),
      {.before = before.data(), .to = to, .place = place_, .speed = speed_, .per_distance = per_distance_}, out.data());
}

}  // namespace signweave
