#include "signweave/transition/body_guard.h"

#include <algorithm>
#include <cmath>

#include "signweave/transition/fade.h"
#include "signweave/transition/knots.h"

namespace signweave {
namespace {

using Eigen::Vector3f;

/// Maximum swivel of an elbow in one round. Radians.
constexpr float kMostSwivel = 0.3f;

/// Maximum distance, about a hand's breadth, by which a hand is moved out of the other. If that is not enough, as for
/// hands that were captured inside each other, it stays nearer to its generated position. Metres.
constexpr float kMostApart = 0.1f;

constexpr auto kOtherHand = static_cast<std::size_t>(Meeting::hand_hand);

/// Frames between two examined ones are skipped if the arm moves less than this, because it cannot be a millimetre
/// deeper there: this is the thickness of trunk, head and forearms, and of two fingers that pass each other. Metres.
constexpr float kPassedByBody = 0.025f;
constexpr float kPassedByFinger = 0.01f;
/// Maximum ratio of a trajectory's length to the straight line between two frames less than knot_stride apart.
constexpr float kLonger = 1.25f;

std::size_t at(JointIndex joint) {
  return static_cast<std::size_t>(joint);
}

}  // namespace

BodyGuard::BodyGuard(const Skeleton& skeleton, const SignerModel& signer, const JointGroups& groups)
    : skeleton_(&skeleton), scene_(skeleton, signer, groups) {
  for (const Side side : kSides) {
    if (scene_.has(side)) fingers_[static_cast<std::size_t>(side)] = FingerGuard(skeleton, signer.rig, side);
  }
}

BodyGuard::Knot BodyGuard::knot_at(std::int64_t frame) {
  Knot knot{.frame = frame};
  const ArmJoints& joints = scene_.joints(side_);
  const PoseView pose = scene_.pose_of(frame);
  knot.as_made = {pose.rotations[at(joints.shoulder)], pose.rotations[at(joints.elbow)],
                  pose.rotations[at(joints.wrist)]};
  knot.origin = scene_.origin(frame);
  const Side other = side_ == Side::left ? Side::right : Side::left;
  if (scene_.has(other)) knot.other = scene_.stored_place(other, frame).wrist;
  if (frame >= 0 && frame < gap_->count) {
    for (const Correction& correction : corrections_) apply(correction, frame);
  }
  look(knot);
  return knot;
}

void BodyGuard::look(Knot& knot) {
  knot.place = scene_.look(side_, knot.frame, knot.depths);
}

/// Computes the depths that the borders of a gap allow.
void BodyGuard::begin(const Gap& gap, Side side) {
  gap_ = &gap;
  side_ = side;
  const auto frames = static_cast<std::size_t>(gap.count + 2);
  corrections_.clear();
  corrections_.reserve(2 * kRounds);
  knots_.clear();
  knots_.reserve(frames);
  added_.reserve(frames);
  apart_.setZero();
  led_apart_ = 0;
  allowed_.fill(kDepthAllowed);
  wrists_[static_cast<std::size_t>(side)].begin(scene_, side);
  hand_reach_ = 0;
  for (const std::int64_t border : {std::int64_t{-1}, gap.count}) {
    const Knot& knot = knots_.emplace_back(knot_at(border));
    for (std::size_t meeting = 0; meeting < kMeetings; ++meeting) {
      allowed_[meeting] = std::max(allowed_[meeting], knot.depths[meeting].depth + kDepthAllowed);
    }
    hand_reach_ = std::max(hand_reach_, scene_.reach(side, border));
  }
  passing_ = (knots_[1].place.wrist - knots_[1].other) - (knots_[0].place.wrist - knots_[0].other);
}

/// True if a frame between two neighbouring knots may be too deep, and much deeper than both.
bool BodyGuard::may_hide(const Knot& a, const Knot& b) const {
  const Vector3f trunk = b.origin - a.origin;
  const Vector3f wrist = b.place.wrist - a.place.wrist;
  const Vector3f elbow = b.place.elbow - a.place.elbow;
  const float cosine = std::min(1.0f, std::abs(a.place.hand.dot(b.place.hand)));
  const float turned = 2 * std::sqrt(2 * (1 - cosine)) * hand_reach_;  // how far the rotation moves the fingertips
  for (std::size_t meeting = 0; meeting < kMeetings; ++meeting) {
    const Depth& here = a.depths[meeting];
    const Depth& there = b.depths[meeting];
    float moved = 0;
    if (meeting == kOtherHand) {
      moved = (wrist - (b.other - a.other)).norm();
    } else if (is_of_hand(meeting)) {
      moved = (wrist - trunk).norm();
    } else {
      const float along = std::max(here.along, there.along);
      moved = ((1 - along) * elbow + along * wrist - trunk).norm();
    }
    if (here.by_shape || there.by_shape) moved += turned;
    const float left = std::max(0.0f, allowed_[meeting] - here.depth) + std::max(0.0f, allowed_[meeting] - there.depth);
    if (kLonger * moved > left + (meeting == kOtherHand ? kPassedByFinger : kPassedByBody)) return true;
  }
  return false;
}

/// Adds knots until nothing can be hidden between them. Returns true if knots were added.
bool BodyGuard::refine() {
  return refine_knots(
      knots_, added_, knot_stride(gap_->rate), [this](std::int64_t frame) { return knot_at(frame); },
      [this](const Knot& a, const Knot& b) { return may_hide(a, b); });
}

/// The correction for the arm of a knot.
BodyGuard::Correction BodyGuard::correction_for(const Knot& deepest, float beyond, std::size_t meeting) {
  Correction correction{.peak = moment_of(*gap_, deepest.frame)};
  // Slightly more than needed; otherwise the rounds would only approach the goal.
  const float needed = beyond + 0.5f * kDepthAllowed;
  const Depth& depth = deepest.depths[meeting];
  if (meeting == kOtherHand) {
    // Fingers are thin: the nearest exit from one leads into the next, or back on the other side. So hands are moved
    // apart along the line between them, perpendicular to their relative motion, and keep that direction.
    if (apart_.isZero()) {
      const Side other = side_ == Side::left ? Side::right : Side::left;
      const Vector3f separation = scene_.palm(side_, deepest.frame, deepest.place) -
                                  scene_.palm(other, deepest.frame, scene_.stored_place(other, deepest.frame));
      const Vector3f along = passing_.norm() > 0.05f ? Vector3f(passing_.normalized()) : Vector3f::Zero();
      apart_ = separation - separation.dot(along) * along;
      apart_ = apart_.norm() > 0.01f ? Vector3f(apart_.normalized()) : depth.out;
    }
    const float step = std::min(needed, kMostApart - led_apart_);
    led_apart_ += step;
    correction.shift = step * apart_;
    return correction;
  }
  scene_.place(side_, deepest.frame);
  const Vector3f shoulder = scene_.pose().positions[at(scene_.joints(side_).shoulder)];
  const Vector3f line = (deepest.place.wrist - shoulder).normalized();
  // How far that point of the forearm moves per metre of wrist shift or per radian of elbow swivel.
  const float by_shift = std::max(depth.along, 0.5f);
  const Vector3f round = line.cross(deepest.place.elbow - shoulder);
  const float by_swivel = (1 - depth.along) * round.dot(depth.out);
  if (std::abs(by_swivel) > 0.5f * depth.along * round.norm() && std::abs(by_swivel) > 0.02f) {
    correction.swivel = std::clamp(needed / by_swivel, -kMostSwivel, kMostSwivel);
  } else {
    correction.shift = needed / by_shift * depth.out;
  }
  return correction;
}

/// Applies a correction to one frame, fading towards both borders.
void BodyGuard::apply(const Correction& correction, std::int64_t frame) {
  const MutablePoseView pose = scene_.made(frame);
  const float share = bump(moment_of(*gap_, frame), correction.peak);
  scene_.place(side_, frame);
  if (correction.swivel != 0) {
    swivel_elbow(*skeleton_, scene_.joints(side_), scene_.pose(), share * correction.swivel, pose);
  } else {
    shift_wrist(*skeleton_, scene_.joints(side_), scene_.pose(), share * correction.shift, pose);
  }
  wrists_[static_cast<std::size_t>(side_)].limit(scene_, frame);
}

void BodyGuard::restore(const Bent& bent, MutablePoseView pose) const {
  const ArmJoints& joints = scene_.joints(side_);
  pose.rotations[at(joints.shoulder)] = bent[0];
  pose.rotations[at(joints.elbow)] = bent[1];
  pose.rotations[at(joints.wrist)] = bent[2];
}

/// Finds the corrections and applies them to the knots. Returns true if there are any.
bool BodyGuard::lead_out() {
  // If not everything can be corrected, as when a whole arm passes through the trunk, at least the hand stays outside.
  for (const std::size_t meetings : {kMeetings, kOtherHand}) {
    std::size_t best = corrections_.size();  // number of corrections up to the least deep round
    float least = 0;
    bool first = true;
    for (int round = 0;;) {
      const Knot* worst = nullptr;
      std::size_t worst_meeting = 0;
      float beyond = 0;
      for (const Knot& knot : knots_) {
        for (std::size_t meeting = 0; meeting < meetings; ++meeting) {
          if (knot.depths[meeting].depth - allowed_[meeting] <= beyond) continue;
          beyond = knot.depths[meeting].depth - allowed_[meeting];
          worst = &knot;
          worst_meeting = meeting;
        }
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
      const Correction correction = correction_for(*worst, beyond, worst_meeting);
      if (correction.shift.isZero() && correction.swivel == 0) break;
      corrections_.push_back(correction);
      for (std::size_t i = 1; i + 1 < knots_.size(); ++i) {
        apply(corrections_.back(), knots_[i].frame);
        look(knots_[i]);
      }
    }
    if (best < corrections_.size()) {
      corrections_.resize(best);
      for (std::size_t i = 1; i + 1 < knots_.size(); ++i) {
        restore(knots_[i].as_made, scene_.made(knots_[i].frame));
        for (const Correction& correction : corrections_) apply(correction, knots_[i].frame);
        look(knots_[i]);
      }
    }
    if (!(least > 0)) break;
  }
  return !corrections_.empty();
}

bool BodyGuard::repair_arm(const Gap& gap, Side side, bool with_fingers, MutablePoses made) {
  begin(gap, side);
  bool bent = wrists_[static_cast<std::size_t>(side)].limit_all(scene_, gap);
  refine();
  if (lead_out()) {
    bent = true;
    for_each_between_knots(knots_, gap.count, [&](std::int64_t frame) {
      for (const Correction& correction : corrections_) apply(correction, frame);
    });
  }
  FingerGuard& fingers = fingers_[static_cast<std::size_t>(side)];
  if (with_fingers && fingers.known()) bent |= fingers.repair(gap, made);
  return bent;
}

bool BodyGuard::repair(const Gap& gap, GroupSet groups, MutablePoses made) {
  bool begun = false;
  bool bent = false;
  for (const Side side : kSides) {
    if (!scene_.has(side)) continue;
    if (!groups.has(arm_of(side))) {
      FingerGuard& fingers = fingers_[static_cast<std::size_t>(side)];
      if (groups.has(fingers_of(side)) && fingers.known()) bent |= fingers.repair(gap, made);
      continue;
    }
    if (!std::exchange(begun, true)) scene_.begin(gap, made);
    if (!repair_arm(gap, side, groups.has(fingers_of(side)), made)) continue;
    scene_.changed(side);
    bent = true;
  }
  return bent;
}

}  // namespace signweave
