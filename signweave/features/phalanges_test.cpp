#include "signweave/features/phalanges.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>

namespace signweave {
namespace {

using Eigen::Vector3f;

/// Fingers with bones of 1 to 5 cm at random positions within a hand's reach.
HandPoints arbitrary_hand() {
  const auto number = [](int from, int to) { return static_cast<float>(*rc::gen::inRange(from, to)) / 1000; };
  const auto point = [&](int reach) {
    const float x = number(-reach, reach), y = number(-reach, reach), z = number(-reach, reach);
    return Vector3f(x, y, z);
  };
  HandPoints hand;
  hand.wrist = point(50);
  for (HandPoints::OneFinger& finger : hand.fingers) {
    finger.count = *rc::gen::element<std::size_t>(0, 2, 3, 4);
    for (std::size_t k = 0; k < finger.count; ++k) {
      finger.points[k] = k == 0 ? point(40) : Vector3f(finger.points[k - 1] + Vector3f(0.01f, 0, 0) + point(30));
    }
  }
  return hand;
}

/// The bones as capsules (contact.h).
std::vector<Capsule> bars_of(const HandPoints& hand, const FingerRadii& radii, std::size_t finger) {
  const HandPoints::OneFinger& one = hand.fingers[finger];
  std::vector<Capsule> bars;
  for (std::size_t k = finger == 0 && one.count > 3 ? 1 : 0; k + 1 < one.count; ++k) {
    bars.push_back({one.points[k], one.points[k + 1], radii[finger]});
  }
  return bars;
}

RC_GTEST_PROP(Phalanges, HaveThePenetrationDepthsOfTheirCapsules, ()) {
  const HandPoints hand = arbitrary_hand();
  const FingerRadii radii = finger_radii(hand);
  Phalanges phalanges;
  phalanges_of(hand, radii, phalanges);
  const FingerPairs pairs = finger_pairs(phalanges);
  const FingerDepths depths = finger_depths(pairs);
  std::size_t pair = 0;
  float deepest = 0;
  for (std::size_t a = 0; a < kFingers.size(); ++a) {
    for (std::size_t b = a + 1; b < kFingers.size(); ++b, ++pair) {
      float depth = 0;
      for (const Capsule& one : bars_of(hand, radii, a)) {
        for (const Capsule& other : bars_of(hand, radii, b)) depth = std::max(depth, -clearance(one, other));
      }
      RC_ASSERT(std::abs(depths[pair] - depth) < 1e-5f);
      deepest = std::max(deepest, depth);
    }
  }
  const auto worst = worst_crossing(phalanges, pairs, {});
  RC_ASSERT(worst.has_value() == (deepest > 0));
  if (!worst) return;
  RC_ASSERT(std::abs(worst->beyond - deepest) < 1e-5f);
  // Moved apart by their penetration depth, the fingers no longer overlap at these points.
  const float thick =
      radii[static_cast<std::size_t>(worst->a.finger)] + radii[static_cast<std::size_t>(worst->b.finger)];
  const Vector3f led = worst->a.at + worst->beyond * worst->away - worst->b.at;
  RC_ASSERT(worst->away.isZero() || std::abs(led.norm() - thick) < 1e-4f);
  FingerDepths allowed;
  allowed.fill(deepest + 1e-5f);
  RC_ASSERT(!worst_crossing(phalanges, pairs, allowed));
}

TEST(Phalanges, AFingerIsATenthOfItsLengthThick) {
  HandPoints hand{};
  hand.fingers[1].count = 3;
  hand.fingers[1].points = {Vector3f(0, 0, 0), Vector3f(0.05f, 0, 0), Vector3f(0.05f, 0.03f, 0)};
  EXPECT_FLOAT_EQ(finger_radii(hand)[1], 0.008f);
  EXPECT_EQ(finger_radii(hand)[2], 0);
}

}  // namespace
}  // namespace signweave
