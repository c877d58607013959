#include "signweave/transition/gap.h"

namespace signweave {

PosesView view_of(const Motion& motion, FrameRange frames) noexcept {
  const auto part = [&](auto all, std::size_t each) {
    return all.subspan(static_cast<std::size_t>(frames.begin) * each, static_cast<std::size_t>(frames.size()) * each);
  };
  return {part(motion.rotations(), motion.skeleton().joint_count()),
          part(motion.translations(), motion.skeleton().translation_count()), frames.size()};
}

}  // namespace signweave
