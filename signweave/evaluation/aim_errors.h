#pragma once

#include "signweave/inflection/aim.h"
#include "signweave/inflection/phase_points.h"

namespace signweave {

/// How a made stroke differs from a captured one, in the hand that moves farther in the capture.
struct AimErrors {
  double end_mm = 0;        ///< between the palms at the stroke's end
  double path_mm = 0;       ///< the same over the stroke, root mean square
  double aim_degrees = 0;   ///< see aim_errors
  double turn_degrees = 0;  ///< between the orientations of the hands, mean over the stroke
  /// Between the paths after the best shift, turn and scale (Procrustes; Umeyama 1991), root mean square.
  double shape_mm = 0;
};

/// A stroke as it is compared.
struct ComparedStroke {
  const PhasePoints& points;
  HandInSpace last;  ///< of the compared hand
};

/// The error of aim is that between the directions from begin to end of the movement; if the captured palm moves less
/// than kNoMovementOfAim, between those from between the shoulders to the palm. Of a pointing sign it is the angle in
/// the made stroke between its index finger and the direction to `pointed_at`. `unit`: metres of a shoulder width.
AimErrors aim_errors(const ComparedStroke& made, const ComparedStroke& captured, Side side,
                     const std::optional<Locus>& pointed_at, float unit);
inline constexpr float kNoMovementOfAim = 0.05f;  ///< metres

}  // namespace signweave
