#include "signweave/calls/utterance_call.h"

#include <gtest/gtest.h>

namespace signweave::calls {
namespace {

TEST(UtteranceCall, PositionsAreInCharactersAndLines) {
  const UtteranceAnswer answer = run(UtteranceCall{.text = "手 A{neg}\nÉ ] B#0\n[X"});
  ASSERT_EQ(answer.places.size(), 4U);
  EXPECT_EQ(answer.places[1].begin, 2U);
  EXPECT_EQ(answer.places[1].end, 8U);
  ASSERT_EQ(answer.faults.size(), 3U);
  EXPECT_EQ(answer.faults[0].line, 2U);
  EXPECT_EQ(answer.faults[0].column, 3U);
  EXPECT_EQ(answer.faults[0].begin, 11U);
  EXPECT_EQ(answer.faults[1].line, 2U);
  EXPECT_EQ(answer.faults[1].column, 5U);
  EXPECT_EQ(answer.faults[2].line, 3U);
  EXPECT_EQ(answer.faults[2].column, 1U);
  EXPECT_EQ(answer.faults[0].corrected, "手 A{neg}\nÉ \"]\" B#0\n[X");
  EXPECT_FALSE(answer.canonical);
}

TEST(UtteranceCall, AnswersWithTheCanonicalText) {
  EXPECT_EQ(run(UtteranceCall{.text = "A [B|weak:hold]"}).canonical, "A{weak hold ..+1} B");
  EXPECT_FALSE(run(UtteranceCall{.text = " , "}).canonical);
}

}  // namespace
}  // namespace signweave::calls
