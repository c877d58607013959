// Real signing and the made signer's, on the character that studio/avatar builds, against what the source does. The
// character is no part of the sources: it is looked for in build/character (studio/avatar/build --plain
// build/character), or where SIGNWEAVE_CHARACTERS says.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <iostream>
#include <numbers>

#include "demo/corpus.h"
#include "signweave/features/hand_points.h"
#include "signweave/formats/bvh.h"
#include "signweave/retarget/retarget.h"

namespace signweave {
namespace {

namespace fs = std::filesystem;
using Eigen::Quaternionf;
using Eigen::Vector3f;

constexpr float kDegree = std::numbers::pi_v<float> / 180;

float angle(const Vector3f& a, const Vector3f& b) {
  return std::atan2(a.cross(b).norm(), a.dot(b)) / kDegree;
}

fs::path character_path(const std::string& name) {
  const char* told = std::getenv("SIGNWEAVE_CHARACTERS");
  return (told != nullptr ? fs::path(told) : fs::path(SIGNWEAVE_SOURCE_DIR) / "build" / "character") /
         (name + ".plain.glb");
}

Motion source(const std::string& name) {
  if (name == "meteo") return demo::make_recording(demo::corpus_scripts(2).front(), {100, 1}, 1).motion;
  bvh::ReadOptions options;
  // What `info` says of these files: the root's columns are permuted, and in metres.
  if (name.starts_with("signon")) options = {.root_unit = 1.0, .root_columns = bvh::RootColumns::rotation_first};
  return bvh::read(fs::path(SIGNWEAVE_SHARED_DATA) / "bvh" / name, options).motion;
}

float length_of(const HandPoints& hand) {
  const HandPoints::OneFinger& middle = hand.finger(Finger::middle);
  float sum = (middle.points[0] - hand.wrist).norm();
  for (std::size_t i = 1; i < middle.count; ++i) sum += (middle.points[i] - middle.points[i - 1]).norm();
  return sum;
}
Vector3f tip_of(const HandPoints& hand, Finger finger) {
  return hand.finger(finger).points[hand.finger(finger).count - 1];
}

/// The value below which so much of them lies.
float quantile(std::vector<float> values, double share) {
  const auto at = values.begin() + static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), at, values.end());
  return *at;
}

class OnTheCharacter : public testing::TestWithParam<std::tuple<const char*, const char*>> {};
INSTANTIATE_TEST_SUITE_P(
    SharedData, OnTheCharacter,
    testing::Combine(testing::Values("woman", "man"),
                     testing::Values("meteo", "ksl-always/always.bvh", "signon-thanks/ISL Thanks.bvh",
                                     "signon-thanks/NGT Thanks.bvh", "signon-thanks/VGT Thanks.bvh")),
    [](const auto& row) {
      std::string name = std::get<0>(row.param);
      const std::string stem = fs::path(std::get<1>(row.param)).stem().string();
      return name + '_' + stem.substr(0, stem.find(' '));
    });

