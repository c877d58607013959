#include "signweave/features/point_track.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "signweave/features/point_sum.h"
#include "signweave/features/smoothing.h"

namespace signweave {

Facing facing_of(const Eigen::Vector3f& direction) noexcept {
  if (direction.isZero() || !direction.allFinite()) return Facing::unknown;
  Eigen::Index axis = 0;
  direction.cwiseAbs().maxCoeff(&axis);
  const bool ahead = direction[axis] > 0;
  if (axis == 0) return ahead ? Facing::left : Facing::right;
  if (axis == 1) return ahead ? Facing::up : Facing::down;
  return ahead ? Facing::forward : Facing::back;
}

PointFrame point_of(const HandFrame& hand) noexcept {
  return {.position = hand.position,
          .velocity = hand.velocity,
          .acceleration = hand.acceleration.norm(),
          .state = {.openness = hand.openness,
                    .contact = hand.contact,
                    .palm = facing_of(hand.palm),
                    .fingers = facing_of(hand.fingers)}};
}

PointOver over(std::span<const PointFrame> frames, FrameRate rate, float shoulder_width) noexcept {
  assert(!frames.empty());
  PointSum sum;
  for (const PointFrame& frame : frames) sum.add(frame);
  return sum.over(rate, shoulder_width);
}

std::vector<PointTrack> track_points(const Motion& motion, const SignerModel& model, std::span<const Part> parts,
                                     FrameRange range) {
  std::vector<PointTrack> tracks(parts.size());
  range = clamp(range, motion.frame_count());
  if (range.empty() || !model.body || !why_no_signer_space(model.rig).empty()) return tracks;
  const SignerBody& body = *model.body;
  std::vector<JointIndex> joints = {model.rig[Part::left_upper_arm].joint, model.rig[Part::right_upper_arm].joint,
                                    body.trunk};
  for (const Part part : parts) {
    if (model.rig.has(part)) joints.push_back(model.rig[part].joint);
  }
  std::erase(joints, kNoJoint);
  const JointChains chains(motion.skeleton(), joints);
  const Smoother smoother(kSmoothing, motion.rate(), motion.frame_count());
  const FrameRange seen = smoother.window(range);
  std::vector<std::vector<Eigen::Vector3f>> paths(parts.size());
  ModelPose pose;
  for (std::int64_t frame = seen.begin; frame < seen.end; ++frame) {
    chains.to_model_space(motion.pose(frame), pose);
    const SignerSpace space = signer_space(body, model.rig, pose);
    for (std::size_t i = 0; i < parts.size(); ++i) {
      const PartPlace& place = model.rig[parts[i]];
      if (place.known()) paths[i].push_back(space.to_signer(position_of(place, pose)));
    }
  }
  for (std::size_t i = 0; i < parts.size(); ++i) {
    if (paths[i].empty()) continue;
    tracks[i].reserve(static_cast<std::size_t>(range.size()));
    for (std::int64_t frame = range.begin; frame < range.end; ++frame) {
      const PathDerivatives at = smoother.at(frame, paths[i], seen.begin);
      tracks[i].push_back({.position = paths[i][static_cast<std::size_t>(frame - seen.begin)],
                           .velocity = at.velocity * body.shoulder_width,
                           .acceleration = at.acceleration.norm() * body.shoulder_width});
    }
  }
  return tracks;
}

}  // namespace signweave
