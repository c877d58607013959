#pragma once

#include <string_view>

#include "signweave/nonmanual/curve.h"
#include "signweave/notation/utterance.h"

namespace signweave {

/// The utterance with gazes at loci by their numbers, instead of by the names that were set up for them, and with a
/// gaze at the locus of each sign that is aimed, unless another gaze accompanies it: at the object of a verb, or at
/// what is pointed at (most gazes of agreeing verbs go to the object: Thompson et al. 2006). No gaze goes to the signer
/// or, as it is there anyway, to the addressee. Throws Error{not_found} for a name that is not set up by then.
Utterance with_gazes_at_loci(Utterance utterance);

/// The direction of a gaze by name (find_gaze), or at a locus that is given by numbers. Throws as find_gaze, and
/// Error{bad_input} for a locus behind the signer.
GazeDirection direction_of_gaze(std::string_view what);

/// Where the eyes are, in shoulder widths from between the shoulders: up, and forward. (ours)
inline constexpr float kEyesUp = 0.72f;
inline constexpr float kEyesForward = 0.2f;

}  // namespace signweave
