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

/// The cut from a T-pose to the signing is no second defect.
bool cuts_a_t_pose(const Defect& jump, const std::vector<Defect>& poses) {
  constexpr std::int64_t kNear = 2;  // frames: the arms may be on their way for one
  return std::any_of(poses.begin(), poses.end(), [&](const Defect& pose) {
    return std::abs(jump.frames.begin - pose.frames.begin) <= kNear ||
           std::abs(jump.frames.begin - pose.frames.end) <= kNear;
  });
}

/// Adds what was found of one kind, kMostDefects at most.
void add(std::vector<Defect> found, std::vector<Defect>& all) {
  if (found.size() > kMostDefects) {
    const std::size_t more = found.size() - kMostDefects;
    found.resize(kMostDefects);
    fmt::format_to(std::back_inserter(found.back().text), "; and {} more of the kind", more);
  }
  std::move(found.begin(), found.end(), std::back_inserter(all));
}

}  // namespace

std::string_view name_of(DefectKind kind) noexcept {
  assert(static_cast<std::size_t>(kind) < kNames.size());
  return kNames[static_cast<std::size_t>(kind)];
}

std::vector<Defect> find_defects(const Motion& motion, const RigMap& rig) {
  std::vector<Defect> all;
  if (motion.frame_count() == 0) return all;
  defect::TPoseWatch poses(motion, rig);
  defect::StillWatch still(motion, rig);
  defect::JumpWatch jumps(motion);
  defect::NumberWatch numbers(motion);
  ModelPose model;
  bool whole = true;  // every number is one
  for (std::int64_t frame = 0; frame < motion.frame_count(); ++frame) {
    whole = numbers.see(frame) && whole;
    jumps.see(frame);
    still.see(frame);
    if (!poses.can_tell()) continue;
    to_model_space(motion.skeleton(), motion.pose(frame), model);
    poses.see(frame, model);
  }
  std::vector<Defect> t_poses = poses.found();
  std::vector<Defect> jumped = jumps.found();
  std::erase_if(jumped, [&](const Defect& jump) { return cuts_a_t_pose(jump, t_poses); });
  const bool permuted = whole && defect::has_permuted_root(motion);
  if (permuted) {  // where the root is then says nothing
    std::erase_if(jumped, [](const Defect& jump) { return jump.joint == 0; });
  }
  add(std::move(t_poses), all);
  add(still.found(), all);
  add(std::move(jumped), all);
  add(numbers.found(), all);
  if (permuted) {
    Defect defect{.kind = DefectKind::permuted_root, .joint = 0};
    defect.text = fmt::format(
        "{} never turns, and stands turned by its own offset taken for degrees: its columns hold "
        "the rotation first; read the file with --root-order rotation_first",
        printable(motion.skeleton().joint(0).name));
    add({std::move(defect)}, all);
  }
  if (whole) add(defect::odd_scale(motion, rig), all);
  std::stable_sort(all.begin(), all.end(), [](const Defect& a, const Defect& b) {
    return a.kind != b.kind ? a.kind < b.kind : a.frames.begin < b.frames.begin;
  });
  return all;
}

}  // namespace signweave
