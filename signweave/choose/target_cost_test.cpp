#include "signweave/choose/target_cost.h"

#include <gtest/gtest.h>

#include <random>

namespace signweave {
namespace {

SignJoin usual(std::mt19937& random) {
  std::uniform_real_distribution<float> little(-0.1f, 0.1f);
  SignJoin join{.stroke_seconds = 0.5f + 0.2f * little(random), .path = 0.6f + 0.5f * little(random)};
  join.begin.known = join.end.known = 127;
  for (std::size_t i = 0; i < JoinPoint::kVelocity; ++i) {
    join.begin.values[i] = little(random);
    join.end.values[i] = little(random);
  }
  return join;
}

std::vector<float> outliers(const std::vector<SignJoin>& joins) {
  std::vector<const SignJoin*> tokens;
  for (const SignJoin& join : joins) tokens.push_back(&join);
  return outliers_of(tokens);
}

TEST(Outliers, AreTokensFarFromTheMedian) {
  std::mt19937 random(1);
  std::vector<SignJoin> joins;
  for (int i = 0; i < 30; ++i) joins.push_back(usual(random));
  joins[3].stroke_seconds = 2;
  joins[7].path = 5;
  joins[11].begin.values[1] += 1;
  joins[13].end.values[3] += 1;
  joins[17].stroke_seconds = 0.05f;
  const std::vector<float> beyond = outliers(joins);
  for (std::size_t i = 0; i < joins.size(); ++i) {
    const bool odd = i == 3 || i == 7 || i == 11 || i == 13 || i == 17;
    EXPECT_EQ(beyond[i] > 0.75f, odd) << i << ' ' << beyond[i];
    EXPECT_LE(beyond[i], 4);
  }
}

TEST(Outliers, NoneExistAmongFewOrEqualTokens) {
  std::mt19937 random(2);
  std::vector<SignJoin> joins;
  for (std::size_t i = 0; i + 1 < kFewestTokens; ++i) joins.push_back(usual(random));
  joins[0].path = 9;
  EXPECT_EQ(outliers(joins), std::vector<float>(joins.size(), 0));
  joins.assign(20, joins[1]);
  EXPECT_EQ(outliers(joins), std::vector<float>(20, 0));
}

TEST(Outliers, UnknownTokensAreNoOutliers) {
  std::mt19937 random(3);
  std::vector<SignJoin> joins;
  for (int i = 0; i < 10; ++i) joins.push_back(usual(random));
  joins[4].begin.known = 0;
  joins[4].path = 9;
  std::vector<const SignJoin*> tokens(11, nullptr);
  for (std::size_t i = 0; i < joins.size(); ++i) tokens[i] = &joins[i];
  const std::vector<float> beyond = outliers_of(tokens);
  EXPECT_EQ(beyond[4], 0);
  EXPECT_EQ(beyond[10], 0);
}

TEST(DefectCost, CountsOnlyTheGivenFrames) {
  const std::vector<Defect> defects = {{.kind = DefectKind::jump, .frames = {100, 110}, .text = {}},
                                       {.kind = DefectKind::jump, .frames = {112, 113}, .text = {}},
                                       {.kind = DefectKind::t_pose, .frames = {0, 50}, .text = {}},
                                       {.kind = DefectKind::quaternion_flip, .frames = {}, .text = {}}};
  EXPECT_EQ(defect_cost(defects, {50, 100}), 0);
  EXPECT_EQ(defect_cost(defects, {90, 120}), cost_of(DefectKind::jump));  // the same kind counts once
  EXPECT_EQ(defect_cost(defects, {49, 101}), cost_of(DefectKind::jump) + cost_of(DefectKind::t_pose));
  const std::vector<Defect> whole = {{.kind = DefectKind::scale, .frames = {}, .text = {}}};
  EXPECT_EQ(defect_cost(whole, {5, 6}), cost_of(DefectKind::scale));
  EXPECT_GT(cost_of(DefectKind::not_finite), cost_of(DefectKind::t_pose));
}

}  // namespace
}  // namespace signweave
