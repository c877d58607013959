#include "demo/arms.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace signweave::demo {
namespace {

using Eigen::AngleAxisf;
using Eigen::Quaternionf;
using Eigen::Vector3f;

Vector3f in_mirror(const Vector3f& v) {
  return {-v.x(), v.y(), v.z()};
}
Vector3f as_left(const Vector3f& v, Side side) {
  return side == Side::left ? v : in_mirror(v);
}
Quaternionf as_left(const Quaternionf& q, Side side) {
  return side == Side::left ? q : mirrored(q);
}

Vector3f middle_of(const std::vector<Vector3f>& points) {
  Vector3f sum = Vector3f::Zero();
  for (const Vector3f& point : points) sum += point;
  return sum / static_cast<float>(points.size());
}

/// The longest vector among 2 × half + 1 neighbours.
std::vector<Vector3f> widened(const std::vector<Vector3f>& values, int half) {
  const auto count = static_cast<int>(values.size());
  std::vector<Vector3f> result(values.size());
  for (int i = 0; i < count; ++i) {
    for (int k = std::max(0, i - half); k <= std::min(count - 1, i + half); ++k) {
      const Vector3f& value = values[static_cast<std::size_t>(k)];
      Vector3f& longest = result[static_cast<std::size_t>(i)];
      if (k == std::max(0, i - half) || value.squaredNorm() > longest.squaredNorm()) longest = value;
    }
  }
  return result;
}

/// Running means over 2 × half + 1 frames.
std::vector<Vector3f> smoothed(const std::vector<Vector3f>& values, int half) {
  const auto count = static_cast<int>(values.size());
  std::vector<Vector3f> result(values.size());
  for (int i = 0; i < count; ++i) {
    Vector3f sum = Vector3f::Zero();
    for (int k = i - half; k <= i + half; ++k) sum += values[static_cast<std::size_t>(std::clamp(k, 0, count - 1))];
    result[static_cast<std::size_t>(i)] = sum / static_cast<float>(2 * half + 1);
  }
  return result;
}

float mix(float a, float b, float t) {
  return a + t * (b - a);
}

WristAngles mix(const WristAngles& a, const WristAngles& b, float t) {
  return {.twist = mix(a.twist, b.twist, t),
          .flexion = mix(a.flexion, b.flexion, t),
          .radial = mix(a.radial, b.radial, t),
          .swivel = mix(a.swivel, b.swivel, t)};
}

}  // namespace

ArmIdleMotion::ArmIdleMotion(Random& random)
    : place{{random, 0.2, 1.1}, {random, 0.2, 1.1}, {random, 0.2, 1.1}},
      tremor{{random, 3, 7}, {random, 3, 7}, {random, 3, 7}},
      twist(random, 0.2, 0.9),
      flexion(random, 0.2, 0.9),
      radial(random, 0.2, 0.9),
      swivel(random, 0.05, 0.4),
      fingers{{random, 0.1, 0.8}, {random, 0.1, 0.8}, {random, 0.1, 0.8}, {random, 0.1, 0.8}, {random, 0.1, 0.8}} {}

Arms::Arms(const Signer& signer, const HandPlan& plan, double frames_per_second, Random& random)
    : signer_(signer),
      plan_(plan),
      fps_(frames_per_second),
      idle_motion_{ArmIdleMotion(random), ArmIdleMotion(random)} {
  const Skeleton& skeleton = *signer.skeleton;
  sizes_ = {skeleton.joint(signer.left.fore_arm).offset.norm(), skeleton.joint(signer.left.hand).offset.norm()};
  shoulder_ = signer.rest_position(signer.left.arm);
}

Arms::Arms(const Signer& signer, const HandPlan& plan, SignerHands hands, double frames_per_second, Random& random)
    : Arms(signer, plan, frames_per_second, random) {
  hands_ = std::move(hands);
}

Arms::Limbs Arms::planned_limbs(double frame, const Trunk& trunk) {
  if (hands_) return wanted_limbs(frame, trunk);
  return {planned_limb(Side::left, frame, trunk), planned_limb(Side::right, frame, trunk)};
}

void Arms::look_ahead(std::int64_t frame, const Trunk& trunk) {
  Limbs limbs = planned_limbs(static_cast<double>(frame), trunk);
  const Vector3f before[] = {limbs[0].wrist, limbs[1].wrist};
  yield(limbs, trunk);
  for (std::size_t side = 0; side < 2; ++side) yielded_[side].push_back(limbs[side].wrist - before[side]);
  remember_still(limbs, frame);
}

