#pragma once

#include <span>
#include <string_view>

#include "signweave/rig/part.h"

/// Joint names of common rigs, as data. Case, blanks and the separators `_ - .` are ignored.
namespace signweave {

/// The names of a part, separated by blanks, best first. `@` is the side; a row for a left part covers both
/// sides.
struct NameRow {
  Part part;
  std::string_view names;
};

/// The names of finger joints: `@` is the side, `%` the finger, `#` the point.
struct FingerNames {
  std::string_view pattern;
  std::string_view fingers;  ///< five words, thumb to little finger; `-` if there is none
  std::string_view points;   ///< five words, metacarpal to tip; `-` if there is none
};

struct Convention {
  std::string_view name;
  std::string_view left;   ///< words that stand for `@`, separated by blanks
  std::string_view right;  ///< in the same order as `left`
  std::span<const NameRow> rows;
  std::span<const FingerNames> fingers;
  std::string_view marks = {};  ///< words, one of which a whole joint name must contain; empty: no condition
};

/// All known conventions; a general one comes before those that only extend it.
std::span<const Convention> conventions() noexcept;

}  // namespace signweave
