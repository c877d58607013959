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
    std::size_t count = 0;  ///< number of points that the rig has; 0: no such finger
  };
  Eigen::Vector3f wrist;
  std::array<OneFinger, kFingers.size()> fingers;  ///< [Finger]

  const OneFinger& finger(Finger which) const noexcept { return fingers[static_cast<std::size_t>(which)]; }
};

/// The points of a rig that form one hand.
class HandPlaces {
 public:
  HandPlaces(const RigMap& rig, Side side);

  bool has_wrist() const noexcept { return wrist_.known(); }
  /// Empty, or the reason why there are no directions and no handshape: neither two fingers besides the thumb nor one
  /// finger and the thumb.
  const std::string& why_no_fingers() const noexcept { return why_no_fingers_; }
  /// Writes the points' positions in `pose` to `out`. Precondition: has_wrist().
  void read(const ModelPose& pose, HandPoints& out) const noexcept;
  /// Adds the joints that `read` uses.
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

/// The hand's own axes, model space, unit vectors; zero if all points lie on one line.
struct HandAxes {
  Eigen::Vector3f fingers;  ///< wrist to middle knuckle
  Eigen::Vector3f palm;     ///< out of the palm
  Eigen::Vector3f thumb;    ///< in the palm's plane, perpendicular to `fingers`, to the thumb's side
};
HandAxes axes_of(const HandPoints& hand, Side side) noexcept;

/// Returns the midpoint of wrist and middle knuckle (the mean of the knuckles if there is no middle finger); the wrist
/// if there is no finger besides the thumb.
Eigen::Vector3f palm_of(const HandPoints& hand) noexcept;

/// Returns the handshape of a hand with fingers. A finger that the rig lacks copies its nearest neighbour, the
/// thumb-side one first.
Handshape handshape_of(const HandPoints& hand, const HandAxes& axes) noexcept;
/// Returns 1 minus the mean flexion of the fingers besides the thumb, in which the knuckle counts one third.
float openness_of(const Handshape& shape) noexcept;

}  // namespace signweave