void Arms::yield_smoothly() {
  const int half = std::max(1, static_cast<int>(0.04 * fps_));
  for (std::vector<Vector3f>& away : yielded_) {
    away = widened(away, 2 * half);  // otherwise smoothing would lower the peaks
    for (int round = 0; round < 3; ++round) away = smoothed(away, half);
  }
}

void Arms::fill(std::int64_t frame, const Trunk& trunk, MutablePoseView pose) {
  Limbs limbs = planned_limbs(static_cast<double>(frame), trunk);
  for (const Side side : kSides) {
    Limb& limb = limbs[static_cast<std::size_t>(side)];
    const Vector3f& away = yielded_[static_cast<std::size_t>(side)][static_cast<std::size_t>(frame)];
    if (away != Vector3f::Zero()) {
      limb.wrist += away;
      pose_limb(limb, side, trunk);
    }
    stay_outside(limb, side, trunk);
    touch(limb, frame, side, trunk, pose);
    write_limb(limb, side, pose);
    keep_still(frame, side, pose);
  }
}

/// Angles of the left arm (the same for the right, mirrored) for a wrist at a position of the sign table.
WristAngles Arms::angles_at(const Vector3f& place, const Vector3f& palm, const Vector3f& fingers, float swivel) const {
  const Vector3f wrist = to_model(place, Side::left);
  const Vector3f clavicle = signer_.rest_position(signer_.left.shoulder);
  const Vector3f shoulder = clavicle + clavicle_rotation(wrist - shoulder_) * (shoulder_ - clavicle);
  return comfortable_wrist(shoulder, wrist, sizes_, palm, fingers, swivel);
}
WristAngles Arms::angles_at(const Vector3f& place, const Vector3f& palm, const Vector3f& fingers) const {
  // The elbow rises with the hand.
  const float high = std::clamp((place.y() + 0.15f) / 0.35f, 0.0f, 1.0f);
  return angles_at(place, palm, fingers, kNaturalSwivel + 0.25f * high * high);
}

/// The arm at an end of a piece of the plan, without variation per token.
const WristAngles& Arms::held(const HandPlan::End& end, Side side) {
  const SignShape* sign = end.sign != nullptr && acts(*end.sign->shape, side) ? end.sign->shape : nullptr;
  return held(sign, side, sign != nullptr ? end.stroke : static_cast<int>(end.rest));
}
const WristAngles& Arms::held(const SignShape* sign, Side side, int which) {
  const auto [at, fresh] = held_.try_emplace({sign, side, which});
  if (fresh) at->second = find_held(sign, side, which);
  return at->second;
}
WristAngles Arms::find_held(const SignShape* sign, Side side, int which) {
  if (sign == nullptr && static_cast<Rest>(which) == Rest::hips) {
    return angles_at(rest_place(Rest::hips), {-1.0f, 0.0f, -0.15f}, {0.05f, -1.0f, 0.22f});
  }
  if (sign == nullptr) return angles_at(rest_place(), {-0.2f, 0.2f, -1.0f}, {-0.46f, -0.68f, 0.45f});
  if (side == Side::left && sign->hands == Hands::on_base) {
    return angles_at(sign->base.place, sign->base.palm, sign->base.fingers);
  }
  const Vector3f place = stroke_place(*sign, side, static_cast<float>(which));
  if (which == 0) return angles_at(place, sign->palm, sign->fingers);
  // During the stroke the elbow stays approximately in place.
  const float swivel = held(sign, side, 0).swivel;
  return angles_at(place, sign->palm_end.value_or(sign->palm), sign->fingers_end.value_or(sign->fingers), swivel);
}
WristAngles Arms::angles_of_end(const HandPlan::End& end, Side side) {
  WristAngles angles = held(end, side);
  if (end.sign != nullptr) {
    angles.twist += end.sign->token.turn;
    angles.flexion += end.sign->token.bend;
    angles = mix(angles, held({.rest = end.rest}, side), end.let_go);
  }
  return angles;
}

Arms::PosedArm Arms::pose_arm(Side side, const Vector3f& wrist, const WristAngles& angles, const Trunk& trunk) const {
  PosedArm posed;
  posed.clavicle = clavicle_rotation(wrist - shoulder_) * turn(0.012 * trunk.breath, Vector3f::UnitZ());
  // Clavicle and arm are attached to the chest, which has its own rotation.
  posed.chest = as_left(trunk.model.rotations[static_cast<std::size_t>(signer_.spine2)], side);
  const Vector3f clavicle_place =
      as_left(trunk.model.positions[static_cast<std::size_t>(signer_.side(side).shoulder)], side);
  posed.shoulder = clavicle_place + posed.chest * posed.clavicle * signer_.skeleton->joint(signer_.left.arm).offset;
  posed.arm = solve_arm(posed.shoulder, wrist, sizes_, angles);
  return posed;
}

