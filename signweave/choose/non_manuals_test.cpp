#include "signweave/choose/non_manuals.h"

#include <gtest/gtest.h>

namespace signweave {
namespace {

TEST(GazeDirection, IsOfANameOrOfAngles) {
  EXPECT_EQ(gaze_direction_of("left"), (GazeDirection{45, 0}));
  EXPECT_EQ(gaze_direction_of("-30/10"), (GazeDirection{-30, 10}));
  EXPECT_THROW(gaze_direction_of("200"), Error);
  EXPECT_THROW(gaze_direction_of("0.1,0.2,0.3"), Error);
  EXPECT_THROW(gaze_direction_of("a"), Error);
}

}  // namespace
}  // namespace signweave
