#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string>
#include <string_view>

#include "signweave/core/error.h"
#include "signweave/formats/gltf/gltf.h"
#include "signweave/formats/gltf/read.h"

using namespace signweave;

/// Any bytes are either rejected with an Error or read as a motion of finite numbers and unit rotations; the output of
/// our own writer for it can be read again.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view bytes(reinterpret_cast<const char*>(data), size);
  gltf::ReadOptions options;
  options.most_growth = std::size_t{1} << 20;  // so that faults are found quickly
  if (size % 4 == 1) options.rate = FrameRate{50, 1};
  if (size % 8 == 3) options.unit = 0.01;
  Motion motion;
  try {
    motion = gltf::read_bytes("fuzz", bytes, {}, options).motion;
  } catch (const Error&) {
    return 0;
  }
  for (const Eigen::Quaternionf& rotation : motion.rotations()) {
    if (!(std::abs(rotation.norm() - 1) < 1e-3f)) std::abort();
  }
  for (const Eigen::Vector3f& translation : motion.translations()) {
    if (!translation.allFinite()) std::abort();
  }
  if (!keeps_hemisphere(motion) || motion.frame_count() < 1) std::abort();
  std::string written;
  try {
    written = gltf::to_bytes(motion, {}, gltf::Container::binary);
  } catch (const Error&) {
    return 0;  // too far away to be drawn, or too long for a float to distinguish its frames
  }
  options = {};
  gltf::read_bytes("written", written, {}, options);
  return 0;
}
