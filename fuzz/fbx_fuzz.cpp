#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string_view>

#include "signweave/formats/fbx/fbx.h"

using namespace signweave;

/// Any bytes are either rejected with an Error or read as a motion of unit quaternions and finite positions.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view bytes(reinterpret_cast<const char*>(data), size);
  fbx::ReadOptions options;
  if (size % 8 == 7) options.take = "2";
  try {
    const fbx::File file = fbx::read_bytes("fuzz", bytes, options);
    for (const Eigen::Quaternionf& rotation : file.motion.rotations()) {
      if (!(std::abs(rotation.norm() - 1) < 1e-3f)) std::abort();
    }
    for (const Eigen::Vector3f& place : file.motion.translations()) {
      if (!place.allFinite()) std::abort();
    }
    if (!keeps_hemisphere(file.motion)) std::abort();
  } catch (const Error&) {
  }
  return 0;
}
