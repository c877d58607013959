#include "signweave/choose/best_path.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <random>

namespace signweave {
namespace {

float uniform(std::mt19937& random, float from, float to) {
  return std::uniform_real_distribution<float>(from, to)(random);
}

JoinPoint random_point(std::mt19937& random) {
  JoinPoint point;
  point.known = 127;
  for (float& value : point.values) value = uniform(random, -1, 1);
  return point;
}

/// Random candidates, or identical ones (`same`), for which every path costs the same.
PlaceCosts random_place(std::mt19937& random, std::size_t count, std::size_t before, bool same) {
  PlaceCosts place;
  std::vector<JoinPoint> begins;
  std::vector<JoinPoint> ends;
  for (std::size_t i = 0; i < count; ++i) {
    begins.push_back(same ? JoinPoint{.values = {}, .known = 127} : random_point(random));
    ends.push_back(same ? JoinPoint{.values = {}, .known = 127} : random_point(random));
    place.own.push_back(same ? 0.25f : uniform(random, 0, 1));
    place.made_before.push_back(same ? 0 : uniform(random, 0, 0.3f));
    place.made_after.push_back(same ? 0 : uniform(random, 0, 0.3f));
    const bool kept = !same && before > 0 && random() % 4 == 0;
    place.kept.push_back(kept ? static_cast<std::uint32_t>(random() % before) : PlaceCosts::kNone);
  }
  for (std::size_t i = 0; i < before; ++i) place.added_before.push_back(same ? 0 : uniform(random, 0, 0.2f));
  if (random() % 4 == 0) {  // if features are unknown, join costs are given
    for (std::size_t i = 0; i < before * count; ++i) place.joins.push_back(same ? 0.5f : uniform(random, 0, 2));
  }
  place.ends = std::make_shared<const JoinEnds>(begins, ends);
  return place;
}

std::vector<PlaceCosts> random_problem(std::mt19937& random, std::size_t places, std::size_t most, bool same = false) {
  std::vector<PlaceCosts> problem;
  std::size_t before = 0;
  for (std::size_t i = 0; i < places; ++i) {
    const std::size_t count = 1 + random() % most;
    problem.push_back(random_place(random, count, before, same));
    before = count;
  }
  return problem;
}

/// The least cost, by trying every path.
double least_by_trying(const std::vector<PlaceCosts>& places, const JoinScale& scale) {
  std::vector<std::size_t> chosen(places.size());
  double least = std::numeric_limits<double>::infinity();
  for (;;) {
    least = std::min(least, path_cost(places, chosen, scale));
    std::size_t place = 0;
    while (place < places.size() && ++chosen[place] == places[place].size()) chosen[place++] = 0;
    if (place == places.size()) return least;
  }
}

RC_GTEST_PROP(BestPath, CostsWhatTheCheapestOfAllPathsCosts, ()) {
  std::mt19937 random(*rc::gen::arbitrary<unsigned>());
  const std::vector<PlaceCosts> places = random_problem(random, *rc::gen::inRange(1, 6), 5);
  const JoinScale scale;
  const Path path = best_path(places, scale);
  RC_ASSERT(path.chosen.size() == places.size());
  const double cost = path_cost(places, path.chosen, scale);
  RC_ASSERT(std::abs(cost - path.total) < 1e-4);
  RC_ASSERT(std::abs(cost - least_by_trying(places, scale)) < 1e-4);
}

RC_GTEST_PROP(BestPath, SkipsNoBestCandidate, ()) {  // many candidates, so that blocks of them are skipped
  std::mt19937 random(*rc::gen::arbitrary<unsigned>());
  const std::vector<PlaceCosts> places = random_problem(random, 3, 120);
  const JoinScale scale;
  const Path path = best_path(places, scale);
  RC_ASSERT(std::abs(path.total - path_cost(places, path.chosen, scale)) < 1e-4);
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t b = 0; b < places[1].size(); ++b) {  // the best path through each middle candidate
    double left = std::numeric_limits<double>::infinity();
    double right = left;
    for (std::size_t a = 0; a < places[0].size(); ++a) {
      left =
          std::min(left, static_cast<double>(places[0].own[a] + places[0].made_before[a] + places[1].added_before[a] +
                                             transition_cost(places[0], a, places[1], b, scale)));
    }
    for (std::size_t c = 0; c < places[2].size(); ++c) {
      right = std::min(right, static_cast<double>(places[2].own[c] + places[2].made_after[c] +
                                                  transition_cost(places[1], b, places[2], c, scale)));
    }
    least = std::min(least, left + static_cast<double>(places[1].own[b] + places[2].added_before[b]) + right);
  }
  RC_ASSERT(std::abs(path.total - least) < 1e-4);
}

RC_GTEST_PROP(BestPath, TakesTheEarlierTokenOfEqualOnes, ()) {
  std::mt19937 random(*rc::gen::arbitrary<unsigned>());
  const std::vector<PlaceCosts> places = random_problem(random, 1 + random() % 5, 40, true);
  const Path path = best_path(places, {});
  RC_ASSERT(path.chosen == std::vector<std::size_t>(places.size(), 0));
}

RC_GTEST_PROP(BestPath, NeverTakesADominatedCandidate, ()) {
  std::mt19937 random(*rc::gen::arbitrary<unsigned>());
  std::vector<PlaceCosts> places = random_problem(random, 3, 12);
  PlaceCosts& middle = places[1];
  middle.joins.clear();
  places[2].joins.clear();
  // A copy of a candidate with slightly higher cost, inserted first.
  const std::size_t original = random() % middle.size();
  std::vector<JoinPoint> begins = {middle.ends->begin(original)};
  std::vector<JoinPoint> ends = {middle.ends->end(original)};
  for (std::size_t i = 0; i < middle.size(); ++i) {
    begins.push_back(middle.ends->begin(i));
    ends.push_back(middle.ends->end(i));
  }
  middle.ends = std::make_shared<const JoinEnds>(begins, ends);
  const auto repeat = [&](auto& values, auto value) { values.insert(values.begin(), value); };
  repeat(middle.own, middle.own[original] + 0.01f);
  repeat(middle.made_before, middle.made_before[original]);
  repeat(middle.made_after, middle.made_after[original]);
  repeat(middle.kept, middle.kept[original]);
  repeat(places[2].added_before, places[2].added_before[original]);
  for (std::uint32_t& kept : places[2].kept) kept = PlaceCosts::kNone;
  RC_ASSERT(best_path(places, {}).chosen[1] != 0u);
}

std::vector<std::size_t> chosen_ahead(const std::vector<PlaceCosts>& places, std::size_t ahead) {
  PathAhead path({}, ahead);
  std::vector<std::size_t> chosen;
  for (const PlaceCosts& place : places) {
    if (const auto decided = path.push(place)) chosen.push_back(*decided);
  }
  for (const std::size_t rest : path.finish()) chosen.push_back(rest);
  return chosen;
}

RC_GTEST_PROP(PathAheadTest, IsTheBestPathWhereAllIsKnown, ()) {
  std::mt19937 random(*rc::gen::arbitrary<unsigned>());
  const std::vector<PlaceCosts> places = random_problem(random, 1 + random() % 6, 8);
  const std::vector<std::size_t> chosen = chosen_ahead(places, places.size());
  RC_ASSERT(std::abs(path_cost(places, chosen, {}) - best_path(places, {}).total) < 1e-4);
}

TEST(PathAheadTest, DecidesAPlaceOnceThreeMoreAreKnown) {
  std::mt19937 random(1);
  PathAhead path({});
  const std::vector<PlaceCosts> places = random_problem(random, 6, 4);
  for (std::size_t i = 0; i < places.size(); ++i) EXPECT_EQ(path.push(places[i]).has_value(), i >= 3) << i;
  EXPECT_EQ(path.finish().size(), 3u);
  EXPECT_TRUE(path.finish().empty());
  EXPECT_FALSE(path.push(places[0]).has_value());  // a new utterance
  EXPECT_EQ(path.finish().size(), 1u);
}

TEST(PathAheadTest, ThreePlacesAheadCostLittleMoreThanAll) {
  std::mt19937 random(7);
  double ahead_3 = 0;
  double ahead_1 = 0;
  double all = 0;
  for (int problem = 0; problem < 40; ++problem) {
    const std::vector<PlaceCosts> places = random_problem(random, 40, 20);
    all += best_path(places, {}).total;
    ahead_1 += path_cost(places, chosen_ahead(places, 1), {});
    ahead_3 += path_cost(places, chosen_ahead(places, 3), {});
  }
  RecordProperty("ahead_1", std::to_string(ahead_1 / all));
  RecordProperty("ahead_3", std::to_string(ahead_3 / all));
  EXPECT_GE(ahead_3, all - 1e-3);
  EXPECT_LT(ahead_3, 1.04 * all);
  EXPECT_LT(ahead_3, ahead_1);
}

TEST(BestPath, StaysExactInALongUtterance) {
  std::mt19937 random(3);
  const std::vector<PlaceCosts> places = random_problem(random, 20'000, 3);
  const Path path = best_path(places, {});
  EXPECT_NEAR(path.total, path_cost(places, path.chosen, {}), 0.05);
}

TEST(JoinLanes, CostsEqualTheTerms) {
  std::mt19937 random(5);
  std::vector<JoinPoint> begins;
  std::vector<JoinPoint> ends;
  for (int i = 0; i < 37; ++i) {
    begins.push_back(random_point(random));
    ends.push_back(random_point(random));
  }
  JoinScale scale;
  scale.weights.speed_limit = 2;  // so that some go faster
  const JoinEnds both(begins, ends);
  std::vector<std::uint32_t> order;
  for (std::uint32_t i = 37; i-- > 0;) order.push_back(i);
  JoinLanes lanes;
  lanes.place(both, order, scale);
  ASSERT_EQ(lanes.blocks(), 3u);
  std::array<float, JoinEnds::kLanes> before{};
  for (std::size_t lane = 0; lane < before.size(); ++lane) before[lane] = 0.1f * static_cast<float>(lane);
  for (const JoinPoint& begin : begins) {
    lanes.compare_with(begin);
    for (std::size_t block = 0; block < 3; ++block) {
      std::array<float, JoinEnds::kLanes> costs{};
      const float least = lanes.costs(block, before, 0.5f, costs);
      EXPECT_EQ(least, *std::min_element(costs.begin(), costs.end()));
      for (std::size_t lane = 0; lane < costs.size() && block * 16 + lane < order.size(); ++lane) {
        const JoinTerms terms =
            join_terms(ends[order[block * 16 + lane]], begin, scale.transition, scale.weights.speed_limit);
        const float whole = cost_of(terms, scale.weights.weights);
        EXPECT_NEAR(costs[lane] - 0.5f - before[lane], whole, 1e-4f * (1 + whole));
      }
    }
  }
}

}  // namespace
}  // namespace signweave