/// Wrist, finger joints, tips, and the midpoints between them, model space.
std::vector<Vector3f> Arms::hand_points(const ArmPose& arm, const FingerRotations& fingers, Side side) const {
  const Skeleton& skeleton = *signer_.skeleton;
  std::vector<Vector3f> points = {as_left(arm.wrist, side)};
  points.reserve(1 + 2 * kFingers * (kPhalanges + 1));
  for (std::size_t finger = 0; finger < kFingers; ++finger) {
    Vector3f place = arm.wrist;
    Quaternionf rotation = arm.hand;
    const auto go_on = [&](const Vector3f& offset) {
      const Vector3f next = place + rotation * offset;
      points.push_back(as_left(Vector3f(0.5f * (place + next)), side));
      points.push_back(as_left(next, side));
      place = next;
    };
    for (std::size_t i = 0; i < kPhalanges; ++i) {
      go_on(skeleton.joint(signer_.left.fingers[finger][i]).offset);
      rotation = rotation * as_left(fingers[finger][i], side);
    }
    go_on(signer_.finger_tip(finger));
  }
  return points;
}

WristAngles Arms::angles_in(const HandPlan::Piece& piece, Side side, double frame) {
  const ArmIdleMotion& idle_motion = idle_motion_[static_cast<std::size_t>(side)];
  const double seconds = frame / fps_;
  const auto done = static_cast<float>(HandPlan::done_in(piece, frame));
  WristAngles angles = mix(angles_of_end(piece.from, side), angles_of_end(piece.to, side), done);
  if (piece.is_stroke() && acts(*piece.from.sign->shape, side)) {
    const SignShape& sign = *piece.from.sign->shape;
    const Token& token = piece.from.sign->token;
    const bool base = side == Side::left && sign.hands == Hands::on_base;
    const double u = 2 * static_cast<double>(done) - 1;
    const double window = 1 - u * u * u * u;
    const double turns = std::numbers::pi * static_cast<double>(done) * (base ? 0 : 1);
    const double much = static_cast<double>(token.size * token.small) * window;
    const int times = times_of(sign, token);
    if (sign.movement == Movement::twist) angles.twist += static_cast<float>(0.50 * much * std::sin(2 * times * turns));
    if (sign.movement == Movement::nod) angles.flexion += static_cast<float>(0.42 * much * std::sin(2 * times * turns));
    // Where the arm moves back and forth, the wrist yields slightly.
    if (sign.movement == Movement::repeated) {
      angles.flexion -= static_cast<float>(0.14 * much * std::sin((2 * times - 1) * turns));
    }
  }
  angles.twist += static_cast<float>(0.020 * idle_motion.twist.at(seconds));
  angles.flexion += static_cast<float>(0.020 * idle_motion.flexion.at(seconds));
  angles.radial += static_cast<float>(0.012 * idle_motion.radial.at(seconds));
  angles.swivel += static_cast<float>(0.030 * idle_motion.swivel.at(seconds));
  return limited(angles);
}

HandAngles Arms::fingers_in(const HandPlan::Piece& piece, Side side, double frame) const {
  const ArmIdleMotion& idle_motion = idle_motion_[static_cast<std::size_t>(side)];
  const double seconds = frame / fps_;
  const bool acting = piece.is_stroke() && acts(*piece.from.sign->shape, side);
  const bool flutter = acting && piece.from.sign->shape->movement == Movement::flutter;
  HandAngles from = angles_of(shape_of(piece.from, side));
  HandAngles to = angles_of(shape_of(piece.to, side));
  // A holding hand relaxes slightly.
  const auto loosen = [&](HandAngles& angles, float let_go) {
    const HandAngles& relaxed = angles_of(Handshape::relaxed);
    for (std::size_t finger = 0; finger < kFingers; ++finger) {
      for (std::size_t i = 0; i < kFingerAngles; ++i) {
        angles[finger][i] = mix(angles[finger][i], relaxed[finger][i], 2 * let_go);
      }
    }
  };
  loosen(from, piece.from.let_go);
  loosen(to, piece.to.let_go);
  HandAngles angles = blend(from, to, static_cast<float>(HandPlan::shape_done(piece, frame)));
  const double time = HandPlan::time_in(piece, frame);
  for (std::size_t finger = 0; finger < kFingers; ++finger) {
    double bend = 1.4 * idle_motion.fingers[finger].at(seconds);
    if (flutter) {
      const double window = std::sin(std::numbers::pi * time);
      bend += 17 * static_cast<double>(piece.from.sign->token.size) * window * window *
              (1 + std::sin(2 * std::numbers::pi * 4.2 * seconds + 1.1 * static_cast<double>(finger)));
    }
    const bool thumb = finger == 0;
    angles[finger][thumb ? 2 : 0] += static_cast<float>(bend) * (thumb ? 0.5f : 1.0f);
    angles[finger][thumb ? 3 : 1] += static_cast<float>(0.6 * bend);
    for (std::size_t i = 0; i < kFingerAngles; ++i) {
      const AngleLimits limits = limits_of(static_cast<int>(finger), static_cast<int>(i));
      angles[finger][i] = std::clamp(angles[finger][i], limits.least, limits.most);
    }
  }
  return angles;
}

