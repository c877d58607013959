#include "signweave/transition/body_guard.h"

#include <algorithm>
#include <cmath>

#include "signweave/rig/signer_space.h"
#include "signweave/transition/fade.h"

namespace signweave {
namespace {

using Eigen::Vector3f;

/// An elbow is swivelled no farther in one round. Radians.
constexpr float kMostSwivel = 0.3f;

// Which depths are measured.
constexpr std::size_t kHands = 3;
constexpr std::size_t kForearm = 4;

std::size_t at(JointIndex joint) {
  return static_cast<std::size_t>(joint);
}

HandAxes turned(const HandAxes& axes, const Eigen::Quaternionf& by) {
  return {by * axes.fingers, by * axes.palm, by * axes.thumb};
}

}  // namespace

BodyGuard::BodyGuard(const Skeleton& skeleton, const SignerModel& signer, const JointGroups& groups)
    : skeleton_(&skeleton), signer_(&signer) {
  if (!signer.body) return;
  const RigMap& rig = signer.rig;
  std::array<std::vector<JointIndex>, 2> of_arm;
  for (const Side side : kSides) {
    Arm& arm = arms_[static_cast<std::size_t>(side)];
    arm.side = side;
    const JointIndex wrist = groups.wrists[static_cast<std::size_t>(side)];
    const PartPlace& shoulder = rig[of(side, Part::left_upper_arm)];
    const PartPlace& elbow = rig[of(side, Part::left_forearm)];
    if (wrist == kNoJoint || !shoulder.known() || !elbow.known()) continue;
    arm.joints = {shoulder.joint, elbow.joint, wrist};
    if (!is_above(skeleton, shoulder.joint, elbow.joint) || !is_above(skeleton, elbow.joint, wrist)) continue;
    HandPlaces hand(rig, side);
    if (!hand.has_wrist()) continue;
    std::vector<JointIndex>& joints = of_arm[static_cast<std::size_t>(side)];
    hand.add_joints(joints);
    joints.insert(joints.end(), {shoulder.joint, elbow.joint, wrist});
    hands_[static_cast<std::size_t>(side)] = JointChains(skeleton, joints);
    for (JointIndex joint = wrist; joint != elbow.joint; joint = skeleton.joint(joint).parent) {
      const auto moved = std::ranges::find(skeleton.translated_joints(), joint);
      const bool translated = moved != skeleton.translated_joints().end();
      arm.forearm.push_back(
          {joint, translated ? moved - skeleton.translated_joints().begin() : -1, skeleton.joint(joint).offset});
    }
    arm.hand = hand;
    arm.fingers = FingerGuard(skeleton, rig, side);
  }
  for (const Side side : kSides) {
    Arm& arm = arms_[static_cast<std::size_t>(side)];
    if (!arm.known()) continue;
    std::vector<JointIndex>& joints = of_arm[static_cast<std::size_t>(side)];
    for (const Part part :
         {Part::pelvis, Part::spine, Part::chest, Part::neck, Part::head, Part::head_top, Part::left_upper_arm,
          Part::right_upper_arm, Part::left_thigh, Part::right_thigh, Part::jaw, Part::left_eye, Part::right_eye}) {
      if (rig.has(part)) joints.push_back(rig[part].joint);
    }
    for (const Arm& each : arms_) {
      if (each.known()) joints.push_back(each.joints.wrist);
    }
    joints.push_back(signer.body->trunk);
    arm.chain = JointChains(skeleton, joints);
  }
}

/// Leaves in pose_ and points_ where the pose has this arm.
void BodyGuard::look_at(PoseView pose, const Arm& arm, Depths& depths) {
  arm.chain.to_model_space(pose, pose_);
  const SignerBody& signer = *signer_->body;
  const SignerSpace space = signer_space(signer, signer_->rig, pose_);
  const BodyShell body = shell_of(signer, signer_->rig, space, pose_);
  arm.hand->read(pose_, points_);
  const HandShell hand = shell_of(points_, pose_.positions[at(arm.joints.elbow)], signer);
  const Capsule ball{hand.middle, hand.middle, hand.reach};
  // Through the middle of a trunk forward is out.
  const auto out_of = [&](const Approach& near) {
    return near.away.isZero() ? Vector3f(space.model_from_signer * Vector3f::UnitZ()) : near.away;
  };
  const auto look = [&](const Capsule& part, Depth& deepest) {
    if (clearance(ball, part) > 0) return;
    for (const Capsule& bar : hand.all()) {
      const Approach near = approach(bar, part);
      if (-near.clearance > deepest.depth) deepest = {-near.clearance, out_of(near), 1};
    }
  };
  depths = {};
  look(body.torso[0], depths[0]);
  look(body.torso[1], depths[1]);
  if (body.head) look(*body.head, depths[2]);

  const Arm& other = arms_[1 - static_cast<std::size_t>(arm.side)];
  if (other.known()) {
    // As far as the other hand reaches is not known before it is looked at, but hands are alike.
    const float beside = 2.5f * hand.reach;
    if ((pose_.positions[at(other.joints.wrist)] - hand.middle).squaredNorm() < beside * beside) {
      hands_[static_cast<std::size_t>(other.side)].to_model_space(pose, pose_);
      other.hand->read(pose_, other_);
      const HandShell there = shell_of(other_, pose_.positions[at(other.joints.elbow)], signer);
      if ((there.middle - hand.middle).norm() < there.reach + hand.reach) {
        std::array<float, HandShell::kMostBars> sizes;  // of balls about this hand's bars
        for (std::size_t i = 0; i < hand.count; ++i) {
          sizes[i] = 0.5f * (hand.bars[i].to - hand.bars[i].from).norm() + hand.bars[i].radius;
        }
        for (const Capsule& bar : there.all()) {
          const float size = 0.5f * (bar.to - bar.from).norm() + bar.radius;
          if ((0.5f * (bar.from + bar.to) - hand.middle).norm() > size + hand.reach) continue;
          for (std::size_t i = 0; i < hand.count; ++i) {
            const float both = size + sizes[i];
            if ((bar.from + bar.to - hand.bars[i].from - hand.bars[i].to).squaredNorm() > 4 * both * both) continue;
            const Approach near = approach(hand.bars[i], bar);
            if (-near.clearance > depths[kHands].depth) depths[kHands] = {-near.clearance, near.away, 1};
          }
        }
        beside_ = palm_of(points_) - palm_of(other_);
      }
    }
  }

  const Capsule forearm = forearm_bar(pose_.positions[at(arm.joints.elbow)], hand.middle, signer);
  for (std::size_t i = 0; i < body.torso.size(); ++i) {
    const Approach near = approach(forearm, body.torso[i]);
    if (-near.clearance > 0) depths[kForearm + i] = {-near.clearance, out_of(near), near.along_a};
  }
}

/// From elbow to wrist, in the space of the wrist's joint; not of unit length.
Vector3f BodyGuard::forearm_of(PoseView pose, const Arm& arm) const {
  Vector3f way = Vector3f::Zero();  // from a joint of the chain to the wrist, in the space of its parent
  Eigen::Quaternionf turn = Eigen::Quaternionf::Identity();  // the wrist's, seen from there
  for (std::size_t i = 0; i < arm.forearm.size(); ++i) {
    const Link& link = arm.forearm[i];
    const Eigen::Quaternionf& local = pose.rotations[at(link.joint)];
    way = (link.translation < 0 ? link.offset : pose.translations[static_cast<std::size_t>(link.translation)]) +
          (i > 0 ? Vector3f(local * way) : Vector3f::Zero());
    turn = i > 0 ? local * turn : local;
  }
  return turn.conjugate() * way;
}

bool BodyGuard::limit_wrist(const Arm& arm, MutablePoseView pose) const {
  if (!limited_) return false;
  const Vector3f forearm = forearm_of(pose, arm);
  const float length = forearm.norm();
  Eigen::Quaternionf turn;
  if (!(length > 1e-4f) || !turn_within(limits_, forearm / length, axes_, turn)) return false;
  Eigen::Quaternionf& local = pose.rotations[at(arm.joints.wrist)];
  set_in_hemisphere(local, local * turn);
  return true;
}

/// What the borders of a gap allow.
void BodyGuard::set_limits(const Gap& gap, Arm& arm) {
  allowed_.fill(kDepthAllowed);
  passing_.setZero();
  apart_.setZero();
  limited_ = arm.hand->why_no_fingers().empty();
  const Arm& other = arms_[1 - static_cast<std::size_t>(arm.side)];
  std::array<HandPoints, 2> hands;
  std::array<HandAxes, 2> axes;
  std::array<Vector3f, 2> forearms;
  for (std::size_t border = 0; border < 2; ++border) {
    Depths depths;
    look_at(border == 0 ? gap.left() : gap.right(), arm, depths);
    for (std::size_t part = 0; part < depths.size(); ++part) {
      allowed_[part] = std::max(allowed_[part], depths[part].depth + kDepthAllowed);
    }
    const Eigen::Quaternionf to_joint = pose_.rotations[at(arm.joints.wrist)].conjugate();
    hands[border] = points_;
    if (limited_) axes[border] = turned(axes_of(points_, arm.side), to_joint);
    forearms[border] = to_joint * (points_.wrist - pose_.positions[at(arm.joints.elbow)]).normalized();
    if (!other.known()) continue;
    const Vector3f beside = points_.wrist - pose_.positions[at(other.joints.wrist)];
    passing_ = border == 0 ? Vector3f(-beside) : Vector3f(passing_ + beside);
  }
  if (!limited_) return;
  if (arm.fingers.known()) arm.fingers.set_borders(hands[0], hands[1]);
  // Where the bones of the palm move, the hand's axes are those between both borders.
  axes_.fingers = (axes[0].fingers + axes[1].fingers).normalized();
  const Vector3f palm = axes[0].palm + axes[1].palm;
  axes_.palm = (palm - palm.dot(axes_.fingers) * axes_.fingers).normalized();
  axes_.thumb = arm.side == Side::left ? axes_.palm.cross(axes_.fingers) : axes_.fingers.cross(axes_.palm);
  limits_ = human_wrist();
  for (const Vector3f& forearm : forearms) limits_ = widened(limits_, wrist_bend(forearm, axes_));
}

/// From pose_ and what else look_at left.
BodyGuard::Way BodyGuard::way_out(const Depth& deepest, bool of_hands, const Arm& arm) {
  // A little farther than needed, or the rounds would only come near.
  const float needed = deepest.depth + 0.5f * kDepthAllowed;
  if (of_hands) {
    // Fingers are thin: the nearest way out of one leads into the next, and back on the other side. Hands are led apart
    // as they lie beside each other, across the way on which they pass, and keep to that.
    if (apart_.isZero()) {
      const Vector3f along = passing_.norm() > 0.05f ? Vector3f(passing_.normalized()) : Vector3f::Zero();
      apart_ = beside_ - beside_.dot(along) * along;
      apart_ = apart_.norm() > 0.01f ? Vector3f(apart_.normalized()) : deepest.out;
    }
    return {.shift = needed * apart_};
  }
  const Vector3f shoulder = pose_.positions[at(arm.joints.shoulder)];
  const Vector3f line = (pose_.positions[at(arm.joints.wrist)] - shoulder).normalized();
  // How far that place of the forearm goes, for one metre of the wrist's way or one radian of the elbow's.
  const float by_shift = std::max(deepest.along, 0.5f);
  const Vector3f round = line.cross(pose_.positions[at(arm.joints.elbow)] - shoulder);
  const float by_swivel = (1 - deepest.along) * round.dot(deepest.out);
  if (std::abs(by_swivel) > 0.5f * deepest.along * round.norm() && std::abs(by_swivel) > 0.02f) {
    return {.swivel = std::clamp(needed / by_swivel, -kMostSwivel, kMostSwivel)};
  }
  return {.shift = needed / by_shift * deepest.out};
}

/// Bends an arm where it is deepest, and ever less towards both borders.
void BodyGuard::bend(const Gap& gap, const Arm& arm, const Way& way, float peak, MutablePoses made) {
  for (std::int64_t frame = 0; frame < gap.count; ++frame) {
    const MutablePoseView pose = pose_at(*skeleton_, made, frame);
    const float share = bump(moment_of(gap, frame), peak);
    hands_[static_cast<std::size_t>(arm.side)].to_model_space(pose, pose_);
    if (way.swivel != 0) {
      swivel_elbow(*skeleton_, arm.joints, pose_, share * way.swivel, pose);
    } else {
      shift_wrist(*skeleton_, arm.joints, pose_, share * way.shift, pose);
    }
    limit_wrist(arm, pose);
  }
}

bool BodyGuard::mend_arm(const Gap& gap, Arm& arm, bool with_fingers, MutablePoses made) {
  const std::array<JointIndex, 3> joints{arm.joints.shoulder, arm.joints.elbow, arm.joints.wrist};
  const auto each = [&](auto&& use) {
    for (std::int64_t frame = 0; frame < gap.count; ++frame) {
      const MutablePoseView pose = pose_at(*skeleton_, made, frame);
      Eigen::Quaternionf* kept = best_.data() + static_cast<std::size_t>(frame) * joints.size();
      for (const JointIndex joint : joints) use(pose.rotations[at(joint)], *kept++);
    }
  };
  set_limits(gap, arm);
  bool bent = false;
  for (std::int64_t frame = 0; frame < gap.count; ++frame) {
    bent |= limit_wrist(arm, pose_at(*skeleton_, made, frame));
  }
  bool crossed = false;  // of the fingers
  // Where not everything can be had, as when a whole arm passes through the trunk, the hand at least stays out of it.
  for (const std::size_t parts : {std::tuple_size_v<Depths>, kHands}) {
    bool best_is_last = true;
    float least = 0;
    for (int round = 0;; ++round) {
      std::int64_t worst = -1;
      std::size_t worst_part = 0;
      float beyond = 0;
      Depths here;
      for (std::int64_t frame = 0; frame < gap.count; ++frame) {
        look_at(pose_at(*skeleton_, made, frame), arm, here);
        if (parts > kHands && round == 0 && with_fingers && !crossed) {
          crossed = arm.fingers.known() && arm.fingers.crosses(points_);
        }
        for (std::size_t part = 0; part < parts; ++part) {
          if (here[part].depth - allowed_[part] <= beyond) continue;
          beyond = here[part].depth - allowed_[part];
          worst = frame;
          worst_part = part;
        }
      }
      best_is_last = round == 0 || beyond < least;
      if (best_is_last) least = beyond;
      if (worst < 0 || round == kRounds) break;
      bent = true;
      if (best_is_last) {
        best_.resize(std::max(best_.size(), static_cast<std::size_t>(gap.count) * joints.size()));
        each([](const Eigen::Quaternionf& now, Eigen::Quaternionf& kept) { kept = now; });
      }
      look_at(pose_at(*skeleton_, made, worst), arm, here);
      const Way way = way_out({beyond, here[worst_part].out, here[worst_part].along}, worst_part == kHands, arm);
      bend(gap, arm, way, moment_of(gap, worst), made);
    }
    if (!best_is_last) each([](Eigen::Quaternionf& now, const Eigen::Quaternionf& kept) { now = kept; });
    if (!(least > 0)) break;
  }
  return (crossed && arm.fingers.mend(gap, made)) || bent;
}

bool BodyGuard::mend(const Gap& gap, GroupSet groups, MutablePoses made) {
  bool bent = false;
  for (const Side side : kSides) {
    Arm& arm = arms_[static_cast<std::size_t>(side)];
    if (arm.known() && groups.has(arm_of(side))) bent |= mend_arm(gap, arm, groups.has(fingers_of(side)), made);
  }
  return bent;
}

}  // namespace signweave
