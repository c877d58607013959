#include "signweave/evaluation/evaluate_aim.h"

#include <gtest/gtest.h>

#include "signweave/evaluation/annotated_loci.h"
#include "signweave/render/test_signing_person.h"

namespace signweave {
namespace {

using Eigen::Vector3f;
using testing_person::Person;

constexpr std::int64_t kFrames = 40;  ///< of a token

Locus at(float azimuth) {
  return {.at = point_of({azimuth, 0, kLocusDistance})};
}
Locus self() {
  return {.at = {0, -0.4f, kChestDepth}, .self = true};
}

/// The right wrist goes from the chest to a place that depends on the locus, with a repetition that is 4 mm aside.
EvaluatedMotion signing(const std::vector<float>& azimuths, bool annotated) {
  const Person person;
  Motion motion(person.skeleton, {100, 1});
  std::vector<Sign> signs;
  std::vector<LociOfSign> loci;
  for (std::size_t i = 0; i < azimuths.size(); ++i) {
    const float aside = 0.004f * static_cast<float>(i % 2);
    const Vector3f end = Vector3f(-0.12f, 1.28f, 0) +
                         0.34f * Vector3f(0.6f * std::sin(azimuths[i] / 57.3f), 0, std::cos(azimuths[i] / 80));
    const Motion token = person.stroke(
        [&](Side side, float t) -> Vector3f {
          if (side == Side::left) return {0.25f, 0.85f, 0.1f};
          return Vector3f(-0.12f + aside, 1.25f, 0.2f) + t * (end - Vector3f(-0.12f, 1.25f, 0.2f));
        },
        kFrames, false);
    for (std::int64_t frame = 0; frame < kFrames; ++frame) motion.append(token.pose(frame));
    const auto begin = static_cast<std::int64_t>(10 * kFrames * static_cast<std::int64_t>(i));
    const TimeSpan span{Milliseconds(begin), Milliseconds(begin + 10 * kFrames)};
    signs.push_back({.gloss = "GIVE", .span = span, .phases = {{.kind = PhaseKind::stroke, .span = span}}});
    loci.push_back({.from = self(), .to = at(azimuths[i])});
  }
  const FrameClock clock{motion.rate().frame_time(), Seconds(0)};
  EvaluatedMotion recording = evaluated_motion("a", std::move(motion), person.signer.rig, std::move(signs), clock);
  recording.unusable.assign(recording.unusable.size(), false);  // tokens follow each other without transitions
  if (annotated) recording.loci = std::move(loci);
  return recording;
}
std::vector<float> twice() {
  return {-60, -60, -30, -30, 0, 0, 30, 30, 60, 60};
}

std::vector<AimScore> scores_by(const AimEvaluation& made, AimMethod method) {
  std::vector<AimScore> found;
  for (const AimScore& score : made.scores) {
    if (score.method == method) found.push_back(score);
  }
  return found;
}

TEST(EvaluateAim, LeavesOutEachLocusAndLearnsFromTheOthers) {
  const std::vector<EvaluatedMotion> recordings{signing(twice(), true)};
  const AimEvaluation made = evaluate_aim(recordings);
  ASSERT_EQ(made.glosses.size(), 1u);
  EXPECT_EQ(made.glosses[0].role, SpaceRole::forward);
  EXPECT_EQ(made.glosses[0].with_loci, 10u);
  EXPECT_EQ(made.glosses[0].why_not_learned, "");
  const std::vector<AimScore> learned = scores_by(made, AimMethod::learned);
  ASSERT_EQ(learned.size(), 10u);
  EXPECT_EQ(scores_by(made, AimMethod::cubic).size(), 10u);
  EXPECT_EQ(scores_by(made, AimMethod::nearest).size(), 10u);
  EXPECT_EQ(scores_by(made, AimMethod::citation).size(), 8u);  // not of the citation itself
  for (const AimScore& score : learned) {
    const auto azimuth = [&](std::size_t token) { return twice()[made.tokens[token].sign]; };
    EXPECT_NE(azimuth(score.source), azimuth(score.token));
    if (std::abs(azimuth(score.token)) < 50) EXPECT_LT(score.errors.end_mm, 25) << azimuth(score.token);
  }
  for (const AimScore& score : scores_by(made, AimMethod::seen)) EXPECT_LT(score.errors.path_mm, 15);
  const std::vector<AimScore> floor = scores_by(made, AimMethod::floor);
  ASSERT_EQ(floor.size(), 5u);
  for (const AimScore& score : floor) EXPECT_NEAR(score.errors.path_mm, 4, 0.5);
}

TEST(EvaluateAim, WithoutLociTokensAtOtherPlacesGiveTheirEnds) {
  const std::vector<EvaluatedMotion> recordings{signing(twice(), false)};
  const AimEvaluation made = evaluate_aim(recordings);
  EXPECT_EQ(made.glosses[0].role, SpaceRole::none);
  EXPECT_TRUE(scores_by(made, AimMethod::learned).empty());
  const std::vector<AimScore> ends = scores_by(made, AimMethod::ends);
  ASSERT_EQ(ends.size(), 10u);
  for (const AimScore& score : ends) {
    EXPECT_LT(score.errors.end_mm, 2);
    EXPECT_LT(score.errors.aim_degrees, 1);
  }
}

TEST(EvaluateAim, TokensThatCannotBeComparedAreCounted) {
  std::vector<EvaluatedMotion> recordings{signing(twice(), false)};
  recordings[0].unusable[5] = true;
  recordings[0].signs[3].phases[0].kind = PhaseKind::preparation;
  const AimEvaluation made = evaluate_aim(recordings);
  EXPECT_EQ(made.left_out, 2u);
  EXPECT_EQ(made.tokens.size(), 8u);
}

TEST(RoleOfStrokes, FollowsFromTheLociThatTheEndsAreNear) {
  const Vector3f chest(0, -0.4f, 0.7f);
  const Vector3f left = at(45).at;
  const LociOfSign loci{.from = self(), .to = at(45)};
  EXPECT_EQ(role_of_strokes(std::vector<PlacedStroke>{{loci, chest, left}}), SpaceRole::forward);
  EXPECT_EQ(role_of_strokes(std::vector<PlacedStroke>{{loci, left, chest}}), SpaceRole::backward);
  EXPECT_EQ(role_of_strokes(std::vector<PlacedStroke>{{loci, left, chest, true}}), SpaceRole::both);
  EXPECT_EQ(role_of_strokes(std::vector<PlacedStroke>{{{.at = at(45)}, left, left}}), SpaceRole::aim);
  EXPECT_EQ(role_of_strokes({}), SpaceRole::none);
}

TEST(AnnotatedLoci, AreReadFromTheAnnotationThatCoversASign) {
  AnnotationDocument document;
  const auto tier = [&](const char* id, std::vector<Annotation> annotations) {
    Tier one;
    one.id = id;
    one.annotations = std::move(annotations);
    document.tiers.push_back(std::move(one));
  };
  const auto span = [](int begin, int end) { return TimeSpan{Milliseconds(begin), Milliseconds(end)}; };
  tier("from", {{.id = "a1", .label = "self", .span = span(0, 400)}});
  tier("To", {{.id = "a2", .label = "30/10/1.5", .span = span(0, 300)},
              {.id = "a3", .label = "no where", .span = span(1000, 1400)}});
  const std::vector<Sign> signs{{.gloss = "A", .span = span(0, 500)}, {.gloss = "B", .span = span(1000, 1500)}};
  SignerBody body;
  body.shoulder_width = 0.35f;
  const AnnotatedLoci found = annotated_loci(document, signs, body);
  ASSERT_EQ(found.of.size(), 2u);
  EXPECT_TRUE(found.of[0].from->self);
  EXPECT_NEAR(angles_of(found.of[0].to->at).azimuth, 30, 1e-3f);
  EXPECT_FALSE(found.of[0].at || found.of[1].from || found.of[1].to);
  ASSERT_EQ(found.notices.size(), 1u);
  EXPECT_EQ(found.notices[0].where, "To");
}

PhasePoints straight(const Vector3f& from, const Vector3f& to) {
  PhasePoints points{.hands = {}, .used = {false, true}};
  for (std::size_t k = 0; k < kPhasePoints; ++k) {
    points.hands[1][k].palm = from + static_cast<float>(k) / (kPhasePoints - 1) * (to - from);
  }
  return points;
}

TEST(AimErrors, AreThoseOfEndsDirectionsAndShape) {
  const PhasePoints captured = straight({0, 0, 0.5f}, {0, 0, 1});
  PhasePoints turned = straight({0, 0, 0.5f}, {0.5f, 0, 0.5f});
  for (PhasePoint& point : turned.hands[1]) point.turn = Eigen::AngleAxisf(0.5f, Vector3f::UnitX());
  const AimErrors errors = aim_errors({turned, {}}, {captured, {}}, Side::right, {}, 0.4f);
  EXPECT_NEAR(errors.end_mm, 400 * std::sqrt(0.5), 0.01);
  EXPECT_NEAR(errors.aim_degrees, 90, 0.01);
  EXPECT_NEAR(errors.turn_degrees, 0.5 * 57.29578, 0.01);
  EXPECT_NEAR(errors.shape_mm, 0, 0.01);
  PhasePoints bent = captured;
  bent.hands[1][5].palm.x() += 0.1f;
  EXPECT_GT(aim_errors({bent, {}}, {captured, {}}, Side::right, {}, 0.4f).shape_mm, 5);
}

TEST(AimErrors, APointingFingerIsComparedWithItsLocus) {
  const PhasePoints same = straight({0, 0, 0.5f}, {0, 0, 0.5f});
  HandInSpace hand;
  hand.index_tip = {0, 0, 0.1f};
  const AimErrors errors = aim_errors({same, hand}, {same, {}}, Side::right, at(20), 0.4f);
  EXPECT_NEAR(errors.aim_degrees, 20, 0.01);
  EXPECT_EQ(errors.path_mm, 0);
}

}  // namespace
}  // namespace signweave
