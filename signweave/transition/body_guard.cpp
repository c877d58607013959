#include "signweave/transition/body_guard.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "signweave/motion/turn_between.h"
#include "signweave/rig/signer_space.h"

namespace signweave {
namespace {

/// An elbow is neither bent nor stretched farther than this by being shifted. Radians between the bones.
constexpr float kMostBent = 0.5f;
constexpr float kMostStretched = 3.1f;

bool is_above(const Skeleton& skeleton, JointIndex upper, JointIndex lower) {
  for (JointIndex joint = skeleton.joint(lower).parent; joint != kNoJoint; joint = skeleton.joint(joint).parent) {
    if (joint == upper) return true;
  }
  return false;
}

/// 1 at `peak`, 0 at both ends of [0, 1], level at all three.
float bump(float t, float peak) {
  const float x = t < peak ? t / peak : (1 - t) / (1 - peak);
  const float clamped = std::clamp(x, 0.0f, 1.0f);
  return clamped * clamped * (3 - 2 * clamped);
}

}  // namespace

BodyGuard::BodyGuard(const Skeleton& skeleton, const SignerModel& signer, const JointGroups& groups)
    : skeleton_(&skeleton), signer_(&signer) {
  if (!signer.body) return;
  const RigMap& rig = signer.rig;
  std::vector<JointIndex> looked_at;
  for (const Side side : kSides) {
    Arm& arm = arms_[static_cast<std::size_t>(side)];
    const PartPlace& shoulder = rig[of(side, Part::left_upper_arm)];
    const PartPlace& elbow = rig[of(side, Part::left_forearm)];
    arm.wrist = groups.wrists[static_cast<std::size_t>(side)];
    if (arm.wrist == kNoJoint || !shoulder.known() || !elbow.known()) continue;
    arm.shoulder = shoulder.joint;
    arm.elbow = elbow.joint;
    if (!is_above(skeleton, arm.shoulder, arm.elbow) || !is_above(skeleton, arm.elbow, arm.wrist)) continue;
    HandPlaces hand(rig, side);
    if (!hand.has_wrist()) continue;
    hand.add_joints(looked_at);
    arm.hand = hand;
    looked_at.insert(looked_at.end(), {arm.shoulder, arm.elbow, arm.wrist});
  }
  if (!arms_[0].known() && !arms_[1].known()) return;
  for (const Part part :
       {Part::pelvis, Part::spine, Part::chest, Part::neck, Part::head, Part::head_top, Part::left_upper_arm,
        Part::right_upper_arm, Part::left_thigh, Part::right_thigh, Part::jaw, Part::left_eye, Part::right_eye}) {
    if (rig.has(part)) looked_at.push_back(rig[part].joint);
  }
  looked_at.push_back(signer.body->trunk);
  chains_ = JointChains(skeleton, looked_at);
}

BodyGuard::Depths BodyGuard::depths_at(PoseView pose, const Arm& arm) {
  chains_.to_model_space(pose, pose_);
  const SignerSpace space = signer_space(*signer_->body, signer_->rig, pose_);
  const BodyShell body = shell_of(*signer_->body, signer_->rig, space, pose_);
  arm.hand->read(pose_, points_);
  const HandShell hand = shell_of(points_, pose_.positions[static_cast<std::size_t>(arm.elbow)], *signer_->body);
  const auto look = [&](const Capsule& part) {
    Depth deepest;
    const Capsule ball{hand.middle, hand.middle, hand.reach};
    if (clearance(ball, part) > 0) return deepest;
    for (const Capsule& bar : hand.all()) {
      const Approach near = approach(bar, part);
      if (-near.clearance > deepest.depth) deepest = {-near.clearance, near.away};
    }
    // Through the middle of a trunk forward is out.
    if (deepest.depth > 0 && deepest.out.isZero()) deepest.out = space.model_from_signer * Eigen::Vector3f::UnitZ();
    return deepest;
  };
  return {look(body.torso[0]), look(body.torso[1]), body.head ? look(*body.head) : Depth{}};
}

void BodyGuard::shift(const Arm& arm, const Eigen::Vector3f& by, MutablePoseView pose) {
  chains_.to_model_space(pose, pose_);
  const auto at = [](JointIndex joint) { return static_cast<std::size_t>(joint); };
  const Eigen::Vector3f shoulder = pose_.positions[at(arm.shoulder)];
  const Eigen::Vector3f upper = pose_.positions[at(arm.elbow)] - shoulder;
  const Eigen::Vector3f fore = pose_.positions[at(arm.wrist)] - pose_.positions[at(arm.elbow)];
  const float a = upper.norm();
  const float b = fore.norm();
  if (a < 1e-4f || b < 1e-4f) return;
  // Between the bones, seen from the elbow.
  const float angle = std::acos(std::clamp(-upper.dot(fore) / (a * b), -1.0f, 1.0f));
  const auto distance_at = [&](float between) {
    return std::sqrt(std::max(0.0f, a * a + b * b - 2 * a * b * std::cos(between)));
  };
  const Eigen::Vector3f goal = upper + fore + by;  // from the shoulder
  const float farthest = distance_at(std::max(kMostStretched, angle));
  const float nearest = distance_at(std::min(kMostBent, angle));
  const float distance = std::clamp(goal.norm(), nearest, farthest);
  if (distance < 1e-4f || goal.norm() < 1e-4f) return;
  const float wanted = std::acos(std::clamp((a * a + b * b - distance * distance) / (2 * a * b), -1.0f, 1.0f));
  Eigen::Vector3f axis = upper.cross(fore);  // turning the forearm about it bends the elbow more
  if (axis.norm() < 1e-4f * a * b) axis = upper.cross(goal);
  if (axis.norm() < 1e-6f) axis = upper.unitOrthogonal();
  axis.normalize();
  const Eigen::Quaternionf bend(Eigen::AngleAxisf(angle - wanted, axis));
  const Eigen::Vector3f reached = upper + bend * fore;
  const Eigen::Quaternionf turn = turn_between(reached, goal);

  const auto parent_rotation = [&](JointIndex joint) -> Eigen::Quaternionf {
    const JointIndex parent = skeleton_->joint(joint).parent;
    return parent == kNoJoint ? Eigen::Quaternionf::Identity() : pose_.rotations[at(parent)];
  };
  const auto set = [&](JointIndex joint, Eigen::Quaternionf local) {
    local.normalize();
    Eigen::Quaternionf& now = pose.rotations[at(joint)];
    if (now.dot(local) < 0) local.coeffs() *= -1.0f;
    now = local;
  };
  const Eigen::Quaternionf before_elbow = parent_rotation(arm.elbow);
  const Eigen::Quaternionf before_wrist = parent_rotation(arm.wrist);
  set(arm.shoulder, parent_rotation(arm.shoulder).conjugate() * turn * pose_.rotations[at(arm.shoulder)]);
  set(arm.elbow, before_elbow.conjugate() * bend * pose_.rotations[at(arm.elbow)]);
  set(arm.wrist, (turn * bend * before_wrist).conjugate() * pose_.rotations[at(arm.wrist)]);
}

bool BodyGuard::mend_arm(const Gap& gap, const Arm& arm, MutablePoses made) {
  const std::size_t joints = skeleton_->joint_count();
  const std::size_t moved = skeleton_->translation_count();
  const auto pose = [&](std::int64_t frame) {
    const auto at = static_cast<std::size_t>(frame);
    return MutablePoseView{made.rotations.subspan(at * joints, joints), made.translations.subspan(at * moved, moved)};
  };
  const Depths left = depths_at(gap.left(), arm);
  const Depths right = depths_at(gap.right(), arm);
  bool bent = false;
  for (int round = 0; round < kRounds; ++round) {
    std::int64_t worst = -1;
    Depth deepest;  // beyond what is allowed
    for (std::int64_t frame = 0; frame < gap.count; ++frame) {
      const Depths here = depths_at(pose(frame), arm);
      for (std::size_t part = 0; part < here.size(); ++part) {
        const float beyond = here[part].depth - std::max(left[part].depth, right[part].depth) - kDepthAllowed;
        if (beyond <= deepest.depth) continue;
        deepest = {beyond, here[part].out};
        worst = frame;
      }
    }
    if (worst < 0) return bent;
    bent = true;
    // A little farther than needed, or the rounds would only come near.
    const Eigen::Vector3f by = (deepest.depth + 0.5f * kDepthAllowed) * deepest.out;
    const auto count = static_cast<float>(gap.count + 1);
    const float peak = static_cast<float>(worst + 1) / count;
    for (std::int64_t frame = 0; frame < gap.count; ++frame) {
      shift(arm, bump(static_cast<float>(frame + 1) / count, peak) * by, pose(frame));
    }
  }
  return bent;
}

bool BodyGuard::mend(const Gap& gap, GroupSet groups, MutablePoses made) {
  bool bent = false;
  for (const Side side : kSides) {
    const Arm& arm = arms_[static_cast<std::size_t>(side)];
    if (arm.known() && groups.has(arm_of(side))) bent |= mend_arm(gap, arm, made);
  }
  return bent;
}

}  // namespace signweave
