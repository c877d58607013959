#include "signweave/retarget/body_mapping.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "signweave/core/error.h"
#include "signweave/core/text.h"
#include "signweave/features/hand_points.h"
#include "signweave/retarget/body_match.h"
#include "signweave/rig/joint_at.h"

namespace signweave {
namespace {

using Eigen::Quaternionf;
using Eigen::Vector3f;

/// Maximum number of joints named in one line.
constexpr std::size_t kNamedJoints = 6;
/// An arm bent this much reaches its position on any body: distance from shoulder to wrist, as a fraction of the arm's
/// length.
constexpr float kBentArm = 0.79f;

JointIndex pelvis_of(const RigMap& rig) {
  for (const Part part : {Part::pelvis, Part::spine, Part::chest}) {
    if (rig.has(part)) return rig[part].joint;
  }
  return 0;
}

/// Returns the lowest translated joint from the root to the pelvis; the root if there is none.
JointIndex carrier_of(const Skeleton& skeleton, const RigMap& rig) {
  JointIndex joint = pelvis_of(rig);
  while (joint > 0 && !skeleton.joint(joint).translated) joint = skeleton.joint(joint).parent;
  return joint;
}

/// Returns the value below which a fraction `share` of the values lies; 0 if empty.
float quantile_of(std::vector<float> values, double share) {
  if (values.empty()) return 0;
  const auto which = values.begin() + static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), which, values.end());
  return *which;
}

/// The landmark by which the heights of two bodies are compared: the lowest ankle, else the hips, else the shoulders.
enum class Landmark { ankles, hips, shoulders };

Landmark landmark_of(const RigMap& a, const RigMap& b) {
  const auto both = [&](Part part) { return a.has(part) && b.has(part); };
  if (both(Part::left_foot) && both(Part::right_foot)) return Landmark::ankles;
  if (both(Part::left_thigh) && both(Part::right_thigh)) return Landmark::hips;
  return Landmark::shoulders;
}

float height_in(const ModelPose& pose, const RigMap& rig, Landmark which) {
  const auto y = [&](Part part) { return position_of(rig[part], pose).y(); };
  switch (which) {
    case Landmark::ankles:
      return std::min(y(Part::left_foot), y(Part::right_foot));
    case Landmark::hips:
      return 0.5f * (y(Part::left_thigh) + y(Part::right_thigh));
    case Landmark::shoulders:
      break;
  }
  return 0.5f * (y(Part::left_upper_arm) + y(Part::right_upper_arm));
}

/// The usual position of a signer over some frames: the midpoint of the shoulders and the heading.
struct Stance {
  Standing standing;
  float height = 0;  ///< median height of the landmark
};

Stance stance_of(const Motion& motion, const SignerModel& signer, Landmark which) {
  std::vector<float> heights;
  std::vector<float> x;
  std::vector<float> z;
  Vector3f ahead = Vector3f::Zero();
  ModelPose pose;
  for (std::int64_t frame = 0; frame < motion.frame_count(); ++frame) {
    to_model_space(motion.skeleton(), motion.pose(frame), pose);
    const float height = height_in(pose, signer.rig, which);
    const SignerSpace space = signer_space(*signer.body, signer.rig, pose);
    const Vector3f forward = space.model_from_signer * Vector3f::UnitZ();
    if (!std::isfinite(height) || !space.origin.allFinite() || !forward.allFinite()) continue;
    heights.push_back(height);
    x.push_back(space.origin.x());
    z.push_back(space.origin.z());
    ahead += forward;
  }
  return {.standing = {.position = {quantile_of(x, 0.5), 0, quantile_of(z, 0.5)},
                       .heading = std::atan2(ahead.x(), ahead.z())},
          .height = quantile_of(heights, 0.5)};
}

/// Returns the distances of hands from their intended positions, in shoulder widths scaled by the target's reach: only
/// for bent arms, which can reach them.
std::vector<float> hand_distances(const RecordedBody& source, const Motion& shown, const RecordedBody& target,
                                  float ratio) {
  std::vector<float> distances;
  const RigMap& from = source.signer.rig;
  const RigMap& to = target.signer.rig;
  ModelPose there;
  ModelPose here;
  for (std::int64_t frame = 0; frame < shown.frame_count(); ++frame) {
    to_model_space(source.frames.skeleton(), source.frames.pose(frame), there);
    to_model_space(shown.skeleton(), shown.pose(frame), here);
    const SignerSpace from_space = signer_space(*source.signer.body, from, there);
    SignerSpace to_space = signer_space(*target.signer.body, to, here);
    to_space.unit = ratio * from_space.unit;
    for (const Side side : kSides) {
      const Part shoulder = of(side, Part::left_upper_arm);
      const Part elbow = of(side, Part::left_forearm);
      const Part wrist = of(side, Part::left_hand);
      if (!from.has(wrist) || !to.has(wrist) || !from.has(elbow) || !to.has(elbow)) continue;
      const auto point = [&](Part part) { return position_of(from[part], there); };
      const float arm = (point(elbow) - point(shoulder)).norm() + (point(wrist) - point(elbow)).norm();
      if ((point(wrist) - point(shoulder)).norm() > kBentArm * arm) continue;
      HandPoints a;
      HandPoints b;
      HandPlaces(from, side).read(there, a);
      HandPlaces(to, side).read(here, b);
      const float distance = (from_space.to_signer(palm_of(a)) - to_space.to_signer(palm_of(b))).norm();
      if (std::isfinite(distance)) distances.push_back(distance);
    }
  }
  return distances;
}

