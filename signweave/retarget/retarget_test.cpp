#include "signweave/retarget/retarget.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <string>
#include <utility>

#include "signweave/features/hand_points.h"
#include "signweave/retarget/test_character.h"

namespace signweave {
namespace {

using Eigen::AngleAxisf;
using Eigen::Quaternionf;
using Eigen::Vector3f;

constexpr float kDegree = std::numbers::pi_v<float> / 180;

std::size_t joint(const Skeleton& skeleton, const std::string& name) {
  return static_cast<std::size_t>(skeleton.find(name).value());
}

/// A signing motion: arms forward and bent, hands rotated, fingers curled to varying degrees.
Motion signing(std::shared_ptr<const Skeleton> skeleton, std::int64_t frames = 40) {
  Motion motion(std::move(skeleton), {30, 1}, frames);
  const Skeleton& own = motion.skeleton();
  for (std::int64_t frame = 0; frame < frames; ++frame) {
    const MutablePoseView pose = motion.pose(frame);
    const float wave = std::sin(0.2f * static_cast<float>(frame));
    pose.translations[0] += Vector3f(0.05f * wave, 0, 0);
    pose.rotations[joint(own, "Spine")] = AngleAxisf(0.1f * wave, Vector3f::UnitY());
    for (const float side : {1.0f, -1.0f}) {
      const std::string name = side > 0 ? "Left" : "Right";
      pose.rotations[joint(own, name + "Shoulder")] = AngleAxisf(side * 0.06f * wave, Vector3f::UnitZ());
      // Rotate the arm down and forward, then the forearm up to the front, then the hand about the forearm.
      pose.rotations[joint(own, name + "Arm")] =
          AngleAxisf(side * (-0.9f + 0.2f * wave), Vector3f::UnitZ()) * AngleAxisf(side * -0.4f, Vector3f::UnitY());
      pose.rotations[joint(own, name + "ForeArm")] = AngleAxisf(side * (-1.2f + 0.3f * wave), Vector3f::UnitY());
      pose.rotations[joint(own, name + "Hand")] =
          AngleAxisf(0.8f * wave, Vector3f::UnitX()) * AngleAxisf(side * 0.2f, Vector3f::UnitZ());
      for (const char* finger : {"Index", "Middle", "Ring", "Pinky"}) {
        for (const char* at : {"1", "2", "3"}) {
          if (!own.find(name + "Hand" + finger + at)) continue;
          pose.rotations[joint(own, name + "Hand" + finger + at)] =
              AngleAxisf(-side * (0.5f + 0.4f * wave), Vector3f::UnitZ());
        }
      }
    }
  }
  return motion;
}

/// A pose with hanging arms, bent elbows and fingers: another rest pose for the same body.
Pose relaxed(const Skeleton& skeleton) {
  const Motion motion = signing(std::make_shared<const Skeleton>(skeleton), 9);
  Pose pose(motion.pose(8));
  for (const char* still : {"Spine", "LeftShoulder", "RightShoulder"}) {
    pose.rotations[joint(skeleton, still)] = Quaternionf::Identity();
  }
  pose.translations[0] = skeleton.joint(0).offset;
  return pose;
}

float angle_between(const Quaternionf& a, const Quaternionf& b) {
  return 2 * std::atan2((a.conjugate() * b).vec().norm(), std::abs((a.conjugate() * b).w())) / kDegree;
}

TEST(Retarget, ToItselfChangesNothing) {
  const auto skeleton = with_twist(*whole_person(), {"LeftForeArm", "LeftHand", "RightForeArm", "RightHand"});
  const Character character = character_of(skeleton);
  Motion motion = signing(skeleton);
  for (std::int64_t frame = 0; frame < motion.frame_count(); ++frame) {
    motion.pose(frame).rotations[joint(*skeleton, "LeftHandTwist")] = AngleAxisf(0.3f, Vector3f::UnitX());
    motion.pose(frame).rotations[joint(*skeleton, "LeftForeArmTwist")] = AngleAxisf(0.2f, Vector3f::UnitX());
  }
  // Use the character's body: measured over the motion its shoulders are slightly narrower, because they move.
  const Motion made = retarget(motion, {.rig = character.rig, .body = character.body}, character).motion;
  ASSERT_EQ(made.frame_count(), motion.frame_count());
  for (std::int64_t frame = 0; frame < motion.frame_count(); ++frame) {
    for (std::size_t i = 0; i < skeleton->joint_count(); ++i) {
      EXPECT_LT(angle_between(made.pose(frame).rotations[i], motion.pose(frame).rotations[i]), 0.1f)
          << skeleton->joints()[i].name << ' ' << frame;
    }
    EXPECT_LT((made.pose(frame).translations[0] - motion.pose(frame).translations[0]).norm(), 0.001f);
  }
}

TEST(Retarget, DoesNotDependOnTheRestPose) {
  const auto straight = whole_person();
  const Character character = character_of(rested_in(*straight, relaxed(*straight).view()));
  const Motion motion = signing(straight);
  const Motion made = retarget(motion, plain_model_of(motion), character).motion;
  for (std::int64_t frame = 0; frame < motion.frame_count(); ++frame) {
    const ModelPose a = to_model_space(*straight, motion.pose(frame));
    const ModelPose b = to_model_space(made.skeleton(), made.pose(frame));
    for (std::size_t i = 0; i < a.positions.size(); ++i) {
      EXPECT_LT((a.positions[i] - b.positions[i]).norm(), 0.002f) << straight->joints()[i].name << ' ' << frame;
    }
  }
}

TEST(Retarget, KeepsPalmAndPositionOnABodyOfOtherSize) {
  const auto straight = whole_person();
  const auto small = whole_person(0.8f);
  const Character character = character_of(rested_in(*small, relaxed(*small).view()));
  const Motion motion = signing(straight);
  const SignerModel signer = plain_model_of(motion);
  const Motion made = retarget(motion, signer, character).motion;
  for (std::int64_t frame = 0; frame < motion.frame_count(); ++frame) {
    const ModelPose a = to_model_space(*straight, motion.pose(frame));
    const ModelPose b = to_model_space(made.skeleton(), made.pose(frame));
    for (const Side side : kSides) {
      HandPoints from;
      HandPoints to;
      HandPlaces(signer.rig, side).read(a, from);
      HandPlaces(character.rig, side).read(b, to);
      EXPECT_GT(axes_of(from, side).palm.dot(axes_of(to, side).palm), std::cos(0.5f * kDegree));
      EXPECT_GT(axes_of(from, side).fingers.dot(axes_of(to, side).fingers), std::cos(0.5f * kDegree));
      const Vector3f there = signer_space(*signer.body, signer.rig, a).to_signer(palm_of(from));
      const Vector3f here = signer_space(*character.body, character.rig, b).to_signer(palm_of(to));
      EXPECT_LT((there - here).norm(), 0.02f) << frame;
    }
  }
}

TEST(Retarget, DistributesTheHandsTwistOverTheForearm) {
  const auto skeleton = with_twist(*whole_person(), {"LeftHand", "RightHand"});
  const Character character = character_of(skeleton);
  Motion motion(whole_person(), {30, 1}, 1);
  const std::size_t hand = joint(motion.skeleton(), "LeftHand");
  motion.pose(0).rotations[hand] = AngleAxisf(80 * kDegree, Vector3f::UnitX());
  const Motion made = retarget(motion, plain_model_of(motion), character).motion;
  const ModelPose pose = to_model_space(*skeleton, made.pose(0));
  const auto about = [&](const char* name) {
    return twist_about(pose.rotations[joint(*skeleton, name)], Vector3f::UnitX()) / kDegree;
  };
  EXPECT_NEAR(about("LeftForeArm"), 16, 1);
  EXPECT_NEAR(about("LeftHandTwist"), 60, 1);
  EXPECT_NEAR(about("LeftHand"), 80, 0.1);
}

TEST(Retarget, TouchingHandsAlsoTouchOnOtherArms) {
  const auto straight = whole_person();
  Motion motion(straight, {30, 1}, 1);
  // Both index fingers meet in front of the chest.
  for (const float side : {1.0f, -1.0f}) {
    const std::string name = side > 0 ? "Left" : "Right";
    motion.pose(0).rotations[joint(*straight, name + "Arm")] = AngleAxisf(side * -0.75f, Vector3f::UnitY());
    motion.pose(0).rotations[joint(*straight, name + "ForeArm")] = AngleAxisf(side * -1.87f, Vector3f::UnitY());
  }
  const SignerModel signer = plain_model_of(motion);
  std::vector<Joint> joints(straight->joints().begin(), straight->joints().end());
  for (Joint& one : joints) {
    if (one.name.find("ForeArm") != std::string::npos || one.name.ends_with("Hand")) one.offset *= 0.85f;
  }
  const Character character = character_of(
      std::make_shared<const Skeleton>(joints, std::vector<Tip>(straight->tips().begin(), straight->tips().end())));
  const Motion made = retarget(motion, signer, character).motion;
  const auto gap = [](const RigMap& rig, const Motion& of_motion) {
    const ModelPose pose = to_model_space(of_motion.skeleton(), of_motion.pose(0));
    return (position_of(rig[finger_part(Side::left, Finger::index, FingerPoint::tip)], pose) -
            position_of(rig[finger_part(Side::right, Finger::index, FingerPoint::tip)], pose))
        .norm();
  };
  ASSERT_LT(gap(signer.rig, motion), 0.06f);
  EXPECT_NEAR(gap(character.rig, made), gap(signer.rig, motion), 0.01f);
}

TEST(Retarget, HandsStayOutOfTheChest) {
  const auto skeleton = whole_person();
  Motion motion(skeleton, {30, 1}, 30);
  // The upper arm hangs; the forearm crosses the trunk, too close to it, and rises.
  const auto to = [](const Vector3f& direction) { return Quaternionf::FromTwoVectors(Vector3f::UnitX(), direction); };
  for (std::int64_t frame = 0; frame < 30; ++frame) {
    const MutablePoseView pose = motion.pose(frame);
    const Quaternionf upper = to({0.35f, -0.9f, -0.1f});
    const Quaternionf lower = to({-0.92f, -0.3f + 0.025f * static_cast<float>(frame), 0.3f});
    pose.rotations[joint(*skeleton, "LeftArm")] = upper;
    pose.rotations[joint(*skeleton, "LeftForeArm")] = upper.conjugate() * lower;
  }
  const Character character = character_of(skeleton);
  const Motion made = retarget(motion, plain_model_of(motion), character).motion;
  const RigAxes axes(*skeleton, character.rig);
  BodySurface surface(character, axes);
  float deepest = 0;
  float deepest_there = 0;
  for (std::int64_t frame = 0; frame < 30; ++frame) {
    const auto deep = [&](const Motion& of_motion) {
      const ModelPose pose = to_model_space(*skeleton, of_motion.pose(frame));
      surface.place(pose);
      float most = 0;
      for (const Finger finger : kFingers) {
        const PartPlace& tip = character.rig[finger_part(Side::left, finger, FingerPoint::tip)];
        most = std::max(most, surface.push_out(position_of(tip, pose), 0.008f).norm());
      }
      return most;
    };
    deepest = std::max(deepest, deep(made));
    deepest_there = std::max(deepest_there, deep(motion));
  }
  EXPECT_GT(deepest_there, 0.03f);
  EXPECT_LT(deepest, 0.002f);
}

TEST(Retarget, ClaviclesFollowTheArmsIfTheSourcesDoNotMove) {
  const auto skeleton = whole_person();
  const Character character = character_of(skeleton);
  Motion motion(skeleton, {30, 1}, 2);
  // Frame 0: arms hang. Frame 1: the left one is raised, the right one reaches across.
  for (std::int64_t frame = 0; frame < 2; ++frame) {
    motion.pose(frame).rotations[joint(*skeleton, "LeftArm")] =
        AngleAxisf(frame == 0 ? -1.5f : 1.0f, Vector3f::UnitZ());
    motion.pose(frame).rotations[joint(*skeleton, "RightArm")] =
        frame == 0 ? AngleAxisf(1.5f, Vector3f::UnitZ()) : AngleAxisf(1.9f, Vector3f::UnitY());
  }
  const auto bone = [&](const Motion& of_motion, std::int64_t frame, const std::string& name) {
    const ModelPose pose = to_model_space(*skeleton, of_motion.pose(frame));
    return Vector3f(pose.positions[joint(*skeleton, name + "Arm")] -
                    pose.positions[joint(*skeleton, name + "Shoulder")])
        .normalized();
  };
  Motion made = retarget(motion, plain_model_of(motion), character).motion;
  EXPECT_LT(bone(made, 0, "Left").y(), 0.02f);
  EXPECT_GT(bone(made, 1, "Left").y(), std::sin(15 * kDegree));
  EXPECT_GT(bone(made, 1, "Right").z(), std::sin(10 * kDegree));
  // If the source's clavicles move, their movement is used.
  motion.pose(0).rotations[joint(*skeleton, "LeftShoulder")] = AngleAxisf(0.1f, Vector3f::UnitZ());
  made = retarget(motion, plain_model_of(motion), character).motion;
  EXPECT_NEAR(bone(made, 0, "Left").y(), std::sin(0.1f), 0.005f);
  EXPECT_NEAR(bone(made, 1, "Left").y(), 0, 0.005f);
}

/// The body with two-bone legs and feet; the thigh takes the given fraction of the leg.
std::shared_ptr<const Skeleton> with_legs(const Skeleton& body, float thigh) {
  std::vector<Joint> joints(body.joints().begin(), body.joints().end());
  for (const std::string side : {"Left", "Right"}) {
    const JointIndex hip = body.find(side + "UpLeg").value();
    joints.push_back({side + "Leg", hip, {0, -0.84f * thigh, 0.01f}, false});
    joints.push_back(
        {side + "Foot", static_cast<JointIndex>(joints.size()) - 1, {0, -0.84f * (1 - thigh), -0.01f}, false});
    joints.push_back({side + "ToeBase", static_cast<JointIndex>(joints.size()) - 1, {0, -0.06f, 0.13f}, false});
  }
  return std::make_shared<const Skeleton>(joints, std::vector<Tip>(body.tips().begin(), body.tips().end()));
}
RigMap rig_with_legs(const Skeleton& skeleton) {
  RigMap rig = rig_of_signer(skeleton);
  for (const Side side : kSides) {
    const std::string name = side == Side::left ? "Left" : "Right";
    for (const auto& [part, joint_name] : {std::pair(Part::left_shin, "Leg"), std::pair(Part::left_foot, "Foot"),
                                           std::pair(Part::left_toes, "ToeBase")}) {
      rig[of(side, part)] = {.joint = skeleton.find(name + joint_name).value(),
                             .offset = Vector3f::Zero(),
                             .evidence = Evidence::file,
                             .confidence = 1};
    }
  }
  return rig;
}

TEST(Retarget, PlantedFeetDoNotSlide) {
  const auto skeleton = with_legs(*whole_person(), 0.5f);
  Character character = character_of(with_legs(*whole_person(0.9f), 0.6f));
  character.rig = rig_with_legs(*character.skeleton);
  // The hips sway and sink over planted feet.
  Motion motion(skeleton, {30, 1}, 30);
  for (std::int64_t frame = 0; frame < 30; ++frame) {
    const MutablePoseView pose = motion.pose(frame);
    const float bend = 0.3f + 0.25f * std::sin(0.3f * static_cast<float>(frame));
    for (const std::string side : {"Left", "Right"}) {
      pose.rotations[joint(*skeleton, side + "UpLeg")] = AngleAxisf(-bend, Vector3f::UnitX());
      pose.rotations[joint(*skeleton, side + "Leg")] = AngleAxisf(2 * bend, Vector3f::UnitX());
      pose.rotations[joint(*skeleton, side + "Foot")] = AngleAxisf(-bend, Vector3f::UnitX());
    }
    const ModelPose placed = to_model_space(*skeleton, motion.pose(frame));
    const Vector3f off = Vector3f(0.09f, 0.07f, 0) - placed.positions[joint(*skeleton, "LeftFoot")];
    pose.translations[0] += off;
  }
  SignerModel signer{.rig = rig_with_legs(*skeleton), .body = {}};
  signer.body = signer_body(motion, signer.rig);
  const Motion made = retarget(motion, signer, character).motion;
  std::optional<Vector3f> first;
  for (std::int64_t frame = 0; frame < 30; ++frame) {
    const ModelPose pose = to_model_space(*character.skeleton, made.pose(frame));
    const Vector3f foot = position_of(character.rig[Part::left_foot], pose);
    if (!first) first = foot;
    EXPECT_LT((foot - *first).norm(), 0.003f) << frame;
  }
}

TEST(Retarget, FingersStayWithinTheirLimits) {
  const auto skeleton = whole_person();
  Character character = character_of(skeleton);
  for (CharacterHand& hand : character.hands) {
    for (CharacterFinger& finger : hand.fingers) finger.flexion[0] = {-0.1f, 0.6f};
  }
  const Motion motion = signing(skeleton);
  const Motion made = retarget(motion, plain_model_of(motion), character).motion;
  const CharacterFinger& index = character.hands[0].fingers[1];
  float most = 0;
  for (std::int64_t frame = 0; frame < made.frame_count(); ++frame) {
    const Quaternionf turn = made.pose(frame).rotations[static_cast<std::size_t>(index.joints[0])];
    most = std::max(most, twist_about(turn, index.flexion_axis));
  }
  EXPECT_NEAR(most, 0.6f, 0.02f);
}

TEST(Retarget, MissingPartsStayAtRestAndAreReported) {
  const Character character = character_of(whole_person());
  const Motion motion = signing(whole_person(1, false));
  const Retargeted made = retarget(motion, plain_model_of(motion), character);
  std::string text;
  for (const Notice& notice : made.notices) text += notice.text + '\n';
  EXPECT_THAT(text, testing::HasSubstr("no left index finger: it stays at rest"));
  const std::size_t index = joint(*character.skeleton, "LeftHandIndex2");
  EXPECT_LT(angle_between(made.motion.pose(3).rotations[index], Quaternionf::Identity()), 0.01f);
}

TEST(Retarget, NonFiniteValuesGiveTheRestPose) {
  const Character character = character_of(whole_person());
  Motion motion = signing(whole_person(), 3);
  const SignerModel signer = plain_model_of(motion);
  motion.pose(1).rotations[4].w() = std::numeric_limits<float>::quiet_NaN();
  const Motion made = retarget(motion, signer, character).motion;
  for (const Quaternionf& turn : made.rotations()) {
    ASSERT_TRUE(turn.coeffs().allFinite());
    EXPECT_NEAR(turn.norm(), 1, 1e-4f);
  }
}

TEST(Retarget, TracksArePassedThrough) {
  Motion motion = signing(whole_person(), 2);
  motion.add_track({"jawOpen", {0.25f, 0.5f}});
  const Motion made = retarget(motion, plain_model_of(motion), character_of(whole_person())).motion;
  EXPECT_EQ(made.tracks(), motion.tracks());
}

}  // namespace
}  // namespace signweave
