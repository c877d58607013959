#include "signweave/inflection/stroke_changer.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "signweave/inflection/slots.h"
#include "signweave/inflection/turns.h"

namespace signweave {
namespace {

using inflection::of_vector;
using inflection::slot;

using Eigen::Quaternionf;
using Eigen::Vector3f;

/// The arm is solved again while its wrist is farther from its place than this. Metres.
constexpr float kExact = 2e-5f;
constexpr int kSolves = 4;

Quaternionf share_of(const Quaternionf& turn, float weight) {
  if (weight >= 1) return turn;
  return Quaternionf::Identity().slerp(weight, turn);
}

}  // namespace

StrokeChanger::StrokeChanger(const Skeleton& skeleton, std::shared_ptr<const SignerRig> rig)
    : skeleton_(&skeleton), rig_(std::move(rig)), meter_(skeleton, rig_->signer) {
  if (!rig_->signer.body || rig_->signer.body->trunk == kNoJoint) {
    why_not_ = why_no_signer_space(rig_->signer.rig);
    if (why_not_.empty()) why_not_ = "the signer's body cannot be measured";
    return;
  }
  for (const Side side : kSides) add_arm(side);
  if (!has(Side::left) && !has(Side::right))
    why_not_ = "no arm with shoulder, elbow and wrist: name them in a mapping file";
  std::vector<JointIndex> joints{rig_->signer.body->trunk};
  for (const Part part : {Part::left_upper_arm, Part::right_upper_arm, Part::head}) {
    if (rig_->signer.rig.has(part)) joints.push_back(rig_->signer.rig[part].joint);
  }
  for (const Side side : kSides) {
    if (meter_.has(side)) {
      const JointSet& read = meter_.joints(side);
      joints.insert(joints.end(), read.begin(), read.end());
    }
    if (has(side)) joints.push_back(arm(side).joints.wrist);
  }
  all_ = JointChains(skeleton, joints);
}

void StrokeChanger::add_arm(Side side) {
  const RigMap& rig = rig_->signer.rig;
  const PartPlace& shoulder = rig[of(side, Part::left_upper_arm)];
  const PartPlace& elbow = rig[of(side, Part::left_forearm)];
  const JointIndex wrist = rig_->groups.wrists[slot(side)];
  if (wrist == kNoJoint || !shoulder.known() || !elbow.known()) return;
  if (!is_above(*skeleton_, rig_->signer.body->trunk, shoulder.joint)) return;
  if (!is_above(*skeleton_, shoulder.joint, elbow.joint) || !is_above(*skeleton_, elbow.joint, wrist)) return;
  HandPlaces places(rig, side);
  if (!places.has_wrist()) return;
  std::vector<JointIndex> joints{wrist, rig_->signer.body->trunk, rig[Part::left_upper_arm].joint,
                                 rig[Part::right_upper_arm].joint};
  places.add_joints(joints);
  const bool has_index = rig.has(finger_part(side, Finger::index, FingerPoint::proximal)) &&
                         rig.has(finger_part(side, Finger::index, FingerPoint::tip));
  arms_[slot(side)] = Arm{.joints = {shoulder.joint, elbow.joint, wrist},
                          .places = std::move(places),
                          .has_index = has_index,
                          .chains = JointChains(*skeleton_, joints),
                          .below_shoulder = JointChains(*skeleton_, std::array{wrist}, shoulder.joint),
                          .points = {}};
}

StrokeSpace StrokeChanger::space_of(PoseView pose) {
  all_.to_model_space(pose, model_);
  const SignerSpace space = signer_space(body(), rig_->signer.rig, model_);
  return {.origin = space.origin, .model_from_signer = space.model_from_signer};
}

HandInSpace StrokeChanger::look(PoseView pose, const StrokeSpace& space, Side side) {
  Arm& own = arm(side);
  own.chains.to_model_space(pose, model_);
  own.places.read(model_, own.points);
  HandInSpace hand{.palm = space.to_signer(palm_of(own.points)),
                   .turn = space.model_from_signer.conjugate() * model_.rotations[slot(own.joints.wrist)],
                   .shoulder = space.to_signer(model_.positions[slot(own.joints.shoulder)]),
                   .elbow = space.to_signer(model_.positions[slot(own.joints.elbow)]),
                   .wrist = space.to_signer(model_.positions[slot(own.joints.wrist)])};
  if (own.has_index) {
    const RigMap& rig = rig_->signer.rig;
    hand.index_base =
        space.to_signer(position_of(rig[finger_part(side, Finger::index, FingerPoint::proximal)], model_));
    hand.index_tip = space.to_signer(position_of(rig[finger_part(side, Finger::index, FingerPoint::tip)], model_));
  }
  return hand;
}

/// Turns the trunk about the vertical through its joint. Leaves `model_` outdated.
void StrokeChanger::turn_trunk(float yaw, MutablePoseView pose) {
  const JointIndex trunk = body().trunk;
  const JointIndex parent = skeleton_->joint(trunk).parent;
  const Quaternionf above = parent == kNoJoint ? Quaternionf::Identity() : model_.rotations[slot(parent)];
  const Quaternionf turn(Eigen::AngleAxisf(yaw, Vector3f::UnitY()));
  set_in_hemisphere(pose.rotations[slot(trunk)], above.conjugate() * turn * model_.rotations[slot(trunk)]);
}

void StrokeChanger::update_below_shoulder(Side side, PoseView pose) {
  const JointIndex shoulder = arm(side).joints.shoulder;
  const JointIndex parent = skeleton_->joint(shoulder).parent;
  model_.rotations[slot(shoulder)] = model_.rotations[slot(parent)] * pose.rotations[slot(shoulder)];
  arm(side).below_shoulder.continue_below_top(pose, model_);
}

/// Returns how far the wrist is from its place.
float StrokeChanger::put(Side side, const Goal& goal, MutablePoseView pose) {
  const Arm& own = arm(side);
  const auto [shoulder, elbow, wrist] = own.joints;
  const Quaternionf hand = goal.turn * model_.rotations[slot(wrist)];
  const Vector3f place = goal.wanted + goal.turn * (model_.positions[slot(wrist)] - goal.palm);
  if (goal.carry.w() < 1) {
    const Quaternionf above = model_.rotations[slot(skeleton_->joint(shoulder).parent)];
    set_in_hemisphere(pose.rotations[slot(shoulder)],
                      above.conjugate() * goal.carry * model_.rotations[slot(shoulder)]);
    update_below_shoulder(side, pose);
  }
  float missed = 0;
  for (int solve = 0;; ++solve) {
    const Vector3f missing = place - model_.positions[slot(wrist)];
    missed = missing.norm();
    if (missed <= kExact || solve == kSolves) break;
    shift_wrist(*skeleton_, own.joints, model_, missing, pose);
    update_below_shoulder(side, pose);
  }
  if (goal.swivel != 0) {
    swivel_elbow(*skeleton_, own.joints, model_, goal.swivel, pose);
    update_below_shoulder(side, pose);
  }
  const Quaternionf above = model_.rotations[slot(skeleton_->joint(wrist).parent)];
  set_in_hemisphere(pose.rotations[slot(wrist)], above.conjugate() * hand);
  return missed;
}

StrokeChanger::Fit StrokeChanger::apply(const StrokeChange& change, const std::array<PathSpline, 2>& paths,
                                        const StrokeSpace& space, float weight, float time, MutablePoseView pose) {
  Fit fit;
  if (!(weight > 0)) return fit;
  all_.to_model_space(pose, model_);
  // Where the hands go depends on where they were captured, before the trunk turns.
  std::array<Goal, 2> goals;
  Vector3f middle = Vector3f::Zero();
  for (const Side side : kSides) {
    if (!change.arms[slot(side)] || !has(side)) continue;
    Arm& own = arm(side);
    own.places.read(model_, own.points);
    goals[slot(side)].palm = palm_of(own.points);
    middle += space.to_signer(goals[slot(side)].palm) / 2;
  }
  for (const Side side : kSides) {
    if (!change.arms[slot(side)] || !has(side)) continue;
    const ArmChange& asked = *change.arms[slot(side)];
    const PathPoint along = paths[slot(side)].at(time);
    Goal& goal = goals[slot(side)];
    const Vector3f palm = space.to_signer(goal.palm);
    const Vector3f& moved = change.together ? middle : palm;
    const Quaternionf turn = share_of(of_vector(along.turn) * asked.turn, weight);
    Vector3f to = asked.to + asked.linear * (moved - asked.from) + along.shift;
    to = moved + weight * (to - moved);
    if (change.together) to += turn * (palm - middle);
    goal.wanted = space.to_model(to);
    goal.turn = space.model_from_signer * turn * space.model_from_signer.conjugate();
    goal.carry = space.model_from_signer * share_of(asked.carry, weight) * space.model_from_signer.conjugate();
    goal.swivel = weight * (asked.swivel + along.swivel);
  }
  if (change.trunk_yaw != 0) {
    std::array<Quaternionf, 2> hands;
    std::array<Vector3f, 2> offsets;
    for (const Side side : kSides) {
      if (!has(side)) continue;
      const std::size_t wrist = slot(arm(side).joints.wrist);
      hands[slot(side)] = model_.rotations[wrist];
      offsets[slot(side)] = model_.positions[wrist];
    }
    turn_trunk(weight * change.trunk_yaw, pose);
    all_.to_model_space(pose, model_);
    for (const Side side : kSides) {
      if (!change.arms[slot(side)] || !has(side)) continue;
      // The hand turns as asked from where it was captured, not from where the trunk carried it.
      const std::size_t wrist = slot(arm(side).joints.wrist);
      Goal& goal = goals[slot(side)];
      const Quaternionf carried = model_.rotations[wrist] * hands[slot(side)].conjugate();
      goal.palm = model_.positions[wrist] + carried * (goal.palm - offsets[slot(side)]);
      goal.turn = goal.turn * carried.conjugate();
    }
  }
  for (const Side side : kSides) {
    if (change.arms[slot(side)] && has(side)) fit.missed[slot(side)] = put(side, goals[slot(side)], pose);
  }
  all_.to_model_space(pose, model_);
  return fit;
}

WristBend StrokeChanger::bend(Side side) const {
  if (!meter_.has_fingers(side)) return {};
  const Arm& own = arm(side);
  HandPoints points;
  own.places.read(model_, points);
  const Vector3f forearm = model_.positions[slot(own.joints.wrist)] - model_.positions[slot(own.joints.elbow)];
  return wrist_bend(forearm.normalized(), axes_of(points, side));
}

}  // namespace signweave
