#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "signweave/query/movement.h"
#include "signweave/query/phase_query.h"

namespace signweave {

/// A row of a table as a condition on movement looks at it.
struct MovingRow {
  RowId row = kNoRow;  ///< within its recording
  std::uint32_t recording = 0;
  bool any_hand = true;     ///< it is of no hand or of both, so that `hand` means either
  Side hand = Side::right;  ///< of a row of one hand
};

/// Whether a term is about hands alone, of which columns are stored. All else is read from the motion, segment by
/// segment.
bool is_scannable(const MovementTerm& term) noexcept;

/// What is looked at of a row: a sign's strokes in order, of other rows their span.
using Stretches = std::function<std::vector<TimeSpan>()>;

/// A condition on movement made ready for one database. Borrows the movement, which may be null: then nothing is known.
/// For one thread.
class MovementCheck {
 public:
  /// `condition` must have Field::movement.
  MovementCheck(const Condition& condition, const Movement* movement);

  /// False also where what is asked for is not known. `stretches` is called where something is not stored. Throws
  /// Error{corrupt} where a trace or motion is damaged, and what Movement::pause throws.
  bool holds(const MovingRow& row, const Stretches& stretches);

  /// Whether what it asks for may be stored as a column: it is about hands.
  bool scannable() const noexcept { return is_scannable(condition_->movement); }
  /// Appends `first` + all rows of a recording for which it holds, and perhaps others (of `hand`: what either hand
  /// does). False, and nothing, where something that it asks for is not stored.
  bool scan(std::uint32_t recording, RowId first, std::vector<RowId>& rows);

 private:
  struct Way {
    Point point;
    std::optional<Point> other;
    bool own = false;          ///< `point` is there for `hand`: of a row of one hand it must be that
    bool other_own = false;    ///< the same of `other`
    ColumnValues column = {};  ///< of `recording_`; empty: from frames
  };
  /// How the number of a row answers.
  enum class Reading : std::uint8_t {
    within,   ///< by the bounds
    outside,  ///< by lying outside the bounds
    set,      ///< by a bit that it has of the mask
    state,    ///< by what the state number says
  };
  /// Both included; no number lies within where low is above high, and what is no number nowhere.
  struct Bounds {
    float low, high;
    bool hold(float value) const noexcept { return low <= value && value <= high; }
  };

  void load(std::uint32_t recording);
  float series_of(const MovingRow& row, const Stretches& stretches);
  static Reading reading_of(const Condition& condition, HandMeasure measure) noexcept;
  void append_fitting(std::span<const float> column, RowId first, std::vector<RowId>& rows) const;
  bool fits(float value) const;
  Bounds bounds_of_amount(std::uint32_t recording) const;
  Bounds bounds_of_zone(std::uint32_t recording) const;
  float from_frames(const Way& way, std::uint32_t recording, std::span<const TimeSpan> stretches) const;
  void track(const Point& point, std::uint32_t recording, const HandTrace& trace, FrameRange frames,
             PointTrack& out) const;

  const Movement* movement_;
  const Condition* condition_;
  std::vector<Way> ways_;                   ///< one of them has to hold
  std::optional<std::uint32_t> recording_;  ///< of which columns and bounds are at hand
  HandMeasure measure_ = HandMeasure::speed;
  Reading reading_ = Reading::within;
  std::uint32_t mask_ = 0;   ///< where it is a set
  Bounds bounds_{};          ///< of `recording_`
  bool scaled_ = false;      ///< the value's unit is not the column's: it depends on the signer's shoulders
  std::vector<float> told_;  ///< [row of `recording_`] of a track or the gaze; infinite: not looked at yet
};

}  // namespace signweave
