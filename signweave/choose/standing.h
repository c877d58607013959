#pragma once

#include <cstdint>
#include <string>

#include "signweave/motion/blend.h"
#include "signweave/render/junction.h"

namespace signweave {

/// How clips are moved to where the signer of the reference clip stands.
enum class Alignment {
  automatic,  ///< `ground` for clips of other recordings than the reference's, `none` for its own
  ground,     ///< every clip: translation on the ground and rotation about the vertical
  none,       ///< no clip; for sources from one session
};

/// True if clips of `recording` are moved to where the signer of `reference` stands.
bool is_aligned(Alignment alignment, const std::string& recording, const std::string& reference) noexcept;

/// Maximum number of a clip's frames over which its signer's standing is measured.
inline constexpr std::int64_t kStandingFrames = 16'384;

/// The standing of the signer over the core of a clip, independent of its position. Reads the core's frames, at most
/// kStandingFrames, into `memory`. Throws Error{corrupt}.
Standing standing_of(const PlacedClip& placed, const JunctionSettings& settings, Motion& memory);

}  // namespace signweave
