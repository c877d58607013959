#include "signweave/features/defects.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cassert>

#include "signweave/core/text.h"
#include "signweave/features/defect_watch.h"

namespace signweave {
namespace {

constexpr std::array<std::string_view, 7> kNames = {"T-pose",        "frozen joint", "jump",      "quaternion flip",
                                                    "permuted root", "scale",        "not finite"};

/// Returns [frame] whether it is near the cut from a T-pose to the signing, or back, which is not a second defect.
std::vector<bool> cuts_of(const std::vector<Defect>& poses, std::int64_t frames) {
  constexpr std::int64_t kNear = 2;  // frames: the arms may be in transit for one
  std::vector<bool> cuts(static_cast<std::size_t>(frames), false);
  for (const Defect& pose : poses) {
    for (const std::int64_t cut : {pose.frames.begin, pose.frames.end}) {
      for (std::int64_t frame = std::max<std::int64_t>(0, cut - kNear); frame <= std::min(cut + kNear, frames - 1);
           ++frame) {
        cuts[static_cast<std::size_t>(frame)] = true;
      }
    }
  }
  return cuts;
}

/// Adds the defects of one kind; the last one says how many more there are.
void add(defect::Found found, std::vector<Defect>& all) {
  assert(found.defects.size() <= kMostDefects);
  if (found.more > 0) {
    fmt::format_to(std::back_inserter(found.defects.back().text), "; and {} more of this kind", found.more);
  }
  std::move(found.defects.begin(), found.defects.end(), std::back_inserter(all));
}

/// Keeps the first kMostDefects.
defect::Found first_of(std::vector<Defect> defects) {
  const std::size_t more = defects.size() - std::min(defects.size(), kMostDefects);
  defects.resize(defects.size() - more);
  return {.defects = std::move(defects), .more = more};
}

}  // namespace

std::string_view name_of(DefectKind kind) noexcept {
  assert(static_cast<std::size_t>(kind) < kNames.size());
  return kNames[static_cast<std::size_t>(kind)];
}

std::vector<Defect> find_defects(const Motion& motion, const RigMap& rig) {
  std::vector<Defect> all;
  if (motion.frame_count() == 0) return all;
  // The first pass finds invalid frames, which other detectors skip, and T-poses, which excuse jumps.
  defect::NumberWatch numbers(motion);
  defect::TPoseWatch poses(motion, rig);
  std::vector<bool> is_whole(static_cast<std::size_t>(motion.frame_count()));  // all values are finite
  ModelPose model;
  for (std::int64_t frame = 0; frame < motion.frame_count(); ++frame) {
    const bool good = numbers.see(frame);
    is_whole[static_cast<std::size_t>(frame)] = good;
    if (!good || !poses.can_tell()) continue;
    to_model_space(motion.skeleton(), motion.pose(frame), model);
    poses.see(frame, model);
  }
  const bool whole = std::find(is_whole.begin(), is_whole.end(), false) == is_whole.end();
  const bool permuted = whole && defect::has_permuted_root(motion);
  std::vector<Defect> t_poses = poses.found();
  const std::vector<bool> cuts = cuts_of(t_poses, motion.frame_count());

  defect::StillWatch still(motion, rig);
  defect::JumpWatch jumps(motion, [&](std::int64_t frame, JointIndex joint) {
    return cuts[static_cast<std::size_t>(frame)] ||
           (permuted && joint == 0);  // the root's position is meaningless then
  });
  for (std::int64_t frame = 0; frame < motion.frame_count(); ++frame) {
    const bool good = is_whole[static_cast<std::size_t>(frame)];
    jumps.see(frame, good);
    if (good) still.see(frame);
  }
  add(first_of(std::move(t_poses)), all);
  add(still.found(), all);
  add(jumps.found(), all);
  add(numbers.flips(), all);
  add(numbers.not_finite(), all);
  if (permuted) {
    Defect defect{.kind = DefectKind::permuted_root, .joint = 0};
    defect.text = fmt::format(
        "{} has a constant rotation that equals its offset taken as degrees: its columns contain "
        "the rotation first; read the file with the rotation first",
        printable(motion.skeleton().joint(0).name));
    all.push_back(std::move(defect));
  }
  if (whole) add(first_of(defect::odd_scale(motion, rig)), all);
  std::stable_sort(all.begin(), all.end(), [](const Defect& a, const Defect& b) {
    return a.kind != b.kind ? a.kind < b.kind : a.frames.begin < b.frames.begin;
  });
  return all;
}

}  // namespace signweave
