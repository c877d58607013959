#include "signweave/score/report.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "signweave/score/test_motion.h"

namespace signweave {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

Item shows(ClipId clip, FrameRange at) {
  return {ClipUse{clip}, at};
}
Item joins(ClipId from, ClipId to, FrameRange at) {
  return {Transition{.from = from, .to = to, .cut = {}}, at};
}

/// Two clips of the whole body in every lane.
Synthesis two_clips() {
  Synthesis made{.motion = testing_motion::moving(100, {100, 1}, 1), .score = {}};
  made.score.frames = 100;
  for (ClipId id = 0; id < 2; ++id) {
    made.score.clips.push_back({.id = id, .place = id, .at = {std::int64_t{60} * id, std::int64_t{60} * id + 40}});
    made.clips.push_back({.recording = "r", .output = made.score.clips.back().at});
  }
  made.score.junctions.push_back({.number = 1, .method = "taught"});
  for (const Channel channel : kChannels) {
    made.score.lanes.push_back({channel, {shows(0, {0, 45}), joins(0, 1, {45, 55}), shows(1, {55, 100})}});
  }
  return made;
}

std::vector<std::string> lines_of(const ReportLane& lane) {
  std::vector<std::string> lines;
  for (const ReportLaneItem& item : lane.items) {
    const std::string at = std::to_string(item.frames.begin) + ".." + std::to_string(item.frames.end);
    const std::string clip = std::to_string(item.clip);
    switch (item.kind) {
      case ReportLaneItem::Kind::clip:
        lines.push_back("clip " + clip + " " + at + (item.hand ? " keeps its place" : ""));
        break;
      case ReportLaneItem::Kind::transition:
        lines.push_back(clip + " to " + std::to_string(item.to_clip) + " by " + item.method + " " + at);
        break;
      case ReportLaneItem::Kind::hold:
        lines.push_back("hold " + clip + " " + at);
        break;
    }
  }
  return lines;
}

TEST(SynthesisReport, NamesOnlyLanesThatShowSomethingElse) {
  Synthesis made = two_clips();
  EXPECT_THAT(report_of(made).lanes, IsEmpty());
  made.score.lanes[1].items = {
      {ClipUse{0, HandPlace{.moved_mm = 3}}, {0, 40}}, {Hold{0}, {40, 50}}, joins(0, 1, {50, 60}), shows(1, {60, 100})};
  const SynthesisReport report = report_of(made);
  ASSERT_EQ(report.lanes.size(), 1u);
  EXPECT_EQ(report.lanes[0].channel, Channel::left);
  EXPECT_THAT(lines_of(report.lanes[0]), ElementsAre("clip 0 0..40 keeps its place", "hold 0 40..50",
                                                     "0 to 1 by taught 50..60", "clip 1 60..100"));
}

TEST(SynthesisReport, LeavesOutTransitionsWithoutFrames) {
  Synthesis made = two_clips();
  made.score.clips[1].at = {40, 100};
  made.score.lanes[2].items = {{Hold{0}, {0, 10}}, shows(0, {10, 40}), joins(0, 1, {40, 40}), shows(1, {40, 100})};
  const SynthesisReport report = report_of(made);
  ASSERT_EQ(report.lanes.size(), 1u);
  EXPECT_THAT(lines_of(report.lanes[0]), ElementsAre("hold 0 0..10", "clip 0 10..40", "clip 1 40..100"));
}

TEST(SynthesisReport, NamesTheChannelsThatAMovementMoves) {
  Synthesis made = two_clips();
  Curve question{.name = "q", .weights = {{"browInnerUp", 0.5f}, {"eyeBlinkLeft", 0.1f}}};
  question.head.turn.pitch = 5;
  const Curve look{.name = "left", .gaze = GazeDirection{20, 0}};
  const Curve mouthed{.name = "a", .mouth = {{.viseme = Viseme::aa, .at = 100ms, .held = 50ms, .strength = 1}}};
  for (const Curve& curve : {question, look, mouthed}) made.score.curves.push_back({curve, {10, 50}, 0, 1});
  const std::vector<ReportMovement> movements = report_of(made).movements;
  ASSERT_EQ(movements.size(), 3u);
  EXPECT_EQ(movements[0].kind, "expression");
  EXPECT_THAT(movements[0].channels, ElementsAre("head", "brows", "lids"));
  EXPECT_EQ(movements[1].kind, "gaze");
  EXPECT_THAT(movements[1].channels, ElementsAre("gaze"));
  EXPECT_EQ(movements[2].kind, "mouthing");
  EXPECT_THAT(movements[2].channels, ElementsAre("mouth"));
  EXPECT_EQ(movements[2].frames, (FrameRange{10, 50}));
}

}  // namespace
}  // namespace signweave
