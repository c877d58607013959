#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string_view>

#include "signweave/formats/asf/asf.h"

using namespace signweave;

/// Any bytes, a skeleton and, after the first form feed, its motion, are either rejected with an Error or read as a
/// motion of finite numbers.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  const std::size_t cut = text.find('\f');
  const std::string_view asf = text.substr(0, cut);
  const std::string_view amc = cut == std::string_view::npos ? std::string_view() : text.substr(cut + 1);
  asf::ReadOptions options;
  if (size % 2 == 1) options.unit = 0.0254;
  if (size % 3 == 1) options.up = bvh::UpAxis::z;
  asf::File file;
  try {
    file = asf::read_text("skeleton", asf, "motion", amc, options);
  } catch (const Error&) {
    return 0;
  }
  if (file.motion.frame_count() == 0 || !keeps_hemisphere(file.motion)) std::abort();
  for (const Eigen::Quaternionf& rotation : file.motion.rotations()) {
    if (!(std::abs(rotation.norm() - 1) < 1e-5f)) std::abort();
  }
  for (const Eigen::Vector3f& translation : file.motion.translations()) {
    if (!translation.allFinite()) std::abort();
  }
  return 0;
}
