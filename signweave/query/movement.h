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
#include "signweave/query/extent.h"
#include "signweave/semantic_db/segment_table.h"

namespace signweave {

// How a query gets at movement without knowing where it is stored: `Movement`, which `database` implements. What is
// measured of the hands is a column of floats for each measure, computed by `measure_rows` when a recording is put.

/// What is measured of one hand over one segment, or of both.
enum class HandMeasure : std::uint8_t {
  speed,              ///< the peak, metres a second
  mean_speed,         ///< metres a second
  least_speed,        ///< metres a second
  acceleration,       ///< the peak of its length, metres a second squared
  mean_acceleration,  ///< of its length, metres a second squared
  least_acceleration,
  path,          ///< its length, metres
  displacement,  ///< straight from begin to end, metres
  contact,       ///< a set of Contact as a number: all that is touched at some moment
  begin_x,       ///< at the first frame: to the signer's left, shoulder widths
  begin_height,  ///< up
  begin_forward,
  begin_state,  ///< see `state_number`
  end_x,        ///< at the last frame
  end_height,
  end_forward,
  end_state,
  least_x,  ///< the farthest to the signer's right, shoulder widths
  least_height,
  least_forward,
  least_openness,
  most_x,
  most_height,
  most_forward,
  most_openness,
  zones,     ///< a set: where it is at some moment (query/extent.h)
  entered,   ///< a set: the zones that it enters
  facings,   ///< a set: where palm and fingers point to at some moment
  distance,  ///< of the palms from each other, the least, metres; one column for both hands, as are these:
  most_distance,
  begin_distance,  ///< at the first frame
  end_distance,    ///< at the last
};
inline constexpr std::size_t kHandMeasures = static_cast<std::size_t>(HandMeasure::distance);

/// One column: a measure of a hand, or one of both (then `side` does not matter).
struct Column {
  HandMeasure measure = HandMeasure::speed;
  Side side = Side::right;
};
inline constexpr std::size_t kMovementColumns = 2 * kHandMeasures + 4;
/// Its place among all columns, below kMovementColumns: left hand's, right hand's, both hands'.
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

/// What `measure_rows` has to know of a row.
struct MovementRow {
  RowKind kind = RowKind::annotation;
  PhaseKind phase = PhaseKind::other;  ///< of a phase
  RowId parent = kNoRow;               ///< of a phase: the place of its sign in the same list
  TimeSpan span{};
};

/// The columns of some rows, [place_of(column)][row], kNotKnown where nothing is known.
using MovementColumns = std::array<std::vector<float>, kMovementColumns>;

/// The columns of one recording. Phases have what `features` says of them (one entry for each phase row, in order),
/// and from the trace what features lack (peak acceleration, contact at any moment, the hands' least distance); signs
/// have it over their strokes; every other row has it from the trace. Numbers of a sign are known where those of each
/// of its strokes are. A row that the motion holds in part has those of that part, as phases have.
MovementColumns measure_rows(std::span<const MovementRow> rows, const RecordingFeatures& features,
                             const HandTrace& trace, const FrameClock& clock, const Pause& pause = {});

/// The numbers of a column, and what keeps them in memory.
struct ColumnValues {
  std::span<const float> values;
  std::shared_ptr<const void> owner;
};

/// The movement of what the segments of a database list. Recordings are numbered as in Segments, rows within their
/// recording, as its table has them. For one thread.
class Movement {
 public:
  virtual ~Movement() = default;

  /// One number for each row of a recording, kNotKnown where nothing is known of it; or empty: nothing is stored, ask
  /// for the trace.
  virtual ColumnValues column(Column column, std::uint32_t recording) const = 0;
  /// Metres; 0 where it is not known.
  virtual float shoulder_width(std::uint32_t recording) const = 0;
  virtual FrameClock clock(std::uint32_t recording) const = 0;
  /// The hands of a recording; never null, but perhaps empty (`why_not`).
  virtual std::shared_ptr<const HandTrace> hands(std::uint32_t recording) const = 0;
  /// Points of the body over some frames of a recording, as `track_points` gives them, computed from the motion.
  virtual std::vector<PointTrack> points(std::uint32_t recording, std::span<const Part> parts,
                                         FrameRange range) const = 0;
  /// Frames of the motion; 0 where there is none.
  virtual std::int64_t frame_count(std::uint32_t) const { return 0; }
  /// Values of a scalar track at some frames, which must lie within the motion: one for each; none where it is not
  /// known. A track that is 0 throughout may be left out of what is stored: it is known, and 0.
  virtual std::vector<float> track(std::uint32_t, std::string_view, FrameRange) const { return {}; }
  /// The gaze at some frames, which must lie within the motion: one for each; none where it is not known.
  virtual std::vector<Gaze> gaze(std::uint32_t, FrameRange) const { return {}; }
  /// Whether a scalar track of this name is known of some recording.
  virtual bool has_track(std::string_view) const { return false; }
  /// The names of all scalar tracks that are known of some recording, sorted.
  virtual std::vector<std::string> tracks() const { return {}; }
  /// Called now and then by what works on movement for more than a few milliseconds. May throw Error{cancelled}.
  virtual void pause() const {}
};

/// How a point moves over one stretch, or over several of them one after the other.
struct Course {
  PointOver over;
  Extent extent;
};

/// `Course` of frames that are added one after the other. Borrows the body, which tells the zones.
class CourseSum {
 public:
  explicit CourseSum(const SignerBody& body) noexcept : reached_(body) {}
  void add(const PointFrame& frame) noexcept {
    moved_.add(frame);
    reached_.add(frame);
  }
  /// Of what was added, at least one frame.
  Course course(FrameRate rate, float shoulder_width) const noexcept {
    return {moved_.over(rate, shoulder_width), reached_.extent()};
  }

 private:
  PointSum moved_;
  ExtentSum reached_;
};

/// One of the measures of a hand, or of a point in its place, `kNotKnown` where it is none of a hand's; `body` tells
/// the zones.
float measure_of(const Course& course, HandMeasure measure, const SignerBody& body) noexcept;

/// Of several stretches (at least one) as of one: peaks, sums, and means by `frames`. Displacement is from the begin of
/// the first to the end of the last.
Course join(std::span<const Course> courses, std::span<const double> frames, float shoulder_width) noexcept;

/// How far two points are from each other over some frames, metres; kNotKnown before a frame was added, and for good
/// once one of them is not known.
struct Distances {
  float least = kNotKnown;
  float most = kNotKnown;
  float begin = kNotKnown;
  float end = kNotKnown;
  bool known() const noexcept { return !std::isnan(least); }
  /// Frames that come next, which both have; false where it is not known: then nothing more may be added.
  bool add(std::span<const PointFrame> a, std::span<const PointFrame> b, float shoulder_width) noexcept;
  float operator[](HandMeasure measure) const noexcept;
};

/// Where rows of one table get their movement.
struct MovingTable {
  const Movement* movement = nullptr;                   ///< none: nothing is known
  const std::vector<std::uint32_t>* numbers = nullptr;  ///< [recording of the table] its number in Segments
};

/// The frames of a segment within a motion of so many, as features are measured over: one frame where it is shorter
/// than that; empty where it lies outside.
FrameRange measured_frames(TimeSpan span, const FrameClock& clock, std::int64_t frames) noexcept;

}  // namespace signweave
