#pragma once

#include <string_view>
#include <vector>

#include "signweave/core/error.h"
#include "signweave/nonmanual/curve.h"
#include "signweave/nonmanual/expressions.h"
#include "signweave/nonmanual/mouthing/pronounce.h"
#include "signweave/notation/utterance.h"
#include "signweave/score/score.h"

namespace signweave {

/// How movements of the face, the gaze and the head are made from an utterance.
struct NonManualOptions {
  Expressions expressions = built_in_expressions();
  PronounceOptions pronounce;
  bool blinks = false;  ///< blink at pauses and where expressions and gazes end, and sometimes elsewhere
  bool gaze = false;    ///< look at the addressee before the first sign, at pauses and after the last sign
};

/// The direction of NonManual::what of a gaze: one of named_gazes(), or angles such as "30/10". Throws Error{not_found}
/// for an unknown name, with near matches; Error{bad_input} for angles out of range; Error{unsupported} for a point.
GazeDirection gaze_direction_of(std::string_view what);

/// The curves of an utterance's non-manuals in a score of it, and the gazes and blinks that are planned. Adds what
/// could not be mouthed as written to `notices`. Throws Error{not_found} for an unknown expression or gaze, with near
/// matches; Error{bad_input} for a text that cannot be mouthed.
std::vector<AuthoredCurve> author_non_manuals(const Utterance& utterance, const Score& score,
                                              const NonManualOptions& options, std::vector<Notice>& notices);

/// Throws what author_non_manuals would throw.
void check_non_manuals(const Utterance& utterance, const NonManualOptions& options);

}  // namespace signweave
