#include "signweave/calls/regenerate.h"
#include "signweave/notation/answer_json.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>

#include "signweave/calls/export_call.h"
#include "signweave/choose/captured_spans.h"
#include "signweave/core/error.h"
#include "signweave/database/test_signing.h"
#include "signweave/evaluation/evaluation.h"
#include "signweave/evaluation/regenerate.h"
#include "signweave/features/phase_features.h"

namespace signweave::calls {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing_database::recording_of;
using testing_database::TestFolder;

/// A recording of 3 s at 100 frames per second with annotated transitions, whose frame 0 is at 500 ms of annotation
/// time. The signer sways, and every joint rotates.
Recording swaying(const std::string& name, int seed, const std::vector<std::string>& glosses) {
  Recording recording = recording_of(name, seed, glosses);
  Motion& motion = recording.motion->motion;
  for (std::int64_t frame = 0; frame < motion.frame_count(); ++frame) {
    const MutablePoseView pose = motion.pose(frame);
    const float t = 0.01F * static_cast<float>(frame) + static_cast<float>(seed);
    pose.translations[0] += Eigen::Vector3f(0.1F * std::sin(t), 0.02F * std::sin(3 * t), 0.1F * std::cos(2 * t));
    for (std::size_t joint = 0; joint < pose.rotations.size(); ++joint) {
      const float angle = 0.05F * std::sin(4 * t + static_cast<float>(joint));
      pose.rotations[joint] = pose.rotations[joint] * Eigen::AngleAxisf(angle, Eigen::Vector3f::UnitX());
    }
  }
  recording.clock.origin = Seconds(0.5);
  return recording;
}

/// A database of two such recordings, the first with a scalar track.
const Database& database() {
  static const TestFolder folder;
  static const std::unique_ptr<const Database> made = [] {
    Database::create(folder / "db", {});
    Database writer(folder / "db", kv::Access::read_write);
    for (const auto& [name, seed] : {std::pair{"one", 1}, std::pair{"two", 2}}) {
      Recording recording = swaying(name, seed, {"A", "B", "C", "D", "E", "F", "G"});
      if (seed == 1) {
        ScalarTrack smile{.name = "smile", .values = {}};
        for (int frame = 0; frame < 300; ++frame) smile.values.push_back(0.01F * static_cast<float>(frame));
        recording.motion->motion.add_track(std::move(smile));
      }
      writer.put(recording);
    }
    return std::make_unique<const Database>(folder / "db", kv::Access::read_only);
  }();
  return *made;
}

Exported exported(ExportCall call, const std::string& output = "out.bvh") {
  if (call.recording.empty()) call.recording = "one";
  return run(database(), call, {output});
}

std::string export_fault(const ExportCall& call, const std::string& output = "out.bvh") {
  try {
    exported(call, output);
  } catch (const Error& error) {
    return error.what();
  }
  return "no fault";
}

bool same_pose(PoseView a, PoseView b) {
  return std::memcmp(a.rotations.data(), b.rotations.data(), a.rotations.size_bytes()) == 0 &&
         std::memcmp(a.translations.data(), b.translations.data(), a.translations.size_bytes()) == 0;
}

/// The largest rotation of any joint from one frame to the next.
float greatest_turn(const Motion& motion) {
  float greatest = 0;
  for (std::int64_t frame = 1; frame < motion.frame_count(); ++frame) {
    const PoseView a = motion.pose(frame - 1);
    const PoseView b = motion.pose(frame);
    for (std::size_t joint = 0; joint < a.rotations.size(); ++joint) {
      greatest = std::max(greatest, a.rotations[joint].angularDistance(b.rotations[joint]));
    }
  }
  return greatest;
}

/// The largest distance the root moves from one frame to the next.
float greatest_shift(const Motion& motion) {
  float greatest = 0;
  for (std::int64_t frame = 1; frame < motion.frame_count(); ++frame) {
    greatest = std::max(greatest, (motion.pose(frame).translations[0] - motion.pose(frame - 1).translations[0]).norm());
  }
  return greatest;
}

/// Every rule below holds for each method.
class Regenerate : public testing::TestWithParam<std::string> {};

TEST_P(Regenerate, ChangesNoFrameOutsideTheGapsAndJoinsWithoutAJump) {
  const Motion plain = *exported({}).motion;
  const Exported made = exported({.regenerate = {"1500..1900", "2500..2800"}, .transition = GetParam()});
  EXPECT_THAT(made.regenerated, ElementsAre(FrameRange{100, 140}, FrameRange{200, 230}));
  EXPECT_EQ(made.regenerated_by->name, GetParam());
  ASSERT_EQ(made.motion->frame_count(), plain.frame_count());
  std::size_t changed = 0;
  for (std::int64_t frame = 0; frame < plain.frame_count(); ++frame) {
    const bool outside =
        std::ranges::none_of(made.regenerated, [&](FrameRange gap) { return frame >= gap.begin && frame < gap.end; });
    const bool same = same_pose(plain.pose(frame), made.motion->pose(frame));
    if (outside) {
      ASSERT_TRUE(same) << frame;
    }
    changed += same ? 0 : 1;
  }
  EXPECT_GT(changed, 50u);
  EXPECT_LE(greatest_turn(*made.motion), 2 * greatest_turn(plain));
  EXPECT_LE(greatest_shift(*made.motion), 2 * greatest_shift(plain));
}

TEST_P(Regenerate, GeneratesTheSameMotionAsTheEvaluation) {
  const std::string name = "one";
  const std::shared_ptr<const Contents> contents = database().contents();
  Motion motion = database().read(name);
  const RigMap rig = map_rig(motion);
  const EvaluatedMotion whole = evaluated_motion(name, std::move(motion), rig, {}, contents->at(name).clock);
  const SignerRig rig_of_whole{whole.signer, whole.groups};
  const TransitionMethod& method = *find_transition_method(GetParam());
  const CapturedSpans others =
      captured_spans(database().snapshot(), whole.motion.skeleton(), whole.groups, method.fill->needs, name);
  const FrameRange gap{100, 140};
  Regenerator regenerator({.skeleton = whole.motion.shared_skeleton(),
                           .rate = whole.motion.rate(),
                           .rig = &rig_of_whole,
                           .model = method.fill->needs == Needs::spans ? others.model.get() : nullptr});
  const Regenerator::Made expected = regenerator.make(*method.fill, {whole.motion, gap, gap.size()});
  // The exported span need not contain all frames that the method reads.
  for (const auto& [from, to] : {std::pair<std::int64_t, std::int64_t>{500, 3500}, {1470, 1930}}) {
    const Exported made = exported({.from = from, .to = to, .regenerate = {"1500..1900"}, .transition = GetParam()});
    for (std::int64_t frame = 0; frame < gap.size(); ++frame) {
      ASSERT_TRUE(same_pose(expected.poses.pose(frame), made.motion->pose(gap.begin + frame - made.frames.begin)));
    }
  }
}

INSTANTIATE_TEST_SUITE_P(EveryMethod, Regenerate, testing::ValuesIn(transition_names()),
                         [](const auto& test) { return test.param; });

TEST(RegenerateOf, UsesTheDefaultMethodIfNoneIsNamed) {
  const Exported made = exported({.regenerate = {"1500..1900"}});
  EXPECT_EQ(made.regenerated_by, &transition_methods().front());
  const Exported named = exported({.regenerate = {"1500..1900"}, .transition = std::string(made.regenerated_by->name)});
  EXPECT_TRUE(same_bits(*made.motion, *named.motion));
}

TEST(RegenerateOf, ASpanIgnoresTheFramesThatAnotherCutsOut) {
  const Exported both = exported({.regenerate = {"1950..2100", "1700..1900"}, .transition = "hermite"});
  EXPECT_THAT(both.regenerated, ElementsAre(FrameRange{120, 140}, FrameRange{145, 160}));
  // For the first gap, the recording ends where the second gap begins.
  const Motion until = database().read("one", {0, 145});
  const Motion whole = database().read("one");
  const SignerModel signer = model_of(whole);
  const SignerRig rig{signer, joint_groups(until.skeleton(), signer.rig)};
  Regenerator regenerator({.skeleton = whole.shared_skeleton(), .rate = whole.rate(), .rig = &rig});
  const auto make = [&](const Motion& motion) {
    return regenerator.make(*find_gap_method("hermite"), {motion, {120, 140}, 20});
  };
  const Regenerator::Made expected = make(until);
  for (std::int64_t frame = 0; frame < 20; ++frame) {
    ASSERT_TRUE(same_pose(expected.poses.pose(frame), both.motion->pose(120 + frame)));
  }
  const Regenerator::Made unlike = make(whole);
  EXPECT_FALSE(same_pose(unlike.poses.pose(10), both.motion->pose(130)));
}

TEST(RegenerateOf, JointsNotRequestedStayAtRest) {
  const ExportCall arm{.joints = "RightArm"};
  const Motion plain = *exported(arm).motion;
  ExportCall call = arm;
  call.regenerate = {"1500..1900"};
  const Motion made = *exported(call).motion;
  const auto wanted = static_cast<std::size_t>(*plain.skeleton().find("RightArm"));
  bool differs = false;
  for (std::int64_t frame = 0; frame < plain.frame_count(); ++frame) {
    for (std::size_t joint = 0; joint < plain.skeleton().joint_count(); ++joint) {
      const bool same = plain.pose(frame).rotations[joint].coeffs() == made.pose(frame).rotations[joint].coeffs();
      if (joint != wanted) {
        ASSERT_TRUE(same);
      }
      differs = differs || !same;
    }
    ASSERT_EQ(plain.pose(frame).translations[0], made.pose(frame).translations[0]);
  }
  EXPECT_TRUE(differs);
}

TEST(RegenerateOf, TracksAreBlendedFromOneBorderToTheOther) {
  const Motion plain = *exported({}).motion;
  const Motion made = *exported({.regenerate = {"1500..1900"}}).motion;
  ASSERT_EQ(made.tracks().size(), 1u);
  EXPECT_EQ(made.tracks()[0].name, "smile");
  const std::vector<float>& before = plain.tracks()[0].values;
  const std::vector<float>& after = made.tracks()[0].values;
  for (std::size_t frame = 0; frame < after.size(); ++frame) {
    const bool inside = frame >= 100 && frame < 140;
    const float expected =
        before[99] + crossfade_weight(static_cast<std::int64_t>(frame) - 100, 40) * (before[140] - before[99]);
    EXPECT_EQ(after[frame], inside ? expected : before[frame]) << frame;
  }
}

TEST(RegenerateOf, CapturedSpansOfTheSameRecordingAreNotUsed) {
  // The same recording with other annotation, so that it has no captured spans: the result is the same.
  const TestFolder folder;
  Database::create(folder / "db", {});
  {
    Database writer(folder / "db", kv::Access::read_write);
    writer.put(swaying("one", 1, {"A"}));
    writer.put(swaying("two", 2, {"A", "B", "C", "D", "E", "F", "G"}));
  }
  const Database other(folder / "db", kv::Access::read_only);
  const ExportCall call{.recording = "one", .regenerate = {"1500..1900"}, .transition = "recorded"};
  const Motion without = *run(other, call, {"out.bvh"}).motion;
  const Motion with = *exported(call).motion;
  EXPECT_TRUE(std::ranges::equal(without.rotations(), with.rotations(),
                                 [](const auto& a, const auto& b) { return a.coeffs() == b.coeffs(); }));
  // No other recording to learn from: a notice says so.
  const ExportCall alone{.recording = "two", .regenerate = {"1500..1900"}, .transition = "recorded"};
  const Exported kriged = run(other, alone, {"out.bvh"});
  ASSERT_EQ(kriged.notices.size(), 1u);
  EXPECT_THAT(kriged.notices[0].text, HasSubstr("no annotated transition of this skeleton in another recording"));
}

TEST(RegenerateOf, AnotherRateIsSampledFromTheRegeneratedMotion) {
  const Exported made = exported({.regenerate = {"1500..1900"}, .rate = {.rate = "50", .method = "nearest"}});
  const Motion whole = *exported({.regenerate = {"1500..1900"}}).motion;
  ASSERT_EQ(made.motion->frame_count(), 150);
  EXPECT_TRUE(same_pose(made.motion->pose(60), whole.pose(120)));
}

TEST(RegenerateOf, TheReportListsTheRegeneratedSpans) {
  const Exported made = exported({.from = 1000, .to = 2500, .regenerate = {"1500..1900"}, .transition = "sine"});
  const auto report = answer_json<nlohmann::json>(made);
  EXPECT_EQ(report["frames"], 150);
  EXPECT_EQ(report["regenerated"], nlohmann::json::parse(R"([{"begin_ms": 1500, "end_ms": 1900, "method": "sine",
                                                         "recorded_frames": {"begin": 100, "end": 140}}])"));
  EXPECT_FALSE(answer_json(exported({})).contains("regenerated"));
}

