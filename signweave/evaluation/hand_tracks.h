#pragma once

#include <Eigen/Core>
#include <array>
#include <optional>
#include <vector>

#include "signweave/core/time.h"
#include "signweave/features/contact.h"
#include "signweave/features/hand_motion.h"
#include "signweave/features/hand_points.h"
#include "signweave/motion/kinematics.h"
#include "signweave/transition/gap.h"

namespace signweave {

/// One hand over some frames. Metres.
struct HandTrack {
  std::vector<Eigen::Vector3f> wrist;  ///< [frame] model space; empty: no such wrist
  std::vector<Eigen::Vector3f> seen;   ///< [frame] the wrist in signer-centred space; empty: no such space
  std::array<std::vector<Eigen::Vector3f>, kFingers.size()>
      tips;                  ///< [Finger][frame] in the wrist's space; may be empty
  std::vector<float> depth;  ///< [frame] depth inside head or trunk, at least 0; empty: the body's size is unknown
};
/// Both hands, [Side].
using HandTracks = std::array<HandTrack, 2>;

/// Measures the hands of a rig. Reusable, so that a loop over gaps does not allocate.
class HandTracker {
 public:
  HandTracker(const Skeleton& skeleton, const SignerModel& signer);

  bool has_wrist(Side side) const noexcept { return places_[static_cast<std::size_t>(side)].has_wrist(); }
  /// Measures poses; `out` is cleared first.
  void track(PosesView poses, HandTracks& out);

 private:
  const SignerModel* signer_;
  std::array<HandPlaces, 2> places_;
  JointChains chains_;
  ModelPose pose_;
  HandPoints points_;
};

}  // namespace signweave
