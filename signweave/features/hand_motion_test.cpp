#include "signweave/features/hand_motion.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <numbers>
#include <span>

#include "signweave/rig/test_rig.h"

namespace signweave {
namespace {

using Eigen::AngleAxisf;
using Eigen::Vector3f;

SignerModel model_of_arm(const Motion& motion) {
  SignerModel model{.rig = rig_of_signer(motion.skeleton()), .body = {}};
  model.body = signer_body(motion, model.rig);
  return model;
}

HandMotion measured(const Motion& motion) {
  return measure_hands(motion, model_of_arm(motion), {0, motion.frame_count()});
}

/// Bit-identical in all fields.
bool same_bits(const HandFrame& a, const HandFrame& b) {
  const auto bytes = [](const auto& one) { return std::as_bytes(std::span(&one, 1)); };
  const auto same = [&](const auto& one, const auto& other) { return std::ranges::equal(bytes(one), bytes(other)); };
  return same(a.position, b.position) && same(a.velocity, b.velocity) && same(a.acceleration, b.acceleration) &&
         same(a.curvature, b.curvature) && same(a.palm, b.palm) && same(a.fingers, b.fingers) &&
         same(a.elbow, b.elbow) && same(a.openness, b.openness) && same(a.handshape.values, b.handshape.values) &&
         a.contact == b.contact;
}

/// The maximum difference in signer space; `scale` applies to velocities and accelerations.
float difference(const HandFrame& a, const HandFrame& b, float scale = 1) {
  return std::max({(a.position - b.position).norm(), (a.velocity - b.velocity / scale).norm() / 10,
                   (a.acceleration - b.acceleration / scale).norm() / 1000, (a.palm - b.palm).norm(),
                   (a.fingers - b.fingers).norm(), (a.elbow - b.elbow).norm(), std::abs(a.openness - b.openness),
                   distance(a.handshape, b.handshape)});
}

RC_GTEST_PROP(MeasureHands, APartIsBitIdenticalToTheWhole, ()) {
  const auto frames = *rc::gen::inRange<std::int64_t>(1, 60);
  const Motion motion = moving(whole_person(), frames, *rc::gen::arbitrary<unsigned>(),
                               {*rc::gen::element<std::int64_t>(10, 30, 60, 120), 1});
  const SignerModel model = model_of_arm(motion);
  const HandMotion whole = measure_hands(motion, model, {-5, frames + 5});
  RC_ASSERT(whole.range == (FrameRange{0, frames}));
  const auto begin = *rc::gen::inRange<std::int64_t>(0, frames);
  const auto end = *rc::gen::inRange<std::int64_t>(begin, frames + 1);
  const HandMotion part = measure_hands(motion, model, {begin, end});
  for (std::size_t side = 0; side < 2; ++side) {
    RC_ASSERT(std::ssize(part.hands[side].frames) == end - begin);
    for (std::int64_t i = begin; i < end; ++i) {
      const auto in_part = static_cast<std::size_t>(i - begin);
      RC_ASSERT(same_bits(part.hands[side].frames[in_part], whole.hands[side].frames[static_cast<std::size_t>(i)]));
      RC_ASSERT(part.hands_distance[in_part] == whole.hands_distance[static_cast<std::size_t>(i)]);
    }
  }
}

RC_GTEST_PROP(MeasureHands, DoesNotDependOnThePositionAndHeadingOfTheSigner, ()) {
  const Motion here = moving(whole_person(), 20, *rc::gen::arbitrary<unsigned>());
  const auto number = [](int most) { return static_cast<float>(*rc::gen::inRange(-most, most)) / 10; };
  const Motion there = placed(here, number(31), {number(20), number(2), number(20)});
  const HandMotion a = measured(here);
  const HandMotion b = measured(there);
  for (std::size_t side = 0; side < 2; ++side) {
    for (std::size_t i = 0; i < 20; ++i) {
      RC_ASSERT(difference(a.hands[side].frames[i], b.hands[side].frames[i]) < 1e-4f);
      RC_ASSERT(std::abs(a.hands_distance[i] - b.hands_distance[i]) < 1e-4f);
      RC_ASSERT((a.trunk[i].lean - b.trunk[i].lean).norm() < 1e-4f);
      RC_ASSERT(std::abs(a.trunk[i].twist - b.trunk[i].twist) < 1e-4f);
    }
  }
}

RC_GTEST_PROP(MeasureHands, ScalesVelocitiesWithTheBodyAndNotPositions, ()) {
  const unsigned seed = *rc::gen::arbitrary<unsigned>();
  const float scale = static_cast<float>(*rc::gen::inRange(5, 20)) / 10;
  const Motion one = moving(whole_person(), 20, seed);
  const Motion other = moving(whole_person(scale), 20, seed);
  const HandMotion a = measured(one);
  const HandMotion b = measured(other);
  for (std::size_t side = 0; side < 2; ++side) {
    for (std::size_t i = 0; i < 20; ++i) {
      RC_ASSERT(difference(a.hands[side].frames[i], b.hands[side].frames[i], scale) < 1e-4f);
      RC_ASSERT(a.hands[side].frames[i].contact == b.hands[side].frames[i].contact);
      RC_ASSERT(std::abs(scale * a.hands_distance[i] - b.hands_distance[i]) < 1e-4f);
    }
  }
}

RC_GTEST_PROP(MeasureHands, MirroringSwapsTheHands, ()) {
  const Motion motion = moving(whole_person(), 20, *rc::gen::arbitrary<unsigned>());
  const HandMotion a = measured(motion);
  const HandMotion b = measured(in_mirror(motion));
  const auto mirrored = [](HandFrame frame) {
    for (Vector3f* vector :
         {&frame.position, &frame.velocity, &frame.acceleration, &frame.palm, &frame.fingers, &frame.elbow}) {
      vector->x() = -vector->x();
    }
    return frame;
  };
  for (std::size_t side = 0; side < 2; ++side) {
    for (std::size_t i = 0; i < 20; ++i) {
      RC_ASSERT(difference(mirrored(a.hands[side].frames[i]), b.hands[1 - side].frames[i]) < 1e-4f);
      RC_ASSERT(a.hands[side].frames[i].contact == b.hands[1 - side].frames[i].contact);
    }
  }
}

TEST(MeasureHands, MeasuresLeanAndTwistOfTheTrunk) {
  Motion motion(whole_person(), {100, 1}, 3);
  const auto spine = static_cast<std::size_t>(*motion.skeleton().find("Spine"));
  motion.pose(1).rotations[spine] = AngleAxisf(0.3f, Vector3f::UnitX());  // forwards
  motion.pose(2).rotations[spine] = AngleAxisf(0.4f, Vector3f::UnitY());  // to the left
  const HandMotion hands = measured(motion);
  ASSERT_EQ(hands.trunk.size(), 3U);
  EXPECT_NEAR(hands.trunk[0].lean.norm(), 1, 1e-5f);
  EXPECT_GT(hands.trunk[0].lean.y(), 0.95f);
  EXPECT_NEAR(hands.trunk[0].twist, 0, 1e-3f);
  EXPECT_GT(hands.trunk[1].lean.z(), hands.trunk[0].lean.z() + 0.15f);
  EXPECT_NEAR(hands.trunk[1].twist, 0, 1e-3f);
  EXPECT_NEAR(std::abs(hands.trunk[2].twist), std::sin(0.4f), 0.02f);
  EXPECT_FALSE(hands.hands[0].frames[0].elbow.isZero());
  EXPECT_GT(hands.hands[0].frames[0].elbow.x(), 0.4f);  // the left arm's elbow is on the left
  SignerModel model = model_of_arm(motion);
  model.rig[Part::pelvis] = {};
  model.rig[Part::left_thigh] = {};
  model.rig[Part::left_forearm] = {};
  const HandMotion without = measure_hands(motion, model, {0, 3});
  EXPECT_TRUE(without.trunk[1].lean.isZero());
  EXPECT_EQ(without.trunk[2].twist, 0);
  EXPECT_TRUE(without.hands[0].frames[0].elbow.isZero());
}

/// The rest pose with one forearm that rotates uniformly about the elbow, forwards: a circle of known size.
TEST(MeasureHands, FindsSpeedAccelerationAndCurvatureOfACircle) {
  Motion motion(whole_person(), {100, 1}, 60);
  const JointIndex forearm = *motion.skeleton().find("LeftForeArm");
  constexpr float kTurn = 2;  // radians a second
  for (std::int64_t frame = 0; frame < 60; ++frame) {
    motion.pose(frame).rotations[static_cast<std::size_t>(forearm)] =
        AngleAxisf(-kTurn * static_cast<float>(frame) / 100, Vector3f::UnitY());
  }
  constexpr float kRadius = 0.25f + 0.045f;  // to the palm
  const HandMotion hands = measured(motion);
  for (std::size_t i = 0; i < 60; ++i) {
    const HandFrame& left = hands.hands[0].frames[i];
    const float angle = kTurn * static_cast<float>(i) / 100;
    const Vector3f palm(0.46f + kRadius * std::cos(angle), 0, kRadius * std::sin(angle));
    EXPECT_LT((left.position - palm / 0.36f).norm(), 1e-4f);
    EXPECT_LT((left.velocity - kTurn * kRadius * Vector3f(-std::sin(angle), 0, std::cos(angle))).norm(), 0.01f) << i;
    if (i >= 5 && i < 55) {
      EXPECT_NEAR(left.acceleration.norm(), kTurn * kTurn * kRadius, 0.02f);
      EXPECT_NEAR(left.curvature, 1 / kRadius, 0.05f);
    }
    EXPECT_LT(hands.hands[1].frames[i].velocity.norm(), 1e-4f);
    EXPECT_EQ(hands.hands[1].frames[i].curvature, 0);
    EXPECT_NEAR(left.palm.y(), -1, 1e-4f);
    EXPECT_NEAR(hands.hands_distance[i], (palm - Vector3f(-0.755f, 0, 0)).norm(), 1e-4f);
  }
}

TEST(MeasureHands, MeasuresOneFrame) {
  const HandMotion hands = measured(Motion(whole_person(), {60, 1}, 1));
  ASSERT_EQ(hands.hands[1].frames.size(), 1U);
  const HandFrame& right = hands.hands[1].frames[0];
  EXPECT_LT((right.position - Vector3f(-0.755f / 0.36f, 0, 0)).norm(), 1e-4f);
  EXPECT_EQ(right.velocity, Vector3f::Zero().eval());
  EXPECT_NEAR(right.openness, 1, 0.01f);
  EXPECT_EQ(right.contact, Contact::none);
}

TEST(MeasureHands, ReportsWhyNothingIsMeasured) {
  const Motion motion = moving(whole_person(), 10);
  SignerModel model = model_of_arm(motion);
  const auto measure = [&] { return measure_hands(motion, model, {0, 10}); };

  model.rig[Part::left_hand] = {};
  EXPECT_EQ(measure().hands[0].why_not, "no left wrist");
  EXPECT_TRUE(measure().hands[0].frames.empty());
  EXPECT_EQ(measure().hands[1].why_not, "");
  EXPECT_EQ(measure().hands[1].frames.size(), 10U);
  EXPECT_TRUE(measure().hands_distance.empty());

  model = model_of_arm(motion);
  model.rig[Part::left_upper_arm] = {};  // one arm: no shoulder line
  model.body = signer_body(motion, model.rig);
  for (const auto& hand : measure().hands) {
    EXPECT_EQ(hand.why_not, "no left shoulder: name it in a mapping file");
    EXPECT_TRUE(hand.frames.empty());
  }

  model = model_of_arm(motion);
  model.body.reset();
  EXPECT_EQ(measure().hands[0].why_not, "the shoulders are in one place, or the motion has no frames");
}

TEST(MeasureHands, MeasuresAHandWithoutFingersAtItsWrist) {
  const HandMotion hands = measured(moving(whole_person(1, false), 10));
  for (const auto& hand : hands.hands) {
    EXPECT_TRUE(hand.why_no_fingers.ends_with("fingers"));
    ASSERT_EQ(hand.frames.size(), 10U);
    EXPECT_EQ(hand.frames[3].palm, Vector3f::Zero().eval());
    EXPECT_EQ(hand.frames[3].handshape.values, Handshape{}.values);
    EXPECT_EQ(hand.frames[3].openness, 0);
    EXPECT_GT(hand.frames[3].velocity.norm(), 0);
  }
}

TEST(MeasureHands, MeasuresAHeadlessBodyAndOneOf300Joints) {
  const Motion motion = moving(whole_person(), 10);
  SignerModel model = model_of_arm(motion);
  model.rig[Part::head] = {};
  EXPECT_EQ(measure_hands(motion, model, {0, 10}).hands[0].frames.size(), 10U);

  std::vector<Joint> joints(motion.skeleton().joints().begin(), motion.skeleton().joints().end());
  while (joints.size() < 300) {
    joints.push_back({"Cloth", static_cast<JointIndex>(joints.size()) - 1, {0, 0.01f, 0}, false});
  }
  const std::vector<Tip> tips(motion.skeleton().tips().begin(), motion.skeleton().tips().end());
  Motion dressed(std::make_shared<const Skeleton>(joints, tips), motion.rate(), 10);
  for (std::int64_t frame = 0; frame < 10; ++frame) {
    const PoseView pose = motion.pose(frame);
    std::copy(pose.rotations.begin(), pose.rotations.end(), dressed.pose(frame).rotations.begin());
  }
  const HandMotion bare = measured(motion);
  const HandMotion with_cloth = measured(dressed);
  for (std::size_t i = 0; i < 10; ++i) {
    EXPECT_TRUE(same_bits(bare.hands[0].frames[i], with_cloth.hands[0].frames[i]));
  }
}

TEST(MeasureHands, DetectsContactBetweenHandsAndWithTheBody) {
  Motion motion(whole_person(), {60, 1}, 1);
  const auto turn = [&](const char* name, float degrees, const Vector3f& axis) {
    motion.pose(0).rotations[static_cast<std::size_t>(*motion.skeleton().find(name))] =
        AngleAxisf(degrees * std::numbers::pi_v<float> / 180, axis);
  };
  // Upper arms forward and down, forearms inwards: the hands in front of the chest, almost palm to palm.
  turn("LeftArm", -90, Vector3f::UnitY());
  turn("RightArm", 90, Vector3f::UnitY());
  EXPECT_EQ(measured(motion).hands[0].frames[0].contact, Contact::none);
  turn("LeftForeArm", 45, -Vector3f::UnitY());
  turn("RightForeArm", 45, Vector3f::UnitY());
  EXPECT_EQ(measured(motion).hands[0].frames[0].contact, Contact::hands);
  EXPECT_EQ(measured(motion).hands[1].frames[0].contact, Contact::hands);
  // The left forearm fully bent: the hand at its own shoulder, which belongs to the torso.
  turn("LeftForeArm", 165, -Vector3f::UnitY());
  EXPECT_TRUE(has(measured(motion).hands[0].frames[0].contact, Contact::torso));
  EXPECT_EQ(measured(motion).hands[1].frames[0].contact, Contact::none);
}

}  // namespace
}  // namespace signweave
