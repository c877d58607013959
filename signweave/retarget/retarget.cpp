#include "signweave/retarget/retarget.h"

#include "signweave/retarget/angles.h"
#include "signweave/rig/joint_at.h"

#include <algorithm>
#include <cmath>

namespace signweave {
namespace {

using Eigen::Quaternionf;
using Eigen::Vector3f;

/// The limits of the ratio between the character's signing space and the reach of its arms.
constexpr float kLeastRatio = 0.88f;
constexpr float kMostRatio = 1.14f;
/// An arm that would be extended beyond the first fraction of its length takes the source's extension, fully at the
/// second.
constexpr float kExtendedFrom = 0.90f;
constexpr float kExtendedTo = 1.0f;
/// A foot closer to its goal than the first distance is not moved; beyond the second it is moved fully. Metres.
constexpr float kFootFrom = 0.0005f;
constexpr float kFootTo = 0.004f;
/// Proportions of a head: the position of the eyes above and in front of the head's joint. (Drillis and Contini's
/// proportions, and ours.)
constexpr float kHeadTopOfJoint = 1.1f;  // chin to top, relative to joint to top
constexpr float kHeadOfEyesToTop = 2;    // eyes are halfway up a head
constexpr float kEyesUp = 0.45f;
constexpr float kEyesForward = 0.40f;

float bone(const RigAxes& axes, const RigMap& rig, Part from, Part to) {
  return rig.has(from) && rig.has(to) ? (axes.place(to) - axes.place(from)).norm() : 0;
}
float arm_length(const RigAxes& axes, const RigMap& rig, Side side) {
  return bone(axes, rig, of(side, Part::left_upper_arm), of(side, Part::left_forearm)) +
         bone(axes, rig, of(side, Part::left_forearm), of(side, Part::left_hand));
}
/// Returns the length from the wrist along the middle finger's bones; the index finger's if there is no middle one.
float hand_length(const RigAxes& axes, const RigMap& rig, Side side) {
  for (const Finger finger : {Finger::middle, Finger::index}) {
    Part last = of(side, Part::left_hand);
    float sum = 0;
    for (const FingerPoint point : {FingerPoint::proximal, FingerPoint::intermediate, FingerPoint::distal}) {
      const Part part = finger_part(side, finger, point);
      if (!rig.has(part)) break;
      sum += bone(axes, rig, last, part);
      last = part;
    }
    if (last == finger_part(side, finger, FingerPoint::distal)) return sum;
  }
  return 0;
}

/// Returns the head in the space of its joint.
std::optional<HeadSpace> head_space(const RigAxes& axes, const RigMap& rig) {
  if (!rig.has(Part::head)) return std::nullopt;
  HeadSpace head;
  head.turn = axes.trunk();
  const Vector3f joint = axes.place(Part::head);
  const bool eyes = rig.has(Part::left_eye) && rig.has(Part::right_eye);
  float top = rig.has(Part::head_top) ? (axes.place(Part::head_top) - joint).dot(head.turn * Vector3f::UnitX()) : 0;
  const Vector3f between =
      eyes ? Vector3f(0.5f * (axes.place(Part::left_eye) + axes.place(Part::right_eye)) - joint) : Vector3f(0, 0, 0);
  if (top < 0.05f) top = eyes ? std::max(2.0f * between.norm(), 0.1f) : 0;
  if (top < 0.05f) return std::nullopt;
  head.size = eyes ? kHeadOfEyesToTop * std::max(top - between.dot(head.turn * Vector3f::UnitX()), 0.04f)
                   : kHeadTopOfJoint * top;
  head.eyes = eyes ? between : Vector3f(head.turn * Vector3f(kEyesUp * top, 0, -kEyesForward * top));
  return head;
}

HeadSpace moved(const HeadSpace& head, JointIndex joint, const ModelPose& pose) {
  const Quaternionf& turn = pose.rotations[at(joint)];
  return {pose.positions[at(joint)] + turn * head.eyes, turn * head.turn, head.size};
}

}  // namespace

Retargeter::Retargeter(const Skeleton& source, const SignerModel& signer, const Character& character,
                       const RetargetOptions& options)
    : source_(source),
      signer_(signer),
      character_(&character),
      options_(options),
      source_axes_(source_, signer_.rig),
      axes_(*character.skeleton, character.rig),
      drives_(drives_of(source_, signer_.rig, source_axes_, character, axes_)),
      surface_(character, axes_) {
  const RigMap& rig = character.rig;
  for (const std::string& line : drives_.missing) notices_.push_back({.where = {}, .text = line});
  if (!options_.face_joints) {
    for (const Part part : {Part::jaw, Part::left_eye, Part::right_eye}) {
      if (rig.has(part)) drives_.joints[at(rig[part].joint)] = {};
    }
  }
  const float legs = leg_length(axes_, rig);
  const float source_legs = leg_length(source_axes_, signer_.rig);
  if (legs > 0.05f && source_legs > 0.05f) scale_ = legs / source_legs;
  for (const Side side : kSides) {
    const bool known = signer_.rig.has(of(side, Part::left_thigh)) && signer_.rig.has(of(side, Part::left_shin)) &&
                       signer_.rig.has(of(side, Part::left_foot));
    if (known) legs_[static_cast<std::size_t>(side)] = CharacterLeg::make(character, axes_, side);
  }
  float arms = 0;
  float source_arms = 0;
  for (const Side side : kSides) {
    const auto i = static_cast<std::size_t>(side);
    const bool known = signer_.rig.has(of(side, Part::left_upper_arm)) &&
                       signer_.rig.has(of(side, Part::left_forearm)) && signer_.rig.has(of(side, Part::left_hand));
    if (!known) continue;
    if (options_.collar_share || !drives_.collar[i]) collars_[i] = CharacterCollar::make(character, axes_, side);
    arms_[i] = CharacterArm::make(character, axes_, side);
    if (!arms_[i]) continue;
    arms += arm_length(axes_, rig, side);
    source_arms += arm_length(source_axes_, signer_.rig, side);
    fingers_[i].emplace(character, signer_.rig, side);
    const float hand = hand_length(axes_, rig, side);
    const float source_hand = hand_length(source_axes_, signer_.rig, side);
    if (hand > 0.02f && source_hand > 0.02f) hand_scale_ = hand / source_hand;
  }
  if (signer_.body && character.body && source_arms > 0.05f) {
    unit_ratio_ = std::clamp(character.body->shoulder_width / signer_.body->shoulder_width,
                             kLeastRatio * arms / source_arms, kMostRatio * arms / source_arms);
  } else if (options_.place_hands) {
    notices_.push_back({.where = {}, .text = "no signing space: the arms follow only the bones' directions"});
    options_.place_hands = false;
  }
  head_ = head_space(axes_, rig);
  source_head_ = head_space(source_axes_, signer_.rig);
  if (head_ && character.eyes.squaredNorm() > 0) {
    head_->eyes = character.eyes - axes_.place(Part::head);
    head_->size = kHeadOfEyesToTop * (character.height - character.eyes.y());
  }
  // Undriven joints keep their rotation relative to their parents, however those are posed. Clavicles are posed with
  // the arm.
  for (std::size_t i = 0; i < character.skeleton->joint_count(); ++i) loose_.push_back(!drives_.joints[i].driven());
  for (const Side side : kSides) {
    const PartPlace& collar = rig[of(side, Part::left_clavicle)];
    if (!collar.known()) continue;
    for (const JointIndex joint :
         path_between(*character.skeleton, collar.joint, rig[of(side, Part::left_upper_arm)].joint)) {
      loose_[at(joint)] = false;
    }
  }
  // The character's soles are at y = 0 at rest; a source's ankles are assumed to be equally high relative to its legs.
  if (rig.has(Part::left_foot)) ankle_ = axes_.place(Part::left_foot).y();
  source_ankle_ = ankle_ / scale_;
  to_model_space(source_, Pose(source_).view(), from_);
  to_model_space(*character.skeleton, Pose(*character.skeleton).view(), to_);
}

float Retargeter::lowest_ankle(const RigMap& rig, const ModelPose& pose) noexcept {
  float lowest = 1e9f;
  for (const Part part : {Part::left_foot, Part::right_foot}) {
    if (rig.has(part)) lowest = std::min(lowest, position_of(rig[part], pose).y());
  }
  return lowest;
}

void Retargeter::turn_joints() noexcept {
  const Skeleton& skeleton = *character_->skeleton;
  for (std::size_t i = 0; i < skeleton.joint_count(); ++i) {
    const Joint& joint = skeleton.joints()[i];
    if (drives_.joints[i].driven()) {
      to_.rotations[i] = drives_.joints[i].turn(from_).normalized();
    } else {
      const Quaternionf still = character_->still_turn(i);
      to_.rotations[i] = joint.parent == kNoJoint ? still : to_.rotations[at(joint.parent)] * still;
    }
    to_.positions[i] = joint.parent == kNoJoint
                           ? joint.offset
                           : Vector3f(to_.positions[at(joint.parent)] + to_.rotations[at(joint.parent)] * joint.offset);
  }
}

void Retargeter::put_root() noexcept {
  const RigMap& rig = character_->rig;
  const auto middle = [](const RigMap& map, const ModelPose& pose) {
    if (map.has(Part::left_thigh) && map.has(Part::right_thigh)) {
      return Vector3f(0.5f * (position_of(map[Part::left_thigh], pose) + position_of(map[Part::right_thigh], pose)));
    }
    return map.has(Part::pelvis) ? position_of(map[Part::pelvis], pose) : pose.positions[0];
  };
  const Vector3f hips = middle(signer_.rig, from_);
  const Vector3f goal = scale_ * (hips - Vector3f(0, options_.ground, 0));
  Vector3f shift = goal - middle(rig, to_);
  // The lower foot is as high above the floor as the source's.
  const float ankle = lowest_ankle(rig, to_);
  const float source_ankle = lowest_ankle(signer_.rig, from_);
  if (ankle < 1e8f) {
    const float above = source_ankle < 1e8f ? source_ankle - options_.ground - source_ankle_ : 0;
    shift.y() = ankle_ + scale_ * above - ankle;
  }
  for (Vector3f& place : to_.positions) place += shift;
}

void Retargeter::solve_legs() noexcept {
  for (const Side side : kSides) {
    const std::optional<CharacterLeg>& leg = legs_[static_cast<std::size_t>(side)];
    if (!leg) continue;
    const Part foot = of(side, Part::left_foot);
    Vector3f goal = scale_ * position_of(signer_.rig[foot], from_);
    goal.y() = ankle_ + scale_ * (position_of(signer_.rig[foot], from_).y() - options_.ground - source_ankle_);
    const Vector3f current = position_of(character_->rig[foot], to_);
    const float weight = smooth_step((goal - current).norm(), kFootFrom, kFootTo);
    leg->solve(*character_->skeleton, current + weight * (goal - current), to_);
  }
}

void Retargeter::solve_arms() noexcept {
  const Skeleton& skeleton = *character_->skeleton;
  std::array<std::optional<TwoHands>, 2> hands;
  PlacedBody source = {.rig = &signer_.rig, .pose = &from_, .body = signer_.body ? &*signer_.body : nullptr};
  PlacedBody own = {.rig = &character_->rig, .pose = &to_, .body = character_->body ? &*character_->body : nullptr};
  if (options_.place_hands) {
    source.space = signer_space(*source.body, *source.rig, from_);
    own.space = space_;
  }
  for (const Side side : kSides) {
    const auto i = static_cast<std::size_t>(side);
    if (!arms_[i]) continue;
    fingers_[i]->constrain(skeleton, drives_, to_);
    const Part wrist = of(side, Part::left_hand);
    const Quaternionf turn = to_.rotations[at(arms_[i]->wrist())] * axes_[wrist] * source_axes_[wrist].conjugate() *
                             from_.rotations[at(signer_.rig[wrist].joint)].conjugate();
    fingers_[i]->pinch(skeleton, from_, turn, hand_scale_, to_);
    hands[i] = TwoHands{&*fingers_[i], signer_.rig[wrist].joint, arms_[i]->wrist()};
  }
  WristGoals goals;
  if (options_.place_hands) {
    const auto head = [](const std::optional<HeadSpace>& space, const RigMap& rig, const ModelPose& pose) {
      return space ? std::optional(moved(*space, rig[Part::head].joint, pose)) : std::nullopt;
    };
    goals = wrist_goals(source, head(source_head_, signer_.rig, from_), own, head(head_, character_->rig, to_), hands,
                        surface_, unit_ratio_);
  }
  for (const Side side : kSides) {
    const auto i = static_cast<std::size_t>(side);
    if (!arms_[i]) continue;
    if (goals.wrists[i]) {
      // Out of reach, the source's own extension is used, so that the elbow does not jump.
      const Vector3f shoulder = to_.positions[at(arms_[i]->shoulder())];
      const Vector3f arm = *goals.wrists[i] - shoulder;
      const Vector3f shown = position_of(signer_.rig[of(side, Part::left_hand)], from_) -
                             position_of(signer_.rig[of(side, Part::left_upper_arm)], from_);
      const float extension = arm.norm() / arms_[i]->length();
      const float source_extension = shown.norm() / std::max(arm_length(source_axes_, signer_.rig, side), 1e-3f);
      const float weight = smooth_step(extension, kExtendedFrom, kExtendedTo);
      const float kept = (1 - weight) * std::min(extension, 1.0f) + weight * std::min(source_extension, 1.0f);
      if (extension > 1e-3f) *goals.wrists[i] = shoulder + arm * (kept / extension);
      *goals.wrists[i] = out_of_body(*hands[i], to_, surface_, *goals.wrists[i]);
    }
    arms_[i]->solve(skeleton, goals.wrists[i], {drives_.upper_twist[i], drives_.lower_twist[i]}, to_);
  }
}

void Retargeter::rest(MutablePoseView out) const noexcept {
  for (std::size_t i = 0; i < out.rotations.size(); ++i) out.rotations[i] = character_->still_turn(i);
  for (std::size_t i = 0; i < out.translations.size(); ++i) {
    out.translations[i] = character_->skeleton->joint(character_->skeleton->translated_joints()[i]).offset;
  }
}

void Retargeter::pose(PoseView source, MutablePoseView out) noexcept {
  const Skeleton& skeleton = *character_->skeleton;
  to_model_space(source_, source, from_);
  turn_joints();
  put_root();
  solve_legs();
  surface_.place(to_);
  // Computed before the clavicles follow the arms, so that they do not move the space in which hands are placed.
  if (character_->body) space_ = signer_space(*character_->body, character_->rig, to_);
  for (const std::optional<CharacterCollar>& collar : collars_) {
    if (collar) collar->apply(skeleton, to_);
  }
  solve_arms();
  bool finite = true;
  for (std::size_t i = 0; i < skeleton.joint_count(); ++i) {
    const JointIndex parent = skeleton.joints()[i].parent;
    const Quaternionf local =
        parent == kNoJoint ? to_.rotations[i] : Quaternionf(to_.rotations[at(parent)].conjugate() * to_.rotations[i]);
    out.rotations[i] = loose_[i] ? character_->still_turn(i) : local.normalized();
    finite = finite && out.rotations[i].coeffs().allFinite();
  }
  for (std::size_t i = 0; i < out.translations.size(); ++i) {
    const JointIndex joint = skeleton.translated_joints()[i];
    out.translations[i] =
        skeleton.joint(joint).parent == kNoJoint ? to_.positions[at(joint)] : skeleton.joint(joint).offset;
    finite = finite && out.translations[i].allFinite();
  }
  if (!finite) rest(out);
}

}  // namespace signweave
