// The paper's two scenarios (section 5.1) end to end through the library, on the demo corpus, for every transition
// method.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <atomic>
#include <thread>

#include "signweave/choose/synthesizer.h"
#include "signweave/core/error.h"
#include "signweave/database/database.h"
#include "signweave/database/test_recording.h"
#include "signweave/formats/eaf/eaf.h"
#include "signweave/motion/kinematics.h"
#include "signweave/rig/rig_map.h"
#include "signweave/score/provenance.h"
#include "tests/demo_database.h"

namespace signweave {
namespace {

using testing_database::TestFolder;

/// The demo corpus in a database, created once.
const Database& edited_corpus() {
  static const TestFolder folder;
  static const std::unique_ptr<const Database> database = demo_database(folder / "db", 2);
  return *database;
}

class Scenario : public testing::TestWithParam<std::string> {
 protected:
  Synthesized edit(const Edit& what) const {
    return synthesize(edited_corpus(), "meteo", what,
                      {.method = find_transition_method(GetParam()), .duration = {.fitted = false}});
  }
};

std::vector<std::string> glosses_of(const Synthesis& made) {
  std::vector<std::string> glosses;
  for (const PlacedSign& sign : made.signs) glosses.push_back(sign.sign.gloss);
  return glosses;
}

std::vector<std::string> glosses_of_meteo() {
  std::vector<std::string> glosses;
  const AnnotationDocument document = edited_corpus().document("meteo");
  for (const Annotation& annotation : document.find_tier("Gloss")->annotations) glosses.push_back(annotation.label);
  return glosses;
}

Edit scenario_1() {
  Edit edit;
  for (const char* text : {"BRETAGNE=VANNES", "DEMAIN=MARSEILLE", "VENDREDI=RENNES", "MATIN#2=LE MANS"}) {
    edit.replacements.push_back(parse_replacement(text));
  }
  return edit;
}

Edit scenario_2() {
  Edit edit;
  edit.swap = parse_swap("BRETAGNE..PLUIE,NUAGES#2..BROUILLARD");
  return edit;
}

/// Every frame taken from a recording has that recording's own bits (its root may be aligned).
void expect_captured_frames_are_kept(const Synthesis& made) {
  std::map<std::string, Motion> sources;
  for (const ShownClip& placed : made.clips) {
    if (!sources.contains(placed.recording)) sources.emplace(placed.recording, edited_corpus().read(placed.recording));
  }
  std::size_t kept = 0;
  for (std::int64_t frame = 0; frame < made.motion.frame_count(); ++frame) {
    const FrameSource& source = made.sources[static_cast<std::size_t>(frame)];
    if (source.clip == FrameSource::kNone) continue;
    ASSERT_EQ(source.frame, std::floor(source.frame));
    const Motion& recording = sources.at(made.clips[static_cast<std::size_t>(source.clip)].recording);
    const PoseView captured = recording.pose(static_cast<std::int64_t>(source.frame));
    const PoseView shown = made.motion.pose(frame);
    for (std::size_t joint = 1; joint < shown.rotations.size(); ++joint) {
      const auto& a = shown.rotations[joint].coeffs();
      const auto& b = captured.rotations[joint].coeffs();
      ASSERT_TRUE(a == b || a == -b) << "frame " << frame << " joint " << joint;
    }
    ++kept;
  }
  EXPECT_GT(kept, static_cast<std::size_t>(made.motion.frame_count()) * 3 / 4);
}

/// No generated movement is faster than the fastest captured one.
void expect_no_jump(const Synthesis& made) {
  const Motion& motion = made.motion;
  double captured = 0;
  double between = 0;
  ModelPose before;
  ModelPose now;
  to_model_space(motion.skeleton(), motion.pose(0), before);
  for (std::int64_t frame = 1; frame < motion.frame_count(); ++frame) {
    to_model_space(motion.skeleton(), motion.pose(frame), now);
    const auto is_made = [&](std::int64_t f) {
      return made.sources[static_cast<std::size_t>(f)].junction != FrameSource::kNone;
    };
    double& fastest = is_made(frame) || is_made(frame - 1) ? between : captured;
    for (std::size_t joint = 0; joint < now.positions.size(); ++joint) {
      const double speed = (now.positions[joint] - before.positions[joint]).norm() * motion.rate().hertz();
      fastest = std::max(fastest, speed);
    }
    std::swap(before, now);
  }
  EXPECT_GT(between, 0.0);
  EXPECT_LT(between, captured);
}

TEST_P(Scenario, OneReplacesFourWordsWithEightJunctions) {
  const Synthesized made = edit(scenario_1());
  EXPECT_EQ(made.result.junctions.size(), 8u);
  std::vector<std::string> expected = glosses_of_meteo();
  std::size_t matins = 0;
  for (std::string& gloss : expected) {
    if (gloss == "BRETAGNE") gloss = "VANNES";
    if (gloss == "DEMAIN") gloss = "MARSEILLE";
    if (gloss == "VENDREDI") gloss = "RENNES";
    if (gloss == "MATIN" && ++matins == 2) gloss = "LE MANS";
  }
  EXPECT_EQ(glosses_of(made.result), expected);
  expect_captured_frames_are_kept(made.result);
  expect_no_jump(made.result);
}

TEST_P(Scenario, TwoSwapsTwoPredictionsWithThreeJunctions) {
  const Synthesized made = edit(scenario_2());
  EXPECT_EQ(made.result.junctions.size(), 3u);
  const std::vector<std::string> glosses = glosses_of(made.result);
  const std::vector<std::string> tail(glosses.end() - 16, glosses.end());
  EXPECT_THAT(tail, testing::ElementsAre("NUAGES", "NUIT", "EN-MER", "MATIN", "BROUILLARD", "DEMAIN", "SOLEIL-BRILLER",
                                         "CHAUD-SEC-FERA", "NAGER", "CE-SERA-LE-MOMENT", "VENDREDI", "BRETAGNE",
                                         "MATIN", "NUAGES", "APRES-MIDI", "PLUIE"));
  expect_captured_frames_are_kept(made.result);
  expect_no_jump(made.result);
}

TEST_P(Scenario, TransitionsLastTheMeanOfTheCorpus) {
  const Synthesized made = edit(scenario_1());
  const auto mean = edited_corpus().contents()->transitions.mean.count();
  for (const Junction& junction : made.result.junctions) {
    EXPECT_NEAR(static_cast<double>(junction.frames.size()) * 10.0, static_cast<double>(mean), 5.0);
  }
}

TEST_P(Scenario, TheAnnotationIsConsistent) {
  const Synthesized made = edit(scenario_1());
  const AnnotationDocument document = annotation_of(made.result, "scenario1.bvh");
  const eaf::File back = eaf::read_text("scenario1.eaf", eaf::write_text(document));
  EXPECT_TRUE(back.notices.empty());
  const TierNames tiers = guess_tier_names(back.document);
  const SignsFound found = signs_in(back.document, tiers);
  EXPECT_TRUE(found.notices.empty()) << found.notices[0].text;  // the phases of each sign fill it exactly
  EXPECT_EQ(found.signs.size(), made.result.signs.size());
  EXPECT_EQ(back.document.find_tier("Junction")->annotations.size(), 8u);
  EXPECT_EQ(back.document.find_tier("Source")->annotations.size(), 9u);
}

TEST_P(Scenario, UneditedClipsStayAsCaptured) {
  const Synthesized made = edit(scenario_1());
  const Motion meteo = edited_corpus().read("meteo");
  const ShownClip& first = made.result.clips.front();
  for (std::int64_t frame = 0; frame < first.core.end; ++frame) {
    for (std::size_t joint = 0; joint < meteo.skeleton().joint_count();
         ++joint) {  // the root too, because nothing is aligned
      const auto& a = made.result.motion.pose(frame).rotations[joint].coeffs();
      const auto& b = meteo.pose(frame).rotations[joint].coeffs();
      ASSERT_TRUE(a == b || a == -b) << frame << ' ' << joint;
    }
    ASSERT_EQ(made.result.motion.pose(frame).translations[0], meteo.pose(frame).translations[0]);
  }
}

std::vector<std::string> every_method() {
  std::vector<std::string> methods;
  for (const TransitionMethod& method : transition_methods()) methods.emplace_back(method.name);
  return methods;
}

INSTANTIATE_TEST_SUITE_P(EveryMethod, Scenario, testing::ValuesIn(every_method()),
                         [](const auto& tested) { return tested.param; });

/// [Side][frame]: wrist positions, metres.
std::array<std::vector<Eigen::Vector3f>, 2> wrists_of(const Motion& motion) {
  const RigMap rig = map_rig(motion);
  std::array<std::vector<Eigen::Vector3f>, 2> wrists;
  ModelPose pose;
  for (std::int64_t frame = 0; frame < motion.frame_count(); ++frame) {
    to_model_space(motion.skeleton(), motion.pose(frame), pose);
    for (const Side side : kSides) {
      wrists[static_cast<std::size_t>(side)].push_back(position_of(rig[of(side, Part::left_hand)], pose));
    }
  }
  return wrists;
}

/// The change of velocity at a frame, metres per frame.
double change_at(const std::vector<Eigen::Vector3f>& path, std::int64_t frame) {
  const auto at = static_cast<std::size_t>(frame);
  return static_cast<double>((path[at + 1] - 2.0f * path[at] + path[at - 1]).norm());
}

/// The difference between the velocities just after and just before a frame, metres per frame: each from the parabola
/// through three frames on its own side, so that the onset of an acceleration is not a jump.
double jump_at(const std::vector<Eigen::Vector3f>& path, std::int64_t frame) {
  const auto at = static_cast<std::size_t>(frame);
  const Eigen::Vector3f before = 1.5f * path[at] - 2.0f * path[at - 1] + 0.5f * path[at - 2];
  const Eigen::Vector3f after = -1.5f * path[at] + 2.0f * path[at + 1] - 0.5f * path[at + 2];
  return static_cast<double>((after - before).norm());
}

/// Where generated frames meet captured ones, the velocity of a hand jumps by at most 1.5 times its largest change
/// between frames of the recording within a tenth of a second of that point.
TEST(Seams, VelocityContinuesBetweenGeneratedAndCapturedFrames) {
  constexpr double kUnseen = 2e-4;  // a fifth of a millimetre between frames
  constexpr std::int64_t kNear = 10;
  const Utterance utterance = parse_utterance("VANNES MATIN PLUIE FRANCE NUAGES SOLEIL-BRILLER DEMAIN BONJOUR RENNES");
  std::map<std::string, std::array<std::vector<Eigen::Vector3f>, 2>> captured;
  const std::shared_ptr<const Contents> contents = edited_corpus().contents();
  for (const RecordingInfo& info : contents->recordings) {
    captured.emplace(info.name, wrists_of(edited_corpus().read(info.name)));
  }
  // The methods that continue with the velocity at the border, including the default; others damp it, estimate it from
  // a longer span, or bend away from the border immediately.
  for (const char* name : {"learned", "kriging", "inertialize"}) {
    const TransitionMethod method{name, "", nullptr, find_gap_method(name)};
    const Synthesis made = synthesize(edited_corpus(), utterance, {.method = &method}).result;
    const auto wrists = wrists_of(made.motion);
    double worst = 0;
    std::size_t seams = 0;
    for (std::size_t i = 0; i < made.junctions.size(); ++i) {
      const Junction& junction = made.junctions[i];
      for (const Side side : kSides) {
        const auto hand = static_cast<std::size_t>(side);
        const auto look = [&](const ShownClip& placed, std::int64_t seam) {
          const auto& path = captured.at(placed.recording)[hand];
          const std::int64_t there = static_cast<std::int64_t>(placed.first_frame) + seam - placed.core.begin;
          double usual = kUnseen;
          for (std::int64_t frame = std::max<std::int64_t>(1, there - kNear);
               frame <= std::min(there + kNear, std::ssize(path) - 2); ++frame) {
            usual = std::max(usual, change_at(path, frame));
          }
          worst = std::max(worst, jump_at(wrists[hand], seam) / usual);
          ++seams;
        };
        // The trunk carries the hand, so its seams are also the hand's.
        for (const TransitionCut& cut : {junction.cuts[0], junction.cuts[1 + hand]}) {
          look(made.clips[i], junction.frames.begin + cut.kept_after() - 1);
          look(made.clips[i + 1], junction.frames.end - cut.kept_before());
        }
      }
    }
    EXPECT_EQ(seams, 8u * made.junctions.size());
    EXPECT_LE(worst, 1.5) << method.name;
  }
}

/// A full stop is stillness, not a slower movement: each hand that does not move to rest and back is still for most of
/// it.
TEST(Pauses, AreStillness) {
  const Synthesis made =
      synthesize(edited_corpus(), parse_utterance("RENNES . METEO . HIER . VANNES . MATIN . PLUIE")).result;
  const auto wrists = wrists_of(made.motion);
  const double hertz = made.motion.rate().hertz();
  int checked = 0;
  for (const Junction& junction : made.junctions) {
    for (const Side side : kSides) {
      const auto hand = static_cast<std::size_t>(side);
      const TransitionCut& cut = junction.cuts[1 + hand];
      if (cut.retraction_frames + cut.preparation_frames > 40) continue;  // moving to the rest position, as captured
      std::int64_t longest = 0;
      std::int64_t still = 0;
      for (std::int64_t frame = junction.frames.begin; frame < junction.frames.end; ++frame) {
        const auto at = static_cast<std::size_t>(frame);
        const double speed = static_cast<double>((wrists[hand][at] - wrists[hand][at - 1]).norm()) * hertz;
        still = speed < 0.03 ? still + 1 : 0;  // metres per second
        longest = std::max(longest, still);
      }
      EXPECT_GE(static_cast<double>(longest) / hertz, 0.4) << junction.from << " to " << junction.to;
      ++checked;
    }
  }
  EXPECT_GE(checked, 5);
}

TEST(Utterances, NeighboursKeepTheirRecordedTransition) {
  const Synthesized made = synthesize(edited_corpus(), parse_utterance("NUAGES#1 APRES-MIDI PLUIE"));
  EXPECT_EQ(made.result.junctions.size(), 0u);
  EXPECT_EQ(made.result.signs.size(), 3u);
}

TEST(Utterances, AnUnknownGlossNamesNearOnes) {
  try {
    synthesize(edited_corpus(), parse_utterance("VANES"));
    FAIL() << "no error";
  } catch (const Error& error) {
    EXPECT_THAT(error.what(), testing::HasSubstr("no sign 'VANES' in this database; did you mean VANNES or NANTES?"));
  }
}

TEST(Utterances, AnErrorForATokenBeyondTheLastGivesTheNumberOfTokens) {
  try {
    synthesize(edited_corpus(), parse_utterance("VANNES#99"));
    FAIL() << "no error";
  } catch (const Error& error) {
    EXPECT_THAT(error.what(),
                testing::HasSubstr("no token 99 of 'VANNES': there are 3, counted by recording name, then time"));
  }
}

TEST(Edits, AGlossThatOccursTwiceNeedsANumber) {
  Edit edit;
  edit.replacements.push_back(parse_replacement("MATIN=VANNES"));
  try {
    synthesize(edited_corpus(), "meteo", edit);
    FAIL() << "no error";
  } catch (const Error& error) {
    EXPECT_THAT(error.what(),
                testing::HasSubstr("'MATIN' occurs 2 times in recording 'meteo'; say which: MATIN#1 to MATIN#2"));
  }
}

TEST(Edits, ReplacingTheFirstSignKeepsThePositionOfTheRecording) {
  Edit edit;
  edit.replacements.push_back(parse_replacement("BONJOUR=VANNES"));
  const Synthesized made = synthesize(edited_corpus(), "meteo", edit);
  EXPECT_EQ(made.layout_from, "meteo");
  EXPECT_EQ(made.result.junctions.size(), 2u);  // everything before the first sign remains
  const Motion meteo = edited_corpus().read("meteo");
  EXPECT_EQ(made.result.motion.pose(0).translations[0], meteo.pose(0).translations[0]);
  const std::int64_t last = made.result.motion.frame_count() - 1;
  EXPECT_EQ(made.result.motion.pose(last).translations[0], meteo.pose(meteo.frame_count() - 1).translations[0]);
}

TEST(Utterances, SigningContinuesWhileARecordingIsReplaced) {
  const TestFolder folder;
  Database::create(folder / "db", {});
  Database writer(folder / "db", kv::Access::read_write);
  writer.put(testing_database::small_recording("a", 1, {"A", "B", "C"}, 300));
  const Database reader(folder / "db", kv::Access::read_only);
  std::atomic<bool> stop = false;
  std::thread replacing([&] {
    for (int i = 0; !stop; ++i) {
      writer.put(testing_database::small_recording("a", i, {"A", "B", "C"}, i % 2 == 0 ? 130 : 300));
    }
  });
  for (int i = 0; i < 200; ++i) {
    const Synthesized made = synthesize(reader, parse_utterance("C A C"));
    EXPECT_EQ(made.result.junctions.size(), 2u);
  }
  stop = true;
  replacing.join();
}

TEST(Edits, SignsWithoutStrokeAtTheRecordingsEndsRemain) {
  const TestFolder folder;
  Database::create(folder / "db", {});
  Database database(folder / "db", kv::Access::read_write);
  Recording recording = testing_database::small_recording("a", 1, {"N0", "A", "B", "C", "N4"}, 300);
  for (Annotation& phase :
       recording.annotation->document.tiers[1].annotations) {  // the outer two consist only of holds
    if (phase.span.begin < 400ms || phase.span.begin >= 1'600ms) phase.label = "Hold";
  }
  database.put(recording);
  Edit edit;
  edit.replacements.push_back(parse_replacement("B=A"));
  EXPECT_THAT(glosses_of(synthesize(database, "a", edit).result), testing::ElementsAre("N0", "A", "A", "C", "N4"));
  edit.replacements = {parse_replacement("A=B")};
  EXPECT_THAT(glosses_of(synthesize(database, "a", edit).result), testing::ElementsAre("N0", "B", "B", "C", "N4"));
}

TEST(Edits, RunsThatShareSignsCannotBeSwapped) {
  Edit edit;
  edit.swap = parse_swap("BRETAGNE..PLUIE,NUAGES#1..DEMAIN");
  EXPECT_THROW(synthesize(edited_corpus(), "meteo", edit), Error);
}

}  // namespace
}  // namespace signweave
