#include "signweave/score/schedule.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>

namespace signweave {
namespace {

TEST(ScheduleTest, TakesTheEarliestMoments) {
  const std::vector<TimeConstraint> constraints = {{0, 1, 30}, {1, 2, 40}, {0, 3, 10}, {3, 2, 90}};
  EXPECT_EQ(schedule(std::vector<std::int64_t>{5, 0, 0, 0}, constraints).moments,
            (std::vector<std::int64_t>{5, 35, 105, 15}));
}

TEST(ScheduleTest, ATieMovesTheEarlierMoment) {
  const std::vector<TimeConstraint> constraints = {{0, 1, 30}, {1, 2, -50}, {2, 1, 50}};
  EXPECT_EQ(schedule(std::vector<std::int64_t>{0, 0, 7}, constraints).moments, (std::vector<std::int64_t>{0, 57, 7}));
}

TEST(ScheduleTest, WhatIsAddedLaterDoesNotMoveWhatWasBefore) {
  std::vector<TimeConstraint> constraints = {{0, 1, 30}, {1, 2, 40}};
  const std::vector<std::int64_t> before = schedule(std::vector<std::int64_t>{5, 0, 0}, constraints).moments;
  constraints.push_back({2, 3, 100});
  const std::vector<std::int64_t> after = schedule(std::vector<std::int64_t>{5, 0, 0, 0}, constraints).moments;
  EXPECT_TRUE(std::equal(before.begin(), before.end(), after.begin()));
}

TEST(ScheduleTest, AContradictionIsACycleOfItsConstraints) {
  const std::vector<TimeConstraint> constraints = {{0, 1, 30}, {1, 2, 20}, {2, 1, -10}, {2, 3, 5}};
  EXPECT_EQ(schedule(std::vector<std::int64_t>{0, 0, 0, 0}, constraints).contradiction,
            (std::vector<std::size_t>{1, 2}));
}

RC_GTEST_PROP(ScheduleTest, SatisfiesEveryConstraintOrNamesACycleThatCannotBeSatisfied, ()) {
  const auto moments = *rc::gen::inRange<std::size_t>(1, 9);
  std::vector<std::int64_t> earliest(moments);
  for (std::int64_t& one : earliest) one = *rc::gen::inRange(0, 100);
  std::vector<TimeConstraint> constraints(*rc::gen::inRange<std::size_t>(0, 20));
  for (TimeConstraint& one : constraints) {
    one = {*rc::gen::inRange<std::size_t>(0, moments), *rc::gen::inRange<std::size_t>(0, moments),
           *rc::gen::inRange(-60, 20)};
  }
  const Schedule found = schedule(earliest, constraints);
  if (!found.contradiction.empty()) {
    std::int64_t sum = 0;
    for (std::size_t i = 0; i < found.contradiction.size(); ++i) {
      const TimeConstraint& one = constraints[found.contradiction[i]];
      const TimeConstraint& next = constraints[found.contradiction[(i + 1) % found.contradiction.size()]];
      RC_ASSERT(one.to == next.from);
      sum += one.at_least;
    }
    RC_ASSERT(sum > 0);
    return;
  }
  for (const TimeConstraint& one : constraints) {
    RC_ASSERT(found.moments[one.to] >= found.moments[one.from] + one.at_least);
  }
  for (std::size_t i = 0; i < moments; ++i) {  // nothing can be earlier: a bound or a constraint is met exactly
    RC_ASSERT(found.moments[i] >= earliest[i]);
    RC_ASSERT(found.moments[i] == earliest[i] || std::ranges::any_of(constraints, [&](const TimeConstraint& one) {
                return one.to == i && found.moments[i] == found.moments[one.from] + one.at_least;
              }));
  }
}

}  // namespace
}  // namespace signweave
