#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <functional>
#include <limits>
#include <optional>
#include <span>
#include <vector>

#include "signweave/query/movement.h"
#include "signweave/query/phase_query.h"

namespace signweave {

/// A row of a table as seen by a condition on movement.
struct MovingRow {
  RowId row = kNoRow;  ///< within its recording
  std::uint32_t recording = 0;
  bool any_hand = true;     ///< the row has no hand or both, so `hand` means either
  Side hand = Side::right;  ///< for a row of one hand
};

/// Whether a term is about hands only, for which columns are stored. All other terms are read from the motion, segment
/// by segment.
bool is_scannable(const MovementTerm& term) noexcept;

/// The spans a row is measured over: a sign's strokes in order; for any other row, its span.
using MeasuredSpans = std::function<std::vector<TimeSpan>()>;

/// A condition on movement, or on how both hands take part, bound to one database. Borrows the movement; if it is null,
/// nothing is known. For one thread.
class MovementCheck {
 public:
  /// `condition` must have Field::movement or Field::hands.
  MovementCheck(const Condition& condition, const Movement* movement);

  /// Returns false also if the value is not known. `spans` is called if a value is not stored. Throws
  /// Error{corrupt} if a trace or motion is damaged, and whatever Movement::pause throws.
  bool holds(const MovingRow& row, const MeasuredSpans& spans);

  /// Whether the value may be stored as a column, that is, the term is about hands.
  bool scannable() const noexcept { return is_scannable(condition_->movement); }
  /// Appends `first` plus each row of a recording for which the condition holds, and perhaps other rows (for `hand`:
  /// those where either hand meets it). Returns false and appends nothing if a value it needs is not stored.
  bool scan(std::uint32_t recording, RowId first, std::vector<RowId>& rows);

 private:
  struct Alternative {
    Point point;
    std::optional<Point> other;
    bool own = false;          ///< `point` is a substitute for `hand`: for a row of one hand it must be that hand
    bool other_own = false;    ///< the same for `other`
    ColumnValues column = {};  ///< of `recording_`; empty: computed from frames
    std::array<ColumnValues, 6> ends = {};  ///< for is_of_ends in its place: x, height, forward of begin and of end
    std::vector<float> angles = {};  ///< [row of `recording_`] where the finger points; infinite: not computed yet
  };
  /// How a row's value is tested.
  enum class Reading : std::uint8_t {
    within,   ///< it lies within the bounds
    outside,  ///< it lies outside the bounds
    set,      ///< it has a bit of the mask
    state,    ///< its state number is decoded
  };
  static constexpr float kUnbounded = std::numeric_limits<float>::infinity();
  /// Both included. No value lies within if low is above high; NaN never does.
  struct Bounds {
    float low, high;  ///< kUnbounded: none
    bool hold(float value) const noexcept { return low <= value && value <= high; }
  };

  void load(std::uint32_t recording);
  void load_ends(Alternative& alternative, std::uint32_t recording);
  float series_of(const MovingRow& row, const MeasuredSpans& spans);
  bool of_ends() const noexcept { return is_of_ends(condition_->movement.quantity); }
  /// Whether the values of an alternative are stored; its column is then computed from its `ends`.
  bool is_stored(const Alternative& alternative) const noexcept;
  float stored_value(const Alternative& alternative, RowId row) const;
  float computed_value(Alternative& alternative, const MovingRow& row, std::span<const TimeSpan> spans);
  static Reading reading_of(const Condition& condition, HandMeasure measure) noexcept;
  void append_fitting(std::span<const float> column, RowId first, std::vector<RowId>& rows) const;
  bool fits(float value) const;
  Bounds bounds_of_amount(std::uint32_t recording) const;
  Bounds bounds_of_zone(std::uint32_t recording) const;
  float from_frames(const Alternative& alternative, std::uint32_t recording, std::span<const TimeSpan> spans) const;
  void track(const Point& point, std::uint32_t recording, const HandTrace& trace, FrameRange frames,
             PointTrack& out) const;

  const Movement* movement_;
  const Condition* condition_;
  std::vector<Alternative> alternatives_;   ///< at least one must hold
  std::optional<std::uint32_t> recording_;  ///< the one whose columns and bounds are loaded
  HandMeasure measure_ = HandMeasure::speed;
  Reading reading_ = Reading::within;
  std::uint32_t mask_ = 0;                           ///< for Reading::set
  Bounds bounds_{};                                  ///< of `recording_`
  Eigen::Vector3f locus_ = Eigen::Vector3f::Zero();  ///< of an aim, for `recording_`
  bool scaled_ = false;  ///< the value's unit differs from the column's: it depends on the signer's shoulder width
  std::vector<float>
      series_values_;  ///< [row of `recording_`] value of a track or the gaze; infinite: not computed yet
};

}  // namespace signweave
