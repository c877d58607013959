// A mirrored signer: twice gives the original, hands are exchanged, the signer stays in place.
#include "signweave/retarget/mirrored_source.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <string>
#include <vector>

#include "signweave/core/error.h"
#include "signweave/core/test_allocations.h"
#include "signweave/features/hand_motion.h"
#include "signweave/features/phase_features.h"
#include "signweave/retarget/retarget.h"
#include "signweave/retarget/test_character.h"
#include "signweave/retarget/test_other_rig.h"
#include "signweave/rig/test_rigs.h"

namespace signweave {
namespace {

using Eigen::Quaternionf;
using Eigen::Vector3f;
using testing::HasSubstr;

const std::vector<std::vector<std::string>> kThreeJointFingers = {{"@HandThumb1", "@HandThumb2", "@HandThumb3"},
                                                                  {"@HandIndex1", "@HandIndex2", "@HandIndex3"},
                                                                  {"@HandMiddle1", "@HandMiddle2", "@HandMiddle3"},
                                                                  {"@HandRing1", "@HandRing2", "@HandRing3"},
                                                                  {"@HandPinky1", "@HandPinky2", "@HandPinky3"}};

/// The same motion in joints whose rest pose is `rest`: the spaces of left and right then differ.
Motion rested(const Motion& motion, PoseView rest) {
  const Skeleton& skeleton = motion.skeleton();
  const ModelPose rests = to_model_space(skeleton, rest);
  Motion result(rested_in(skeleton, rest), motion.rate(), motion.frame_count());
  ModelPose pose;
  for (std::int64_t frame = 0; frame < motion.frame_count(); ++frame) {
    to_model_space(skeleton, motion.pose(frame), pose);
    for (std::size_t i = 0; i < skeleton.joint_count(); ++i) {
      const JointIndex parent = skeleton.joints()[i].parent;
      const auto turn = [&](std::size_t joint) { return pose.rotations[joint] * rests.rotations[joint].conjugate(); };
      result.pose(frame).rotations[i] =
          parent == kNoJoint ? turn(i) : turn(static_cast<std::size_t>(parent)).conjugate() * turn(i);
    }
    result.pose(frame).translations[0] = motion.pose(frame).translations[0];
  }
  return result;
}

/// A rest pose with the right arm down and rotated about itself, and the left one stretched out.
Pose uneven_rest(const Skeleton& skeleton) {
  Pose rest(skeleton);
  const auto turn = [&](const char* name, float angle, const Vector3f& axis) {
    rest.rotations[static_cast<std::size_t>(*skeleton.find(name))] = Eigen::AngleAxisf(angle, axis);
  };
  turn("RightArm", 1.2f, Vector3f::UnitZ());
  turn("RightForeArm", 0.7f, Vector3f(1, 0.5f, 0).normalized());
  turn("LeftHand", -0.6f, Vector3f::UnitX());
  return rest;
}

/// A rest pose that lies on the side from the spine up, with a foot turned outwards: each has a space of its own.
Pose lying_rest(const Skeleton& skeleton) {
  Pose rest(skeleton);
  const auto turn = [&](const char* name, float angle, const Vector3f& axis) {
    rest.rotations[static_cast<std::size_t>(*skeleton.find(name))] = Eigen::AngleAxisf(angle, axis);
  };
  turn("Spine", -1.5707963f, Vector3f::UnitZ());
  turn("LeftFoot", 1.5707963f, Vector3f::UnitZ());
  turn("RightFoot", -0.9f, Vector3f::UnitX());
  return rest;
}

struct MovingRig {
  std::string name;
  Motion motion;
};

/// Moving people of several rigs: symmetric ones, away from the origin.
std::vector<MovingRig> mirrored_rigs() {
  std::vector<MovingRig> all;
  const auto add = [&](std::string name, std::shared_ptr<const Skeleton> skeleton, float turn) {
    all.push_back({std::move(name), placed(moving(std::move(skeleton), 60), turn, {1.5f, 0, -2})});
  };
  add("signer", whole_person(), 0.7f);
  add("no fingers", whole_person(1, false), 0);
  add("MotionBuilder", rig_body({.fingers = kThreeJointFingers}).shared_skeleton(), 2.5f);
  add("Unreal",
      rig_body({.left = "l",
                .right = "r",
                .hips = "pelvis",
                .spine = "spine_01",
                .chest = "spine_02",
                .neck = "neck_01",
                .head = "head",
                .collar = "clavicle_@",
                .arm = "upperarm_@",
                .elbow = "lowerarm_@",
                .hand = "hand_@",
                .thigh = "thigh_@",
                .knee = "calf_@",
                .foot = "foot_@",
                .toes = "ball_@"})
          .shared_skeleton(),
      -1);
  add("twist joints", with_twist(*whole_person(), {"LeftHand", "RightHand", "Neck"}), 0.3f);
  Motion even = moving(rig_body({.fingers = kThreeJointFingers}).shared_skeleton(), 60);
  all.push_back({"uneven rest", placed(rested(even, uneven_rest(even.skeleton()).view()), 0.4f, {0, 0, 1})});
  all.push_back({"lying rest", rested(even, lying_rest(even.skeleton()).view())});
  return all;
}

RecordedBody body_seen(const Motion& motion) {
  return recorded_body("captured", MemorySource(motion));
}

float turn_angle(const Quaternionf& a, const Quaternionf& b) {
  const Quaternionf turn = a.conjugate() * b;
  return 2 * std::atan2(turn.vec().norm(), std::abs(turn.w()));
}

void expect_same_movement(const Motion& a, const Motion& b, const std::string& what) {
  float angle = 0;
  float distance = 0;
  for (std::int64_t frame = 0; frame < a.frame_count(); ++frame) {
    for (std::size_t i = 0; i < a.skeleton().joint_count(); ++i) {
      angle = std::max(angle, turn_angle(a.pose(frame).rotations[i], b.pose(frame).rotations[i]));
    }
    for (std::size_t i = 0; i < a.skeleton().translation_count(); ++i) {
      distance = std::max(distance, (a.pose(frame).translations[i] - b.pose(frame).translations[i]).norm());
    }
  }
  EXPECT_LT(angle, 1e-4f) << what;
  EXPECT_LT(distance, 1e-5f) << what;
}

TEST(Mirrored, TwiceGivesTheOriginal) {
  for (const MovingRig& rig : mirrored_rigs()) {
    const Motion once = mirrored(rig.motion, mirroring_of(body_seen(rig.motion)));
    const Motion twice = mirrored(once, mirroring_of(body_seen(once)));
    expect_same_movement(twice, rig.motion, rig.name);
  }
}

TEST(Mirrored, PalmsExchangeTheirPlaces) {
  for (const MovingRig& rig : mirrored_rigs()) {
    const RecordedBody body = body_seen(rig.motion);
    const Motion shown = mirrored(rig.motion, mirroring_of(body));
    const HandMotion was = measure_hands(rig.motion, body.signer, {0, rig.motion.frame_count()});
    const HandMotion is = measure_hands(shown, body.signer, {0, shown.frame_count()});
    for (const Side side : kSides) {
      const auto& from = was.hands[side == Side::left ? 1 : 0].frames;
      const auto& to = is.hands[static_cast<std::size_t>(side)].frames;
      ASSERT_EQ(to.size(), from.size());
      float distance = 0;
      float direction = 0;
      for (std::size_t i = 0; i < to.size(); ++i) {
        const auto in_mirror = [](const Vector3f& v) { return Vector3f(-v.x(), v.y(), v.z()); };
        distance = std::max(distance, (to[i].position - in_mirror(from[i].position)).norm());
        direction = std::max(direction, (to[i].palm - in_mirror(from[i].palm)).norm());
      }
      EXPECT_LT(distance, 1e-4f) << rig.name;
      EXPECT_LT(direction, 1e-3f) << rig.name;
    }
  }
}

TEST(Mirrored, EveryJointIsWhereTheMirrorShowsItsCounterpart) {
  for (const MovingRig& rig : mirrored_rigs()) {
    const Mirroring mirroring = mirroring_of(body_seen(rig.motion));
    const Motion shown = mirrored(rig.motion, mirroring);
    for (std::int64_t frame = 0; frame < shown.frame_count(); frame += 7) {
      const ModelPose was = to_model_space(rig.motion.skeleton(), rig.motion.pose(frame));
      const ModelPose is = to_model_space(shown.skeleton(), shown.pose(frame));
      for (std::size_t i = 0; i < is.positions.size(); ++i) {
        const auto from = static_cast<std::size_t>(mirroring.joints[i].joint);
        const Vector3f wanted = mirroring.place - mirroring.half_turn * (was.positions[from] - mirroring.place);
        const std::string& name = shown.skeleton().joints()[i].name;
        const float near = name.find("Toe") != std::string::npos ? 0.05f : 1e-3f;
        ASSERT_LT((is.positions[i] - wanted).norm(), near) << rig.name << ' ' << name;
      }
    }
  }
}

TEST(Mirrored, AJointInTheMiddleWithASpaceOfItsOwnFollowsTheSignersLeft) {
  const Motion even = moving(rig_body({.fingers = kThreeJointFingers}).shared_skeleton(), 60);
  const std::size_t neck = static_cast<std::size_t>(*even.skeleton().find("Neck"));
  Pose rest(even.skeleton());
  rest.rotations[neck] = Eigen::AngleAxisf(1.5707963f, Vector3f::UnitY());
  const Mirroring mirroring = mirroring_of(body_seen(rested(even, rest.view())));
  const Vector3f left = mirroring.joints[neck].turn.vec();
  EXPECT_GT(std::abs(left.dot(rest.rotations[neck] * Vector3f::UnitX())), 0.96f);
}

TEST(Mirrored, IsTheMirrorImageOfASymmetricSkeleton) {
  const Motion motion = moving(whole_person(), 60);
  const Motion expected = in_mirror(motion);
  Mirroring mirroring = mirroring_of(body_seen(motion));
  mirroring.half_turn = Quaternionf(0, 1, 0, 0);
  mirroring.place = Vector3f::Zero();
  expect_same_movement(mirrored(motion, mirroring), expected, "about x = 0");
}

TEST(Mirrored, TheSignerStaysInPlaceAndKeepsFacingTheAddressee) {
  for (const MovingRig& rig : mirrored_rigs()) {
    const RecordedBody body = body_seen(rig.motion);
    const Motion shown = mirrored(rig.motion, mirroring_of(body));
    Vector3f moved = Vector3f::Zero();
    Vector3f turned = Vector3f::Zero();
    for (std::int64_t frame = 0; frame < shown.frame_count(); ++frame) {
      const auto space = [&](const Motion& motion) {
        return signer_space(*body.signer.body, body.signer.rig, to_model_space(motion.skeleton(), motion.pose(frame)));
      };
      const auto pelvis = [&](const Motion& motion) { return motion.pose(frame).translations[0]; };
      moved += pelvis(shown) - pelvis(rig.motion);
      turned +=
          space(shown).model_from_signer * Vector3f::UnitZ() - space(rig.motion).model_from_signer * Vector3f::UnitZ();
    }
    EXPECT_LT(moved.norm() / 60, 1e-4f) << rig.name;
    EXPECT_LT(turned.norm() / 60, 1e-3f) << rig.name;
  }
}

TEST(Mirrored, UnequalBonesStayAndAreReported) {
  const auto skeleton = whole_person();
  std::vector<Joint> joints(skeleton->joints().begin(), skeleton->joints().end());
  joints[static_cast<std::size_t>(*skeleton->find("LeftForeArm"))].offset.x() += 0.02f;
  const auto uneven =
      std::make_shared<const Skeleton>(joints, std::vector<Tip>(skeleton->tips().begin(), skeleton->tips().end()));
  const Motion motion = moving(uneven, 60);
  const Mirroring mirroring = mirroring_of(body_seen(motion));
  ASSERT_EQ(mirroring.notices.size(), 1U);
  EXPECT_THAT(mirroring.notices[0].text, HasSubstr("left and right differ: wrists within 20 mm"));
  const Motion once = mirrored(motion, mirroring);
  EXPECT_EQ(once.shared_skeleton(), motion.shared_skeleton());
  expect_same_movement(mirrored(once, mirroring), motion, "unequal bones");
}

TEST(Mirrored, TranslatedBonesOfUnequalLengthStayOnTheirSides) {
  Motion motion = moving(whole_person(), 30);  // its arms are translated
  const std::size_t left = *motion.skeleton().translation_of(*motion.skeleton().find("LeftArm"));
  const std::size_t right = *motion.skeleton().translation_of(*motion.skeleton().find("RightArm"));
  std::vector<Joint> joints(motion.skeleton().joints().begin(), motion.skeleton().joints().end());
  joints[static_cast<std::size_t>(*motion.skeleton().find("LeftArm"))].offset.x() = 0.25f;
  Motion uneven(std::make_shared<const Skeleton>(
                    joints, std::vector<Tip>(motion.skeleton().tips().begin(), motion.skeleton().tips().end())),
                motion.rate());
  for (std::int64_t frame = 0; frame < 30; ++frame) {
    motion.pose(frame).translations[left].x() = 0.25f;
    motion.pose(frame).translations[right].y() = frame % 2 == 0 ? 0.01f : -0.01f;
    uneven.append(motion.pose(frame));
  }
  const Mirroring mirroring = mirroring_of(body_seen(uneven));
  const Motion once = mirrored(uneven, mirroring);
  EXPECT_NEAR(once.pose(4).translations[left].x(), 0.25f, 1e-5f);
  EXPECT_NEAR(once.pose(4).translations[left].y(), 0.01f, 1e-5f);
  EXPECT_NEAR(once.pose(4).translations[right].x(), -0.15f, 1e-5f);
  expect_same_movement(mirrored(once, mirroring), uneven, "translated");
}

TEST(Mirrored, OffsetsThatNoPoseHasDoNotMatter) {
  const Motion even = moving(whole_person(), 30);
  std::vector<Joint> joints(even.skeleton().joints().begin(), even.skeleton().joints().end());
  for (Joint& joint : joints) {
    joint.translated = true;
    if (joint.parent != kNoJoint) joint.offset = {0, 0.2f, 0.01f * static_cast<float>(joint.parent)};
  }
  Motion motion(std::make_shared<const Skeleton>(joints, std::vector<Tip>()), even.rate(), 30);
  for (std::int64_t frame = 0; frame < 30; ++frame) {
    std::ranges::copy(even.pose(frame).rotations, motion.pose(frame).rotations.begin());
    for (std::size_t i = 0; i < joints.size(); ++i)
      motion.pose(frame).translations[i] = even.skeleton().joints()[i].offset;
  }
  const Motion once = mirrored(motion, mirroring_of(body_seen(motion)));
  const Motion expected = mirrored(even, mirroring_of(body_seen(even)));
  for (std::size_t i = 0; i < joints.size(); ++i) {
    EXPECT_LT(turn_angle(once.pose(12).rotations[i], expected.pose(12).rotations[i]), 1e-3f) << joints[i].name;
  }
  expect_same_movement(mirrored(once, mirroring_of(body_seen(once))), motion, "other offsets");
}

TEST(Mirrored, AJointThatOnlyOneSideHasKeepsItsRotation) {
  const auto skeleton = whole_person();
  std::vector<Joint> joints(skeleton->joints().begin(), skeleton->joints().end());
  joints.push_back({"Pen", *skeleton->find("RightHand"), {-0.05f, -0.02f, 0.02f}, false});
  const Motion motion = moving(std::make_shared<const Skeleton>(joints, std::vector<Tip>()), 20);
  const Motion once = mirrored(motion, mirroring_of(body_seen(motion)));
  EXPECT_EQ(once.pose(7).rotations.back().coeffs(), motion.pose(7).rotations.back().coeffs());
}

TEST(Mirrored, JointsWithoutAPartFollowTheirPartnersByNameOrByOffset) {
  const auto skeleton = whole_person();
  std::vector<Joint> joints(skeleton->joints().begin(), skeleton->joints().end());
  const JointIndex head = *skeleton->find("Head");
  joints.push_back({"EarLeft", head, {0.08f, 0.05f, 0}, false});
  joints.push_back({"EarRight", head, {-0.06f, 0.05f, 0}, false});
  joints.push_back({"Braid7", head, {0.05f, 0.1f, -0.08f}, false});
  joints.push_back({"Braid8", head, {-0.05f, 0.1f, -0.08f}, false});
  joints.push_back({"Nose", head, {0, 0.06f, 0.1f}, false});
  const Motion motion = moving(std::make_shared<const Skeleton>(joints, std::vector<Tip>()), 20);
  const Mirroring mirroring = mirroring_of(body_seen(motion));
  const auto last = static_cast<JointIndex>(joints.size()) - 1;
  const auto partner = [&](JointIndex joint) { return mirroring.joints[static_cast<std::size_t>(joint)].joint; };
  EXPECT_EQ(partner(last - 4), last - 3);
  EXPECT_EQ(partner(last - 3), last - 4);
  EXPECT_EQ(partner(last - 2), last - 1);
  EXPECT_EQ(partner(last - 1), last - 2);
  EXPECT_EQ(partner(last), last);
}

TEST(Mirrored, ARootAboveTheBodyStaysWhereItIs) {
  Motion below = below_a_still_root(placed(moving(whole_person(), 40), 0.9f, {2, 0, 1}));
  const Quaternionf upright(Eigen::AngleAxisf(-1.5707963f, Vector3f::UnitX()));  // as in files with z up
  for (std::int64_t frame = 0; frame < 40; ++frame) {
    const MutablePoseView pose = below.pose(frame);
    pose.rotations[0] = upright;
    pose.rotations[1] = upright.conjugate() * pose.rotations[1];
    pose.translations[1] = upright.conjugate() * pose.translations[1];
  }
  const Motion once = mirrored(below, mirroring_of(body_seen(below)));
  for (std::int64_t frame = 0; frame < 40; ++frame) {
    EXPECT_EQ(once.pose(frame).rotations[0].coeffs(), below.pose(frame).rotations[0].coeffs());
    EXPECT_EQ(once.pose(frame).translations[0], below.pose(frame).translations[0]);
  }
  expect_same_movement(mirrored(once, mirroring_of(body_seen(once))), below, "below a root");
}

TEST(Mirrored, OnACharacterItIsTheMirrorImageToo) {
  const Motion motion = moving(whole_person(), 40);
  const Character character = character_of(whole_person(0.9f));
  const RecordedBody body = body_seen(motion);
  const Motion shown = retarget(motion, body.signer, character).motion;
  const Motion exchanged = retarget(mirrored(motion, mirroring_of(body)), body.signer, character).motion;
  const SignerModel model = model_of(shown);
  const HandMotion was = measure_hands(shown, model, {0, 40});
  const HandMotion is = measure_hands(exchanged, model, {0, 40});
  float distance = 0;
  for (std::size_t i = 0; i < 40; ++i) {
    Vector3f wanted = was.hands[1].frames[i].position;
    wanted.x() *= -1;
    distance = std::max(distance, (is.hands[0].frames[i].position - wanted).norm());
  }
  EXPECT_LT(distance, 1e-3f);
}

TEST(Mirrored, ASignerWithoutShouldersIsRefused) {
  const Motion motion(
      std::make_shared<const Skeleton>(std::vector<Joint>{{"a", kNoJoint, {0, 1, 0}, true}}, std::vector<Tip>{}),
      {30, 1}, 3);
  try {
    mirroring_of(body_seen(motion));
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::bad_input);
    EXPECT_THAT(error.what(), HasSubstr("captured: the signer cannot be mirrored: no left shoulder"));
  }
}

/// A source of a moving person with a face.
std::shared_ptr<const MemorySource> moving_face() {
  Motion motion = moving(whole_person(), 100);
  for (std::int64_t frame = 0; frame < 100; ++frame) {  // turns around more than once
    motion.pose(frame).rotations[0] = Eigen::AngleAxisf(0.15f * static_cast<float>(frame), Vector3f::UnitY());
  }
  const auto track = [&](const char* name, float scale) {
    std::vector<float> values(100);
    for (std::size_t i = 0; i < values.size(); ++i) values[i] = scale * static_cast<float>(i);
    motion.add_track({name, std::move(values)});
  };
  track("browDownLeft", 1);
  track("headYaw", 2);
  track("browDownRight", 3);
  return std::make_shared<MemorySource>(std::move(motion));
}

MirroredSource mirror_of(const std::shared_ptr<const MemorySource>& source) {
  return {source, std::make_shared<const Mirroring>(mirroring_of(recorded_body("captured", *source)))};
}

TEST(MirroredSource, ReadsTheMirroredMotionWithItsTracks) {
  const auto source = moving_face();
  const MirroredSource mirror = mirror_of(source);
  const Motion expected = mirrored(source->motion(), mirror.mirroring());
  Motion read(mirror.skeleton(), mirror.rate(), 100);
  mirror.read({0, 100}, read.poses({0, 100}));
  std::vector<std::vector<float>> values(3, std::vector<float>(100));
  const std::vector<std::span<float>> spans = {values[0], {}, values[2]};
  mirror.read_tracks({0, 100}, spans);
  EXPECT_EQ(values[0][10], 30);
  EXPECT_EQ(values[2][10], 10);
  EXPECT_EQ(values[1][10], 0);
  mirror.read_tracks({0, 100}, std::vector<std::span<float>>{{}, values[1], {}});
  EXPECT_EQ(values[1][10], -20);
  for (std::size_t i = 0; i < 3; ++i) read.add_track({mirror.tracks()[i], values[i]});
  EXPECT_TRUE(same_bits(read, expected));
}

TEST(MirroredSource, AnyRangeHasTheSameBitsAndQuaternionsStayInTheirHemisphere) {
  const MirroredSource mirror = mirror_of(moving_face());
  Motion whole(mirror.skeleton(), mirror.rate(), 100);
  mirror.read({0, 100}, whole.poses({0, 100}));
  EXPECT_TRUE(keeps_hemisphere(whole));
  for (const FrameRange range : {FrameRange{99, 100}, FrameRange{3, 50}, FrameRange{31, 34}, FrameRange{0, 1}}) {
    Motion part(mirror.skeleton(), mirror.rate(), range.size());
    mirror.read(range, part.poses({0, range.size()}));
    Motion expected = whole.slice(range);
    EXPECT_TRUE(same_bits(part, expected)) << range.begin;
  }
}

TEST(MirroredSource, ReadingAllocatesNothing) {
  const MirroredSource mirror = mirror_of(moving_face());
  Motion out(mirror.skeleton(), mirror.rate(), 70);
  std::vector<float> values(70);
  const std::vector<std::span<float>> spans = {values, {}, {}};
  EXPECT_EQ(allocations_in([&] {
              mirror.read({20, 90}, out.poses({0, 70}));
              mirror.read_tracks({20, 90}, spans);
            }),
            0U);
}

}  // namespace
}  // namespace signweave
