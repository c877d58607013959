#include "signweave/transition/finger_guard.h"

#include <algorithm>
#include <cmath>

#include "signweave/transition/arm_reach.h"
#include "signweave/transition/fade.h"

namespace signweave {
namespace {

using Eigen::Vector3f;

/// A hinge turns no farther in one round. Radians.
constexpr float kMostTurn = 0.25f;
/// How gladly a finger goes aside, where 1 is how gladly it bends.
constexpr float kAside = 0.5f;

/// The bend is greatest no nearer to a border than this share of the gap.
constexpr float kNearestPeak = 0.2f;

}  // namespace

FingerGuard::FingerGuard(const Skeleton& skeleton, const RigMap& rig, Side side) : side_(side) {
  const HandPlaces places(rig, side);
  if (!places.has_wrist() || !places.why_no_fingers().empty()) return;
  const JointIndex wrist = rig[of(side, Part::left_hand)].joint;
  std::vector<JointIndex> looked_at;
  places.add_joints(looked_at);
  for (const JointIndex joint : looked_at) {
    if (joint != wrist && !is_above(skeleton, wrist, joint)) return;
  }
  skeleton_ = &skeleton;
  places_.push_back(places);
  chains_ = JointChains(skeleton, looked_at, wrist);
  for (const Finger finger : kFingers) {
    std::array<JointIndex, 2>& joints = joints_[static_cast<std::size_t>(finger)];
    joints.fill(kNoJoint);
    std::size_t known = 0;
    std::size_t point =
        static_cast<std::size_t>(finger == Finger::thumb ? FingerPoint::metacarpal : FingerPoint::proximal);
    for (; point < kFingerPoints && known < joints.size(); ++point) {
      const PartPlace& place = rig[finger_part(side, finger, static_cast<FingerPoint>(point))];
      if (!place.known() || !place.offset.isZero()) continue;
      joints[known++] = place.joint;
      bent_.push_back(place.joint);
    }
  }
}

void FingerGuard::set_borders(const HandPoints& left, const HandPoints& right) noexcept {
  radii_ = finger_radii(left);
  phalanges_of(left, radii_, phalanges_);
  allowed_ = finger_depths(phalanges_);
  phalanges_of(right, radii_, phalanges_);
  const FingerDepths other = finger_depths(phalanges_);
  for (std::size_t i = 0; i < allowed_.size(); ++i) allowed_[i] = std::max(allowed_[i], other[i]) + kFingerDepthAllowed;
}

bool FingerGuard::crosses(const HandPoints& hand) noexcept {
  phalanges_of(hand, radii_, phalanges_);
  return worst_crossing(phalanges_, allowed_, 0).has_value();
}

void FingerGuard::read(PoseView pose) {
  chains_.to_model_space(pose, pose_);
  places_.front().read(pose_, points_);
  phalanges_of(points_, radii_, phalanges_);
}

/// Turns about the hinges of one finger so that it goes some way where it is touched, the least turns that do.
void FingerGuard::lead_out(const FingerCrossing::One& one, const Vector3f& way, const HandAxes& axes,
                           Hinges& hinges) const {
  const std::array<JointIndex, 2>& joints = joints_[static_cast<std::size_t>(one.finger)];
  const float length = way.norm();
  const Vector3f out = way / length;
  const std::size_t first = hinges.count;
  std::array<float, 3> gains;   // metres along `out` for each radian
  std::array<float, 3> gladly;  // how gladly it turns
  float sum = 1e-6f;
  const auto add = [&](JointIndex joint, const Vector3f& axis, float weight) {
    if (joint == kNoJoint) return;
    const auto parent = static_cast<std::size_t>(skeleton_->joint(joint).parent);
    const std::size_t i = hinges.count - first;
    gains[i] = axis.cross(one.at - pose_.positions[static_cast<std::size_t>(joint)]).dot(out);
    gladly[i] = weight;
    sum += weight * gains[i] * gains[i];
    hinges.all[hinges.count++] = {joint, pose_.rotations[parent].conjugate() * axis, 0};
  };
  if (one.finger == Finger::thumb) {  // its first joint turns every way
    if (joints[0] == kNoJoint) return;
    const Vector3f axis = (one.at - pose_.positions[static_cast<std::size_t>(joints[0])]).cross(out);
    if (axis.norm() > 1e-4f) add(joints[0], axis.normalized(), 1);
  } else {
    add(joints[0], axes.thumb, 1);
    add(joints[0], axes.palm, kAside);
    if (one.bone > 0) add(joints[1], axes.thumb, 1);
  }
  for (std::size_t i = 0; i < hinges.count - first; ++i) {
    hinges.all[first + i].angle = std::clamp(gladly[i] * gains[i] * length / sum, -kMostTurn, kMostTurn);
  }
}

/// From pose_ and points_ of the crossing's frame.
FingerGuard::Hinges FingerGuard::way_out(const FingerCrossing& crossing, Way by) {
  const HandAxes axes = axes_of(points_, side_);
  Vector3f away = crossing.away.isZero() ? axes.palm : crossing.away;
  if (by != Way::nearest) {
    Vector3f& first = away_[crossing.pair];
    if (first.isZero()) first = by == Way::first ? away : Vector3f(-away);
    if (away.dot(first) < 0) away = first;
  }
  // A little farther than needed, or the rounds would only come near.
  const Vector3f half = 0.5f * (crossing.beyond + 0.5f * kFingerDepthAllowed) * away;
  Hinges hinges;
  lead_out(crossing.a, half, axes, hinges);
  lead_out(crossing.b, -half, axes, hinges);
  return hinges;
}

FingerGuard::Worst FingerGuard::look(const Gap& gap, MutablePoses made) {
  Worst worst;
  for (std::int64_t frame = 0; frame < gap.count; ++frame) {
    read(pose_at(*skeleton_, made, frame));
    if (const auto crossing = worst_crossing(phalanges_, allowed_, worst.crossing.beyond)) worst = {frame, *crossing};
  }
  return worst;
}

bool FingerGuard::mend(const Gap& gap, Way by, float& least, MutablePoses made) {
  const auto each = [&](auto&& use) {
    for (std::int64_t frame = 0; frame < gap.count; ++frame) {
      const MutablePoseView pose = pose_at(*skeleton_, made, frame);
      Eigen::Quaternionf* kept = best_.data() + static_cast<std::size_t>(frame) * bent_.size();
      for (const JointIndex joint : bent_) use(pose.rotations[static_cast<std::size_t>(joint)], *kept++);
    }
  };
  away_.fill(Vector3f::Zero());
  bool best_is_last = true;
  int round = 0;
  for (;; ++round) {
    const Worst worst = look(gap, made);
    best_is_last = round == 0 || worst.crossing.beyond < least;
    if (best_is_last) least = worst.crossing.beyond;
    if (worst.frame < 0 || round == kRounds) break;
    if (best_is_last) {
      best_.resize(std::max(best_.size(), static_cast<std::size_t>(gap.count) * bent_.size()));
      each([](const Eigen::Quaternionf& now, Eigen::Quaternionf& kept) { kept = now; });
    }
    read(pose_at(*skeleton_, made, worst.frame));
    const Hinges hinges = way_out(worst.crossing, by);
    // Not so near a border that fingers would snap there.
    const float peak = std::clamp(moment_of(gap, worst.frame), kNearestPeak, 1 - kNearestPeak);
    for (std::int64_t frame = 0; frame < gap.count; ++frame) {
      const MutablePoseView pose = pose_at(*skeleton_, made, frame);
      const float share = bump(moment_of(gap, frame), peak);
      for (std::size_t i = 0; i < hinges.count; ++i) {
        const Hinge& hinge = hinges.all[i];
        Eigen::Quaternionf& local = pose.rotations[static_cast<std::size_t>(hinge.joint)];
        set_in_hemisphere(local, Eigen::Quaternionf(Eigen::AngleAxisf(share * hinge.angle, hinge.axis)) * local);
      }
    }
  }
  if (!best_is_last) each([](Eigen::Quaternionf& now, const Eigen::Quaternionf& kept) { now = kept; });
  return round > 0;
}

bool FingerGuard::mend(const Gap& gap, MutablePoses made) {
  bool bent = false;
  float least = 0;
  for (const Way by : {Way::nearest, Way::first, Way::other}) {
    bent |= mend(gap, by, least, made);
    if (!(least > 0)) break;
  }
  return bent;
}

}  // namespace signweave
