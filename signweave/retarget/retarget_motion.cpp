#include <algorithm>
#include <cmath>

#include "signweave/retarget/retarget.h"

#include "signweave/rig/joint_at.h"

namespace signweave {
namespace {

using Eigen::Quaternionf;

/// Clavicles that rotate by less than this relative to the chest count as not moving, radians.
constexpr float kStill = 0.035f;

}  // namespace

bool collars_move(const Motion& motion, const RigMap& rig) {
  for (const Side side : kSides) {
    const Part collar = of(side, Part::left_clavicle);
    if (!rig.has(collar) || motion.frame_count() == 0) continue;
    const std::size_t joint = at(rig[collar].joint);
    const Quaternionf first = motion.pose(0).rotations[joint];
    constexpr std::int64_t kFrames = 500;
    const std::int64_t step = std::max<std::int64_t>(motion.frame_count() / kFrames, 1);
    for (std::int64_t frame = step; frame < motion.frame_count(); frame += step) {
      const Quaternionf turn = first.conjugate() * motion.pose(frame).rotations[joint];
      if (2 * std::atan2(turn.vec().norm(), std::abs(turn.w())) > kStill) return true;
    }
  }
  return false;
}

float ground_of(const Motion& motion, const RigMap& rig) {
  if (!rig.has(Part::left_foot) || !rig.has(Part::right_foot) || motion.frame_count() == 0) return 0;
  std::vector<float> heights;
  ModelPose pose;
  constexpr std::int64_t kFrames = 120;
  const std::int64_t step = std::max<std::int64_t>(motion.frame_count() / kFrames, 1);
  for (std::int64_t frame = 0; frame < motion.frame_count(); frame += step) {
    to_model_space(motion.skeleton(), motion.pose(frame), pose);
    const float low =
        std::min(position_of(rig[Part::left_foot], pose).y(), position_of(rig[Part::right_foot], pose).y());
    if (std::isfinite(low)) heights.push_back(low);
  }
  if (heights.empty()) return 0;
  const auto middle = heights.begin() + static_cast<std::ptrdiff_t>(heights.size() / 2);
  std::nth_element(heights.begin(), middle, heights.end());
  return *middle;
}

RetargetOptions options_for(const Motion& motion, const SignerModel& signer, const Character& character) {
  RetargetOptions options{.face_joints = motion.tracks().empty(), .collar_share = !collars_move(motion, signer.rig)};
  // An ankle is above the floor by the same fraction of the leg as the character's.
  const RigAxes axes(motion.skeleton(), signer.rig);
  const RigAxes own(*character.skeleton, character.rig);
  const float legs = leg_length(own, character.rig);
  const float source_legs = leg_length(axes, signer.rig);
  const float ankle = character.rig.has(Part::left_foot) ? own.place(Part::left_foot).y() : 0;
  if (legs > 0.05f && source_legs > 0.05f && signer.rig.has(Part::left_foot)) {
    options.ground = ground_of(motion, signer.rig) - ankle * source_legs / legs;
  }
  return options;
}

Retargeted retarget(const Motion& motion, const SignerModel& signer, const Character& character,
                    const RetargetOptions& options) {
  Retargeter retargeter(motion.skeleton(), signer, character, options);
  Retargeted result{Motion(character.skeleton, motion.rate(), motion.frame_count()), retargeter.notices()};
  for (std::int64_t frame = 0; frame < motion.frame_count(); ++frame) {
    retargeter.pose(motion.pose(frame), result.motion.pose(frame));
  }
  for (const ScalarTrack& track : motion.tracks()) result.motion.add_track(track);
  return result;
}

Retargeted retarget(const Motion& motion, const SignerModel& signer, const Character& character) {
  Retargeted result = retarget(motion, signer, character, options_for(motion, signer, character));
  keep_hemisphere(result.motion);
  return result;
}

}  // namespace signweave
