#include "signweave/inflection/edit_stroke.h"

#include <gtest/gtest.h>

#include <array>

#include "signweave/inflection/test_stroke.h"

namespace signweave {
namespace {

using Eigen::Vector3f;
using testing_inflection::kRight;
using testing_inflection::outward;
using testing_inflection::right_alone;
using testing_inflection::Stroke;

/// The path that the affine edit of another system gives for the same numbers: translation, rotations about z, x and y
/// in this order, and scale about the first point. Axes as there: x to the back, y up, z to the signer's left.
Vector3f affine_elsewhere(const Vector3f& point, const Vector3f& first, const Vector3f& translation,
                          const Vector3f& radians, const Vector3f& scale) {
  const Eigen::Matrix3f turn =
      (Eigen::AngleAxisf(radians.y(), Vector3f::UnitY()) * Eigen::AngleAxisf(radians.x(), Vector3f::UnitX()) *
       Eigen::AngleAxisf(radians.z(), Vector3f::UnitZ()))
          .toRotationMatrix();
  return translation + first + turn * Vector3f(scale.cwiseProduct(point - first));
}
Vector3f axes_elsewhere(const Vector3f& ours) {
  return {-ours.z(), ours.y(), ours.x()};
}

TEST(EditStroke, TheSameNumbersGiveThePathOfAnAffineEdit) {
  Stroke stroke(right_alone(outward));
  SpaceChange change;
  change.move = {-4, 6, 3};  // left, up, forward
  change.turn = {0, 25, 0};  // about up, the one axis that both conventions share
  change.scale = {1.2f, 1.5f, 0.8f};
  const FittedChange fitted = edit_stroke(stroke.changer, stroke.captured, change);
  ASSERT_EQ(fitted.share, 1) << fitted.why;
  const auto changed = stroke.changed(fitted.change);
  const Vector3f first = axes_elsewhere(stroke.captured.first(Side::right).palm);
  const auto palm_at = [&](const MotionSource& of, std::int64_t frame) {
    return axes_elsewhere(stroke.hand(of, frame, Side::right).palm);
  };
  for (std::int64_t frame = Stroke::kCore.begin; frame < Stroke::kCore.end; ++frame) {
    const Vector3f expected = affine_elsewhere(palm_at(*stroke.source, frame), first, {-0.03f, 0.06f, -0.04f},
                                               {0, 25 * 0.0174533f, 0}, {0.8f, 1.5f, 1.2f});
    EXPECT_LT((palm_at(*changed, frame) - expected).norm(), 1e-3f) << frame;
  }
}

TEST(EditStroke, BigMovesFartherAboutTheSameMiddle) {
  Stroke stroke(right_alone(outward));
  SpaceChange change;
  change.size = kBig;
  const FittedChange fitted = edit_stroke(stroke.changer, stroke.captured, change);
  ASSERT_EQ(fitted.share, 1) << fitted.why;
  const auto changed = stroke.changed(fitted.change);
  const auto ends = [&](const MotionSource& of) {
    return std::pair<Vector3f, Vector3f>(stroke.hand(of, Stroke::kCore.begin, Side::right).palm,
                                         stroke.hand(of, Stroke::kCore.end - 1, Side::right).palm);
  };
  const auto before = ends(*stroke.source);
  const auto after = ends(*changed);
  EXPECT_NEAR((after.second - after.first).norm() / (before.second - before.first).norm(), kBig, 1e-3f);
  EXPECT_LT((after.second + after.first - before.second - before.first).norm(), 0.02f);
}

TEST(EditStroke, HandsThatMoveApartMoveFartherApartIfBig) {
  Stroke stroke([](Side side, float t) -> Vector3f {
    const float u = std::clamp(2 * t - 0.5f, 0.0f, 1.0f);
    const float s = side == Side::left ? 1.0f : -1.0f;
    return {s * (0.15f + 0.12f * u), 1.22f, 0.3f};
  });
  ASSERT_TRUE(stroke.captured.both_move);
  ASSERT_FALSE(stroke.captured.touch);
  SpaceChange change;
  change.size = kBig;
  const FittedChange fitted = edit_stroke(stroke.changer, stroke.captured, change);
  ASSERT_EQ(fitted.share, 1) << fitted.why;
  const auto changed = stroke.changed(fitted.change);
  const auto apart = [&](const MotionSource& of, std::int64_t frame) {
    return (stroke.hand(of, frame, Side::left).palm - stroke.hand(of, frame, Side::right).palm).norm();
  };
  const auto widened = [&](const MotionSource& of) {
    return apart(of, Stroke::kCore.end - 1) - apart(of, Stroke::kCore.begin);
  };
  EXPECT_NEAR(widened(*changed) / widened(*stroke.source), kBig, 0.01f);
}

TEST(EditStroke, AMoveBeyondReachIsDoneAsFarAsTheArmGoes) {
  Stroke stroke(right_alone(outward));
  SpaceChange change;
  change.move = {0, 0, 90};
  const FittedChange fitted = edit_stroke(stroke.changer, stroke.captured, change);
  EXPECT_LT(fitted.share, 0.8f);
  EXPECT_NE(fitted.why.find("the right hand would be"), std::string::npos) << fitted.why;
  EXPECT_NE(fitted.why.find("beyond its reach"), std::string::npos) << fitted.why;
}

TEST(EditStroke, TheHandGoesAlongItsPlacesAndTurnsWithItsPath) {
  Stroke stroke(right_alone(outward));
  const std::array places = {stroke.locus("-0.9,-0.3,1"), stroke.locus("-0.2,-0.3,1.2"), stroke.locus("0.3,-0.3,0.9")};
  const float unit = stroke.changer.body().shoulder_width;
  for (const bool keeps_turn : {false, true}) {
    const FittedChange fitted = take_along(stroke.changer, stroke.captured, places, keeps_turn);
    ASSERT_EQ(fitted.share, 1) << fitted.why;
    const auto changed = stroke.changed(fitted.change);
    const HandInSpace begin = stroke.hand(*changed, Stroke::kCore.begin, Side::right);
    const HandInSpace end = stroke.hand(*changed, Stroke::kCore.end - 1, Side::right);
    EXPECT_LT((begin.palm - unit * places[0].at).norm(), 0.005f);
    EXPECT_LT((end.palm - unit * places[2].at).norm(), 0.005f);
    float nearest = 1;
    for (std::int64_t frame = Stroke::kCore.begin; frame < Stroke::kCore.end; ++frame) {
      nearest = std::min(nearest, (stroke.hand(*changed, frame, Side::right).palm - unit * places[1].at).norm());
    }
    EXPECT_LT(nearest, 0.01f);
    const float turned = begin.turn.angularDistance(end.turn);
    const float captured =
        stroke.captured.first(Side::right).turn.angularDistance(stroke.captured.last(Side::right).turn);
    if (keeps_turn) {
      EXPECT_NEAR(turned, captured, 0.01f);
    } else {
      EXPECT_GT(turned, 0.3f);
    }
  }
}

TEST(EditStroke, TheHandGoesPastItsPlace) {
  Stroke stroke(right_alone(outward));
  const Locus place = stroke.locus("-0.7,-0.2,1");
  const FittedChange fitted = take_past(stroke.changer, stroke.captured, place, false);
  ASSERT_EQ(fitted.share, 1) << fitted.why;
  const auto changed = stroke.changed(fitted.change);
  float nearest = 1;
  for (std::int64_t frame = Stroke::kCore.begin; frame < Stroke::kCore.end; ++frame) {
    nearest = std::min(
        nearest,
        (stroke.hand(*changed, frame, Side::right).palm - stroke.changer.body().shoulder_width * place.at).norm());
  }
  EXPECT_LT(nearest, 0.005f);
}

}  // namespace
}  // namespace signweave
