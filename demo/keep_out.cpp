#include "demo/keep_out.h"

#include <algorithm>
#include <cmath>

namespace signweave::demo {
namespace {

using Eigen::Vector3f;

Vector3f nearest_on(const Capsule& capsule, const Vector3f& point) {
  const Vector3f line = capsule.to - capsule.from;
  const float along = std::clamp((point - capsule.from).dot(line) / line.squaredNorm(), 0.0f, 1.0f);
  return capsule.from + along * line;
}

/// The push for a clearance that is too small by `missing` metres: it grows smoothly from 0.
float softly(float missing, float soft) {
  if (missing <= 0) return 0;
  return missing < soft ? 0.5f * missing * missing / soft : missing - 0.5f * soft;
}

}  // namespace

std::array<Capsule, 2> keep_out_of(const Signer& signer, const ModelPose& pose) {
  const auto at = [&](JointIndex joint, const Vector3f& offset) {
    const auto i = static_cast<std::size_t>(joint);
    return Vector3f(pose.positions[i] + pose.rotations[i] * offset);
  };
  return {Capsule{at(signer.hips, {0, 0, 0}), at(signer.spine2, {0, 0.10f, 0.01f}), 0.115f},
          Capsule{at(signer.head, {0, 0.035f, 0.025f}), at(signer.head, {0, 0.105f, 0.010f}), 0.085f}};
}

float clearance(const Capsule& capsule, const Vector3f& point) {
  return (point - nearest_on(capsule, point)).norm() - capsule.radius;
}

float too_close(std::span<const Vector3f> one, std::span<const Vector3f> other) {
  constexpr float kThick = 0.022f;  // distance between bones at which the push begins
  float nearest = kThick * kThick;
  for (const Vector3f& a : one) {
    for (const Vector3f& b : other) nearest = std::min(nearest, (a - b).squaredNorm());
  }
  return softly(kThick - std::sqrt(nearest), 0.012f);
}

Vector3f push_out(std::span<const Capsule> capsules, std::span<const Vector3f> points) {
  constexpr float kSoft = 0.016f;  // metres of clearance at which the push begins
  Vector3f push = Vector3f::Zero();
  for (const Capsule& capsule : capsules) {
    float most = 0;
    Vector3f out = Vector3f::Zero();
    for (const Vector3f& point : points) {
      const float missing = kSoft - clearance(capsule, point);
      if (missing <= 0) continue;
      const float wanted = softly(missing, kSoft);
      if (wanted > most) {
        most = wanted;
        out = (point - nearest_on(capsule, point)).normalized();
      }
    }
    push += most * out;
  }
  return push;
}

}  // namespace signweave::demo
