#pragma once

#include <optional>
#include <span>
#include <vector>

#include "signweave/inflection/fit_change.h"
#include "signweave/space/change.h"
#include "signweave/space/locus.h"
#include "signweave/space/roles.h"

namespace signweave {

/// The loci between which a sign goes.
struct LociOfSign {
  std::optional<Locus> from, to, at;
};

/// How well a sign was aimed.
struct Aimed {
  FittedChange fitted;
  /// Distance of the palm at the stroke's end from where it should be, metres; of a pointing sign 0.
  float end_missed = 0;
  float begin_missed = 0;
  /// Of a pointing sign: between the index finger and the direction to the locus at the stroke's end, degrees.
  float aim_error = 0;
};

/// Aims one captured stroke at loci by geometry alone: the movement between its begin and its end is turned, scaled and
/// shifted as a whole so that it begins and ends at the wanted loci (a similarity), and the hand turns with it.
/// An end at which the hand touches the body stays there. A sign with the role `aim` points: the arm turns about the
/// shoulder and the index finger at the locus. `captured` are the loci of the captured stroke, as far as they are
/// annotated; unknown ones are guessed from its ends.
///
/// Throws Error{bad_input, "…"}: for a locus behind the signer (kMostAzimuth), and for a sign without role.
Aimed aim_stroke(StrokeChanger& changer, const CapturedStroke& stroke, SpaceRole role, const LociOfSign& wanted,
                 const LociOfSign& captured);

/// Throws Error{bad_input} for a locus behind the signer.
void require_in_front(const std::optional<Locus>& locus);

/// The same movement begins and ends with the palm, or the middle between both that keep to each other, at given
/// places: metres, the axes of the stroke's space.
Aimed aim_between(StrokeChanger& changer, const CapturedStroke& stroke, const Eigen::Vector3f& begin,
                  const Eigen::Vector3f& end);

/// A locus at a larger azimuth than this is behind the signer. Degrees. (ours)
inline constexpr float kMostAzimuth = 110;
/// A hand points at nearer loci as if they were this far away in the same direction from between the shoulders.
/// Shoulder widths. (ours)
inline constexpr float kNearestPointedAt = 2.5f;
/// The limits of the similarity. (design: pitch 30°, scale 0.6 to 1.6)
inline constexpr float kMostPitch = 30;
inline constexpr float kLeastAimScale = 0.6f;
inline constexpr float kMostAimScale = 1.6f;

/// The role that a stroke's ends suggest: from the signer outwards is `forward`, towards the signer `backward`,
/// otherwise `aim` if the index finger alone is stretched, else `none`.
SpaceRole guessed_role(const CapturedStroke& stroke, const StrokeChanger& changer);

}  // namespace signweave
