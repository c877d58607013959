#include "signweave/evaluation/hand_tracks.h"

#include <algorithm>

namespace signweave {
namespace {

JointChains chains_of(const Skeleton& skeleton, const SignerModel& signer, const std::array<HandPlaces, 2>& places) {
  std::vector<JointIndex> joints;
  for (const Part part : {Part::pelvis, Part::neck, Part::head, Part::head_top, Part::left_eye, Part::right_eye,
                          Part::left_upper_arm, Part::right_upper_arm, Part::left_forearm, Part::right_forearm}) {
    if (signer.rig.has(part)) joints.push_back(signer.rig[part].joint);
  }
  if (signer.body) joints.push_back(signer.body->trunk);
  for (const HandPlaces& hand : places) hand.add_joints(joints);
  return {skeleton, joints};
}

/// The deepest point of any bar of a hand inside head or trunk.
float depth_of(const HandShell& hand, const BodyShell& body) {
  float depth = 0;
  const auto look = [&](const Capsule& part) {
    for (const Capsule& bar : hand.all()) depth = std::max(depth, -clearance(bar, part));
  };
  for (const Capsule& part : body.torso) look(part);
  if (body.head) look(*body.head);
  return depth;
}

}  // namespace

HandTracker::HandTracker(const Skeleton& skeleton, const SignerModel& signer)
    : signer_(&signer),
      places_{HandPlaces(signer.rig, Side::left), HandPlaces(signer.rig, Side::right)},
      chains_(chains_of(skeleton, signer, places_)) {}

void HandTracker::track(PosesView poses, HandTracks& out) {
  for (HandTrack& hand : out) {
    hand.wrist.clear();
    hand.seen.clear();
    hand.depth.clear();
    for (std::vector<Eigen::Vector3f>& tip : hand.tips) tip.clear();
  }
  for (std::int64_t frame = 0; frame < poses.frames; ++frame) {
    chains_.to_model_space(poses.pose(frame), pose_);
    std::optional<BodyShell> body;
    SignerSpace space;
    if (signer_->body) {
      space = signer_space(*signer_->body, signer_->rig, pose_);
      body = shell_of(*signer_->body, signer_->rig, space, pose_);
    }
    for (const Side side : kSides) {
      const HandPlaces& places = places_[static_cast<std::size_t>(side)];
      if (!places.has_wrist()) continue;
      HandTrack& hand = out[static_cast<std::size_t>(side)];
      places.read(pose_, points_);
      hand.wrist.push_back(points_.wrist);
      const PartPlace& wrist = signer_->rig[of(side, Part::left_hand)];
      const Eigen::Quaternionf wrist_from_model = pose_.rotations[static_cast<std::size_t>(wrist.joint)].conjugate();
      for (std::size_t finger = 0; finger < kFingers.size(); ++finger) {
        const HandPoints::OneFinger& one = points_.fingers[finger];
        if (one.count > 0) hand.tips[finger].push_back(wrist_from_model * (one.points[one.count - 1] - points_.wrist));
      }
      if (!body) continue;
      hand.seen.push_back(space.unit * space.to_signer(points_.wrist));
      const PartPlace& elbow = signer_->rig[of(side, Part::left_forearm)];
      const HandShell shell =
          shell_of(points_, elbow.known() ? std::optional(position_of(elbow, pose_)) : std::nullopt, *signer_->body);
      hand.depth.push_back(depth_of(shell, *body));
    }
  }
}

}  // namespace signweave
