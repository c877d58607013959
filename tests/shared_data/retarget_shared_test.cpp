// Real signing on the characters built by studio/avatar, compared with the source.

#include <gtest/gtest.h>

#include <iostream>

#include "signweave/formats/bvh/bvh.h"
#include "tests/retarget_figures.h"

namespace signweave {
namespace {

namespace fs = std::filesystem;
using Eigen::Quaternionf;

Motion source(const std::string& name) {
  bvh::ReadOptions options;
  // Options according to what `info` reports of these files: the root's columns are permuted, and in metres.
  if (name.starts_with("signon")) options = {.root_unit = 1.0, .root_columns = bvh::RootColumns::rotation_first};
  return bvh::read(fs::path(SIGNWEAVE_SHARED_DATA) / "bvh" / name, options).motion;
}

SignerModel model_in(const Motion& motion) {
  SignerModel signer{.rig = map_rig(motion), .body = {}};
  signer.body = signer_body(motion, signer.rig);
  return signer;
}

class OnTheCharacter : public testing::TestWithParam<std::tuple<const char*, const char*>> {};
INSTANTIATE_TEST_SUITE_P(RetargetSharedData, OnTheCharacter,
                         testing::Combine(testing::Values("woman", "man"),
                                          testing::Values("ksl-always/always.bvh", "signon-thanks/ISL Thanks.bvh",
                                                          "signon-thanks/NGT Thanks.bvh",
                                                          "signon-thanks/VGT Thanks.bvh")),
                         [](const auto& row) {
                           std::string name = std::get<0>(row.param);
                           const std::string stem = fs::path(std::get<1>(row.param)).stem().string();
                           return name + '_' + stem.substr(0, stem.find(' '));
                         });

TEST_P(OnTheCharacter, SigningStaysTheSame) {
  const auto [who, what] = GetParam();
  const auto path = built_character(who);
  if (!path) {
    std::cout << kNoCharacter << std::endl;
    return;
  }
  const Character character = read_character(*path);
  const Motion motion = source(what);
  const SignerModel signer = model_in(motion);
  ASSERT_TRUE(signer.body);
  const Retargeted shown = retarget(motion, signer, character);
  EXPECT_TRUE(shown.notices.empty()) << shown.notices.front().text;
  ASSERT_EQ(shown.motion.frame_count(), motion.frame_count());
  for (const Quaternionf& turn : shown.motion.rotations()) ASSERT_NEAR(turn.norm(), 1, 1e-4f);

  const RetargetFigures figures = measure_retargeting(motion, signer, shown.motion, character);
  std::cout << figures.line(std::string(who) + ' ' + what) << '\n';
  EXPECT_LT(quantile(figures.palm, 1), 5);
  EXPECT_LT(quantile(figures.fingers, 1), 5);
  EXPECT_LT(quantile(figures.thumb, 0.5), 0.08f);
  EXPECT_LT(quantile(figures.thumb, 0.95), 0.20f);
  if (!figures.pinch.empty()) {
    EXPECT_LT(quantile(figures.pinch, 0.95), 0.06f);
  }
  EXPECT_LT(quantile(figures.held, 0.5), 0.03f);
  EXPECT_LT(quantile(figures.held, 0.95), 0.05f);
  EXPECT_LT(quantile(figures.place, 0.95), 0.08f);
  if (!figures.hanging.empty()) {
    EXPECT_LT(quantile(figures.hanging, 0.95), 0.40f);
  }
  EXPECT_LT(quantile(figures.inside, 1), 0.005f);
  EXPECT_LT(quantile(figures.elbow, 1), 0.12f);
}

TEST_P(OnTheCharacter, RetargetingTwiceChangesNothing) {
  const auto [who, what] = GetParam();
  const auto path = built_character(who);
  if (!path) {
    std::cout << kNoCharacter << std::endl;
    return;
  }
  const Character character = read_character(*path);
  const Motion motion = source(what);
  Motion once = retarget(motion, model_in(motion), character).motion;
  once.take_tracks();
  const Motion twice = retarget(once, {.rig = character.rig, .body = character.body}, character).motion;
  float bent = 0;      // degrees, joints except those of nearly straight arms
  float straight = 0;  // degrees, joints of nearly straight arms
  float moved = 0;     // metres, wrists
  for (std::int64_t frame = 0; frame < once.frame_count(); ++frame) {
    const ModelPose before = to_model_space(*character.skeleton, once.pose(frame));
    const ModelPose after = to_model_space(*character.skeleton, twice.pose(frame));
    bool nearly_straight = false;
    for (const Side side : kSides) {
      const auto place = [&](Part part) { return position_of(character.rig[of(side, part)], before); };
      const Eigen::Vector3f upper = place(Part::left_forearm) - place(Part::left_upper_arm);
      const Eigen::Vector3f lower = place(Part::left_hand) - place(Part::left_forearm);
      nearly_straight |= degrees_between(upper, lower) < 15;
      moved = std::max(moved,
                       (position_of(character.rig[of(side, Part::left_hand)], after) - place(Part::left_hand)).norm());
    }
    for (std::size_t i = 0; i < character.skeleton->joint_count(); ++i) {
      const Quaternionf turn = once.pose(frame).rotations[i].conjugate() * twice.pose(frame).rotations[i];
      const float off = 2 * std::atan2(turn.vec().norm(), std::abs(turn.w())) * 180 / std::numbers::pi_v<float>;
      (nearly_straight ? straight : bent) = std::max(nearly_straight ? straight : bent, off);
    }
  }
  std::cout << fmt::format(
      "{} {}: once and twice differ by {:.3f} deg, {:.2f} where an arm is nearly straight, wrists by {:.2f} mm\n", who,
      what, bent, straight, 1000 * moved);
  EXPECT_LT(moved, 0.001f);
  EXPECT_LT(bent, 0.1f);
  // The elbow of a nearly straight arm turns by degrees when its wrist moves by less than a millimetre.
  EXPECT_LT(straight, 2);
}

}  // namespace
}  // namespace signweave
