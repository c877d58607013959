#include "signweave/query/example.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstring>

#if defined(__SSE2__)
#include <immintrin.h>
#define SIGNWEAVE_AVX2
#endif

namespace signweave {
namespace {

constexpr std::size_t kN = kShapePoints;
constexpr std::size_t kR = kShapeBand;
/// Moments read together around one: the band, and one for padding.
constexpr std::size_t kWide = 2 * kR + 2;
static_assert(PointShape::kMargin > kR && kWide == 8);
constexpr float kInfinity = std::numeric_limits<float>::infinity();

/// Bounds and distances are summed in different orders: a candidate is rejected only if it is farther by more than this
/// may change.
constexpr float kRounding = 1 + 1e-4f;

/// The squared differences between one moment of `a` and the moments around it of `b`, summed over all points and axes.
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

/// The least sum along a path from the first moments of both to the last; infinity as soon as it is known to exceed
/// `limit`, given a lower bound of what is added from each moment of `b` onwards.
float warped(const Shape& a, const Shape& b, float limit, const std::array<float, kN + 1>& rest) noexcept {
  // [k] of the previous row and of this one: the moment of b is that of a, minus the band, plus k.
  std::array<float, kWide + 2> before;
  std::array<float, kWide + 2> row;
  before.fill(kInfinity);
  for (std::size_t i = 0; i < kN; ++i) {
    const std::array<float, kWide> cost = differences(a, i, b);
    row.fill(kInfinity);
    float least = kInfinity;
    for (std::size_t k = 0; k <= 2 * kR; ++k) {
      if (i + k < kR || i + k >= kN + kR) continue;
      // In the row of the previous moment of a, the same moment of b is at k + 1.
      const float straight = before[k];
      const float down = before[k + 1];
      float across = kInfinity;
      if (k > 0) across = row[k - 1];
      const float from = i == 0 && k == kR ? 0.0f : std::min({straight, down, across});
      row[k] = from + cost[k];
      least = std::min(least, row[k]);
    }
    // Every path still has to pass every moment of b after the band.
    if (least + rest[std::min(i + kR + 1, kN)] > limit) return kInfinity;
    before = row;
  }
  return before[kR];
}

float distance_of(float sum, std::size_t points) noexcept {
  return std::sqrt(sum / static_cast<float>(kN * points));
}

/// Sum of the squared distances of values outside their bounds.
class Sums {
 public:
  using Lanes = TraceSpan::Lanes;
#if defined(__SSE2__)
  void add(const Lanes& values, const Lanes& low, const Lanes& high) noexcept {
    for (std::size_t i = 0; i < 2; ++i) {
      const __m128 value = _mm_loadu_ps(values.data() + 4 * i);
      const __m128 above = _mm_sub_ps(value, _mm_loadu_ps(high.data() + 4 * i));
      const __m128 below = _mm_sub_ps(_mm_loadu_ps(low.data() + 4 * i), value);
      const __m128 outside = _mm_max_ps(_mm_max_ps(above, below), _mm_setzero_ps());
      sums_[i] = _mm_add_ps(sums_[i], _mm_mul_ps(outside, outside));
    }
  }
  float all() const noexcept {
    const __m128 four = _mm_add_ps(sums_[0], sums_[1]);
    const __m128 two = _mm_add_ps(four, _mm_movehl_ps(four, four));
    return _mm_cvtss_f32(_mm_add_ss(two, _mm_shuffle_ps(two, two, 1)));
  }

 private:
  __m128 sums_[2] = {_mm_setzero_ps(), _mm_setzero_ps()};
#else
  // Bit-identical to the above: a NaN difference counts as zero, and the sums are added in the same order.
  void add(const Lanes& values, const Lanes& low, const Lanes& high) noexcept {
    for (std::size_t i = 0; i < values.size(); ++i) {
      const float outside = std::max(0.0f, std::max(low[i] - values[i], values[i] - high[i]));
      sums_[i] += outside * outside;
    }
  }
  float all() const noexcept {
    std::array<float, 4> four;
    for (std::size_t i = 0; i < four.size(); ++i) four[i] = sums_[i] + sums_[4 + i];
    return (four[0] + four[2]) + (four[1] + four[3]);
  }

