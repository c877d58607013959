#include "signweave/evaluation/judge.h"

#include <gtest/gtest.h>

namespace signweave {
namespace {

/// Two collections of three recordings with four spans each; `error` gives the method's error, the other's is 10.
template <class Error>
Judgement judged(Error error) {
  std::vector<EvaluatedSpan> spans;
  MethodScores method{.name = "m", .spans = {}};
  MethodScores other{.name = "kriging", .spans = {}};
  const std::vector<std::size_t> collection_of = {0, 0, 0, 1, 1, 1};
  for (std::size_t recording = 0; recording < 6; ++recording) {
    for (std::size_t i = 0; i < 4; ++i) {
      spans.push_back({.recording = recording, .group = i % 2});
      method.spans.emplace_back().at(HandChoice::moving, Measure::wrist).value = error(recording, i);
      other.spans.emplace_back().at(HandChoice::moving, Measure::wrist).value = 10;
    }
  }
  Bootstrap bootstrap(1);
  return judge(method, other, spans, collection_of, 2, bootstrap);
}

TEST(Judge, AMethodBetterEverywhereWins) {
  const Judgement one = judged([](std::size_t, std::size_t) { return 8.0; });
  EXPECT_NEAR(one.all.value, 0.8, 1e-12);
  EXPECT_TRUE(one.worse_in().empty());
  EXPECT_TRUE(one.wins());
}

TEST(Judge, AMethodWorseInOneCollectionDoesNotWin) {
  const Judgement one = judged([](std::size_t recording, std::size_t) { return recording < 3 ? 2.0 : 11.0; });
  EXPECT_NEAR(one.all.value, 0.65, 1e-12);
  EXPECT_EQ(one.worse_in(), std::vector<std::size_t>{1});
  EXPECT_FALSE(one.wins());
}

TEST(Judge, WorseWithinTheIntervalIsNotWorse) {
  const Judgement one = judged([](std::size_t recording, std::size_t) {
    return recording < 3 ? 8.0 : recording == 3 ? 16.0 : 8.0;
  });
  EXPECT_GT(one.collections[1].value, 1);
  EXPECT_TRUE(one.wins());
}

TEST(Judge, AnEqualMethodDoesNotWin) {
  EXPECT_FALSE(judged([](std::size_t, std::size_t) { return 10.0; }).wins());
}

}  // namespace
}  // namespace signweave
