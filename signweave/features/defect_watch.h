#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "signweave/features/defects.h"
#include "signweave/motion/kinematics.h"

/// The parts of `find_defects`. Each is shown the frames in order, once, and then asked what it found. Internal to
/// `features`.
namespace signweave::defect {

/// Jumps of joints in their parents, of translated joints and of the root in the room. A step from one frame to the
/// next is compared with those beside it: a quick movement speeds up and slows down, a jump does neither. One frame
/// that is out of place makes two steps, there and back, which are judged as one.
class JumpWatch {
 public:
  explicit JumpWatch(const Motion& motion);
  void see(std::int64_t frame);
  std::vector<Defect> found();

 private:
  static constexpr std::int64_t kRing = 5;
  struct Jump {
    std::int64_t frame;  ///< the first in the new place
    JointIndex joint;
    bool turns;    ///< else it shifts
    float step;    ///< radians or metres
    float around;  ///< of the frames beside it, the larger one
  };
  /// Steps into one frame from the frame before.
  struct Steps {
    std::vector<float> turns;   ///< [joint] radians
    std::vector<float> shifts;  ///< [translated joint] metres
    bool repeated = false;      ///< the whole frame is the one before again
  };
  const Steps& into(std::int64_t frame) const { return ring_[static_cast<std::size_t>(frame % kRing)]; }
  template <typename Distance>
  float around(std::int64_t frame, std::vector<float> Steps::*what, std::size_t index, const Distance& distance) const;
  void judge(std::int64_t frame);
  float lever(std::int64_t frame, JointIndex joint);

  const Motion& motion_;
  double hertz_;
  std::array<Steps, kRing> ring_;
  std::vector<float> reach_;  ///< [joint] metres to the farthest point that it carries, at most
  std::vector<std::vector<JointIndex>> carried_;
  ModelPose model_;
  std::int64_t model_of_ = -1;
  std::int64_t seen_ = 0;
  std::vector<Jump> jumps_;
};

/// Joints whose numbers keep to the bit: for a long stretch while the body moves, or throughout.
class StillWatch {
 public:
  StillWatch(const Motion& motion, const RigMap& rig);
  void see(std::int64_t frame);
  std::vector<Defect> found();

 private:
  struct Run {
    JointIndex joint;
    FrameRange frames;
  };
  struct Joint {
    std::int64_t since = 0;        ///< the first frame of the present run
    std::int64_t changes = 0;      ///< steps in which it moved
    std::int64_t short_still = 0;  ///< steps in which it did not, outside long runs
  };
  void end_run(JointIndex joint, std::int64_t end);
  bool is_frozen(const Run& run, std::int64_t live) const;
  bool comes_back(const Run& run) const;
  void tell_frozen(std::vector<Defect>& out) const;
  /// Of the parts that sign: neck, head, arms, hands and fingers. Helper joints and feet may rest for ever.
  std::vector<JointIndex> signing_joints_that_never_move() const;

  const Motion& motion_;
  const RigMap& rig_;
  std::int64_t shortest_;  ///< frames of a long stretch
  std::vector<Joint> joints_;
  std::vector<std::int64_t> in_long_runs_;  ///< [joint] steps
  std::vector<std::uint16_t> moving_;       ///< [frame] joints that changed in the step into it
  std::vector<Run> runs_;                   ///< the long ones
};

/// T-pose: arms straight out sideways, both.
class TPoseWatch {
 public:
  TPoseWatch(const Motion& motion, const RigMap& rig);
  /// False where the rig lacks what is needed; then it need not be shown anything.
  bool can_tell() const noexcept { return can_tell_; }
  void see(std::int64_t frame, const ModelPose& model);
  std::vector<Defect> found();

 private:
  void end_stretch(std::int64_t end);

  const Motion& motion_;
  const RigMap& rig_;
  bool can_tell_;
  std::int64_t since_ = -1;
  double way_ = 0;  ///< metres that the wrists travelled within the stretch
  std::array<Eigen::Vector3f, 2> wrists_;
  std::vector<Defect> found_;
};

/// Quaternions that leave the hemisphere of the frame before, and numbers that are none.
class NumberWatch {
 public:
  explicit NumberWatch(const Motion& motion);
  /// False where the frame holds numbers that are none, which nobody else should be shown.
  bool see(std::int64_t frame);
  std::vector<Defect> found();

 private:
  struct Bad {
    JointIndex joint;
    FrameRange frames;
  };
  const Motion& motion_;
  std::vector<Bad> bad_;
  std::vector<std::int64_t> bad_until_;  ///< [joint] index + 1 of its last entry in bad_, 0 none
  std::vector<Defect> flips_;
};

/// The root's columns look exchanged: its rotation keeps to the bit and is what its offset makes as an angle.
bool has_permuted_root(const Motion& motion);

/// Stature beyond that of people; nothing where the rig lacks head or feet.
std::vector<Defect> odd_scale(const Motion& motion, const RigMap& rig);

/// "LeftHand", "LeftHand and RightHand", "LeftHand, RightHand and 5 more".
std::string names_of(const Skeleton& skeleton, const std::vector<JointIndex>& joints, std::size_t most = 3);

}  // namespace signweave::defect
