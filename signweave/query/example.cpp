#include "signweave/query/example.h"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace signweave {
namespace {

constexpr std::size_t kN = kShapePoints;
constexpr std::size_t kR = kShapeBand;
/// Moments that are read at once around one: the band, and one for company.
constexpr std::size_t kWide = 2 * kR + 2;
static_assert(PointShape::kMargin > kR && kWide == 8);
constexpr float kInfinity = std::numeric_limits<float>::infinity();

/// Bounds and distances are sums in another order: what is refused must be farther by more than that may change.
constexpr float kRounding = 1 + 1e-4f;

/// The squared differences of one moment of `a` from those around it of `b`, all points and axes together.
std::array<float, kWide> differences(const Shape& a, std::size_t moment, const Shape& b) noexcept {
  std::array<float, kWide> sum{};
  for (std::size_t point = 0; point < a.size(); ++point) {
    for (std::size_t axis = 0; axis < PointShape::kAxes; ++axis) {
      const float value = a[point].at(axis, moment);
      const float* others = &b[point].axes[axis][PointShape::kMargin + moment - kR];
      for (std::size_t k = 0; k < kWide; ++k) {
        const float difference = value - others[k];
        sum[k] += difference * difference;
      }
    }
  }
  return sum;
}

/// The least sum along a path from first to last moments of both; infinity as soon as it is known to be above `limit`,
/// given what is added at least from each moment of `b` on.
float warped(const Shape& a, const Shape& b, float limit, const std::array<float, kN + 1>& rest) noexcept {
  // [k] of the row before and of this: the moment of b is that of a, less the band, plus k.
  std::array<float, kWide + 2> before;
  std::array<float, kWide + 2> row;
  before.fill(kInfinity);
  for (std::size_t i = 0; i < kN; ++i) {
    const std::array<float, kWide> cost = differences(a, i, b);
    row.fill(kInfinity);
    float least = kInfinity;
    for (std::size_t k = 0; k <= 2 * kR; ++k) {
      if (i + k < kR || i + k >= kN + kR) continue;
      // One moment of a earlier, the same moment of b is one place on.
      const float straight = before[k];
      const float down = before[k + 1];
      const float across = k > 0 ? row[k - 1] : kInfinity;
      const float from = i == 0 && k == kR ? 0 : std::min({straight, down, across});
      row[k] = from + cost[k];
      least = std::min(least, row[k]);
    }
    // Whatever path is taken, it has still to pass every moment of b behind the band.
    if (least + rest[std::min(i + kR + 1, kN)] > limit) return kInfinity;
    before = row;
  }
  return before[kR];
}

float distance_of(float sum, std::size_t points) noexcept {
  return std::sqrt(sum / static_cast<float>(kN * points));
}

/// Between two frames of a track, `part` of the way.
void put(const PointFrame& from, const PointFrame& to, float part, float velocity, std::size_t moment,
         PointShape& out) noexcept {
  for (int axis = 0; axis < 3; ++axis) {
    const auto i = static_cast<std::size_t>(axis);
    out.at(i, moment) = std::lerp(from.position[axis], to.position[axis], part);
    out.at(3 + i, moment) = velocity * std::lerp(from.velocity[axis], to.velocity[axis], part);
  }
}

}  // namespace

bool resample(std::span<const PointFrame> track, float shoulder_width, PointShape& out) noexcept {
  const float last = static_cast<float>(track.size() - 1);
  bool known = true;
  for (std::size_t moment = 0; moment < kN; ++moment) {
    const float at = last * static_cast<float>(moment) / static_cast<float>(kN - 1);
    const auto low = std::min(static_cast<std::size_t>(at), track.size() - 1);
    const std::size_t high = std::min(low + 1, track.size() - 1);
    put(track[low], track[high], at - static_cast<float>(low), kVelocityTime / shoulder_width, moment, out);
    for (std::size_t axis = 0; axis < PointShape::kAxes; ++axis) known = known && std::isfinite(out.at(axis, moment));
  }
  return known;
}

