#pragma once

#include <functional>
#include <optional>
#include <string>

#include "signweave/inflection/captured_stroke.h"

namespace signweave {

/// A change that a signer can make: no wrist beyond its limits, no hand deeper in the body or in the other hand than
/// captured and kDepthOfHandAllowed, every hand within reach.
struct FittedChange {
  StrokeChange change;
  float share = 1;     ///< of what was asked for that is reached; 1: all
  float relief = 0;    ///< as given to MakeChange
  float moved_mm = 0;  ///< the largest displacement of a palm over the stroke
  float turned_degrees = 0;
  /// Why not all is reached: "the right hand would be 12 cm beyond its reach"; empty if share is 1.
  std::string why;
};

/// The change for a share, from 0 (as captured) to 1 (all), of what is asked for, and for a relief of the arm, from 0
/// (none) to 1: for a movement, how much the hands turn with the arm instead of with the movement; for a pointing hand,
/// how much less it leaves its place. The palms are shifted by `pushed`, metres, besides. It must depend continuously
/// on all, and share 0 must be feasible.
using MakeChange = std::function<StrokeChange(float share, float relief, const Eigen::Vector3f& pushed)>;

/// Finds the change nearest to what is asked for. The trunk turns towards the target by up to kTrunkShare where that
/// brings it within reach; then the elbow swivels; a hand that would enter the body is moved out of it by up to
/// kMostPushed; the arm is relieved; at last less of the whole is done. `towards` is the direction of
/// the trunk's turn, positive: to the signer's left; 0: it does not turn. (ours)
FittedChange fit_change(StrokeChanger& changer, const CapturedStroke& stroke, const MakeChange& make, float towards);

inline constexpr float kTrunkShare = 15;     ///< degrees
inline constexpr float kMostPushed = 0.06f;  ///< metres

}  // namespace signweave
