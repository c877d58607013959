#pragma once

#include <Eigen/Geometry>

#include "signweave/features/hand_points.h"

namespace signweave {

/// How a wrist is bent: the turn from the forearm's direction to the hand's, seen in the hand's own axes. Radians.
struct WristBend {
  float flexion = 0;    ///< to the palm; below 0 extension
  float deviation = 0;  ///< to the thumb's side (radial); below 0 to the little finger's (ulnar)
};
/// `forearm` is the unit direction from elbow to wrist, in the space of the axes. Twist does not bend.
WristBend wrist_bend(const Eigen::Vector3f& forearm, const HandAxes& hand) noexcept;

/// One way in which a wrist bends: as it is up to `freely`, then ever less of what more is asked for, never `most`.
struct BendLimit {
  float freely = 0;  ///< radians
  float most = 0;    ///< radians, above `freely`
};

/// How far wrists bend: freely as far as those of men do in the mean (Boone and Azen 1979: 76°, 75°, 22°, 36°; the
/// norms of the AAOS are 80°, 70°, 20°, 30°), and never more than 13°, to the sides 8°, farther (ours).
struct WristLimits {
  BendLimit flexion;
  BendLimit extension;
  BendLimit radial;
  BendLimit ulnar;
};
WristLimits human_wrist() noexcept;

/// The same limits for a gap between captured borders: where one is bent farther, that is free, and a little more.
WristLimits widened(WristLimits limits, const WristBend& border) noexcept;

/// The bend as far as it is allowed; level with the one given where that leaves `freely`, so what is smooth stays so.
WristBend limited(const WristBend& bend, const WristLimits& limits) noexcept;

/// The turn of the hand, in the space of its axes and before its own rotation (hand · turn), that takes it from the
/// bend that `forearm` has to one within the limits; none where nothing is to be turned: false.
bool turn_within(const WristLimits& limits, const Eigen::Vector3f& forearm, const HandAxes& hand,
                 Eigen::Quaternionf& turn) noexcept;

}  // namespace signweave
