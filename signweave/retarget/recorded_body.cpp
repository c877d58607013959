#include "signweave/retarget/recorded_body.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include "signweave/features/from_source.h"
#include "signweave/retarget/rig_axes.h"

namespace signweave {
namespace {

using Eigen::Quaternionf;
using Eigen::Vector3f;

float median_of(std::vector<float>& values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

CharacterFinger finger_of(const RigMap& rig, const RigAxes& axes, Side side, Finger which) {
  CharacterFinger finger;
  const auto part = [&](FingerPoint point) { return finger_part(side, which, point); };
  finger.metacarpal = rig[part(FingerPoint::metacarpal)].joint;
  const Part proximal = part(FingerPoint::proximal);
  if (!rig.has(proximal) || !rig.has(part(FingerPoint::intermediate)) || !rig.has(part(FingerPoint::distal))) {
    return finger;
  }
  for (std::size_t i = 0; i < 3; ++i) finger.joints[i] = rig[part(static_cast<FingerPoint>(i + 1))].joint;
  // Axes of a finger's bones: to the next joint, to the thumb's side, so the third is the normal of the palm or the
  // back.
  finger.spread_axis = axes[proximal] * Vector3f::UnitZ();
  finger.flexion_axis = (side == Side::left ? 1.0f : -1.0f) * (axes[proximal] * Vector3f::UnitY());
  constexpr float kWhole = std::numbers::pi_v<float>;
  finger.flexion.fill({-kWhole, kWhole});
  finger.spread = {-kWhole, kWhole};
  finger.slack = kWhole;
  return finger;
}

}  // namespace

RecordedBody recorded_body(std::string recording, const MotionSource& source, const RigNames& names) {
  RecordedBody body{.recording = std::move(recording), .signer = model_of(source, names), .frames = {}};
  const std::int64_t all = source.frame_count();
  const std::int64_t seen = std::min(all, kSeenFrames);
  body.frames.reset(source.skeleton(), source.rate(), seen);
  for (std::int64_t i = 0; i < seen; ++i) {
    const std::int64_t frame = i * all / seen;
    source.read({frame, frame + 1}, body.frames.poses({i, i + 1}));
  }
  return body;
}

Pose usual_pose(const Motion& motion) {
  Pose usual(motion.skeleton());
  for (std::size_t joint = 0; joint < usual.rotations.size(); ++joint) {
    Eigen::Vector4f sum = Eigen::Vector4f::Zero();
    Eigen::Vector4f first = Eigen::Vector4f::Zero();
    for (std::int64_t frame = 0; frame < motion.frame_count(); ++frame) {
      const Eigen::Vector4f turn = motion.pose(frame).rotations[joint].coeffs();
      if (!turn.allFinite()) continue;
      if (first.isZero(0)) first = turn;
      sum += first.dot(turn) < 0 ? Eigen::Vector4f(-turn) : turn;
    }
    if (sum.norm() > 1e-3f) usual.rotations[joint] = Quaternionf(sum.normalized());
  }
  std::vector<float> values;
  for (std::size_t i = 0; i < usual.translations.size(); ++i) {
    for (Eigen::Index axis = 0; axis < 3; ++axis) {
      values.clear();
      for (std::int64_t frame = 0; frame < motion.frame_count(); ++frame) {
        const float value = motion.pose(frame).translations[i][axis];
        if (std::isfinite(value)) values.push_back(value);
      }
      if (!values.empty()) usual.translations[i][axis] = median_of(values);
    }
  }
  return usual;
}

Skeleton with_usual_bones(const Skeleton& skeleton, const Pose& usual, BoneLengths which) {
  std::vector<Joint> joints(skeleton.joints().begin(), skeleton.joints().end());
  for (std::size_t i = 0; i < skeleton.translation_count(); ++i) {
    joints[static_cast<std::size_t>(skeleton.translated_joints()[i])].offset = usual.translations[i];
  }
  if (which.only_root) {
    for (Joint& joint : joints) joint.translated = joint.parent == kNoJoint;
  }
  return Skeleton(std::move(joints), {skeleton.tips().begin(), skeleton.tips().end()});
}

Character character_of(const RecordedBody& body, const Pose& usual) {
  Character character;
  character.name = body.recording;
  character.skeleton =
      std::make_shared<const Skeleton>(with_usual_bones(body.frames.skeleton(), usual, {.only_root = true}));
  character.rig = body.signer.rig;
  character.body = body.signer.body;
  character.still = usual.rotations;
  const RigAxes axes(*character.skeleton, character.rig);
  for (const Side side : kSides) {
    if (!character.rig.has(of(side, Part::left_hand))) continue;
    CharacterHand& hand = character.hands[static_cast<std::size_t>(side)];
    for (const Finger finger : kFingers) {
      hand.fingers[static_cast<std::size_t>(finger)] = finger_of(character.rig, axes, side, finger);
    }
    const Part tip = finger_part(side, Finger::middle, FingerPoint::tip);
    if (character.rig.has(tip)) hand.length = (axes.place(tip) - axes.place(of(side, Part::left_hand))).norm();
  }
  return character;
}

}  // namespace signweave
