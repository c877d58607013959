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
  Distribution sign;    ///< milliseconds, whole signs: its count is that of the tokens
  Distribution stroke;  ///< milliseconds, from first stroke to last; of signs with annotated phases alone
};

/// By how often they occur, then by name. Glosses are compared in match form.
std::vector<GlossStats> glosses_of(std::span<const Sign> signs);

/// Glosses that follow each other.
struct NgramStats {
  std::vector<std::string> glosses;  ///< as first written
  std::size_t count = 0;
  /// Milliseconds from the end of one member's last stroke to the begin of the next one's first, over all neighbours of
  /// all occurrences.
  Distribution interval;
};

/// Every run of `length` (at least 2) signs that follow each other on one tier of one recording, by how often it
/// occurs, then by name. `recordings` is [recording][sign]. Signs follow each other where at most kMeeting (kRest where
/// a sign has no annotated phases) lies between them.
std::vector<NgramStats> ngrams_of(std::span<const std::vector<Sign>> recordings, std::size_t length);

}  // namespace signweave
