#include "signweave/choose/space_gaze.h"

#include <gtest/gtest.h>

#include "signweave/core/error.h"

namespace signweave {
namespace {

std::vector<std::string> gazes_of(std::string_view text) {
  std::vector<std::string> gazes;
  for (const NonManual& one : with_gazes_at_loci(parse_utterance(text)).non_manuals) gazes.push_back(one.what);
  return gazes;
}

TEST(SpaceGaze, GoesToTheObjectOrToWhatIsPointedAt) {
  using All = std::vector<std::string>;
  EXPECT_EQ(gazes_of("A{to @left} B{at @30/10} C"), (All{"left", "30/10"}));
  EXPECT_EQ(gazes_of("A{from @left}"), All{}) << "a subject is not looked at";
  EXPECT_EQ(gazes_of("A{to @self} B{to @addressee}"), All{});
  EXPECT_EQ(gazes_of("A{@a = @20} B{at @a}"), All{"20"});
  EXPECT_EQ(gazes_of("A{to @left; gaze @right}"), All{"right"});
  EXPECT_EQ(gazes_of("A{@a = @-20} {gaze @a: B C}"), All{"-20"});
  EXPECT_EQ(gazes_of("A{big}"), All{});
}

TEST(SpaceGaze, IsADirectionOrTheDirectionFromTheEyes) {
  EXPECT_EQ(direction_of_gaze("left"), (GazeDirection{45, 0}));
  const GazeDirection at = direction_of_gaze("-30/10");
  EXPECT_LT(at.yaw, -30);  // the eyes are in front of the shoulders
  EXPECT_GT(at.yaw, -40);
  EXPECT_LT(at.pitch, -10);  // and above them
  EXPECT_NEAR(direction_of_gaze("0,0.72,9").pitch, 0, 0.1f);
  EXPECT_THROW(direction_of_gaze("140"), Error);
  EXPECT_THROW(direction_of_gaze("200"), Error);
  EXPECT_THROW(direction_of_gaze("a"), Error);
}

}  // namespace
}  // namespace signweave
