#pragma once

#include <string>
#include <utility>

#include "signweave/annotation/sign.h"
#include "signweave/core/time.h"

/// For tests: signs with one phase of each kind.
namespace signweave {

/// Returns a sign with preparation from `begin` to `stroke`, stroke to `after`, retraction to `end`.
inline Sign sign_of_three(std::string gloss, Milliseconds begin, Milliseconds stroke, Milliseconds after,
                          Milliseconds end) {
  return {.gloss = std::move(gloss),
          .span = {begin, end},
          .phases = {{PhaseKind::preparation, {begin, stroke}, "P", "p"},
                     {PhaseKind::stroke, {stroke, after}, "S", "s"},
                     {PhaseKind::retraction, {after, end}, "R", "r"}},
          .tier = "Gloss"};
}

}  // namespace signweave
