#include "signweave/query/rank.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "signweave/query/corpus_for_tests.h"
#include "signweave/query/movement_for_tests.h"

namespace signweave {
namespace {

/// The spans nearest to an example among many spans of one moving person, and the same by comparing it with each.
class Rank : public testing::Test {
 protected:
  Rank() {
    movement_.add(TestMotion(600, 11), {});
    std::mt19937 random(4);
    for (int i = 0; i < 150; ++i) {
      const auto begin = static_cast<std::int64_t>(random() % 9'000);
      pieces_.push_back({Milliseconds(begin), Milliseconds(begin + 60 + static_cast<std::int64_t>(random() % 900))});
    }
  }

  PointShape shape_of(const Point& point, TimeSpan span) const {
    PointShape shape;
    const FrameRange frames = measured_frames(span, movement_.clock(0), 600);
    const std::shared_ptr<const HandTrace> trace = movement_.hands(0);
    if (point.kind == Point::Kind::palm) {
      EXPECT_TRUE(resample(*trace, palm_on(point.side), frames, shape));
    } else {
      const std::vector<PointTrack> tracks = movement_.points(0, std::span(&point.part, 1), frames);
      EXPECT_TRUE(resample(tracks.front(), trace->shoulder_width, shape));
    }
    return shape;
  }

  std::vector<NearestSearch::Found> ranked(const Example& example, std::size_t most) const {
    RankedExample ready(example, corpus_, &movement_);
    NearestSearch search(ready.shape(), most);
    for (std::uint32_t id = 0; id < pieces_.size(); ++id) ready.offer(id, 0, pieces_[id], search);
    return search.take();
  }

  std::vector<NearestSearch::Found> compared(const Example& example, std::size_t most) const {
    const auto shape = [&](TimeSpan span) {
      Shape result;
      for (const Point& point : example.points) result.push_back(shape_of(point, span));
      return result;
    };
    std::vector<NearestSearch::Found> all;
    for (std::uint32_t id = 0; id < pieces_.size(); ++id) {
      all.push_back({warped_distance(shape(example.span), shape(pieces_[id])), id});
    }
    std::ranges::sort(all, [](const auto& a, const auto& b) {
      return a.distance < b.distance || (a.distance == b.distance && a.id < b.id);
    });
    all.resize(most);
    return all;
  }

  const Segments corpus_ = weather_corpus().table();
  TestMovement movement_;
  std::vector<TimeSpan> pieces_;
};

TEST_F(Rank, TracedAndUntracedPointsAreComparedTogether) {
  const Point hand = Point::palm(Side::right);
  const Point elbow = Point::of(Part::right_forearm);
  const std::string name(corpus_.recording_name(0));
  for (const std::vector<Point>& points : {std::vector<Point>{elbow, hand}, {hand, elbow}, {hand}, {elbow}}) {
    for (const std::size_t piece : {140U, 70U, 149U}) {
      const Example example{.recording = name, .span = pieces_[piece], .points = points};
      const std::vector<NearestSearch::Found> found = ranked(example, 3);
      EXPECT_EQ(found, compared(example, 3)) << to_string(example);
      ASSERT_FALSE(found.empty());
      EXPECT_EQ(found.front(), (NearestSearch::Found{0, static_cast<std::uint32_t>(piece)})) << to_string(example);
    }
  }
}

}  // namespace
}  // namespace signweave
