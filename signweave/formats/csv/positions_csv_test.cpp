#include "signweave/formats/csv/positions_csv.h"

#include <gtest/gtest.h>

namespace signweave {
namespace {

TEST(PositionsCsv, ARowHoldsJointsAndTipsInMetres) {
  const auto skeleton = std::make_shared<const Skeleton>(
      std::vector<Joint>{{"Hips, main", kNoJoint, {0, 1, 0}, true}, {"Head", 0, {0, 0.5f, 0}, false}},
      std::vector<Tip>{{1, {0, 0.25f, 0}}});
  Motion motion(skeleton, {50, 1}, 2);
  motion.pose(1).rotations[0] = Eigen::AngleAxisf(static_cast<float>(EIGEN_PI) / 2, Eigen::Vector3f::UnitZ());
  EXPECT_EQ(
      positions_csv_heading(*skeleton),
      "frame,time_s,\"Hips, main.x\",\"Hips, main.y\",\"Hips, main.z\",Head.x,Head.y,Head.z,Head tip.x,Head tip.y,"
      "Head tip.z\n");
  EXPECT_EQ(positions_csv_row(motion, 0),
            "0,0.000000,0.000000,1.000000,0.000000,0.000000,1.500000,0.000000,0.000000,1.750000,0.000000\n");
  EXPECT_EQ(positions_csv_row(motion, 1),
            "1,0.020000,0.000000,1.000000,0.000000,-0.500000,1.000000,0.000000,-0.750000,1.000000,0.000000\n");
}

}  // namespace
}  // namespace signweave
