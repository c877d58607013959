#include "signweave/transition/wrist_limits.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <numbers>

#include "signweave/motion/kinematics.h"
#include "signweave/rig/test_rig.h"

namespace signweave {
namespace {

using Eigen::AngleAxisf;
using Eigen::Quaternionf;
using Eigen::Vector3f;

constexpr float kOneDegree = std::numbers::pi_v<float> / 180;

float arbitrary_degrees(int from, int to) {
  return kOneDegree * static_cast<float>(*rc::gen::inRange(10 * from, 10 * to)) / 10;
}

TEST(WristBend, FlexionIsTowardsThePalmAndDeviationTowardsTheThumb) {
  const auto skeleton = whole_person();
  const RigMap rig = rig_of_signer(*skeleton);
  for (const Side side : kSides) {
    const float s = side == Side::left ? 1.0f : -1.0f;
    const JointIndex wrist = rig[of(side, Part::left_hand)].joint;
    const auto bend_after = [&](const Quaternionf& turn) {
      Pose pose(*skeleton);
      pose.rotations[static_cast<std::size_t>(wrist)] = turn;
      const ModelPose model = to_model_space(*skeleton, pose.view());
      HandPoints points;
      HandPlaces(rig, side).read(model, points);
      const Vector3f elbow = position_of(rig[of(side, Part::left_forearm)], model);
      return wrist_bend((points.wrist - elbow).normalized(), axes_of(points, side));
    };
    // The test person's palms face down, the thumbs forwards, the fingers along x.
    const WristBend straight = bend_after(Quaternionf::Identity());
    EXPECT_NEAR(straight.flexion, 0, 0.01f);
    EXPECT_NEAR(straight.deviation, 0, 0.01f);
    EXPECT_NEAR(bend_after(Quaternionf(AngleAxisf(-s * 0.6f, Vector3f::UnitZ()))).flexion, 0.6f, 0.01f);
    EXPECT_NEAR(bend_after(Quaternionf(AngleAxisf(s * 0.6f, Vector3f::UnitZ()))).flexion, -0.6f, 0.01f);
    EXPECT_NEAR(bend_after(Quaternionf(AngleAxisf(-s * 0.4f, Vector3f::UnitY()))).deviation, 0.4f, 0.01f);
    EXPECT_NEAR(bend_after(Quaternionf(AngleAxisf(s * 0.4f, Vector3f::UnitY()))).deviation, -0.4f, 0.01f);
    EXPECT_NEAR(bend_after(Quaternionf(AngleAxisf(1.0f, Vector3f::UnitX()))).flexion, 0, 0.02f);  // twist
  }
}

RC_GTEST_PROP(WristLimits, KeepWhatIsWithinAndBendTheRestSmoothly, ()) {
  const WristLimits limits = human_wrist();
  const WristBend bend{arbitrary_degrees(-170, 170), arbitrary_degrees(-170, 170)};
  const WristBend kept = limited(bend, limits);
  const auto holds = [](float given, float is, const BendLimit& limit) {
    RC_ASSERT(is <= limit.most + 1e-6f);
    RC_ASSERT(is <= given + 1e-6f);
    if (given <= limit.freely) RC_ASSERT(is == given);
  };
  if (bend.flexion > 0) holds(bend.flexion, kept.flexion, limits.flexion);
  if (bend.flexion < 0) holds(-bend.flexion, -kept.flexion, limits.extension);
  if (bend.deviation > 0) holds(bend.deviation, kept.deviation, limits.radial);
  if (bend.deviation < 0) holds(-bend.deviation, -kept.deviation, limits.ulnar);
  // Slope: of an increase by a thousandth, at most that is given, and nearly all of it where the limit begins.
  const float edge = limits.ulnar.freely + 1e-3f;
  RC_ASSERT(std::abs(-limited({0, -edge}, limits).deviation - edge) < 1e-5f);
  const WristBend next = limited({bend.flexion + 1e-3f, bend.deviation}, limits);
  RC_ASSERT(next.flexion - kept.flexion >= -1e-6f);
  RC_ASSERT(next.flexion - kept.flexion <= 1e-3f + 1e-6f);
}

RC_GTEST_PROP(WristLimits, TurnTheHandToTheBendThatIsAllowed, ()) {
  const Side side = *rc::gen::element(Side::left, Side::right);
  const WristBend bend{arbitrary_degrees(-110, 110), arbitrary_degrees(-110, 110)};
  // A hand in an arbitrary orientation, and the forearm that gives it this bend.
  const Quaternionf lies = Quaternionf(AngleAxisf(arbitrary_degrees(-180, 180), Vector3f(0.6f, 0, 0.8f))) *
                           Quaternionf(AngleAxisf(arbitrary_degrees(-180, 180), Vector3f::UnitY()));
  const float s = side == Side::left ? 1.0f : -1.0f;
  const HandAxes rest{Vector3f(s, 0, 0), Vector3f(0, -1, 0), Vector3f(0, 0, 1)};
  const HandAxes hand{lies * rest.fingers, lies * rest.palm, lies * rest.thumb};
  const float angle = std::hypot(bend.flexion, bend.deviation);
  RC_PRE(angle > 0.01f && angle < 3);
  const Vector3f forearm = std::cos(angle) * hand.fingers -
                           std::sin(angle) / angle * (bend.flexion * hand.palm + bend.deviation * hand.thumb);
  RC_ASSERT(std::abs(wrist_bend(forearm, hand).flexion - bend.flexion) < 1e-3f);
  Quaternionf turn;
  const WristLimits limits = human_wrist();
  const WristBend wanted = limited(bend, limits);
  if (!turn_within(limits, forearm, hand, turn)) {
    RC_ASSERT(std::abs(wanted.flexion - bend.flexion) + std::abs(wanted.deviation - bend.deviation) < 1e-3f);
    return;
  }
  // Relative to the rotated hand, the forearm has the allowed bend.
  const WristBend is = wrist_bend(turn.conjugate() * forearm, hand);
  RC_ASSERT(std::abs(is.flexion - wanted.flexion) < 2e-3f);
  RC_ASSERT(std::abs(is.deviation - wanted.deviation) < 2e-3f);
}

TEST(WristLimits, ABorderBeyondTheLimitsWidensThem) {
  const WristLimits wide = widened(human_wrist(), {.flexion = -1.0f, .deviation = -70 * kOneDegree});
  EXPECT_FLOAT_EQ(wide.ulnar.freely, 70 * kOneDegree);
  EXPECT_FLOAT_EQ(wide.ulnar.most, 75 * kOneDegree);
  EXPECT_EQ(wide.radial.most, human_wrist().radial.most);
  EXPECT_EQ(wide.extension.freely, human_wrist().extension.freely);
}

}  // namespace
}  // namespace signweave
