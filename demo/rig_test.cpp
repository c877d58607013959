#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "demo/signer.h"
#include "signweave/rig/rig_map.h"

namespace signweave::demo {
namespace {

Motion at_rest(const std::shared_ptr<const Skeleton>& skeleton) {
  return Motion(skeleton, {100, 1}, 1);
}

TEST(SignersRig, IsRecognisedDownToTheLastFinger) {
  const Signer signer = make_signer();
  const RigMap map = map_rig(at_rest(signer.skeleton));
  EXPECT_EQ(map.convention, "MotionBuilder");
  EXPECT_THAT(map.notices, testing::IsEmpty());
  EXPECT_FALSE(map.sides_swapped);
  EXPECT_EQ(map[Part::chest].joint, signer.spine2);
  EXPECT_EQ(map[Part::jaw].joint, signer.jaw);
  EXPECT_EQ(map[Part::left_eye].joint, signer.left.eye);
  EXPECT_EQ(map[Part::right_hand].joint, signer.right.hand);
  EXPECT_EQ(map[finger_part(signweave::Side::left, Finger::ring, FingerPoint::intermediate)].joint,
            signer.left.fingers[3][1]);
}

TEST(SignersRig, IsRecognisedByShapeAloneWithLessConfidence) {
  const Signer signer = make_signer();
  std::vector<Joint> joints(signer.skeleton->joints().begin(), signer.skeleton->joints().end());
  for (std::size_t i = 0; i < joints.size(); ++i) joints[i].name = "q" + std::to_string(i * 31 % 97);
  const auto tips = signer.skeleton->tips();
  const Motion nameless =
      at_rest(std::make_shared<const Skeleton>(std::move(joints), std::vector<Tip>(tips.begin(), tips.end())));
  const RigMap by_name = map_rig(at_rest(signer.skeleton));
  const RigMap by_shape = map_rig(nameless);
  for (std::size_t i = 0; i < kPartCount; ++i) {
    const auto part = static_cast<Part>(i);
    if (part == Part::jaw || part == Part::left_eye || part == Part::right_eye) continue;  // not recognisable by shape
    EXPECT_EQ(by_shape[part].joint, by_name[part].joint) << name_of(part);
    if (by_shape.has(part)) {
      EXPECT_LT(by_shape[part].confidence, by_name[part].confidence) << name_of(part);
    }
  }
}

}  // namespace
}  // namespace signweave::demo
