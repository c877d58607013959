#pragma once

#include <string_view>
#include <vector>

namespace signweave::demo {

/// A shape of the mouth in a mouthed word; weights from 0 to 1 of ARKit's blend shapes.
struct MouthShape {
  float jaw = 0, close = 0, funnel = 0, pucker = 0, wide = 0, press = 0;
  float length = 1;  ///< relative to the others of its word
};

/// The shapes of a French word by simple rules from its letters (UTF-8): a placeholder for mouthing, as the signs are
/// for signs. Silent letters have none; p, b and m close the lips.
std::vector<MouthShape> mouth_shapes(std::string_view word);

}  // namespace signweave::demo
