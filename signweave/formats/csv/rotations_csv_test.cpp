#include "signweave/formats/csv/rotations_csv.h"

#include <gtest/gtest.h>

namespace signweave {
namespace {

TEST(RotationsCsv, HasAQuaternionForEachJointAndAPositionForTranslatedOnes) {
  const auto skeleton = std::make_shared<const Skeleton>(
      std::vector<Joint>{{.name = "hips", .parent = kNoJoint, .offset = {0, 0, 0}, .translated = true},
                         {.name = "hand, left", .parent = 0, .offset = {0, 1, 0}}},
      std::vector<Tip>{});
  Motion motion(skeleton, {25, 1}, 2);
  motion.pose(1).translations[0] = {0.1f, 1, -2};
  motion.pose(1).rotations[1] = Eigen::Quaternionf(0.5f, 0.5f, -0.5f, 0.5f);  // w first
  EXPECT_EQ(rotations_csv_heading(*skeleton),
            "frame,time_s,hips.tx,hips.ty,hips.tz,hips.qx,hips.qy,hips.qz,hips.qw,"
            "\"hand, left.qx\",\"hand, left.qy\",\"hand, left.qz\",\"hand, left.qw\"\n");
  EXPECT_EQ(rotations_csv_row(motion, 0), "0,0.000000,0,0,0,0,0,0,1,0,0,0,1\n");
  EXPECT_EQ(rotations_csv_row(motion, 1), "1,0.040000,0.1,1,-2,0,0,0,1,0.5,-0.5,0.5,0.5\n");
}

}  // namespace
}  // namespace signweave
