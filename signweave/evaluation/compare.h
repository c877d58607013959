#pragma once

#include <vector>

#include "signweave/evaluation/evaluation.h"
#include "signweave/evaluation/measure.h"
#include "signweave/evaluation/spans.h"
#include "signweave/evaluation/wrist_kinematics.h"
#include "signweave/transition/gap.h"

namespace signweave {

/// Compares made frames of a recording's span with the captured ones. For one recording.
class Comparison {
 public:
  /// The recording must outlive it.
  explicit Comparison(const EvaluatedMotion& recording);

  /// `made` stands where the span's frames were, and may be fewer or more of them: then both times are taken as going
  /// from 0 to 1. What is measured of time and speed alone is left to others: duration, changed frames, microseconds.
  SpanScores compare(const EvaluatedSpan& span, PosesView made);

 private:
  void lay_out(FrameRange frames, const std::vector<Eigen::Vector3f>& captured,
               std::span<const Eigen::Vector3f> between);
  void compare_hand(const EvaluatedSpan& span, PosesView made, Side side, std::array<Measurement, kMeasures>& out);
  void compare_angles(const EvaluatedSpan& span, PosesView made, JointGroup group, Measurement& out) const;
  std::int64_t margin_before(FrameRange frames) const noexcept;
  double duration_of_gap(std::int64_t count) const noexcept;

  const EvaluatedMotion& recording_;
  HandTracker tracker_;
  WristMeter meter_;
  std::int64_t margin_;
  std::array<bool, kJointGroups> moves_{};  ///< whether any joint of the group ever turns
  HandTracks tracks_;                       ///< of the made frames
  std::vector<Eigen::Vector3f> path_;       ///< a wrist's, with captured frames on both sides
  std::array<WristKinematics, 2> captured_;
  std::array<WristKinematics, 2> made_;
};

/// As many captured frames on both sides count for smoothness, so that a seam does. (ours)
inline constexpr Seconds kMargin{0.1};
}  // namespace signweave
