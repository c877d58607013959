#pragma once

#include <cstddef>
#include <span>
#include <string_view>
#include <vector>

#include "signweave/evaluation/evaluation.h"

namespace signweave {

/// Groups of recordings that are held out together while one of them is evaluated, so that nothing is learned from
/// similar ones.
struct Folds {
  std::vector<std::size_t> of;  ///< [recording]
  std::size_t count = 0;
  std::string_view by;  ///< "collection", "signer" or "recording"
};

/// Folds by collection if there are several; collections that share a performer are then joined. A single collection is
/// divided by performer if it has several; recordings of unknown performers form one fold. Otherwise each recording is
/// a fold.
Folds folds_of(std::span<const EvaluatedMotion> recordings);

}  // namespace signweave