TEST(RegenerateOf, FaultMessagesAreOneLine) {
  EXPECT_EQ(check_span("1200..1800"), "");
  EXPECT_EQ(check_span("-300..-100"), "");
  for (const char* text : {"", "1200", "1200..", "..1800", "1200-1800", "1.5..2.5", "1200..1800..2000", "a..b",
                           "99999999999999999999..1"}) {
    EXPECT_THAT(check_span(text), HasSubstr("expected FROM..TO in ms of annotation time")) << text;
  }
  EXPECT_THAT(check_span("1800..1200"), HasSubstr("FROM must be before TO"));
  EXPECT_THAT(check_span("1800..1800"), HasSubstr("FROM must be before TO"));

  EXPECT_EQ(export_fault({.regenerate = {"1501..1504"}}), "regenerate 1501..1504: no frame lies in it");
  for (const char* span : {"500..900", "520..900", "3000..3480", "3000..9000", "-9000..9000", "9000..9100"}) {
    EXPECT_THAT(export_fault({.regenerate = {span}}),
                HasSubstr("3 captured frames must lie on both sides of it, and what is "
                          "exported covers 500..3500 ms"))
        << span;
  }
  EXPECT_EQ(export_fault({.regenerate = {"530..900"}}), "no fault");
  EXPECT_THAT(export_fault({.from = 1000, .to = 1900, .regenerate = {"1500..1890"}}),
              HasSubstr("covers 1000..1900 ms"));
  for (const char* second : {"1700..2000", "1900..2000", "1920..2000", "1500..1900"}) {
    EXPECT_THAT(export_fault({.regenerate = {"1500..1900", second}}), HasSubstr("between it and the span before"))
        << second;
  }
  EXPECT_EQ(export_fault({.regenerate = {"1500..1900", "1930..2000"}}), "no fault");
  EXPECT_THAT(export_fault({.transition = "sine"}), HasSubstr("'transition' applies only to 'regenerate'"));
  EXPECT_THAT(export_fault({.regenerate = {"1500..1900"}}, "out.eaf"), HasSubstr("request a motion file"));
}

}  // namespace
}  // namespace signweave::calls
