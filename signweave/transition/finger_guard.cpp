#include "signweave/transition/finger_guard.h"

#include <algorithm>
#include <cmath>

#include "signweave/transition/arm_reach.h"
#include "signweave/transition/fade.h"
#include "signweave/transition/knots.h"

namespace signweave {
namespace {

using Eigen::Vector3f;

/// Maximum rotation of a hinge in one round. Radians.
constexpr float kMostTurn = 0.25f;
/// Preference for moving a finger sideways, relative to bending it.
constexpr float kAside = 0.5f;

/// Two fingers that move at least this far past each other between two frames may have passed through each other. With
/// less motion, they are deeper by less than a millimetre in between. Metres.
constexpr float kPassed = 0.012f;

/// Two fingers are on the same sides of each other in two frames if their exit directions have at least this cosine.
constexpr float kSameSide = 0.9f;

/// The peak of a bend keeps at least this share of the gap as distance from the borders.
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

void FingerGuard::read(PoseView pose) {
  chains_.to_model_space(pose, pose_);
  places_.front().read(pose_, points_);
  phalanges_of(points_, radii_, phalanges_);
}

/// Adds the smallest rotations about the hinges of one finger that displace its contact point by `direction`.
void FingerGuard::lead_out(const FingerCrossing::One& one, const Vector3f& direction, const HandAxes& axes,
                           Correction& correction) const {
  const std::array<JointIndex, 2>& joints = joints_[static_cast<std::size_t>(one.finger)];
  const float length = direction.norm();
  const Vector3f out = direction / length;
  const std::size_t first = correction.count;
  std::array<float, 3> gains;   // metres along `out` for each radian
  std::array<float, 3> gladly;  // preference for rotating it
  float sum = 1e-6f;
  const auto add = [&](JointIndex joint, const Vector3f& axis, float weight) {
    if (joint == kNoJoint) return;
    const auto parent = static_cast<std::size_t>(skeleton_->joint(joint).parent);
    const std::size_t i = correction.count - first;
    gains[i] = axis.cross(one.at - pose_.positions[static_cast<std::size_t>(joint)]).dot(out);
    gladly[i] = weight;
    sum += weight * gains[i] * gains[i];
    correction.hinges[correction.count++] = {joint, pose_.rotations[parent].conjugate() * axis, 0};
  };
  if (one.finger == Finger::thumb) {  // its first joint rotates about all axes
    if (joints[0] == kNoJoint) return;
    const Vector3f axis = (one.at - pose_.positions[static_cast<std::size_t>(joints[0])]).cross(out);
    if (axis.norm() > 1e-4f) add(joints[0], axis.normalized(), 1);
  } else {
    add(joints[0], axes.thumb, 1);
    add(joints[0], axes.palm, kAside);
    if (one.bone > 0) add(joints[1], axes.thumb, 1);
  }
  for (std::size_t i = 0; i < correction.count - first; ++i) {
    correction.hinges[first + i].angle = std::clamp(gladly[i] * gains[i] * length / sum, -kMostTurn, kMostTurn);
  }
}

/// Requires pose_ and points_ of the crossing's frame.
FingerGuard::Correction FingerGuard::correction_for(const FingerCrossing& crossing, Exit by) {
  const HandAxes axes = axes_of(points_, side_);
  Vector3f away = crossing.away.isZero() ? axes.palm : crossing.away;
  if (by != Exit::nearest) {
    Vector3f& first = away_[crossing.pair];
    if (first.isZero()) first = by == Exit::first ? away : Vector3f(-away);
    if (away.dot(first) < 0) away = first;
  }
  // Slightly more than needed; otherwise the rounds would only approach the goal.
  const Vector3f half = 0.5f * (crossing.beyond + 0.5f * kFingerDepthAllowed) * away;
  Correction correction;
  lead_out(crossing.a, half, axes, correction);
  lead_out(crossing.b, -half, axes, correction);
  return correction;
}

MutablePoseView FingerGuard::pose_of(std::int64_t frame) const noexcept {
  return pose_at(*skeleton_, made_, frame);
}

/// Applies a correction to one frame, fading towards both borders.
void FingerGuard::apply(const Correction& correction, std::int64_t frame) const {
  const MutablePoseView pose = pose_of(frame);
  const float share = bump(moment_of(*gap_, frame), correction.peak);
  for (std::size_t i = 0; i < correction.count; ++i) {
    const Hinge& hinge = correction.hinges[i];
    Eigen::Quaternionf& local = pose.rotations[static_cast<std::size_t>(hinge.joint)];
    set_in_hemisphere(local, Eigen::Quaternionf(Eigen::AngleAxisf(share * hinge.angle, hinge.axis)) * local);
  }
}

/// The knot of a generated frame.
FingerGuard::Knot FingerGuard::knot_at(std::int64_t frame) {
  Knot knot{.frame = frame, .as_made = kept_.size()};
  const MutablePoseView pose = pose_of(frame);
  for (const JointIndex joint : bent_) kept_.push_back(pose.rotations[static_cast<std::size_t>(joint)]);
  for (const Correction& correction : corrections_) apply(correction, frame);
  look(knot);
  return knot;
}

void FingerGuard::look(Knot& knot) {
  const bool inside = knot.frame >= 0 && knot.frame < gap_->count;
  read(inside ? PoseView(pose_of(knot.frame)) : knot.frame < 0 ? gap_->left() : gap_->right());
  for (std::size_t i = 0; i < knot.fingers.size(); ++i) {
    const Phalanges::One& finger = phalanges_.fingers[i];
    if (finger.end == finger.begin) continue;
    knot.fingers[i] = {phalanges_.bones[finger.end - 1].to, phalanges_.bones[(finger.begin + finger.end) / 2].from};
  }
  pairs_ = finger_pairs(phalanges_);
  for (std::size_t i = 0; i < pairs_.size(); ++i) {
    const FingerPair& pair = pairs_[i];
    knot.pairs[i] = {.depth = pair.depth};
    if (pair.depth < -kPassed) continue;
    knot.pairs[i].away = approach(phalanges_.bones[pair.a], phalanges_.bones[pair.b]).away;
  }
  knot.crossing = inside ? worst_crossing(phalanges_, pairs_, allowed_) : std::nullopt;
}

bool FingerGuard::may_hide(const Knot& a, const Knot& b) const {
  std::size_t pair = 0;
  for (std::size_t i = 0; i < kFingers.size(); ++i) {
    const Vector3f tip = b.fingers[i].tip - a.fingers[i].tip;
    const Vector3f joint = b.fingers[i].joint - a.fingers[i].joint;
    for (std::size_t k = i + 1; k < kFingers.size(); ++k, ++pair) {
      const PairState& before = a.pairs[pair];
      const PairState& after = b.pairs[pair];
      if (before.away.dot(after.away) > kSameSide) continue;
      const float moved = std::sqrt(std::max((tip - (b.fingers[k].tip - a.fingers[k].tip)).squaredNorm(),
                                             (joint - (b.fingers[k].joint - a.fingers[k].joint)).squaredNorm()));
      const float left = std::max(0.0f, allowed_[pair] - before.depth) + std::max(0.0f, allowed_[pair] - after.depth);
      if (moved > kPassed && moved > left) return true;
    }
  }
  return false;
}

bool FingerGuard::refine() {
  return refine_knots(
      knots_, added_, 2 * knot_stride(gap_->rate), [this](std::int64_t frame) { return knot_at(frame); },
      [this](const Knot& a, const Knot& b) { return may_hide(a, b); });
}

/// Finds corrections and applies them to the knots. `least` is the smallest excess depth so far, and is updated.
bool FingerGuard::lead_out(Exit by, float& least) {
  away_.fill(Vector3f::Zero());
  std::size_t best = corrections_.size();
  bool first = true;
  for (int round = 0;;) {
    const Knot* worst = nullptr;
    float beyond = 0;
    for (const Knot& knot : knots_) {
      if (!knot.crossing || knot.crossing->beyond <= beyond) continue;
      beyond = knot.crossing->beyond;
      worst = &knot;
    }
    if (first || beyond < least) {
      least = beyond;
      best = corrections_.size();
    }
    first = false;
    if (worst == nullptr) {
      if (!refine()) break;
      first = true;
      continue;
    }
    if (round++ == kRounds) break;
    read(pose_of(worst->frame));
    corrections_.push_back(correction_for(*worst->crossing, by));
    // Away from the borders, so that fingers do not snap there.
    corrections_.back().peak = std::clamp(moment_of(*gap_, worst->frame), kNearestPeak, 1 - kNearestPeak);
    for (std::size_t i = 1; i + 1 < knots_.size(); ++i) {
      apply(corrections_.back(), knots_[i].frame);
      look(knots_[i]);
    }
  }
  if (best < corrections_.size()) {
    corrections_.resize(best);
    for (std::size_t i = 1; i + 1 < knots_.size(); ++i) {
      const MutablePoseView pose = pose_of(knots_[i].frame);
      const Eigen::Quaternionf* kept = kept_.data() + knots_[i].as_made;
      for (const JointIndex joint : bent_) pose.rotations[static_cast<std::size_t>(joint)] = *kept++;
      for (const Correction& correction : corrections_) apply(correction, knots_[i].frame);
      look(knots_[i]);
    }
  }
  return least > 0;
}

bool FingerGuard::repair(const Gap& gap, MutablePoses made) {
  gap_ = &gap;
  made_ = made;
  const auto frames = static_cast<std::size_t>(gap.count + 2);
  knots_.clear();
  knots_.reserve(frames);
  added_.reserve(frames);
  kept_.clear();
  kept_.reserve(frames * bent_.size());
  corrections_.clear();
  corrections_.reserve(3 * kRounds);
  chains_.to_model_space(gap.left(), pose_);
  places_.front().read(pose_, points_);
  radii_ = finger_radii(points_);
  allowed_.fill(kFingerDepthAllowed);
  for (const std::int64_t border : {std::int64_t{-1}, gap.count}) {
    look(knots_.emplace_back(Knot{.frame = border}));
    const FingerDepths depths = finger_depths(pairs_);
    for (std::size_t i = 0; i < depths.size(); ++i) {
      allowed_[i] = std::max(allowed_[i], depths[i] + kFingerDepthAllowed);
    }
  }
  refine();
  float least = 0;
  for (const Exit by : {Exit::nearest, Exit::first, Exit::other}) {
    if (!lead_out(by, least)) break;
  }
  if (corrections_.empty()) return false;
  for_each_between_knots(knots_, gap.count, [&](std::int64_t frame) {
    for (const Correction& correction : corrections_) apply(correction, frame);
  });
  return true;
}

}  // namespace signweave
