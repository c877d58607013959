// The sign table, handshapes, tokens: the shapes, and how tokens differ.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <set>

#include "demo/corpus.h"
#include "demo/plan.h"
#include "demo/test_rate.h"
#include "signweave/core/error.h"
#include "signweave/motion/kinematics.h"

namespace signweave::demo {
namespace {

using Eigen::Vector3f;

TEST(SignTable, HasEveryGlossOnceAndEveryPlaceWithinReach) {
  std::set<std::string_view> seen;
  for (const SignShape& sign : sign_table()) {
    EXPECT_TRUE(seen.insert(sign.gloss).second) << sign.gloss;
    EXPECT_TRUE(within_reach(sign)) << sign.gloss;
    for (const Side side : kSides) {
      if (!acts(sign, side)) continue;
      for (int i = 0; i <= 20; ++i) {
        const Vector3f place = stroke_place(sign, side, 0.05f * static_cast<float>(i));
        EXPECT_LT((place - Vector3f(0.175f, 0, 0)).norm(), 0.50f) << sign.gloss;
        EXPECT_GT(place.z(), 0.11f) << sign.gloss;  // in front of chest and face
        EXPECT_GT(place.x(), 0.02f) << sign.gloss;  // on its own side: mirrored hands do not pass through each other
      }
    }
  }
  EXPECT_GE(seen.size(), 75U);
  EXPECT_THROW(sign_for("NO-SUCH-SIGN"), Error);
}

TEST(SignTable, UsesAllFeaturesOfADescription) {
  std::set<Handshape> shapes;
  std::set<Movement> movements;
  std::set<Mouth> mouths;
  std::map<Hands, int> hands;
  std::map<Brows, int> brows;
  int to_the_hand = 0;
  for (const SignShape& sign : sign_table()) {
    shapes.insert(sign.shape);
    if (sign.shape_end) shapes.insert(*sign.shape_end);
    if (sign.hands == Hands::on_base) shapes.insert(sign.base.shape);
    movements.insert(sign.movement);
    mouths.insert(sign.face.mouth);
    ++hands[sign.hands];
    ++brows[sign.face.brows];
    to_the_hand += sign.face.gaze == Gaze::hand ? 1 : 0;
  }
  EXPECT_EQ(shapes.size() + 1, static_cast<std::size_t>(kHandshapes));  // all except the relaxed one
  EXPECT_EQ(movements.size(), 8U);
  EXPECT_GE(mouths.size(), 10U);
  EXPECT_EQ(hands.size(), 4U);
  for (const auto& [which, count] : hands) EXPECT_GE(count, 5);
  EXPECT_EQ(brows.size(), 3U);
  EXPECT_GE(to_the_hand, 15);
}

TEST(Handshapes, AreWithinHumanLimitsAndDiffer) {
  EXPECT_GE(kHandshapes, 30);
  std::set<std::string_view> names;
  for (int a = 0; a < kHandshapes; ++a) {
    const auto shape = static_cast<Handshape>(a);
    EXPECT_TRUE(names.insert(name_of(shape)).second) << name_of(shape);
    const HandAngles& angles = angles_of(shape);
    for (std::size_t finger = 0; finger < kFingers; ++finger) {
      for (std::size_t i = 0; i < kFingerAngles; ++i) {
        const AngleLimits limits = limits_of(static_cast<int>(finger), static_cast<int>(i));
        EXPECT_GE(angles[finger][i], limits.least) << name_of(shape) << ' ' << finger << ' ' << i;
        EXPECT_LE(angles[finger][i], limits.most) << name_of(shape) << ' ' << finger << ' ' << i;
      }
    }
    for (int b = 0; b < a; ++b) {
      float whole = 0;
      for (std::size_t finger = 0; finger < kFingers; ++finger) {
        for (std::size_t i = 0; i < kFingerAngles; ++i) {
          whole += std::abs(angles[finger][i] - angles_of(static_cast<Handshape>(b))[finger][i]);
        }
      }
      EXPECT_GT(whole, 17.0f) << name_of(shape) << " and " << name_of(static_cast<Handshape>(b));
    }
  }
}

TEST(Handshapes, AreRecoveredFromTheirRotationsOnBothSides) {
  for (int a = 0; a < kHandshapes; ++a) {
    const HandAngles& angles = angles_of(static_cast<Handshape>(a));
    for (const Side side : kSides) {
      const HandAngles back = angles_in(finger_rotations(angles, side), side);
      for (std::size_t finger = 0; finger < kFingers; ++finger) {
        for (std::size_t i = 0; i < kFingerAngles; ++i) EXPECT_NEAR(back[finger][i], angles[finger][i], 0.05f) << a;
      }
    }
  }
}

/// Joints and tip of a finger of the left hand, from the wrist.
std::vector<Vector3f> finger_points(Handshape shape, std::size_t finger) {
  const Signer signer = make_signer();
  const FingerRotations rotations = finger_rotations(angles_of(shape), Side::left);
  std::vector<Vector3f> points;
  Vector3f place = Vector3f::Zero();
  Eigen::Quaternionf rotation = Eigen::Quaternionf::Identity();
  for (std::size_t i = 0; i < kPhalanges; ++i) {
    place += rotation * signer.skeleton->joint(signer.left.fingers[finger][i]).offset;
    rotation = rotation * rotations[finger][i];
    points.push_back(place);
  }
  points.push_back(place + rotation * signer.finger_tip(finger));
  return points;
}

TEST(Handshapes, TouchAsDescribedWithoutPenetration) {
  const auto apart = [](Handshape shape, std::size_t a, std::size_t b) {
    return (finger_points(shape, a).back() - finger_points(shape, b).back()).norm();
  };
  EXPECT_LT(apart(Handshape::ring, 0, 1), 0.016f);
  EXPECT_LT(apart(Handshape::pinch, 0, 1), 0.016f);
  EXPECT_LT(apart(Handshape::snap, 0, 2), 0.016f);
  EXPECT_LT(apart(Handshape::beak, 0, 2), 0.024f);
  EXPECT_GT(apart(Handshape::spread, 0, 1), 0.06f);
  for (int a = 0; a < kHandshapes; ++a) {
    const auto shape = static_cast<Handshape>(a);
    // Fingers are about 1.5 cm thick: their tips stay apart, and no tip is inside the palm, which is 2 cm thick.
    for (std::size_t i = 0; i < kFingers; ++i) {
      for (std::size_t j = 0; j < i; ++j) EXPECT_GT(apart(shape, i, j), 0.006f) << name_of(shape) << i << j;
      const Vector3f tip = finger_points(shape, i).back();
      if (tip.x() < 0.075f && std::abs(tip.z()) < 0.03f) {
        EXPECT_LT(tip.y(), -0.012f) << name_of(shape) << i;
      }
    }
  }
}

TEST(Handshapes, BlendFromOneToTheOtherWithoutOvershooting) {
  const HandAngles& from = angles_of(Handshape::spread);
  const HandAngles& to = angles_of(Handshape::fist);
  EXPECT_EQ(blend(from, to, 0), from);
  const HandAngles end = blend(from, to, 1);
  for (std::size_t finger = 0; finger < kFingers; ++finger) {
    for (std::size_t i = 0; i < kFingerAngles; ++i) {
      EXPECT_FLOAT_EQ(end[finger][i], to[finger][i]);
      float before = from[finger][i];
      for (int k = 1; k <= 20; ++k) {
        const float now = blend(from, to, 0.05f * static_cast<float>(k))[finger][i];
        EXPECT_GE((now - before) * (to[finger][i] - from[finger][i]), 0.0f);
        before = now;
      }
    }
  }
  // The thumb moves first when a fist opens and last when it closes.
  const auto done = [](const HandAngles& a, const HandAngles& b, std::size_t finger, std::size_t i) {
    return (blend(a, b, 0.35f)[finger][i] - a[finger][i]) / (b[finger][i] - a[finger][i]);
  };
  EXPECT_LT(done(from, to, 0, 2), done(from, to, 1, 1));
  EXPECT_GE(done(to, from, 0, 2), done(to, from, 4, 1));
}

TEST(Tokens, OfOneGlossDifferInSizeSpeedAndPlaceWithinBounds) {
  std::map<std::string_view, std::vector<PlacedSign>> tokens;
  for (const Script& script : corpus_scripts(20)) {
    const Timeline timeline = timeline_of(script, kRate, 1);
    for (const PlacedSign& sign : timeline.signs) tokens[sign.shape->gloss].push_back(sign);
  }
  for (const auto& [gloss, signs] : tokens) {
    std::set<float> sizes, places;
    std::set<std::int64_t> lengths;
    for (const PlacedSign& sign : signs) {
      EXPECT_NEAR(sign.token.size, 1, 0.1501) << gloss;
      EXPECT_LT(sign.token.shift.norm(), 0.0201f) << gloss;
      EXPECT_TRUE(within_reach(*sign.shape, sign.token)) << gloss;
      EXPECT_GE(sign.token.lag, 0.010);
      EXPECT_LE(sign.token.lag, 0.040);
      sizes.insert(sign.token.size);
      places.insert(sign.token.shift.x());
      lengths.insert(sign.stroke_end - sign.stroke_begin);
    }
    EXPECT_EQ(sizes.size(), signs.size()) << gloss;
    EXPECT_EQ(places.size(), signs.size()) << gloss;
    if (signs.size() >= 5) {
      EXPECT_GE(lengths.size(), 2U) << gloss;
    }
  }
}

TEST(Tokens, MakeSmallMovementsSmallerInAQuickContext) {
  double quick = 0, slow = 0;
  int quick_count = 0, slow_count = 0;
  for (const std::uint64_t seed : {1, 2, 3, 4}) {
    const Timeline timeline = timeline_of(meteo(), kRate, seed);
    for (std::size_t i = 1; i + 1 < timeline.signs.size(); ++i) {
      const PlacedSign& sign = timeline.signs[i];
      const auto before = sign.stroke_begin - timeline.signs[i - 1].stroke_end;
      const auto after = timeline.signs[i + 1].stroke_begin - sign.stroke_end;
      const bool fast = std::min(before, after) < 50;
      (fast ? quick : slow) += static_cast<double>(sign.token.small);
      ++(fast ? quick_count : slow_count);
      EXPECT_LE(sign.token.small, 1);
      EXPECT_GE(sign.token.small, 0.7f);
    }
  }
  ASSERT_GT(quick_count, 5);
  ASSERT_GT(slow_count, 5);
  EXPECT_LT(quick / quick_count, slow / slow_count - 0.1);
  // A smaller movement is also shorter.
  const SignShape& froid = sign_for("FROID");
  const Token calm;
  const Token hurried{.small = 0.72f, .fewer = 1};
  EXPECT_LT(stroke_length(froid, Side::right, hurried), 0.8f * stroke_length(froid, Side::right, calm));
}

}  // namespace
}  // namespace signweave::demo
