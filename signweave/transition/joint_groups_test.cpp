#include "signweave/transition/joint_groups.h"

#include <gtest/gtest.h>

#include "signweave/rig/test_rigs.h"

namespace signweave {
namespace {

Motion whole_body() {
  RigNaming naming;
  for (const char* const finger : {"Thumb", "Index", "Middle"}) {
    std::vector<std::string> joints;
    for (int i = 1; i <= 3; ++i) joints.push_back(std::string("@Hand") + finger + std::to_string(i));
    naming.fingers.push_back(std::move(joints));
  }
  return rig_body(naming, 1);
}

TEST(JointGroups, OfAWholeBody) {
  const Motion motion = whole_body();
  const Skeleton& skeleton = motion.skeleton();
  const JointGroups groups = joint_groups(skeleton, map_rig(motion));
  const auto at = [&](const char* name) { return static_cast<std::size_t>(*skeleton.find(name)); };
  const auto expect = [&](const char* name, JointGroup group, JointRole role) {
    EXPECT_EQ(groups.of[at(name)], group) << name;
    EXPECT_EQ(groups.roles[at(name)], role) << name;
  };
  expect("Hips", JointGroup::body, JointRole::trunk);
  expect("Spine1", JointGroup::body, JointRole::trunk);
  expect("Head", JointGroup::body, JointRole::other);
  expect("LeftLeg", JointGroup::body, JointRole::other);
  expect("LeftShoulder", JointGroup::left_arm, JointRole::other_arm);
  expect("LeftArm", JointGroup::left_arm, JointRole::shoulder);
  expect("LeftForeArm", JointGroup::left_arm, JointRole::elbow);
  expect("LeftHand", JointGroup::left_arm, JointRole::other_arm);
  expect("LeftHandIndex3", JointGroup::left_fingers, JointRole::finger);
  expect("RightArm", JointGroup::right_arm, JointRole::shoulder);
  expect("RightHandThumb1", JointGroup::right_fingers, JointRole::finger);
  EXPECT_EQ(groups.wrists[0], *skeleton.find("LeftHand"));
  EXPECT_EQ(groups.wrists[1], *skeleton.find("RightHand"));
  EXPECT_EQ(groups.of_translation, std::vector{JointGroup::body});
  std::size_t count = 0;
  for (std::size_t group = 0; group < kJointGroups; ++group) {
    for (const JointIndex joint : groups.all[group]) {
      EXPECT_EQ(groups.of[static_cast<std::size_t>(joint)], static_cast<JointGroup>(group));
      ++count;
    }
  }
  EXPECT_EQ(count, skeleton.joint_count());
}

TEST(JointGroups, WithoutKnownHandsAllJointsAreBody) {
  const Motion motion = whole_body();
  const JointGroups groups = joint_groups(motion.skeleton(), RigMap{});
  for (const JointGroup group : groups.of) EXPECT_EQ(group, JointGroup::body);
  for (const JointRole role : groups.roles) EXPECT_EQ(role, JointRole::other);
  EXPECT_EQ(groups[JointGroup::body].size(), motion.skeleton().joint_count());
  EXPECT_EQ(groups.wrists[0], kNoJoint);
}

TEST(JointGroups, ASingleArmMayBeKnown) {
  const Motion motion = whole_body();
  RigMap rig = map_rig(motion);
  rig[Part::left_hand] = {};
  const JointGroups groups = joint_groups(motion.skeleton(), rig);
  EXPECT_TRUE(groups[JointGroup::left_arm].empty());
  EXPECT_TRUE(groups[JointGroup::left_fingers].empty());
  EXPECT_FALSE(groups[JointGroup::right_arm].empty());
  EXPECT_EQ(groups.wrists[0], kNoJoint);
}

TEST(JointGroups, ASetContainsItsGroups) {
  constexpr GroupSet set{JointGroup::left_arm, JointGroup::right_fingers};
  EXPECT_TRUE(set.has(JointGroup::left_arm));
  EXPECT_FALSE(set.has(JointGroup::body));
  EXPECT_NE(set, GroupSet::all());
}

}  // namespace
}  // namespace signweave
