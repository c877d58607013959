#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "signweave/features/hand_trace.h"

namespace signweave {

// Query by example: how far one stretch of movement is from another, and the nearest of many. Needs no database.
//
// Both are resampled to kShapePoints moments, evenly spaced in time. At each moment a point has its position (shoulder
// widths, signer-centred) and its velocity (shoulder widths in kVelocityTime). The distance is that of dynamic time
// warping (Sakoe and Chiba 1978) within a band of kShapeBand moments: the root of the least sum of squared differences
// along a path, a moment and point: of two that are the same it is 0, and one shoulder width where all is so far off.
//
// Most candidates are told to be too far by bounds that never exceed their distance: from first and last moment (Kim,
// Park and Chu 2001, as Rakthanmanon et al. 2012 use it), from an envelope around the example (Keogh and Ratanamahatana
// 2005); and warping is abandoned as soon as the rest cannot be near (Rakthanmanon et al. 2012).

inline constexpr std::size_t kShapePoints = 32;
inline constexpr std::size_t kShapeBand = 3;  ///< a tenth of the moments
/// Seconds in which a velocity counts as a position (ours, chosen by judgement).
inline constexpr float kVelocityTime = 0.15f;

/// Position x, y, z and velocity x, y, z of one point at each moment.
struct PointShape {
  static constexpr std::size_t kAxes = 6;
  /// Before the first moment and behind the last, so that a whole band can be read around each.
  static constexpr std::size_t kMargin = 4;
  using Axis = std::array<float, kShapePoints + 2 * kMargin>;
  std::array<Axis, kAxes> axes{};

  float& at(std::size_t axis, std::size_t moment) noexcept { return axes[axis][kMargin + moment]; }
  float at(std::size_t axis, std::size_t moment) const noexcept { return axes[axis][kMargin + moment]; }
};
/// One stretch of movement, ready to be compared. One entry for each point.
using Shape = std::vector<PointShape>;

/// Points of a trace over some frames (at least one, within the motion), read moment by moment. Borrows the trace.
class TraceStretch {
 public:
  /// The trace must have the points.
  TraceStretch(const HandTrace& trace, FrameRange frames) noexcept;

  /// Position, velocity, and two zeros.
  using Lanes = std::array<float, PointShape::kAxes + 2>;

 private:
  friend class NearestSearch;
  friend bool resample(const HandTrace& trace, TracePoint point, FrameRange frames, PointShape& out) noexcept;

  /// Between which samples a moment lies.
  struct Place {
    std::size_t low = 0;
    std::size_t high = 0;
    float part = 0;  ///< of the way from one to the other
  };
  Place place(std::size_t moment) const noexcept;
  /// False where one of the numbers is none.
  bool read(TracePoint point, const Place& at, Lanes& out) const noexcept;

  const HandTrace* trace_;
  std::size_t first_;        ///< the sample at or before the first frame
  std::size_t left_;         ///< samples behind it
  std::size_t whole_steps_;  ///< to the last sample that is a whole step behind the one before
  float begin_, step_, per_step_, per_last_step_, scale_;
  Lanes units_;  ///< what a number of a sample counts
};

/// A point of a trace, which must have it, over some frames (at least one, within the motion). False where a number of
/// them is none.
bool resample(const HandTrace& trace, TracePoint point, FrameRange frames, PointShape& out) noexcept;
/// The same of a track that holds just those frames; `shoulder_width` in metres.
bool resample(std::span<const PointFrame> track, float shoulder_width, PointShape& out) noexcept;

/// The distance, without bounds: what the search has to give. Both shapes have the same points, at least one.
float warped_distance(const Shape& a, const Shape& b);

/// Finds the nearest of many to one example. For one thread; `offer` allocates nothing once it is full.
class NearestSearch {
 public:
  struct Found {
    float distance = 0;
    std::uint32_t id = 0;  ///< of two at one distance the lower is nearer
    friend bool operator==(const Found&, const Found&) = default;
  };
  /// What became of those that were offered.
  struct Counts {
    std::size_t offered = 0;
    std::size_t by_moments = 0;   ///< `too_far`, and so not among `offered`
    std::size_t by_ends = 0;      ///< refused by first and last moment
    std::size_t by_envelope = 0;  ///< refused by the example's envelope
    std::size_t abandoned = 0;    ///< while warping
  };

  /// The `most` (at least one) nearest to an example, whose numbers must be finite.
  NearestSearch(Shape example, std::size_t most);

  /// Shows a candidate, in any order of ids: the example's points, with numbers that are finite.
  void offer(std::uint32_t id, const Shape& candidate);

  /// Whether these points of a trace, in the example's order, are too far to be an answer, told from a few moments
  /// of them: then they need not be offered. What seems near may be far yet.
  bool too_far(const TraceStretch& stretch, std::span<const TracePoint> points) noexcept;

  /// Nearest first. The search is over.
  std::vector<Found> take();
  const Counts& counts() const noexcept { return counts_; }

 private:
  static bool nearer(const Found& a, const Found& b) noexcept {
    return a.distance < b.distance || (a.distance == b.distance && a.id < b.id);
  }
  /// Above this no candidate is wanted any more; as sums of squares.
  float limit() const noexcept;
  /// Whether points of a trace, at these moments in turn, lie outside the example's envelope by more than `most`.
  bool outside_by_fours(const TraceStretch& stretch, std::span<const TracePoint> points,
                        const std::array<std::uint8_t, kShapePoints>& moments, float most) const noexcept;
  bool outside_by_eights(const TraceStretch& stretch, std::span<const TracePoint> points,
                         const std::array<std::uint8_t, kShapePoints>& moments, float most) const noexcept;
  /// What the candidate adds at least outside the example's envelope, into `rest_` from each moment on.
  float outside(const Shape& candidate);

  Shape example_;
  Shape low_;   ///< [point] least of the example within the band around each moment
  Shape high_;  ///< [point] the most
  /// [point * kShapePoints + moment] the same, moment by moment.
  std::vector<TraceStretch::Lanes> low_lanes_, high_lanes_;
  std::size_t most_;
  std::vector<Found> heap_;  ///< the farthest on top
  Counts counts_;
  std::array<float, kShapePoints + 1> rest_{};  ///< [moment] what the candidate adds at least from there on
};

}  // namespace signweave
