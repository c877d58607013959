#include "signweave/render/hand_meter.h"

#include <algorithm>
#include <cstring>
#include <limits>
#include <vector>

namespace signweave {
namespace {

using Eigen::Vector3f;

constexpr std::array<std::string_view, 4> kObstacleNames = {"trunk", "trunk", "head", "other hand"};

Side across_from(Side side) {
  return side == Side::left ? Side::right : Side::left;
}

/// The clearance of two hands if it is less than `most`, else `most`.
float clearance_within(float most, const HandShell& a, const HandShell& b) noexcept {
  if ((a.middle - b.middle).norm() - a.reach - b.reach >= most) return most;
  for (const Capsule& own : a.all()) {
    if (clearance(own, {b.middle, b.middle, b.reach}) >= most) continue;
    for (const Capsule& other : b.all()) most = std::min(most, clearance(own, other));
  }
  return most;
}

}  // namespace

std::string_view name_of(Obstacle obstacle) noexcept {
  return kObstacleNames[static_cast<std::size_t>(obstacle)];
}

bool is_held(const PosesView& poses, std::int64_t frame) noexcept {
  if (frame == 0) return false;
  const auto same = [](const auto& a, const auto& b) { return std::memcmp(a.data(), b.data(), a.size_bytes()) == 0; };
  const PoseView before = poses.pose(frame - 1);
  const PoseView now = poses.pose(frame);
  return same(before.rotations, now.rotations) && same(before.translations, now.translations);
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
  std::vector<JointIndex> all = joints;
  for (const Side side : kSides) {
    HandPlaces places(signer.rig, side);
    if (!places.has_wrist()) continue;
    places.add_joints(all);
    std::vector<JointIndex> own = joints;
    places.add_joints(own);
    hands_[static_cast<std::size_t>(side)].chains = JointChains(skeleton, own);
    hands_[static_cast<std::size_t>(side)].places = std::move(places);
  }
  chains_ = JointChains(skeleton, all);
}

void HandMeter::look(PoseView pose) {
  chains_.to_model_space(pose, pose_);
  look_at_body(pose_);
  for (const Side side : kSides) {
    if (has(side)) look_at_hand(pose_, side);
  }
}

void HandMeter::look(PoseView pose, Side side) {
  hand(side).chains.to_model_space(pose, pose_);
  look(pose_, side);
}

void HandMeter::look(const ModelPose& pose, Side side) {
  look_at_body(pose);
  look_at_hand(pose, side);
}

void HandMeter::look_at_body(const ModelPose& pose) {
  space_ = signer_space(*signer_->body, signer_->rig, pose);
  body_ = shell_of(*signer_->body, signer_->rig, space_, pose);
}

void HandMeter::look_at_hand(const ModelPose& pose, Side side) {
  Hand& own = hands_[static_cast<std::size_t>(side)];
  own.places->read(pose, own.points);
  const PartPlace& elbow = signer_->rig[of(side, Part::left_forearm)];
  std::optional<Vector3f> at_elbow;
  if (elbow.known()) at_elbow = position_of(elbow, pose);
  own.shell = shell_of(own.points, at_elbow, *signer_->body);
}

Contact HandMeter::touched(Side side, Contact known) const noexcept {
  const SignerBody& body = *signer_->body;
  const HandShell& shell = hand(side).shell;
  const auto asked = [&](Contact one) { return !signweave::has(known, one); };
  Contact touched = known;
  if (asked(Contact::hands) && has(across_from(side)) && touches(shell, hand(across_from(side)).shell, body)) {
    touched = touched | Contact::hands;
  }
  if (asked(Contact::head) && body_.head && touches(shell, *body_.head, body)) touched = touched | Contact::head;
  if (asked(Contact::torso) && (touches(shell, body_.torso[0], body) || touches(shell, body_.torso[1], body))) {
    touched = touched | Contact::torso;
  }
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
    if (is_held(poses, frame)) continue;
    look(poses.pose(frame));
    all = touched(side, all);
  }
  return all;
}

HandDepths HandMeter::deepest(PosesView poses, Side side) {
  HandDepths deepest;
  deepest.fill(-std::numeric_limits<float>::max());
  for (std::int64_t frame = 0; frame < poses.frames; ++frame) {
    if (is_held(poses, frame)) continue;
    look(poses.pose(frame), side);
    for (std::size_t i = 0; i < deepest.size(); ++i) {
      deepest[i] = std::max(deepest[i], -to(side, kBodyObstacles[i]).clearance);
    }
  }
  return deepest;
}

HandsMeeting HandMeter::meeting(PosesView poses) {
  HandsMeeting meeting;
  for (std::int64_t frame = 0; frame < poses.frames; ++frame) {
    if (is_held(poses, frame)) continue;
    look(poses.pose(frame));
    meet(meeting);
  }
  return meeting;
}

void HandMeter::meet(HandsMeeting& meeting) const noexcept {
  const float far = 2 * kContactGap * signer_->body->shoulder_width;
  const float nearest = std::min(far, -meeting.depth);
  meeting.depth = -clearance_within(nearest, hand(Side::right).shell, hand(Side::left).shell);
  const Vector3f across = space_.turn_to_signer(palm(Side::right) - palm(Side::left));
  meeting.crossed = std::max(meeting.crossed, across.x());
}

}  // namespace signweave
