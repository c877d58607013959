// Tests of methods next to noisy frames, and that knowing the noise reduces their swing.

#include "signweave/evaluation/shake.h"

#include <gtest/gtest.h>

#include "signweave/evaluation/evaluate.h"
#include "signweave/evaluation/test_recording.h"

namespace signweave {
namespace {

/// The mean wrist error of a method in millimetres, over spans of two recordings with 4 mm of noise at their borders.
double wrist_error(std::string_view method, bool known) {
  std::vector<EvaluatedMotion> recordings = {lively("a", 0.4), lively("b", 1.9)};
  std::vector<EvaluatedSpan> spans;
  for (std::size_t i = 0; i < recordings.size(); ++i) {
    shake(recordings[i], 0.004, 1);
    const float noise = 0.01f;  // about 4 mm with these arms
    recordings[i].noise.rotations.assign(recordings[i].motion.skeleton().joint_count(), 0.0f);
    for (std::size_t joint = 0; known && joint < recordings[i].groups.roles.size(); ++joint) {
      const JointRole role = recordings[i].groups.roles[joint];
      if (role == JointRole::shoulder || role == JointRole::elbow) recordings[i].noise.rotations[joint] = noise;
    }
    for (std::int64_t begin = 40; begin < 200; begin += 20) {
      spans.push_back(span_at(recordings[i], i, {begin, begin + 25}, 0));
    }
  }
  const GapMethod* const methods[] = {find_gap_method(method)};
  double sum = 0;
  const std::vector<MethodScores> scores = evaluate_given(recordings, spans, methods);
  for (const SpanScores& one : scores.front().spans) {
    sum += one.at(HandChoice::moving, Measure::wrist).value;
  }
  return sum / static_cast<double>(spans.size());
}

TEST(Shake, AddsNoiseOnlyNextToSpans) {
  const EvaluatedMotion clean = lively("a", 0.4);
  EvaluatedMotion one = lively("a", 0.4);
  EvaluatedMotion other = lively("a", 0.4);
  shake(one, 0.002, 1);
  shake(other, 0.002, 1);
  ASSERT_NE(one.shaken, nullptr);
  for (std::size_t joint = 0; joint < clean.motion.skeleton().joint_count(); ++joint) {
    const JointRole role = clean.groups.roles[joint];
    const bool shaken = role == JointRole::shoulder || role == JointRole::elbow;
    EXPECT_EQ(one.motion.pose(50).rotations[joint].coeffs(), clean.motion.pose(50).rotations[joint].coeffs());
    EXPECT_EQ(one.shaken->pose(50).rotations[joint].coeffs() == clean.motion.pose(50).rotations[joint].coeffs(),
              !shaken);
    EXPECT_EQ(one.shaken->pose(50).rotations[joint].coeffs(), other.shaken->pose(50).rotations[joint].coeffs());
  }
}

TEST(Shake, KnowingTheNoiseImprovesWrists) {
  EXPECT_LT(wrist_error("kriging", true), 0.8 * wrist_error("kriging", false));
  EXPECT_LT(wrist_error("kriging", true), wrist_error("sine", true));
  EXPECT_LT(wrist_error("kriging", true), wrist_error("hermite", true));
}

}  // namespace
}  // namespace signweave
