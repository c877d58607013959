#pragma once

#include <cstddef>
#include <span>
#include <string_view>
#include <vector>

#include "signweave/evaluation/evaluation.h"

namespace signweave {

/// Which recordings are left out together while one of them is judged, so that nothing is learned from what is like it.
struct Folds {
  std::vector<std::size_t> of;  ///< [recording]
  std::size_t count = 0;
  std::string_view by;  ///< "collection", "signer" or "recording"
};

/// By collection where there are several, and then all recordings of one performer too, whatever collections they are
/// in; of one collection by performer where it has several, and those of whom nobody knows the performer go together;
/// else each recording by itself.
Folds folds_of(std::span<const EvaluatedMotion> recordings);

}  // namespace signweave
