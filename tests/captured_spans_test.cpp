// The method `recorded` on whole databases: which captured transitions it uses.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <set>

#include "signweave/choose/captured_spans.h"
#include "signweave/choose/synthesizer.h"
#include "signweave/database/test_recording.h"
#include "signweave/database/test_signing.h"
#include "signweave/features/transition_stats.h"
#include "signweave/semantic_db/semantic_db.h"
#include "signweave/transition/learned.h"
#include "tests/demo_database.h"

namespace signweave {
namespace {

using testing_database::recording_of;
using testing_database::TestFolder;

/// The paper's two scenarios in a database, created once.
const Database& two_recordings_corpus() {
  static const TestFolder folder;
  static const std::unique_ptr<const Database> database = [] {
    const std::vector<demo::Script> scripts = {demo::meteo(), demo::villes()};
    return demo_database(folder / "db", scripts);
  }();
  return *database;
}

Synthesized sign_with(const Database& database, const char* utterance, const char* method) {
  return synthesize(
      database, parse_utterance(utterance),
      {.method = method != nullptr ? find_transition_method(method) : nullptr, .duration = {.fitted = false}});
}

JointGroups groups_of(const Database& database, std::string_view recording) {
  const Motion motion = database.read(recording);
  return joint_groups(motion.skeleton(), map_rig(motion));
}

bool same_frames(const Motion& a, const Motion& b) {
  return a.frame_count() == b.frame_count() &&
         std::ranges::equal(a.rotations(), b.rotations(),
                            [](const auto& x, const auto& y) { return x.coeffs() == y.coeffs(); });
}

TEST(CapturedSpans, AreTheAnnotatedTransitionsOfTheSkeleton) {
  const Snapshot snapshot = two_recordings_corpus().snapshot();
  const auto skeleton = two_recordings_corpus().skeleton("meteo");
  const CapturedSpans captured =
      captured_spans(snapshot, *skeleton, groups_of(two_recordings_corpus(), "meteo"), Needs::spans);
  EXPECT_EQ(captured.transitions, 32u + 21u);
  ASSERT_EQ(captured.model->libraries.size(), 1u);
  const std::vector<CapturedSpan>& spans = captured.model->libraries[0]->spans;
  ASSERT_EQ(spans.size(), 2u * (32 + 21));  // each once complete, once without its first and last quarter
  const Contents& contents = snapshot.contents();
  std::size_t at = 0;
  for (std::uint32_t recording = 0; recording < 2; ++recording) {
    for (const AnnotatedTransition& one : transitions_in(signs_of(contents.segments, recording))) {
      const double seconds = Seconds(one.span.duration()).count();
      EXPECT_NEAR(static_cast<double>(spans[at].seconds), seconds, 0.021);
      EXPECT_NEAR(static_cast<double>(spans[at + 1].seconds), seconds / 2, 0.031);
      at += 2;
    }
  }
  // The rest is as learned.
  EXPECT_EQ(captured.model->bends, default_transition_model().bends);
  EXPECT_EQ(captured.model->damping, default_transition_model().damping);
}

TEST(CapturedSpans, ThereAreNoneOfAnotherSkeleton) {
  const Motion other = testing_database::signing(10, 1);
  const CapturedSpans captured = captured_spans(two_recordings_corpus().snapshot(), other.skeleton(),
                                                joint_groups(other.skeleton(), map_rig(other)), Needs::spans);
  EXPECT_EQ(captured.transitions, 0u);
  EXPECT_TRUE(captured.model->libraries.empty());
}

TEST(RecordedMethod, UsesTheCapturedTransitionsOfTheDatabase) {
  const char* const utterance = "VANNES PLUIE MATIN";
  const Synthesized recorded = sign_with(two_recordings_corpus(), utterance, "recorded");
  EXPECT_EQ(recorded.captured_transitions, 53u);
  EXPECT_TRUE(recorded.result.notices.empty());
  EXPECT_FALSE(
      same_frames(recorded.result.motion, sign_with(two_recordings_corpus(), utterance, "kriging").result.motion));
  EXPECT_TRUE(
      same_frames(recorded.result.motion, sign_with(two_recordings_corpus(), utterance, "recorded").result.motion));
}

TEST(RecordedMethod, StrokesKeepTheirBits) {
  const Synthesized recorded = sign_with(two_recordings_corpus(), "VANNES PLUIE MATIN", "recorded");
  const Synthesized other = sign_with(two_recordings_corpus(), "VANNES PLUIE MATIN", "kriging");
  std::size_t compared = 0;
  for (const ShownClip& placed : recorded.result.clips) {
    for (std::int64_t frame = placed.core.begin; frame < placed.core.end; ++frame, ++compared) {
      for (std::size_t joint = 0; joint < recorded.result.motion.skeleton().joint_count(); ++joint) {
        const Eigen::Vector4f a = recorded.result.motion.pose(frame).rotations[joint].coeffs();
        const Eigen::Vector4f b = other.result.motion.pose(frame).rotations[joint].coeffs();
        ASSERT_TRUE(a == b || a == -b) << frame << ' ' << joint;
      }
    }
  }
  EXPECT_GT(compared, 50u);
}

TEST(RecordedMethod, OtherMethodsUseNone) {
  for (const TransitionMethod& method : transition_methods()) {
    const Synthesized made = sign_with(two_recordings_corpus(), "VANNES PLUIE", std::string(method.name).c_str());
    EXPECT_EQ(made.captured_transitions.has_value(), method.name == "recorded") << method.name;
  }
  EXPECT_FALSE(sign_with(two_recordings_corpus(), "VANNES", "recorded")
                   .captured_transitions.has_value());  // no transition to generate
}

TEST(TaughtMethod, BendsIfResidualsWereLearned) {
  const char* const utterance = "VANNES PLUIE MATIN";
  ASSERT_FALSE(two_recordings_corpus().snapshot().learned()->residuals.centres.empty());
  const Synthesized taught = sign_with(two_recordings_corpus(), utterance, nullptr);
  EXPECT_EQ(taught.result.junctions[0].method, "taught");
  EXPECT_FALSE(
      same_frames(taught.result.motion, sign_with(two_recordings_corpus(), utterance, "kriging").result.motion));
}

TEST(TaughtMethod, EqualsKrigingIfNothingWasLearned) {
  const TestFolder folder;
  Database::create(folder / "db", {});
  Database database(folder / "db", kv::Access::read_write);
  database.put(recording_of("one", 1, {"A", "B", "C"}));
  ASSERT_TRUE(database.snapshot().learned()->residuals.centres.empty());
  const Synthesized taught = sign_with(database, "C A", nullptr);
  EXPECT_TRUE(taught.result.notices.empty());
  EXPECT_TRUE(same_frames(taught.result.motion, sign_with(database, "C A", "kriging").result.motion));
}

TEST(RecordedMethod, WithoutAnnotatedTransitionsFallsBackToKrigingWithANotice) {
  const TestFolder folder;
  Database::create(folder / "db", {});
  Database database(folder / "db", kv::Access::read_write);
  Recording recording = recording_of("one", 1, {"A", "B", "C"});
  // Signs without phases: only gaps between them are known.
  auto& tiers = recording.annotation->document.tiers;
  for (Tier& tier : tiers) {
    if (tier.id == "Phase") tier.annotations.clear();
  }
  recording.annotation->document.source.clear();
  database.put(recording);
  const Synthesized recorded = sign_with(database, "C A", "recorded");
  EXPECT_EQ(recorded.captured_transitions, 0u);
  std::vector<std::string> notices;
  for (const Notice& notice : recorded.result.notices) notices.push_back(notice.text);
  EXPECT_THAT(notices, testing::Contains(testing::HasSubstr("no annotated transitions of this skeleton")));
  EXPECT_TRUE(same_frames(recorded.result.motion, sign_with(database, "C A", "kriging").result.motion));
}

}  // namespace
}  // namespace signweave
