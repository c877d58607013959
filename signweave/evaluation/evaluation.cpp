#include "signweave/evaluation/evaluation.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "signweave/features/defects.h"

namespace signweave {
namespace {

bool spoils_frames(DefectKind kind) {
  return kind == DefectKind::t_pose || kind == DefectKind::jump || kind == DefectKind::not_finite;
}

/// The performer of most signs, the first by name on a tie; empty if no sign has a performer.
std::string performer_of(const std::vector<Sign>& signs) {
  std::map<std::string, std::size_t> counts;
  for (const Sign& sign : signs) {
    if (!sign.signer.empty()) ++counts[sign.signer];
  }
  const auto most = std::ranges::max_element(counts, [](const auto& a, const auto& b) { return a.second < b.second; });
  return most == counts.end() ? std::string() : most->first;
}

}  // namespace

EvaluatedMotion evaluated_motion(std::string name, Motion motion, const RigMap& rig, std::vector<Sign> signs,
                                 const FrameClock& clock) {
  if (motion.frame_count() < kLeastFrames) {
    throw Error(ErrorCode::unsupported, fmt::format("{}: only {} frame{}, so nothing can be cut out", name,
                                                    motion.frame_count(), motion.frame_count() == 1 ? "" : "s"));
  }
  if (!rig.has(Part::left_hand) && !rig.has(Part::right_hand)) {
    throw Error(ErrorCode::unsupported,
                fmt::format("{}: no wrist is known, so there is nothing to compare; a mapping file can name left_hand "
                            "and right_hand",
                            name));
  }
  EvaluatedMotion one{.name = std::move(name), .motion = std::move(motion), .signs = std::move(signs), .clock = clock};
  one.performer = performer_of(one.signs);
  one.unusable.assign(static_cast<std::size_t>(one.motion.frame_count()), false);
  for (const Defect& defect : find_defects(one.motion, rig)) {
    if (!spoils_frames(defect.kind)) continue;
    const FrameRange frames = clamp(defect.frames, one.motion.frame_count());
    for (std::int64_t frame = frames.begin; frame < frames.end; ++frame) {
      one.unusable[static_cast<std::size_t>(frame)] = true;
    }
  }
  keep_hemisphere(one.motion);
  one.noise = capture_noise(one.motion);
  one.signer = {rig, signer_body(one.motion, rig)};
  one.groups = joint_groups(one.motion.skeleton(), rig);
  HandTracker tracker(one.motion.skeleton(), one.signer);
  tracker.track(view_of(one.motion, {0, one.motion.frame_count()}), one.tracks);
  return one;
}

}  // namespace signweave
