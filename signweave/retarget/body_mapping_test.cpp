#include "signweave/retarget/body_mapping.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <limits>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "signweave/core/error.h"
#include "signweave/features/hand_points.h"
#include "signweave/retarget/body_match.h"
#include "signweave/retarget/retargeted_source.h"
#include "signweave/retarget/test_other_rig.h"

namespace signweave {
namespace {

using Eigen::Quaternionf;
using Eigen::Vector3f;
using testing::ElementsAre;
using testing::HasSubstr;

RecordedBody body_in(const std::string& name, const Motion& motion, const RigNames& rig = {}) {
  return recorded_body(name, MemorySource(motion), rig);
}

Motion first_signer(unsigned seed = 1) {
  return moving(whole_person(), 60, seed);
}
Motion other_signer(unsigned seed = 1) {
  return on_other_rig(moving(whole_person(), 60, seed));
}

std::shared_ptr<const RetargetedSource> shown(const Motion& motion, const Motion& onto) {
  return std::make_shared<RetargetedSource>(
      std::make_shared<MemorySource>(motion),
      std::make_shared<const BodyMapping>(map_body(body_in("b", motion), body_in("a", onto))));
}

Motion all_of(const MotionSource& source) {
  Motion motion(source.skeleton(), source.rate(), source.frame_count());
  source.read({0, source.frame_count()}, motion.poses({0, source.frame_count()}));
  return motion;
}

std::string refusal(const Motion& motion, const Motion& onto, const RigNames& rig = {}) {
  try {
    map_body(body_in("b", motion, rig), body_in("a", onto));
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::bad_input);
    return error.what();
  }
  return "none";
}

std::vector<std::string> approximations(const Motion& motion, const Motion& onto) {
  const BodyMatch match = match_bodies(body_in("b", motion), body_in("a", onto));
  EXPECT_THAT(match.unsafe, ElementsAre());
  return match.approximate;
}

std::vector<std::string> first_joints(const std::string& hand, std::initializer_list<const char*> fingers) {
  std::vector<std::string> names;
  for (const char* finger : fingers) names.push_back(hand + finger + "1");
  return names;
}

RC_GTEST_PROP(BodyMapping, OnItsOwnBodyEveryJointKeepsItsPosition, ()) {
  const Motion motion = first_signer(*rc::gen::inRange(1u, 1000u));
  const Motion same = all_of(*shown(motion, motion));
  for (std::int64_t frame = 0; frame < motion.frame_count(); ++frame) {
    const ModelPose a = to_model_space(motion.skeleton(), motion.pose(frame));
    const ModelPose b = to_model_space(same.skeleton(), same.pose(frame));
    for (std::size_t joint = 0; joint < a.positions.size(); ++joint) {
      // No arm is completely straight: the elbow of one that was is off by 15.6 mm in the worst of all seeds; of all
      // others by 0.11 mm.
      const bool elbow = motion.skeleton().joints()[joint].name.ends_with("ForeArm");
      RC_ASSERT((a.positions[joint] - b.positions[joint]).norm() < (elbow ? 0.018f : 0.0005f));
    }
  }
}

RC_GTEST_PROP(BodyMapping, HandDirectionsAndFingerFlexionAreKept, ()) {
  const unsigned seed = *rc::gen::inRange(1u, 1000u);
  const bool back = *rc::gen::arbitrary<bool>();
  const Motion motion = back ? other_signer(seed) : first_signer(seed);
  const Motion onto = back ? first_signer(seed + 1) : other_signer(seed + 1);
  const Motion made = all_of(*shown(motion, onto));
  const RigMap from = map_rig(motion);
  const RigMap to = map_rig(onto);
  for (std::int64_t frame = 0; frame < motion.frame_count(); ++frame) {
    const ModelPose a = to_model_space(motion.skeleton(), motion.pose(frame));
    const ModelPose b = to_model_space(made.skeleton(), made.pose(frame));
    for (const Side side : kSides) {
      HandPoints there;
      HandPoints here;
      HandPlaces(from, side).read(a, there);
      HandPlaces(to, side).read(b, here);
      RC_ASSERT(axes_of(there, side).palm.dot(axes_of(here, side).palm) > 0.99999f);
      RC_ASSERT(axes_of(there, side).fingers.dot(axes_of(here, side).fingers) > 0.99999f);
      const Handshape shape = handshape_of(there, axes_of(there, side));
      RC_ASSERT(distance(shape, handshape_of(here, axes_of(here, side))) < 0.02f);
    }
  }
}

RC_GTEST_PROP(BodyMapping, AFrameIsTheSameWhicheverFramesAreReadWithIt, ()) {
  static const auto source = shown(other_signer(), first_signer(2));
  static const Motion whole = all_of(*source);
  const std::int64_t begin = *rc::gen::inRange<std::int64_t>(0, whole.frame_count());
  const std::int64_t end = *rc::gen::inRange<std::int64_t>(begin, whole.frame_count()) + 1;
  Motion part(source->skeleton(), source->rate(), end - begin);
  source->read({begin, end}, part.poses({0, end - begin}));
  for (std::int64_t frame = begin; frame < end; ++frame) {
    const PoseView a = whole.pose(frame);
    const PoseView b = std::as_const(part).pose(frame - begin);
    for (std::size_t joint = 0; joint < a.rotations.size(); ++joint) {
      const Eigen::Vector4f q = a.rotations[joint].coeffs();
      RC_ASSERT(q == b.rotations[joint].coeffs() || q == -b.rotations[joint].coeffs());
    }
    for (std::size_t i = 0; i < a.translations.size(); ++i) RC_ASSERT(a.translations[i] == b.translations[i]);
  }
  RC_ASSERT(keeps_hemisphere(part));
}

TEST(BodyMapping, BonesKeepTheSignersUsualLengths) {
  Motion onto = first_signer(2);  // its shoulders may be translated
  const std::size_t shoulder = *onto.skeleton().translation_of(*onto.skeleton().find("LeftArm"));
  for (std::int64_t frame = 0; frame < onto.frame_count(); ++frame) {
    onto.pose(frame).translations[shoulder] = {0.14f, 0.01f, frame < 9 ? 0.5f : 0.02f};
  }
  const Motion made = all_of(*shown(other_signer(), onto));
  for (std::int64_t frame = 0; frame < made.frame_count(); ++frame) {
    EXPECT_EQ(std::as_const(made).pose(frame).translations[shoulder], Vector3f(0.14f, 0.01f, 0.02f));
  }
}

TEST(BodyMapping, TheSignerStandsOnTheTargetsFloor) {
  Motion above = other_signer();
  for (std::int64_t frame = 0; frame < above.frame_count(); ++frame) above.pose(frame).translations[0].y() += 3;
  const Motion onto = first_signer(2);
  const Motion made = all_of(*shown(above, onto));
  EXPECT_NEAR(usual_pose(made).translations[0].y(), usual_pose(onto).translations[0].y(), 0.02f);
}

TEST(BodyMapping, AMotionlessRootStaysStillAndItsDescendantsMove) {
  const Motion onto = below_a_still_root(placed(first_signer(2), 1.0f, {3, 0, 1}));
  const Motion made = all_of(*shown(other_signer(), onto));
  ASSERT_EQ(made.skeleton(), onto.skeleton());
  const SignerModel signer = body_in("a", onto).signer;
  const SignerSpace there = signer_space(*signer.body, signer.rig, to_model_space(onto.skeleton(), onto.pose(0)));
  for (std::int64_t frame = 0; frame < made.frame_count(); ++frame) {
    const PoseView pose = std::as_const(made).pose(frame);
    ASSERT_LT(pose.rotations[0].angularDistance(Quaternionf::Identity()), 1e-3f);
    ASSERT_LT(pose.translations[0].norm(), 1e-6f);
    const SignerSpace here = signer_space(*signer.body, signer.rig, to_model_space(made.skeleton(), pose));
    ASSERT_LT((here.origin - there.origin).norm(), 0.1f);
    ASSERT_GT((here.model_from_signer * Vector3f::UnitZ()).dot(there.model_from_signer * Vector3f::UnitZ()), 0.9f);
  }
}

TEST(BodyMapping, NonFiniteValuesGiveTheUsualPose) {
  Motion broken = other_signer();
  broken.pose(10).rotations[3].x() = std::numeric_limits<float>::quiet_NaN();
  const Motion made = all_of(*shown(broken, first_signer(2)));
  for (const Quaternionf& turn : made.rotations()) ASSERT_NEAR(turn.norm(), 1, 1e-4f);
  for (const Vector3f& place : made.translations()) ASSERT_TRUE(place.allFinite());
  const Pose usual = usual_pose(first_signer(2));
  EXPECT_LT(made.pose(10).rotations[5].angularDistance(usual.rotations[5]), 0.1f);
}

TEST(BodyMapping, TheNoticeCountsDrivenJoints) {
  const BodyMapping mapping = map_body(body_in("b", other_signer()), body_in("a", first_signer(2)));
  ASSERT_EQ(mapping.notices.size(), 1u);
  EXPECT_EQ(mapping.notices[0].where, "b");
  EXPECT_THAT(mapping.notices[0].text,
              HasSubstr("retargeted to the skeleton of 'a', which has other joints: 45 of 47 driven, at rest: "));
}

TEST(BodyMatch, AnArmMissingFromOneBodyIsRefusedByName) {
  const Motion one_armed = without_joints(first_signer(), {"LeftForeArm"});
  EXPECT_EQ(refusal(one_armed, other_signer()),
            "recording 'b' cannot be retargeted to the skeleton of 'a': 'b' has no left_forearm, left_hand; import "
            "them with a mapping file that names "
            "such joints, or sign with recordings of one skeleton");
  EXPECT_THAT(refusal(other_signer(), one_armed), HasSubstr("': 'a' has no left_forearm, left_hand; import"));
  EXPECT_THAT(approximations(one_armed, without_joints(other_signer(), {"mixamorig:LeftForeArm"})),
              ElementsAre("neither has a left arm"));
  EXPECT_THAT(refusal(without_joints(first_signer(), {"LeftArm"}), other_signer()),
              HasSubstr("'b' has no left_upper_arm; 'b' has no left_forearm, left_hand"));
}

TEST(BodyMatch, AHandWithSomeFingersIsRefusedNamingTheMissingOnes) {
  const Motion three = without_joints(first_signer(), first_joints("LeftHand", {"Ring", "Pinky"}));
  EXPECT_THAT(refusal(three, other_signer()), HasSubstr("'b' has no left_ring_proximal, left_little_proximal; import"));
  EXPECT_THAT(approximations(other_signer(), three),
              ElementsAre("'a' has no left_ring_proximal, left_little_proximal: their movement is lost"));
}

TEST(BodyMatch, AHandWithoutFingersStaysStillAndIsReported) {
  const Motion none =
      without_joints(first_signer(), first_joints("LeftHand", {"Thumb", "Index", "Middle", "Ring", "Pinky"}));
  EXPECT_THAT(approximations(none, other_signer()),
              ElementsAre("its left hand has no fingers: the target's fingers stay still"));
  EXPECT_THAT(approximations(other_signer(), none),
              ElementsAre("'a' has no fingers on the left hand: handshapes are lost"));
  const Motion onto = other_signer(2);
  const Motion made = all_of(*shown(none, onto));
  const auto thumb = static_cast<std::size_t>(*made.skeleton().find("mixamorig:LeftHandThumb2"));
  const Quaternionf usual = usual_pose(onto).rotations[thumb];
  for (std::int64_t frame = 0; frame < made.frame_count(); ++frame) {
    EXPECT_LT(std::as_const(made).pose(frame).rotations[thumb].angularDistance(usual), 1e-3f);
  }
}

TEST(BodyMatch, FingersWithFewerJointsAndMissingEyesAreReported) {
  EXPECT_THAT(approximations(without_joints(first_signer(), {"RightHandIndex3"}), other_signer()),
              ElementsAre("it has no right_index_distal: they stay still"));
  EXPECT_THAT(approximations(without_joints(first_signer(), {"LeftEye"}), other_signer()),
              ElementsAre("it has no left_eye: they do not move on their own"));
}

TEST(BodyMatch, AGuessedHandIsRefused) {
  RecordedBody guess = body_in("b", first_signer());
  guess.signer.rig[Part::left_hand].confidence = 0.3f;
  EXPECT_THAT(match_bodies(guess, body_in("a", other_signer())).unsafe,
              ElementsAre("the joints of 'b' for left_hand are guesses"));
  EXPECT_THAT(match_bodies(body_in("a", other_signer()), guess).unsafe,
              ElementsAre("the joints of 'b' for left_hand are guesses"));
}

TEST(BodyMatch, AMappingFileCanRemoveFingers) {
  const Motion three = without_joints(first_signer(), first_joints("LeftHand", {"Ring", "Pinky"}));
  RigNames none;
  for (const Finger finger : kFingers) {
    for (std::size_t i = 0; i < kFingerPoints; ++i) {
      none[finger_part(Side::left, finger, static_cast<FingerPoint>(i))] = "";
    }
  }
  EXPECT_EQ(refusal(three, other_signer(), none), "none");
}

}  // namespace
}  // namespace signweave
