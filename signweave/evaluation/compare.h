#pragma once

#include <vector>

#include "signweave/evaluation/evaluation.h"
#include "signweave/evaluation/measure.h"
#include "signweave/evaluation/spans.h"
#include "signweave/evaluation/wrist_kinematics.h"
#include "signweave/transition/gap.h"

namespace signweave {

/// Compares generated frames of a recording's spans with the captured ones.
class Comparison {
 public:
  /// The recording must outlive it.
  explicit Comparison(const EvaluatedMotion& recording);

  /// `made` replaces the span's frames and may have another number of frames; then both are compared on a time scale
  /// from 0 to 1. Does not fill duration, changed frames and microseconds.
  SpanScores compare(const EvaluatedSpan& span, PosesView made);

 private:
  void fill_path(FrameRange frames, const std::vector<Eigen::Vector3f>& captured,
                 std::span<const Eigen::Vector3f> between);
  void compare_hand(const EvaluatedSpan& span, PosesView made, Side side, std::array<Measurement, kMeasures>& out);
  void compare_angles(const EvaluatedSpan& span, PosesView made, JointGroup group, Measurement& out) const;
  std::int64_t margin_before(FrameRange frames) const noexcept;
  double duration_of_gap(std::int64_t count) const noexcept;

  const EvaluatedMotion& recording_;
  HandTracker tracker_;
  WristMeter meter_;
  std::int64_t margin_;
  std::array<bool, kJointGroups> moves_{};  ///< true if any joint of the group ever turns
  HandTracks tracks_;                       ///< of the generated frames
  std::vector<Eigen::Vector3f> path_;       ///< a wrist's, with captured frames on both sides
  std::array<WristKinematics, 2> captured_;
  std::array<WristKinematics, 2> made_;
};

/// Captured time on both sides included in smoothness measures, so that seams count. (ours)
inline constexpr Seconds kMargin{0.1};
}  // namespace signweave
