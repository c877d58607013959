// Signs that are changed in space, on the demo corpus.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "demo/space.h"
#include "signweave/choose/synthesizer.h"
#include "signweave/core/error.h"
#include "signweave/database/test_recording.h"
#include "signweave/features/hand_motion.h"
#include "signweave/notation/score_json.h"
#include "signweave/score/provenance.h"
#include "signweave/score/report.h"
#include "tests/demo_database.h"

namespace signweave::in_space {
namespace {

using testing::HasSubstr;

const Database& corpus() {
  static const testing_database::TestFolder folder;
  static const std::unique_ptr<const Database> database = [] {
    copy_demo_database(folder / "db", 2);
    return std::make_unique<const Database>(folder / "db", kv::Access::read_only);
  }();
  return *database;
}

Synthesized signed_as(std::string_view text, const SynthesisOptions& options = {}) {
  return synthesize(corpus(), parse_utterance(text), options);
}

/// The captured frames of a clip's core.
Motion captured(const Clip& clip) {
  const Snapshot snapshot = corpus().snapshot();
  const auto source = snapshot.motion(snapshot.contents().at(clip.source.recording));
  Motion core(source->skeleton(), source->rate(), clip.core.size());
  source->read(clip.core, core.poses({0, clip.core.size()}));
  return core;
}

/// True if the core of a clip shows its captured local rotations below the root.
bool is_as_captured(const Synthesized& made, std::size_t number) {
  const Clip& clip = made.result.score.clips[number];
  const Motion core = captured(clip);
  for (std::int64_t frame = 0; frame < clip.at.size(); ++frame) {
    const PoseView shown = made.result.motion.pose(clip.at.begin + frame);
    for (std::size_t joint = 1; joint < core.skeleton().joint_count(); ++joint) {
      if (shown.rotations[joint].coeffs() != core.pose(frame).rotations[joint].coeffs()) return false;
    }
  }
  return true;
}

/// The mean place of a palm over a clip's core, signer-centred.
Eigen::Vector3f mean_palm(const Synthesized& made, std::size_t number, Side side) {
  const Motion& motion = made.result.motion;
  const HandMotion hands = measure_hands(motion, model_of(motion), made.result.score.clips[number].at);
  Eigen::Vector3f sum = Eigen::Vector3f::Zero();
  const auto& frames = hands.hands[static_cast<std::size_t>(side)].frames;
  for (const HandFrame& frame : frames) sum += frame.position;
  return sum / static_cast<float>(frames.size());
}

std::string why(std::string_view text, const SynthesisOptions& options = {}) {
  try {
    signed_as(text, options);
  } catch (const Error& error) {
    return error.what();
  }
  return "none";
}

TEST(SpaceTest, OnlyTheSignThatIsChangedLosesItsFrames) {
  const Synthesized made = signed_as("BONJOUR DEMAIN{at @left} MATIN");
  ASSERT_EQ(made.result.score.clips.size(), 3u);
  EXPECT_TRUE(is_as_captured(made, 0));
  EXPECT_FALSE(is_as_captured(made, 1));
  EXPECT_TRUE(is_as_captured(made, 2));
  const std::vector<ClipChange>& changes = made.result.score.clips[1].changes;
  ASSERT_EQ(changes.size(), 1u);
  EXPECT_EQ(changes[0].asked, "at @left");
  EXPECT_EQ(changes[0].basis, ChangeBasis::geometric);
  EXPECT_GT(changes[0].moved_mm, 50);
  const Synthesized plain = signed_as("BONJOUR DEMAIN MATIN");
  EXPECT_GT(angles_of(mean_palm(made, 1, Side::right)).azimuth,
            angles_of(mean_palm(plain, 1, Side::right)).azimuth + 20);
}

TEST(SpaceTest, AScoreHoldsAllThatMakesTheFrames) {
  const Synthesized made = signed_as("BONJOUR{at @left} DEMAIN{big; slow} MATIN{along @right @front; unturned}");
  const std::string text = json_of(made.result.score);
  EXPECT_EQ(version_of(made.result.score), 3);
  const Score again = score_from_json(text, "score.json");
  EXPECT_EQ(again, made.result.score);
  EXPECT_TRUE(same_bits(synthesize(corpus(), again).result.motion, made.result.motion));
}

TEST(SpaceTest, APluralIsSignedThreeTimesSmallerAndFartherOut) {
  const Synthesized made = signed_as("BONJOUR DEMAIN{plural} MATIN");
  ASSERT_EQ(made.result.score.clips.size(), 5u);
  for (const std::size_t clip : {1, 2, 3}) EXPECT_EQ(made.result.score.clips[clip].place, 1u);
  EXPECT_TRUE(is_as_captured(made, 1));
  EXPECT_FALSE(is_as_captured(made, 2));
  const float first = mean_palm(made, 1, Side::right).x();
  EXPECT_LT(mean_palm(made, 2, Side::right).x(), first - 0.05f);
  EXPECT_LT(mean_palm(made, 3, Side::right).x(), mean_palm(made, 2, Side::right).x() - 0.05f);
}

TEST(SpaceTest, ASlowSignTakesLonger) {
  const Synthesized made = signed_as("BONJOUR DEMAIN{slow} MATIN");
  const Synthesized plain = signed_as("BONJOUR DEMAIN MATIN");
  const auto frames = [](const Synthesized& one, std::size_t clip) {
    return static_cast<double>(one.result.score.clips[clip].at.size());
  };
  EXPECT_NEAR(frames(made, 1) * static_cast<double>(kSlow), frames(plain, 1), 2);
  EXPECT_EQ(frames(made, 0), frames(plain, 0));
}

TEST(SpaceTest, AMirroredSignIsSignedWithTheOtherHand) {
  const Synthesized made = signed_as("BONJOUR DEMAIN{mirrored} MATIN");
  EXPECT_FALSE(made.result.score.clips[0].mirrored);
  EXPECT_TRUE(made.result.score.clips[1].mirrored);
}

TEST(SpaceTest, TheGazeGoesToTheLocusAndBack) {
  const Synthesized made = signed_as("BONJOUR{@a = @left} DEMAIN{at @a} MATIN");
  ASSERT_EQ(made.result.score.curves.size(), 1u);
  const AuthoredCurve& gaze = made.result.score.curves.front();
  ASSERT_TRUE(gaze.curve.gaze);
  EXPECT_NEAR(gaze.curve.gaze->yaw, 50, 10);
  EXPECT_EQ(gaze.first, 1u);
  const Clip& clip = made.result.score.clips[1];
  EXPECT_LT(gaze.at.begin, clip.at.begin);
  EXPECT_GE(gaze.at.end, clip.at.end);
  const Synthesized own = signed_as("BONJOUR DEMAIN{at @left; gaze @right} MATIN");
  ASSERT_EQ(own.result.score.curves.size(), 1u);
  EXPECT_LT(own.result.score.curves.front().curve.gaze->yaw, 0);
}

TEST(SpaceTest, ReportsAndAnnotationSayWhatWasChanged) {
  const Synthesized made = signed_as("BONJOUR DEMAIN{move -6/0/0} MATIN");
  const SynthesisReport report = report_of(made.result);
  ASSERT_EQ(report.clips[1].changes.size(), 1u);
  EXPECT_NEAR(report.clips[1].changes[0].moved_mm, 60, 1);
  EXPECT_TRUE(report.clips[0].changes.empty());
  std::string sources;
  const AnnotationDocument document = annotation_of(made.result);
  for (const Annotation& one : document.find_tier("Source")->annotations) sources += one.label + "\n";
  EXPECT_THAT(sources, HasSubstr("move -6/0/0 (asked: 60 mm, 0°)"));
}

/// The recordings whose signs are aimed by a known law.
const Database& aimed() {
  static const testing_database::TestFolder folder;
  static const std::unique_ptr<const Database> database = [] {
    Database::create(folder / "db", {});
    Database writer(folder / "db", kv::Access::read_write);
    for (const demo::SpaceScript& script : {demo::espace_index(), demo::espace_verbes(1), demo::espace_verbes(2)}) {
      demo::SyntheticRecording made = demo::make_space(script, {100, 1}, 1);
      Recording recording{.name = made.name};
      recording.motion = MotionPart{.motion = std::move(made.motion)};
      TierNames tiers = guess_tier_names(made.document);
      recording.annotation = AnnotationPart{.document = std::move(made.document), .tiers = std::move(tiers)};
      recording.clock = {.frame_time = made.timeline.rate.frame_time()};
      writer.put(recording);
    }
    return std::make_unique<const Database>(folder / "db", kv::Access::read_only);
  }();
  return *database;
}

TEST(SpaceTest, TheBestBasisOfAVerbIsTaken) {
  SynthesisOptions options;
  options.space.roles = {{"INVITER", SpaceRole::backward}, {"INDEX", SpaceRole::aim}, {"DONNER", SpaceRole::forward}};
  const auto change = [&](std::string_view text) {
    return synthesize(aimed(), parse_utterance(text), options).result.score.clips.front().changes.front();
  };
  const ClipChange captured = change("INVITER{from @self to @25}");
  EXPECT_EQ(captured.basis, ChangeBasis::captured);
  EXPECT_EQ(captured.moved_mm, 0);
  const ClipChange learned = change("INVITER{from @self to @12}");
  EXPECT_EQ(learned.basis, ChangeBasis::learned) << learned.because;
  EXPECT_THAT(learned.because, HasSubstr("learned from"));
  const ClipChange geometric = change("INVITER{from @self to @105}");
  EXPECT_EQ(geometric.basis, ChangeBasis::geometric);
  EXPECT_THAT(geometric.because, HasSubstr("geometric from 'INVITER'"));
  const ClipChange index = change("INDEX{at @33/5/3}");
  EXPECT_EQ(index.basis, ChangeBasis::geometric);
  EXPECT_LT(index.aim_degrees, 1);
}

TEST(SpaceTest, FaultsAreOneLineWithTheirMend) {
  SynthesisOptions options;
  options.space.roles["VANNES"] = SpaceRole::none;
  EXPECT_THAT(why("VANNES{to @left}", options),
              HasSubstr("'VANNES' has no role in space, so it cannot go from or to a locus"));
  EXPECT_THAT(why("DEMAIN{at @170}"), HasSubstr("a locus at 170° is behind the signer; give one within 110°"));
}

}  // namespace
}  // namespace signweave::in_space
