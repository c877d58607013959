#pragma once

#include <optional>

#include "signweave/transition/body_scene.h"
#include "signweave/transition/wrist_limits.h"

namespace signweave {

/// Keeps one wrist within human limits, frame by frame, such that smooth motion stays smooth (see WristLimits). A bend
/// within the range of the gap's borders is left as it is.
class WristGuard {
 public:
  /// Sets the limits for one gap, widened by its borders. A hand without fingers has no limits.
  void begin(BodyScene& scene, Side side);
  /// Turns the hand of one generated frame back. Returns true if it was bent too far.
  bool limit(const BodyScene& scene, std::int64_t frame) const;
  /// The same for every frame of a gap; frames between two that are far from every limit are not examined.
  bool limit_all(const BodyScene& scene, const Gap& gap) const;

 private:
  WristBend bend_at(const BodyScene& scene, std::int64_t frame) const;

  Side side_ = Side::left;
  JointIndex wrist_ = kNoJoint;
  std::optional<WristLimits> limits_;
  HandAxes axes_{};  ///< in the space of the wrist joint
};

}  // namespace signweave
