#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <vector>

#include "signweave/features/defects.h"
#include "signweave/motion/kinematics.h"

/// The parts of `find_defects`. Each is shown the frames in order, once, and then asked what it found. Internal to
/// `features`.
namespace signweave::defect {

/// What a watch found of one kind: the first ones, and how many there are besides.
struct Found {
  std::vector<Defect> defects;  ///< kMostDefects at most
  std::size_t more = 0;
};

/// Jumps of joints in their parents, of translated joints and of the root in the room. A step from one frame to the
/// next is compared with those beside it: a quick movement speeds up and slows down, a jump does neither. One frame
/// that is out of place makes two steps, there and back, which are judged as one.
/// More than fifteen members: what has been seen so far of joints, of the root and of the frame at hand.
class JumpWatch {
 public:
  /// True for what is no defect: a jump that begins in a frame, of a joint (kNoJoint: the whole body).
  using Excuse = std::function<bool(std::int64_t frame, JointIndex joint)>;
  explicit JumpWatch(const Motion& motion, Excuse excuse = {});
  /// Every frame must be shown. One that is not `whole` holds numbers that are none: steps to and from it tell nothing.
  void see(std::int64_t frame, bool whole = true);
  Found found();

 private:
  static constexpr std::int64_t kRing = 5;
  /// Of one joint in one frame or in several that lie near together, or of many joints in one frame.
  struct Jump {
    std::int64_t first = -1;  ///< frame, the first in the new place; -1: none
    std::int64_t last = -1;   ///< frame
    JointIndex joint = kNoJoint;
    bool turns = true;      ///< else it shifts
    float step = 0;         ///< radians or metres, the largest
    float around = 0;       ///< of the frames beside that one, the larger
    std::size_t count = 1;  ///< joints; where it is more than one, `joint` is the fastest
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
  void gather(std::int64_t frame);
  static bool comes_before(const Jump& a, const Jump& b) noexcept;
  void keep(const Jump& jump);
  Defect told(const Jump& jump) const;
  bool reaches_beyond(std::int64_t frame, JointIndex joint, double lever);

  const Motion& motion_;
  Excuse excuse_;
  double hertz_;
  std::size_t many_;  ///< joints that jump at once make the whole body
  std::array<Steps, kRing> ring_;
  std::vector<float> reach_;  ///< [joint] metres to the farthest point that it carries, at most
  std::vector<std::vector<JointIndex>> carried_;
  std::vector<std::vector<Tip>> tips_;  ///< [joint]
  ModelPose model_;
  std::int64_t model_of_ = -1;
  std::size_t looked_at_ = 0;     ///< points, for the levers of that frame
  std::vector<JointIndex> open_;  ///< scratch of reaches_beyond
  std::int64_t seen_ = 0;
  bool last_whole_ = false;
  std::vector<Jump> now_;                  ///< of the frame that is judged
  std::array<std::vector<Jump>, 2> near_;  ///< [turns][joint] its latest, to which the next may belong
  std::vector<Jump> kept_;                 ///< the earliest, fewer than twice kMostDefects
  std::size_t jumps_ = 0;                  ///< all that were kept once
};

/// Joints whose numbers keep to the bit: for a long stretch while the body moves, or throughout. Frames that it is not
/// shown are as if they were not there.
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
    std::int64_t since = 0;        ///< index of shown_: the first of the present run
    std::int64_t changes = 0;      ///< steps in which it moved
    std::int64_t short_still = 0;  ///< steps in which it did not, outside long runs
  };
  struct Together {
    FrameRange frames;
    std::vector<JointIndex> joints;  ///< ascending
  };
  std::int64_t count() const noexcept { return static_cast<std::int64_t>(shown_.size()); }
  const Eigen::Quaternionf& rotation(std::int64_t index, JointIndex joint) const;
  void end_run(JointIndex joint, std::int64_t end);
  std::vector<Run> frozen_runs() const;
  /// Leaves out the runs, of one joint, whose value the joint has outside them too.
  void erase_those_that_come_back(std::vector<Run>& runs) const;
  std::vector<Together> lost_together(std::vector<Run> frozen) const;
  /// Of the parts that sign: neck, head, arms, hands and fingers. Helper joints and feet may rest for ever.
  std::vector<JointIndex> signing_joints_that_never_move() const;

  const Motion& motion_;
  const RigMap& rig_;
  std::int64_t shortest_;  ///< frames of a long stretch
  std::vector<Joint> joints_;
  std::vector<std::int64_t> shown_;    ///< frames
  std::vector<std::uint16_t> moving_;  ///< [index of shown_] joints that changed in the step into it
  std::vector<Run> runs_;              ///< the long ones
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
  void end_stretch(bool at_end);

  const Motion& motion_;
  const RigMap& rig_;
  bool can_tell_ = true;
  std::int64_t first_ = -1;  ///< frame that was shown
  std::int64_t since_ = -1;
  std::int64_t until_ = -1;  ///< after the last frame of the stretch
  double way_ = 0;           ///< metres that the wrists travelled within the stretch
  std::array<Eigen::Vector3f, 2> wrists_;
  std::vector<Defect> found_;
};

/// Quaternions that leave the hemisphere of the frame before, and numbers that are none.
class NumberWatch {
 public:
  explicit NumberWatch(const Motion& motion);
  /// False where the frame holds numbers that are none, which nobody else should be shown.
  bool see(std::int64_t frame);
  Found flips() const;
  Found not_finite() const;

 private:
  struct Place {
    JointIndex joint;
    FrameRange frames;
  };
  /// The latest stretch of a joint's numbers that are none.
  struct Latest {
    std::int64_t end = -1;    ///< frame after it
    std::size_t kept_at = 0;  ///< in bad_; beyond its end where it was only counted
  };
  void flag(JointIndex joint, std::int64_t frame);

  const Motion& motion_;
  std::vector<Latest> latest_;      ///< [joint]
  std::vector<Place> bad_, flips_;  ///< the first ones, kMostDefects at most
  std::size_t more_bad_ = 0, more_flips_ = 0;
};

/// The root's columns look exchanged: its rotation keeps to the bit and is what its offset makes as an angle.
bool has_permuted_root(const Motion& motion);

/// Stature beyond that of people; nothing where the rig lacks head or feet.
std::vector<Defect> odd_scale(const Motion& motion, const RigMap& rig);

/// "LeftHand", "LeftHand and RightHand", "LeftHand, RightHand and 5 more".
std::string names_of(const Skeleton& skeleton, const std::vector<JointIndex>& joints, std::size_t most = 3);

}  // namespace signweave::defect
