#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "signweave/core/text.h"
#include "signweave/features/defect_watch.h"

namespace signweave::defect {
namespace {

using Eigen::Vector3f;

// All values are ours.
constexpr float kLevel = 0.30f;     // sine of 17.5°: maximum elevation of an arm, up or down
constexpr float kSideways = 0.94f;  // cosine of 20°: maximum angle to the shoulder line
constexpr float kStraight = 0.94f;  // cosine of 20°: maximum bend of the elbow
constexpr double kHeld = 0.5;       // minimum duration of a T-pose in the middle of a recording, seconds
constexpr double kStill = 0.15;     // maximum wrist speed meanwhile, m/s: arms also move through the pose
// Adults: nearly all are well within 1.2 m and 2.3 m.
constexpr double kShortest = 1.2;
constexpr double kTallest = 2.3;
// Distance from the head's joint to the crown, as a fraction of the bones below: the default, and the maximum. An eye
// or a camera may be attached far from the head.
constexpr double kCrown = 0.10;
constexpr double kMostCrown = 0.25;
constexpr std::int64_t kFramesMeasured = 50;

Part of_side(int side, Part left) {
  return of(side == 0 ? Side::left : Side::right, left);
}

bool in_t_pose(const RigMap& rig, const ModelPose& model) {
  std::array<Vector3f, 2> shoulders;
  for (int side = 0; side < 2; ++side) {
    shoulders[static_cast<std::size_t>(side)] = position_of(rig[of_side(side, Part::left_upper_arm)], model);
  }
  Vector3f across = shoulders[0] - shoulders[1];  // points to the left
  across.y() = 0;
  if (!(across.norm() >= 1e-4f)) return false;  // written so that NaN, from very large values, is not a pose
  across.normalize();
  for (int side = 0; side < 2; ++side) {
    const Vector3f shoulder = shoulders[static_cast<std::size_t>(side)];
    const Vector3f wrist = position_of(rig[of_side(side, Part::left_hand)], model);
    const Vector3f arm = (wrist - shoulder).normalized();
    if (!(std::abs(arm.y()) <= kLevel && arm.dot(side == 0 ? across : -across) >= kSideways)) return false;
    const PartPlace& elbow = rig[of_side(side, Part::left_forearm)];
    if (!elbow.known()) continue;
    const Vector3f at = position_of(elbow, model);
    if (!((at - shoulder).normalized().dot((wrist - at).normalized()) >= kStraight)) return false;
  }
  return true;
}

}  // namespace

TPoseWatch::TPoseWatch(const Motion& motion, const RigMap& rig) : motion_(motion), rig_(rig) {
  for (int side = 0; side < 2; ++side) {
    can_tell_ = can_tell_ && rig.has(of_side(side, Part::left_upper_arm)) && rig.has(of_side(side, Part::left_hand));
  }
}

void TPoseWatch::see(std::int64_t frame, const ModelPose& model) {
  if (first_ < 0) first_ = frame;
  if (!in_t_pose(rig_, model)) {
    end_pose(false);
    return;
  }
  const std::array<Vector3f, 2> wrists = {position_of(rig_[Part::left_hand], model),
                                          position_of(rig_[Part::right_hand], model)};
  if (since_ < 0) {
    since_ = frame;
    travel_ = 0;
  } else {
    for (std::size_t side = 0; side < 2; ++side) travel_ += static_cast<double>((wrists[side] - wrists_[side]).norm());
  }
  until_ = frame + 1;
  wrists_ = wrists;
}

void TPoseWatch::end_pose(bool at_end) {
  if (since_ < 0) return;
  const FrameRange frames{since_, until_};
  since_ = -1;
  const double seconds = static_cast<double>(frames.size()) / motion_.rate().hertz();
  const bool at_start = frames.begin == first_;
  if (!at_start && !at_end && (seconds < kHeld || travel_ / 2 / seconds > kStill)) return;
  found_.push_back(
      {.kind = DefectKind::t_pose,
       .frames = frames,
       .value = static_cast<float>(seconds),
       .text = at_start && at_end
                   ? "every frame is a T-pose: the motion contains no signing"
                   : fmt::format("both arms stretched out sideways{}: calibration, not signing; leave these "
                                 "frames out",
                                 at_start ? " at the start"
                                 : at_end ? " at the end"
                                          : "")});
}

std::vector<Defect> TPoseWatch::found() {
  end_pose(true);
  return found_;
}

bool has_permuted_root(const Motion& motion) {
  const Skeleton& skeleton = motion.skeleton();
  if (motion.frame_count() < 2 || !skeleton.joint(0).translated) return false;
  const Eigen::Quaternionf first = motion.pose(0).rotations[0];
  const Vector3f offset = skeleton.joint(0).offset;
  const Eigen::AngleAxisf turn(first);
  const double degrees = static_cast<double>(turn.angle()) * 180 / std::numbers::pi;
  if (degrees < 0.01 || offset.norm() < 1e-6f) return false;
  if (std::abs(turn.axis().dot(offset.normalized())) < 0.999f) return false;
  const double per_metre = degrees / static_cast<double>(offset.norm());
  if (per_metre < 0.9 || per_metre > 1100) return false;   // file units per metre, from m to mm
  bool shifts = motion.pose(0).translations[0] != offset;  // the translation column does not hold a position
  for (std::int64_t frame = 1; frame < motion.frame_count(); ++frame) {
    if (motion.pose(frame).rotations[0].coeffs() != first.coeffs()) return false;
    shifts = shifts || motion.pose(frame).translations[0] != motion.pose(0).translations[0];
  }
  return shifts;
}

namespace {

/// Returns the length of the bones from a foot to the head, metres, averaged over some frames.
double bones_between(const Motion& motion, JointIndex foot, JointIndex head) {
  const Skeleton& skeleton = motion.skeleton();
  const std::int64_t step = std::max<std::int64_t>(1, motion.frame_count() / kFramesMeasured);
  const auto bone = [&](JointIndex joint) {
    const std::optional<std::size_t> translation = skeleton.translation_of(joint);
    if (!translation) return static_cast<double>(skeleton.joint(joint).offset.norm());
    double sum = 0;
    int seen = 0;
    for (std::int64_t frame = 0; frame < motion.frame_count(); frame += step, ++seen) {
      sum += static_cast<double>(motion.pose(frame).translations[*translation].norm());
    }
    return sum / seen;
  };
  double length = 0;
  for (JointIndex a = foot, b = head; a != b;) {
    JointIndex& later = a > b ? a : b;
    length += bone(later);
    later = skeleton.joint(later).parent;
  }
  return length;
}

/// Returns the distance from the head's joint to the top of the head, metres; nullopt if the rig does not define it.
std::optional<double> crown_of(const Motion& motion, const RigMap& rig) {
  const JointIndex head = rig[Part::head].joint;
  if (rig.has(Part::head_top)) {
    const PartPlace& top = rig[Part::head_top];
    return bones_between(motion, top.joint, head) + static_cast<double>(top.offset.norm());
  }
  std::optional<double> crown;
  for (const Tip& tip : motion.skeleton().tips()) {
    if (tip.joint == head) crown = std::max(crown.value_or(0), static_cast<double>(tip.offset.norm()));
  }
  return crown;
}

}  // namespace

std::vector<Defect> odd_scale(const Motion& motion, const RigMap& rig) {
  const PartPlace& head = rig[Part::head];
  double legs = 0;
  int count = 0;
  for (const Part foot : {Part::left_foot, Part::right_foot}) {
    if (!head.known() || !rig.has(foot)) continue;
    legs += bones_between(motion, rig[foot].joint, head.joint);
    ++count;
  }
  if (count == 0) return {};
  const double bones = legs / count;
  const double stature = bones + std::min(crown_of(motion, rig).value_or(kCrown * bones), kMostCrown * bones);
  if (!std::isfinite(stature) || (stature >= kShortest && stature <= kTallest)) return {};
  Defect defect{.kind = DefectKind::scale, .value = static_cast<float>(stature)};
  defect.text = fmt::format(
      "the body is {:.3g} m tall, measured along the bones from foot to head: read the file with another "
      "unit",
      stature);
  return {defect};
}

}  // namespace signweave::defect
