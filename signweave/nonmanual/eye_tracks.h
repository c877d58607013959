#pragma once

#include <optional>
#include <span>
#include <string_view>

#include "signweave/nonmanual/curve.h"

/// The scalar tracks that show a gaze; inside this module only.
namespace signweave {

/// The eight eyeLook weights.
std::span<const std::string_view> look_tracks() noexcept;

/// The value of a track when the eyes look in a direction relative to the head: an eyeLook weight from 0 to 1, or an
/// eye's rotation in radians as Live Link Face has it (yaw to the right, pitch down). nullopt for other tracks. Eyes
/// turn as far as weight 1 does.
std::optional<float> eye_track_value(std::string_view track, GazeDirection eyes) noexcept;

}  // namespace signweave
