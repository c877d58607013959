#pragma once

#include <cstdint>
#include <string>

#include "signweave/motion/blend.h"
#include "signweave/render/junction.h"

namespace signweave {

/// How stretches from other recordings are brought to where the signer of the reference stretch stands.
enum class Alignment {
  automatic,  ///< `ground` for stretches of other recordings than the reference, none for its own
  ground,     ///< every stretch: shift on the ground and turn about the vertical
  none,       ///< all sources come from one session
};

/// True where a stretch of that recording is brought to where the signer of the reference's stands.
bool is_aligned(Alignment alignment, const std::string& recording, const std::string& reference) noexcept;

/// Where a signer stands in a stretch is measured over no more of its frames.
inline constexpr std::int64_t kStandingFrames = 16'384;

/// Where the signer stands over the core of a stretch, wherever it is laid. Reads the core's frames, at most
/// kStandingFrames, into `memory`. Throws Error{corrupt}.
Standing standing_of(const Laid& laid, const JunctionSettings& settings, Motion& memory);

}  // namespace signweave
