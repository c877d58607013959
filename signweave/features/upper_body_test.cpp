#include <gtest/gtest.h>

#include "signweave/features/segmenter.h"

namespace signweave {
namespace {

/// Pelvis, neck, head, both shoulders and hands of a signer who faces +x: left is -z.
struct Posed {
  Motion motion;
  RigMap rig;
};

Posed person_facing_x() {
  std::vector<Joint> joints = {{.name = "Hips", .parent = kNoJoint, .offset = {0, 1, 0}, .translated = true}};
  Posed person;
  const auto add = [&](Part part, JointIndex parent, const Eigen::Vector3f& offset) {
    person.rig[part] = {.joint = static_cast<JointIndex>(joints.size()), .evidence = Evidence::file, .confidence = 1};
    joints.push_back({.name = std::string(name_of(part)), .parent = parent, .offset = offset});
  };
  person.rig[Part::pelvis] = {.joint = 0, .evidence = Evidence::file, .confidence = 1};
  add(Part::neck, 0, {0, 0.5F, 0});
  add(Part::head, 1, {0, 0.1F, 0});
  add(Part::left_upper_arm, 1, {0, 0, -0.2F});
  add(Part::right_upper_arm, 1, {0, 0, 0.2F});
  add(Part::left_hand, 3, {0.3F, -0.2F, 0});
  add(Part::right_hand, 4, {0.3F, -0.2F, 0});
  person.motion = Motion(std::make_shared<const Skeleton>(std::move(joints), std::vector<Tip>{}), {50, 1}, 3);
  return person;
}

TEST(UpperBodyOf, UsesTheSignersAxes) {
  const Posed person = person_facing_x();
  const UpperBodyTrack track = upper_body_of(person.motion, person.rig);
  ASSERT_EQ(track.times.size(), 3u);
  EXPECT_DOUBLE_EQ(track.times[2].count(), 0.04);
  const UpperBody& body = track.bodies[1];
  const Eigen::Vector3f left = body.wrists[0] - body.spine;
  const Eigen::Vector3f right = body.wrists[1] - body.spine;
  EXPECT_TRUE(left.isApprox(Eigen::Vector3f(0.2F, 0.05F, 0.3F), 1e-5F)) << left.transpose();
  EXPECT_TRUE(right.isApprox(Eigen::Vector3f(-0.2F, 0.05F, 0.3F), 1e-5F)) << right.transpose();
  EXPECT_TRUE(body.hands[0].isApprox(body.wrists[0]));  // no knuckles
}

TEST(UpperBodyOf, UsesTheCentreOfThePalmIfThereAreKnuckles) {
  Posed person = person_facing_x();
  PartPlace& knuckle = person.rig[finger_part(Side::right, Finger::middle, FingerPoint::proximal)];
  knuckle = person.rig[Part::right_hand];
  knuckle.offset = {0.1F, 0, 0};
  const UpperBody body = upper_body_of(person.motion, person.rig).bodies[0];
  EXPECT_TRUE((body.hands[1] - body.wrists[1]).isApprox(Eigen::Vector3f(0, 0, 0.05F), 1e-5F));
}

TEST(UpperBodyOf, OneHandMayBeAbsentButNotBothNorTheTrunk) {
  Posed person = person_facing_x();
  person.rig[Part::left_hand] = {};
  const UpperBodyTrack track = upper_body_of(person.motion, person.rig);
  EXPECT_FALSE(track.has_hand[0]);
  EXPECT_TRUE(track.has_hand[1]);
  Posed no_trunk = person_facing_x();
  no_trunk.rig[Part::pelvis] = {};
  EXPECT_THROW(upper_body_of(no_trunk.motion, no_trunk.rig), Error);
  person.rig[Part::right_hand] = {};
  EXPECT_THROW(upper_body_of(person.motion, person.rig), Error);
}

}  // namespace
}  // namespace signweave
