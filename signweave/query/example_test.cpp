#include "signweave/query/example.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "signweave/query/movement_for_tests.h"

namespace signweave {
namespace {

/// A wandering path; near `base` by `noise`.
Shape wander(std::mt19937& random, std::size_t points, const Shape* base = nullptr, float noise = 1) {
  std::normal_distribution<float> step(0, 0.2f);
  Shape shape(points);
  for (std::size_t point = 0; point < points; ++point) {
    for (std::size_t axis = 0; axis < PointShape::kAxes; ++axis) {
      float value = step(random) * 3;
      for (std::size_t moment = 0; moment < kShapePoints; ++moment) {
        value += step(random);
        shape[point].at(axis, moment) = base == nullptr ? value : (*base)[point].at(axis, moment) + noise * value;
      }
    }
  }
  return shape;
}

/// The textbook algorithm: all cells of the band, in doubles.
double by_the_book(const Shape& a, const Shape& b) {
  constexpr auto kN = static_cast<int>(kShapePoints);
  std::vector<std::vector<double>> sums(kN + 1, std::vector<double>(kN + 1, 1e300));
  sums[0][0] = 0;
  for (int i = 0; i < kN; ++i) {
    for (int j = 0; j < kN; ++j) {
      if (std::abs(i - j) > static_cast<int>(kShapeBand)) continue;
      double cost = 0;
      for (std::size_t point = 0; point < a.size(); ++point) {
        for (std::size_t axis = 0; axis < PointShape::kAxes; ++axis) {
          cost += std::pow(static_cast<double>(a[point].at(axis, static_cast<std::size_t>(i))) -
                               static_cast<double>(b[point].at(axis, static_cast<std::size_t>(j))),
                           2);
        }
      }
      const auto x = static_cast<std::size_t>(i);
      const auto y = static_cast<std::size_t>(j);
      sums[x + 1][y + 1] = cost + std::min({sums[x][y], sums[x][y + 1], sums[x + 1][y]});
    }
  }
  return std::sqrt(sums[kShapePoints][kShapePoints] / static_cast<double>(kShapePoints * a.size()));
}

RC_GTEST_PROP(Example, TheDistanceIsThatOfTheTextbook, (std::uint32_t seed)) {
  std::mt19937 random(seed);
  const std::size_t points = 1 + random() % 3;
  const Shape a = wander(random, points);
  const Shape b = random() % 2 == 0 ? wander(random, points) : wander(random, points, &a, 0.1f);
  const double expected = by_the_book(a, b);
  RC_ASSERT(std::abs(static_cast<double>(warped_distance(a, b)) - expected) < 1e-5 * (1 + expected));
}

TEST(Example, IdenticalSpansHaveDistanceZeroAndAShiftItsLength) {
  std::mt19937 random(5);
  const Shape a = wander(random, 2);
  EXPECT_EQ(warped_distance(a, a), 0);
  Shape still(1);
  Shape away(1);
  for (std::size_t moment = 0; moment < kShapePoints; ++moment) away[0].at(1, moment) = 0.5f;
  EXPECT_FLOAT_EQ(warped_distance(still, away), 0.5f);
}

TEST(Example, ASmallTimeShiftIsNearerThanFrameByFrame) {
  Shape early(1);
  Shape late(1);
  float plain = 0;
  for (std::size_t moment = 0; moment < kShapePoints; ++moment) {
    early[0].at(0, moment) = std::sin(0.2f * static_cast<float>(moment));
    late[0].at(0, moment) = std::sin(0.2f * (static_cast<float>(moment) - 2));
    plain += std::pow(early[0].at(0, moment) - late[0].at(0, moment), 2.0f);
  }
  EXPECT_LT(warped_distance(early, late), 0.5f * std::sqrt(plain / kShapePoints));
}

RC_GTEST_PROP(Example, TheSearchFindsTheSameAsAnExhaustiveSearch, (std::uint32_t seed)) {
  std::mt19937 random(seed);
  const std::size_t points = 1 + random() % 2;
  const Shape example = wander(random, points);
  const std::size_t most = 1 + random() % 12;
  NearestSearch search(example, most);
  std::vector<NearestSearch::Found> all;
  std::vector<Shape> shapes;
  for (std::uint32_t id = 0; id < 80; ++id) {
    // Some far, some near, some equal to an earlier one.
    const unsigned kind = random() % 4;
    if (kind == 0 && !shapes.empty()) {
      shapes.push_back(shapes[random() % shapes.size()]);
    } else {
      shapes.push_back(kind == 1 ? wander(random, points)
                                 : wander(random, points, &example, 0.02f * static_cast<float>(random() % 50)));
    }
    all.push_back({warped_distance(example, shapes.back()), id});
  }
  std::vector<std::uint32_t> order(shapes.size());
  for (std::uint32_t id = 0; id < order.size(); ++id) order[id] = id;
  std::shuffle(order.begin(), order.end(), random);
  for (const std::uint32_t id : order) search.offer(id, shapes[id]);
  std::sort(all.begin(), all.end(), [](const auto& a, const auto& b) {
    return a.distance < b.distance || (a.distance == b.distance && a.id < b.id);
  });
  all.resize(std::min(most, all.size()));
  RC_ASSERT(search.take() == all);
}

TEST(Example, BoundsRejectMostDistantCandidates) {
  std::mt19937 random(3);
  const Shape example = wander(random, 2);
  NearestSearch search(example, 1);
  search.offer(0, wander(random, 2, &example, 0.01f));
  for (std::uint32_t id = 1; id < 500; ++id) search.offer(id, wander(random, 2));
  const NearestSearch::Counts& counts = search.counts();
  EXPECT_EQ(counts.offered, 500U);
  EXPECT_GT(counts.by_ends, 300U);
  EXPECT_GE(counts.by_ends + counts.by_envelope + counts.abandoned, 499U);
  EXPECT_EQ(search.take().front().id, 0U);
}

TEST(Example, ATraceAndItsTrackHaveOneShape) {
  for (const std::int64_t hertz : {30, 60, 120, 240}) {
    const TestMotion test(203, 7, {hertz, 1});
    const HandTrace trace = trace_hands(test.motion, test.model);
    for (const FrameRange frames : {FrameRange{0, 203}, FrameRange{17, 18}, FrameRange{31, 90}, FrameRange{150, 203},
                                    FrameRange{202, 203}, FrameRange{197, 203}}) {
      PointShape from_trace;
      PointShape from_track;
      ASSERT_TRUE(resample(trace, TracePoint::right_palm, frames, from_trace));
      ASSERT_TRUE(resample(trace.track(TracePoint::right_palm, frames), trace.shoulder_width, from_track));
      for (std::size_t axis = 0; axis < PointShape::kAxes; ++axis) {
        for (std::size_t moment = 0; moment < kShapePoints; ++moment) {
          // Between frames that lie between samples, the track follows shorter line segments, not different ones.
          ASSERT_NEAR(from_trace.at(axis, moment), from_track.at(axis, moment), 2e-4)
              << hertz << ' ' << frames.begin << ' ' << axis << ' ' << moment;
        }
      }
    }
  }
}

RC_GTEST_PROP(Example, ACandidateRejectedByAFewMomentsIsNoAnswer, (std::uint32_t seed)) {
  std::mt19937 random(seed);
  const TestMotion test(400, seed, {random() % 2 == 0 ? 60 : 120, 1});
  const HandTrace trace = trace_hands(test.motion, test.model);
  constexpr std::array kPalms = {TracePoint::left_palm, TracePoint::right_palm};
  const auto shape_of = [&](FrameRange frames) {
    Shape shape(2);
    for (std::size_t i = 0; i < 2; ++i) resample(trace, kPalms[i], frames, shape[i]);
    return shape;
  };
  std::vector<FrameRange> pieces;
  for (int i = 0; i < 60; ++i) {
    const auto begin = static_cast<std::int64_t>(random() % 390);
    pieces.push_back({begin, begin + 1 + static_cast<std::int64_t>(random() % static_cast<unsigned>(400 - begin))});
  }
  pieces.push_back(pieces[7]);
  const Shape example = shape_of(pieces[random() % pieces.size()]);
  NearestSearch search(example, 3);
  std::vector<NearestSearch::Found> all;
  for (std::uint32_t id = 0; id < pieces.size(); ++id) {
    all.push_back({warped_distance(example, shape_of(pieces[id])), id});
    if (!search.too_far(TraceSpan(trace, pieces[id]), kPalms)) search.offer(id, shape_of(pieces[id]));
  }
  std::ranges::sort(all, [](const auto& a, const auto& b) {
    return a.distance < b.distance || (a.distance == b.distance && a.id < b.id);
  });
  all.resize(3);
  RC_ASSERT(search.take() == all);
}

TEST(Example, AShapeBeginsAndEndsWithItsFrames) {
  const TestMotion test(100, 7);
  const HandTrace trace = trace_hands(test.motion, test.model);
  PointShape shape;
  ASSERT_TRUE(resample(trace, TracePoint::left_palm, {20, 51}, shape));
  const PointTrack track = trace.track(TracePoint::left_palm, {20, 51});
  EXPECT_NEAR(shape.at(1, 0), track.front().position.y(), 1e-6);
  EXPECT_NEAR(shape.at(1, kShapePoints - 1), track.back().position.y(), 1e-6);
  EXPECT_NEAR(shape.at(3, kShapePoints - 1), track.back().velocity.x() * kVelocityTime / trace.shoulder_width, 1e-5);
}

TEST(Example, NanHasNoShape) {
  TestMotion test(40, 7);
  const auto arm = static_cast<std::size_t>(test.model.rig[Part::right_forearm].joint);
  test.motion.pose(20).rotations[arm].coeffs().setConstant(std::numeric_limits<float>::quiet_NaN());
  const HandTrace trace = trace_hands(test.motion, test.model);
  PointShape shape;
  EXPECT_FALSE(resample(trace, TracePoint::right_palm, {10, 30}, shape));
  EXPECT_FALSE(resample(trace.track(TracePoint::right_palm, {10, 30}), trace.shoulder_width, shape));
  EXPECT_TRUE(resample(trace, TracePoint::left_palm, {10, 30}, shape));
}

}  // namespace
}  // namespace signweave
