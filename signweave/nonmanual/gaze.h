#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "signweave/nonmanual/curve.h"

/// Authored gaze at directions in the signer's space.
namespace signweave {

/// A jump of the eyes takes 30 to 50 ms.
inline constexpr Milliseconds kSaccade{40};
/// The head follows by this share of the angle, this much later.
inline constexpr float kHeadShare = 0.3f;
inline constexpr Milliseconds kHeadDelay{150};
/// After the stroke that a gaze accompanies, the eyes stay on their target this long.
inline constexpr Milliseconds kGazeStays{100};

/// A name for a direction.
struct NamedGaze {
  std::string_view name;
  GazeDirection direction;
};
/// All names: left, right, up, down, front, addressee, and the codes of SiGML that are directions (AD, FR, UP, DN, LE,
/// RI, LU, LD, RU, RD).
std::span<const NamedGaze> named_gazes() noexcept;

/// The direction of a name. Throws Error{not_found, "there is no gaze 'lft'; did you mean left?"}.
GazeDirection find_gaze(std::string_view name);

/// A gaze at a direction: eyes, and the head's share.
Curve gaze_at(GazeDirection direction, std::string name);

/// When a gaze accompanies signs: from the begin of the first preparation (or stroke, if it has none) to
/// kGazeStays after the last stroke.
TimeSpan gaze_span(Milliseconds first_preparation, Milliseconds last_stroke_end) noexcept;

/// A glance at the addressee is at least this long.
inline constexpr Milliseconds kShortestGlance{200};
/// When a signer looks at the addressee at the boundaries of what is signed: before, between and after `units`, each
/// from its first preparation to its last stroke's end, in order of time. Later units change nothing before them.
std::vector<TimeSpan> plan_gaze(TimeSpan whole, std::span<const TimeSpan> units);

}  // namespace signweave
