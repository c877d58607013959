#include "signweave/transition/duration.h"

#include <cmath>

#include "signweave/features/hand_points.h"
#include "signweave/motion/kinematics.h"
#include "signweave/rig/signer_space.h"

namespace signweave {
namespace {

/// Measures hands in single poses.
class HandReader {
 public:
  HandReader(const Gap& gap, const SignerModel& signer)
      : signer_(signer), hands_{HandPlaces(signer.rig, Side::left), HandPlaces(signer.rig, Side::right)} {
    std::vector<JointIndex> joints = {signer.body->trunk, signer.rig[Part::left_upper_arm].joint,
                                      signer.rig[Part::right_upper_arm].joint};
    for (const HandPlaces& hand : hands_) hand.add_joints(joints);
    std::erase(joints, kNoJoint);
    chains_ = JointChains(*gap.skeleton, joints);
  }
  bool has(std::size_t side) const noexcept { return hands_[side].has_wrist(); }

  std::array<HandThere, 2> at(PoseView pose, PoseView other, Seconds apart) {
    std::array<HandThere, 2> result = places(pose);
    if (apart == Seconds(0)) return result;
    const std::array<HandThere, 2> away = places(other);
    for (std::size_t side = 0; side < 2; ++side) {
      result[side].velocity = (result[side].place - away[side].place) / static_cast<float>(apart.count());
    }
    return result;
  }

 private:
  std::array<HandThere, 2> places(PoseView pose) {
    chains_.to_model_space(pose, pose_);
    const SignerSpace space = signer_space(*signer_.body, signer_.rig, pose_);
    std::array<HandThere, 2> result;
    for (const Side side : kSides) {
      const auto at = static_cast<std::size_t>(side);
      if (!has(at)) continue;
      hands_[at].read(pose_, points_);
      result[at].place = space.unit * space.to_signer(palm_of(points_));
      if (hands_[at].why_no_fingers().empty()) result[at].shape = handshape_of(points_, axes_of(points_, side));
    }
    return result;
  }

  const SignerModel& signer_;
  std::array<HandPlaces, 2> hands_;
  JointChains chains_;
  ModelPose pose_;
  HandPoints points_;
};

}  // namespace

TransitionTask task_of(const Gap& gap, const SignerModel& signer) {
  TransitionTask task;
  if (!signer.body || !why_no_signer_space(signer.rig).empty()) return task;
  task.shoulder_width = signer.body->shoulder_width;
  HandReader reader(gap, signer);
  const std::int64_t context = std::max<std::int64_t>(1, std::llround(kTaskContext.count() * gap.rate.hertz()));
  const std::int64_t before = std::min(context, gap.before.frames - 1);
  const std::int64_t after = std::min(context, gap.after.frames - 1);
  const Seconds frame = gap.rate.frame_time();
  const auto from =
      reader.at(gap.left(), gap.before.pose(gap.before.frames - 1 - before), static_cast<double>(before) * frame);
  const auto to = reader.at(gap.right(), gap.after.pose(after), -static_cast<double>(after) * frame);
  for (std::size_t side = 0; side < 2; ++side) {
    if (reader.has(side)) task.hands[side] = task_from(from[side], to[side]);
  }
  return task;
}

}  // namespace signweave
