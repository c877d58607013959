#include "signweave/choose/concatenate.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "signweave/core/error.h"
#include "signweave/motion/blend.h"
#include "signweave/score/test_motion.h"

namespace signweave {
namespace {

using testing_motion::angle;
using testing_motion::clip;
using testing_motion::motion_of;
using testing_motion::small_skeleton;

/// Every test below runs for each method.
class Concatenate : public testing::TestWithParam<std::string> {
 protected:
  ConcatenateOptions options(Milliseconds duration = 500ms) const {
    return {.method = find_transition_method(GetParam()), .duration = duration};
  }
};

bool same_up_to_sign(const Eigen::Quaternionf& a, const Eigen::Quaternionf& b) {
  return a.coeffs() == b.coeffs() || a.coeffs() == -b.coeffs();
}

TEST_P(Concatenate, StrokesAreBitIdentical) {
  const std::vector<MotionClip> clips = {clip("A", 0.1f, 20, 40, 25), clip("B", 0.8f, 30, 33, 20),
                                         clip("C", 1.7f, 15, 50, 40)};
  const Synthesis made = concatenate(clips, options());
  for (std::size_t i = 0; i < clips.size(); ++i) {
    const ShownClip& placed = made.clips[i];
    ASSERT_EQ(placed.core.size(), clips[i].core.size());
    for (std::int64_t k = 0; k < placed.core.size(); ++k) {
      const PoseView kept = made.motion.pose(placed.core.begin + k);
      const PoseView captured = motion_of(clips[i]).pose(clips[i].core.begin + k);
      for (std::size_t joint = 1; joint < kept.rotations.size(); ++joint) {  // the root is aligned
        EXPECT_TRUE(same_up_to_sign(kept.rotations[joint], captured.rotations[joint])) << i << ' ' << k << ' ' << joint;
      }
    }
  }
}

TEST_P(Concatenate, TransitionsHaveTheRequestedDuration) {
  const std::vector<MotionClip> clips = {clip("A", 0.1f, 20, 40, 25), clip("B", 0.8f, 30, 33, 20)};
  for (const Milliseconds duration : {10ms, 200ms, 735ms, 3'000ms}) {
    const Synthesis made = concatenate(clips, options(duration));
    ASSERT_EQ(made.junctions.size(), 1u);
    EXPECT_EQ(made.junctions[0].frames.size(), std::llround(static_cast<double>(duration.count()) / 10.0));
    EXPECT_EQ(made.junctions[0].frames.begin, made.clips[0].core.end);
    EXPECT_EQ(made.junctions[0].frames.end, made.clips[1].core.begin);
  }
}

TEST_P(Concatenate, APauseLengthensTheTransition) {
  std::vector<MotionClip> clips = {clip("A", 0.1f, 20, 40, 25), clip("B", 0.8f, 30, 33, 20)};
  clips[1].pause_before = 350ms;
  EXPECT_EQ(concatenate(clips, options()).junctions[0].frames.size(), 85);
}

TEST_P(Concatenate, EveryFrameHasItsSource) {
  const std::vector<MotionClip> clips = {clip("A", 0.1f, 20, 40, 25), clip("B", 0.8f, 30, 33, 20, {50, 1})};
  const Synthesis made = concatenate(clips, options());
  ASSERT_EQ(made.sources.size(), static_cast<std::size_t>(made.motion.frame_count()));
  Pose captured(made.motion.skeleton());
  std::size_t made_frames = 0;
  for (std::size_t frame = 0; frame < made.sources.size(); ++frame) {
    const FrameSource& source = made.sources[frame];
    if (source.clip == FrameSource::kNone) {
      ++made_frames;
      EXPECT_EQ(source.junction, 0);
      continue;
    }
    const MotionClip& from = clips[static_cast<std::size_t>(source.clip)];
    EXPECT_GE(source.frame, static_cast<double>(from.whole.begin));
    EXPECT_LT(source.frame, static_cast<double>(from.whole.end));
    sample(motion_of(from), source.frame, captured.view());
    const PoseView kept = made.motion.pose(static_cast<std::int64_t>(frame));
    for (std::size_t joint = 1; joint < kept.rotations.size(); ++joint) {
      EXPECT_TRUE(same_up_to_sign(kept.rotations[joint], captured.rotations[joint])) << frame << ' ' << joint;
    }
  }
  EXPECT_GT(made_frames, 0u);
}

TEST_P(Concatenate, NothingJumps) {
  const std::vector<MotionClip> clips = {clip("A", 0.1f, 20, 40, 25), clip("B", 0.8f, 30, 33, 20),
                                         clip("C", 1.7f, 0, 50, 0)};
  const Synthesis made = concatenate(clips, options(735ms));
  for (std::int64_t frame = 1; frame < made.motion.frame_count(); ++frame) {
    const PoseView before = made.motion.pose(frame - 1);
    const PoseView now = made.motion.pose(frame);
    for (std::size_t joint = 0; joint < now.rotations.size(); ++joint) {
      EXPECT_LT(angle(before.rotations[joint], now.rotations[joint]), 0.12) << frame << ' ' << joint;
      EXPECT_GE(before.rotations[joint].dot(now.rotations[joint]), 0.0f);
    }
    EXPECT_LT((now.translations[0] - before.translations[0]).norm(), 0.02f) << frame;
  }
}

TEST_P(Concatenate, MissingPhasesAreNoError) {
  const std::vector<MotionClip> clips = {clip("A", 0.1f, 0, 40, 0), clip("B", 0.8f, 0, 1, 0), clip("C", 1.1f, 0, 5, 0)};
  const Synthesis made = concatenate(clips, options());
  EXPECT_EQ(made.motion.frame_count(), 40 + 50 + 1 + 50 + 5);
  EXPECT_EQ(made.junctions[0].cut.retraction_frames, 0);
}

TEST_P(Concatenate, TheHighestRateWins) {
  const std::vector<MotionClip> clips = {clip("A", 0.1f, 10, 30, 10, {30, 1}), clip("B", 0.8f, 40, 120, 40, {120, 1})};
  const Synthesis made = concatenate(clips, options());
  EXPECT_EQ(made.motion.rate(), (FrameRate{120, 1}));
  EXPECT_EQ(made.clips[0].core.size(), 120);  // one second
  EXPECT_EQ(made.clips[1].core.size(), 120);
  EXPECT_DOUBLE_EQ(made.clips[0].step, 0.25);
  ConcatenateOptions slower = options();
  slower.rate = {60, 1};
  EXPECT_EQ(concatenate(clips, slower).clips[1].core.size(), 60);
}

TEST_P(Concatenate, AtAnotherRateAStrokeIsItsSourceInterpolatedToTheLastFrame) {
  const MotionClip slow = clip("A", 0.1f, 10, 20, 0, {50, 1});
  const Synthesis made = concatenate({slow, clip("B", 0.8f, 30, 33, 20)}, options());
  const Motion recording = testing_motion::moving(45, {50, 1}, 0.1f);
  Pose expected(recording.skeleton());
  const ShownClip& placed = made.clips[0];
  ASSERT_EQ(placed.core.size(), 40);
  for (std::int64_t k = 0; k < placed.core.size(); ++k) {
    sample(recording, static_cast<double>(slow.core.begin) + 0.5 * static_cast<double>(k), expected.view());
    const PoseView shown = made.motion.pose(placed.core.begin + k);
    for (std::size_t joint = 1; joint < shown.rotations.size(); ++joint) {
      EXPECT_LT(angle(shown.rotations[joint], expected.rotations[joint]), 1e-6) << k;
    }
  }
}

TEST_P(Concatenate, TempoScalesSignsAndTransitions) {
  const std::vector<MotionClip> clips = {clip("A", 0.1f, 20, 40, 25), clip("B", 0.8f, 30, 30, 20)};
  ConcatenateOptions twice = options(600ms);
  twice.tempo = 2;
  const Synthesis made = concatenate(clips, twice);
  EXPECT_EQ(made.clips[0].core.size(), 20);
  EXPECT_EQ(made.junctions[0].frames.size(), 30);
}

TEST_P(Concatenate, ManySignsDoNotDrift) {
  std::vector<MotionClip> clips;
  for (int i = 0; i < 1'000; ++i) {
    clips.push_back(clip("R" + std::to_string(i % 7), 0.1f + 0.37f * static_cast<float>(i % 7), 5, 8, 5));
  }
  const Synthesis made = concatenate(clips, options(100ms));
  const Standing home = standing_over(made.motion, made.clips[0].core);
  for (const ShownClip& placed : {made.clips[1], made.clips[500], made.clips.back()}) {
    const Standing there = standing_over(made.motion, placed.core);
    EXPECT_LT((there.position - home.position).norm(), 1e-4f);
    EXPECT_NEAR(there.heading, home.heading, 1e-3f);
  }
}

TEST_P(Concatenate, AlignmentCanBeDisabled) {
  const std::vector<MotionClip> clips = {clip("A", 0.1f, 20, 40, 25), clip("B", 0.8f, 30, 33, 20)};
  ConcatenateOptions none = options();
  none.alignment = Alignment::none;
  const Synthesis made = concatenate(clips, none);
  const PoseView kept = made.motion.pose(made.clips[1].core.begin);
  const PoseView captured = motion_of(clips[1]).pose(clips[1].core.begin);
  EXPECT_TRUE(same_up_to_sign(kept.rotations[0], captured.rotations[0]));
  EXPECT_EQ(kept.translations[0], captured.translations[0]);
}

TEST_P(Concatenate, OffsetsMayDifferAndTheFirstAreUsed) {
  const std::vector<MotionClip> clips = {clip("A", 0.1f, 20, 40, 25, {100, 1}, small_skeleton(0.3f)),
                                         clip("B", 0.8f, 30, 33, 20, {100, 1}, small_skeleton(0.35f))};
  const Synthesis made = concatenate(clips, options());
  EXPECT_FLOAT_EQ(made.motion.skeleton().joint(2).offset.x(), 0.3f);
}

TEST_P(Concatenate, OtherJointsAreRejectedByName) {
  const auto other = std::make_shared<const Skeleton>(std::vector<Joint>{{"Hips", kNoJoint, {0, 1, 0}, true},
                                                                         {"Spine", 0, {0, 0.3f, 0}, false},
                                                                         {"LeftArm", 1, {0.3f, 0, 0}, false},
                                                                         {"Hand", 2, {0.3f, 0, 0}, false}},
                                                      std::vector<Tip>{});
  const std::vector<MotionClip> clips = {clip("A", 0.1f, 20, 40, 25), clip("B", 0.8f, 30, 33, 20, {100, 1}, other)};
  try {
    concatenate(clips, options());
    FAIL() << "no error";
  } catch (const Error& error) {
    EXPECT_THAT(error.what(), testing::HasSubstr("'Arm' in one and 'LeftArm' in the other"));
  }
}

TEST_P(Concatenate, PhasesCoverTheirSigns) {
  const std::vector<MotionClip> clips = {clip("A", 0.1f, 20, 40, 25), clip("B", 0.8f, 30, 33, 20),
                                         clip("C", 1.7f, 0, 50, 0)};
  const Synthesis made = concatenate(clips, options());
  ASSERT_EQ(made.signs.size(), 3u);
  for (std::size_t i = 0; i < made.signs.size(); ++i) {
    const Sign& sign = made.signs[i].sign;
    ASSERT_FALSE(sign.phases.empty());
    EXPECT_EQ(sign.phases.front().span.begin, sign.span.begin);
    EXPECT_EQ(sign.phases.back().span.end, sign.span.end);
    for (std::size_t p = 1; p < sign.phases.size(); ++p)
      EXPECT_EQ(sign.phases[p - 1].span.end, sign.phases[p].span.begin);
    EXPECT_EQ(sign.stroke_span(), span_of(made.clips[i].core, {Seconds(0.01), Seconds(0)}));
    if (i > 0) {
      EXPECT_EQ(made.signs[i - 1].sign.span.end, sign.span.begin);
    }
  }
  EXPECT_EQ(made.signs[0].recorded, clips[0].signs[0].span);
}

TEST(Crossfading, DoesNotJumpIfTheSidesPassHalfATurnApart) {
  // One joint rotates from 70 to 110 degrees on one side and from -70 to -110 on the other: 140 to 220 degrees apart.
  const auto turning = [](const std::string& name, float sense) {
    MotionClip result = clip(name, 0.0f, 60, 20, 60);
    Motion motion = motion_of(result);
    for (std::int64_t at = result.whole.begin; at < motion.frame_count(); ++at) {
      const std::int64_t frame = at - result.whole.begin;
      const float part = static_cast<float>(frame % 80) / 59.0f;
      const float degrees = frame < 60   ? 70.0f + 40.0f * part
                            : frame < 80 ? 110.0f
                                         : 70.0f + 40.0f * (static_cast<float>(frame - 80) / 59.0f);
      for (Eigen::Quaternionf& q : motion.pose(at).rotations) q.setIdentity();
      motion.pose(at).rotations[2] =
          Eigen::AngleAxisf(sense * degrees * static_cast<float>(EIGEN_PI) / 180.0f, Eigen::Vector3f::UnitX());
    }
    result.source = std::make_shared<MemorySource>(std::move(motion));
    return result;
  };
  const Synthesis made = concatenate({turning("A", 1.0f), turning("B", -1.0f)},
                                     {.method = find_transition_method("overlap"), .duration = 600ms});
  const Junction& junction = made.junctions[0];
  ASSERT_EQ(junction.cut.overlap(), 20);
  for (std::int64_t frame = junction.frames.begin + 1; frame < junction.frames.end; ++frame) {
    EXPECT_LT(angle(made.motion.pose(frame - 1).rotations[2], made.motion.pose(frame).rotations[2]), 0.4) << frame;
  }
}

TEST_P(Concatenate, HoldsAreKeptAsAnnotated) {
  std::vector<MotionClip> clips = {clip("A", 0.1f, 20, 40, 60), clip("B", 0.8f, 30, 33, 20)};
  Sign& sign = clips[0].signs[0];
  sign.phases.back().span.begin += 100ms;  // the hands wait before they leave
  sign.phases.insert(sign.phases.end() - 1,
                     {PhaseKind::hold, {sign.phases[1].span.end, sign.phases[1].span.end + 100ms}, "Hold", {}});
  const Synthesis made = concatenate(clips, options());
  const std::vector<Phase>& phases = made.signs[0].sign.phases;
  const std::int64_t kept = std::min<std::int64_t>(10, made.junctions[0].cut.kept_after());
  if (kept == 0) {  // the cut is before it
    ASSERT_EQ(phases.size(), 3u);
    EXPECT_EQ(phases[2].kind, PhaseKind::retraction);
    return;
  }
  ASSERT_EQ(phases.size(), 4u);
  EXPECT_EQ(phases[2].kind, PhaseKind::hold);
  EXPECT_EQ(phases[2].span.duration(), kept * 10ms);
  EXPECT_EQ(phases[3].kind, PhaseKind::retraction);
  EXPECT_EQ(phases[3].span.end, made.signs[0].sign.span.end);
}

TEST_P(Concatenate, APieceCutThroughASignKeepsItsAnnotation) {
  std::vector<MotionClip> clips = {clip("A", 0.1f, 20, 100, 25), clip("B", 0.8f, 30, 33, 20)};
  Sign& sign = clips[0].signs[0];  // its stroke ends long before the piece
  sign.phases[1].span.end = sign.phases[1].span.begin + 400ms;
  sign.phases.back().span.begin = sign.phases[1].span.end;
  const Synthesis made = concatenate(clips, options());
  EXPECT_EQ(made.signs[0].sign.stroke_span()->duration(), 400ms);
}

TEST_P(Concatenate, TheReferenceDefinesSkeletonAndStanding) {
  const std::vector<MotionClip> clips = {clip("A", 0.1f, 20, 40, 25, {100, 1}, small_skeleton(0.3f)),
                                         clip("B", 0.8f, 30, 33, 20, {100, 1}, small_skeleton(0.35f))};
  ConcatenateOptions second = options();
  second.reference = 1;
  const Synthesis made = concatenate(clips, second);
  EXPECT_FLOAT_EQ(made.motion.skeleton().joint(2).offset.x(), 0.35f);
  EXPECT_EQ(made.motion.pose(made.clips[1].core.begin).translations[0],
            motion_of(clips[1]).pose(clips[1].core.begin).translations[0]);
}

/// The clip with a face track of constant value.
MotionClip with_track(MotionClip clip, const std::string& name, float value) {
  Motion motion = motion_of(clip);
  motion.add_track({name, std::vector<float>(static_cast<std::size_t>(motion.frame_count()), value)});
  clip.source = std::make_shared<MemorySource>(std::move(motion));
  return clip;
}

TEST_P(Concatenate, ScalarTracksArePreserved) {
  const std::vector<MotionClip> clips = {with_track(clip("A", 0.1f, 20, 40, 25), "jawOpen", 0.8f),
                                         with_track(clip("B", 0.8f, 30, 33, 20, {50, 1}), "browInnerUp", 0.5f)};
  const Synthesis made = concatenate(clips, options());
  ASSERT_EQ(made.motion.tracks().size(), 2u);
  const ScalarTrack& jaw = made.motion.tracks()[0];
  const ScalarTrack& brow = made.motion.tracks()[1];
  EXPECT_EQ(jaw.name, "jawOpen");
  EXPECT_EQ(brow.name, "browInnerUp");
  ASSERT_EQ(jaw.values.size(), static_cast<std::size_t>(made.motion.frame_count()));
  for (const ShownClip& placed : made.clips) {
    for (std::int64_t frame = placed.core.begin; frame < placed.core.end; ++frame) {
      const bool first = &placed == &made.clips[0];
      EXPECT_EQ(jaw.values[static_cast<std::size_t>(frame)], first ? 0.8f : 0.0f);  // bit for bit in a stroke
      EXPECT_EQ(brow.values[static_cast<std::size_t>(frame)], first ? 0.0f : 0.5f);
    }
  }
  for (std::size_t frame = 1; frame < jaw.values.size(); ++frame) {
    EXPECT_LE(jaw.values[frame], jaw.values[frame - 1]);
    EXPECT_LT(jaw.values[frame - 1] - jaw.values[frame], 0.15f);
  }
}

TEST_P(Concatenate, SignsOfQuaternionsInASourceDoNotMatter) {
  const std::vector<MotionClip> clips = {clip("A", 0.1f, 40, 40, 45), clip("B", 0.8f, 40, 33, 40)};
  std::vector<MotionClip> flipped = clips;
  for (MotionClip& one : flipped) {
    Motion motion = motion_of(one);
    for (std::int64_t frame = 0; frame < motion.frame_count(); frame += 2) {
      for (Eigen::Quaternionf& q : motion.pose(frame).rotations) q.coeffs() *= -1.0f;
    }
    one.source = std::make_shared<MemorySource>(std::move(motion));
  }
  const Synthesis expected = concatenate(clips, options());
  const Synthesis made = concatenate(flipped, options());
  for (std::size_t i = 0; i < expected.motion.rotations().size(); ++i) {
    ASSERT_LT(angle(made.motion.rotations()[i], expected.motion.rotations()[i]), 1e-5) << i;
  }
}

TEST_P(Concatenate, RatesThatNeedATerabyteAreRejected) {
  const std::vector<MotionClip> clips = {clip("slow", 0.1f, 2, 4, 2, {1, 10'000}),
                                         clip("fast", 0.8f, 2, 4, 2, {1'000'000, 1})};
  try {
    concatenate(clips, options());
    FAIL() << "no error";
  } catch (const Error& error) {
    EXPECT_THAT(error.what(), testing::HasSubstr("('slow' has"));
  }
}

TEST_P(Concatenate, AStrokeShorterThanAFrameHasAtLeastAMillisecond) {
  MotionClip one = clip("A", 0.1f, 20, 40, 25, {30, 1});
  const Milliseconds begin = one.signs[0].phases[1].span.begin;
  one.signs[0].phases[1].span.end = begin + 8ms;
  one.signs[0].phases[2].span.begin = begin + 8ms;
  Sign second = one.signs[0];
  second.span = {begin + 60ms, one.signs[0].span.end};
  second.phases = {{PhaseKind::stroke, second.span, "Stroke", {}}};
  one.signs[0].span.end = begin + 60ms;
  one.signs[0].phases[2].span.end = begin + 60ms;
  one.signs.push_back(second);
  const Synthesis made = concatenate({clip("B", 0.8f, 20, 33, 20, {30, 1}), one}, options());
  ASSERT_EQ(made.signs.size(), 3u);
  const auto stroke = made.signs[1].sign.stroke_span();
  ASSERT_TRUE(stroke);
  EXPECT_GE(stroke->duration(), 1ms);
}

TEST_P(Concatenate, TheMemoryOfAnOlderResultIsReused) {
  const std::vector<MotionClip> clips = {clip("A", 0.1f, 20, 40, 25), clip("B", 0.8f, 30, 33, 20)};
  Synthesis first = concatenate(clips, options());
  const auto* const memory = first.motion.rotations().data();
  const Motion expected = first.motion;
  const Synthesis second = concatenate(clips, options(), std::move(first));
  EXPECT_EQ(second.motion.rotations().data(), memory);
  ASSERT_EQ(second.motion.frame_count(), expected.frame_count());
  for (std::size_t i = 0; i < expected.rotations().size(); ++i) {
    ASSERT_EQ(second.motion.rotations()[i].coeffs(), expected.rotations()[i].coeffs());
  }
}

TEST(ConcatenateFaults, NothingToJoin) {
  EXPECT_THROW(concatenate({}, {}), Error);
}

std::vector<std::string> every_method() {
  std::vector<std::string> methods;
  for (const TransitionMethod& method : transition_methods()) methods.emplace_back(method.name);
  return methods;
}

INSTANTIATE_TEST_SUITE_P(EveryMethod, Concatenate, testing::ValuesIn(every_method()),
                         [](const auto& tested) { return tested.param; });

}  // namespace
}  // namespace signweave
