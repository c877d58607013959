#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "signweave/core/error.h"
#include "signweave/core/time.h"
#include "signweave/features/hand_trace.h"
#include "signweave/rig/part.h"

namespace signweave {

/// How far the palms move in one stroke, relative to the signer, metres.
struct StrokePaths {
  float left = 0;
  float right = 0;
};

/// Numbers of signs that are annotated for one hand (Sign::hand).
struct HandCounts {
  std::size_t left = 0;
  std::size_t right = 0;
};

/// The dominant hand of a signer: the one that signs one-handed signs.
struct Dominance {
  std::optional<Side> hand;  ///< none: unknown
  float score = 0;           ///< in [-1, 1]: 1 if everything is signed with the right hand, -1 with the left
  std::size_t strokes = 0;   ///< number of strokes that the score is based on
};
/// Returns "left", "right" or "unknown".
std::string_view name_of(const Dominance& dominance) noexcept;

/// From this score on, a hand counts as dominant. (ours)
inline constexpr float kDominant = 0.25f;

/// Returns the dominant hand, from the share of each palm in the path of the one-handed strokes: those in which one
/// palm moves at least 5 cm and 2.5 times as far as the other. Without any, from the paths of all strokes. Signs
/// annotated for one hand, at least ten, have the same weight. Non-finite paths are skipped.
Dominance dominance_of(std::span<const StrokePaths> strokes, const HandCounts& annotated = {});

/// The hand that moves alone in a stroke, or in several together: its palm at least 5 cm and 2.5 times as far as the
/// other; none if both move, or neither.
std::optional<Side> only_hand(const StrokePaths& paths) noexcept;

/// The notice that a recording's signer, whose dominant hand is unknown, counts as right-handed.
Notice notice_unknown_hand(std::string recording, const Dominance& found);

/// Returns the paths in some strokes, frames of the traced motion; clamped to it. Without strokes: in each half second
/// of the motion. Empty if a palm is not traced.
std::vector<StrokePaths> paths_in(const HandTrace& trace, std::span<const FrameRange> strokes = {});

}  // namespace signweave
