#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string>
#include <string_view>

#include "signweave/formats/bvh/bvh.h"

using namespace signweave;

/// Any bytes are either rejected with an Error or read, written and read again as the same motion.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  bvh::ReadOptions options;
  options.mirror = size % 2 == 1;
  if (size % 8 == 7) options.root_columns = bvh::RootColumns::rotation_first;
  bvh::File first;
  try {
    first = bvh::read_text("fuzz", text, options);
  } catch (const Error&) {
    return 0;
  }
  const std::string written = bvh::write_text(first.motion, first.layout);
  options.up = first.layout.up;
  options.unit = first.layout.unit;
  options.root_unit = first.layout.root_unit;
  const bvh::File second = bvh::read_text("written", written, options);
  const bool same = second.layout.channels == first.layout.channels &&
                    second.motion.skeleton().joint_count() == first.motion.skeleton().joint_count() &&
                    second.motion.frame_count() == first.motion.frame_count() &&
                    second.motion.rate() == first.motion.rate() &&
                    std::ranges::equal(second.motion.translations(), first.motion.translations());
  if (!same) std::abort();
  return 0;
}
