#include "demo/arm.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace signweave::demo {
namespace {

using Eigen::AngleAxisf;
using Eigen::Matrix3f;
using Eigen::Quaternionf;
using Eigen::Vector3f;

constexpr float radians(float degrees) {
  return degrees * std::numbers::pi_v<float> / 180.0f;
}

constexpr float kMiddleTwist = radians(-5);

/// The rotation from the rest pose's arm (along x, bending about −y) to a bone direction and a hinge.
Quaternionf bone_rotation(const Vector3f& along, const Vector3f& hinge) {
  Matrix3f axes;
  axes.col(0) = along;
  axes.col(1) = -hinge;
  axes.col(2) = axes.col(0).cross(axes.col(1));
  return Quaternionf(axes).normalized();
}

Quaternionf wrist_swing(const WristAngles& angles) {
  const Vector3f vector(0, -angles.radial, -angles.flexion);
  const float angle = vector.norm();
  if (angle < 1e-6f) return Quaternionf::Identity();
  return Quaternionf(AngleAxisf(angle, vector / angle));
}

Quaternionf forearm_twist(float twist) {
  return Quaternionf(AngleAxisf(twist, Vector3f::UnitX()));
}

Vector3f elbow_direction(const Vector3f& axis, float swivel) {
  // The relaxed position of an elbow: hanging, slightly out and back.
  const Vector3f natural(0.30f, -1.0f, -0.35f);
  const Vector3f across = (natural - natural.dot(axis) * axis).normalized();
  return std::cos(swivel) * across + std::sin(swivel) * axis.cross(across);
}

float excess(float value, float limit) {
  return std::max(0.0f, std::abs(value) - limit);
}

}  // namespace

TwoBones solve_two_bones(const Vector3f& start, const Vector3f& target, float upper, float lower,
                         const Vector3f& toward) {
  const Vector3f line = target - start;
  // Never fully straight: the hinge would be undefined, and real elbows and knees stay slightly bent.
  const float length = std::clamp(line.norm(), std::abs(upper - lower) + 0.01f, 0.995f * (upper + lower));
  const Vector3f axis = line.normalized();
  const Vector3f across = (toward - toward.dot(axis) * axis).normalized();
  const float along = (upper * upper - lower * lower + length * length) / (2 * length);
  const float height = std::sqrt(std::max(0.0f, upper * upper - along * along));
  return {.middle = start + along * axis + height * across, .end = start + length * axis, .hinge = across.cross(axis)};
}

ArmPose solve_arm(const Vector3f& shoulder, const Vector3f& wrist, ArmSizes sizes, const WristAngles& angles) {
  const Vector3f axis = (wrist - shoulder).normalized();
  const TwoBones bones =
      solve_two_bones(shoulder, wrist, sizes.upper, sizes.lower, elbow_direction(axis, angles.swivel));
  ArmPose pose;
  pose.elbow = bones.middle;
  pose.wrist = bones.end;
  pose.arm = bone_rotation((bones.middle - shoulder).normalized(), bones.hinge);
  pose.fore_arm = bone_rotation((bones.end - bones.middle).normalized(), bones.hinge) * forearm_twist(angles.twist);
  pose.hand = pose.fore_arm * wrist_swing(angles);
  return pose;
}

WristAngles wrist_angles(const Quaternionf& turn) {
  // turn = twist about x, then a swing without twist: its x is 0.
  float twist = 2 * std::atan2(turn.x(), turn.w());
  const float full = 2 * std::numbers::pi_v<float>;
  twist -= full * std::round((twist - kMiddleTwist) / full);
  AngleAxisf swing(forearm_twist(twist).conjugate() * turn);
  const Vector3f vector = swing.angle() * swing.axis();
  return {.twist = twist, .flexion = -vector.z(), .radial = -vector.y()};
}

WristAngles comfortable_wrist(const Vector3f& shoulder, const Vector3f& wrist, ArmSizes sizes, const Vector3f& palm,
                              const Vector3f& fingers, float swivel) {
  Matrix3f axes;  // the hand in the rest pose: fingers along x, palm towards −y
  axes.col(0) = fingers.normalized();
  axes.col(1) = -(palm - palm.dot(axes.col(0)) * axes.col(0)).normalized();
  axes.col(2) = axes.col(0).cross(axes.col(1));
  const Quaternionf hand(axes);

  WristAngles best;
  float least = std::numeric_limits<float>::max();
  for (int degrees = -5; degrees <= 60; ++degrees) {
    WristAngles angles{.swivel = radians(static_cast<float>(degrees))};
    const Quaternionf turn = solve_arm(shoulder, wrist, sizes, angles).fore_arm.conjugate() * hand;
    const float tried = angles.swivel;
    angles = wrist_angles(turn);
    angles.swivel = tried;
    const auto square = [](float value) { return value * value; };
    const float cost =
        square(excess(angles.twist - kMiddleTwist, radians(55))) * 2 + square(excess(angles.flexion, radians(35))) +
        square(excess(angles.radial + radians(8), radians(18))) * 2 + 0.7f * square(angles.swivel - swivel);
    if (cost < least) {
      least = cost;
      best = angles;
    }
  }
  return limited(best);
}

WristAngles limited(WristAngles angles) {
  angles.twist = std::clamp(angles.twist, radians(-90), radians(85));
  // A fully bent wrist cannot deviate sideways as well: the limits form an ellipse.
  const float aside = angles.radial / (angles.radial > 0 ? radians(25) : radians(40));
  const float over = std::hypot(angles.flexion / radians(70), aside);
  if (over > 1) {
    angles.flexion /= over;
    angles.radial /= over;
  }
  return angles;
}

Quaternionf clavicle_rotation(const Vector3f& shoulder_to_wrist) {
  const Vector3f reach = shoulder_to_wrist / 0.53f;  // as a fraction of the arm's length
  const float raised = 0.5f * (reach.y() + 1.0f);
  const float lift = 0.24f * raised * raised;
  const float forward = 0.14f * reach.z();
  return AngleAxisf(-forward, Vector3f::UnitY()) * AngleAxisf(lift, Vector3f::UnitZ());
}

}  // namespace signweave::demo
