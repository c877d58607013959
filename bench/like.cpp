// Query by example over 264,000 frames of two hands (44 minutes at 100 frames per second), against one pass over the
// features that it reads; and a condition on movement over every row, against the sum of the same numbers. Before that,
// the answers are checked against those of a full comparison. Finally a database is queried, for the first time and
// again.

#include <algorithm>
#include <cmath>
#include <cstring>
#include <numbers>
#include <numeric>
#include <random>

#include "bench/like_database.h"
#include "bench/measure.h"
#include "signweave/query/example.h"
#include "signweave/query/movement_check.h"
#include "signweave/query/parse.h"

namespace {

using namespace signweave;

/// Hands that move from position to position, as in signing: a movement takes a third to one second, followed by a
/// short rest.
HandTrace wandering_hands(std::int64_t frames, FrameRate rate, std::mt19937& random) {
  HandTrace trace{.rate = rate, .frames = frames, .step = rate.hertz() > kTraceHertz ? 2 : 1, .shoulder_width = 0.35f};
  std::uniform_real_distribution<float> place(-1, 1);
  std::uniform_real_distribution<float> seconds(0.3f, 1);
  const float sample_time = static_cast<float>(trace.step) * static_cast<float>(rate.frame_time().count());
  for (const TracePoint point : {TracePoint::left_palm, TracePoint::right_palm}) {
    auto& samples = trace.points[static_cast<std::size_t>(point)];
    Eigen::Vector3f from(0, 0, 0.5f);
    while (samples.size() < trace.samples()) {
      const Eigen::Vector3f to(0.8f * place(random), 0.7f * place(random) - 0.3f, 0.6f + 0.4f * place(random));
      const float duration = seconds(random);
      const int steps = static_cast<int>(std::ceil(duration / sample_time));
      for (int step = 0; step < steps && samples.size() < trace.samples(); ++step) {
        const float part = static_cast<float>(step) * sample_time / duration;
        const float s = 0.5f - 0.5f * std::cos(std::numbers::pi_v<float> * part);
        const float rise = 0.5f * std::numbers::pi_v<float> / duration * std::sin(std::numbers::pi_v<float> * part);
        const Eigen::Vector3f position = from + s * (to - from);
        const Eigen::Vector3f velocity = rise * trace.shoulder_width * (to - from);
        TraceSample sample;
        for (int axis = 0; axis < 3; ++axis) {
          const auto i = static_cast<std::size_t>(axis);
          sample.position[i] = static_cast<std::int16_t>(std::lround(position[axis] / TraceSample::kPosition));
          sample.velocity[i] = static_cast<std::int16_t>(std::lround(velocity[axis] / TraceSample::kVelocity));
        }
        samples.push_back(sample);
      }
      from = to;
    }
  }
  return trace;
}

/// Consecutive signs of 0.4 to 1.6 seconds, each filled by three phases.
std::vector<FrameRange> segments_of(const HandTrace& trace, bool phases, std::mt19937& random) {
  std::vector<FrameRange> result;
  std::uniform_real_distribution<double> seconds(0.4, 1.6);
  for (std::int64_t begin = 0;;) {
    const auto size = static_cast<std::int64_t>(seconds(random) * trace.rate.hertz());
    if (begin + size > trace.frames) return result;
    if (!phases) {
      result.push_back({begin, begin + size});
    } else {
      for (std::int64_t third = 0; third < 3; ++third) {
        result.push_back({begin + size * third / 3, begin + size * (third + 1) / 3});
      }
    }
    begin += size;
  }
}

constexpr std::array kPalms = {TracePoint::left_palm, TracePoint::right_palm};

Shape shape_of(const HandTrace& trace, FrameRange frames) {
  Shape shape(2);
  for (const Side side : kSides) resample(trace, palm_on(side), frames, shape[static_cast<std::size_t>(side)]);
  return shape;
}

/// All features of both palms, summed: the cost of reading each number once.
std::int64_t sum_of(const HandTrace& trace) {
  std::int64_t sum = 0;
  for (const TracePoint point : {TracePoint::left_palm, TracePoint::right_palm}) {
    const auto* numbers = reinterpret_cast<const std::int16_t*>(trace[point].data());
    const std::size_t count = trace[point].size() * (sizeof(TraceSample) / sizeof(std::int16_t));
    constexpr std::size_t kBlock = 4096;  // so that its sum fits 32 bits
    for (std::size_t i = 0; i < count; i += kBlock) {
      std::int32_t part = 0;
      for (std::size_t k = i; k < std::min(i + kBlock, count); ++k) part += numbers[k];
      sum += part;
    }
  }
  return sum;
}

class OneColumn : public Movement {
 public:
  explicit OneColumn(std::vector<float> values) : values_(std::move(values)) {}
  ColumnValues column(Column, std::uint32_t) const override { return {values_, nullptr}; }
  float shoulder_width(std::uint32_t) const override { return 0.35f; }
  FrameClock clock(std::uint32_t) const override { return {}; }
  std::shared_ptr<const HandTrace> hands(std::uint32_t) const override { return nullptr; }
  std::vector<PointTrack> points(std::uint32_t, std::span<const Part>, FrameRange) const override { return {}; }

