#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <vector>

#include "signweave/features/defects.h"
#include "signweave/motion/kinematics.h"

/// The detectors that `find_defects` uses. Each receives the frames once, in order, then returns what it found.
/// Internal to `features`.
namespace signweave::defect {

/// The defects of one kind: the first ones, and the number of further ones.
struct Found {
  std::vector<Defect> defects;  ///< at most kMostDefects
  std::size_t more = 0;
};

/// Detects jumps of joints relative to their parents, of translated joints and of the root. The step from one frame to
/// the next is compared with the adjacent steps: a quick movement accelerates and decelerates, a jump does neither. A
/// single misplaced frame produces two steps, away and back, which are reported as one jump. More than fifteen members:
/// the state for joints, the root and the current frame.
class JumpWatch {
 public:
  /// Returns true for a jump that is not a defect, given its first frame and its joint (kNoJoint: the whole body).
  using Excuse = std::function<bool(std::int64_t frame, JointIndex joint)>;
  explicit JumpWatch(const Motion& motion, Excuse excuse = {});
  /// Must be called for every frame. A frame that is not `whole` contains non-finite values; steps to and from it are
  /// ignored.
  void see(std::int64_t frame, bool whole = true);
  Found found();

 private:
  static constexpr std::int64_t kRing = 5;
  /// A jump of one joint in one frame or in several adjacent frames, or of many joints in one frame.
  struct Jump {
    std::int64_t first = -1;  ///< first frame at the new position; -1: no jump
    std::int64_t last = -1;   ///< frame
    JointIndex joint = kNoJoint;
    bool turns = true;      ///< rotation; false: translation
    float step = 0;         ///< largest step, radians or metres
    float around = 0;       ///< the larger of the adjacent steps
    std::size_t count = 1;  ///< number of joints; if more than one, `joint` is the fastest
  };
  /// The steps from the previous frame into one frame.
  struct Steps {
    std::vector<float> turns;   ///< [joint] radians
    std::vector<float> shifts;  ///< [translated joint] metres
    bool repeated = false;      ///< the frame equals the previous one
  };
  const Steps& into(std::int64_t frame) const { return ring_[static_cast<std::size_t>(frame % kRing)]; }
  template <typename Distance>
  float around(std::int64_t frame, std::vector<float> Steps::*what, std::size_t index, const Distance& distance) const;
  void judge(std::int64_t frame);
  void gather(std::int64_t frame);
  static bool comes_before(const Jump& a, const Jump& b) noexcept;
  void keep(const Jump& jump);
  Defect defect_of(const Jump& jump) const;
  bool reaches_beyond(std::int64_t frame, JointIndex joint, double lever);

  const Motion& motion_;
  Excuse excuse_;
  double hertz_;
  std::size_t many_;  ///< number of simultaneous joints that count as the whole body
  std::array<Steps, kRing> ring_;
  std::vector<float> reach_;  ///< [joint] upper bound of the distance to the farthest point that it carries, metres
  std::vector<std::vector<JointIndex>> carried_;
  std::vector<std::vector<Tip>> tips_;  ///< [joint]
  ModelPose model_;
  std::int64_t model_of_ = -1;
  std::size_t looked_at_ = 0;     ///< points visited for the levers of frame model_of_
  std::vector<JointIndex> open_;  ///< scratch memory of reaches_beyond
  std::int64_t seen_ = 0;
  bool last_whole_ = false;
  std::vector<Jump> now_;                  ///< jumps of the frame being evaluated
  std::array<std::vector<Jump>, 2> near_;  ///< [turns][joint] the latest jump, which the next may extend
  std::vector<Jump> kept_;                 ///< the earliest jumps, fewer than 2 * kMostDefects
  std::size_t jumps_ = 0;                  ///< number of all jumps
};

/// Detects joints whose values stay bit-identical for a long time while the body moves, or throughout. Frames that are
/// not passed to `see` are treated as if they did not exist.
class StillWatch {
 public:
  StillWatch(const Motion& motion, const RigMap& rig);
  void see(std::int64_t frame);
  Found found();

