#pragma once

#include <cstdint>
#include <string>

#include "signweave/motion/blend.h"
#include "signweave/render/junction.h"

namespace signweave {

/// How clips from other recordings are brought to where the signer of the reference clip stands.
enum class Alignment {
  automatic,  ///< `ground` for clips of other recordings than the reference, none for its own
  ground,     ///< every clip: shift on the ground and turn about the vertical
  none,       ///< all sources come from one session
};

/// True where a clip of that recording is brought to where the signer of the reference's stands.
bool is_aligned(Alignment alignment, const std::string& recording, const std::string& reference) noexcept;

/// Where a signer stands in a clip is measured over no more of its frames.
inline constexpr std::int64_t kStandingFrames = 16'384;

/// Where the signer stands over the core of a clip, wherever it is placed. Reads the core's frames, at most
/// kStandingFrames, into `memory`. Throws Error{corrupt}.
Standing standing_of(const PlacedClip& placed, const JunctionSettings& settings, Motion& memory);

}  // namespace signweave
