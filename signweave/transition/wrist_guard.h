#pragma once

#include <optional>

#include "signweave/transition/body_scene.h"
#include "signweave/transition/wrist_limits.h"

namespace signweave {

/// Keeps one wrist within what people's wrists do, each frame by itself and so that what is smooth stays smooth (see
/// WristLimits). A bend that both borders of a gap allow is left as it is.
class WristGuard {
 public:
  /// The limits of one gap, as its borders widen them. A hand without fingers has none: nothing is limited.
  void begin(BodyScene& scene, Side side);
  /// Turns the hand of one made frame back; returns whether it was bent too far.
  bool limit(const BodyScene& scene, std::int64_t frame) const;
  /// The same for every frame of a gap; those between two frames that are far from every limit are not examined.
  bool limit_all(const BodyScene& scene, const Gap& gap) const;

 private:
  WristBend bend_at(const BodyScene& scene, std::int64_t frame) const;

  Side side_ = Side::left;
  JointIndex wrist_ = kNoJoint;
  std::optional<WristLimits> limits_;
  HandAxes axes_{};  ///< in the space of the wrist's joint
};

}  // namespace signweave
