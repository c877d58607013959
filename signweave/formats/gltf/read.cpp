#include "signweave/formats/gltf/read.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <memory>
#include <set>

#include "signweave/core/atomic_file.h"
#include "signweave/core/text.h"
#include "signweave/formats/gltf/bind.h"
#include "signweave/formats/gltf/loss.h"
#include "signweave/formats/gltf/pose.h"
#include "signweave/formats/gltf/rate.h"
#include "signweave/formats/gltf/space.h"
#include "signweave/formats/gltf/tracks.h"

namespace signweave::gltf {
namespace {

/// Bodies lower or taller than this are unlikely to be in metres.
constexpr float kLowestBody = 0.05f;
constexpr float kTallestBody = 4.0f;

constexpr std::uintmax_t kMostFileSize = std::uintmax_t{1} << 32;

void check_options(const ReadOptions& options) {
  if (options.unit && !(*options.unit >= 1e-6 && *options.unit <= 1e6)) {
    throw Error(ErrorCode::bad_input, fmt::format("a unit of {} metres; give one between 1e-6 and 1e6", *options.unit));
  }
  if (options.rate && !(options.rate->numerator > 0 && options.rate->denominator > 0 && options.rate->hertz() >= 1e-4 &&
                        options.rate->hertz() <= 1e6)) {
    throw Error(ErrorCode::bad_input, "an invalid rate; give frames a second between 1e-4 and 1e6");
  }
}

/// The times of the curves that are used, each list once.
std::vector<std::shared_ptr<KeyTimes>> times_of_used(const Take& take, const std::vector<JointPlace>& places) {
  std::vector<std::shared_ptr<KeyTimes>> all;
  std::set<const KeyTimes*> known;
  const auto add = [&](const Curve* curve) {
    if (curve != nullptr && known.insert(curve->times.get()).second) all.push_back(curve->times);
  };
  for (const JointPlace& place : places) {
    add(take.nodes[place.node].translation);
    add(take.nodes[place.node].rotation);
    for (const Curve* growth : place.growth) add(growth);
  }
  for (const NodeCurves& curves : take.nodes) add(curves.weights);
  return all;
}

bool is_any_cubic(const Take& take) {
  return std::ranges::any_of(take.curves,
                             [](const auto& curve) { return curve->interpolation == Interpolation::cubic; });
}

void report_timing(const std::string& name, const Timing& timing, const ReadOptions& options, bool one_pose,
                   std::vector<Notice>& notices) {
  if (timing.start > 0) {
    notices.push_back(
        {name, fmt::format("its first key is at {:.6g} seconds; that is the motion's first frame", timing.start)});
  }
  if (one_pose && !options.rate) {
    notices.push_back({name,
                       fmt::format("it has one key only, so its rate is taken to be {}", to_string(timing.rate)),
                       {{"source_rate", ""}}});
  }
}

void report_size(const std::string& name, const Motion& motion, const ReadOptions& options,
                 std::vector<Notice>& notices) {
  if (options.unit || motion.skeleton().joint_count() < 2) return;
  const float size = size_of_first_pose(motion);
  if (size >= kLowestBody && size <= kTallestBody) return;
  const auto fits = [&](float factor) { return size * factor >= 0.3f && size * factor <= 3.0f; };
  const char* const unit = fits(0.01f) ? "centimetres" : fits(0.001f) ? "millimetres" : fits(0.0254f) ? "inches" : "";
  const char* const suggested = fits(0.01f) ? "0.01" : fits(0.001f) ? "0.001" : fits(0.0254f) ? "0.0254" : "";
  std::string text = fmt::format("its joints span {:.3g} metres", size);
  text += *unit == '\0' ? "; check its unit" : fmt::format(", as if it were in {}", unit);
  notices.push_back({name, std::move(text), {{"unit", suggested}}});
}

std::filesystem::path folder_of(const std::filesystem::path& path) {
  return path.has_parent_path() ? path.parent_path() : std::filesystem::path(".");
}

/// A file's bytes, read at once: a buffer that grows while reading is copied repeatedly, and a GLB may be large.
struct WholeFile {
  std::unique_ptr<char[]> bytes;
  std::size_t size = 0;
};

WholeFile whole_file(const std::filesystem::path& path) {
  std::error_code fault;
  const std::uintmax_t size = std::filesystem::file_size(path, fault);
  if (!fault && size <= kMostFileSize) {
    const std::unique_ptr<std::FILE, int (*)(std::FILE*)> file(std::fopen(path.c_str(), "rb"), &std::fclose);
    WholeFile whole{std::make_unique_for_overwrite<char[]>(size), size};
    if (file && std::fread(whole.bytes.get(), 1, size, file.get()) == size) return whole;
  }
  const std::string text = read_file(path);  // reports the error, or reads a file without a size
  WholeFile whole{std::make_unique_for_overwrite<char[]>(text.size()), text.size()};
  std::ranges::copy(text, whole.bytes.get());
  return whole;
}

ReadFile read_content(const Content& content, const ReadOptions& options) {
  const std::string& name = content.name;
  ReadFile file;
  Budget budget(name, options.most_growth + 64 * content.byte_count);
  Accessors accessors(content, budget);
  const NodeForest forest = forest_of(content);
  Take take = take_of(content, accessors, budget, options.take, file.notices);
  file.take = take.name;
  file.declarations = content.declarations;
  const std::vector<std::size_t> joints = joints_of(content, forest, take, file.notices);
  const double unit = options.unit.value_or(1.0);
  std::vector<JointPlace> places = joint_places(content, forest, take, joints, unit, file.notices);
  check_bind_poses(content, forest, accessors, unit, file.notices);

  const std::vector<std::shared_ptr<KeyTimes>> times = times_of_used(take, places);
  const KeyHabits habits{.smooth = is_any_cubic(take), .key_a_frame = content.is_ours()};
  const Timing timing = timing_of(times, habits, options.rate);
  for (const auto& one : times) place_keys(*one, timing);
  report_timing(name, timing, options, !timing.known_from_keys && timing.frames == 1, file.notices);

  file.motion = motion_of(content, places, timing, budget, options.progress);
  for (ScalarTrack& track : tracks_of(content, take, timing, budget, file.notices)) {
    file.motion.add_track(std::move(track));
  }
  if (!timing.even) report_loss(content, take, places, timing, options.rate.has_value(), file.notices);
  report_size(name, file.motion, options, file.notices);
  if (options.progress) options.progress(1.0);
  return file;
}

}  // namespace

ReadFile read_bytes(const std::string& name, std::string_view bytes, const std::filesystem::path& folder,
                    const ReadOptions& options) {
  check_options(options);
  return read_content(content_of(name, bytes, folder), options);
}

ReadFile read(const std::filesystem::path& path, const ReadOptions& options) {
  check_options(options);
  const WholeFile whole = whole_file(path);
  return read_bytes(path.string(), {whole.bytes.get(), whole.size}, folder_of(path), options);
}

std::vector<std::filesystem::path> files_of(const std::filesystem::path& path) {
  std::vector<std::filesystem::path> files = {path};
  const std::string bytes = read_file(path);
  try {
    std::set<std::filesystem::path> known = {path};
    for (std::filesystem::path& buffer : outside_buffers(path.string(), bytes, folder_of(path))) {
      if (known.insert(buffer).second) files.push_back(std::move(buffer));
    }
  } catch (const Error&) {
    // Reading the file reports what is wrong with it.
  }
  return files;
}

}  // namespace signweave::gltf
