#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "signweave/core/time.h"
#include "signweave/features/gaze.h"
#include "signweave/features/hand_trace.h"
#include "signweave/features/phase_features.h"
#include "signweave/features/point_sum.h"
#include "signweave/features/point_track.h"
#include "signweave/features/two_handed.h"
#include "signweave/query/extent.h"
#include "signweave/semantic_db/segment_table.h"

namespace signweave {

// Access of queries to movement, independent of where it is stored: `Movement`, which `database` implements. Each
// measure of the hands is a column of floats, computed by `measure_rows` when a recording is put.

/// A measure of one hand, or of both, over one segment.
enum class HandMeasure : std::uint8_t {
  speed,              ///< peak, metres per second
  mean_speed,         ///< metres per second
  least_speed,        ///< metres per second
  acceleration,       ///< peak of its length, metres per second squared
  mean_acceleration,  ///< of its length, metres per second squared
  least_acceleration,
  path,          ///< length, metres
  displacement,  ///< straight line from begin to end, metres
  contact,       ///< a set of Contact as a number: everything touched at some moment
  begin_x,       ///< at the first frame: to the signer's left, shoulder widths
  begin_height,  ///< upwards
  begin_forward,
  begin_state,  ///< see `state_number`
  end_x,        ///< at the last frame
  end_height,
  end_forward,
  end_state,
  least_x,  ///< minimum (farthest to the signer's right), shoulder widths
  least_height,
  least_forward,
  least_openness,
  most_x,
  most_height,
  most_forward,
  most_openness,
  zones,     ///< a set: the zones it is in at some moment (query/extent.h)
  entered,   ///< a set: the zones it enters
  facings,   ///< a set: directions of palm and fingers at some moment
  distance,  ///< minimum distance of the palms, metres; one column for both hands, as are the following
  most_distance,
  begin_distance,  ///< at the first frame
  end_distance,    ///< at the last frame
  hands,           ///< a set with one member, the class of the movement: `bit_of(Hands)`
};
/// The member of HandMeasure::hands for a class.
constexpr std::uint32_t bit_of(Hands hands) noexcept {
  return 1U << static_cast<unsigned>(hands);
}
inline constexpr std::size_t kHandMeasures = static_cast<std::size_t>(HandMeasure::distance);

/// One column: a measure of a hand, or one of both hands (then `side` is ignored).
struct Column {
  HandMeasure measure = HandMeasure::speed;
  Side side = Side::right;
};
inline constexpr std::size_t kMovementColumns = 2 * kHandMeasures + 5;
/// Its index among all columns, below kMovementColumns: first the left hand's, then the right hand's, then those of
/// both hands.
constexpr std::size_t place_of(Column column) noexcept {
  const auto measure = static_cast<std::size_t>(column.measure);
  if (measure >= kHandMeasures) return kHandMeasures + measure;
  return static_cast<std::size_t>(column.side) * kHandMeasures + measure;
}

inline constexpr float kNotKnown = std::numeric_limits<float>::quiet_NaN();

/// A hand's state and zone as one whole number below 2^20, which a float holds exactly. Bits from the lowest: 7
/// openness, 3 Contact, 3 Facing of the palm, 3 of the fingers, 3 Height, 1 Reach.
std::uint32_t state_number(const HandState& state, Zone zone) noexcept;
struct StateAndZone {
  HandState state;
  Height height = Height::chest;
  Reach reach = Reach::near;
};
StateAndZone state_of(std::uint32_t number) noexcept;

/// What `measure_rows` needs to know about a row.
struct MovementRow {
  RowKind kind = RowKind::annotation;
  PhaseKind phase = PhaseKind::other;  ///< for a phase
  RowId parent = kNoRow;               ///< for a phase: the index of its sign in the same list
  TimeSpan span{};
};

/// The columns of some rows, [place_of(column)][row]; kNotKnown if a value is not known.
using MovementColumns = std::array<std::vector<float>, kMovementColumns>;

/// The columns of one recording. Phases take their values from `features` (one entry per phase row, in order) and the
/// measures that features lack (peak acceleration, contact at any moment, minimum distance of the hands) from the
/// trace. Signs are measured over their strokes; all other rows from the trace. A sign's values are kNotKnown if any of
/// its strokes' values are. A row that lies partly outside the motion is measured over the part inside, as phases are.
MovementColumns measure_rows(std::span<const MovementRow> rows, const RecordingFeatures& features,
                             const HandTrace& trace, const FrameClock& clock, const Pause& pause = {});

/// The values of a column, and their owner, which keeps them in memory.
struct ColumnValues {
  std::span<const float> values;
  std::shared_ptr<const void> owner;
};

/// The movement of the segments of a database. Recordings are numbered as in Segments, rows within their recording as
/// in its table. For one thread.
class Movement {
 public:
  virtual ~Movement() = default;

