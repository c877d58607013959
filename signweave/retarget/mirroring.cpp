#include "signweave/retarget/mirroring.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "signweave/retarget/mirrored_tracks.h"
#include "signweave/rig/joint_at.h"
#include "signweave/rig/signer_space.h"

namespace signweave {
namespace {

using Eigen::Quaternionf;
using Eigen::Vector3f;

/// Offsets of left and right that differ by less than this are equal. Metres. (ours)
constexpr float kSameBone = 0.005f;
/// A bone that is usually this far from its offset is not as the skeleton says. Metres. (ours)
constexpr float kOtherBone = 0.03f;
/// Wrists that miss their mirrored positions by less than this need no notice. Metres. (ours)
constexpr float kNoticed = 0.001f;

/// The lowest translated joint from the root to the pelvis; the root if there is none.
JointIndex body_carrier(const Skeleton& skeleton, const RigMap& rig) {
  JointIndex joint = rig.has(Part::pelvis) ? rig[Part::pelvis].joint : 0;
  while (joint > 0 && !skeleton.joint(joint).translated) joint = skeleton.joint(joint).parent;
  return joint;
}

/// [translated joint] the mean translation. Not the median, which is different in a mirror.
std::vector<Vector3f> usual_translations(const Motion& motion) {
  Pose usual(motion.skeleton());
  for (std::size_t i = 0; i < usual.translations.size(); ++i) {
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    double count = 0;
    for (std::int64_t frame = 0; frame < motion.frame_count(); ++frame) {
      const Vector3f& place = motion.pose(frame).translations[i];
      if (!place.allFinite()) continue;
      sum += place.cast<double>();
      ++count;
    }
    if (count > 0) usual.translations[i] = (sum / count).cast<float>();
  }
  return std::move(usual.translations);
}

/// The skeleton with the bones that its poses have: the mean of a translation that is far from its offset is the
/// offset.
Skeleton with_real_bones(const Skeleton& skeleton, const std::vector<Vector3f>& usual) {
  std::vector<Joint> joints(skeleton.joints().begin(), skeleton.joints().end());
  for (std::size_t i = 0; i < usual.size(); ++i) {
    Joint& joint = joints[at(skeleton.translated_joints()[i])];
    if (joint.parent != kNoJoint && (usual[i] - joint.offset).norm() > kOtherBone) joint.offset = usual[i];
  }
  return Skeleton(std::move(joints), {skeleton.tips().begin(), skeleton.tips().end()});
}

MirroredTranslation translation_of(const Mirroring& mirroring, const Skeleton& skeleton, std::size_t index,
                                   const std::vector<Vector3f>& usual) {
  MirroredTranslation translation{.from = index};
  const JointIndex joint = skeleton.translated_joints()[index];
  const JointIndex parent = skeleton.joint(joint).parent;
  const JointIndex other = mirroring.joints[at(joint)].joint;
  if (joint <= mirroring.carrier || parent == kNoJoint || other == kNoJoint) return translation;
  const auto from = skeleton.translation_of(other);
  const Counterpart& above = mirroring.joints[at(parent)];
  if (!from || skeleton.joint(other).parent != above.joint) return translation;
  translation = {.from = *from, .mirrored = true, .turn = above.turn, .shift = {}};
  translation.shift.setZero();
  const auto difference = [&](const Vector3f& own, const Vector3f& others) {
    return Vector3f(own + above.turn * others);
  };
  const Vector3f of_offsets = difference(skeleton.joint(joint).offset, skeleton.joint(other).offset);
  const Vector3f of_usual = difference(usual[index], usual[*from]);
  if (of_offsets.norm() > kSameBone && of_usual.norm() > kSameBone) translation.shift = of_usual;
  return translation;
}

/// Sets the plane: through the mean position of the carrier, its normal the mean direction to the signer's left. Sets
/// that direction in each joint's space, too.
void set_plane(const RecordedBody& body, Mirroring& mirroring, std::vector<UsualRotation>& usual) {
  Vector3f left = Vector3f::Zero();
  Eigen::Vector3d place = Eigen::Vector3d::Zero();
  double count = 0;
  ModelPose pose;
  for (std::int64_t frame = 0; frame < body.frames.frame_count(); ++frame) {
    to_model_space(body.frames.skeleton(), body.frames.pose(frame), pose);
    const SignerSpace space = signer_space(*body.signer.body, body.signer.rig, pose);
    const Vector3f across = space.model_from_signer * Vector3f::UnitX();
    const Vector3f& carried = pose.positions[at(mirroring.carrier)];
    if (!across.allFinite() || !carried.allFinite()) continue;
    left += across;
    for (std::size_t i = 0; i < usual.size(); ++i) {
      const Vector3f own = pose.rotations[i].conjugate() * across;
      if (own.allFinite()) usual[i].left += own;
    }
    place += carried.cast<double>();
    ++count;
  }
  for (UsualRotation& one : usual)
    one.left = one.left.norm() > 1e-3f ? Vector3f(one.left.normalized()) : Vector3f::Zero();
  left.y() = 0;
  if (left.norm() < 1e-3f) left = Vector3f::UnitX();
  left.normalize();
  mirroring.half_turn = Quaternionf(0, left.x(), left.y(), left.z());
  if (count > 0) mirroring.place = (place / count).cast<float>();
}

/// Chooses the signs of the turns so that a usual pose keeps the signs of its quaternions where its mirror image is
/// near.
void set_signs(const std::vector<UsualRotation>& usual, Mirroring& mirroring) {
  const Skeleton& skeleton = *mirroring.skeleton;
  for (std::size_t i = 0; i < mirroring.joints.size(); ++i) {
    Counterpart& one = mirroring.joints[i];
    if (one.joint == kNoJoint) continue;
    const JointIndex parent = skeleton.joints()[i].parent;
    const bool free = parent == kNoJoint || mirroring.joints[at(parent)].joint == kNoJoint;
    const Quaternionf& above = free ? mirroring.half_turn : mirroring.joints[at(parent)].turn;
    const Quaternionf shown = above * usual[at(one.joint)].mean * one.turn.conjugate();
    if (shown.dot(usual[i].mean) < 0) one.turn.coeffs() *= -1.0f;
  }
}

/// The largest distance from a wrist to the mirror image of the other one, in the 95 % of frames in which it is
/// smallest; metres.
float wrist_error(const RecordedBody& body, const Mirroring& mirroring) {
  const RigMap& rig = body.signer.rig;
  if (!rig.has(Part::left_hand) || !rig.has(Part::right_hand)) return 0;
  Mirrorer mirrorer(mirroring);
  Pose shown(body.frames.skeleton());
  ModelPose captured;
  ModelPose pose;
  std::vector<float> errors;
  for (std::int64_t frame = 0; frame < body.frames.frame_count(); ++frame) {
    mirrorer.pose(body.frames.pose(frame), shown.view());
    to_model_space(body.frames.skeleton(), body.frames.pose(frame), captured);
    to_model_space(body.frames.skeleton(), std::as_const(shown).view(), pose);
    const SignerSpace was = signer_space(*body.signer.body, rig, captured);
    const SignerSpace is = signer_space(*body.signer.body, rig, pose);
    float error = 0;
    for (const Side side : kSides) {
      const Part wrist = of(side, Part::left_hand);
      Vector3f wanted =
          was.to_signer(position_of(rig[side == Side::left ? Part::right_hand : Part::left_hand], captured));
      wanted.x() = -wanted.x();
      error = std::max(error, (is.to_signer(position_of(rig[wrist], pose)) - wanted).norm() * is.unit);
    }
    if (std::isfinite(error)) errors.push_back(error);
  }
  if (errors.empty()) return 0;
  const auto rank = errors.begin() + static_cast<std::ptrdiff_t>((errors.size() - 1) * 95 / 100);
  std::nth_element(errors.begin(), rank, errors.end());
  return *rank;
}

}  // namespace

Mirroring mirroring_of(const RecordedBody& body) {
  if (!body.signer.body) {
    const std::string why = why_no_signer_space(body.signer.rig);
    throw Error(ErrorCode::bad_input,
                fmt::format("{}: the signer cannot be mirrored: {}", body.recording,
                            why.empty() ? "the shoulders are not apart; name them in a mapping file" : why));
  }
  const Motion& frames = body.frames;
  std::vector<UsualRotation> usual = usual_rotations(frames);
  Mirroring mirroring{.skeleton = frames.shared_skeleton(),
                      .joints = {},
                      .translations = {},
                      .carrier = body_carrier(frames.skeleton(), body.signer.rig),
                      .notices = {}};
  set_plane(body, mirroring, usual);
  const std::vector<Vector3f> places = usual_translations(frames);
  const Skeleton bones = with_real_bones(frames.skeleton(), places);
  mirroring.joints = counterparts(bones, body.signer.rig, mirroring.carrier, usual);
  set_signs(usual, mirroring);
  for (std::size_t i = 0; i < places.size(); ++i)
    mirroring.translations.push_back(translation_of(mirroring, bones, i, places));
  if (const float error = wrist_error(body, mirroring); error > kNoticed) {
    mirroring.notices.push_back(
        {body.recording,
         fmt::format("mirrored with its own bones, whose left and right differ: wrists within {:.0f} mm "
                     "of the mirrored positions",
                     std::round(error * 1000))});
  }
  return mirroring;
}

Mirrorer::Mirrorer(const Mirroring& mirroring) : mirroring_(mirroring), turns_(mirroring.skeleton->joint_count()) {
  captured_.rotations.resize(turns_.size());
  captured_.positions.resize(turns_.size());
}

void Mirrorer::pose(PoseView captured, MutablePoseView out) noexcept {
  const Skeleton& skeleton = *mirroring_.skeleton;
  to_model_space(skeleton, captured, captured_);
  for (std::size_t i = 0; i < turns_.size(); ++i) {
    const JointIndex parent = skeleton.joints()[i].parent;
    const Counterpart& one = mirroring_.joints[i];
    if (one.joint == kNoJoint) {
      out.rotations[i] = captured.rotations[i];
      turns_[i] = parent == kNoJoint ? out.rotations[i] : turns_[at(parent)] * out.rotations[i];
      continue;
    }
    turns_[i] = (mirroring_.half_turn * captured_.rotations[at(one.joint)] * one.turn.conjugate()).normalized();
    out.rotations[i] = parent == kNoJoint ? turns_[i] : (turns_[at(parent)].conjugate() * turns_[i]).normalized();
  }
  for (std::size_t i = 0; i < mirroring_.translations.size(); ++i) {
    const MirroredTranslation& one = mirroring_.translations[i];
    out.translations[i] =
        one.mirrored ? Vector3f(one.shift - one.turn * captured.translations[one.from]) : captured.translations[i];
  }
  const auto carried = skeleton.translation_of(mirroring_.carrier);
  if (!carried) return;
  // The carrier's position is reflected in model space; the joints above it are where they were captured.
  const Vector3f place =
      mirroring_.place - mirroring_.half_turn * (captured_.positions[at(mirroring_.carrier)] - mirroring_.place);
  const JointIndex above = skeleton.joint(mirroring_.carrier).parent;
  out.translations[*carried] =
      above == kNoJoint
          ? place
          : Vector3f(captured_.rotations[at(above)].conjugate() * (place - captured_.positions[at(above)]));
}

Motion mirrored(const Motion& motion, const Mirroring& mirroring) {
  Motion result(motion.shared_skeleton(), motion.rate(), motion.frame_count());
  Mirrorer mirrorer(mirroring);
  for (std::int64_t frame = 0; frame < motion.frame_count(); ++frame) {
    mirrorer.pose(motion.pose(frame), result.pose(frame));
  }
  std::vector<std::string> names;
  for (const ScalarTrack& track : motion.tracks()) names.push_back(track.name);
  for (MirroredTrack& track : mirrored_tracks(names)) {
    std::vector<float> values = motion.tracks()[track.from].values;
    for (float& value : values) value *= track.sign;
    result.add_track({std::move(track.name), std::move(values)});
  }
  return result;
}

}  // namespace signweave
