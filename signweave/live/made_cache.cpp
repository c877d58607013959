#include "signweave/live/made_cache.h"

namespace signweave {

std::size_t bytes_in(const Motion& frames) noexcept {
  return frames.rotations().size_bytes() + frames.translations().size_bytes() +
         static_cast<std::size_t>(frames.frame_count()) * frames.tracks().size() * sizeof(float);
}

}  // namespace signweave
