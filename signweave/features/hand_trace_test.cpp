#include "signweave/features/hand_trace.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <random>

#include "signweave/features/phase_features.h"
#include "signweave/rig/test_rig.h"

namespace signweave {
namespace {

using Eigen::Vector3f;

SignerModel model_for(const Motion& motion) {
  SignerModel model{.rig = rig_of_signer(motion.skeleton()), .body = {}};
  model.body = signer_body(motion, model.rig);
  return model;
}

TEST(HandTrace, MatchesTheMeasurementWithinItsResolution) {
  const Motion motion = moving(whole_person(), 150, 3, {60, 1});
  const SignerModel model = model_for(motion);
  const HandTrace trace = trace_hands(motion, model);
  ASSERT_EQ(trace.why_not, "");
  EXPECT_EQ(trace.step, 1);
  EXPECT_EQ(trace.samples(), 150U);
  EXPECT_EQ(trace.shoulder_width, model.body->shoulder_width);
  const HandMotion measured = measure_hands(motion, model, {0, 150});
  for (const Side side : kSides) {
    const PointTrack track = trace.track(palm_on(side), {20, 90});
    ASSERT_EQ(track.size(), 70U);
    for (std::size_t i = 0; i < track.size(); ++i) {
      const HandFrame& frame = measured.hands[static_cast<std::size_t>(side)].frames[20 + i];
      EXPECT_LE((track[i].position - frame.position).cwiseAbs().maxCoeff(), 0.51f * TraceSample::kPosition);
      EXPECT_LE((track[i].velocity - frame.velocity).cwiseAbs().maxCoeff(), 0.51f * TraceSample::kVelocity);
      EXPECT_NEAR(track[i].acceleration, frame.acceleration.norm(), 0.51f * TraceSample::kAcceleration);
      EXPECT_NEAR(track[i].state.openness, frame.openness, 0.5f / 127 + 1e-6f);
      EXPECT_EQ(track[i].state.contact, frame.contact);
      EXPECT_EQ(track[i].state.palm, facing_of(frame.palm));
      EXPECT_EQ(track[i].state.fingers, facing_of(frame.fingers));
    }
  }
  EXPECT_FALSE(trace[TracePoint::left_index].empty());
  EXPECT_NE(trace[TracePoint::left_index], trace[TracePoint::left_palm]);
}

TEST(HandTrace, KeepsAtMostSixtySamplesASecondAndTheLastFrame) {
  const Motion motion = moving(whole_person(), 98, 5, {120, 1});
  const SignerModel model = model_for(motion);
  const HandTrace trace = trace_hands(motion, model);
  EXPECT_EQ(trace.step, 2);
  EXPECT_EQ(trace.samples(), 50U);  // 0, 2, … 96, and 97
  const HandMotion measured = measure_hands(motion, model, {0, 98});
  const PointTrack track = trace.track(TracePoint::right_palm, {0, 98});
  const auto& frames = measured.hands[1].frames;
  for (const std::size_t kept : {0U, 2U, 96U, 97U}) {
    EXPECT_LE((track[kept].position - frames[kept].position).norm(), TraceSample::kPosition);
  }
  // Halfway between two samples.
  const Vector3f middle = 0.5f * (frames[10].position + frames[12].position);
  EXPECT_LE((track[11].position - middle).norm(), TraceSample::kPosition);
}

TEST(HandTrace, OverSomeFramesItGivesTheValuesOfTheFeatures) {
  const Motion motion = moving(whole_person(), 120, 7, {60, 1});
  const SignerModel model = model_for(motion);
  const HandMotion measured = measure_hands(motion, model, {0, 120});
  const PhaseFeatures features = features_over(measured, {30, 80}, motion.rate(), *model.body);
  const HandTrace trace = trace_hands(motion, model);
  for (const Side side : kSides) {
    const HandOver& hand = features.hands[static_cast<std::size_t>(side)];
    const PointTrack track = trace.track(palm_on(side), {30, 80});
    const PointOver point = over(track, trace.rate, trace.shoulder_width);
    EXPECT_NEAR(point.peak_speed, hand.peak_speed, 2e-3);
    EXPECT_NEAR(point.mean_speed, hand.mean_speed, 2e-3);
    EXPECT_NEAR(point.mean_acceleration, hand.mean_acceleration, 0.02);
    EXPECT_GE(point.peak_acceleration, point.mean_acceleration);
    EXPECT_NEAR(point.path_length, hand.path_length, 2e-3);
    EXPECT_NEAR(point.displacement, hand.displacement, 1e-3);
    EXPECT_LE((point.end.position - hand.end.position).norm(), 1e-3);
  }
}

TEST(HandTrace, SurvivesStorage) {
  const Motion motion = moving(whole_person(), 40, 9, {25, 1});
  const HandTrace trace = trace_hands(motion, model_for(motion));
  ByteWriter out;
  encode(trace, out);
  ByteReader in(out.bytes(), "trace");
  const std::optional<HandTrace> back = decode_trace(in);
  ASSERT_TRUE(back);
  EXPECT_EQ(back->points, trace.points);
  EXPECT_EQ(back->frames, trace.frames);
  EXPECT_EQ(back->step, trace.step);
  EXPECT_EQ(back->rate, trace.rate);
  EXPECT_EQ(back->shoulder_width, trace.shoulder_width);
  for (std::size_t i = 1; i < trace.body.heights.size(); ++i) {
    EXPECT_EQ(back->body.heights[i], trace.body.heights[i]);
  }
  EXPECT_EQ(back->body.near_reach, trace.body.near_reach);

  Bytes other = out.bytes();
  other[0] = std::byte{0xFF};
  ByteReader later(other, "trace");
  EXPECT_FALSE(decode_trace(later));
}

/// Decodes the encoded `trace`, and throws what that throws.
void read_back(const HandTrace& trace) {
  ByteWriter out;
  encode(trace, out);
  ByteReader in(out.bytes(), "trace");
  decode_trace(in);
}

TEST(HandTrace, ImpossibleFrameCountsAreRefused) {
  const auto damaged = [](std::int64_t frames, std::int64_t step) {
    return HandTrace{.rate = {25, 1}, .frames = frames, .step = step};
  };
  constexpr std::int64_t kMost = std::numeric_limits<std::int64_t>::max();
  EXPECT_NO_THROW(read_back(damaged(100, 2)));
  for (const auto& [frames, step] : {std::pair<std::int64_t, std::int64_t>{-1, 1},
                                     {kMost, 1},
                                     {100, 0},
                                     {100, -2},
                                     {100, std::int64_t{std::numeric_limits<std::int32_t>::max()} + 1}}) {
    const HandTrace trace = damaged(frames, step);
    EXPECT_THAT([&] { read_back(trace); },
                testing::Throws<Error>(
                    testing::Property(&Error::what, testing::HasSubstr("the frame count or the step is out of range"))))
        << frames << ' ' << step;
  }
}

TEST(HandTrace, TooFewSamplesAreRefusedBeforeAllocation) {
  HandTrace trace{.rate = {25, 1}, .frames = 5, .step = 1};
  trace.points[1].resize(5);
  EXPECT_NO_THROW(read_back(trace));
  // 2^60 samples have 2^64 bytes, which is 0 in 64-bit arithmetic.
  for (const std::int64_t frames : {std::int64_t{6}, std::int64_t{1} << 60}) {
    trace.frames = frames;
    EXPECT_THAT([&] { read_back(trace); },
                testing::Throws<Error>(testing::Property(&Error::what, testing::HasSubstr("it has too few samples"))))
        << frames;
  }
}

RC_GTEST_PROP(HandTrace, DamagedBytesAreRefusedOrRead, (std::uint32_t seed)) {
  static const Bytes sound = [] {
    const Motion motion = moving(whole_person(), 12, 9, {25, 1});
    ByteWriter out;
    encode(trace_hands(motion, model_for(motion)), out);
    return out.take();
  }();
  std::mt19937 random(seed);
  Bytes bytes = sound;
  for (int i = 0; i < 3; ++i) bytes[random() % std::min<std::size_t>(bytes.size(), 120)] = std::byte(random() & 0xFFU);
  if (random() % 3 == 0) bytes.resize(random() % bytes.size());
  try {
    ByteReader in(bytes, "trace");
    const std::optional<HandTrace> trace = decode_trace(in);
    if (trace && trace->frames > 0) trace->track(TracePoint::left_palm, {0, std::min<std::int64_t>(trace->frames, 9)});
  } catch (const Error& error) {
    RC_ASSERT(error.code() == ErrorCode::corrupt);
  }
}

TEST(HandTrace, WithoutShouldersItGivesTheReason) {
  const Motion motion = moving(whole_person(), 10, 1);
  SignerModel model = model_for(motion);
  model.rig[Part::left_upper_arm] = {};
  model.body.reset();
  const HandTrace trace = trace_hands(motion, model);
  EXPECT_THAT(trace.why_not, testing::HasSubstr("no left shoulder"));
  EXPECT_EQ(trace.samples(), 0U);
  ByteWriter out;
  encode(trace, out);
  ByteReader in(out.bytes(), "trace");
  EXPECT_EQ(decode_trace(in)->why_not, trace.why_not);
}

TEST(HandTrace, AHandThatTheRigLacksIsNotTraced) {
  const Motion motion = moving(whole_person(), 10, 1);
  SignerModel model = model_for(motion);
  model.rig[Part::left_hand] = {};
  model.rig[finger_part(Side::right, Finger::index, FingerPoint::tip)] = {};
  const HandTrace trace = trace_hands(motion, model);
  EXPECT_TRUE(trace[TracePoint::left_palm].empty());
  EXPECT_FALSE(trace[TracePoint::right_palm].empty());
  EXPECT_TRUE(trace[TracePoint::right_index].empty());
  EXPECT_TRUE(trace.track(TracePoint::left_palm, {0, 5}).empty());
  ByteWriter out;
  encode(trace, out);
  ByteReader in(out.bytes(), "trace");
  EXPECT_EQ(decode_trace(in)->points, trace.points);
}

TEST(HandTrace, NonFiniteValuesStayNonFinite) {
  Motion motion = moving(whole_person(), 30, 2);
  const SignerModel model = model_for(motion);
  const auto arm = static_cast<std::size_t>(model.rig[Part::right_forearm].joint);
  motion.pose(15).rotations[arm].coeffs().setConstant(std::numeric_limits<float>::quiet_NaN());
  const HandTrace trace = trace_hands(motion, model);
  const PointTrack track = trace.track(TracePoint::right_palm, {0, 30});
  EXPECT_FALSE(track[15].position.allFinite());
  EXPECT_TRUE(track[2].position.allFinite());
  EXPECT_TRUE(std::isnan(over(track, trace.rate, trace.shoulder_width).path_length));
}

TEST(PointTrack, APartOfAMotionGivesTheValuesOfTheWhole) {
  const Motion motion = moving(whole_person(), 60, 4);
  const SignerModel model = model_for(motion);
  constexpr std::array kParts = {Part::right_forearm, Part::head};
  const std::vector<PointTrack> whole = track_points(motion, model, kParts, {0, 60});
  const std::vector<PointTrack> part = track_points(motion, model, kParts, {20, 33});
  ASSERT_EQ(whole.size(), 2U);
  ASSERT_EQ(part[0].size(), 13U);
  for (std::size_t i = 0; i < 13; ++i) {
    for (std::size_t which = 0; which < 2; ++which) {
      EXPECT_EQ(part[which][i].position, whole[which][20 + i].position);
      EXPECT_EQ(part[which][i].velocity, whole[which][20 + i].velocity);
      EXPECT_EQ(part[which][i].acceleration, whole[which][20 + i].acceleration);
    }
  }
  // The elbow as in the hands' own measurement.
  const HandMotion measured = measure_hands(motion, model, {20, 33});
  EXPECT_LE((measured.hands[1].frames[5].elbow - part[0][5].position).norm(), 1e-6f);
}

TEST(PointTrack, AMissingPartHasNoTrack) {
  const Motion motion = moving(whole_person(), 10, 4);
  SignerModel model = model_for(motion);
  model.rig[Part::head] = {};
  constexpr std::array kParts = {Part::right_forearm, Part::head};
  const std::vector<PointTrack> tracks = track_points(motion, model, kParts, {0, 10});
  EXPECT_EQ(tracks[0].size(), 10U);
  EXPECT_TRUE(tracks[1].empty());
  model.body.reset();
  EXPECT_TRUE(track_points(motion, model, kParts, {0, 10})[0].empty());
}

TEST(PointTrack, SpeedsAndPathsCoverAllFrames) {
  PointTrack track(3);
  track[0] = {.velocity = {1, 0, 0}, .acceleration = 1, .state = {.contact = Contact::head}};
  track[1] = {.position = {0.5f, 0, 0}, .velocity = {0, 3, 0}, .acceleration = 5};
  track[2] = {.position = {0, 2, 0}, .velocity = {2, 0, 0}, .acceleration = 3, .state = {.contact = Contact::torso}};
  const PointOver all = over(track, {10, 1}, 0.4f);
  EXPECT_FLOAT_EQ(all.peak_speed, 3);
  EXPECT_FLOAT_EQ(all.mean_speed, 2);
  EXPECT_FLOAT_EQ(all.peak_acceleration, 5);
  EXPECT_FLOAT_EQ(all.mean_acceleration, 3);
  EXPECT_FLOAT_EQ(all.path_length, 0.45f);  // two steps of a tenth of a second, at 2 and 2.5 m/s
  EXPECT_FLOAT_EQ(all.displacement, 0.8f);
  EXPECT_EQ(all.contact, Contact::head | Contact::torso);
  EXPECT_EQ(all.end.position.y(), 2);
}

TEST(PointTrack, FacingIsTheNearestAxis) {
  EXPECT_EQ(facing_of({0, 0, 0}), Facing::unknown);
  EXPECT_EQ(facing_of({0.9f, 0.1f, 0.2f}), Facing::left);
  EXPECT_EQ(facing_of({-0.9f, 0.1f, 0.2f}), Facing::right);
  EXPECT_EQ(facing_of({0.2f, -0.9f, 0.2f}), Facing::down);
  EXPECT_EQ(facing_of({0.2f, 0.3f, 0.2f}), Facing::up);
  EXPECT_EQ(facing_of({0.2f, 0.3f, -0.5f}), Facing::back);
  EXPECT_EQ(facing_of({0.2f, 0.3f, 0.5f}), Facing::forward);
}

}  // namespace
}  // namespace signweave
