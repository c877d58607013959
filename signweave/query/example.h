#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "signweave/features/hand_trace.h"

namespace signweave {

// Query by example: the distance between two spans of movement, and the nearest of many. Needs no database.
//
// Both are resampled to kShapePoints moments, evenly spaced in time. At each moment a point has a position (shoulder
// widths, signer-centred) and a velocity (shoulder widths per kVelocityTime). The distance is that of dynamic time
// warping (Sakoe and Chiba 1978) within a band of kShapeBand moments: the root of the least sum of squared differences
// along a path, normalised per moment and point. Identical spans have distance 0; a constant offset of one shoulder
// width gives distance 1.
//
// Most candidates are rejected by lower bounds of their distance: one from the first and last moment (Kim, Park and Chu
// 2001, in the form of Rakthanmanon et al. 2012), one from an envelope around the example (Keogh and Ratanamahatana
// 2005). Warping is abandoned as soon as the remainder cannot bring the distance below the limit (Rakthanmanon et al.
// 2012).

inline constexpr std::size_t kShapePoints = 32;
inline constexpr std::size_t kShapeBand = 3;  ///< a tenth of the moments
/// Seconds over which a velocity counts as a position (chosen by judgement).
inline constexpr float kVelocityTime = 0.15f;

/// Position x, y, z and velocity x, y, z of one point at each moment.
struct PointShape {
  static constexpr std::size_t kAxes = 6;
  /// Padding before the first and after the last moment, so that a full band can be read around each.
  static constexpr std::size_t kMargin = 4;
  using Axis = std::array<float, kShapePoints + 2 * kMargin>;
  std::array<Axis, kAxes> axes{};

  float& at(std::size_t axis, std::size_t moment) noexcept { return axes[axis][kMargin + moment]; }
  float at(std::size_t axis, std::size_t moment) const noexcept { return axes[axis][kMargin + moment]; }
};
/// One span of movement, ready for comparison: one entry per point.
using Shape = std::vector<PointShape>;

/// Points of a trace over a frame range (at least one frame, within the motion), read moment by moment. Borrows the
/// trace.
class TraceSpan {
 public:
  /// The trace must contain the points.
  TraceSpan(const HandTrace& trace, FrameRange frames) noexcept;

  /// Position, velocity, and two zeros.
  using Lanes = std::array<float, PointShape::kAxes + 2>;

 private:
  friend class NearestSearch;
  friend bool resample(const HandTrace& trace, TracePoint point, FrameRange frames, PointShape& out) noexcept;

  /// The two samples around a moment.
  struct SamplePair {
    std::size_t low = 0;
    std::size_t high = 0;
    float part = 0;  ///< interpolation weight of `high`
  };
  SamplePair samples_at(std::size_t moment) const noexcept;
  /// Returns false if a value is NaN.
  bool read(TracePoint point, const SamplePair& at, Lanes& out) const noexcept;

  const HandTrace* trace_;
  std::size_t first_;        ///< the sample at or before the first frame
  std::size_t left_;         ///< number of samples after it
  std::size_t whole_steps_;  ///< up to the last sample that is a full step after its predecessor
  float begin_, step_, per_step_, per_last_step_, scale_;
  Lanes units_;  ///< scale of each value of a sample
};

/// Resamples a point that the trace has, over a frame range (at least one frame, within the motion). Returns false if a
/// value is NaN.
bool resample(const HandTrace& trace, TracePoint point, FrameRange frames, PointShape& out) noexcept;
/// The same for a track of exactly those frames; `shoulder_width` in metres.
bool resample(std::span<const PointFrame> track, float shoulder_width, PointShape& out) noexcept;

/// The exact distance, without bounds: the reference for the search. Both shapes have the same points, at least one.
float warped_distance(const Shape& a, const Shape& b);

/// Finds the candidates nearest to one example. For one thread; `offer` allocates nothing once the result is full.
class NearestSearch {
 public:
  struct Found {
    float distance = 0;
    std::uint32_t id = 0;  ///< breaks ties: the lower id is nearer
    friend bool operator==(const Found&, const Found&) = default;
  };
  /// What became of the candidates.
  struct Counts {
    std::size_t offered = 0;
    std::size_t by_moments = 0;   ///< rejected by `too_far`; not included in `offered`
    std::size_t by_ends = 0;      ///< rejected by the first and last moment
    std::size_t by_envelope = 0;  ///< rejected by the example's envelope
    std::size_t abandoned = 0;    ///< abandoned while warping
  };

  /// Keeps the `most` (at least one) nearest to an example, whose values must be finite.
  NearestSearch(Shape example, std::size_t most);

  /// Adds a candidate: the points of the example, with finite values. Ids may come in any order.
  void offer(std::uint32_t id, const Shape& candidate);

  /// Whether these points of a trace, in the example's order, are too far to be a result, judged from a few moments. If
  /// so, they need not be offered. A false result does not mean that they are near.
  bool too_far(const TraceSpan& span, std::span<const TracePoint> points) noexcept;

  /// The results, nearest first. Ends the search.
  std::vector<Found> take();
  const Counts& counts() const noexcept { return counts_; }

 private:
  static bool nearer(const Found& a, const Found& b) noexcept {
    return a.distance < b.distance || (a.distance == b.distance && a.id < b.id);
  }
  /// The squared sum above which a candidate is rejected.
  float limit() const noexcept;
  /// Whether points of a trace, at these moments in turn, lie outside the example's envelope by more than `most`.
  bool outside_by_fours(const TraceSpan& span, std::span<const TracePoint> points,
                        const std::array<std::uint8_t, kShapePoints>& moments, float most) const noexcept;
  bool outside_by_eights(const TraceSpan& span, std::span<const TracePoint> points,
                         const std::array<std::uint8_t, kShapePoints>& moments, float most) const noexcept;
  /// Lower bound of what the candidate adds outside the example's envelope; `rest_` gets it from each moment onwards.
  float outside(const Shape& candidate);

  Shape example_;
  Shape low_;   ///< [point] minimum of the example within the band around each moment
  Shape high_;  ///< [point] maximum
  /// [point * kShapePoints + moment] the same, moment by moment.
  std::vector<TraceSpan::Lanes> low_lanes_, high_lanes_;
  std::size_t most_;
  std::vector<Found> heap_;  ///< max-heap: the farthest on top
  Counts counts_;
  std::array<float, kShapePoints + 1>
      rest_{};  ///< [moment] lower bound of what the candidate adds from that moment onwards
};

}  // namespace signweave