TEST_P(OnTheCharacter, SigningStaysTheSame) {
  const auto [who, what] = GetParam();
  if (!fs::exists(character_path(who))) {
    GTEST_SKIP() << "not run: no character: studio/avatar/build --plain build/character makes it";
  }
  const Character character = read_character(character_path(who));
  const Motion motion = source(what);
  SignerModel signer{.rig = map_rig(motion), .body = {}};
  signer.body = signer_body(motion, signer.rig);
  ASSERT_TRUE(signer.body);
  const Retargeted shown = retarget(motion, signer, character);
  EXPECT_TRUE(shown.notices.empty()) << shown.notices.front().text;
  ASSERT_EQ(shown.motion.frame_count(), motion.frame_count());

  std::vector<float> pinches;
  std::vector<float> heights;
  const RigAxes axes(*character.skeleton, character.rig);
  for (std::int64_t frame = 0; frame < motion.frame_count(); ++frame) {
    const PoseView pose = shown.motion.pose(frame);
    for (const Quaternionf& turn : pose.rotations) ASSERT_NEAR(turn.norm(), 1, 1e-4f) << frame;
    const ModelPose from = to_model_space(motion.skeleton(), motion.pose(frame));
    const ModelPose to = to_model_space(*character.skeleton, pose);
    const SignerSpace there = signer_space(*signer.body, signer.rig, from);
    const SignerSpace here = signer_space(*character.body, character.rig, to);
    for (const Side side : kSides) {
      HandPoints a;
      HandPoints b;
      HandPlaces(signer.rig, side).read(from, a);
      HandPlaces(character.rig, side).read(to, b);
      ASSERT_LT(angle(axes_of(a, side).palm, axes_of(b, side).palm), 5) << frame;
      ASSERT_LT(angle(axes_of(a, side).fingers, axes_of(b, side).fingers), 5) << frame;
      for (const Finger finger : {Finger::index, Finger::middle, Finger::ring, Finger::little}) {
        const float source_gap = (tip_of(a, finger) - tip_of(a, Finger::thumb)).norm() / length_of(a);
        const float gap = (tip_of(b, finger) - tip_of(b, Finger::thumb)).norm() / length_of(b);
        pinches.push_back(std::abs(gap - source_gap));
      }
      heights.push_back(std::abs(there.to_signer(palm_of(a)).y() - here.to_signer(palm_of(b)).y()));
      // An elbow bends to the side to which elbows bend.
      const auto turn_of = [&](Part part) { return to.rotations[static_cast<std::size_t>(character.rig[part].joint)]; };
      const Part elbow = of(side, Part::left_forearm);
      const JointIndex upper = character.skeleton->joint(character.rig[elbow].joint).parent;
      const Quaternionf arm = to.rotations[static_cast<std::size_t>(upper)] * axes[of(side, Part::left_upper_arm)];
      const Vector3f lower = (to.positions[static_cast<std::size_t>(character.rig[of(side, Part::left_hand)].joint)] -
                              to.positions[static_cast<std::size_t>(character.rig[elbow].joint)])
                                 .normalized();
      ASSERT_GT(lower.dot(arm * Vector3f::UnitY()), -0.12f) << frame << ": the elbow is bent backwards";
      ASSERT_TRUE(turn_of(elbow).coeffs().allFinite());
    }
  }
  // Of a hand's length, and of a shoulder width.
  std::cout << who << ' ' << what << ": thumb " << quantile(pinches, 0.5) << ' ' << quantile(pinches, 0.95)
            << ", height " << quantile(heights, 0.5) << ' ' << quantile(heights, 0.95) << '\n';
  EXPECT_LT(quantile(pinches, 0.5), 0.08f);
  EXPECT_LT(quantile(pinches, 0.95), 0.20f);
  EXPECT_LT(quantile(heights, 0.5), 0.10f);
  EXPECT_LT(quantile(heights, 0.95), 0.25f);
}

TEST_P(OnTheCharacter, ItselfGivesItselfBack) {
  const auto [who, what] = GetParam();
  if (!fs::exists(character_path(who))) {
    GTEST_SKIP() << "not run: no character: studio/avatar/build --plain build/character makes it";
  }
  const Character character = read_character(character_path(who));
  const Motion motion = source(what);
  SignerModel signer{.rig = map_rig(motion), .body = {}};
  signer.body = signer_body(motion, signer.rig);
  Motion once = retarget(motion, signer, character).motion;
  once.take_tracks();
  const Motion twice = retarget(once, {.rig = character.rig, .body = character.body}, character).motion;
  float most = 0;
  for (std::size_t i = 0; i < once.rotations().size(); ++i) {
    const Quaternionf turn = once.rotations()[i].conjugate() * twice.rotations()[i];
    most = std::max(most, 2 * std::atan2(turn.vec().norm(), std::abs(turn.w())) / kDegree);
  }
  EXPECT_LT(most, 0.1f);
}

}  // namespace
}  // namespace signweave