 private:
  Lanes sums_{};
#endif
};

/// Interpolates between two frames of a track with weight `part`.
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

TraceSpan::TraceSpan(const HandTrace& trace, FrameRange frames) noexcept
    : trace_(&trace), first_(static_cast<std::size_t>(frames.begin / trace.step)) {
  assert(!frames.empty() && frames.begin >= 0 && frames.end <= trace.frames);
  left_ = trace.samples() - 1 - first_;
  // The last sample is that of the last frame, which may be less than a full step away.
  const std::int64_t regular = (trace.frames - 1) / trace.step * trace.step;
  whole_steps_ = static_cast<std::size_t>(regular / trace.step) - first_;
  begin_ = static_cast<float>(frames.begin % trace.step);
  step_ = static_cast<float>(trace.step);
  per_step_ = 1 / step_;
  const std::int64_t last_step = trace.frames - 1 - regular;
  per_last_step_ = last_step > 0 ? 1 / static_cast<float>(last_step) : per_step_;
  scale_ = static_cast<float>(frames.size() - 1) / static_cast<float>(kN - 1);
  constexpr float kP = TraceSample::kPosition;
  const float velocity = TraceSample::kVelocity * kVelocityTime / trace.shoulder_width;
  units_ = {kP, kP, kP, velocity, velocity, velocity, 0, 0};
}

inline TraceSpan::SamplePair TraceSpan::samples_at(std::size_t moment) const noexcept {
  const float at = begin_ + scale_ * static_cast<float>(moment);
  // Converts through a signed integer: the conversion to unsigned takes several instructions.
  const auto steps = static_cast<std::size_t>(static_cast<std::int64_t>(at * per_step_));
  const std::size_t low = std::min({steps, whole_steps_, left_});
  const float gap = low == whole_steps_ ? per_last_step_ : per_step_;
  return {low, std::min(low + 1, left_), std::min((at - static_cast<float>(low) * step_) * gap, 1.0f)};
}

inline bool TraceSpan::read(TracePoint point, const SamplePair& at, Lanes& out) const noexcept {
  constexpr std::int16_t kNone = std::numeric_limits<std::int16_t>::min();
  const TraceSample* samples = (*trace_)[point].data() + first_;
  static_assert(sizeof(TraceSample) == 8 * sizeof(std::int16_t));
#if defined(__SSE2__)
  const __m128i a = _mm_loadu_si128(reinterpret_cast<const __m128i*>(samples + at.low));
  const __m128i b = _mm_loadu_si128(reinterpret_cast<const __m128i*>(samples + at.high));
  const __m128 part = _mm_set1_ps(at.part);
  // Four values each, in the upper halves of 32 bits, shifted down with their signs.
  const auto between = [&](__m128i from_bits, __m128i to_bits, const float* by, float* to) {
    const __m128 from = _mm_cvtepi32_ps(_mm_srai_epi32(from_bits, 16));
    const __m128 difference = _mm_sub_ps(_mm_cvtepi32_ps(_mm_srai_epi32(to_bits, 16)), from);
    _mm_storeu_ps(to, _mm_mul_ps(_mm_loadu_ps(by), _mm_add_ps(from, _mm_mul_ps(part, difference))));
  };
  between(_mm_unpacklo_epi16(a, a), _mm_unpacklo_epi16(b, b), units_.data(), out.data());
  between(_mm_unpackhi_epi16(a, a), _mm_unpackhi_epi16(b, b), units_.data() + 4, out.data() + 4);
#else
  std::array<std::int16_t, 8> a;
  std::array<std::int16_t, 8> b;
  std::memcpy(a.data(), samples + at.low, sizeof a);
  std::memcpy(b.data(), samples + at.high, sizeof b);
  for (std::size_t i = 0; i < units_.size(); ++i) {
    const auto from = static_cast<float>(a[i]);
    out[i] = units_[i] * (from + at.part * (static_cast<float>(b[i]) - from));
  }
#endif
  return samples[at.low].position[0] != kNone && samples[at.high].position[0] != kNone;
}

bool resample(const HandTrace& trace, TracePoint point, FrameRange frames, PointShape& out) noexcept {
  assert(!trace[point].empty());
  const TraceSpan span(trace, frames);
  bool known = true;
  TraceSpan::Lanes lanes;
  for (std::size_t moment = 0; moment < kN; ++moment) {
    known = span.read(point, span.samples_at(moment), lanes) && known;
    for (std::size_t axis = 0; axis < PointShape::kAxes; ++axis) out.at(axis, moment) = lanes[axis];
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
  low_lanes_.resize(example_.size() * kN);
  high_lanes_.resize(example_.size() * kN);
  for (std::size_t i = 0; i < low_lanes_.size(); ++i) {
    for (std::size_t axis = 0; axis < PointShape::kAxes; ++axis) {
      low_lanes_[i][axis] = low_[i / kN].at(axis, i % kN);
      high_lanes_[i][axis] = high_[i / kN].at(axis, i % kN);
    }
  }
}

bool NearestSearch::too_far(const TraceSpan& span, std::span<const TracePoint> points) noexcept {
  assert(points.size() == example_.size());
  const float most = limit();
  if (most == kInfinity) return false;
  // Distant moments first: each adds different information.
  static constexpr std::array<std::uint8_t, kN> kMoments = {16, 0,  31, 8,  24, 4,  12, 20, 28, 2, 6,
                                                            10, 14, 18, 22, 26, 30, 1,  3,  5,  7, 9,
                                                            11, 13, 15, 17, 19, 21, 23, 25, 27, 29};
#if defined(SIGNWEAVE_AVX2)
  static const bool has_avx2 = __builtin_cpu_supports("avx2") != 0;
  const bool far =
      has_avx2 ? outside_by_eights(span, points, kMoments, most) : outside_by_fours(span, points, kMoments, most);
#else
  const bool far = outside_by_fours(span, points, kMoments, most);
#endif
  if (far) ++counts_.by_moments;
  return far;
}

bool NearestSearch::outside_by_fours(const TraceSpan& span, std::span<const TracePoint> points,
                                     const std::array<std::uint8_t, kN>& moments, float most) const noexcept {
  Sums sums;
  TraceSpan::Lanes lanes;
  for (const std::size_t moment : moments) {
    const TraceSpan::SamplePair pair = span.samples_at(moment);
    for (std::size_t point = 0; point < points.size(); ++point) {
      span.read(points[point], pair, lanes);
      sums.add(lanes, low_lanes_[point * kN + moment], high_lanes_[point * kN + moment]);
    }
    if (sums.all() > most) return true;
  }
  return false;
}

#if defined(SIGNWEAVE_AVX2)
/// Bit-identical to the above with eight values in one register.
__attribute__((target("avx2"))) bool NearestSearch::outside_by_eights(const TraceSpan& span,
                                                                      std::span<const TracePoint> points,
                                                                      const std::array<std::uint8_t, kN>& moments,
                                                                      float most) const noexcept {
  const __m256 units = _mm256_loadu_ps(span.units_.data());
  __m256 sums = _mm256_setzero_ps();
  for (const std::size_t moment : moments) {
    const TraceSpan::SamplePair pair = span.samples_at(moment);
    const __m256 part = _mm256_set1_ps(pair.part);
    for (std::size_t point = 0; point < points.size(); ++point) {
      const TraceSample* samples = (*span.trace_)[points[point]].data() + span.first_;
      const auto* from_bits = reinterpret_cast<const __m128i*>(samples + pair.low);
      const auto* to_bits = reinterpret_cast<const __m128i*>(samples + pair.high);
      const __m256 from = _mm256_cvtepi32_ps(_mm256_cvtepi16_epi32(_mm_loadu_si128(from_bits)));
      const __m256 to = _mm256_cvtepi32_ps(_mm256_cvtepi16_epi32(_mm_loadu_si128(to_bits)));
      const __m256 value = _mm256_mul_ps(units, _mm256_add_ps(from, _mm256_mul_ps(part, _mm256_sub_ps(to, from))));
      const __m256 above = _mm256_sub_ps(value, _mm256_loadu_ps(high_lanes_[point * kN + moment].data()));
      const __m256 below = _mm256_sub_ps(_mm256_loadu_ps(low_lanes_[point * kN + moment].data()), value);
      const __m256 outside = _mm256_max_ps(_mm256_max_ps(above, below), _mm256_setzero_ps());
      sums = _mm256_add_ps(sums, _mm256_mul_ps(outside, outside));
    }
    const __m128 four = _mm_add_ps(_mm256_castps256_ps128(sums), _mm256_extractf128_ps(sums, 1));
    const __m128 two = _mm_add_ps(four, _mm_movehl_ps(four, four));
    if (_mm_cvtss_f32(_mm_add_ss(two, _mm_shuffle_ps(two, two, 1))) > most) return true;
  }
  return false;
}
#endif

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
  // Every path begins at both first moments and ends at both last moments.
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
