#pragma once

#include <Eigen/Geometry>
#include <cmath>
#include <memory>
#include <string>

#include "signweave/motion/motion.h"
#include "signweave/score/motion_clip.h"

namespace signweave::testing_motion {

/// A small signer: hips, spine, arm, hand.
inline std::shared_ptr<const Skeleton> small_skeleton(float arm = 0.3f) {
  return std::make_shared<const Skeleton>(std::vector<Joint>{{"Hips", kNoJoint, {0, 1, 0}, true},
                                                             {"Spine", 0, {0, 0.3f, 0}, false},
                                                             {"Arm", 1, {arm, 0.1f, 0}, false},
                                                             {"Hand", 2, {0.3f, 0, 0}, false}},
                                          std::vector<Tip>{{3, {0.1f, 0, 0}}});
}

/// A motion in which every joint turns continuously, differently for each `seed`.
inline Motion moving(std::int64_t frames, FrameRate rate, float seed,
                     std::shared_ptr<const Skeleton> skeleton = small_skeleton()) {
  Motion motion(std::move(skeleton), rate, frames);
  for (std::int64_t frame = 0; frame < frames; ++frame) {
    const float t = static_cast<float>(static_cast<double>(frame) * rate.frame_time().count());
    const MutablePoseView pose = motion.pose(frame);
    for (std::size_t joint = 0; joint < pose.rotations.size(); ++joint) {
      const float phase = seed + static_cast<float>(joint);
      const Eigen::Vector3f axis = Eigen::Vector3f(std::sin(phase), 1.0f, std::cos(phase)).normalized();
      pose.rotations[joint] = Eigen::AngleAxisf(0.6f * std::sin(2.0f * t + phase), axis);
    }
    pose.translations[0] = {seed + 0.05f * std::sin(t), 1.0f, 0.5f * seed};
  }
  return motion;
}

/// A clip of one sign with these frame counts of preparation, stroke and retraction, from a longer recording.
inline MotionClip clip(const std::string& name, float seed, std::int64_t preparation, std::int64_t stroke,
                       std::int64_t retraction, FrameRate rate = {100, 1},
                       std::shared_ptr<const Skeleton> skeleton = small_skeleton()) {
  constexpr std::int64_t kBefore = 7;  // frames of the recording that are not part of the sign
  MotionClip result;
  result.recording = name;
  result.whole = {kBefore, kBefore + preparation + stroke + retraction};
  result.core = {kBefore + preparation, kBefore + preparation + stroke};
  result.source = std::make_shared<MemorySource>(
      moving(kBefore + preparation + stroke + retraction + 5, rate, seed, std::move(skeleton)));
  result.clock = {rate.frame_time(), Seconds(0)};
  const auto ms = [&](std::int64_t frame) { return span_of({0, frame}, result.clock).end; };
  Sign sign{.gloss = name, .span = {ms(result.whole.begin), ms(result.whole.end)}, .tier = "Gloss"};
  const TimeSpan core{ms(result.core.begin), ms(result.core.end)};
  if (preparation > 0)
    sign.phases.push_back({PhaseKind::preparation, {sign.span.begin, core.begin}, "Preparation", {}});
  sign.phases.push_back({PhaseKind::stroke, core, "Stroke", {}});
  if (retraction > 0) sign.phases.push_back({PhaseKind::retraction, {core.end, sign.span.end}, "Retraction", {}});
  result.signs.push_back(sign);
  return result;
}

/// The recording of such a clip.
inline const Motion& motion_of(const MotionClip& clip) {
  return dynamic_cast<const MemorySource&>(*clip.source).motion();
}

/// Angle between two rotations in radians.
inline double angle(const Eigen::Quaternionf& a, const Eigen::Quaternionf& b) {
  return 2.0 * std::atan2((a.conjugate() * b).vec().cast<double>().norm(), std::abs(static_cast<double>(a.dot(b))));
}

}  // namespace signweave::testing_motion
