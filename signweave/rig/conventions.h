#pragma once

#include <span>
#include <string_view>

#include "signweave/rig/part.h"

/// Names that common rigs give their joints: facts, as data. Case and the separators `_ - . ` and blank do not matter.
namespace signweave {

/// The names of a part, separated by blanks, the best first. `@` stands for the side; a left part stands for both.
struct NameRow {
  Part part;
  std::string_view names;
};

/// How the joints of fingers are called: `@` stands for the side, `%` for the finger, `#` for the point.
struct FingerNames {
  std::string_view pattern;
  std::string_view fingers;  ///< five words, thumb to little finger; `-` where there is none
  std::string_view points;   ///< five words, metacarpal to tip; `-` where there is none
};

struct Convention {
  std::string_view name;
  std::string_view left;   ///< words that stand for `@`, separated by blanks
  std::string_view right;  ///< in the order of `left`
  std::span<const NameRow> rows;
  std::span<const FingerNames> fingers;
  std::string_view marks =
      {};  ///< what one of the joints' whole names must contain, one of these words; empty: nothing
};

/// Every convention known, the more general before those that only add to it.
std::span<const Convention> conventions() noexcept;

}  // namespace signweave
