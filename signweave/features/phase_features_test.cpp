#include "signweave/features/phase_features.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <cstring>

namespace signweave {
namespace {

constexpr FrameRate kFeatureRate{100, 1};
const SignerBody kBody{.shoulder_width = 0.4f,
                       .heights = {-9, -1.2f, -0.6f, -0.2f, 0.2f, 0.4f, 0.6f, 0.9f},
                       .near_reach = 0.8f,
                       .arm_length = 1.5f};

/// A right hand that moves to the signer's left with the given speed at each frame.
HandMotion moving(const std::vector<float>& speeds) {
  HandMotion motion{.range = {10, 10 + static_cast<std::int64_t>(speeds.size())}, .hands = {}, .hands_distance = {}};
  motion.hands[0].why_not = "no left wrist";
  float x = 0;
  for (const float speed : speeds) {
    HandFrame frame;
    frame.position = {x, 0, 0.5f};
    frame.velocity = {speed, 0, 0};
    frame.acceleration = {0, 2, 0};
    frame.curvature = 3;
    x += speed * 0.01f / kBody.shoulder_width;
    motion.hands[1].frames.push_back(frame);
  }
  return motion;
}

TEST(PhaseFeatures, OneHandsPathPeakAndProfile) {
  const HandMotion measured = moving({1, 1, 1, 3, 1, 1, 1, 1, 1});
  const PhaseFeatures features = features_over(measured, {10, 19}, kFeatureRate, kBody);
  EXPECT_TRUE(features.known);
  EXPECT_FALSE(features.hands[0].known);
  const HandOver& hand = features.hands[1];
  ASSERT_TRUE(hand.known);
  EXPECT_FLOAT_EQ(features.seconds, 0.09f);
  EXPECT_NEAR(hand.path_length, 0.10f, 1e-6);  // eight steps of a hundredth of a second, two of them faster
  EXPECT_NEAR(hand.displacement, 0.10f, 1e-6);
  EXPECT_FLOAT_EQ(hand.peak_speed, 3);
  EXPECT_FLOAT_EQ(hand.peak_time, 3.0f / 8);
  EXPECT_FLOAT_EQ(hand.mean_speed, 11.0f / 9);
  EXPECT_FLOAT_EQ(hand.mean_acceleration, 2);
  EXPECT_FLOAT_EQ(hand.mean_curvature, 3);
  EXPECT_FLOAT_EQ(hand.profile.front(), 1);
  EXPECT_FLOAT_EQ(hand.profile.back(), 1);
  EXPECT_NEAR(*std::ranges::max_element(hand.profile), 3, 0.5);
  EXPECT_EQ(hand.begin.zone, zone_of({0, 0, 0.5f}, kBody));
}

TEST(PhaseFeatures, APartIsMeasuredAtItsOwnEnds) {
  const HandMotion measured = moving({1, 2, 3, 4, 5});
  const PhaseFeatures features = features_over(measured, {12, 14}, kFeatureRate, kBody);
  EXPECT_FLOAT_EQ(features.hands[1].begin.velocity.x(), 3);
  EXPECT_FLOAT_EQ(features.hands[1].end.velocity.x(), 4);
  EXPECT_FLOAT_EQ(features.hands[1].begin.acceleration.y(), 2);
  EXPECT_FLOAT_EQ(features.hands[1].end.curvature, 3);
}

TEST(PhaseFeatures, OneFrameHasOneValueThroughout) {
  const PhaseFeatures features = features_over(moving({2}), {10, 11}, kFeatureRate, kBody);
  const HandOver& hand = features.hands[1];
  EXPECT_FLOAT_EQ(hand.path_length, 0);
  EXPECT_FLOAT_EQ(hand.peak_time, 0);
  for (const float speed : hand.profile) EXPECT_FLOAT_EQ(speed, 2);
}

TEST(PhaseFeatures, AMotionlessHandHasNoCurvature) {
  EXPECT_FLOAT_EQ(features_over(moving({0, 0, 0}), {10, 13}, kFeatureRate, kBody).hands[1].mean_curvature, 0);
}

TEST(PhaseFeatures, ABodyWithoutShouldersGivesAReasonAndNoValues) {
  const auto skeleton = std::make_shared<const Skeleton>(
      std::vector<Joint>{{"a", kNoJoint, {0, 1, 0}, true}, {"b", 0, {0, 1, 0}, false}}, std::vector<Tip>{});
  const Motion motion(skeleton, kFeatureRate, 20);
  const FrameClock clock{.frame_time = Seconds(0.01)};
  const std::array spans = {TimeSpan{0ms, 100ms}, TimeSpan{50ms, 50ms}, TimeSpan{900ms, 1000ms}};
  const RecordingFeatures features = measure_phases(motion, model_of(motion), spans, clock);
  EXPECT_THAT(features.why_not, testing::HasSubstr("shoulder"));
  ASSERT_EQ(features.phases.size(), 3u);
  EXPECT_FALSE(features.phases[0].known);
  EXPECT_FLOAT_EQ(features.phases[0].seconds, 0.1f);
  EXPECT_FLOAT_EQ(features.phases[1].seconds, 0);
  EXPECT_FLOAT_EQ(features.phases[2].seconds, 0) << "outside the motion";
}

RecordingFeatures stored_and_read(const RecordingFeatures& features) {
  ByteWriter out;
  encode(features, out);
  ByteReader in(out.bytes(), "test");
  return decode_features(in).value();
}

RC_GTEST_PROP(FeatureRecord, SurvivesStorage, (const std::vector<std::vector<std::uint8_t>>& speeds)) {
  RecordingFeatures features;
  features.why_not = speeds.empty() ? "nothing" : "";
  features.shoulder_width = 0.4f;
  features.noise = {std::vector<float>(speeds.size(), 0.01f), std::vector<float>(speeds.size() / 2, 0.002f)};
  for (const std::vector<std::uint8_t>& phase : speeds) {
    std::vector<float> numbers(phase.begin(), phase.end());
    features.phases.emplace_back();
    if (numbers.empty()) continue;
    HandMotion measured = moving(numbers);
    if (numbers.size() % 2 == 0) {
      measured.hands[0] = measured.hands[1];
      measured.hands_distance = numbers;
    }
    features.phases.back() = features_over(measured, measured.range, kFeatureRate, kBody);
  }
  const RecordingFeatures read = stored_and_read(features);
  RC_ASSERT(read.why_not == features.why_not);
  RC_ASSERT(read.shoulder_width == features.shoulder_width);
  RC_ASSERT(read.phases.size() == features.phases.size());
  RC_ASSERT(read.noise == features.noise);
  for (std::size_t i = 0; i < read.phases.size(); ++i) RC_ASSERT(nearly_same(read.phases[i], features.phases[i]));
  ByteWriter again;
  ByteWriter first;
  encode(read, again);
  encode(features, first);
  RC_ASSERT(again.bytes() == first.bytes());
}

TEST(FeatureRecord, EveryTruncationIsRefused) {
  RecordingFeatures features;
  const HandMotion measured = moving({1, 2});
  features.phases = {features_over(measured, measured.range, kFeatureRate, kBody)};
  ByteWriter out;
  encode(features, out);
  for (std::size_t size = 2; size < out.size(); ++size) {
    ByteReader in(ByteSpan(out.bytes()).first(size), "test");
    EXPECT_THROW(decode_features(in), Error) << size;
  }
}

TEST(FeatureRecord, ThePreviousVersionIsReadWithoutNoise) {
  RecordingFeatures features;
  const HandMotion measured = moving({1, 2});
  features.phases = {features_over(measured, measured.range, kFeatureRate, kBody)};
  ByteWriter out;
  encode(features, out);
  Bytes before(out.bytes().begin(), out.bytes().end() - 8);  // without the two noise counts
  before[0] = std::byte{kFeaturesWithoutNoise};
  ByteReader in(before, "test");
  const RecordingFeatures read = decode_features(in).value();
  ASSERT_EQ(read.phases.size(), 1u);
  EXPECT_TRUE(nearly_same(read.phases[0], features.phases[0]));
  EXPECT_TRUE(read.noise.rotations.empty());
}

TEST(FeatureRecord, NegativeNoiseIsRefused) {
  RecordingFeatures features;
  features.noise.rotations = {0.1f, -0.1f};
  ByteWriter out;
  encode(features, out);
  ByteReader in(out.bytes(), "test");
  EXPECT_THROW(decode_features(in), Error);
}

TEST(FeatureRecord, OtherVersionsGiveNulloptAndNonFiniteValuesAreRefused) {
  RecordingFeatures features;
  const HandMotion measured = moving({1, 2});
  features.phases = {features_over(measured, measured.range, kFeatureRate, kBody)};
  features.phases[0].hands_distance_end = NAN;
  ByteWriter out;
  encode(features, out);
  ByteReader in(out.bytes(), "test");
  EXPECT_THROW(decode_features(in), Error);
  Bytes other = out.bytes();
  other[0] = std::byte{0xff};
  ByteReader later(other, "test");
  EXPECT_FALSE(decode_features(later).has_value());
}

TEST(FeatureRecord, ADifferenceIsDetected) {
  const HandMotion measured = moving({1, 2, 1});
  const PhaseFeatures features = features_over(measured, measured.range, kFeatureRate, kBody);
  PhaseFeatures other = features;
  EXPECT_TRUE(nearly_same(features, other));
  other.hands[1].begin.position.x() += 0.01f;
  EXPECT_FALSE(nearly_same(features, other));
  other = features;
  other.hands[1].known = false;
  EXPECT_FALSE(nearly_same(features, other));
}

}  // namespace
}  // namespace signweave
