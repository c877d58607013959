#include "signweave/choose/channel_clips.h"

#include <fmt/format.h>

#include "signweave/core/text.h"

namespace signweave {

std::string quoted_name(const MotionClip& clip) {
  if (clip.at_rest) return "a rest";
  if (clip.signs.empty()) return fmt::format("a piece of '{}'", printable(clip.recording));
  return fmt::format("'{}'", printable(clip.signs.front().gloss));
}

}  // namespace signweave