 private:
  struct Run {
    JointIndex joint;
    FrameRange steps;  ///< indices of shown_
  };
  struct Joint {
    std::int64_t since = 0;        ///< first index in shown_ of the current run
    std::int64_t changes = 0;      ///< steps in which the joint moved
    std::int64_t short_still = 0;  ///< steps in which it did not move, outside long runs
  };
  struct Together {
    FrameRange frames;
    std::vector<JointIndex> joints;  ///< ascending
  };
  std::int64_t count() const noexcept { return static_cast<std::int64_t>(shown_.size()); }
  const Eigen::Quaternionf& rotation(std::int64_t index, JointIndex joint) const;
  void end_run(JointIndex joint, std::int64_t end);
  std::vector<Run> frozen_runs() const;
  /// Removes the runs (all of one joint) whose value also occurs outside them.
  void erase_recurring(std::vector<Run>& runs) const;
  std::vector<Together> lost_together(std::vector<Run> frozen) const;
  /// Considers only the parts used for signing: neck, head, arms, hands and fingers. Helper joints and feet may rest
  /// throughout.
  std::vector<JointIndex> motionless_signing_joints() const;

  const Motion& motion_;
  const RigMap& rig_;
  std::int64_t shortest_;  ///< minimum length of a long run, frames
  std::vector<Joint> joints_;
  std::vector<std::int64_t> shown_;    ///< frames
  std::vector<std::uint16_t> moving_;  ///< [index of shown_] number of joints that changed in the step into it
  std::vector<Run> runs_;              ///< long runs only
};

/// Detects the T-pose: both arms stretched out sideways.
class TPoseWatch {
 public:
  TPoseWatch(const Motion& motion, const RigMap& rig);
  /// Returns false if the rig lacks the required joints; `see` need not be called then.
  bool can_tell() const noexcept { return can_tell_; }
  void see(std::int64_t frame, const ModelPose& model);
  std::vector<Defect> found();

 private:
  void end_pose(bool at_end);

  const Motion& motion_;
  const RigMap& rig_;
  bool can_tell_ = true;
  std::int64_t first_ = -1;  ///< first frame passed to `see`
  std::int64_t since_ = -1;
  std::int64_t until_ = -1;  ///< one past the last frame of the current T-pose
  double travel_ = 0;        ///< metres travelled by both wrists during the current T-pose
  std::array<Eigen::Vector3f, 2> wrists_;
  std::vector<Defect> found_;
};

/// Detects quaternions that leave the hemisphere of the previous frame, and values that are not finite.
class NumberWatch {
 public:
  explicit NumberWatch(const Motion& motion);
  /// Returns false if the frame contains non-finite values; other detectors must then not use it.
  bool see(std::int64_t frame);
  Found flips() const;
  Found not_finite() const;

 private:
  struct JointFrames {
    JointIndex joint;
    FrameRange frames;
  };
  /// The latest range of frames in which a joint has non-finite values.
  struct Latest {
    std::int64_t end = -1;    ///< one past its last frame
    std::size_t kept_at = 0;  ///< index in bad_; past the end if the range was only counted
  };
  void flag(JointIndex joint, std::int64_t frame);

  const Motion& motion_;
  std::vector<Latest> latest_;            ///< [joint]
  std::vector<JointFrames> bad_, flips_;  ///< the first ones, at most kMostDefects each
  std::size_t more_bad_ = 0, more_flips_ = 0;
};

/// Returns whether the root's columns look swapped: its rotation is constant to the bit and equals the angles that its
/// offset would give.
bool has_permuted_root(const Motion& motion);

/// Returns a defect if the stature is outside the human range; empty if the rig lacks head or feet.
std::vector<Defect> odd_scale(const Motion& motion, const RigMap& rig);

/// Lists joint names: "LeftHand", "LeftHand and RightHand", "LeftHand, RightHand and 5 more".
std::string names_of(const Skeleton& skeleton, const std::vector<JointIndex>& joints, std::size_t most = 3);

}  // namespace signweave::defect
