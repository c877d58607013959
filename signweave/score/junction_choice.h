#pragma once

#include <cstddef>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "signweave/core/time.h"
#include "signweave/score/transition.h"

namespace signweave {

/// Options for the transition of one junction. Unset members use the options for all junctions.
struct JunctionChoice {
  const TransitionMethod* method = nullptr;  ///< null: the method for all
  std::optional<Milliseconds> duration;      ///< at tempo 1, without a pause; none: timed like the others
  /// Factor by which the transition is shortened; its pause and the strokes on both sides are not. The kept parts of
  /// retraction and preparation play at the speed of their stroke, so that the speed does not change where they meet.
  std::optional<double> tempo;

  bool empty() const noexcept { return method == nullptr && !duration && !tempo; }
  friend bool operator==(const JunctionChoice&, const JunctionChoice&) = default;
};

/// By junction number: 1 is the junction between the first and second place of an utterance or part of an edit, whether
/// or not their recorded transition would be kept.
using JunctionChoices = std::map<std::size_t, JunctionChoice>;

struct NumberedJunction {
  std::size_t number = 0;
  JunctionChoice choice;
};

/// Inclusive limits.
inline constexpr Milliseconds kLongestTransition{60'000};
inline constexpr double kSlowestTempo = 0.25;
inline constexpr double kFastestTempo = 4.0;

/// `N=PART[,PART…]`, each part once: a method's name, a duration `450ms`, a tempo `x1.5`. Throws Error{bad_input}, with
/// near matches for an unknown method.
NumberedJunction parse_junction(std::string_view text);
/// Parses several. Throws Error{bad_input}, also if a junction is named twice.
JunctionChoices parse_junctions(std::span<const std::string> texts);
/// "hermite,450ms,x1.5"; empty if nothing was chosen.
std::string to_string(const JunctionChoice& choice);

}  // namespace signweave
