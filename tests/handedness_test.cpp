// Utterances shown with one dominant hand: recordings of signers with the other one are mirrored, and the score says
// so.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <memory>
#include <string>

#include "demo/corpus.h"
#include "signweave/choose/synthesizer.h"
#include "signweave/core/error.h"
#include "signweave/database/signer_dominance.h"
#include "signweave/kv/test_folder.h"
#include "signweave/notation/score_json.h"
#include "signweave/retarget/mirroring.h"
#include "signweave/score/provenance.h"
#include "signweave/score/report.h"

namespace signweave {
namespace {

using testing::HasSubstr;
using testing::Not;

void put_recording(Database& writer, demo::SyntheticRecording made) {
  Recording recording{.name = made.name};
  recording.motion = MotionPart{.motion = std::move(made.motion)};
  TierNames tiers = guess_tier_names(made.document);
  recording.annotation = AnnotationPart{.document = std::move(made.document), .tiers = std::move(tiers)};
  recording.clock = {.frame_time = made.timeline.rate.frame_time()};
  writer.put(recording);
}

Motion captured_villes() {
  return demo::make_recording(demo::villes(), {100, 1}, 1).motion;
}

/// meteo as captured from the right-handed signer, and villes as if a left-handed one had signed it.
const Database& two_hands() {
  static const kv::TestFolder folder;
  static const std::unique_ptr<const Database> database = [] {
    const std::filesystem::path path = folder / "db";
    Database::create(path, {});
    {
      Database writer(path, kv::Access::read_write);
      put_recording(writer, demo::make_recording(demo::meteo(), {100, 1}, 1));
      demo::SyntheticRecording villes = demo::make_recording(demo::villes(), {100, 1}, 1);
      const BorrowedSource source(villes.motion);
      villes.motion = mirrored(villes.motion, mirroring_of(recorded_body("villes", source)));
      put_recording(writer, std::move(villes));
    }
    return std::make_unique<const Database>(path, kv::Access::read_only);
  }();
  return *database;
}

/// VANNES and RENNES are signed only in villes, the others in meteo.
const std::string kWeather = "BONJOUR VANNES PLUIE RENNES DEMAIN";

Synthesized signed_with(std::optional<Side> hand) {
  return synthesize(two_hands(), parse_utterance(kWeather), {.handedness = hand});
}

TEST(Handedness, TheSyntheticSignerIsRightHandedAndItsMirrorImageLeftHanded) {
  const Snapshot snapshot = two_hands().snapshot();
  const Dominance meteo = dominance_of(snapshot, 0);
  const Dominance villes = dominance_of(snapshot, 1);
  EXPECT_EQ(meteo.hand, Side::right);
  EXPECT_EQ(villes.hand, Side::left);
  EXPECT_GT(meteo.score, 0.5f);
  EXPECT_LT(villes.score, -0.5f);
}

TEST(Handedness, MirrorsOnlyTheClipsOfTheOtherHand) {
  for (const Side hand : kSides) {
    const Synthesized made = signed_with(hand);
    const std::string mirrored_one = hand == Side::right ? "villes" : "meteo";
    for (const Clip& clip : made.result.score.clips) {
      EXPECT_EQ(clip.mirrored, clip.source.recording == mirrored_one) << clip.source.recording;
    }
    const std::string eaf = annotation_of(made.result, "").tiers[3].annotations[1].label;
    EXPECT_EQ(eaf.ends_with(", mirrored"), hand == Side::right) << eaf;
    EXPECT_EQ(report_of(made.result).clips[1].mirrored, hand == Side::right);
  }
}

TEST(Handedness, MirroredFramesAreThoseOfTheSignerBeforeTheMirror) {
  const Synthesized made = signed_with(Side::right);
  const Motion captured = captured_villes();
  std::size_t seen = 0;
  for (std::int64_t frame = 0; frame < made.result.motion.frame_count(); ++frame) {
    const FrameSource& source = made.result.sources[static_cast<std::size_t>(frame)];
    if (source.clip == FrameSource::kNone || !made.result.score.clips[static_cast<std::size_t>(source.clip)].mirrored)
      continue;
    for (std::size_t joint = 1; joint < captured.skeleton().joint_count(); ++joint) {
      const Eigen::Quaternionf turn = made.result.motion.pose(frame).rotations[joint].conjugate() *
                                      captured.pose(static_cast<std::int64_t>(source.frame)).rotations[joint];
      ASSERT_LT(turn.vec().norm(), 1e-4f) << frame << ' ' << joint;
    }
    ++seen;
  }
  EXPECT_GT(seen, 50U);
}

TEST(Handedness, AScoreSaysWhatIsMirroredAndGivesTheSameFrames) {
  const Synthesized made = signed_with(Side::right);
  const std::string json = json_of(made.result.score);
  EXPECT_THAT(json, HasSubstr("\"mirrored\": true"));
  EXPECT_THAT(to_string(made.result.score), HasSubstr("VANNES from 'villes', mirrored"));
  const Score read = score_from_json(json, "score.json");
  EXPECT_EQ(read, made.result.score);
  const Synthesized again = synthesize(two_hands(), read);
  EXPECT_TRUE(same_bits(again.result.motion, made.result.motion));
  OpenScore open(two_hands(), read);
  Motion part;
  open.render({100, 160}, part);
  EXPECT_TRUE(same_bits(part, made.result.motion.slice({100, 160})));
}

TEST(Handedness, WithoutTheOptionNothingIsMirroredAndAScoreDoesNotMentionIt) {
  const Synthesized made = signed_with(std::nullopt);
  EXPECT_THAT(json_of(made.result.score), Not(HasSubstr("mirrored")));
  const Synthesized right =
      synthesize(two_hands(), parse_utterance("BONJOUR PLUIE DEMAIN"), {.handedness = Side::right});
  const Synthesized plain = synthesize(two_hands(), parse_utterance("BONJOUR PLUIE DEMAIN"));
  EXPECT_TRUE(same_bits(right.result.motion, plain.result.motion));
  EXPECT_EQ(json_of(right.result.score), json_of(plain.result.score));
}

TEST(Handedness, AnEditedRecordingIsMirroredAsAWhole) {
  Edit edit;
  edit.replacements.push_back(parse_replacement("VANNES#1=PLUIE"));
  const Synthesized made = synthesize(two_hands(), "villes", edit, {.handedness = Side::right});
  for (const Clip& clip : made.result.score.clips) EXPECT_EQ(clip.mirrored, clip.source.recording == "villes");
  EXPECT_TRUE(same_bits(synthesize(two_hands(), made.result.score).result.motion, made.result.motion));
}

TEST(Handedness, OnlyFramesOfRecordingsCanBeMirrored) {
  Score score = signed_with(std::nullopt).result.score;
  score.clips[1].source.kind = SourceRef::Kind::rest;
  score.clips[1].mirrored = true;
  try {
    check(score, "score.json");
    FAIL();
  } catch (const Error& error) {
    EXPECT_THAT(error.what(), HasSubstr("score.json: clip 1 is mirrored, but not of kind 'recording'"));
  }
}

}  // namespace
}  // namespace signweave
