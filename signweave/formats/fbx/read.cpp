#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>

#include "signweave/core/atomic_file.h"
#include "signweave/core/text.h"
#include "signweave/formats/fbx/bones.h"
#include "signweave/formats/fbx/fbx.h"
#include "signweave/formats/fbx/keys.h"
#include "signweave/formats/fbx/local.h"
#include "signweave/formats/fbx/motion.h"
#include "signweave/formats/fbx/time.h"
#include "signweave/formats/fbx/tree.h"

namespace signweave::fbx {
namespace {

void check_options(const ReadOptions& options) {
  if (options.unit && !(*options.unit > 0 && *options.unit < 1e6)) {
    throw Error(ErrorCode::bad_input,
                fmt::format("{} is not a unit; give the metres of one unit, such as 0.01", *options.unit));
  }
  if (options.rate && (options.rate->numerator <= 0 || options.rate->denominator <= 0)) {
    throw Error(ErrorCode::bad_input, "a frame rate must be above 0");
  }
}

/// True for visibility, sizes and other properties that do not move bones.
bool moves_nothing(const Channel& channel) noexcept {
  if (channel.what != Animated::other) return false;
  const std::string& name = channel.property;
  const bool moves = name.find("Rotation") != std::string::npos || name.find("Scaling") != std::string::npos ||
                     name.find("InheritType") != std::string::npos;
  return !moves || name.rfind("Geometric", 0) == 0;
}

/// Removes the channels of a take that belong to other nodes or are not transforms.
Take of_bones(Take take, const std::vector<std::size_t>& bones, std::size_t nodes) {
  std::vector<bool> is_bone(nodes);
  for (const std::size_t bone : bones) is_bone[bone] = true;
  std::erase_if(take.channels,
                [&](const Channel& channel) { return !is_bone[channel.node] || moves_nothing(channel); });
  return take;
}

bool has_keys(const Take& take) noexcept {
  return !take.channels.empty() || !take.morphs.empty();
}

std::string names_of(const std::vector<Take>& takes, std::size_t without) {
  std::string names;
  for (std::size_t i = 0; i < takes.size(); ++i) {
    if (i == without) continue;
    if (names.size() > 200) return names + " …";
    names += fmt::format("{}{} '{}'", names.empty() ? "" : ", ", i + 1, printable(takes[i].name));
  }
  return names;
}

/// Selects the requested take, from those reduced to the motion of the bones.
std::size_t take_of(const Source& source, const std::vector<Take>& takes, const std::string& wanted,
                    std::vector<Notice>& notices) {
  if (takes.empty()) {
    throw Error(
        ErrorCode::bad_input,
        fmt::format("{}: it has no take (AnimationStack), so no motion; export it with its animation", source.name));
  }
  if (wanted.empty()) {
    const auto found = std::find_if(takes.begin(), takes.end(), has_keys);
    if (found == takes.end()) {
      throw Error(ErrorCode::bad_input,
                  fmt::format("{}: no take has keys for its bones; export it with its animation baked", source.name));
    }
    const auto take = static_cast<std::size_t>(found - takes.begin());
    if (takes.size() > 1) {
      notices.push_back({source.name, fmt::format("take {} '{}' is read; others: {}", take + 1,
                                                  printable(takes[take].name), names_of(takes, take))});
    }
    return take;
  }
  std::size_t take = takes.size();
  std::vector<std::string> known;
  for (std::size_t i = takes.size(); i-- > 0;) {
    known.push_back(takes[i].name);
    if (takes[i].name == wanted) take = i;
  }
  if (take == takes.size()) {
    std::size_t number = 0;
    const auto [end, error] = std::from_chars(wanted.data(), wanted.data() + wanted.size(), number);
    const bool is_number = error == std::errc() && end == wanted.data() + wanted.size();
    if (!is_number || number < 1 || number > takes.size()) {
      throw Error(ErrorCode::not_found, fmt::format("{}: it has no take '{}'; it has {}", source.name,
                                                    printable(wanted), names_of(takes, takes.size())));
    }
    take = number - 1;
  }
  if (!has_keys(takes[take])) {
    throw Error(ErrorCode::bad_input, fmt::format("{}: take '{}' has no keys for its bones; it has {}", source.name,
                                                  printable(takes[take].name), names_of(takes, takes.size())));
  }
  return take;
}

/// Fails if rotating and moving bones cannot represent the take.
void check_channels(const Source& source, const Scene& scene, const Take& take) {
  std::size_t layer = std::numeric_limits<std::size_t>::max();
  for (const Channel& channel : take.channels) {
    const Node& node = scene.nodes[channel.node];
    if (layer == std::numeric_limits<std::size_t>::max()) layer = channel.layer;
    if (channel.layer != layer) {
      throw Error(ErrorCode::bad_input, fmt::format("{}: take '{}' animates bones in several layers; bake it into one",
                                                    source.name, printable(take.name)));
    }
    if (channel.what != Animated::other) continue;
    source.fail(node.place, fmt::format("node '{}' animates its {}, which is not read; bake the animation",
                                        printable(node.name), printable(channel.property)));
  }
}

void note_space(const Source& source, const Settings& settings, const ReadOptions& options,
                std::vector<Notice>& notices) {
  if (!settings.has_axes) notices.push_back({source.name, "it names no up axis; Y up assumed"});
  if (!settings.has_unit && !options.unit) notices.push_back({source.name, "it names no unit; centimetres assumed"});
  const bool plain = settings.axes == std::array<int, 3>{0, 1, 2} && settings.signs == std::array<int, 3>{1, 1, 1};
  if (plain) return;
  const auto axis = [&](std::size_t index) {
    return fmt::format("{}{}", settings.signs[index] < 0 ? "-" : "+", "XYZ"[settings.axes[index]]);
  };
  notices.push_back(
      {source.name, fmt::format("turned to Y up: its right is {}, its up {}, its front {}{}", axis(0), axis(1), axis(2),
                                Space(settings).mirrored() ? " (left-handed, mirrored)" : "")});
}

File read(Source& source, const ReadOptions& options) {
  check_options(options);
  const Record root = read_tree(source);
  const Scene scene = scene_of(source, root);
  File file;
  const std::vector<std::size_t> bones = bones_of(source, scene, file.notices);
  std::vector<Take> takes;
  for (const Take& take : scene.takes) takes.push_back(of_bones(take, bones, scene.nodes.size()));
  const Take& take = takes[take_of(source, takes, options.take, file.notices)];
  file.take = take.name;
  check_channels(source, scene, take);
  note_space(source, scene.settings, options, file.notices);

  const Curves curves = read_curves(source, records_of(take));
  const Frames frames = frames_of(source, scene, take, keys_of(take, curves), options.rate, bones.size(), file.notices);
  const double unit = options.unit.value_or(0.01 * scene.settings.unit_factor);
  file.motion = motion_of({.source = source,
                           .scene = scene,
                           .take = take,
                           .bones = bones,
                           .curves = curves,
                           .frames = frames,
                           .unit = unit,
                           .progress = options.progress},
                          file.notices);
  keep_hemisphere(file.motion);
  if (options.progress) options.progress(1.0);
  return file;
}

}  // namespace

File read(const std::filesystem::path& path, const ReadOptions& options) {
  // Read as a whole, because the tree borrows from it.
  const std::string bytes = read_file(path, std::size_t{1} << 31);
  return read_bytes(path.string(), bytes, options);
}

File read_bytes(const std::string& name, std::string_view bytes, const ReadOptions& options) {
  Source source{.name = name, .bytes = bytes};
  return read(source, options);
}

}  // namespace signweave::fbx
