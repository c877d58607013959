#include "signweave/features/segmenter.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "signweave/annotation/sign.h"
#include "signweave/features/phase_model.h"
#include "signweave/features/phase_proposals.h"

namespace signweave {
namespace {

constexpr auto kRight = static_cast<std::size_t>(Side::right);
constexpr auto kLeft = static_cast<std::size_t>(Side::left);

/// Position of the right hand: on the lap, up within half a second at 3 s, to and fro in front of the chest, down again
/// at 6 s.
Eigen::Vector3f right_hand(double second) {
  const Eigen::Vector3f lap(-0.15F, -0.25F, 0.2F);
  const Eigen::Vector3f chest(-0.2F, 0.15F, 0.35F);
  const auto smooth = [](double x) {
    const double part = std::clamp(x, 0.0, 1.0);
    return static_cast<float>(part * part * (3 - 2 * part));
  };
  const float up = smooth((second - 3) / 0.5) - smooth((second - 6) / 0.5);
  const float wave = second > 3.5 && second < 6 ? 0.08F * static_cast<float>(std::sin(9 * (second - 3.5))) : 0.0F;
  return lap + up * (chest - lap) + Eigen::Vector3f(wave, 0.5F * wave, 0);
}

/// One movement of the right hand in ten seconds; the left one rests.
UpperBodyTrack one_gesture(double rate) {
  UpperBodyTrack track;
  const auto count = static_cast<std::size_t>(10 * rate);
  for (std::size_t i = 0; i < count; ++i) {
    const double second = static_cast<double>(i) / rate;
    const Eigen::Vector3f right = right_hand(second);
    const Eigen::Vector3f left(0.15F, -0.25F, 0.2F);
    track.times.emplace_back(second);
    track.bodies.push_back(
        {.hands = {left, right}, .wrists = {left, right}, .head = {0, 0.47F, 0}, .spine = {0, 0, 0}});
  }
  return track;
}

MotionPhase phase_at(const std::vector<ProposedPhase>& phases, double second) {
  for (const ProposedPhase& one : phases) {
    if (one.begin.count() <= second && second < one.end.count()) return one.phase;
  }
  ADD_FAILURE() << "nothing proposed at " << second;
  return MotionPhase::rest;
}

TEST(Segmenter, OneGestureIsRestPreparationStrokeRetractionRest) {
  const std::vector<ProposedPhase> right = propose_phases(one_gesture(30)).hands[kRight];
  EXPECT_EQ(phase_at(right, 1.0), MotionPhase::rest);
  EXPECT_EQ(phase_at(right, 3.2), MotionPhase::preparation);
  EXPECT_EQ(phase_at(right, 4.7), MotionPhase::stroke);
  EXPECT_EQ(phase_at(right, 6.3), MotionPhase::retraction);
  EXPECT_EQ(phase_at(right, 9.0), MotionPhase::rest);
}

TEST(Segmenter, AHandThatNeverMovesRests) {
  const std::vector<ProposedPhase> left = propose_phases(one_gesture(30)).hands[kLeft];
  ASSERT_EQ(left.size(), 1u);
  EXPECT_EQ(left[0].phase, MotionPhase::rest);
}

TEST(Segmenter, PhasesAreContiguousAndCoverTheRecording) {
  const std::vector<ProposedPhase> right = propose_phases(one_gesture(60)).hands[kRight];
  ASSERT_GE(right.size(), 5u);
  EXPECT_EQ(right.front().begin, Seconds(0));
  EXPECT_NEAR(right.back().end.count(), 10, 0.05);
  for (std::size_t i = 0; i < right.size(); ++i) {
    EXPECT_LT(right[i].begin, right[i].end);
    EXPECT_GT(right[i].confidence, 0.2F);
    EXPECT_LE(right[i].confidence, 1.0F);
    if (i == 0) continue;
    EXPECT_EQ(right[i].begin, right[i - 1].end);
    EXPECT_NE(right[i].phase, right[i - 1].phase);
  }
}

void expect_same(const std::vector<ProposedPhase>& phases, const std::vector<ProposedPhase>& expected, float most) {
  ASSERT_EQ(phases.size(), expected.size());
  for (std::size_t i = 0; i < phases.size(); ++i) {
    EXPECT_EQ(phases[i].phase, expected[i].phase);
    EXPECT_EQ(phases[i].begin, expected[i].begin);
    EXPECT_NEAR(phases[i].confidence, expected[i].confidence, most);
  }
}

TEST(Segmenter, AMirroredSignerGetsTheSamePhases) {
  UpperBodyTrack mirrored = one_gesture(30);
  for (UpperBody& body : mirrored.bodies) {
    std::swap(body.hands[0], body.hands[1]);
    std::swap(body.wrists[0], body.wrists[1]);
    for (std::size_t side = 0; side < 2; ++side) {
      body.hands[side].x() *= -1;
      body.wrists[side].x() *= -1;
    }
  }
  expect_same(propose_phases(mirrored).hands[kLeft], propose_phases(one_gesture(30)).hands[kRight], 1e-6F);
}

TEST(Segmenter, UnitAndPositionDoNotMatter) {
  UpperBodyTrack track = one_gesture(30);
  for (UpperBody& body : track.bodies) {
    for (Eigen::Vector3f* point :
         {&body.hands[0], &body.hands[1], &body.wrists[0], &body.wrists[1], &body.head, &body.spine}) {
      *point = 100.0F * *point + Eigen::Vector3f(200, 100, -300);
    }
  }
  expect_same(propose_phases(track).hands[kRight], propose_phases(one_gesture(30)).hands[kRight], 1e-3F);
}

TEST(Segmenter, TheFrameRateHardlyMatters) {
  const std::vector<ProposedPhase> slow = propose_phases(one_gesture(30)).hands[kRight];
  const std::vector<ProposedPhase> fast = propose_phases(one_gesture(120)).hands[kRight];
  for (int k = 0; k < 20; ++k) {
    const double second = 0.25 + 0.5 * k;
    EXPECT_EQ(phase_at(fast, second), phase_at(slow, second)) << second;
  }
}

TEST(Segmenter, NothingIsProposedInAGap) {
  UpperBodyTrack track = one_gesture(30);
  for (std::size_t i = 240; i < track.times.size(); ++i) track.times[i] += Seconds(40);
  const std::vector<ProposedPhase> right = propose_phases(track).hands[kRight];
  for (const ProposedPhase& one : right) EXPECT_FALSE(one.begin < Seconds(20) && one.end > Seconds(20));
  EXPECT_NEAR(right.back().end.count(), 50, 0.05);
}

TEST(Segmenter, AnAbsentHandIsLeftOutWithANotice) {
  UpperBodyTrack track = one_gesture(30);
  track.has_hand[kLeft] = false;
  for (UpperBody& body : track.bodies) body.hands[kLeft].setConstant(std::numeric_limits<float>::quiet_NaN());
  const ProposedPhases proposed = propose_phases(track);
  EXPECT_TRUE(proposed.hands[kLeft].empty());
  EXPECT_FALSE(proposed.hands[kRight].empty());
  ASSERT_EQ(proposed.notices.size(), 1u);
  EXPECT_THAT(proposed.notices[0].text, testing::HasSubstr("no left hand"));
}

TEST(Segmenter, OneMomentGivesOnePhaseAndNoneGivesNone) {
  UpperBodyTrack track = one_gesture(30);
  track.times.resize(1);
  track.bodies.resize(1);
  EXPECT_EQ(propose_phases(track).hands[kRight].size(), 1u);
  EXPECT_TRUE(propose_phases({}).hands[kRight].empty());
}

TEST(Segmenter, InvalidValuesAreRefused) {
  UpperBodyTrack backwards = one_gesture(30);
  backwards.times[7] = backwards.times[6];
  EXPECT_THROW(propose_phases(backwards), Error);
  UpperBodyTrack wild = one_gesture(30);
  wild.bodies[3].head.x() = std::numeric_limits<float>::infinity();
  EXPECT_THROW(propose_phases(wild), Error);
  UpperBodyTrack short_of_times = one_gesture(30);
  short_of_times.times.pop_back();
  EXPECT_THROW(propose_phases(short_of_times), Error);
}

TEST(PhaseModel, PackingTwiceChangesNothing) {
  const PhaseModel& model = built_in_phase_model();
  EXPECT_FALSE(model.networks.empty());
  const std::vector<int> once = packed(model);
  EXPECT_EQ(packed(unpacked(once)), once);
}

// A single outlier frame does not justify two phase borders.
TEST(PhaseModel, TheMostLikelySequenceIgnoresOneOutlier) {
  std::vector<PhaseProbabilities> frames(21, PhaseProbabilities{0.8F, 0.05F, 0.05F, 0.05F, 0.05F});
  frames[10] = {0.3F, 0.1F, 0.4F, 0.1F, 0.1F};
  const std::vector<MotionPhase> phases = most_likely_phases(built_in_phase_model(), frames);
  EXPECT_THAT(phases, testing::Each(MotionPhase::rest));
  PhaseModel hasty = built_in_phase_model();
  hasty.step = {};
  EXPECT_EQ(most_likely_phases(hasty, frames)[10], MotionPhase::stroke);
}

TEST(PhaseProposals, ConfidenceIsAChildOfEachPhase) {
  ProposedPhases proposed;
  proposed.hands[kRight] = {{MotionPhase::rest, Seconds(0), Seconds(0.5), 0.9F},
                            {MotionPhase::stroke, Seconds(0.5), Seconds(1.04), 0.5F},
                            {MotionPhase::hold, Seconds(1.04), Seconds(1.1), 0.5F}};
  const AnnotationDocument document = proposals_document(proposed, Seconds(1), "a.bvh");
  ASSERT_EQ(document.tiers.size(), 2u);  // no left hand, so no tiers for it
  const Tier& phases = document.tiers[0];
  const Tier& sure = document.tiers[1];
  EXPECT_EQ(phases.id, "Phase RH (proposed)");
  EXPECT_EQ(sure.parent, phases.id);
  ASSERT_EQ(phases.annotations.size(), 2u);  // phases after the motion's end are omitted
  EXPECT_EQ(phases.annotations[1].span, (TimeSpan{500ms, 1'000ms}));
  EXPECT_EQ(sure.annotations[0].label, "0.90");
  EXPECT_EQ(sure.annotations[0].parent, phases.annotations[0].id);
  ASSERT_EQ(document.properties.size(), 1u);
  EXPECT_EQ(document.properties[0].first, "signweave:proposed");
  for (const Annotation& one : phases.annotations) EXPECT_NE(phase_kind_of(one.label, {}), PhaseKind::other);
}

}  // namespace
}  // namespace signweave
