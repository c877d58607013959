#include "signweave/live/rest_pose.h"

#include <gtest/gtest.h>

#include <numbers>

#include "signweave/rig/test_rigs.h"

namespace signweave {
namespace {

using Eigen::Quaternionf;
using Eigen::Vector3f;

/// A person whose arms, trunk and head are given in degrees.
struct Stance {
  double arms = 0;  ///< below the horizontal; 90 hanging
  double bow = 0;
  double look = 0;  ///< to the left
};

Quaternionf turn_about(const Vector3f& axis, double degrees) {
  return Quaternionf(Eigen::AngleAxisf(static_cast<float>(degrees * std::numbers::pi / 180), axis));
}

/// Takes each stance in turn for `hold` frames, after as many frames of moving there.
Motion taking(const std::vector<Stance>& stances, std::int64_t hold = 50) {
  Motion motion = rig_body({}, 2 * hold * static_cast<std::int64_t>(stances.size()));
  const auto joint = [&](std::string_view name) {
    return static_cast<std::size_t>(motion.skeleton().find(name).value_or(kNoJoint));
  };
  Stance at = stances.front();
  for (std::int64_t frame = 0; frame < motion.frame_count(); ++frame) {
    const auto place = static_cast<std::size_t>(frame / (2 * hold));
    const Stance& from = stances[place == 0 ? 0 : place - 1];
    const Stance& to = stances[place];
    const double t = std::min(1.0, static_cast<double>(frame % (2 * hold)) / static_cast<double>(hold));
    at = {.arms = std::lerp(from.arms, to.arms, t),
          .bow = std::lerp(from.bow, to.bow, t),
          .look = std::lerp(from.look, to.look, t)};
    const MutablePoseView pose = motion.pose(frame);
    pose.rotations[joint("LeftArm")] = turn_about(Vector3f::UnitX(), -at.bow) * turn_about(Vector3f::UnitZ(), -at.arms);
    pose.rotations[joint("RightArm")] = turn_about(Vector3f::UnitX(), -at.bow) * turn_about(Vector3f::UnitZ(), at.arms);
    pose.rotations[joint("Spine")] = turn_about(Vector3f::UnitX(), at.bow);
    pose.rotations[joint("Head")] =
        turn_about(Vector3f::UnitX(), -at.bow) * turn_about(Vector3f::UnitY(), at.look);  // looks up
  }
  return motion;
}

RestPose rest_of(const Motion& motion) {
  SignerModel signer{.rig = map_rig(motion), .body = {}};
  signer.body = signer_body(motion, signer.rig);
  return rest_pose_of(MemorySource(motion), signer);
}

/// The stance of a frame, within a few degrees; none while moving.
int held(std::int64_t frame) {
  return frame % 100 >= 40 ? static_cast<int>(frame / 100) : -1;
}

TEST(RestPoseOf, HandsLowBodyStillTrunkUprightHeadAhead) {
  const std::vector<Stance> stances = {{},                        // begin of a capture, arms held out
                                       {.arms = -40},             // signs
                                       {.arms = 80, .bow = 40},   // bows
                                       {.arms = 80, .look = 45},  // looks away
                                       {.arms = 80},              // rests
                                       {.arms = 10},              // signs
                                       {.arms = -60}};
  const Motion motion = taking(stances);
  const RestPose rest = rest_of(motion);
  EXPECT_EQ(held(rest.frame), 4) << rest.frame;
  for (std::size_t i = 0; i < motion.skeleton().joint_count(); ++i) {
    EXPECT_EQ(rest.pose.rotations[i].coeffs(), std::as_const(motion).pose(rest.frame).rotations[i].coeffs());
  }
  EXPECT_EQ(rest.pose.translations.size(), 1u);
}

TEST(RestPoseOf, TheLowestSlowPoseIfHandsNeverRest) {
  const Motion motion = taking({{.arms = -60}, {.arms = -10}, {.arms = -70}, {.arms = -30}});
  EXPECT_EQ(held(rest_of(motion).frame), 1) << rest_of(motion).frame;
}

TEST(RestPoseOf, StillRatherThanWalkingAndOnBothFeet) {
  Motion motion = taking({{.arms = 80}, {.arms = 80}, {.arms = 80}});
  const auto thigh = static_cast<std::size_t>(motion.skeleton().find("LeftUpLeg").value_or(kNoJoint));
  const auto knee = static_cast<std::size_t>(motion.skeleton().find("LeftLeg").value_or(kNoJoint));
  for (std::int64_t frame = 0; frame < 100; ++frame) {
    motion.pose(frame).translations[0].z() = 0.01f * static_cast<float>(frame);
    motion.pose(100 + frame).rotations[thigh] = turn_about(Vector3f::UnitX(), -60);
    motion.pose(100 + frame).rotations[knee] = turn_about(Vector3f::UnitX(), 60);
  }
  for (std::int64_t frame = 100; frame < 300; ++frame) motion.pose(frame).translations[0].z() = 0.99f;
  EXPECT_EQ(rest_of(motion).frame / 100, 2) << rest_of(motion).frame;
}

TEST(RestPoseOf, TheLastFrameIsExamined) {
  Motion motion = taking({{.arms = 0}, {.arms = 20}});
  Motion end = taking({{.arms = 80}});
  motion.append(std::as_const(end).pose(0));
  EXPECT_EQ(rest_of(motion).frame, 200);
}

TEST(RestPoseOf, TheFirstFrameIfNothingIsKnown) {
  const Motion motion = taking({{}, {.arms = 80}});
  EXPECT_EQ(rest_pose_of(MemorySource(motion), {}).frame, 0);
  const Motion one = motion.slice({7, 8});
  EXPECT_EQ(rest_of(one).frame, 0);
}

TEST(RestPoseOf, HasTracksWithOpenEyes) {
  Motion motion = taking({{}, {.arms = 80}, {.arms = -20}});
  ScalarTrack lid{"eyeBlinkLeft", std::vector<float>(300, 0.1f)};
  ScalarTrack jaw{"jawOpen", std::vector<float>(300)};
  for (std::size_t i = 0; i < 300; ++i) {
    jaw.values[i] = static_cast<float>(i);
    if (i >= 140 && i < 200) lid.values[i] = 1;  // closed at rest
  }
  motion.add_track(lid);
  motion.add_track(jaw);
  const RestPose rest = rest_of(motion);
  ASSERT_EQ(held(rest.frame), 1);
  EXPECT_EQ(rest.tracks, (std::vector<float>{0.1f, static_cast<float>(rest.frame)}));
}

}  // namespace
}  // namespace signweave
