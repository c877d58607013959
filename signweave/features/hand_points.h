#pragma once

#include <Eigen/Core>
#include <array>
#include <span>
#include <string>
#include <vector>

#include "signweave/features/hand_motion.h"
#include "signweave/rig/rig_map.h"

namespace signweave {

/// The points of one hand in one pose, metres, model space.
struct HandPoints {
  struct OneFinger {
    std::array<Eigen::Vector3f, kFingerPoints>
        points;             ///< from the knuckle (the thumb: from near the wrist) to the tip
    std::size_t count = 0;  ///< how many of them the rig has; 0: no such finger
  };
  Eigen::Vector3f wrist;
  std::array<OneFinger, kFingers.size()> fingers;  ///< [Finger]

  const OneFinger& finger(Finger which) const noexcept { return fingers[static_cast<std::size_t>(which)]; }
};

/// Which points of a rig make a hand.
class HandPlaces {
 public:
  HandPlaces(const RigMap& rig, Side side);

  bool has_wrist() const noexcept { return wrist_.known(); }
  /// Empty, or why there are no directions and no handshape: fewer than two fingers beside the thumb, or one and the
  /// thumb.
  const std::string& why_no_fingers() const noexcept { return why_no_fingers_; }
  /// Where they are. There must be a wrist.
  void read(const ModelPose& pose, HandPoints& out) const noexcept;
  /// Adds the joints that `read` looks at.
  void add_joints(std::vector<JointIndex>& joints) const;

 private:
  struct OneFinger {
    std::array<PartPlace, kFingerPoints> places;
    std::size_t count = 0;
  };
  PartPlace wrist_;
  std::array<OneFinger, kFingers.size()> fingers_;
  std::string why_no_fingers_;
};

/// The hand's own axes, model space, unit; those of a hand with fingers that lies in one line are zero.
struct HandAxes {
  Eigen::Vector3f fingers;  ///< wrist to middle knuckle
  Eigen::Vector3f palm;     ///< out of the palm
  Eigen::Vector3f thumb;    ///< in the palm's plane, across `fingers`, to the thumb's side
};
HandAxes axes_of(const HandPoints& hand, Side side) noexcept;

/// Between wrist and middle knuckle (the mean of the knuckles where there is no middle finger); the wrist where there
/// is no finger beside the thumb.
Eigen::Vector3f palm_of(const HandPoints& hand) noexcept;

/// Of a hand with fingers. A finger that the rig lacks does what its nearest neighbour does, the thumb-side one first.
Handshape handshape_of(const HandPoints& hand, const HandAxes& axes) noexcept;
/// 1 less the mean bend of the fingers beside the thumb, one third of which is the knuckle's.
float openness_of(const Handshape& shape) noexcept;

}  // namespace signweave
