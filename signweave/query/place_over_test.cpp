#include "signweave/query/place_over.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "signweave/query/corpus_for_tests.h"
#include "signweave/query/explain.h"
#include "signweave/query/find.h"
#include "signweave/query/movement_check.h"
#include "signweave/query/movement_for_tests.h"
#include "signweave/query/parse.h"

namespace signweave {
namespace {

using Eigen::Vector3d;
using testing::HasSubstr;
using testing::Not;

constexpr double kDegrees = 180 / std::numbers::pi;

Condition place_condition(const std::string& text) {
  return parse(text).elements.front().term.expression.condition;
}

/// Rows of random spans in a random motion.
struct RandomRows {
  TestMovement movement;
  std::vector<TimeSpan> spans;

  explicit RandomRows(std::uint32_t seed, TestMovement::From from = TestMovement::From::columns) : movement(from) {
    std::mt19937 random(seed);
    std::vector<MovementRow> rows;
    for (int i = 0; i < 4; ++i) {
      const Milliseconds begin(random() % 500);
      spans.push_back({begin, begin + Milliseconds(20 + random() % 300)});
      rows.push_back({.span = spans.back()});
    }
    TestMotion moving(50, seed);
    bend_fingers(moving.motion, seed);
    movement.add(std::move(moving), rows);
  }
  /// Bends the outer joints of the index fingers, now more and now less.
  static void bend_fingers(Motion& motion, std::uint32_t seed) {
    for (std::size_t joint = 0; joint < motion.skeleton().joint_count(); ++joint) {
      const std::string& name = motion.skeleton().joints()[joint].name;
      if (!name.ends_with("HandIndex2") && !name.ends_with("HandIndex3")) continue;
      for (std::int64_t frame = 0; frame < motion.frame_count(); ++frame) {
        const float bend = 0.7f * (1 + std::sin(0.2f * static_cast<float>(frame) + static_cast<float>(seed % 100)));
        motion.pose(frame).rotations[joint] = Eigen::AngleAxisf(bend, Eigen::Vector3f::UnitZ());
      }
    }
  }
  bool holds(const Condition& condition, RowId row) const {
    MovementCheck check(condition, &movement);
    return check.holds({.row = row}, [&] { return std::vector{spans[row]}; });
  }
  /// Where a point is at the first or last frame of a row, from the motion.
  Vector3d at(RowId row, Part part, bool end) const {
    const FrameRange frames = measured_frames(spans[row], movement.clock(0), movement.frame_count(0));
    const std::int64_t frame = end ? frames.end - 1 : frames.begin;
    return movement.points(0, std::span(&part, 1), {frame, frame + 1}).front().front().position.cast<double>();
  }
};

double angle_of(const Vector3d& a, const Vector3d& b) {
  return std::acos(std::clamp(a.normalized().dot(b.normalized()), -1.0, 1.0)) * kDegrees;
}

RC_GTEST_PROP(PlaceOver, TheEndsOfAPointDecideExactly, (std::uint32_t seed)) {
  const RandomRows rows(seed);
  for (RowId row = 0; row < rows.spans.size(); ++row) {
    const Vector3d begin = rows.at(row, Part::right_hand, false);
    const Vector3d end = rows.at(row, Part::right_hand, true);
    const auto agrees = [&](const std::string& text, double value, double limit, bool expected) {
      if (std::abs(value - limit) < 0.01) return;
      RC_LOG() << text << ", row " << row << ", value " << value << '\n';
      RC_ASSERT(rows.holds(place_condition(text), row) == expected);
    };
    for (const double limit : {-20.0, 50.0}) {
      const double azimuth = std::atan2(begin.x(), begin.z()) * kDegrees;
      agrees(fmt::format("from(right_wrist).azimuth < {} deg", limit), azimuth, limit, azimuth < limit);
      const double elevation = std::asin(end.y() / end.norm()) * kDegrees;
      agrees(fmt::format("to(right_wrist).elevation >= {} deg", limit), elevation, limit, elevation >= limit);
    }
    agrees("to(right_wrist).distance > 1.1", end.norm(), 1.1, end.norm() > 1.1);
    const double metres = begin.norm() * static_cast<double>(rows.movement.shoulder_width(0));
    agrees("from(right_wrist).distance <= 0.4 m", metres, 0.4, metres <= 0.4);
    const Vector3d locus(0.6, 0.1, 0.9);
    const double turned = angle_of(end - begin, locus - begin);
    const double moved = (end - begin).norm();
    const double nearer = (locus - begin).norm() - (locus - end).norm();
    if (std::abs(moved - static_cast<double>(kLeastMove)) < 1e-4 || std::abs(nearer) < 1e-4) continue;
    const bool goes = nearer > 0 && moved > static_cast<double>(kLeastMove);
    agrees("right_wrist moves toward @0.6,0.1,0.9", turned, 30, goes && turned < 30);
    agrees("right_wrist moves toward @0.6,0.1,0.9 within 80 deg", turned, 80, goes && turned < 80);
  }
}

RC_GTEST_PROP(PlaceOver, AStretchedIndexFingerPointsAtWhatLiesAheadOfIt, (std::uint32_t seed)) {
  const RandomRows rows(seed);
  for (RowId row = 0; row < rows.spans.size(); ++row) {
    std::vector<Vector3d> joints;
    for (const FingerPoint point :
         {FingerPoint::proximal, FingerPoint::intermediate, FingerPoint::distal, FingerPoint::tip}) {
      joints.push_back(rows.at(row, finger_part(Side::left, Finger::index, point), true));
    }
    double length = 0;
    for (std::size_t i = 1; i < joints.size(); ++i) length += (joints[i] - joints[i - 1]).norm();
    const Vector3d finger = joints.back() - joints.front();
    const double straight = finger.norm() / length;
    if (std::abs(straight - static_cast<double>(kStretched)) < 1e-4) continue;
    // A locus that lies near the finger's direction, and one that does not.
    for (const Vector3d& aside : {Vector3d(0.1, 0.05, -0.1), Vector3d(-0.6, 0.4, 0.3), Vector3d(0.2, -0.2, 0.1)}) {
      const Vector3d locus = joints.front() + finger.normalized() + aside;
      const double turned = angle_of(finger, locus - joints.front());
      for (const double limit : {15.0, 40.0}) {
        if (std::abs(turned - limit) < 0.02) continue;
        const std::string text = fmt::format("left_hand points at @{:.6f},{:.6f},{:.6f} within {} deg", locus.x(),
                                             locus.y(), locus.z(), limit);
        RC_LOG() << text << ", row " << row << ": " << turned << ", straight " << straight << '\n';
        RC_ASSERT(rows.holds(place_condition(text), row) ==
                  (straight > static_cast<double>(kStretched) && turned < limit));
      }
    }
  }
}

TEST(PlaceOver, RandomFingersAreBothStretchedAndBent) {
  std::size_t pointing = 0;
  for (std::uint32_t seed = 0; seed < 15; ++seed) {
    const RandomRows rows(seed);
    for (RowId row = 0; row < rows.spans.size(); ++row) {
      pointing += rows.holds(place_condition("left_hand points at @front within 180 deg"), row) ? 1 : 0;
    }
  }
  EXPECT_GT(pointing, 8U);
  EXPECT_LT(pointing, 52U);
}

TEST(PlaceOver, ALocusOnTheSignerIsThatOfEachBody) {
  const Condition by_name = place_condition("right_hand moves toward @self within 60 deg");
  std::size_t found = 0;
  for (std::uint32_t seed = 0; seed < 20; ++seed) {
    const RandomRows rows(seed);
    const Eigen::Vector3f chest = resolve(by_name.movement.locus, {}, 0, rows.movement.hands(0)->body).at;
    const Condition by_numbers = place_condition(
        fmt::format("right_hand moves toward @{},{},{} within 60 deg", chest.x(), chest.y(), chest.z()));
    for (RowId row = 0; row < rows.spans.size(); ++row) {
      EXPECT_EQ(rows.holds(by_name, row), rows.holds(by_numbers, row));
      found += rows.holds(by_name, row) ? 1 : 0;
    }
  }
  EXPECT_GT(found, 0U);
}

TEST(PlaceOver, WhatIsNotKnownMatchesNothing) {
  const MovementTerm from = place_condition("from(right_hand).azimuth < 0 deg").movement;
  const MovementTerm toward = place_condition("right_hand moves toward @front").movement;
  const Eigen::Vector3f front(0, 0, 1.2f);
  const Eigen::Vector3f unknown(kNotKnown, 0, 1);
  EXPECT_TRUE(std::isnan(place_over(from, {.begin = unknown, .end = front}, front)));
  EXPECT_FALSE(std::isnan(place_over(from, {.begin = front, .end = unknown}, front)));
  EXPECT_TRUE(std::isnan(place_over(toward, {.begin = {0, 0, 0}, .end = unknown}, front)));
  EXPECT_TRUE(std::isnan(place_over(toward, {.begin = unknown, .end = {0, 0, 0}}, front)));
  EXPECT_FLOAT_EQ(place_over(toward, {.begin = {0, 0, 0}, .end = {0, 0.5f, 0.5f}}, front), 45);
  EXPECT_TRUE(std::isnan(place_over(toward, {.begin = {0, 0, 0}, .end = {0, 0, 0.09f}}, front))) << "hardly moved";
  EXPECT_TRUE(std::isnan(place_over(toward, {.begin = {0, 0, 0}, .end = {0, 0, 2.5f}}, front))) << "beyond it";
  const RandomRows rows(2, TestMovement::From::frames);
  for (const char* text : {"from(hand).azimuth < 180 deg", "hand moves toward @front", "hand points at @front"}) {
    const Condition parsed = place_condition(text);
    MovementCheck nothing(parsed, nullptr);
    EXPECT_FALSE(nothing.holds({.row = 0}, {})) << text;
    MovementCheck outside(parsed, &rows.movement);
    EXPECT_FALSE(outside.holds({.row = 0}, [] { return std::vector{TimeSpan{9'000ms, 9'100ms}}; })) << text;
    EXPECT_FALSE(outside.holds({.row = 1}, [] { return std::vector<TimeSpan>(); })) << text;
  }
}

TEST(PlaceOver, OnlyAFingerIsReadFromTheMotion) {
  const Segments segments = weather_corpus().table();
  EXPECT_THAT(explain(parse("from(right_hand).azimuth < -30 deg & right_hand moves toward @left"), segments),
              testing::AllOf(HasSubstr("the movement column (from(right_hand).azimuth < -30 deg)"),
                             Not(HasSubstr("read from the motion"))));
  EXPECT_THAT(explain(parse("phase = stroke & points at @left within 20 deg"), segments),
              HasSubstr("read from the motion if the rest does not decide: hand points at @left within 20 deg"));
}

}  // namespace
}  // namespace signweave
