#include "signweave/calls/utterance_call.h"

#include <gtest/gtest.h>

#include "signweave/notation/answer_json.h"

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

TEST(UtteranceCall, AnswersWithChangesInSpace) {
  const UtteranceAnswer answer =
      run(UtteranceCall{.text = "A{@a = @30/10} B{from @a to @self; big; plural; scale 1/1.2/1} C{along @left @a; "
                                "unturned; mirrored} D{at @0.3,0.1,0.8; move 1/2/3}"});
  const nlohmann::ordered_json json = answer_json(answer);
  EXPECT_EQ(json["loci"].dump(), R"([{"name":"a","is":"30/10","from":0}])");
  EXPECT_FALSE(json["places"][0].contains("space"));
  EXPECT_EQ(json["places"][1]["space"].dump(),
            R"({"from":"a","to":"self","scale":[1.0,1.2,1.0],"size":1.3,"repetitions":3,"outward":true})");
  EXPECT_EQ(json["places"][2]["space"].dump(), R"({"along":["left","a"],"unturned":true,"mirrored":true})");
  EXPECT_EQ(json["places"][3]["space"].dump(), R"({"at":"0.3,0.1,0.8","move_cm":[1.0,2.0,3.0]})");
  EXPECT_FALSE(answer_json(run(UtteranceCall{.text = "A"})).contains("loci"));
}

}  // namespace
}  // namespace signweave::calls
