#include <cmath>

#include "demo/arms.h"

namespace signweave::demo {
namespace {

using Eigen::Matrix3f;
using Eigen::Quaternionf;
using Eigen::Vector3f;

Vector3f on_left(const Vector3f& v, Side side) {
  return {sign_of(side) * v.x(), v.y(), v.z()};
}

Matrix3f columns(const Vector3f& fingers, const Vector3f& palm) {
  Matrix3f axes;
  axes.col(0) = fingers;
  axes.col(1) = palm;
  axes.col(2) = fingers.cross(palm);
  return axes;
}

}  // namespace

Quaternionf hand_from_wrist() {
  static const Quaternionf rotation = [] {
    // As features measure a hand: fingers from wrist to middle knuckle, palm across the knuckles (hand_points.h).
    const Signer signer = make_signer();
    const auto knuckle = [&](std::size_t finger) {
      return signer.skeleton->joint(signer.left.fingers[finger][0]).offset;
    };
    const Vector3f fingers = knuckle(2).normalized();
    const Vector3f palm = fingers.cross(knuckle(1) - knuckle(4)).normalized();
    const Matrix3f turned = columns(Vector3f::UnitZ(), -Vector3f::UnitY()) * columns(fingers, palm).transpose();
    return Quaternionf(turned).normalized();
  }();
  return rotation;
}

/// Poses the hand in signer-centred space with that origin (model space) and yaw.
void Arms::aim_limb(Limb& limb, const SignerHand& wanted, Side side, const Vector3f& origin, float yaw) const {
  const Quaternionf model_from_signer = turn(static_cast<double>(yaw), Vector3f::UnitY());
  const Quaternionf in_model = model_from_signer * wanted.hand;
  const Quaternionf hand = (side == Side::left ? in_model : mirrored(in_model)) * hand_from_wrist();
  const Vector3f palm_from_wrist = 0.5f * signer_.skeleton->joint(signer_.left.fingers[2][0]).offset;
  limb.wrist = on_left(origin + model_from_signer * wanted.palm, side) - hand * palm_from_wrist;
  const WristAngles elbow{.swivel = wanted.swivel};
  const Quaternionf fore_arm = solve_arm(limb.posed.shoulder, limb.wrist, sizes_, elbow).fore_arm;
  WristAngles angles = wrist_angles(fore_arm.conjugate() * hand);
  angles.swivel = wanted.swivel;
  limb.angles = limited(angles);
}

Arms::Limbs Arms::wanted_limbs(double frame, const Trunk& trunk) const {
  const std::array<SignerHand, 2> wanted = {hands_(Side::left, frame), hands_(Side::right, frame)};
  Limbs limbs;
  for (const Side side : kSides) {
    const auto which = static_cast<std::size_t>(side);
    limbs[which].fingers = finger_rotations(wanted[which].fingers, side);
    limbs[which].wrist = shoulder_ + on_left(wanted[which].palm, side);
  }
  // The shoulders follow the hands, and the space in which the hands are wanted follows the shoulders.
  for (int round = 0; round < 6; ++round) {
    for (const Side side : kSides) {
      Limb& limb = limbs[static_cast<std::size_t>(side)];
      limb.posed = pose_arm(side, limb.wrist, limb.angles, trunk);
    }
    const Vector3f left = limbs[0].posed.shoulder;
    const Vector3f right = on_left(limbs[1].posed.shoulder, Side::right);
    const Vector3f across = left - right;
    const float yaw = std::atan2(-across.z(), across.x());
    for (const Side side : kSides) {
      const auto which = static_cast<std::size_t>(side);
      aim_limb(limbs[which], wanted[which], side, 0.5f * (left + right), yaw);
    }
  }
  for (const Side side : kSides) pose_limb(limbs[static_cast<std::size_t>(side)], side, trunk);
  return limbs;
}

}  // namespace signweave::demo
