#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "signweave/annotation/sign.h"
#include "signweave/features/distribution.h"

namespace signweave {

/// The tokens of one gloss.
struct GlossStats {
  std::string gloss;    ///< as first written
  Distribution sign;    ///< milliseconds, whole signs: its count is the number of tokens
  Distribution stroke;  ///< milliseconds, from first stroke to last; only of signs with annotated phases
};

/// Returns the glosses by descending frequency, then by name. Glosses are compared in match form.
std::vector<GlossStats> glosses_of(std::span<const Sign> signs);

/// A sequence of consecutive glosses.
struct NgramStats {
  std::vector<std::string> glosses;  ///< as first written
  std::size_t count = 0;
  /// Milliseconds from the end of one member's last stroke to the begin of the next one's first, over all adjacent
  /// pairs of all occurrences.
  Distribution interval;
};

/// Returns every sequence of `length` (at least 2) consecutive signs on one tier of one recording, by descending
/// frequency, then by name. `recordings` is [recording][sign]. Signs are consecutive if at most kMeeting (kRest if a
/// sign has no annotated phases) lies between them.
std::vector<NgramStats> ngrams_of(std::span<const std::vector<Sign>> recordings, std::size_t length);

}  // namespace signweave