void Arms::pose_limb(Limb& limb, Side side, const Trunk& trunk) const {
  limb.posed = pose_arm(side, limb.wrist, limb.angles, trunk);
  limb.points = hand_points(limb.posed.arm, limb.fingers, side);
}
/// The planned wrist without its full stops: a hand rounds the corners between a movement and a stroke.
Vector3f Arms::flowing(Side side, double frame) const {
  constexpr float kWeights[] = {1, 2, 3, 2, 1};
  Vector3f sum = Vector3f::Zero();
  for (int i = 0; i < 5; ++i) {
    sum += kWeights[i] / 9 * plan_.at(side, frame + static_cast<double>(i - 2) * 0.018 * fps_);
  }
  return sum;
}
Arms::Limb Arms::planned_limb(Side side, double frame, const Trunk& trunk) {
  const ArmIdleMotion& idle_motion = idle_motion_[static_cast<std::size_t>(side)];
  const double seconds = frame / fps_;
  const HandPlan::Piece& piece = plan_.piece_at(side, frame);
  Limb limb;
  limb.fingers = finger_rotations(fingers_in(piece, side, frame), side);
  limb.angles = angles_in(piece, side, frame);
  limb.wrist = as_left(flowing(side, frame), side);
  for (int i = 0; i < 3; ++i) {
    limb.wrist[i] +=
        static_cast<float>(0.0010 * idle_motion.place[i].at(seconds) + 0.0002 * idle_motion.tremor[i].at(seconds));
  }
  pose_limb(limb, side, trunk);
  return limb;
}

/// Moves colliding hands apart, and out of head and trunk.
void Arms::yield(Limbs& limbs, const Trunk& trunk) const {
  for (int round = 0; round < 5; ++round) {
    const float apart = too_close(limbs[0].points, limbs[1].points);
    if (apart <= 0) break;
    const Vector3f across = middle_of(limbs[0].points) - middle_of(limbs[1].points);
    const Vector3f shift = 0.5f * apart * (across + Vector3f(0.03f, 0, 0)).normalized();
    limbs[0].wrist += shift;
    limbs[1].wrist += in_mirror(-shift);
    for (const Side side : kSides) pose_limb(limbs[static_cast<std::size_t>(side)], side, trunk);
  }
  for (const Side side : kSides) stay_outside(limbs[static_cast<std::size_t>(side)], side, trunk);
}
void Arms::stay_outside(Limb& limb, Side side, const Trunk& trunk) const {
  for (int round = 0; round < 3; ++round) {
    const Vector3f push = push_out(trunk.keep_out, limb.points);
    if (push == Vector3f::Zero()) return;
    limb.wrist += as_left(push, side);
    pose_limb(limb, side, trunk);
  }
}

void Arms::write_limb(const Limb& limb, Side side, MutablePoseView pose) const {
  const SideJoints& joints = signer_.side(side);
  const PosedArm& posed = limb.posed;
  const ArmPose& arm = posed.arm;
  const auto of = [&](JointIndex joint) -> Quaternionf& { return pose.rotations[static_cast<std::size_t>(joint)]; };
  const auto set = [&](JointIndex joint, const Quaternionf& local) { of(joint) = as_left(local, side).normalized(); };
  set(joints.shoulder, posed.clavicle);
  set(joints.arm, (posed.chest * posed.clavicle).conjugate() * arm.arm);
  set(joints.fore_arm, arm.arm.conjugate() * arm.fore_arm);
  set(joints.hand, arm.fore_arm.conjugate() * arm.hand);
  for (std::size_t finger = 0; finger < kFingers; ++finger) {
    for (std::size_t i = 0; i < kPhalanges; ++i) of(joints.fingers[finger][i]) = limb.fingers[finger][i];
  }
}

}  // namespace signweave::demo
