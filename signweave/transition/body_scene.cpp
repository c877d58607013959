#include "signweave/transition/body_scene.h"

#include <algorithm>
#include <limits>

#include "signweave/rig/signer_space.h"
#include "signweave/transition/fade.h"

namespace signweave {
namespace {

using Eigen::Vector3f;

std::size_t joint_slot(JointIndex joint) {
  return static_cast<std::size_t>(joint);
}

/// Reach of a hand from its wrist with all fingers extended.
float max_reach_of(const HandPoints& hand, const CapsuleRow& bars, float from_wrist) {
  float most = from_wrist;
  float thickest = 0;
  for (std::size_t i = 0; i < bars.count; ++i) thickest = std::max(thickest, bars.radius[i]);
  for (const HandPoints::OneFinger& finger : hand.fingers) {
    if (finger.count == 0) continue;
    float length = (finger.points[0] - hand.wrist).norm();
    for (std::size_t k = 1; k < finger.count; ++k) length += (finger.points[k] - finger.points[k - 1]).norm();
    most = std::max(most, length + thickest);
  }
  return most;
}

}  // namespace

BodyScene::BodyScene(const Skeleton& skeleton, const SignerModel& signer, const JointGroups& groups)
    : skeleton_(&skeleton), signer_(&signer) {
  if (!signer.body) return;
  const RigMap& rig = signer.rig;
  std::vector<JointIndex> trunk{signer.body->trunk};
  for (const Part part :
       {Part::pelvis, Part::spine, Part::chest, Part::neck, Part::head, Part::head_top, Part::left_upper_arm,
        Part::right_upper_arm, Part::left_thigh, Part::right_thigh, Part::jaw, Part::left_eye, Part::right_eye}) {
    if (rig.has(part)) trunk.push_back(rig[part].joint);
  }
  for (const Side side : kSides) {
    const JointIndex wrist = groups.wrists[static_cast<std::size_t>(side)];
    const PartPlace& shoulder = rig[of(side, Part::left_upper_arm)];
    const PartPlace& elbow = rig[of(side, Part::left_forearm)];
    if (wrist == kNoJoint || !shoulder.known() || !elbow.known()) continue;
    if (!is_above(skeleton, shoulder.joint, elbow.joint) || !is_above(skeleton, elbow.joint, wrist)) continue;
    HandPlaces hand(rig, side);
    const JointIndex above = skeleton.joint(shoulder.joint).parent;
    if (!hand.has_wrist() || above == kNoJoint) continue;
    std::vector<JointIndex> in_hand{wrist};
    hand.add_joints(in_hand);
    // A finger that is not a descendant of the wrist has no shape of its own.
    if (!std::ranges::all_of(in_hand,
                             [&](JointIndex joint) { return joint == wrist || is_above(skeleton, wrist, joint); })) {
      continue;
    }
    Arm& arm = arms_[static_cast<std::size_t>(side)];
    arm.joints = {shoulder.joint, elbow.joint, wrist};
    arm.above = above;
    for (JointIndex joint = wrist; joint != elbow.joint; joint = skeleton.joint(joint).parent) {
      const auto moved = std::ranges::find(skeleton.translated_joints(), joint);
      const bool translated = moved != skeleton.translated_joints().end();
      arm.forearm.push_back(
          {joint, translated ? moved - skeleton.translated_joints().begin() : -1, skeleton.joint(joint).offset});
    }
    arm.hand = hand;
    arm.chain = JointChains(skeleton, std::array{wrist}, above);
    arm.fingers = JointChains(skeleton, in_hand, wrist);
    trunk.push_back(above);
  }
  trunk_ = JointChains(skeleton, trunk);
}

void BodyScene::begin(const Gap& gap, MutablePoses made) {
  gap_ = &gap;
  made_ = made;
  const auto frames = static_cast<std::size_t>(gap.count + 2);
  bodies_.begin(frames);
  for (const Side side : kSides) {
    const auto s = static_cast<std::size_t>(side);
    hands_[s].begin(frames);
    places_[s].begin(frames);
    if (!has(side)) continue;
    const Hand& hand = hand_of(side, -1);
    max_reach_[s] = max_reach_of(hand.points, hand.bars, hand.from_wrist);
  }
}

void BodyScene::changed(Side side) {
  const auto frames = static_cast<std::size_t>(gap_->count + 2);
  hands_[static_cast<std::size_t>(side)].begin(frames);
  places_[static_cast<std::size_t>(side)].begin(frames);
}

PoseView BodyScene::pose_of(std::int64_t frame) const noexcept {
  return frame < 0 ? gap_->left() : frame < gap_->count ? PoseView(made(frame)) : gap_->right();
}

MutablePoseView BodyScene::made(std::int64_t frame) const noexcept {
  return pose_at(*skeleton_, made_, frame);
}

const BodyScene::Body& BodyScene::body_of(std::int64_t frame) {
  if (const Body* const known = bodies_.find(frame)) return *known;
  Body& body = bodies_.add(frame);
  trunk_.to_model_space(pose_of(frame), pose_);
  const SignerSpace space = signer_space(*signer_->body, signer_->rig, pose_);
  body.shell = shell_of(*signer_->body, signer_->rig, space, pose_);
  body.origin = space.origin;
  body.forward = space.model_from_signer * Vector3f::UnitZ();
  for (std::size_t s = 0; s < 2; ++s) {
    if (!arms_[s].hand) continue;
    body.above_rotation[s] = pose_.rotations[joint_slot(arms_[s].above)];
    body.above_position[s] = pose_.positions[joint_slot(arms_[s].above)];
  }
  return body;
}

const BodyScene::Hand& BodyScene::hand_of(Side side, std::int64_t frame) {
  Known<Hand>& hands = hands_[static_cast<std::size_t>(side)];
  if (const Hand* const known = hands.find(frame)) return *known;
  // Without fingers, one bar depends on the forearm, which may be corrected, so it is recomputed each time.
  Hand& hand = has_fingers(side) ? hands.add(frame) : bars_[static_cast<std::size_t>(side)];
  const Arm& of = arm(side);
  const PoseView pose = pose_of(frame);
  of.fingers.to_model_space(pose, in_hand_);
  of.hand->read(in_hand_, hand.points);
  std::optional<Vector3f> elbow;  // used if there are no fingers
  if (!has_fingers(side)) elbow = hand.points.wrist - forearm(side, frame);
  const HandShell shell = shell_of(hand.points, elbow, *signer_->body);
  hand.from_wrist = shell.reach;
  hand.middle.setZero();
  for (const Capsule& bar : shell.all()) hand.middle += bar.to;
  hand.middle = 0.5f * (hand.points.wrist + hand.middle / static_cast<float>(shell.count));
  hand.reach = 0;
  hand.bars.clear();
  for (const Capsule& bar : shell.all()) {
    hand.bars.add(bar);
    hand.reach = std::max(
        {hand.reach, (bar.from - hand.middle).norm() + bar.radius, (bar.to - hand.middle).norm() + bar.radius});
  }
  return hand;
}

ArmPlace BodyScene::place(Side side, std::int64_t frame) {
  const Arm& of = arm(side);
  const Body& body = body_of(frame);
  pose_.rotations[joint_slot(of.above)] = body.above_rotation[static_cast<std::size_t>(side)];
  pose_.positions[joint_slot(of.above)] = body.above_position[static_cast<std::size_t>(side)];
  of.chain.continue_below_top(pose_of(frame), pose_);
  return {pose_.positions[joint_slot(of.joints.elbow)], pose_.positions[joint_slot(of.joints.wrist)],
          pose_.rotations[joint_slot(of.joints.wrist)]};
}

const ArmPlace& BodyScene::stored_place(Side side, std::int64_t frame) {
  Known<ArmPlace>& places = places_[static_cast<std::size_t>(side)];
  if (const ArmPlace* const known = places.find(frame)) return *known;
  const ArmPlace here = place(side, frame);
  return places.add(frame) = here;
}

Vector3f BodyScene::forearm(Side side, std::int64_t frame) const {
  const PoseView pose = pose_of(frame);
  Vector3f to_wrist = Vector3f::Zero();  // from a joint of the chain to the wrist, in the space of its parent
  Eigen::Quaternionf turn = Eigen::Quaternionf::Identity();  // the wrist's rotation in that space
  const std::vector<Link>& links = arm(side).forearm;
  for (std::size_t i = 0; i < links.size(); ++i) {
    const Link& link = links[i];
    const Eigen::Quaternionf& local = pose.rotations[joint_slot(link.joint)];
    to_wrist = (link.translation < 0 ? link.offset : pose.translations[static_cast<std::size_t>(link.translation)]) +
               (i > 0 ? Vector3f(local * to_wrist) : Vector3f::Zero());
    turn = i > 0 ? local * turn : local;
  }
  return turn.conjugate() * to_wrist;
}

/// Depth of the hand in one part of the body.
Depth BodyScene::hand_in(const Capsule& part, Side side, std::int64_t frame, const ArmPlace& here) {
  const float far = clearance({here.wrist, here.wrist, max_reach_[static_cast<std::size_t>(side)]}, part);
  if (far > 0) return {.depth = -far};
  const Hand& hand = hand_of(side, frame);
  const Vector3f middle = here.wrist + here.hand * hand.middle;
  const float near = clearance({middle, middle, hand.reach}, part);
  if (near > 0) return {.depth = -near, .by_shape = true};
  // In the space of the wrist.
  const Eigen::Quaternionf back = here.hand.conjugate();
  const Capsule local{back * (part.from - here.wrist), back * (part.to - here.wrist), part.radius};
  CapsuleRow::Numbers clear;
  clearances(local, hand.bars, 0, clear);
  const auto nearest = static_cast<std::size_t>(
      std::min_element(clear.begin(), clear.begin() + static_cast<std::ptrdiff_t>(hand.bars.count)) - clear.begin());
  const Approach approached = approach(hand.bars[nearest], local);
  return {.depth = -approached.clearance, .out = here.hand * approached.away, .by_shape = true};
}

/// Depth of the hand in the other hand.
Depth BodyScene::hand_in_hand(Side side, std::int64_t frame, const ArmPlace& here) {
  const Side other_side = side == Side::left ? Side::right : Side::left;
  if (!has(other_side)) return {.depth = -1};
  const ArmPlace& other = stored_place(other_side, frame);
  const float far = (here.wrist - other.wrist).norm() - max_reach_[0] - max_reach_[1];
  if (far > 0) return {.depth = -far};
  const Hand& hand = hand_of(side, frame);
  const Hand& there = hand_of(other_side, frame);
  // The other hand in the space of this one's wrist.
  const Eigen::Quaternionf back = here.hand.conjugate();
  const Eigen::Quaternionf turned = back * other.hand;
  const ArmPlace seen{.wrist = back * (other.wrist - here.wrist)};
  const Vector3f ball = seen.wrist + turned * there.middle;
  const float near = (hand.middle - ball).norm() - hand.reach - there.reach;
  if (near > 0) return {.depth = -near, .by_shape = true};
  const CapsuleRow bars = moved(there.bars, turned.toRotationMatrix(), seen.wrist);
  float least = std::numeric_limits<float>::max();
  std::size_t own = 0;
  std::size_t other_bar = 0;
  CapsuleRow::Numbers clear;
  // The distance to the bounding sphere of the other hand is a lower bound for its bars.
  CapsuleRow::Numbers at_least;
  clearances({ball, ball, there.reach}, hand.bars, 0, at_least);
  for (std::size_t i = 0; i < hand.bars.count; ++i) {
    if (at_least[i] >= least) continue;
    clearances(hand.bars[i], bars, 0, clear);
    for (std::size_t k = 0; k < bars.count; ++k) {
      if (clear[k] >= least) continue;
      least = clear[k];
      own = i;
      other_bar = k;
    }
  }
  const Approach approached = approach(hand.bars[own], bars[other_bar]);
  return {.depth = -approached.clearance, .out = here.hand * approached.away, .by_shape = true};
}

ArmPlace BodyScene::look(Side side, std::int64_t frame, Depths& depths) {
  const Body& body = body_of(frame);
  const ArmPlace here = place(side, frame);
  // On the axis of the trunk, forward is the way out.
  const auto out_of = [&](const Vector3f& away) { return away.isZero() ? body.forward : away; };
  const Capsule forearm = forearm_bar(here.elbow, here.wrist, *signer_->body);
  for (std::size_t i = 0; i < body.shell.torso.size(); ++i) {
    depths[i] = hand_in(body.shell.torso[i], side, frame, here);
    depths[i].out = out_of(depths[i].out);
    const Approach near = approach(forearm, body.shell.torso[i]);
    depths[static_cast<std::size_t>(Meeting::forearm_left_trunk) + i] = {
        .depth = -near.clearance, .out = out_of(near.away), .along = near.along_a};
  }
  Depth& head = depths[static_cast<std::size_t>(Meeting::hand_head)];
  head = body.shell.head ? hand_in(*body.shell.head, side, frame, here) : Depth{.depth = -1};
  head.out = out_of(head.out);
  depths[static_cast<std::size_t>(Meeting::hand_hand)] = hand_in_hand(side, frame, here);
  return here;
}

}  // namespace signweave
