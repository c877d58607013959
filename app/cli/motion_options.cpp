#include "app/cli/motion_options.h"

#include <CLI/CLI.hpp>
#include <charconv>
#include <cmath>
#include <optional>

namespace signweave::cli {
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

std::string check_unit(const std::string& text) {
  return parse_unit(text) ? std::string() : "'" + text + "' is no unit: cm, m, mm, in, or metres per unit as a number";
}

}  // namespace

void add_motion_options(CLI::App& verb, MotionOptions& options) {
  verb.add_option("--up", options.up, "the file's vertical axis; guessed where not given")
      ->check(CLI::IsMember({"y", "z"}));
  verb.add_option("--unit", options.unit, "the file's unit: cm, m, mm, in or metres per unit; guessed where not given")
      ->check(check_unit);
  verb.add_option("--root-unit", options.root_unit, "the unit of the root's position where it is another")
      ->check(check_unit);
  verb.add_option("--root-order", options.root_order,
                  "declared: as CHANNELS says; rotation_first: the root's columns hold the rotation first")
      ->check(CLI::IsMember({"declared", "rotation_first"}));
  verb.add_flag("--mirror", options.mirror, "the file's space is left-handed");
}

bvh::ReadOptions read_options(const MotionOptions& options) {
  bvh::ReadOptions result;
  if (!options.up.empty()) result.up = options.up == "z" ? bvh::UpAxis::z : bvh::UpAxis::y;
  if (!options.unit.empty()) result.unit = parse_unit(options.unit);
  if (!options.root_unit.empty()) result.root_unit = parse_unit(options.root_unit);
  if (options.root_order == "rotation_first") result.root_columns = bvh::RootColumns::rotation_first;
  result.mirror = options.mirror;
  return result;
}

}  // namespace signweave::cli
