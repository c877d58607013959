// Tests of junctions with their own method, duration or tempo.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "signweave/choose/concatenate.h"
#include "signweave/score/test_motion.h"

namespace signweave {
namespace {

using testing_motion::angle;
using testing_motion::clip;
using testing_motion::motion_of;

/// Every test below runs for each method.
class JunctionsOf : public testing::TestWithParam<std::string> {
 protected:
  const TransitionMethod* method() const { return find_transition_method(GetParam()); }
};

std::vector<MotionClip> some_clips() {
  std::vector<MotionClip> clips = {clip("A", 0.1f, 20, 40, 25), clip("B", 0.8f, 30, 33, 40), clip("C", 1.7f, 60, 50, 0),
                                   clip("D", 2.9f, 0, 20, 30, {50, 1})};
  clips[2].pause_before = 350ms;
  return clips;
}

TEST_P(JunctionsOf, NamingAllWithTheCommonChoiceChangesNothing) {
  for (const double tempo : {1.0, 1.3}) {
    const ConcatenateOptions of_all{.method = method(), .duration = 480ms, .tempo = tempo};
    const Synthesis expected = concatenate(some_clips(), of_all);
    // Options of a junction take precedence over the common ones.
    const ConcatenateOptions otherwise{
        .method = find_transition_method(GetParam() == "sine" ? "overlap" : "sine"), .duration = 900ms, .tempo = tempo};
    std::vector<MotionClip> named = some_clips();
    for (MotionClip& one : named) one.junction = {method(), 480ms, 1.0};
    const Synthesis made = concatenate(named, otherwise);
    EXPECT_TRUE(same_bits(made.motion, expected.motion));
    EXPECT_FALSE(same_bits(concatenate(some_clips(), otherwise).motion, expected.motion));
    for (const Junction& junction : made.junctions) EXPECT_EQ(junction.method, GetParam());
  }
}

TEST_P(JunctionsOf, NamingOneChangesNoOther) {
  const ConcatenateOptions options{.duration = 480ms};
  const std::vector<MotionClip> plain = some_clips();
  const Synthesis before = concatenate(plain, options);
  for (std::size_t at = 1; at < plain.size(); ++at) {
    std::vector<MotionClip> named = plain;
    named[at].junction = {method(), 700ms, 2.0};
    const Synthesis after = concatenate(named, options);
    const std::int64_t shift = after.motion.frame_count() - before.motion.frame_count();
    EXPECT_EQ(shift, 35 - 48);
    for (std::size_t i = 0; i < after.junctions.size(); ++i) {
      EXPECT_EQ(after.junctions[i].method, i + 1 == at ? GetParam() : transition_methods().front().name);
      EXPECT_EQ(after.junctions[i].number, i + 1);
      EXPECT_EQ(after.junctions[i].chosen.empty(), i + 1 != at);
    }
    const FrameRange made = before.junctions[at - 1].frames;
    for (std::int64_t frame = 0; frame < before.motion.frame_count(); ++frame) {
      if (frame >= made.begin && frame < made.end) continue;
      const PoseView a = before.motion.pose(frame);
      const PoseView b = after.motion.pose(frame < made.begin ? frame : frame + shift);
      for (std::size_t joint = 0; joint < a.rotations.size(); ++joint) {
        const Eigen::Vector4f x = a.rotations[joint].coeffs();
        const Eigen::Vector4f y = b.rotations[joint].coeffs();
        ASSERT_TRUE(x == y || x == -y) << at << ' ' << frame << ' ' << joint;
      }
      ASSERT_EQ(a.translations[0], b.translations[0]);
    }
  }
}

TEST_P(JunctionsOf, NothingJumpsNextToJunctionsOfOtherMethods) {
  for (const TransitionMethod& other : transition_methods()) {
    std::vector<MotionClip> clips = some_clips();
    clips[1].junction = {method(), 600ms, {}};
    clips[2].junction = {&other, 735ms, {}};
    clips[3].junction = {method(), {}, 0.5};
    const Synthesis made = concatenate(clips, {.method = &other, .duration = 500ms});
    for (std::int64_t frame = 1; frame < made.motion.frame_count(); ++frame) {
      const PoseView before = made.motion.pose(frame - 1);
      const PoseView now = made.motion.pose(frame);
      for (std::size_t joint = 0; joint < now.rotations.size(); ++joint) {
        ASSERT_LT(angle(before.rotations[joint], now.rotations[joint]), 0.15) << other.name << frame << ' ' << joint;
        ASSERT_GE(before.rotations[joint].dot(now.rotations[joint]), 0.0f);
      }
    }
  }
}

INSTANTIATE_TEST_SUITE_P(EveryMethod, JunctionsOf, testing::ValuesIn([] {
                           std::vector<std::string> names;
                           for (const TransitionMethod& method : transition_methods()) names.emplace_back(method.name);
                           return names;
                         }()),
                         [](const auto& test) { return test.param; });

TEST(JunctionTempo, AppliesToTheTransitionInAdditionToTheCommonTempo) {
  std::vector<MotionClip> clips = {clip("A", 0.1f, 20, 40, 25), clip("B", 0.8f, 30, 34, 20)};
  clips[1].junction.tempo = 1.5;
  ConcatenateOptions options{.duration = 600ms};
  EXPECT_EQ(concatenate(clips, options).junctions[0].frames.size(), 40);
  clips[1].pause_before = 350ms;  // not affected by the tempo
  EXPECT_EQ(concatenate(clips, options).junctions[0].frames.size(), 40 + 35);
  clips[1].junction.duration = 300ms;
  EXPECT_EQ(concatenate(clips, options).junctions[0].frames.size(), 20 + 35);
  options.tempo = 0.5;
  const Synthesis slow = concatenate(clips, options);
  EXPECT_EQ(slow.junctions[0].frames.size(), 40 + 70);
  EXPECT_EQ(slow.clips[0].core.size(), 80);  // strokes use only the common tempo
  EXPECT_EQ(slow.clips[1].core.size(), 68);
}

}  // namespace
}  // namespace signweave
