// Arms and hands: obstacles they avoid, and joint limits.

#include "demo/arms.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <numbers>

#include "demo/corpus.h"
#include "demo/test_rate.h"
#include "signweave/motion/kinematics.h"

namespace signweave::demo {
namespace {

using Eigen::Vector3f;

TEST(KeepOut, PushesPointsOutOfACapsuleAndLeavesOthersAlone) {
  const Capsule bars[] = {{.from = {0, 1, 0}, .to = {0, 1.4f, 0}, .radius = 0.1f}};
  EXPECT_NEAR(clearance(bars[0], {0.25f, 1.2f, 0}), 0.15f, 1e-6f);
  EXPECT_NEAR(clearance(bars[0], {0, 1.55f, 0}), 0.05f, 1e-6f);
  const Vector3f far[] = {{0.2f, 1.2f, 0}};
  EXPECT_EQ(push_out(bars, far), Vector3f::Zero());
  const Vector3f deep[] = {{0.04f, 1.2f, 0.03f}, {0.2f, 1.2f, 0}};
  const Vector3f push = push_out(bars, deep);
  EXPECT_GT(clearance(bars[0], deep[0] + push), 0.0f);
  EXPECT_LT(push.norm(), 0.08f);
  EXPECT_GT(push.z(), 0);  // the shortest direction out
  // The onset is soft.
  const Vector3f near[] = {{0.1155f, 1.2f, 0}};
  EXPECT_GT(push_out(bars, near).norm(), 0);
  EXPECT_LT(push_out(bars, near).norm(), 1e-4f);
}

TEST(KeepOut, ReturnsHowMuchTooCloseTwoHandsAre) {
  const Vector3f one[] = {{0, 0, 0}, {0.1f, 0, 0}};
  const Vector3f apart[] = {{0, 0.05f, 0}};
  const Vector3f close[] = {{0.1f, 0.005f, 0}};
  EXPECT_EQ(too_close(one, apart), 0);
  EXPECT_NEAR(too_close(one, close), 0.011f, 1e-4f);
}

/// Poses every frame of a script with custom capsules.
class Posed {
 public:
  Posed(const Script& script, std::uint64_t seed, const std::array<Capsule, 2>& bars)
      : signer_(make_signer()),
        timeline_(timeline_of(script, kRate, seed)),
        random_(seed),
        plan_(script, timeline_, random_),
        motion_(signer_.skeleton, kRate, timeline_.frames) {
    Arms arms(signer_, plan_, 100, random_);
    const ModelPose rest = to_model_space(*signer_.skeleton, motion_.pose(0));
    const Trunk trunk{.model = rest, .keep_out = bars};
    for (std::int64_t frame = 0; frame < timeline_.frames; ++frame) arms.look_ahead(frame, trunk);
    arms.yield_smoothly();
    for (std::int64_t frame = 0; frame < timeline_.frames; ++frame) arms.fill(frame, trunk, motion_.pose(frame));
  }
  const Timeline& timeline() const { return timeline_; }
  /// Finger joints of one hand.
  std::vector<Vector3f> hand(Side side, std::int64_t frame) const {
    const ModelPose pose = to_model_space(*signer_.skeleton, motion_.pose(frame));
    std::vector<Vector3f> points;
    for (const auto& finger : signer_.side(side).fingers) {
      for (const JointIndex joint : finger) points.push_back(pose.positions[static_cast<std::size_t>(joint)]);
    }
    return points;
  }

 private:
  Signer signer_;
  Timeline timeline_;
  Random random_;
  HandPlan plan_;
  Motion motion_;
};

Script of(std::vector<std::vector<std::string_view>> units) {
  return {.name = "short",
          .units = std::move(units),
          .transition_mean = 735ms,
          .transition_deviation = 224ms,
          .sink = 0.1f};
}

const Capsule kNowhere{.from = {9, 9, 9}, .to = {9, 9.1f, 9}};

TEST(Arms, AvoidACapsuleInTheirPath) {
  const Script script = of({{"NORD", "SUD", "VANNES", "NORD"}});
  // Upright, next to the path of the right hand to the north.
  const Capsule bar{.from = {-0.13f, 1.2f, 0.31f}, .to = {-0.13f, 1.7f, 0.31f}, .radius = 0.05f};
  const Posed free(script, 1, {kNowhere, kNowhere});
  const Posed barred(script, 1, {bar, kNowhere});
  float deepest_free = 1;
  float deepest = 1;
  for (std::int64_t frame = 0; frame < free.timeline().frames; frame += 2) {
    for (const Vector3f& point : free.hand(Side::right, frame))
      deepest_free = std::min(deepest_free, clearance(bar, point));
    for (const Vector3f& point : barred.hand(Side::right, frame)) deepest = std::min(deepest, clearance(bar, point));
  }
  EXPECT_LT(deepest_free, -0.02f);
  EXPECT_GT(deepest, -0.01f);
}

TEST(Arms, AvoidEachOtherWithoutAJerk) {
  float nearest = 1;
  float hardest = 0;
  for (const std::uint64_t seed : {1, 2, 3}) {
    // Without avoidance these would pass 5 mm from bone to bone, inside each other.
    const Posed posed(of({{"MATIN", "AUTOMNE", "MATIN", "AUTOMNE"}, {"CENTRE", "MATIN", "CENTRE", "MATIN"}}), seed,
                      {kNowhere, kNowhere});
    std::vector<Vector3f> before, earlier;
    for (std::int64_t frame = 0; frame < posed.timeline().frames; ++frame) {
      const std::vector<Vector3f> left = posed.hand(Side::left, frame);
      const std::vector<Vector3f> right = posed.hand(Side::right, frame);
      for (const Vector3f& a : left) {
        for (const Vector3f& b : right) nearest = std::min(nearest, (a - b).norm());
      }
      if (frame > 1) {
        for (std::size_t i = 0; i < left.size(); ++i) {
          hardest = std::max(hardest, 1e4f * (left[i] - 2 * before[i] + earlier[i]).norm());
        }
      }
      earlier = std::move(before);
      before = left;
    }
  }
  EXPECT_GT(nearest, 0.009f);
  EXPECT_LT(hardest, 120.0f);
}

TEST(Limited, KeepsForearmAndWristWithinJointLimits) {
  const auto radians = [](double degrees) { return static_cast<float>(degrees * std::numbers::pi / 180); };
  const WristAngles far = limited({.twist = 3, .flexion = 2, .radial = 0.5f, .swivel = 0.3f});
  EXPECT_NEAR(far.twist, radians(85), 1e-5f);
  EXPECT_LE(far.flexion, radians(70));
  EXPECT_LE(far.radial, radians(25));
  EXPECT_EQ(far.swivel, 0.3f);
  const WristAngles easy{.twist = 0.5f, .flexion = -0.4f, .radial = -0.1f};
  EXPECT_EQ(limited(easy).flexion, easy.flexion);
  EXPECT_EQ(limited(easy).radial, easy.radial);
}

}  // namespace
}  // namespace signweave::demo