  /// One value per row of a recording, kNotKnown if it is not known. Empty if nothing is stored: use the trace instead.
  virtual ColumnValues column(Column column, std::uint32_t recording) const = 0;
  /// Metres; 0 if it is not known.
  virtual float shoulder_width(std::uint32_t recording) const = 0;
  virtual FrameClock clock(std::uint32_t recording) const = 0;
  /// The hands of a recording; never null, but possibly empty (`why_not`).
  virtual std::shared_ptr<const HandTrace> hands(std::uint32_t recording) const = 0;
  /// Points of the body over some frames of a recording, as `track_points` returns them, computed from the motion.
  virtual std::vector<PointTrack> points(std::uint32_t recording, std::span<const Part> parts,
                                         FrameRange range) const = 0;
  /// Number of frames of the motion; 0 if there is no motion.
  virtual std::int64_t frame_count(std::uint32_t) const { return 0; }
  /// Values of a scalar track, one per frame; the frames must lie within the motion. Empty if the track is not known. A
  /// track that is 0 throughout may be omitted from storage: it is known, and 0.
  virtual std::vector<float> track(std::uint32_t, std::string_view, FrameRange) const { return {}; }
  /// The gaze, one value per frame; the frames must lie within the motion. Empty if it is not known.
  virtual std::vector<Gaze> gaze(std::uint32_t, FrameRange) const { return {}; }
  /// Whether any recording has a scalar track of this name.
  virtual bool has_track(std::string_view) const { return false; }
  /// The names of the scalar tracks of all recordings, sorted.
  virtual std::vector<std::string> tracks() const { return {}; }
  /// Called regularly by computations on movement that take more than a few milliseconds. May throw Error{cancelled}.
  virtual void pause() const {}
};

/// The movement of a point over one span, or over several consecutive spans.
struct Course {
  PointOver over;
  Extent extent;
};

/// Accumulates a `Course` frame by frame. Borrows the body, which determines the zones.
class CourseSum {
 public:
  explicit CourseSum(const SignerBody& body) noexcept : reached_(body) {}
  void add(const PointFrame& frame) noexcept {
    moved_.add(frame);
    reached_.add(frame);
  }
  /// The course of the frames added so far, at least one.
  Course course(FrameRate rate, float shoulder_width) const noexcept {
    return {moved_.over(rate, shoulder_width), reached_.extent()};
  }

 private:
  PointSum moved_;
  ExtentSum reached_;
};

/// A measure of a hand, or of a point in its place; `kNotKnown` if the measure is not of a single hand. `body`
/// determines the zones.
float measure_of(const Course& course, HandMeasure measure, const SignerBody& body) noexcept;

/// The value of HandMeasure::hands.
float hands_of(const TwoHandedSum& both, const SignerBody& body) noexcept;

/// Combines several spans (at least one) as if they were one: peaks, sums, and means weighted by `frames`. Displacement
/// is from the begin of the first to the end of the last.
Course join(std::span<const Course> courses, std::span<const double> frames, float shoulder_width) noexcept;

/// Distances of two points over some frames, in metres. kNotKnown before the first frame, and permanently once a
/// position is not known.
struct Distances {
  float least = kNotKnown;
  float most = kNotKnown;
  float begin = kNotKnown;
  float end = kNotKnown;
  bool known() const noexcept { return !std::isnan(least); }
  /// Adds the next frames of both points. Returns false if a distance is not known: nothing more may be added then.
  bool add(std::span<const PointFrame> a, std::span<const PointFrame> b, float shoulder_width) noexcept;
  float operator[](HandMeasure measure) const noexcept;
};

/// Source of the movement of one table's rows.
struct MovingTable {
  const Movement* movement = nullptr;                   ///< null: nothing is known
  const std::vector<std::uint32_t>* numbers = nullptr;  ///< [recording of the table] its number in Segments
};

/// The frames of a segment within a motion of `frames` frames, as features are measured over: one frame if the segment
/// is shorter than a frame; empty if it lies outside the motion.
FrameRange measured_frames(TimeSpan span, const FrameClock& clock, std::int64_t frames) noexcept;

}  // namespace signweave
