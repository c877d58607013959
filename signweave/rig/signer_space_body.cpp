#include <algorithm>
#include <cmath>
#include <limits>
#include <span>

#include "signweave/rig/signer_space.h"

namespace signweave {
namespace {

using Eigen::Quaternionf;
using Eigen::Vector3f;

// Heights above the ground as fractions of the stature (Drillis and Contini 1966, as in Winter 2009, figure 4.1).
constexpr float kHip = 0.530f;
constexpr float kShoulder = 0.818f;
constexpr float kChin = 0.870f;
constexpr float kEye = 0.936f;
constexpr float kArm = 0.186f + 0.146f;  // upper arm and forearm
/// Between the shoulder joints of common rigs, which are closer together than a body is broad. (ours)
constexpr float kShoulders = 0.21f;
/// Fraction of the trunk from pelvis to neck: joints closer together than that are not shoulders. In real rigs they are
/// at least half of it apart. (ours)
constexpr float kNarrowest = 0.2f;

// The borders between the landmarks. (ours)
constexpr float kChestOfTrunk = 0.5f;     // up from the hips
constexpr float kShoulderOfTrunk = 0.8f;  // the same: the armpits
constexpr float kChinOfFace = -0.2f;      // up from the chin to the eyes: the throat's upper end counts as chin
constexpr float kMouthOfFace = 0.25f;     // the same: below the lower lip
constexpr float kNearOfArm = 0.65f;       // a bent forearm and half a palm
constexpr float kLeast = 0.02f;           // minimum between two borders, shoulder widths

float median(std::vector<float>& values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

/// The median over the poses of a measurement; 0 if there is none.
template <typename Measure>
float median_over(std::span<const ModelPose> poses, Measure&& measure) {
  std::vector<float> values;
  values.reserve(poses.size());
  for (const ModelPose& pose : poses) {
    const float value = measure(pose);
    if (std::isfinite(value)) values.push_back(value);
  }
  return values.empty() ? 0 : median(values);
}

std::vector<ModelPose> sampled_poses(const Motion& motion) {
  const std::int64_t count = std::min(motion.frame_count(), kBodyFrames);
  std::vector<ModelPose> poses(static_cast<std::size_t>(count));
  for (std::int64_t i = 0; i < count; ++i) {
    const std::int64_t frame = count == 1 ? 0 : i * (motion.frame_count() - 1) / (count - 1);
    to_model_space(motion.skeleton(), motion.pose(frame), poses[static_cast<std::size_t>(i)]);
  }
  return poses;
}

/// The lowest common ancestor of both, or one of them.
JointIndex common_joint(const Skeleton& skeleton, JointIndex a, JointIndex b) {
  while (a != b) (a > b ? a : b) = skeleton.joint(std::max(a, b)).parent;
  return a;
}

/// The orientation of the signer's axes in the trunk's space: the mean over the poses, weighted by how far apart the
/// shoulders are on the ground.
Quaternionf trunk_from_signer(std::span<const ModelPose> poses, const RigMap& rig, JointIndex trunk) {
  Eigen::Vector4f sum = Eigen::Vector4f::Zero();
  for (const ModelPose& pose : poses) {
    const Vector3f across =
        position_of(rig[Part::left_upper_arm], pose) - position_of(rig[Part::right_upper_arm], pose);
    const float weight = across.x() * across.x() + across.z() * across.z();
    const float half = 0.5f * std::atan2(-across.z(), across.x());
    const Quaternionf signer(std::cos(half), 0, std::sin(half), 0);
    const Eigen::Vector4f turn = (pose.rotations[static_cast<std::size_t>(trunk)].conjugate() * signer).coeffs();
    if (!turn.allFinite()) continue;
    sum += (sum.dot(turn) < 0 ? -weight : weight) * turn;
  }
  if (sum.norm() > 1e-6f) return Quaternionf(sum.normalized());
  return poses.front().rotations[static_cast<std::size_t>(trunk)].conjugate();
}

float arm_length(std::span<const ModelPose> poses, const RigMap& rig, float width) {
  float sum = 0;
  int arms = 0;
  for (const Side side : kSides) {
    const PartPlace& shoulder = rig[of(side, Part::left_upper_arm)];
    const PartPlace& elbow = rig[of(side, Part::left_forearm)];
    const PartPlace& wrist = rig[of(side, Part::left_hand)];
    if (!wrist.known()) continue;
    sum += median_over(poses, [&](const ModelPose& pose) {
      const Vector3f hand = position_of(wrist, pose);
      if (!elbow.known()) return (hand - position_of(shoulder, pose)).norm();
      const Vector3f middle = position_of(elbow, pose);
      return (hand - middle).norm() + (middle - position_of(shoulder, pose)).norm();
    });
    ++arms;
  }
  return arms == 0 ? 0 : sum / static_cast<float>(arms) / width;
}

/// Heights of the body's landmarks above the shoulders, in shoulder widths.
struct Landmarks {
  float hip, chin, eye, top;
};

Landmarks landmarks(std::span<const ModelPose> poses, const RigMap& rig, float width, float stature) {
  const auto height = [&](const Vector3f& point, const ModelPose& pose) {
    const Vector3f middle =
        0.5f * (position_of(rig[Part::left_upper_arm], pose) + position_of(rig[Part::right_upper_arm], pose));
    return (point.y() - middle.y()) / width;
  };
  // The mean of the known parts; parts far from the usual height of a human body are not landmarks.
  const auto find = [&](std::initializer_list<Part> parts, float usual) -> std::optional<float> {
    float sum = 0;
    int known = 0;
    for (const Part part : parts) {
      if (!rig.has(part)) continue;
      sum += median_over(poses, [&](const ModelPose& pose) { return height(position_of(rig[part], pose), pose); });
      ++known;
    }
    const float mean = sum / static_cast<float>(std::max(known, 1));
    const float room = 0.6f * std::max(std::abs(usual), (1 - kShoulder) * stature);
    const bool likely = known > 0 && std::abs(mean - usual) < room;
    return likely ? std::optional(mean) : std::nullopt;
  };
  const auto usual = [&](float share) { return (share - kShoulder) * stature; };

  Landmarks found{};
  std::optional<float> hip = find({Part::pelvis}, usual(kHip));
  if (!hip) hip = find({Part::left_thigh, Part::right_thigh}, usual(kHip));
  const std::optional<float> top = find({Part::head_top}, usual(1));
  const std::optional<float> eye = find({Part::left_eye, Part::right_eye}, usual(kEye));
  const std::optional<float> head = find({Part::head}, usual(0.88f));  // the joint is between chin and mouth
  found.hip = hip.value_or(usual(kHip));
  if (eye) {
    found.eye = *eye;
    found.top = top && *top > *eye ? *top : *eye + (1 - kEye) * stature;
    found.chin = *eye - (kEye - kChin) / (1 - kEye) * (found.top - *eye);
  } else {
    found.top = top.value_or(usual(1));
    found.chin = head && *head < found.top ? *head - 0.1f * (found.top - *head) : usual(kChin);
    found.eye = found.chin + (kEye - kChin) / (1 - kChin) * (found.top - found.chin);
  }
  return found;
}

std::array<float, 8> borders(const Landmarks& at) {
  const float face = at.eye - at.chin;
  std::array<float, 8> heights = {-std::numeric_limits<float>::infinity(),
                                  at.hip,
                                  at.hip * (1 - kChestOfTrunk),
                                  at.hip * (1 - kShoulderOfTrunk),
                                  at.chin + kChinOfFace * face,
                                  at.chin + kMouthOfFace * face,
                                  at.eye,
                                  at.top};
  for (std::size_t i = 1; i < heights.size(); ++i) heights[i] = std::max(heights[i], heights[i - 1] + kLeast);
  return heights;
}

/// From pelvis to neck (else head), metres; 0 if the map lacks them.
float trunk_length(std::span<const ModelPose> poses, const RigMap& rig) {
  const Part top = rig.has(Part::neck) ? Part::neck : Part::head;
  if (!rig.has(Part::pelvis) || !rig.has(top)) return 0;
  return median_over(poses, [&](const ModelPose& pose) {
    return (position_of(rig[Part::pelvis], pose) - position_of(rig[top], pose)).norm();
  });
}

}  // namespace

std::optional<SignerBody> signer_body(const Motion& motion, const RigMap& rig) {
  if (!why_no_signer_space(rig).empty() || motion.frame_count() == 0) return std::nullopt;
  const PartPlace& left = rig[Part::left_upper_arm];
  const PartPlace& right = rig[Part::right_upper_arm];
  const std::vector<ModelPose> poses = sampled_poses(motion);
  SignerBody body;
  body.shoulder_width = median_over(
      poses, [&](const ModelPose& pose) { return (position_of(left, pose) - position_of(right, pose)).norm(); });
  if (!(body.shoulder_width > 1e-6f) || body.shoulder_width < kNarrowest * trunk_length(poses, rig))
    return std::nullopt;
  body.arm_length = arm_length(poses, rig, body.shoulder_width);
  // An arm indicates the stature better than the shoulder joints do, unless its length is implausible.
  const bool likely_arm = body.arm_length > 0.7f && body.arm_length < 3.5f;
  const float stature = likely_arm ? body.arm_length / kArm : 1 / kShoulders;
  if (!likely_arm) body.arm_length = kArm * stature;
  body.near_reach = kNearOfArm * body.arm_length;
  body.heights = borders(landmarks(poses, rig, body.shoulder_width, stature));
  body.trunk = common_joint(motion.skeleton(), left.joint, right.joint);
  body.trunk_from_signer = trunk_from_signer(poses, rig, body.trunk);
  return body;
}

}  // namespace signweave
