#pragma once

#include <functional>
#include <vector>

#include "signweave/core/error.h"
#include "signweave/formats/fbx/keys.h"
#include "signweave/formats/fbx/scene.h"
#include "signweave/formats/fbx/time.h"
#include "signweave/motion/motion.h"

/// A take as a motion.
namespace signweave::fbx {

/// The inputs of motion_of, borrowed.
struct Ingredients {
  const Source& source;
  const Scene& scene;
  const Take& take;  ///< of these bones only
  const std::vector<std::size_t>& bones;
  const Curves& curves;
  const Frames& frames;
  double unit = 0.01;  ///< metres
  const std::function<void(double)>& progress;
};

/// Poses and tracks of every frame. Throws Error{bad_input} if a scale stretches or mirrors the nodes below it.
Motion motion_of(const Ingredients& from, std::vector<Notice>& notices);

/// The curves that a take uses.
std::vector<const Record*> records_of(const Take& take);
/// All times of its keys, ascending, each once.
std::vector<std::int64_t> keys_of(const Take& take, const Curves& curves);

}  // namespace signweave::fbx