bool resample(const HandTrace& trace, TracePoint point, FrameRange frames, PointShape& out) noexcept {
  const std::vector<TraceSample>& samples = trace[point];
  assert(!samples.empty() && !frames.empty() && frames.begin >= 0 && frames.end <= trace.frames);
  constexpr std::int16_t kNone = std::numeric_limits<std::int16_t>::min();
  const float position = TraceSample::kPosition;
  const float velocity = TraceSample::kVelocity * kVelocityTime / trace.shoulder_width;
  const auto step = static_cast<float>(trace.step);
  const auto begin = static_cast<float>(frames.begin % trace.step);
  const TraceSample* first = &samples[static_cast<std::size_t>(frames.begin / trace.step)];
  const auto left = static_cast<std::size_t>(samples.data() + samples.size() - 1 - first);
  // The last sample is that of the last frame, which may be nearer than a whole step.
  const std::int64_t regular = (trace.frames - 1) / trace.step * trace.step;
  const float short_step = static_cast<float>(trace.frames - 1 - regular);
  const auto whole_steps = static_cast<std::size_t>(regular / trace.step - frames.begin / trace.step);
  const float scale = static_cast<float>(frames.size() - 1) / static_cast<float>(kN - 1);
  bool known = true;
  for (std::size_t moment = 0; moment < kN; ++moment) {
    const float at = begin + scale * static_cast<float>(moment);
    const auto low = std::min({static_cast<std::size_t>(at / step), whole_steps, left});
    const std::size_t high = std::min(low + 1, left);
    const float gap = low == whole_steps && short_step > 0 ? short_step : step;
    const float part = std::min((at - static_cast<float>(low) * step) / gap, 1.0f);
    const TraceSample& a = first[low];
    const TraceSample& b = first[high];
    known = known && a.position[0] != kNone && b.position[0] != kNone;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const auto p = static_cast<float>(a.position[axis]);
      const auto v = static_cast<float>(a.velocity[axis]);
      out.at(axis, moment) = position * (p + part * (static_cast<float>(b.position[axis]) - p));
      out.at(3 + axis, moment) = velocity * (v + part * (static_cast<float>(b.velocity[axis]) - v));
    }
  }
  return known;
}

float warped_distance(const Shape& a, const Shape& b) {
  return distance_of(warped(a, b, kInfinity, {}), a.size());
}

NearestSearch::NearestSearch(Shape example, std::size_t most)
    : example_(std::move(example)), low_(example_), high_(example_), most_(most) {
  assert(!example_.empty() && most > 0);
  for (std::size_t point = 0; point < example_.size(); ++point) {
    for (std::size_t axis = 0; axis < PointShape::kAxes; ++axis) {
      for (std::size_t moment = 0; moment < kN; ++moment) {
        float& low = low_[point].at(axis, moment);
        float& high = high_[point].at(axis, moment);
        for (std::size_t i = moment < kR ? 0 : moment - kR; i < std::min(moment + kR + 1, kN); ++i) {
          low = std::min(low, example_[point].at(axis, i));
          high = std::max(high, example_[point].at(axis, i));
        }
      }
    }
  }
}

float NearestSearch::limit() const noexcept {
  return heap_.size() < most_ ? kInfinity : heap_.front().distance * kRounding;
}

float NearestSearch::outside(const Shape& candidate) {
  std::array<float, kN> sums{};
  for (std::size_t point = 0; point < candidate.size(); ++point) {
    for (std::size_t axis = 0; axis < PointShape::kAxes; ++axis) {
      const float* value = &candidate[point].axes[axis][PointShape::kMargin];
      const float* low = &low_[point].axes[axis][PointShape::kMargin];
      const float* high = &high_[point].axes[axis][PointShape::kMargin];
      for (std::size_t moment = 0; moment < kN; ++moment) {
        const float above = std::max(value[moment] - high[moment], 0.0f);
        const float below = std::max(low[moment] - value[moment], 0.0f);
        sums[moment] += above * above + below * below;
      }
    }
  }
  rest_[kN] = 0;
  for (std::size_t moment = kN; moment > 0; --moment) rest_[moment - 1] = rest_[moment] + sums[moment - 1];
  return rest_[0];
}

void NearestSearch::offer(std::uint32_t id, const Shape& candidate) {
  assert(candidate.size() == example_.size());
  ++counts_.offered;
  const float most = limit();
  // Every path begins at both first moments and ends at both last ones.
  float ends = 0;
  for (std::size_t point = 0; point < candidate.size(); ++point) {
    for (std::size_t axis = 0; axis < PointShape::kAxes; ++axis) {
      const float first = example_[point].at(axis, 0) - candidate[point].at(axis, 0);
      const float last = example_[point].at(axis, kN - 1) - candidate[point].at(axis, kN - 1);
      ends += first * first + last * last;
    }
  }
  if (ends > most) {
    ++counts_.by_ends;
    return;
  }
  if (outside(candidate) > most) {
    ++counts_.by_envelope;
    return;
  }
  const float sum = warped(example_, candidate, most, rest_);
  if (sum == kInfinity) ++counts_.abandoned;
  const Found found{sum, id};
  if (sum == kInfinity || (heap_.size() == most_ && !nearer(found, heap_.front()))) return;
  if (heap_.size() == most_) {
    std::pop_heap(heap_.begin(), heap_.end(), nearer);
    heap_.pop_back();
  }
  heap_.push_back(found);
  std::push_heap(heap_.begin(), heap_.end(), nearer);
}

std::vector<NearestSearch::Found> NearestSearch::take() {
  std::sort_heap(heap_.begin(), heap_.end(), nearer);
  for (Found& found : heap_) found.distance = distance_of(found.distance, example_.size());
  return std::move(heap_);
}

}  // namespace signweave
