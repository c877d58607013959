#pragma once

#include <Eigen/Geometry>

#include "signweave/features/hand_points.h"

namespace signweave {

/// The bend of a wrist: the rotation from the forearm's direction to the hand's, in the hand's axes. Radians.
struct WristBend {
  float flexion = 0;    ///< towards the palm; negative: extension
  float deviation = 0;  ///< towards the thumb (radial); negative: towards the little finger (ulnar)
};
/// `forearm` is the unit direction from elbow to wrist, in the space of the axes. Twist does not count as bend.
WristBend wrist_bend(const Eigen::Vector3f& forearm, const HandAxes& hand) noexcept;

/// Limit of one direction of bend: unchanged up to `freely`, then a diminishing share of the excess, never reaching
/// `most`.
struct BendLimit {
  float freely = 0;  ///< radians
  float most = 0;    ///< radians, above `freely`
};

/// Limits of wrists: free up to the mean range of men (Boone and Azen 1979: 76°, 75°, 22°, 36°; the norms of the AAOS
/// are 80°, 70°, 20°, 30°), and never more than 13° beyond, to the sides 8° (ours).
struct WristLimits {
  BendLimit flexion;
  BendLimit extension;
  BendLimit radial;
  BendLimit ulnar;
};
WristLimits human_wrist() noexcept;

/// Limits for a gap next to a captured border: if the border is bent farther, its bend and a little more is free.
WristLimits widened(WristLimits limits, const WristBend& border) noexcept;

/// The bend reduced to its limits; the reduction starts with zero slope at `freely`, so smooth motion stays smooth.
WristBend limited(const WristBend& bend, const WristLimits& limits) noexcept;

/// Computes the rotation of the hand, in the space of its axes and applied first (hand · turn), that brings the bend
/// for `forearm` within the limits. Returns false if no rotation is needed.
bool turn_within(const WristLimits& limits, const Eigen::Vector3f& forearm, const HandAxes& hand,
                 Eigen::Quaternionf& turn) noexcept;

}  // namespace signweave
