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

/// How the transition of one junction is made, where that is told for it alone. What is not told is as for all.
struct JunctionChoice {
  const TransitionMethod* method = nullptr;  ///< null: that of all
  std::optional<Milliseconds> duration;      ///< at tempo 1, without a pause; none: as all are timed
  /// The transition lasts so many times shorter than it would; its pause and the strokes on both sides do not. What is
  /// kept of retraction and preparation goes on as fast as its stroke, so that nothing changes pace where they meet.
  std::optional<double> tempo;

  bool empty() const noexcept { return method == nullptr && !duration && !tempo; }
  friend bool operator==(const JunctionChoice&, const JunctionChoice&) = default;
};

/// By the number of the junction: 1 is where the first place of an utterance, or the first part of an edit, meets the
/// second, whether or not their transition would be kept as it was recorded.
using JunctionChoices = std::map<std::size_t, JunctionChoice>;

struct NumberedJunction {
  std::size_t number = 0;
  JunctionChoice choice;
};

/// Both ends belong to it.
inline constexpr Milliseconds kLongestTransition{60'000};
inline constexpr double kSlowestTempo = 0.25;
inline constexpr double kFastestTempo = 4.0;

/// `N=PART[,PART…]`, each part once: a method's name, a duration `450ms`, a tempo `x1.5`. Throws Error{bad_input}, with
/// near matches for a method that there is not.
NumberedJunction parse_junction(std::string_view text);
/// Several of them. Throws Error{bad_input}, also where one is named twice.
JunctionChoices parse_junctions(std::span<const std::string> texts);
/// "hermite,450ms,x1.5"; empty where nothing was chosen.
std::string to_string(const JunctionChoice& choice);

}  // namespace signweave
