#include "signweave/features/join.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "signweave/core/error.h"

namespace signweave {
namespace {

float& term(JoinTerms& terms, JoinTerm which) {
  return terms[static_cast<std::size_t>(which)];
}

PhaseFeatures phase_with_hands() {
  PhaseFeatures phase;
  phase.known = true;
  for (std::size_t side = 0; side < 2; ++side) {
    HandOver& hand = phase.hands[side];
    hand.known = true;
    hand.begin.position = {1, 2, 3};
    hand.end.position = {4, 5, 6};
    hand.end.velocity = {0.1f, 0.2f, 0.3f};
    hand.end.palm = Eigen::Vector3f::UnitX();
    hand.end.fingers = Eigen::Vector3f::UnitY();
    hand.end.handshape.values.fill(0.5f);
    hand.end.elbow = {0.7f, 0, 0};
  }
  phase.trunk_end.lean = Eigen::Vector3f::UnitY();
  phase.trunk_end.twist = 0.25f;
  return phase;
}

TEST(JoinPointTest, ContainsTheKnownValuesAtOneEndOfAPhase) {
  const JoinPoint end = join_point(phase_with_hands(), false);
  EXPECT_EQ(end.known, 127);
  EXPECT_EQ(end.values[JoinPoint::kPlace + 3], 4);
  EXPECT_EQ(end.values[JoinPoint::kVelocity + 5], 0.3f);
  EXPECT_EQ(end.values[JoinPoint::kDirection], 1);
  EXPECT_EQ(end.values[JoinPoint::kDirection + 6 + 4], 1);
  EXPECT_EQ(end.values[JoinPoint::kHandshape + 29], 0.5f);
  EXPECT_EQ(end.values[JoinPoint::kArms + 3], 0.7f);
  EXPECT_EQ(end.values[JoinPoint::kTrunk + 3], 0.25f);
  const JoinPoint begin = join_point(phase_with_hands(), true);  // no fingers, elbows or trunk there
  EXPECT_EQ(begin.known, JoinPoint::kHand | JoinPoint::kHand << 3);
  EXPECT_EQ(begin.values[JoinPoint::kPlace + 2], 3);
  EXPECT_EQ(join_point(PhaseFeatures{}, true).known, 0);
}

TEST(JoinTermsTest, AreSquaredDistancesOfValuesKnownOnBothSides) {
  JoinPoint a = join_point(phase_with_hands(), false);
  JoinPoint b = a;
  const float limit = 2;
  EXPECT_EQ(join_terms(a, b, Seconds(0.5), limit), JoinTerms{});
  b.values[JoinPoint::kPlace] += 2;  // left hand: in half a second, twice the limit
  b.values[JoinPoint::kHandshape] += 0.3f;
  b.values[JoinPoint::kTrunk + 3] += 0.1f;
  JoinTerms terms = join_terms(a, b, Seconds(0.5), limit);
  EXPECT_FLOAT_EQ(term(terms, JoinTerm::place), 4);
  EXPECT_FLOAT_EQ(term(terms, JoinTerm::speed), 3);  // 2² / 1² - 1
  EXPECT_NEAR(term(terms, JoinTerm::handshape), 0.09f / 15, 1e-6f);
  EXPECT_NEAR(term(terms, JoinTerm::trunk), 0.01f, 1e-6f);
  EXPECT_EQ(term(terms, JoinTerm::velocity), 0);
  terms = join_terms(a, b, Seconds(2), limit);  // enough time
  EXPECT_EQ(term(terms, JoinTerm::speed), 0);
  terms = join_terms(a, b, Seconds(0), limit);  // at least a tenth of a second counts
  EXPECT_NEAR(term(terms, JoinTerm::speed), 99, 1e-3f);
  b.known = static_cast<std::uint8_t>(b.known & ~JoinPoint::kHand);
  terms = join_terms(a, b, Seconds(0.5), limit);
  EXPECT_EQ(term(terms, JoinTerm::place), 0);
}

/// Recorded joins have a smaller place term; the handshape term is uninformative.
std::vector<JoinComparison> made_up(std::size_t pairs, std::uint32_t recordings) {
  std::mt19937 random(4);
  std::uniform_real_distribution<float> any(0, 1);
  std::vector<JoinComparison> comparisons;
  for (std::uint32_t pair = 0; pair < pairs; ++pair) {
    JoinComparison one{.recording = pair % recordings, .pair = pair};
    term(one.recorded, JoinTerm::place) = 0.5f * any(random);
    term(one.recorded, JoinTerm::handshape) = 0.01f * any(random);
    for (int other = 0; other < 3; ++other) {
      term(one.other, JoinTerm::place) = 0.2f + 0.8f * any(random);
      term(one.other, JoinTerm::handshape) = 0.01f * any(random);
      comparisons.push_back(one);
    }
  }
  return comparisons;
}

TEST(LearnJoinWeights, FavourTermsThatDistinguishRecordedNeighbours) {
  const JoinWeights learned = learn_join_weights(made_up(200, 8), 3);
  EXPECT_EQ(learned.pairs, 200u);
  EXPECT_EQ(learned.comparisons, 600u);
  EXPECT_EQ(learned.folds, 5u);
  EXPECT_EQ(learned.speed_limit, 3);
  EXPECT_GT(learned.wins, 0.85f);
  EXPECT_GT(learned.wins, learned.default_wins - 0.01f);
  // Relative to their mean values, place counts far more.
  const float place = 0.6f * learned.weights[static_cast<std::size_t>(JoinTerm::place)];
  const float handshape = 0.005f * learned.weights[static_cast<std::size_t>(JoinTerm::handshape)];
  EXPECT_GT(place, 5 * handshape);
  EXPECT_GE(handshape, 0);
  EXPECT_NEAR(place + handshape, 1, 0.35f);  // a random choice costs 1; terms that never occur are excluded
}

TEST(LearnJoinWeights, AreDeterministic) {
  EXPECT_EQ(learn_join_weights(made_up(50, 3), 3), learn_join_weights(made_up(50, 3), 3));
}

TEST(LearnJoinWeights, AreTheDefaultsWithoutPairsAndNearThemWithFew) {
  EXPECT_EQ(learn_join_weights({}, 3), JoinWeights{});
  const JoinWeights few = learn_join_weights(made_up(2, 1), 3);
  EXPECT_EQ(few.folds, 0u);
  const auto ratio = [](const JoinWeights& weights) {
    return weights.weights[static_cast<std::size_t>(JoinTerm::place)] /
           weights.weights[static_cast<std::size_t>(JoinTerm::handshape)];
  };
  EXPECT_NEAR(std::log(ratio(few) / ratio(JoinWeights{})), 0, std::log(4));
}

TEST(LearnJoinWeights, AreTheDefaultsIfTheseDoBetterAndAreBoundedForConstantTerms) {
  std::mt19937 random(6);
  std::uniform_real_distribution<float> any(0, 1);
  std::vector<JoinComparison> noise;
  for (std::uint32_t pair = 0; pair < 60; ++pair) {
    JoinComparison one{.recording = pair % 6, .pair = pair};
    for (std::size_t k = 0; k < kJoinTerms; ++k) {
      one.recorded[k] = 1e-4f * any(random);
      one.other[k] = 1e-4f * any(random);
    }
    noise.push_back(one);
  }
  const JoinWeights learned = learn_join_weights(noise, 3);
  EXPECT_GE(learned.wins, learned.default_wins);
  float sum = 0;  // cost of a random choice: 1 except for the minimum of `speed`
  for (std::size_t k = 0; k < kJoinTerms; ++k) sum += 0.5e-4f * learned.weights[k];
  EXPECT_NEAR(sum, 1, 0.1f);
  JoinTerms shares{};
  for (std::size_t k = 0; k < kJoinTerms; ++k) shares[k] = learned.weights[k] / JoinWeights{}.weights[k];
  const auto [least, most] = std::minmax_element(shares.begin(), shares.end());
  EXPECT_LT(*most, 30 * std::max(*least, 1e-3f * *most));
}

TEST(LearnJoinWeights, AreNeverNegative) {
  std::vector<JoinComparison> comparisons = made_up(200, 8);
  for (JoinComparison& one : comparisons) std::swap(one.recorded, one.other);  // larger distances are preferred
  const JoinWeights learned = learn_join_weights(comparisons, 3);
  for (const float weight : learned.weights) EXPECT_GE(weight, 0);
}

TEST(JoinWeightsRecord, SurvivesStorageAndRefusesInvalidValues) {
  const JoinWeights weights = learn_join_weights(made_up(20, 2), 3);
  ByteWriter out;
  encode(weights, out);
  ByteReader in(out.bytes(), "test");
  EXPECT_EQ(decode_join_weights(in), weights);
  for (const std::size_t at : {3u, 31u}) {  // the sign bits of a weight and of the limit
    Bytes bytes = out.bytes();
    bytes[at] |= std::byte{0x80};
    ByteReader damaged(bytes, "test");
    EXPECT_THROW(decode_join_weights(damaged), Error) << at;
  }
  ByteReader cut(ByteSpan(out.bytes()).first(40), "test");
  EXPECT_THROW(decode_join_weights(cut), Error);
}

}  // namespace
}  // namespace signweave
