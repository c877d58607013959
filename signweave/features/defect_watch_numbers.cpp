#include <fmt/format.h>

#include <cmath>

#include "signweave/core/text.h"
#include "signweave/features/defect_watch.h"

namespace signweave::defect {

NumberWatch::NumberWatch(const Motion& motion) : motion_(motion), latest_(motion.skeleton().joint_count()) {}

void NumberWatch::flag(JointIndex joint, std::int64_t frame) {
  Latest& latest = latest_[static_cast<std::size_t>(joint)];
  if (latest.end < frame) {  // a new range
    latest.kept_at = bad_.size();
    if (bad_.size() < kMostDefects) {
      bad_.push_back({joint, {frame, frame}});
    } else {
      ++more_bad_;
    }
  }
  latest.end = frame + 1;
  if (latest.kept_at < bad_.size()) bad_[latest.kept_at].frames.end = frame + 1;
}

bool NumberWatch::see(std::int64_t frame) {
  const PoseView now = motion_.pose(frame);
  bool whole = true;
  const PoseView before = motion_.pose(frame == 0 ? 0 : frame - 1);
  for (std::size_t i = 0; i < now.rotations.size(); ++i) {
    const float cosine = before.rotations[i].dot(now.rotations[i]);
    if (cosine > 0 && cosine < 2) continue;  // so every component is finite
    const auto joint = static_cast<JointIndex>(i);
    if (!now.rotations[i].coeffs().allFinite()) {
      flag(joint, frame);
      whole = false;
    } else if (cosine < 0) {
      if (flips_.size() < kMostDefects) {
        flips_.push_back({joint, {frame, frame + 1}});
      } else {
        ++more_flips_;
      }
    }
  }
  for (std::size_t i = 0; i < now.translations.size(); ++i) {
    if (now.translations[i].allFinite()) continue;
    flag(motion_.skeleton().translated_joints()[i], frame);
    whole = false;
  }
  return whole;
}

Found NumberWatch::flips() const {
  Found result{.more = more_flips_};
  for (const JointFrames& flip : flips_) {
    result.defects.push_back({.kind = DefectKind::quaternion_flip,
                              .joint = flip.joint,
                              .frames = flip.frames,
                              .text = fmt::format("{} changes the sign of its quaternion: the same rotation, corrected "
                                                  "when it is stored",
                                                  printable(motion_.skeleton().joint(flip.joint).name))});
  }
  return result;
}

Found NumberWatch::not_finite() const {
  Found result{.more = more_bad_};
  for (const JointFrames& bad : bad_) {
    result.defects.push_back({.kind = DefectKind::not_finite,
                              .joint = bad.joint,
                              .frames = bad.frames,
                              .text = fmt::format("{} has values that are NaN or infinite; export the motion again",
                                                  printable(motion_.skeleton().joint(bad.joint).name))});
  }
  return result;
}

}  // namespace signweave::defect
