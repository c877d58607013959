#include "signweave/calls/motion_writing.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>

#include "signweave/core/text.h"
#include "signweave/core/time.h"
#include "signweave/motion/resample.h"

namespace signweave::calls {

std::string check_rate(const std::string& text) {
  const auto rate = parse_frame_rate(text);
  if (rate && rate->hertz() >= 1 && rate->hertz() <= 2000) return {};
  return fmt::format("'{}' is not a rate of 1 to 2000 frames a second", printable(text));
}

std::optional<double> parse_unit(const std::string& text) {
  if (text == "m") return 1.0;
  if (text == "cm") return 0.01;
  if (text == "mm") return 0.001;
  if (text == "in") return 0.0254;
  double metres = 0;
  const char* end = text.data() + text.size();
  if (std::from_chars(text.data(), end, metres).ptr != end || !std::isfinite(metres) || metres < 1e-6 || metres > 1e6) {
    return std::nullopt;
  }
  return metres;
}

std::string check_unit(const std::string& text) {
  return parse_unit(text) ? std::string()
                          : "'" + text + "' is not a unit: cm, m, mm, in, or metres per unit as a number";
}

bvh::LayoutChanges layout_changes_of(const BvhWriting& writing) {
  bvh::LayoutChanges changes;
  if (!writing.order.empty()) {
    changes.order.emplace();
    std::transform(writing.order.begin(), writing.order.end(), changes.order->begin(), [](char axis) {
      return axis == 'X' ? bvh::Channel::x_rotation : axis == 'Y' ? bvh::Channel::y_rotation : bvh::Channel::z_rotation;
    });
  }
  if (!writing.up.empty()) changes.up = writing.up == "z" ? bvh::UpAxis::z : bvh::UpAxis::y;
  if (!writing.unit.empty()) changes.unit = parse_unit(writing.unit);
  return changes;
}

Motion at_rate(Motion motion, const RateWriting& writing, const std::string& where, std::vector<Notice>& notices) {
  const std::optional<FrameRate> rate = writing.rate.empty() ? std::nullopt : parse_frame_rate(writing.rate);
  if (!rate || *rate == motion.rate()) return motion;
  const RateMethod method = writing.method == "nearest" ? RateMethod::nearest : RateMethod::slerp;
  notices.push_back({where, fmt::format("{} frames a second made of {} by {}", to_string(*rate),
                                        to_string(motion.rate()), name_of(method))});
  return resampled(motion, *rate, method);
}

}  // namespace signweave::calls
