#include "signweave/features/join.h"

#include <algorithm>
#include <cmath>

namespace signweave {
namespace {

void copy(const Eigen::Vector3f& from, JoinPoint& point, std::size_t at) noexcept {
  for (int axis = 0; axis < 3; ++axis) point.values[at + static_cast<std::size_t>(axis)] = from[axis];
}

/// Returns the sum of squared differences over some values.
float squares(const JoinPoint& a, const JoinPoint& b, std::size_t from, std::size_t count) noexcept {
  float sum = 0;
  for (std::size_t i = from; i < from + count; ++i) {
    const float difference = a.values[i] - b.values[i];
    sum += difference * difference;
  }
  return sum;
}

}  // namespace

JoinPoint join_point(const PhaseFeatures& phase, bool at_begin) noexcept {
  JoinPoint point;
  for (std::size_t side = 0; side < 2; ++side) {
    const HandOver& hand = phase.hands[side];
    if (!hand.known) continue;
    const HandAt& at = at_begin ? hand.begin : hand.end;
    const auto know = [&](std::uint8_t bit) {
      point.known = static_cast<std::uint8_t>(point.known | (bit << (3 * side)));
    };
    know(JoinPoint::kHand);
    copy(at.position, point, JoinPoint::kPlace + 3 * side);
    copy(at.velocity, point, JoinPoint::kVelocity + 3 * side);
    if (!at.fingers.isZero()) {
      know(JoinPoint::kFingers);
      copy(at.palm, point, JoinPoint::kDirection + 6 * side);
      copy(at.fingers, point, JoinPoint::kDirection + 6 * side + 3);
      std::copy(at.handshape.values.begin(), at.handshape.values.end(),
                point.values.begin() + static_cast<std::ptrdiff_t>(JoinPoint::kHandshape + Handshape::kSize * side));
    }
    if (!at.elbow.isZero()) {
      know(JoinPoint::kElbow);
      copy(at.elbow, point, JoinPoint::kArms + 3 * side);
    }
  }
  const TrunkFrame& trunk = at_begin ? phase.trunk_begin : phase.trunk_end;
  if (point.known != 0 && !trunk.lean.isZero()) {
    point.known = static_cast<std::uint8_t>(point.known | JoinPoint::kTrunkKnown);
    copy(trunk.lean, point, JoinPoint::kTrunk);
    point.values[JoinPoint::kTrunk + 3] = trunk.twist;
  }
  return point;
}

std::string_view name_of(JoinTerm term) noexcept {
  constexpr std::array<std::string_view, kJoinTerms> kTermNames = {"place", "velocity", "handshape", "direction",
                                                                   "arms",  "trunk",    "speed"};
  return kTermNames[static_cast<std::size_t>(term)];
}

JoinTerms join_terms(const JoinPoint& a, const JoinPoint& b, Seconds transition, float limit) noexcept {
  JoinTerms terms{};
  const auto term = [&](JoinTerm which) -> float& { return terms[static_cast<std::size_t>(which)]; };
  const unsigned both = static_cast<unsigned>(a.known) & b.known;
  const auto reach = static_cast<float>(std::max(transition, kShortestJoin).count()) * limit;
  for (std::size_t side = 0; side < 2; ++side) {
    const unsigned known = both >> (3 * side);
    if ((known & JoinPoint::kHand) != 0) {
      const float place = squares(a, b, JoinPoint::kPlace + 3 * side, 3);
      term(JoinTerm::place) += place;
      term(JoinTerm::velocity) += squares(a, b, JoinPoint::kVelocity + 3 * side, 3);
      term(JoinTerm::speed) += std::max(0.0f, place / (reach * reach) - 1.0f);
    }
    if ((known & JoinPoint::kFingers) != 0) {
      term(JoinTerm::direction) += squares(a, b, JoinPoint::kDirection + 6 * side, 6);
      term(JoinTerm::handshape) +=
          squares(a, b, JoinPoint::kHandshape + Handshape::kSize * side, Handshape::kSize) / Handshape::kSize;
    }
    if ((known & JoinPoint::kElbow) != 0) term(JoinTerm::arms) += squares(a, b, JoinPoint::kArms + 3 * side, 3);
  }
  if ((both & JoinPoint::kTrunkKnown) != 0) term(JoinTerm::trunk) = squares(a, b, JoinPoint::kTrunk, 4);
  return terms;
}

float cost_of(const JoinTerms& terms, const JoinTerms& weights) noexcept {
  float sum = 0;
  for (std::size_t i = 0; i < kJoinTerms; ++i) sum += terms[i] * weights[i];
  return sum;
}

bool nearly_same(const JoinWeights& a, const JoinWeights& b) noexcept {
  const auto same = [](float x, float y) { return std::abs(x - y) <= 0.02f * (1 + std::abs(x)); };
  bool all = a.pairs == b.pairs && a.comparisons == b.comparisons && a.folds == b.folds;
  all = all && same(a.speed_limit, b.speed_limit) && same(a.wins, b.wins) && same(a.default_wins, b.default_wins);
  for (std::size_t i = 0; i < kJoinTerms; ++i) all = all && same(a.weights[i], b.weights[i]);
  return all;
}

void encode(const JoinWeights& weights, ByteWriter& out) {
  for (const float weight : weights.weights) out.number(weight);
  out.number(weights.speed_limit);
  out.number(weights.pairs);
  out.number(weights.comparisons);
  out.number(weights.folds);
  out.number(weights.wins);
  out.number(weights.default_wins);
}

JoinWeights decode_join_weights(ByteReader& in) {
  JoinWeights weights;
  const auto number = [&](float most) {
    const auto value = in.number<float>();
    if (!(value >= 0 && value <= most)) in.fail("a weight is out of range");
    return value;
  };
  constexpr float kMost = 1e30f;
  for (float& weight : weights.weights) weight = number(kMost);
  weights.speed_limit = number(kMost);
  if (weights.speed_limit == 0) in.fail("the speed limit is 0");
  weights.pairs = in.number<std::uint32_t>();
  weights.comparisons = in.number<std::uint32_t>();
  weights.folds = in.number<std::uint32_t>();
  weights.wins = number(1);
  weights.default_wins = number(1);
  return weights;
}

}  // namespace signweave
