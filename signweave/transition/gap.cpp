#include "signweave/transition/gap.h"

#include <cmath>

namespace signweave {

std::int64_t context_frames(FrameRate rate) noexcept {
  return static_cast<std::int64_t>(std::ceil(kContext.count() * rate.hertz() - 1e-6)) + 1;
}

PosesView view_of(const Motion& motion, FrameRange frames) noexcept {
  const auto part = [&](auto all, std::size_t each) {
    return all.subspan(static_cast<std::size_t>(frames.begin) * each, static_cast<std::size_t>(frames.size()) * each);
  };
  return {part(motion.rotations(), motion.skeleton().joint_count()),
          part(motion.translations(), motion.skeleton().translation_count()), frames.size()};
}

}  // namespace signweave
