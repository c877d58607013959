#pragma once

#include <Eigen/Geometry>
#include <array>
#include <memory>
#include <optional>

#include "signweave/features/hand_points.h"
#include "signweave/inflection/spline.h"
#include "signweave/render/hand_meter.h"
#include "signweave/score/motion_clip.h"
#include "signweave/space/stroke_change.h"
#include "signweave/transition/arm_reach.h"
#include "signweave/transition/wrist_limits.h"

namespace signweave {

/// The axes in which a stroke is changed: those of signer-centred space in the stroke's first frame.
struct StrokeSpace {
  Eigen::Vector3f origin = Eigen::Vector3f::Zero();  ///< metres, model space
  Eigen::Quaternionf model_from_signer = Eigen::Quaternionf::Identity();

  Eigen::Vector3f to_signer(const Eigen::Vector3f& point) const {
    return model_from_signer.conjugate() * (point - origin);
  }
  Eigen::Vector3f to_model(const Eigen::Vector3f& point) const { return origin + model_from_signer * point; }
};

/// A hand in one pose, in the axes of a stroke's space, metres.
struct HandInSpace {
  Eigen::Vector3f palm = Eigen::Vector3f::Zero();
  Eigen::Quaternionf turn = Eigen::Quaternionf::Identity();  ///< the wrist joint's rotation
  Eigen::Vector3f index_base = Eigen::Vector3f::Zero();      ///< the index finger's knuckle; zero if the rig has none
  Eigen::Vector3f index_tip = Eigen::Vector3f::Zero();
  Eigen::Vector3f shoulder = Eigen::Vector3f::Zero();
  Eigen::Vector3f elbow = Eigen::Vector3f::Zero();
  Eigen::Vector3f wrist = Eigen::Vector3f::Zero();
};

/// Puts changed strokes on a signer, pose by pose. Created once per signer; used by one thread; allocates nothing once
/// created and given a change.
class StrokeChanger {
 public:
  /// Changes nothing if the signer's body or arms are unknown (`why_not`). `rig` must not be null.
  StrokeChanger(const Skeleton& skeleton, std::shared_ptr<const SignerRig> rig);

  /// Empty, or the reason why arms cannot be moved: "no left elbow: name it in a mapping file".
  const std::string& why_not() const noexcept { return why_not_; }
  bool has(Side side) const noexcept { return arms_[static_cast<std::size_t>(side)].has_value(); }
  bool has_index(Side side) const noexcept { return has(side) && arm(side).has_index; }
  const SignerBody& body() const noexcept { return *rig_->signer.body; }
  const Skeleton& skeleton() const noexcept { return *skeleton_; }
  HandMeter& meter() noexcept { return meter_; }

  StrokeSpace space_of(PoseView pose);
  /// Precondition: has(side).
  HandInSpace look(PoseView pose, const StrokeSpace& space, Side side);

  /// How well a pose could be changed.
  struct Fit {
    std::array<float, 2> missed{};  ///< [Side] metres from the wrist's place: the arm is too short, or too folded
  };
  /// Changes a pose by a share `weight` from 0 to 1, at a `time` of the stroke from 0 to 1. Of weight 0 the pose keeps
  /// its bits. Trunk, shoulders, elbows and wrists are turned; fingers keep their rotations.
  Fit apply(const StrokeChange& change, const std::array<PathSpline, 2>& paths, const StrokeSpace& space, float weight,
            float time, MutablePoseView pose);

  /// The bend of a wrist in the pose of the last `look` or `apply`; zero without fingers.
  WristBend bend(Side side) const;
  /// The joints of both arms and hands in the pose that was changed last, and of head and trunk; model space.
  const ModelPose& model() const noexcept { return model_; }

 private:
  struct Arm {
    ArmJoints joints;
    HandPlaces places;
    bool has_index = false;
    JointChains chains;          ///< of this hand, with all ancestors
    JointChains below_shoulder;  ///< down to the wrist
    HandPoints points;
  };
  /// Where a hand was and where it goes, model space.
  struct Goal {
    Eigen::Vector3f palm, wanted;
    Eigen::Quaternionf turn;   ///< to be applied to the hand
    Eigen::Quaternionf carry;  ///< to be applied to the arm first
    float swivel = 0;
  };
  Arm& arm(Side side) noexcept { return *arms_[static_cast<std::size_t>(side)]; }
  const Arm& arm(Side side) const noexcept { return *arms_[static_cast<std::size_t>(side)]; }
  void add_arm(Side side);
  void turn_trunk(float yaw, MutablePoseView pose);
  float put(Side side, const Goal& goal, MutablePoseView pose);
  void update_below_shoulder(Side side, PoseView pose);

  const Skeleton* skeleton_;
  std::shared_ptr<const SignerRig> rig_;
  std::string why_not_;
  std::array<std::optional<Arm>, 2> arms_;  ///< [Side]
  JointChains all_;                         ///< of both arms with hands, trunk and head
  HandMeter meter_;
  ModelPose model_;
};

}  // namespace signweave
