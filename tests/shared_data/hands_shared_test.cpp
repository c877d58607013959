// The hands of real signers: whether the measured values are humanly possible.

#include <gtest/gtest.h>

#include <filesystem>

#include "signweave/features/hand_motion.h"
#include "signweave/formats/bvh/bvh.h"

namespace signweave {
namespace {

namespace fs = std::filesystem;

class RealHands : public testing::TestWithParam<const char*> {
 protected:
  Motion motion = bvh::read(fs::path(SIGNWEAVE_SHARED_DATA) / "bvh" / GetParam()).motion;
};
INSTANTIATE_TEST_SUITE_P(SharedData, RealHands,
                         testing::Values("ksl-always/always.bvh", "signon-thanks/ISL Thanks.bvh",
                                         "signon-thanks/NGT Thanks.bvh", "signon-thanks/VGT Thanks.bvh"),
                         [](const auto& row) {
                           const std::string stem = fs::path(row.param).stem().string();
                           return stem.substr(0, stem.find(' '));
                         });

TEST_P(RealHands, AreWhereHumanHandsCanBe) {
  SignerModel model{.rig = map_rig(motion), .body = {}};
  model.body = signer_body(motion, model.rig);
  ASSERT_TRUE(model.body) << why_no_signer_space(model.rig);
  EXPECT_GT(model.body->shoulder_width, 0.2f);
  EXPECT_LT(model.body->shoulder_width, 0.5f);
  const HandMotion hands = measure_hands(motion, model, {0, motion.frame_count()});
  // In always.bvh the first frame is a T-pose, from which the hands jump: velocity fits that include it are not real
  // speeds.
  const std::size_t first = std::string_view(GetParam()).starts_with("ksl") ? 4 : 0;
  float fastest = 0;
  for (const HandMotion::OneHand& hand : hands.hands) {
    EXPECT_EQ(hand.why_not, "");
    EXPECT_EQ(hand.why_no_fingers, "");
    ASSERT_EQ(std::ssize(hand.frames), motion.frame_count());
    for (std::size_t i = first; i < hand.frames.size(); ++i) {
      const HandFrame& frame = hand.frames[i];
      ASSERT_TRUE(frame.acceleration.allFinite()) << i;
      EXPECT_LT(frame.velocity.norm(), 10) << i;
      fastest = std::max(fastest, frame.velocity.norm());
      // From the shoulder: an arm and half a palm.
      EXPECT_LT(frame.position.norm(), 0.5f + 1.2f * model.body->arm_length) << i;
      EXPECT_NEAR(frame.palm.norm(), 1, 1e-4f) << i;
      EXPECT_NEAR(frame.fingers.norm(), 1, 1e-4f) << i;
      EXPECT_NEAR(frame.palm.dot(frame.fingers), 0, 1e-4f) << i;
    }
  }
  EXPECT_GT(fastest, 0.5f);
}

TEST_P(RealHands, SignInFrontOfTheBody) {
  SignerModel model{.rig = map_rig(motion), .body = {}};
  model.body = signer_body(motion, model.rig);
  ASSERT_TRUE(model.body);
  const HandMotion hands = measure_hands(motion, model, {0, motion.frame_count()});
  // A right hand as high as the chest is signing: in front of the body, and not on the left.
  int signing = 0;
  for (const HandFrame& frame : hands.hands[1].frames) {
    if (frame.velocity.norm() > 5) continue;  // after the T-pose
    const Zone zone = zone_of(frame.position, *model.body);
    if (zone.height < Height::chest || frame.position.z() < 0) continue;
    ++signing;
    EXPECT_NE(zone.across, Across::left);
    EXPECT_LT(zone.height, Height::above_head);
  }
  EXPECT_GT(signing, 10);
}

}  // namespace
}  // namespace signweave
