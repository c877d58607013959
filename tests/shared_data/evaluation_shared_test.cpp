// The evaluation on captured files: properties that must hold however the methods are tuned.

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>

#include "signweave/evaluation/bootstrap.h"
#include "signweave/evaluation/evaluate.h"
#include "signweave/formats/bvh/bvh.h"

namespace signweave {
namespace {

namespace fs = std::filesystem;

std::vector<EvaluatedMotion> some_files() {
  const fs::path root = fs::path(SIGNWEAVE_SHARED_DATA) / "bvh";
  std::vector<EvaluatedMotion> recordings;
  const auto add = [&](const fs::path& path, bvh::RootColumns columns) {
    Motion motion = bvh::read(root / path, {.root_columns = columns}).motion;
    const FrameClock clock{motion.rate().frame_time(), Seconds(0)};
    const RigMap rig = map_rig(motion);
    recordings.push_back(evaluated_motion(path.string(), std::move(motion), rig, {}, clock));
  };
  for (const char* const name : {"bow_normal_001", "bow_happy_001", "bye_normal_001", "byebye_active_001",
                                 "call_normal_001", "call_normal_002", "guide_normal_001", "respond_normal_001"}) {
    add(fs::path("bandai-namco") / ("dataset-1_" + std::string(name) + ".bvh"), bvh::RootColumns::declared);
  }
  add("signon-thanks/ISL Thanks.bvh", bvh::RootColumns::rotation_first);
  add("signon-thanks/VGT Thanks.bvh", bvh::RootColumns::rotation_first);
  add("ksl-always/always.bvh", bvh::RootColumns::declared);
  return recordings;
}

struct SharedEvaluation : testing::Test {
  static void SetUpTestSuite() {
    recordings = some_files();
    choice = choose_spans(recordings);
    std::vector<const GapMethod*> methods;
    for (const GapMethod& method : gap_methods()) methods.push_back(&method);
    scores = evaluate_given(recordings, choice.spans, methods);
    ceiling = evaluate_ceiling(recordings, choice.spans);
  }
  static void TearDownTestSuite() {
    recordings.clear();
    scores.clear();
    ceiling.clear();
  }

  static double figure(const std::vector<MethodScores>& of, std::string_view name, const std::string& group,
                       Measure measure) {
    std::vector<ClusteredScore> found;
    for (const MethodScores& method : of) {
      if (method.name != name) continue;
      for (std::size_t i = 0; i < choice.spans.size(); ++i) {
        if (choice.groups[choice.spans[i].group] != group) continue;
        found.push_back({choice.spans[i].recording, method.spans[i].at(HandChoice::moving, measure)});
      }
    }
    return Bootstrap(1).estimate(found, info_of(measure).pooling).value;
  }

  static inline std::vector<EvaluatedMotion> recordings;
  static inline SpanChoice choice;
  static inline std::vector<MethodScores> scores;
  static inline std::vector<MethodScores> ceiling;
};

TEST_F(SharedEvaluation, EveryGroupHasSpans) {
  std::vector<std::size_t> counts(choice.groups.size());
  for (const EvaluatedSpan& span : choice.spans) ++counts[span.group];
  EXPECT_EQ(counts[0], 0u) << "the files have no annotation";
  for (std::size_t group = 1; group < counts.size(); ++group) EXPECT_GE(counts[group], 5u) << choice.groups[group];
}

TEST_F(SharedEvaluation, TheCaptureIsRankedAsExpected) {
  for (const char* const group : {"170 ms", "280 ms", "520 ms"}) {
    const auto wrist = [&](std::string_view name) { return figure(scores, name, group, Measure::wrist); };
    EXPECT_LT(wrist("hermite"), wrist("slerp")) << group << ": velocities at the borders are what counts";
    EXPECT_LT(wrist(gap_methods()[0].name), wrist("slerp")) << group;
    EXPECT_LT(wrist("slerp"), wrist("recipe")) << group;
    EXPECT_LT(wrist("slerp"), wrist("hold")) << group;
    EXPECT_LT(figure(ceiling, "ceiling", group, Measure::wrist), figure(ceiling, "nearest", group, Measure::wrist));
  }
  // Longer gaps are harder.
  EXPECT_LT(figure(scores, "slerp", "170 ms", Measure::wrist), figure(scores, "slerp", "520 ms", Measure::wrist));
  EXPECT_LT(figure(scores, "slerp", "520 ms", Measure::wrist), figure(scores, "slerp", "1064 ms", Measure::wrist));
}

TEST_F(SharedEvaluation, EveryFigureIsANumberAndNoCapturedFrameIsChanged) {
  for (const MethodScores& method : scores) {
    std::size_t fingers = 0;
    for (std::size_t i = 0; i < choice.spans.size(); ++i) {
      const SpanScores& span = method.spans[i];
      for (const Measure measure : {Measure::wrist, Measure::arm_angle, Measure::depth, Measure::peak_speed}) {
        EXPECT_TRUE(std::isfinite(span.at(HandChoice::moving, measure).value))
            << method.name << ' ' << info_of(measure).name << ' ' << recordings[choice.spans[i].recording].name << ' '
            << choice.spans[i].frames.begin;
      }
      EXPECT_EQ(span.at(HandChoice::moving, Measure::changed_frames).value, 0) << method.name;
      const bool has_fingers = span.at(HandChoice::moving, Measure::fingertips).known();
      fingers += has_fingers ? 1 : 0;
      EXPECT_TRUE(!has_fingers || !recordings[choice.spans[i].recording].name.starts_with("bandai")) << "no fingers";
    }
    EXPECT_GE(fingers, 10u) << method.name;
  }
}

TEST_F(SharedEvaluation, TheTPoseOfAFirstFrameIsInNoSpan) {
  for (const EvaluatedSpan& span : choice.spans) {
    if (recordings[span.recording].name == "ksl-always/always.bvh") {
      EXPECT_GT(span.frames.begin, 18) << "0.3 s after frame 0";
    }
  }
  EXPECT_TRUE(recordings.back().unusable[0]);
}

}  // namespace
}  // namespace signweave
