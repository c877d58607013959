#include "signweave/render/anchor.h"

#include <array>
#include <cassert>

#include "signweave/rig/signer_space.h"

namespace signweave {
namespace {

std::size_t slot_of(JointIndex joint) {
  return static_cast<std::size_t>(joint);
}

/// The motion from one placed space to another.
RigidMotion motion_between(const Eigen::Quaternionf& from_turn, const Eigen::Vector3f& from,
                           const Eigen::Quaternionf& to_turn, const Eigen::Vector3f& to) {
  const Eigen::Quaternionf turn = (to_turn * from_turn.conjugate()).normalized();
  return {turn, to - turn * from};
}

RigidMotion motion_of(JointIndex joint, const ModelPose& source, const ModelPose& target) {
  return motion_between(source.rotations[slot_of(joint)], source.positions[slot_of(joint)],
                        target.rotations[slot_of(joint)], target.positions[slot_of(joint)]);
}

}  // namespace

Anchor anchor_of(Contact touched) noexcept {
  if (has(touched, Contact::hands)) return Anchor::other_hand;
  if (has(touched, Contact::head)) return Anchor::head;
  return has(touched, Contact::torso) ? Anchor::trunk : Anchor::signer_space;
}

AnchorSpaces::AnchorSpaces(const SignerModel& signer) : signer_(&signer) {
  assert(signer.body);
}

SignerSpace AnchorSpaces::space_with_shoulders_of(const ModelPose& source, const ModelPose& target) {
  carried_.rotations.resize(target.rotations.size());
  carried_.positions.resize(target.positions.size());
  const JointIndex trunk = signer_->body->trunk;
  const RigidMotion carry = motion_of(trunk, source, target);
  carried_.rotations[slot_of(trunk)] = target.rotations[slot_of(trunk)];
  carried_.positions[slot_of(trunk)] = target.positions[slot_of(trunk)];
  for (const Part part : {Part::left_upper_arm, Part::right_upper_arm}) {
    const JointIndex shoulder = signer_->rig[part].joint;
    carried_.rotations[slot_of(shoulder)] = carry.turn * source.rotations[slot_of(shoulder)];
    carried_.positions[slot_of(shoulder)] = carry * source.positions[slot_of(shoulder)];
  }
  return signer_space(*signer_->body, signer_->rig, carried_);
}

AnchorMotion AnchorSpaces::between(Anchor anchor, const ModelPose& source, const ModelPose& target) {
  assert(anchor != Anchor::other_hand);
  const RigMap& rig = signer_->rig;
  if (anchor == Anchor::signer_space) {
    const SignerSpace from = signer_space(*signer_->body, rig, source);
    const SignerSpace to = space_with_shoulders_of(source, target);
    return {motion_between(from.model_from_signer, from.origin, to.model_from_signer, to.origin), to.model_from_signer};
  }
  const bool head = anchor == Anchor::head && rig.has(Part::head);
  const JointIndex joint = head ? rig[Part::head].joint : signer_->body->trunk;
  return {motion_of(joint, source, target), target.rotations[slot_of(joint)]};
}

}  // namespace signweave
