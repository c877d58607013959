#include "signweave/render/hand_meter.h"

#include <algorithm>
#include <limits>
#include <vector>

namespace signweave {
namespace {

using Eigen::Vector3f;

constexpr std::array<std::string_view, kObstacles> kObstacleNames = {"trunk", "trunk", "head", "other hand"};

Side across_from(Side side) {
  return side == Side::left ? Side::right : Side::left;
}

}  // namespace

std::string_view name_of(Obstacle obstacle) noexcept {
  return kObstacleNames[static_cast<std::size_t>(obstacle)];
}

HandMeter::HandMeter(const Skeleton& skeleton, const SignerModel& signer) {
  if (!signer.body) return;
  signer_ = &signer;
  std::vector<JointIndex> joints{signer.body->trunk};
  for (const Part part :
       {Part::pelvis, Part::neck, Part::head, Part::head_top, Part::left_eye, Part::right_eye, Part::left_upper_arm,
        Part::right_upper_arm, Part::left_forearm, Part::right_forearm, Part::left_thigh, Part::right_thigh}) {
    if (signer.rig.has(part)) joints.push_back(signer.rig[part].joint);
  }
  for (const Side side : kSides) {
    HandPlaces places(signer.rig, side);
    if (!places.has_wrist()) continue;
    places.add_joints(joints);
    hands_[static_cast<std::size_t>(side)].places = std::move(places);
  }
  chains_ = JointChains(skeleton, joints);
}

void HandMeter::look(PoseView pose) {
  chains_.to_model_space(pose, pose_);
  const RigMap& rig = signer_->rig;
  space_ = signer_space(*signer_->body, rig, pose_);
  body_ = shell_of(*signer_->body, rig, space_, pose_);
  for (const Side side : kSides) {
    Hand& hand = hands_[static_cast<std::size_t>(side)];
    if (!hand.places) continue;
    hand.places->read(pose_, hand.points);
    const PartPlace& elbow = rig[of(side, Part::left_forearm)];
    std::optional<Vector3f> at_elbow;
    if (elbow.known()) at_elbow = position_of(elbow, pose_);
    hand.shell = shell_of(hand.points, at_elbow, *signer_->body);
  }
}

Contact HandMeter::touched(Side side) const noexcept {
  const SignerBody& body = *signer_->body;
  const HandShell& shell = hand(side).shell;
  Contact touched = Contact::none;
  if (has(across_from(side)) && touches(shell, hand(across_from(side)).shell, body)) touched = touched | Contact::hands;
  if (body_.head && touches(shell, *body_.head, body)) touched = touched | Contact::head;
  if (touches(shell, body_.torso[0], body) || touches(shell, body_.torso[1], body)) touched = touched | Contact::torso;
  return touched;
}

Approach HandMeter::to(Side side, Obstacle obstacle) const noexcept {
  const HandShell& shell = hand(side).shell;
  Approach found{.clearance = std::numeric_limits<float>::max()};
  if (obstacle == Obstacle::other_hand) {
    if (has(across_from(side))) found = approach(shell, hand(across_from(side)).shell);
  } else if (obstacle == Obstacle::head) {
    if (body_.head) found = approach(shell, *body_.head);
  } else {
    found = approach(shell, body_.torso[static_cast<std::size_t>(obstacle)]);
  }
  if (found.away.isZero()) found.away = space_.model_from_signer * Vector3f::UnitZ();  // on an axis: forward
  return found;
}

Contact HandMeter::touched(PosesView poses, Side side) {
  Contact all = Contact::none;
  for (std::int64_t frame = 0; frame < poses.frames; ++frame) {
    look(poses.pose(frame));
    all = all | touched(side);
  }
  return all;
}

HandDepths HandMeter::deepest(PosesView poses, Side side) {
  HandDepths deepest;
  deepest.fill(-std::numeric_limits<float>::max());
  for (std::int64_t frame = 0; frame < poses.frames; ++frame) {
    look(poses.pose(frame));
    for (std::size_t i = 0; i < kObstacles; ++i) {
      deepest[i] = std::max(deepest[i], -to(side, static_cast<Obstacle>(i)).clearance);
    }
  }
  return deepest;
}

HandsMeeting HandMeter::meeting(PosesView poses) {
  constexpr float kNever = -std::numeric_limits<float>::max();
  HandsMeeting meeting{.depth = kNever, .crossed = kNever};
  for (std::int64_t frame = 0; frame < poses.frames; ++frame) {
    look(poses.pose(frame));
    meeting.depth = std::max(meeting.depth, -to(Side::right, Obstacle::other_hand).clearance);
    const Vector3f across = space_.turn_to_signer(palm(Side::right) - palm(Side::left));
    meeting.crossed = std::max(meeting.crossed, across.x());
  }
  return meeting;
}

}  // namespace signweave
