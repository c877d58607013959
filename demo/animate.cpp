#include "demo/animate.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <tuple>

#include "demo/arm.h"
#include "signweave/motion/kinematics.h"

namespace signweave::demo {
namespace {

using Eigen::AngleAxisf;
using Eigen::Matrix3f;
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

Quaternionf turn(double angle, const Vector3f& axis) {
  return Quaternionf(AngleAxisf(static_cast<float>(angle), axis));
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

/// The small unrest of one arm.
struct ArmUnrest {
  explicit ArmUnrest(Random& random)
      : place{{random, 0.2, 1.1}, {random, 0.2, 1.1}, {random, 0.2, 1.1}},
        flexion(random, 0.2, 0.9),
        radial(random, 0.2, 0.9),
        swivel(random, 0.05, 0.4),
        fingers{{random, 0.1, 0.8}, {random, 0.1, 0.8}, {random, 0.1, 0.8}, {random, 0.1, 0.8}, {random, 0.1, 0.8}} {}
  Wander place[3], flexion, radial, swivel, fingers[kFingers];
};

/// Fills the frames of one motion, one after another.
class Animator {
 public:
  Animator(const Signer& signer, const Script& script, const Timeline& timeline, Random& random)
      : signer_(signer),
        plan_(script, timeline),
        fps_(timeline.rate.hertz()),
        hip_{{random, 0.05, 0.35}, {random, 0.05, 0.35}, {random, 0.05, 0.35}},
        trunk_{{random, 0.05, 0.35}, {random, 0.05, 0.35}, {random, 0.05, 0.35}},
        head_{{random, 0.1, 0.7}, {random, 0.1, 0.7}, {random, 0.1, 0.7}},
        arms_{ArmUnrest(random), ArmUnrest(random)},
        breath_(random.uniform(0.22, 0.28)) {
    const Skeleton& skeleton = *signer.skeleton;
    sizes_ = {skeleton.joint(signer.left.fore_arm).offset.norm(), skeleton.joint(signer.left.hand).offset.norm()};
    shoulder_ = signer.rest_position(signer.left.arm);
    rest_ = angles_at(rest_place(), {-0.2f, 0.2f, -1.0f}, {-0.42f, -0.72f, 0.45f});
  }

  void fill(std::int64_t frame, MutablePoseView pose) {
    const double at = static_cast<double>(frame);
    const double seconds = at / fps_;
    const Vector3f right = plan_.at(Side::right, at);
    const Vector3f left = plan_.at(Side::left, at);
    fill_trunk(seconds, right, left, pose);
    to_model_space(*signer_.skeleton, pose, model_);
    for (const Side side : kSides) fill_arm(side, at, side == Side::right ? right : left, pose);
    for (const Side side : kSides) fill_leg(side, pose);
  }

 private:
  static Quaternionf& of(MutablePoseView pose, JointIndex joint) {
    return pose.rotations[static_cast<std::size_t>(joint)];
  }
  const Vector3f& position(JointIndex joint) const { return model_.positions[static_cast<std::size_t>(joint)]; }
  const Quaternionf& rotation(JointIndex joint) const { return model_.rotations[static_cast<std::size_t>(joint)]; }

  /// Angles of the left arm (the right's are the same in the mirror) for a wrist at a place of the sign table.
  WristAngles angles_at(const Vector3f& place, const Vector3f& palm, const Vector3f& fingers,
                        float swivel = kNaturalSwivel) const {
    const Vector3f wrist = to_model(place, Side::left);
    const Vector3f clavicle = signer_.rest_position(signer_.left.shoulder);
    const Vector3f shoulder = clavicle + clavicle_rotation(wrist - shoulder_) * (shoulder_ - clavicle);
    return comfortable_wrist(shoulder, wrist, sizes_, palm, fingers, swivel);
  }

  struct Held {
    WristAngles angles;
    Handshape shape = Handshape::relaxed;
  };
  /// What a hand is like at the begin (done 0) or end (1) of a sign's stroke; at rest where it does not act.
  const Held& held(const SignShape* sign, Side side, int done) {
    const auto [at, fresh] = held_.try_emplace({sign, side, done});
    if (fresh) at->second = find_held(sign, side, done);
    return at->second;
  }
  Held find_held(const SignShape* sign, Side side, int done) {
    if (sign == nullptr || !acts(*sign, side)) return {rest_, Handshape::relaxed};
    if (side == Side::left && sign->hands == Hands::on_base) {
      return {angles_at(sign->base.place, sign->base.palm, sign->base.fingers), sign->base.shape};
    }
    const Vector3f place = stroke_place(*sign, side, static_cast<float>(done));
    if (done == 0) return {angles_at(place, sign->palm, sign->fingers), sign->shape};
    // In the stroke the elbow stays about where it is.
    const float swivel = held(sign, side, 0).angles.swivel;
    return {angles_at(place, sign->palm_end.value_or(sign->palm), sign->fingers_end.value_or(sign->fingers), swivel),
            sign->shape_end.value_or(sign->shape)};
  }

  void fill_trunk(double seconds, const Vector3f& right, const Vector3f& left, MutablePoseView pose) {
    const Vector3f x = Vector3f::UnitX();
    const Vector3f y = Vector3f::UnitY();
    const Vector3f z = Vector3f::UnitZ();
    // The knees keep a little bend, so the hips are lower than in the rest pose.
    const Vector3f sway(static_cast<float>(0.006 * hip_[0].at(seconds)), -0.012f,
                        static_cast<float>(0.004 * hip_[1].at(seconds)));
    pose.translations[0] = signer_.skeleton->joint(signer_.hips).offset + sway;
    of(pose, signer_.hips) = turn(0.012 * hip_[2].at(seconds), y) * turn(0.006 * hip_[0].at(seconds), z);
    const double breath = std::sin(2 * std::numbers::pi * breath_ * seconds);
    // The shoulder of the hand that reaches farther comes forward with it.
    const double reach = 0.12 * static_cast<double>(right.z() - left.z());
    const double pitch = 0.008 * trunk_[0].at(seconds);
    const double roll = 0.010 * trunk_[1].at(seconds);
    const double yaw = 0.010 * trunk_[2].at(seconds) + reach;
    of(pose, signer_.spine) = turn(pitch, x) * turn(0.3 * roll, z);
    of(pose, signer_.spine1) = turn(0.3 * yaw, y) * turn(0.3 * roll, z) * turn(-0.004 * breath, x);
    of(pose, signer_.spine2) = turn(0.7 * yaw, y) * turn(0.4 * roll, z) * turn(-0.007 * breath, x);
    // The head looks at whoever is addressed, and a little after the right hand.
    const double look_yaw =
        0.030 * head_[0].at(seconds) + 0.18 * static_cast<double>(right.x() + rest_place().x()) - 0.6 * yaw;
    const double look_pitch =
        0.020 * head_[1].at(seconds) - 0.10 * static_cast<double>(right.y() - 1.30f) - 0.5 * pitch + 0.02;
    const double look_roll = 0.020 * head_[2].at(seconds);
    const auto part = [&](double share) {
      return turn(share * look_yaw, y) * turn(share * look_pitch, x) * turn(share * look_roll, z);
    };
    of(pose, signer_.neck) = part(0.25);
    of(pose, signer_.neck1) = part(0.25);
    of(pose, signer_.head) = part(0.5);
    for (const Side side : kSides) {  // the eyes stay with the addressee while the head moves
      of(pose, signer_.side(side).eye) = turn(-0.7 * look_yaw, y) * turn(-0.7 * look_pitch, x);
    }
    of(pose, signer_.jaw) = turn(0.02 + 0.012 * head_[1].at(seconds + 7), x);
  }

  void fill_arm(Side side, double frame, const Vector3f& planned, MutablePoseView pose) {
    const SideJoints& joints = signer_.side(side);
    ArmUnrest& unrest = arms_[side == Side::left ? 0 : 1];
    const double seconds = frame / fps_;
    const WristPlan::Piece& piece = plan_.piece_at(frame);
    const double time = WristPlan::time_in(piece, frame);
    const auto done = static_cast<float>(WristPlan::done_in(piece, frame));
    const bool stroke = piece.from == piece.to;

    const Held& from = held(piece.from, side, stroke ? 0 : 1);
    const Held& to = held(piece.to, side, stroke ? 1 : 0);
    WristAngles angles = mix(from.angles, to.angles, done);
    angles.flexion += static_cast<float>(0.020 * unrest.flexion.at(seconds));
    angles.radial += static_cast<float>(0.012 * unrest.radial.at(seconds));
    angles.swivel += static_cast<float>(0.030 * unrest.swivel.at(seconds));
    Vector3f wrist = planned;
    for (int i = 0; i < 3; ++i) wrist[i] += static_cast<float>(0.0015 * unrest.place[i].at(seconds));
    wrist = as_left(wrist, side);

    const double breath = std::sin(2 * std::numbers::pi * breath_ * seconds);
    const Quaternionf clavicle = clavicle_rotation(wrist - shoulder_) * turn(0.006 * breath, Vector3f::UnitZ());
    // Clavicle and arm hang on the chest, which has its own rotation.
    const Quaternionf chest = as_left(rotation(signer_.spine2), side);
    const Vector3f clavicle_place = as_left(position(joints.shoulder), side);
    const Vector3f to_shoulder = signer_.skeleton->joint(signer_.left.arm).offset;
    const Vector3f shoulder = clavicle_place + chest * clavicle * to_shoulder;
    const ArmPose arm = solve_arm(shoulder, wrist, sizes_, angles);
    const auto set = [&](JointIndex joint, const Quaternionf& local) {
      of(pose, joint) = as_left(local, side).normalized();
    };
    set(joints.shoulder, clavicle);
    set(joints.arm, (chest * clavicle).conjugate() * arm.arm);
    set(joints.fore_arm, arm.arm.conjugate() * arm.fore_arm);
    set(joints.hand, arm.fore_arm.conjugate() * arm.hand);

    std::array<float, kFingers> bend{};
    const bool flutter =
        stroke && piece.from != nullptr && piece.from->movement == Movement::flutter && acts(*piece.from, side);
    for (std::size_t i = 0; i < kFingers; ++i) {
      double extra = 0.025 * unrest.fingers[i].at(seconds);
      if (flutter) {
        const double window = std::sin(std::numbers::pi * time);
        extra += 0.32 * window * window *
                 (1 + std::sin(2 * std::numbers::pi * 4.2 * seconds + 1.1 * static_cast<double>(i)));
      }
      bend[i] = static_cast<float>(extra);
    }
    const double formed = std::clamp((time - piece.shape_begin) / (piece.shape_end - piece.shape_begin), 0.0, 1.0);
    const auto eased = static_cast<float>(formed * formed * formed * (10 + formed * (6 * formed - 15)));
    const FingerRotations hand =
        blend(finger_rotations(from.shape, side, bend), finger_rotations(to.shape, side, bend), eased);
    for (std::size_t finger = 0; finger < kFingers; ++finger) {
      for (std::size_t i = 0; i < kPhalanges; ++i) of(pose, joints.fingers[finger][i]) = hand[finger][i];
    }
  }

  /// Feet stand where they stood in the rest pose, whatever the hips do.
  void fill_leg(Side side, MutablePoseView pose) {
    const SideJoints& joints = signer_.side(side);
    const Vector3f hip = signer_.rest_position(joints.up_leg);
    const Vector3f knee = signer_.rest_position(joints.leg);
    const Vector3f foot = signer_.rest_position(joints.foot);
    const auto rotation_to = [](const Vector3f& rest, const Vector3f& now, const Vector3f& hinge) {
      const auto axes = [](const Vector3f& along, const Vector3f& across) {
        Matrix3f m;
        m.col(0) = along.normalized();
        m.col(2) = m.col(0).cross(across).normalized();
        m.col(1) = m.col(2).cross(m.col(0));
        return m;
      };
      return Quaternionf(Matrix3f(axes(now, hinge) * axes(rest, Vector3f::UnitX()).transpose())).normalized();
    };
    const Vector3f start = position(joints.up_leg);
    const TwoBones bones =
        solve_two_bones(start, foot, (knee - hip).norm(), (foot - knee).norm(), Vector3f(0.1f * sign_of(side), 0, 1));
    const Quaternionf upper = rotation_to(knee - hip, bones.middle - start, bones.hinge);
    const Quaternionf lower = rotation_to(foot - knee, bones.end - bones.middle, bones.hinge);
    of(pose, joints.up_leg) = (rotation(signer_.hips).conjugate() * upper).normalized();
    of(pose, joints.leg) = (upper.conjugate() * lower).normalized();
    of(pose, joints.foot) = lower.conjugate();
  }

  const Signer& signer_;
  WristPlan plan_;
  double fps_;
  Wander hip_[3], trunk_[3], head_[3];
  ArmUnrest arms_[2];
  double breath_;
  ArmSizes sizes_{};
  Vector3f shoulder_;  ///< the left one in the rest pose
  WristAngles rest_;
  std::map<std::tuple<const SignShape*, Side, int>, Held> held_;  ///< found once: each takes a search
  ModelPose model_;  ///< of the frame being filled, right for the trunk and hips only
};

}  // namespace

Motion animate(const Signer& signer, const Script& script, const Timeline& timeline, Random& random) {
  Animator animator(signer, script, timeline, random);
  Motion motion(signer.skeleton, timeline.rate, timeline.frames);
  for (std::int64_t frame = 0; frame < timeline.frames; ++frame) animator.fill(frame, motion.pose(frame));
  keep_hemisphere(motion);
  return motion;
}

}  // namespace signweave::demo
