#include <fmt/format.h>

#include <cmath>

#include "signweave/core/text.h"
#include "signweave/features/defect_watch.h"

namespace signweave::defect {

NumberWatch::NumberWatch(const Motion& motion) : motion_(motion), bad_until_(motion.skeleton().joint_count(), 0) {}

bool NumberWatch::see(std::int64_t frame) {
  const PoseView now = motion_.pose(frame);
  const auto flag = [&](JointIndex joint) {
    std::int64_t& last = bad_until_[static_cast<std::size_t>(joint)];
    if (last > 0 && bad_[static_cast<std::size_t>(last - 1)].frames.end >= frame) {
      bad_[static_cast<std::size_t>(last - 1)].frames.end = frame + 1;
      return;
    }
    bad_.push_back({joint, {frame, frame + 1}});
    last = static_cast<std::int64_t>(bad_.size());
  };
  bool whole = true;
  const PoseView before = motion_.pose(frame == 0 ? 0 : frame - 1);
  for (std::size_t i = 0; i < now.rotations.size(); ++i) {
    const float cosine = before.rotations[i].dot(now.rotations[i]);
    if (cosine > 0 && cosine < 2) continue;  // and so every number is one
    const auto joint = static_cast<JointIndex>(i);
    if (!now.rotations[i].coeffs().allFinite()) {
      flag(joint);
      whole = false;
    } else if (cosine < 0) {
      flips_.push_back({.kind = DefectKind::quaternion_flip,
                        .joint = joint,
                        .frames = {frame, frame + 1},
                        .text = fmt::format("{} changes the sign of its quaternion: the same rotation, mended when it "
                                            "is stored",
                                            printable(motion_.skeleton().joint(joint).name))});
    }
  }
  for (std::size_t i = 0; i < now.translations.size(); ++i) {
    if (now.translations[i].allFinite()) continue;
    flag(motion_.skeleton().translated_joints()[i]);
    whole = false;
  }
  return whole;
}

std::vector<Defect> NumberWatch::found() {
  std::vector<Defect> result = std::move(flips_);
  for (const Bad& bad : bad_) {
    result.push_back({.kind = DefectKind::not_finite,
                      .joint = bad.joint,
                      .frames = bad.frames,
                      .text = fmt::format("{} has numbers that are infinite or none; export the motion again",
                                          printable(motion_.skeleton().joint(bad.joint).name))});
  }
  return result;
}

}  // namespace signweave::defect