 private:
  std::vector<float> values_;
};

/// As fast as a compiler makes it: sixteen parallel sums.
float sum_of(std::span<const float> values) {
  std::array<float, 16> sums{};
  for (std::size_t i = 0; i + 16 <= values.size(); i += 16) {
    for (std::size_t k = 0; k < 16; ++k) sums[k] += values[i + k];
  }
  return std::accumulate(sums.begin(), sums.end(), 0.0f);
}

/// A condition on one column of `rows` values, distributed as given, against the sum of that column. False if it does
/// not find exactly the rows above `least`.
bool scan_rows(const char* name, const char* condition, std::normal_distribution<float> value, double least,
               std::size_t rows, int rounds, std::mt19937& random) {
  std::vector<float> values(rows);
  for (float& each : values) each = value(random);
  const OneColumn movement(std::move(values));
  const PhaseQuery query = parse(condition);
  MovementCheck check(query.elements.front().term.expression.condition, &movement);
  std::vector<RowId> hits;
  const auto scan = [&] {
    hits.clear();
    check.scan(0, 0, hits);
    bench::keep(hits);
  };
  const std::span<const float> column = movement.column({}, 0).values;
  const auto sum = [&] { bench::keep(sum_of(column)); };
  scan();
  const auto expected = std::ranges::count_if(column, [&](float each) { return static_cast<double>(each) > least; });
  if (static_cast<std::ptrdiff_t>(hits.size()) != expected) {
    fmt::print(stderr, "bench_like: '{}' found {} rows, not {}\n", condition, hits.size(), expected);
    return false;
  }
  bench::print(fmt::format("{}_{}_rows", name, rows), 1e6, "us", bench::compare(rounds, scan, sum), "<= 1.5");
  return true;
}

}  // namespace

int main(int argc, char** argv) {
  const bool quick = argc > 1 && std::strcmp(argv[1], "--quick") == 0;
  const int rounds = quick ? 9 : 41;
  constexpr std::int64_t frames = 264'000;
  std::mt19937 random(7);
  for (const FrameRate rate : {FrameRate{100, 1}, FrameRate{60, 1}}) {
    const HandTrace trace = wandering_hands(frames, rate, random);
    for (const bool phases : {false, true}) {
      const std::vector<FrameRange> segments = segments_of(trace, phases, random);
      const Shape example = shape_of(trace, segments[segments.size() / 2]);
      std::vector<NearestSearch::Found> found;
      NearestSearch::Counts counts;
      Shape shape(2);
      const auto search = [&] {
        NearestSearch nearest(example, 20);
        for (std::uint32_t id = 0; id < segments.size(); ++id) {
          if (nearest.too_far(TraceSpan(trace, segments[id]), kPalms)) continue;
          if (!resample(trace, TracePoint::left_palm, segments[id], shape[0])) continue;
          if (resample(trace, TracePoint::right_palm, segments[id], shape[1])) nearest.offer(id, shape);
        }
        counts = nearest.counts();
        found = nearest.take();
        bench::keep(found);
      };
      const auto pass = [&] { bench::keep(sum_of(trace)); };
      search();
      std::vector<NearestSearch::Found> all;
      for (std::uint32_t id = 0; id < segments.size(); ++id) {
        all.push_back({warped_distance(example, shape_of(trace, segments[id])), id});
      }
      std::ranges::sort(all, [](const auto& a, const auto& b) {
        return a.distance < b.distance || (a.distance == b.distance && a.id < b.id);
      });
      all.resize(std::min<std::size_t>(20, all.size()));
      if (found != all) {
        fmt::print(stderr, "bench_like: the nearest are not those of a full comparison\n");
        return 1;
      }
      const std::string what = fmt::format("like/{}_of_{}_frames_at_{}", phases ? "phases" : "signs", frames,
                                           static_cast<int>(rate.hertz()));
      bench::print(what, 1e3, "ms", bench::compare(rounds, search, pass), "<= 10");
      fmt::print(stderr, "{}: {} segments; refused {} by some moments, {} by ends, {} by envelope, {} while warping\n",
                 what, segments.size(), counts.by_moments, counts.by_ends, counts.by_envelope, counts.abandoned);
    }
  }

  const std::size_t rows = quick ? 100'000 : 1'000'000;
  if (!scan_rows("movement/scan_of", "speed(right_hand) > 1.8 m/s", std::normal_distribution<float>(0.9f, 0.25f), 1.8,
                 rows, rounds, random))
    return 1;
  if (!scan_rows("movement/scan_of_heights_of", "max(right_hand).height > 0.5",
                 std::normal_distribution<float>(-1.3f, 0.5f), 0.5, rows, rounds, random))
    return 1;
  bench::ask_database(quick ? 1 : 44, quick ? 3 : 200);
  return 0;
}