std::string joints_at_rest(const Skeleton& skeleton, const Drives& drives) {
  std::vector<std::string> names;
  for (std::size_t i = 0; i < skeleton.joint_count(); ++i) {
    if (!drives.joints[i].driven()) names.push_back(printable(skeleton.joints()[i].name));
  }
  std::string text;
  for (std::size_t i = 0; i < std::min(names.size(), kNamedJoints); ++i) text += (i > 0 ? ", " : "") + names[i];
  if (names.size() > kNamedJoints) text += fmt::format(" and {} more", names.size() - kNamedJoints);
  return text;
}

void refuse_unsafe(const RecordedBody& source, const RecordedBody& target, const BodyMatch& match) {
  if (match.unsafe.empty()) return;
  throw Error(ErrorCode::bad_input,
              fmt::format("recording '{}' cannot be retargeted to the skeleton of '{}': {}; import them with a "
                          "mapping file that names such joints, or sign with recordings of one skeleton",
                          source.recording, target.recording, fmt::join(match.unsafe, "; ")),
              {{"rig", ""}});
}

}  // namespace

BodyMapping map_body(const RecordedBody& source, const RecordedBody& target) {
  const BodyMatch match = match_bodies(source, target);
  refuse_unsafe(source, target, match);

  BodyMapping mapping;
  mapping.source = with_usual_bones(source.frames.skeleton(), usual_pose(source.frames), {});
  mapping.signer = source.signer;
  mapping.usual = usual_pose(target.frames);
  mapping.character = character_of(target, mapping.usual);
  mapping.options = {.ground = ground_of(source.frames, source.signer.rig),
                     .face_joints = true,
                     .collar_share = !collars_move(source.frames, source.signer.rig)};
  mapping.skeleton = target.frames.shared_skeleton();
  mapping.carrier = carrier_of(*mapping.skeleton, target.signer.rig);

  // The examined frames, on the other body: they determine how high it stands, and how close its hands come.
  BodyMapper mapper(mapping);
  Motion shown(mapping.skeleton, source.frames.rate(), source.frames.frame_count());
  for (std::int64_t frame = 0; frame < shown.frame_count(); ++frame) {
    mapper.pose(source.frames.pose(frame), shown.pose(frame));
  }
  const Landmark landmark = landmark_of(source.signer.rig, target.signer.rig);
  const Stance is = stance_of(shown, target.signer, landmark);
  const Stance wanted = stance_of(target.frames, target.signer, landmark);
  mapping.lift = wanted.height - is.height;
  if (mapping.carrier > 0) mapping.ground = align(is.standing, wanted.standing);

  const Drives& drives = mapper.retargeter().drives();
  const auto driven = std::ranges::count_if(drives.joints, [](const Drive& drive) { return drive.driven(); });
  std::string line = fmt::format("retargeted to the skeleton of '{}', which has other joints: {} of {} driven",
                                 target.recording, driven, drives.joints.size());
  if (const std::string rest = joints_at_rest(*mapping.skeleton, drives); !rest.empty()) {
    line += fmt::format(", at rest: {}", rest);
  }
  if (const std::vector<float> distances = hand_distances(source, shown, target, mapper.retargeter().unit_ratio());
      !distances.empty()) {
    line += fmt::format("; hands within {:.3f} shoulder widths of their positions (95 %: {:.3f})",
                        quantile_of(distances, 0.5), quantile_of(distances, 0.95));
  }
  mapping.notices.push_back({source.recording, line});
  for (const std::string& text : match.approximate) {
    mapping.notices.push_back({source.recording, fmt::format("on the skeleton of '{}': {}", target.recording, text)});
  }
  return mapping;
}

BodyMapper::BodyMapper(const BodyMapping& mapping)
    : mapping_(mapping),
      retargeter_(mapping.source, mapping.signer, mapping.character, mapping.options),
      whole_(*mapping.character.skeleton) {
  const Skeleton& skeleton = *mapping.skeleton;
  root_translation_ = skeleton.translation_of(0);
  if (mapping.carrier == 0) return;
  carrier_translation_ = skeleton.translation_of(mapping.carrier);
  const Skeleton& bones = *mapping.character.skeleton;
  above_ = path_between(bones, 0, bones.joint(mapping.carrier).parent);
  for (const JointIndex joint : above_) {
    above_place_ =
        joint == 0 ? bones.joint(0).offset : Vector3f(above_place_ + above_turn_ * bones.joint(joint).offset);
    above_turn_ = above_turn_ * mapping.usual.rotations[at(joint)];
  }
}

void BodyMapper::pose(PoseView source, MutablePoseView out) noexcept {
  retargeter_.pose(source, whole_.view());
  std::ranges::copy(whole_.rotations, out.rotations.begin());
  std::ranges::copy(mapping_.usual.translations, out.translations.begin());
  const Quaternionf root = mapping_.ground.turn * whole_.rotations[0];
  const Vector3f place =
      mapping_.ground.turn * whole_.translations[0] + mapping_.ground.shift + Vector3f(0, mapping_.lift, 0);
  if (!carrier_translation_) {
    if (root_translation_) out.translations[*root_translation_] = place;
    return;
  }
  // The carrier takes the retargeter's root motion; all joints above it keep the usual pose.
  const Skeleton& bones = *mapping_.character.skeleton;
  Quaternionf turn = root;
  Vector3f end = place;
  for (std::size_t i = 1; i <= above_.size(); ++i) {
    const JointIndex joint = i < above_.size() ? above_[i] : mapping_.carrier;
    end += turn * bones.joint(joint).offset;
    turn = turn * whole_.rotations[at(joint)];
  }
  for (const JointIndex joint : above_) out.rotations[at(joint)] = mapping_.usual.rotations[at(joint)];
  out.rotations[at(mapping_.carrier)] = (above_turn_.conjugate() * turn).normalized();
  out.translations[*carrier_translation_] = above_turn_.conjugate() * (end - above_place_);
}

}  // namespace signweave
