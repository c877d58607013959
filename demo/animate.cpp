#include "demo/animate.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "demo/arm.h"
#include "demo/arms.h"
#include "signweave/motion/kinematics.h"

namespace signweave::demo {
namespace {

using Eigen::AngleAxisf;
using Eigen::Matrix3f;
using Eigen::Quaternionf;
using Eigen::Vector3f;

/// Fills the frames of one motion in order.
class Animator {
 public:
  Animator(const Signer& signer, std::vector<BodyFrame> body, FaceMotion face, Arms arms)
      : signer_(signer), body_(std::move(body)), face_(std::move(face)), arms_(std::move(arms)) {}

  /// Must be called for every frame, in order, before any is filled. Overwrites `pose`.
  void look_ahead(std::int64_t frame, MutablePoseView pose) {
    arms_.look_ahead(frame, stand(body_[static_cast<std::size_t>(frame)], pose));
  }
  void yield_smoothly() { arms_.yield_smoothly(); }

  void fill(std::int64_t frame, MutablePoseView pose) {
    const BodyFrame& body = body_[static_cast<std::size_t>(frame)];
    const Trunk trunk = stand(body, pose);
    fill_face(frame, body, pose);
    arms_.fill(frame, trunk, pose);
    for (const Side side : kSides) fill_leg(side, pose);
  }

  /// The face's tracks; valid once every frame is filled.
  FaceMotion take_face() { return std::move(face_); }

 private:
  static Quaternionf& of(MutablePoseView pose, JointIndex joint) {
    return pose.rotations[static_cast<std::size_t>(joint)];
  }
  const Vector3f& position(JointIndex joint) const { return model_.positions[static_cast<std::size_t>(joint)]; }
  const Quaternionf& rotation(JointIndex joint) const { return model_.rotations[static_cast<std::size_t>(joint)]; }

  Trunk stand(const BodyFrame& body, MutablePoseView pose) {
    fill_trunk(body, pose);
    to_model_space(*signer_.skeleton, pose, model_);
    return {model_, keep_out_of(signer_, model_), body.breath};
  }

  void fill_trunk(const BodyFrame& body, MutablePoseView pose) {
    const Vector3f x = Vector3f::UnitX();
    const Vector3f y = Vector3f::UnitY();
    const Vector3f z = Vector3f::UnitZ();
    // The knees stay slightly bent, so the hips are lower than in the rest pose.
    pose.translations[0] = signer_.skeleton->joint(signer_.hips).offset + body.hips - 0.014f * y;
    of(pose, signer_.hips) = turn(body.hips_yaw, y) * turn(body.hips_roll, z);
    of(pose, signer_.spine) = turn(0.35 * body.pitch, x) * turn(0.3 * body.roll, z);
    of(pose, signer_.spine1) =
        turn(0.35 * body.yaw, y) * turn(0.35 * body.pitch - 0.006 * body.breath, x) * turn(0.3 * body.roll, z);
    of(pose, signer_.spine2) =
        turn(0.65 * body.yaw, y) * turn(0.30 * body.pitch - 0.014 * body.breath, x) * turn(0.4 * body.roll, z);
    // The neck compensates for the rotation of the trunk.
    const double yaw = body.head_yaw - body.yaw - body.hips_yaw;
    const double pitch = body.head_pitch - body.pitch + 0.014 * body.breath;
    const double roll = body.head_roll - body.roll - body.hips_roll;
    const auto part = [&](double share) {
      return turn(share * yaw, y) * turn(share * pitch, x) * turn(share * roll, z);
    };
    of(pose, signer_.neck) = part(0.25);
    of(pose, signer_.neck1) = part(0.25);
    of(pose, signer_.head) = part(0.5);
  }

  /// Fills eyes and jaw, and the lids that follow the eyes.
  void fill_face(std::int64_t frame, const BodyFrame& body, MutablePoseView pose) {
    constexpr double kMost = 0.43;  // radians
    const Vector3f look = rotation(signer_.head).conjugate() * body.look;
    const double yaw = std::clamp(static_cast<double>(std::atan2(look.x(), look.z())), -kMost, kMost);
    const double down = std::clamp(static_cast<double>(-std::asin(std::clamp(look.y(), -1.0f, 1.0f))), -kMost, kMost);
    for (const Side side : kSides) {
      of(pose, signer_.side(side).eye) = turn(yaw, Vector3f::UnitY()) * turn(down, Vector3f::UnitX());
    }
    const auto at = static_cast<std::size_t>(frame);
    for (const FaceTrack lid : {FaceTrack::eyeBlinkLeft, FaceTrack::eyeBlinkRight}) {
      float& weight = face_.tracks[static_cast<std::size_t>(lid)][at];
      const auto lowered = static_cast<float>(0.42 * std::max(0.0, down) / kMost);
      weight = lowered + (1 - lowered) * weight;
    }
    of(pose, signer_.jaw) =
        turn(0.02 + 0.24 * static_cast<double>(face_.of(FaceTrack::jawOpen)[at]), Vector3f::UnitX());
  }

  /// The feet stay where they are in the rest pose, whatever the hips do.
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
  std::vector<BodyFrame> body_;
  FaceMotion face_;
  Arms arms_;
  ModelPose model_;  ///< of the frame being filled; valid for trunk, head and hips only
};

Motion animated(const Signer& signer, FrameRate rate, std::vector<BodyFrame> body, FaceMotion face, Arms arms) {
  const auto frames = static_cast<std::int64_t>(body.size());
  Animator animator(signer, std::move(body), std::move(face), std::move(arms));
  Motion motion(signer.skeleton, rate, frames);
  for (std::int64_t frame = 0; frame < frames; ++frame) animator.look_ahead(frame, motion.pose(frame));
  animator.yield_smoothly();
  for (std::int64_t frame = 0; frame < frames; ++frame) animator.fill(frame, motion.pose(frame));
  keep_hemisphere(motion);
  FaceMotion shown = animator.take_face();
  for (std::size_t i = 0; i < kFaceTracks; ++i) {
    motion.add_track({std::string(name_of(static_cast<FaceTrack>(i))), std::move(shown.tracks[i])});
  }
  return motion;
}

}  // namespace

Motion animate(const Signer& signer, const Timeline& timeline, const HandPlan& plan, Random& random) {
  std::vector<BodyFrame> body = move_body(timeline, plan, random);
  FaceMotion face = face_of(timeline, random);
  return animate(signer, timeline.rate, std::move(body), std::move(face), plan, random);
}

Motion animate(const Signer& signer, FrameRate rate, std::vector<BodyFrame> body, FaceMotion face, const HandPlan& plan,
               Random& random) {
  return animated(signer, rate, std::move(body), std::move(face), Arms(signer, plan, rate.hertz(), random));
}

Motion animate(const Signer& signer, FrameRate rate, std::vector<BodyFrame> body, FaceMotion face, const HandPlan& plan,
               SignerHands hands, Random& random) {
  return animated(signer, rate, std::move(body), std::move(face),
                  Arms(signer, plan, std::move(hands), rate.hertz(), random));
}

}  // namespace signweave::demo
