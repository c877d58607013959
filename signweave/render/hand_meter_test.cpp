#include "signweave/render/hand_meter.h"

#include <gtest/gtest.h>

#include "signweave/render/anchor.h"
#include "signweave/render/test_signing_person.h"

namespace signweave {
namespace {

using namespace testing_person;

TEST(HandMeter, TouchesAreThoseThatAreMeasuredForFeatures) {
  const Person person;
  HandMeter meter(*person.skeleton, person.signer);
  Contact seen = Contact::none;
  for (const Person::WristAt& path : {Person::WristAt(in_front), Person::WristAt(at_chin), Person::WristAt(together)}) {
    const Motion motion = person.stroke(path);
    const HandMotion measured = measure_hands(motion, person.signer, {0, motion.frame_count()});
    for (std::int64_t frame = 0; frame < motion.frame_count(); ++frame) {
      meter.look(motion.pose(frame));
      for (const Side side : kSides) {
        const Contact contact =
            measured.hands[static_cast<std::size_t>(side)].frames[static_cast<std::size_t>(frame)].contact;
        EXPECT_EQ(meter.touched(side), contact);
        seen = seen | contact;
      }
    }
  }
  EXPECT_TRUE(has(seen, Contact::hands) && has(seen, Contact::head));
}

TEST(HandMeter, TheDeepestFrameCounts) {
  const Person person;
  HandMeter meter(*person.skeleton, person.signer);
  const Motion motion = person.stroke(together);
  float deepest = -1;
  for (std::int64_t frame = 0; frame < motion.frame_count(); ++frame) {
    meter.look(motion.pose(frame));
    const Approach right = meter.to(Side::right, Obstacle::other_hand);
    const Approach left = meter.to(Side::left, Obstacle::other_hand);
    EXPECT_NEAR(right.clearance, left.clearance, 1e-6);
    deepest = std::max(deepest, -right.clearance);
  }
  EXPECT_GT(deepest, 0);
  EXPECT_EQ(meter.meeting(person.all_of(motion)).depth, deepest);
}

TEST(HandMeter, HandsCrossByTheDistanceOfOnePalmBeyondTheOther) {
  const Person person;
  HandMeter meter(*person.skeleton, person.signer);
  const auto with = [&](float right, float left) {
    return person.stroke([=](Side side, float) {
      return side == Side::left ? Eigen::Vector3f(left, 1.1f, 0.4f) : Eigen::Vector3f(right, 1.25f, 0.35f);
    });
  };
  const float apart = meter.meeting(person.all_of(with(-0.2f, 0.2f))).crossed;
  const float crossed = meter.meeting(person.all_of(with(0.05f, -0.05f))).crossed;
  EXPECT_LT(apart, -0.1f);
  EXPECT_GT(crossed, 0.02f);
}

TEST(AnchorOf, TheOtherHandComesBeforeTheHeadAndTheHeadBeforeTheTrunk) {
  using enum Contact;
  EXPECT_EQ(anchor_of(none), Anchor::signer_space);
  EXPECT_EQ(anchor_of(torso), Anchor::trunk);
  EXPECT_EQ(anchor_of(torso | head), Anchor::head);
  EXPECT_EQ(anchor_of(head | hands), Anchor::other_hand);
}

TEST(AnchorSpaces, AShrugOfTheOtherShoulderDoesNotMoveSignerSpace) {
  const Person person;
  AnchorSpaces spaces(person.signer);
  const Motion source = person.stroke(in_front, 1);
  Motion target = source;
  target.pose(0).rotations[slot(*person.skeleton, "LeftShoulder")] = turn(20, Eigen::Vector3f::UnitZ());
  const RigidMotion motion = spaces
                                 .between(Anchor::signer_space, to_model_space(*person.skeleton, source.pose(0)),
                                          to_model_space(*person.skeleton, target.pose(0)))
                                 .target_from_source;
  EXPECT_LT(motion.shift.norm(), 1e-6f);
  EXPECT_LT(motion.turn.angularDistance(Eigen::Quaternionf::Identity()), 1e-4f);
}

}  // namespace
}  // namespace signweave
