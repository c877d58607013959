#include "signweave/features/phalanges.h"

#include <algorithm>
#include <cmath>

namespace signweave {
namespace {

using Eigen::Vector3f;

constexpr float kThickness = 0.1f;  ///< ratio of a finger's radius to its length

}  // namespace

FingerRadii finger_radii(const HandPoints& hand) noexcept {
  FingerRadii radii{};
  for (std::size_t i = 0; i < radii.size(); ++i) {
    for (std::size_t k = 1; k < hand.fingers[i].count; ++k) {
      radii[i] += kThickness * (hand.fingers[i].points[k] - hand.fingers[i].points[k - 1]).norm();
    }
  }
  return radii;
}

void phalanges_of(const HandPoints& hand, const FingerRadii& radii, Phalanges& out) noexcept {
  out.bones.clear();
  for (std::size_t i = 0; i < out.fingers.size(); ++i) {
    const HandPoints::OneFinger& finger = hand.fingers[i];
    Phalanges::One& one = out.fingers[i];
    one = {.first = i == static_cast<std::size_t>(Finger::thumb) && finger.count > 3 ? 1u : 0u,
           .begin = out.bones.count};
    for (std::size_t k = one.first; k + 1 < finger.count; ++k) {
      out.bones.add({finger.points[k], finger.points[k + 1], radii[i]});
    }
    one.end = out.bones.count;
    if (one.end == one.begin) continue;
    one.middle = 0.5f * (finger.points[one.first] + finger.points[finger.count - 1]);
    float square = 0;
    for (std::size_t k = one.first; k < finger.count; ++k) {
      square = std::max(square, (finger.points[k] - one.middle).squaredNorm());
    }
    one.reach = std::sqrt(square) + radii[i];
  }
}

FingerPairs finger_pairs(const Phalanges& hand) noexcept {
  FingerPairs pairs;
  CapsuleRow::Numbers clear;
  std::size_t first = 0;  // index of finger a's first pair
  for (std::size_t a = 0; a + 1 < hand.fingers.size(); first += hand.fingers.size() - 1 - a, ++a) {
    for (std::size_t i = hand.fingers[a].begin; i < hand.fingers[a].end; ++i) {
      clearances(hand.bones[i], hand.bones, hand.fingers[a].end, clear);
      for (std::size_t b = a + 1; b < hand.fingers.size(); ++b) {
        FingerPair& pair = pairs[first + b - a - 1];
        for (std::size_t k = hand.fingers[b].begin; k < hand.fingers[b].end; ++k) {
          if (-clear[k] > pair.depth) pair = {-clear[k], i, k, a, b};
        }
      }
    }
  }
  return pairs;
}

FingerDepths finger_depths(const FingerPairs& pairs) noexcept {
  FingerDepths depths;
  for (std::size_t i = 0; i < pairs.size(); ++i) depths[i] = std::max(0.0f, pairs[i].depth);
  return depths;
}

std::optional<FingerCrossing> worst_crossing(const Phalanges& hand, const FingerPairs& pairs,
                                             const FingerDepths& allowed) noexcept {
  std::optional<std::size_t> worst;
  float most = 0;
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    if (!(pairs[i].depth > 0) || !(pairs[i].depth - allowed[i] > most)) continue;
    most = pairs[i].depth - allowed[i];
    worst = i;
  }
  if (!worst) return std::nullopt;
  const FingerPair& pair = pairs[*worst];
  const Capsule one = hand.bones[pair.a];
  const Capsule other = hand.bones[pair.b];
  const Approach near = approach(one, other);
  const auto of_finger = [&](std::size_t finger, std::size_t bone, const Capsule& capsule, float along) {
    return FingerCrossing::One{static_cast<Finger>(finger),
                               hand.fingers[finger].first + bone - hand.fingers[finger].begin,
                               capsule.from + along * (capsule.to - capsule.from)};
  };
  return FingerCrossing{.beyond = most,
                        .a = of_finger(pair.finger_a, pair.a, one, near.along_a),
                        .b = of_finger(pair.finger_b, pair.b, other, near.along_b),
                        .pair = *worst,
                        .away = near.away};
}

}  // namespace signweave
