#include "signweave/inflection/learned_stroke.h"

#include <gtest/gtest.h>

#include <random>

#include "signweave/inflection/test_stroke.h"
#include "signweave/inflection/turns.h"

namespace signweave {
namespace {

using Eigen::Quaternionf;
using Eigen::Vector3f;
using inflection::of_vector;
using inflection::vector_of;
using testing_inflection::kRight;
using testing_inflection::outward;
using testing_inflection::right_alone;
using testing_inflection::Stroke;

constexpr float kDegree = std::numbers::pi_v<float> / 180;

Locus at(float azimuth, float elevation = 0, float distance = kLocusDistance) {
  return {.at = point_of({azimuth, elevation, distance})};
}
Locus self() {
  return {.at = {0, -0.4f, kChestDepth}, .self = true};
}
SignerBody body() {
  SignerBody body;
  body.shoulder_width = 0.35f;
  body.arm_length = 1.5f;
  return body;
}

/// A law: from the chest to a place before the locus, which is nearer than it on the right; the hand turns half as far.
PhasePoints stroke_to(const Locus& locus, const Vector3f& shift = Vector3f::Zero()) {
  PhasePoints points{.hands = {}, .used = {false, true}};
  const float azimuth = angles_of(locus.at).azimuth;
  const Vector3f end = point_of({azimuth, -15, 0.8f + 0.2f * std::tanh(azimuth / 30)});
  for (std::size_t k = 0; k < kPhasePoints; ++k) {
    const float done = static_cast<float>(k) / (kPhasePoints - 1);
    PhasePoint& point = points.hands[kRight][k];
    point.palm = (1 - done) * Vector3f(-0.1f, -0.4f, 0.6f) + done * end + shift;
    // Near half a turn, where signs of quaternions and angles flip.
    point.turn = Quaternionf(Eigen::AngleAxisf((175 + 0.5f * done * azimuth) * kDegree, Vector3f::UnitY()));
    if (k % 2 == 1) point.turn.coeffs() *= -1;
    point.swivel = inflection::wrapped((178 + 0.2f * azimuth) * kDegree);
  }
  return points;
}
constexpr float kAzimuths[] = {-75, -50, -25, 0, 25, 50, 75};

std::vector<StrokeToken> tokens_of(float noise, int rounds = 3) {
  std::mt19937 random(7);
  std::normal_distribution<float> drawn(0, noise);
  std::vector<StrokeToken> tokens;
  for (int round = 0; round < rounds; ++round) {
    for (const float azimuth : kAzimuths) {
      const Locus locus = at(azimuth);
      const Vector3f shift(drawn(random), drawn(random), drawn(random));
      tokens.push_back({.points = stroke_to(locus, shift), .loci = {.from = self(), .to = locus}});
    }
  }
  return tokens;
}
double path_error(const PhasePoints& a, const PhasePoints& b) {
  double squares = 0;
  for (std::size_t k = 0; k < kPhasePoints; ++k) {
    squares += static_cast<double>((a.hands[kRight][k].palm - b.hands[kRight][k].palm).squaredNorm()) / kPhasePoints;
  }
  return std::sqrt(squares);
}

TEST(LearnedStroke, PredictsALocusBetweenThoseSeenBetterThanItsNoise) {
  const auto learned = LearnedStroke::learn(tokens_of(0.01f), SpaceRole::forward, body());
  ASSERT_TRUE(learned.stroke) << learned.why_not;
  EXPECT_EQ(learned.stroke->tokens(), 21u);
  EXPECT_EQ(learned.stroke->loci(), 7u);
  for (const float azimuth : {-60.0f, -12.0f, 8.0f, 37.0f}) {
    const Prediction made = learned.stroke->predict({.from = self(), .to = at(azimuth)});
    EXPECT_TRUE(made.inside) << azimuth << made.why_outside;
    EXPECT_LT(path_error(made.points, stroke_to(at(azimuth))), 0.017) << azimuth;
    const PhasePoint& last = made.points.hands[kRight].back();
    const PhasePoint truth = stroke_to(at(azimuth)).hands[kRight].back();
    EXPECT_LT(vector_of(last.turn * truth.turn.conjugate()).norm(), 3 * kDegree) << azimuth;
    EXPECT_LT(std::abs(inflection::wrapped(last.swivel - truth.swivel)), 3 * kDegree) << azimuth;
    EXPECT_FALSE(made.points.used[0]);
  }
}

TEST(LearnedStroke, ExpectsTheErrorThatItHas) {
  const float noise = 0.015f;  // of each coordinate
  const auto learned = LearnedStroke::learn(tokens_of(noise), SpaceRole::forward, body());
  ASSERT_TRUE(learned.stroke);
  const Prediction made = learned.stroke->predict({.from = self(), .to = at(10)});
  const float whole = 1000 * 0.35f * noise * std::sqrt(3.0f);
  EXPECT_GT(made.error_mm, 0.75f * whole);
  EXPECT_LT(made.error_mm, 1.5f * whole);
  EXPECT_NEAR(made.noise_mm, whole, 0.35f * whole);
  EXPECT_EQ(why_learned(*learned.stroke, made).substr(0, 41), "learned from 21 tokens at 7 loci, expecte");
}

TEST(LearnedStroke, TheProcessFollowsWhatTheCubicCannot) {
  std::vector<StrokeToken> tokens = tokens_of(0.002f);
  std::erase_if(tokens, [](const StrokeToken& one) { return std::abs(angles_of(one.loci.to->at).azimuth - 25) < 1; });
  const LociOfSign wanted{.from = self(), .to = at(25)};
  const auto process = LearnedStroke::learn(tokens, SpaceRole::forward, body());
  const auto cubic = LearnedStroke::learn(tokens, SpaceRole::forward, body(), LearnedStroke::Model::cubic_alone);
  ASSERT_TRUE(process.stroke && cubic.stroke);
  const double by_process = path_error(process.stroke->predict(wanted).points, stroke_to(at(25)));
  EXPECT_LT(by_process, path_error(cubic.stroke->predict(wanted).points, stroke_to(at(25))));
  EXPECT_LT(by_process, 0.03);
}

TEST(LearnedStroke, HandsOverWhereNothingWasSeen) {
  const auto learned = LearnedStroke::learn(tokens_of(0.01f), SpaceRole::forward, body());
  ASSERT_TRUE(learned.stroke);
  const Prediction behind = learned.stroke->predict({.from = self(), .to = at(108)});
  EXPECT_FALSE(behind.inside);
  EXPECT_EQ(behind.why_outside, "no token's locus is nearer than 33°");
  EXPECT_EQ(why_geometric("DONNER#4", behind.why_outside),
            "geometric from DONNER#4: no token's locus is nearer than 33°");
  EXPECT_FALSE(learned.stroke->predict({.from = self(), .to = at(0, 0, 6)}).inside);
  EXPECT_FALSE(learned.stroke->predict({.from = self(), .to = self()}).inside);
  EXPECT_FALSE(learned.stroke->predict({.from = self(), .to = {}}).inside);
}

TEST(LearnedStroke, TheNearestTokenIsThatOfTheNearestLocus) {
  const std::vector<StrokeToken> tokens = tokens_of(0.01f);
  const auto learned = LearnedStroke::learn(tokens, SpaceRole::forward, body());
  const Prediction made = learned.stroke->predict({.from = self(), .to = at(45)});
  EXPECT_NEAR(angles_of(tokens[made.nearest].loci.to->at).azimuth, 50, 1);
}

TEST(LearnedStroke, FewTokensOrLociAreRefused) {
  const std::vector<StrokeToken> tokens = tokens_of(0.01f);
  EXPECT_EQ(LearnedStroke::learn(std::span(tokens).first(2), SpaceRole::forward, body()).why_not,
            "2 tokens with loci are too few");
  const std::vector<StrokeToken> same(9, tokens[2]);
  EXPECT_EQ(LearnedStroke::learn(same, SpaceRole::aim, body()).why_not, "tokens at 1 locus are too few");
}

/// What the hand does at the phase points once a change is made.
PhasePoints made_by(Stroke& stroke, const FittedChange& fitted) {
  std::array<PathSpline, 2> paths;
  paths[kRight] = PathSpline(fitted.change.arms[kRight]->path);
  return phase_points(stroke.changer, *stroke.source, stroke.captured, [&](float time, MutablePoseView pose) {
    stroke.changer.apply(fitted.change, paths, stroke.captured.space, 1, time, pose);
  });
}

TEST(ChangeTo, TakesTheHandToPointsAndKeepsFingers) {
  Stroke stroke(right_alone(outward));
  const PhasePoints own = phase_points(stroke.changer, *stroke.source, stroke.captured);
  ASSERT_TRUE(own.used[kRight]);
  ASSERT_FALSE(own.used[0]);
  PhasePoints wanted = own;
  for (std::size_t k = 0; k < kPhasePoints; ++k) {
    const float done = static_cast<float>(k) / (kPhasePoints - 1);
    PhasePoint& point = wanted.hands[kRight][k];
    point.palm += done * Vector3f(-0.2f, 0.05f, -0.1f);
    point.turn = of_vector(done * Vector3f(0, -0.2f, 0.1f)) * point.turn;
    point.swivel += 0.15f * done;
  }
  const FittedChange fitted = change_to(stroke.changer, stroke.captured, own, wanted);
  ASSERT_EQ(fitted.share, 1) << fitted.why;
  EXPECT_EQ(fitted.relief, 0);
  const PhasePoints made = made_by(stroke, fitted);
  for (std::size_t k = 0; k < kPhasePoints; ++k) {
    const PhasePoint& a = made.hands[kRight][k];
    const PhasePoint& b = wanted.hands[kRight][k];
    EXPECT_LT((a.palm - b.palm).norm(), 0.006f) << k;
    EXPECT_LT(vector_of(a.turn * b.turn.conjugate()).norm(), 0.5f * kDegree) << k;
    EXPECT_NEAR(a.swivel, b.swivel, 3 * kDegree) << k;
  }
}

TEST(ChangeTo, ItsOwnPointsChangeNothing) {
  Stroke stroke(right_alone(outward));
  const PhasePoints own = phase_points(stroke.changer, *stroke.source, stroke.captured);
  const FittedChange fitted = change_to(stroke.changer, stroke.captured, own, own);
  EXPECT_EQ(fitted.share, 1);
  EXPECT_LT(fitted.moved_mm, 0.1f);
  EXPECT_LT(fitted.turned_degrees, 0.1f);
}

TEST(ChangeTo, ArmsStayWithinTheirReach) {
  Stroke stroke(right_alone(outward));
  const PhasePoints own = phase_points(stroke.changer, *stroke.source, stroke.captured);
  PhasePoints wanted = own;
  for (PhasePoint& point : wanted.hands[kRight]) point.palm += Vector3f(0, 0, 4);
  const FittedChange fitted = change_to(stroke.changer, stroke.captured, own, wanted);
  EXPECT_LT(fitted.share, 1);
  EXPECT_NE(fitted.why.find("beyond its reach"), std::string::npos) << fitted.why;
}

TEST(SwivelOf, IsWhatTheElbowIsSwivelledBy) {
  Stroke stroke(right_alone(outward));
  const HandInSpace before = stroke.hand(*stroke.source, 30, Side::right);
  Pose pose(*stroke.person.skeleton);
  stroke.source->read({30, 31}, {pose.rotations, pose.translations});
  const ModelPose model = to_model_space(*stroke.person.skeleton, std::as_const(pose).view());
  swivel_elbow(*stroke.person.skeleton, stroke.person.arm(Side::right), model, 0.3f, pose.view());
  const HandInSpace after = stroke.changer.look(std::as_const(pose).view(), stroke.captured.space, Side::right);
  EXPECT_NEAR(swivel_of(after) - swivel_of(before), 0.3f, 1e-3f);
}

}  // namespace
}  // namespace signweave
