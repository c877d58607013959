#pragma once

#include <Eigen/Core>

#include "signweave/inflection/captured_stroke.h"

/// Internal to this module.
namespace signweave {

/// The sphere in which the palm of an arm stays, in the axes of a stroke's space.
struct PalmReach {
  Eigen::Vector3f shoulder = Eigen::Vector3f::Zero();
  float most = 0;  ///< metres

  /// The place itself, or one in the same direction that is nearer to the signer, as far as the arm needs it.
  Eigen::Vector3f within(const Eigen::Vector3f& place) const noexcept;
};

/// An arm that is nearly stretched, or as far as it was captured.
PalmReach reach_of(const StrokeChanger& changer, const CapturedStroke& stroke, Side side);

}  // namespace signweave
