// Query by example on the demo corpus, against its plain definition in docs/query.md: every candidate is compared, in
// doubles, without bounds.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "signweave/database/test_signing.h"
#include "signweave/query/parse.h"
#include "signweave/query/rank.h"
#include "tests/demo_database.h"

namespace signweave {
namespace {

using testing_database::TestFolder;

const Database& six_minutes_corpus() {
  static const TestFolder folder;
  static const std::unique_ptr<const Database> database = demo_database(folder / "db", 6);
  return *database;
}

constexpr int kMoments = 32;
constexpr int kBand = 3;
constexpr double kVelocitySeconds = 0.15;

/// [moment][axis of all points]: positions in shoulder widths, velocities in shoulder widths per 0.15 s.
using Profile = std::vector<std::vector<double>>;

/// A recording, with the positions of its points at each frame.
class Moving {
 public:
  explicit Moving(const std::string& name)
      : info_(*six_minutes_corpus().info(name)),
        motion_(six_minutes_corpus().read(name)),
        model_(model_of(motion_, info_.rig)),
        trace_(trace_hands(motion_, model_)) {}

  Profile profile(TimeSpan span, const std::vector<Point>& points) {
    const FrameRange frames = measured_frames(span, info_.clock, trace_.frames);
    Profile result(kMoments);
    for (const Point& point : points) {
      const PointTrack& track = of(point);
      for (int moment = 0; moment < kMoments; ++moment) {
        const double at = static_cast<double>(frames.begin) +
                          static_cast<double>(frames.size() - 1) * moment / static_cast<double>(kMoments - 1);
        const auto low = static_cast<std::size_t>(at);
        const std::size_t high = std::min(low + 1, track.size() - 1);
        const double part = at - static_cast<double>(low);
        const auto put = [&](const Eigen::Vector3f& from, const Eigen::Vector3f& to, double scale) {
          for (int axis = 0; axis < 3; ++axis) {
            const auto a = static_cast<double>(from[axis]);
            result[static_cast<std::size_t>(moment)].push_back(scale *
                                                               (a + part * (static_cast<double>(to[axis]) - a)));
          }
        };
        put(track[low].position, track[high].position, 1);
        put(track[low].velocity, track[high].velocity,
            kVelocitySeconds / static_cast<double>(model_.body->shoulder_width));
      }
    }
    return result;
  }

 private:
  const PointTrack& of(const Point& point) {
    PointTrack& track = tracks_[to_string(point)];
    if (!track.empty()) return track;
    const FrameRange all{0, trace_.frames};
    if (point.kind == Point::Kind::palm) {
      track = trace_.track(palm_on(point.side), all);
    } else if (point.part == finger_part(Side::right, Finger::index, FingerPoint::tip)) {
      track = trace_.track(TracePoint::right_index, all);
    } else {
      track = track_points(motion_, model_, std::span(&point.part, 1), all).front();
    }
    return track;
  }

