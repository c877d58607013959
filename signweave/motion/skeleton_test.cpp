#include "signweave/motion/skeleton.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>

#include "signweave/core/error.h"

namespace signweave {
namespace {

using Eigen::Vector3f;

Joint joint(std::string name, JointIndex parent, bool translated = false) {
  return {.name = std::move(name), .parent = parent, .offset = Vector3f(1, 2, 3), .translated = translated};
}

TEST(Skeleton, KnowsItsJointsByNameAndItsTranslationsByJoint) {
  const Skeleton skeleton({joint("Hips", kNoJoint, true), joint("Spine", 0), joint("Hand", 1, true)}, {{2, {0, 1, 0}}});
  EXPECT_EQ(skeleton.joint_count(), 3U);
  EXPECT_EQ(skeleton.find("Spine"), 1);
  EXPECT_EQ(skeleton.find("spine"), std::nullopt);
  EXPECT_THAT(skeleton.translated_joints(), testing::ElementsAre(0, 2));
  EXPECT_EQ(skeleton.translation_of(0), 0U);
  EXPECT_EQ(skeleton.translation_of(1), std::nullopt);
  EXPECT_EQ(skeleton.translation_of(2), 1U);
  EXPECT_EQ(skeleton.translation_of(99), std::nullopt);
}

TEST(Skeleton, FindsTheFirstOfJointsWithTheSameName) {
  const Skeleton skeleton({joint("Hips", kNoJoint), joint("Site", 0), joint("Site", 1)}, {});
  EXPECT_EQ(skeleton.find("Site"), 1);
}

TEST(Skeleton, RefusesAllButTreesWithParentsFirst) {
  const auto make = [](std::vector<Joint> joints, std::vector<Tip> tips = {}) {
    return Skeleton(std::move(joints), std::move(tips));
  };
  EXPECT_THROW(make({}), Error);                                                    // no joint
  EXPECT_THROW(make({joint("A", 0)}), Error);                                       // no root
  EXPECT_THROW(make({joint("A", kNoJoint), joint("B", kNoJoint)}), Error);          // two roots
  EXPECT_THROW(make({joint("A", kNoJoint), joint("B", 1)}), Error);                 // its own parent
  EXPECT_THROW(make({joint("A", kNoJoint), joint("B", 2), joint("C", 0)}), Error);  // the parent comes later
  EXPECT_THROW(make({joint("A", kNoJoint), joint("B", -2)}), Error);
  EXPECT_THROW(make({joint("A", kNoJoint)}, {{1, Vector3f::Zero()}}), Error);  // a tip of no joint
  EXPECT_THROW(make({joint("A", kNoJoint)}, {{-1, Vector3f::Zero()}}), Error);
  EXPECT_THROW(make(std::vector<Joint>(65'536, joint("A", 0))), Error);
}

TEST(Skeleton, RefusesOffsetsThatAreNotFinite) {
  Joint wrong = joint("A", kNoJoint);
  wrong.offset.y() = std::numeric_limits<float>::quiet_NaN();
  EXPECT_THROW(Skeleton({wrong}, {}), Error);
  const Vector3f endless(0, std::numeric_limits<float>::infinity(), 0);
  EXPECT_THROW(Skeleton({joint("A", kNoJoint)}, {{0, endless}}), Error);
}

TEST(Difference, IgnoresOffsetsAndTips) {
  Joint longer = joint("Spine", 0);
  longer.offset *= 2;
  const Skeleton a({joint("Hips", kNoJoint, true), joint("Spine", 0)}, {{1, {0, 1, 0}}});
  const Skeleton b({joint("Hips", kNoJoint, true), longer}, {});
  EXPECT_EQ(difference(a, b), std::nullopt);
  EXPECT_NE(a, b);
}

TEST(Difference, NamesTheFirstJointThatDiffers) {
  const Skeleton a({joint("Hips", kNoJoint, true), joint("Spine", 0), joint("Neck", 1)}, {});
  const Skeleton name({joint("Hips", kNoJoint, true), joint("Chest", 0), joint("Head", 1)}, {});
  const Skeleton parent({joint("Hips", kNoJoint, true), joint("Spine", 0), joint("Neck", 0)}, {});
  const Skeleton translated({joint("Hips", kNoJoint, true), joint("Spine", 0, true), joint("Neck", 1)}, {});
  const Skeleton shorter({joint("Hips", kNoJoint, true), joint("Spine", 0)}, {});
  EXPECT_THAT(difference(a, name).value(), testing::AllOf(testing::HasSubstr("Spine"), testing::HasSubstr("Chest")));
  EXPECT_THAT(difference(a, parent).value(), testing::HasSubstr("Neck"));
  EXPECT_THAT(difference(a, translated).value(), testing::HasSubstr("Spine"));
  EXPECT_THAT(difference(a, shorter).value(), testing::HasSubstr("Neck"));
  EXPECT_THAT(difference(shorter, a).value(), testing::HasSubstr("Neck"));
}

}  // namespace
}  // namespace signweave
