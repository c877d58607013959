#include "app/calls/motion_reading.h"

#include <charconv>
#include <cmath>
#include <optional>

namespace signweave::calls {
namespace {

/// Metres per unit: "cm", "m", "mm", "in", or a number of metres.
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

}  // namespace

std::string check_unit(const std::string& text) {
  return parse_unit(text) ? std::string() : "'" + text + "' is no unit: cm, m, mm, in, or metres per unit as a number";
}

bvh::ReadOptions read_options(const MotionReading& reading) {
  bvh::ReadOptions result;
  if (!reading.up.empty()) result.up = reading.up == "z" ? bvh::UpAxis::z : bvh::UpAxis::y;
  if (!reading.unit.empty()) result.unit = parse_unit(reading.unit);
  if (!reading.root_unit.empty()) result.root_unit = parse_unit(reading.root_unit);
  if (reading.root_order == "rotation_first") result.root_columns = bvh::RootColumns::rotation_first;
  result.mirror = reading.mirror;
  return result;
}

}  // namespace signweave::calls