  RecordingInfo info_;
  Motion motion_;
  SignerModel model_;
  HandTrace trace_;
  std::map<std::string, PointTrack> tracks_;
};

Moving& moving(const std::string& name) {
  static std::map<std::string, std::unique_ptr<Moving>> all;
  std::unique_ptr<Moving>& one = all[name];
  if (!one) one = std::make_unique<Moving>(name);
  return *one;
}

double distance_between(const Profile& a, const Profile& b) {
  std::vector<std::vector<double>> least(kMoments + 1, std::vector<double>(kMoments + 1, 1e300));
  least[0][0] = 0;
  for (std::size_t i = 1; i <= kMoments; ++i) {
    for (std::size_t j = 1; j <= kMoments; ++j) {
      if (std::abs(static_cast<int>(i) - static_cast<int>(j)) > kBand) continue;
      double sum = 0;
      for (std::size_t axis = 0; axis < a[0].size(); ++axis) sum += std::pow(a[i - 1][axis] - b[j - 1][axis], 2);
      least[i][j] = sum + std::min({least[i - 1][j - 1], least[i - 1][j], least[i][j - 1]});
    }
  }
  const double points = static_cast<double>(a[0].size()) / 6;
  return std::sqrt(least[kMoments][kMoments] / (kMoments * points));
}

struct ComparedRow {
  double distance = 0;
  RowId row = 0;
};

/// All candidates, nearest first.
template <typename Wanted>
std::vector<ComparedRow> compared(const Example& example, Wanted&& wanted) {
  const std::shared_ptr<const Contents> contents = six_minutes_corpus().contents();
  const Segments& segments = contents->segments;
  const std::vector<Point> points =
      example.points.empty() ? std::vector<Point>{Point::palm(Side::right), Point::palm(Side::left)} : example.points;
  const Profile asked = moving(example.recording).profile(example.span, points);
  std::vector<ComparedRow> all;
  for (RowId row = 0; row < segments.row_count(); ++row) {
    if (!wanted(segments, row)) continue;
    const std::string name(segments.recording_name(segments.recording(row)));
    all.push_back({distance_between(asked, moving(name).profile(segments.span(row), points)), row});
  }
  std::ranges::sort(all, {}, &ComparedRow::distance);
  return all;
}

/// The largest difference between sums in floats and in doubles.
constexpr double kRounding = 2e-5;

void expect_nearest(const std::string& query, std::optional<std::size_t> limit, std::size_t at_least,
                    const auto& wanted) {
  SCOPED_TRACE(query);
  const PhaseQuery parsed = parse(query);
  const std::vector<Segment> found = six_minutes_corpus().find(parsed, {.limit = limit});
  const std::vector<ComparedRow> all = compared(example_at(parsed, 0), wanted);
  ASSERT_GE(all.size(), at_least);
  ASSERT_EQ(found.size(), std::min(limit.value_or(kNearest), all.size()));
  std::map<RowId, double> distances;
  for (const ComparedRow& each : all) distances[each.row] = each.distance;
  EXPECT_LT(all.front().distance, 0.5 * all[all.size() / 2].distance)
      << "all distances are alike: the test shows nothing";
  for (std::size_t i = 0; i < found.size(); ++i) {
    ASSERT_TRUE(distances.contains(found[i].row)) << i << ": " << found[i].name;
    // Each position of the result has the distance of the plain definition, and the row found there has that distance
    // too: so the order is the same, except among equal distances.
    EXPECT_NEAR(static_cast<double>(*found[i].distance), all[i].distance, kRounding) << i << ": " << found[i].name;
    EXPECT_NEAR(static_cast<double>(*found[i].distance), distances[found[i].row], kRounding) << i;
    for (std::size_t before = 0; before < i; ++before) ASSERT_NE(found[before].row, found[i].row);
  }
}

bool any_sign(const Segments& segments, RowId row) {
  return segments.kind(row) == RowKind::sign;
}
bool any_stroke(const Segments& segments, RowId row) {
  return segments.kind(row) == RowKind::phase && segments.phase(row) == PhaseKind::stroke;
}

/// Some signs of the corpus, far apart in it.
std::vector<std::string> examples(bool strokes) {
  const std::shared_ptr<const Contents> contents = six_minutes_corpus().contents();
  const Segments& segments = contents->segments;
  std::vector<RowId> rows;
  for (RowId row = 0; row < segments.row_count(); ++row) {
    if (strokes ? any_stroke(segments, row) : any_sign(segments, row)) rows.push_back(row);
  }
  std::vector<std::string> result;
  for (const std::size_t place : {rows.size() / 7, rows.size() / 2, rows.size() - 3}) {
    const TimeSpan span = segments.span(rows[place]);
    result.push_back(fmt::format("\"{}\"@{}..{}", segments.recording_name(segments.recording(rows[place])),
                                 span.begin.count() + 7, span.end.count() + 12));
  }
  return result;
}

TEST(LikeOnTheDemo, BothHandsOfSigns) {
  for (const std::string& example : examples(false)) {
    expect_nearest("like(" + example + ")", std::nullopt, 150, any_sign);
    expect_nearest("like(" + example + ")", 1, 150, any_sign);
  }
}

TEST(LikeOnTheDemo, OneHandOfStrokes) {
  for (const std::string& example : examples(true)) {
    expect_nearest("phase = stroke & like(" + example + ", right_hand)", 60, 150, any_stroke);
    expect_nearest("phase = stroke & like(" + example + ", left_hand)", 7, 150, any_stroke);
  }
}

TEST(LikeOnTheDemo, AllRows) {
  expect_nearest("like(" + examples(false).front() + ", right_hand)", 100'000, 150, any_sign);
}

TEST(LikeOnTheDemo, NamedJointsWithHandsAndAlone) {
  const std::string example = examples(false)[1];
  for (const std::string points : {"right_elbow", "right_elbow, right_hand", "right_index_tip", "head, left_wrist"}) {
    expect_nearest("like(" + example + ", " + points + ")", 12, 150, any_sign);
  }
}

TEST(LikeOnTheDemo, TogetherWithOtherConditions) {
  const std::string example = examples(false)[2];
  expect_nearest("duration > 600ms & like(" + example + ")", 5, 20, [](const Segments& segments, RowId row) {
    return any_sign(segments, row) && segments.span(row).duration() > Milliseconds(600);
  });
}

}  // namespace
}  // namespace signweave
