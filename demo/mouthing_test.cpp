#include "demo/mouthing.h"

#include <gtest/gtest.h>

namespace signweave::demo {
namespace {

TEST(MouthShapes, FollowTheLettersAndLeaveSilentOnesOut) {
  EXPECT_EQ(mouth_shapes("Paris").size(), 4U);   // p a r i
  EXPECT_EQ(mouth_shapes("Nantes").size(), 3U);  // n an t
  EXPECT_EQ(mouth_shapes("neige").size(), 3U);   // n ei g
  EXPECT_EQ(mouth_shapes("où").size(), 1U);
  EXPECT_EQ(mouth_shapes("Vannes").size(), 3U);     // v a n
  EXPECT_EQ(mouth_shapes("au revoir").size(), 6U);  // au r e v o-i
  EXPECT_TRUE(mouth_shapes("").empty());
  EXPECT_TRUE(mouth_shapes("123").empty());
  EXPECT_GT(mouth_shapes("bon")[0].press, 0.9f);
}

}  // namespace
}  // namespace signweave::demo
