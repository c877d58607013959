#include "signweave/live/rest_pose.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <span>
#include <string_view>

#include "signweave/features/hand_points.h"
#include "signweave/motion/degree.h"
#include "signweave/motion/kinematics.h"
#include "signweave/rig/signer_space.h"

namespace signweave {
namespace {

using Eigen::Quaternionf;
using Eigen::Vector3f;

// Penalties of a frame. Each hand at shoulder height costs kHigh; the following amounts cost 1. (ours)
constexpr float kHigh = 3;
constexpr float kSpeed = 0.5f;         // metres a second, of the fastest of hands, head and feet
constexpr float kTilt = 20 * kDegree;  // of the trunk, and of the head from its usual orientation
constexpr float kStep = 0.15f;         // metres by which one foot is higher than the other
// Amounts that cost nothing.
constexpr float kStill = 0.02f;
constexpr float kUpright = 6 * kDegree;
constexpr float kLevel = 0.03f;
constexpr Seconds kLook{0.05};          // on each side of a frame, for its speed
constexpr std::int64_t kMostLook = 20;  // frames

/// The penalty of a value, at most kMost: raised hands are worse than any speed.
float beyond(float value, float free, float unit) {
  constexpr float kMost = 1.5f;
  return std::clamp((value - free) / unit, 0.0f, kMost);
}

/// The features of one frame that determine how much it is at rest.
struct Seen {
  std::int64_t frame = 0;
  float height = 0;  ///< sum over the hands: each 0 at the hips and below, kHigh at the shoulders
  float speed = 0;
  float tilt = 0;
  float step = 0;
  Quaternionf signer_from_head = Quaternionf::Identity();
};

/// Examines single frames of a motion.
class RestLook {
 public:
  RestLook(const MotionSource& motion, const SignerModel& signer)
      : motion_(motion),
        signer_(signer),
        hands_{HandPlaces(signer.rig, Side::left), HandPlaces(signer.rig, Side::right)} {
    std::vector<JointIndex> joints = {signer.body->trunk};
    for (const Part part :
         {Part::pelvis, Part::head, Part::left_foot, Part::right_foot, Part::left_upper_arm, Part::right_upper_arm}) {
      if (signer.rig.has(part)) joints.push_back(signer.rig[part].joint);
    }
    for (const HandPlaces& hand : hands_) {
      if (hand.has_wrist()) hand.add_joints(joints);
    }
    chains_ = JointChains(*motion.skeleton(), joints);
    look_ = std::clamp<std::int64_t>(std::llround(kLook.count() * motion.rate().hertz()), 1, kMostLook);
  }

  Seen at(std::int64_t frame) {
    const Skeleton& skeleton = *motion_.skeleton();
    const FrameRange range = clamp({frame - look_, frame + look_ + 1}, motion_.frame_count());
    const auto count = static_cast<std::size_t>(range.size());
    rotations_.resize(count * skeleton.joint_count());
    translations_.resize(count * skeleton.translation_count());
    motion_.read(range, {rotations_, translations_});

    Seen seen{.frame = frame};
    place(range.begin, range);
    const std::vector<Vector3f> before = points();
    place(range.end - 1, range);
    const std::vector<Vector3f> after = points();
    const auto seconds = static_cast<float>(static_cast<double>(count - 1) / motion_.rate().hertz());
    for (std::size_t i = 0; i < before.size() && count > 1; ++i) {
      seen.speed = std::max(seen.speed, (after[i] - before[i]).norm() / seconds);
    }
    place(frame, range);
    measure(seen);
    return seen;
  }

 private:
  void place(std::int64_t frame, FrameRange range) {
    const auto at = static_cast<std::size_t>(frame - range.begin);
    const std::size_t joints = motion_.skeleton()->joint_count();
    const std::size_t moved = motion_.skeleton()->translation_count();
    chains_.to_model_space(
        {std::span(rotations_).subspan(at * joints, joints), std::span(translations_).subspan(at * moved, moved)},
        pose_);
  }

  /// Hands, head and feet.
  std::vector<Vector3f> points() {
    std::vector<Vector3f> points;
    for (const HandPlaces& hand : hands_) {
      if (hand.has_wrist()) points.push_back(palm(hand));
    }
    for (const Part part : {Part::head, Part::left_foot, Part::right_foot}) {
      if (signer_.rig.has(part)) points.push_back(position_of(signer_.rig[part], pose_));
    }
    return points;
  }

  Vector3f palm(const HandPlaces& hand) {
    hand.read(pose_, points_);
    return palm_of(points_);
  }

  void measure(Seen& seen) {
    const RigMap& rig = signer_.rig;
    const SignerSpace space = signer_space(*signer_.body, rig, pose_);
    const float hips = std::min(-0.1f, signer_.body->heights[static_cast<std::size_t>(Height::waist)]);
    for (const HandPlaces& hand : hands_) {
      if (hand.has_wrist()) seen.height += kHigh * std::max(0.0f, 1 - space.to_signer(palm(hand)).y() / hips);
    }
    if (rig.has(Part::pelvis)) {
      const Vector3f trunk = space.origin - position_of(rig[Part::pelvis], pose_);
      seen.tilt = std::atan2(Vector3f(trunk.x(), 0, trunk.z()).norm(), trunk.y());
    }
    if (rig.has(Part::left_foot) && rig.has(Part::right_foot)) {
      seen.step =
          std::abs(position_of(rig[Part::left_foot], pose_).y() - position_of(rig[Part::right_foot], pose_).y());
    }
    if (rig.has(Part::head)) {
      seen.signer_from_head =
          space.model_from_signer.conjugate() * pose_.rotations[static_cast<std::size_t>(rig[Part::head].joint)];
    }
  }

  const MotionSource& motion_;
  const SignerModel& signer_;
  std::array<HandPlaces, 2> hands_;
  JointChains chains_;
  std::int64_t look_ = 1;
  std::vector<Quaternionf> rotations_;
  std::vector<Vector3f> translations_;
  ModelPose pose_;
  HandPoints points_;
};

/// At most kRestFrames, evenly spaced, including the first and the last.
std::vector<std::int64_t> rest_frames(std::int64_t frames) {
  const std::int64_t count = std::min(frames, kRestFrames);
  std::vector<std::int64_t> chosen;
  for (std::int64_t i = 0; i < count; ++i) chosen.push_back(count == 1 ? 0 : i * (frames - 1) / (count - 1));
  return chosen;
}

/// The usual orientation of the head: that of the frame with the least rotation to the others, weighted by how upright
/// the trunk is. A mean would lie between two gaze directions.
Quaternionf usual_head(std::span<const Seen> frames) {
  std::vector<float> weights;
  for (const Seen& seen : frames) {
    weights.push_back(1 / (0.2f + beyond(seen.tilt, kUpright, kTilt)));
  }
  Quaternionf usual = Quaternionf::Identity();
  float least = std::numeric_limits<float>::infinity();
  for (const Seen& candidate : frames) {
    float sum = 0;
    for (std::size_t i = 0; i < frames.size(); ++i) {
      sum += weights[i] * candidate.signer_from_head.angularDistance(frames[i].signer_from_head);
    }
    if (!(sum < least)) continue;
    least = sum;
    usual = candidate.signer_from_head;
  }
  return usual;
}

std::int64_t rest_frame_of(const MotionSource& motion, const SignerModel& signer) {
  const bool known = signer.body && (signer.rig.has(Part::left_hand) || signer.rig.has(Part::right_hand));
  if (!known) return 0;
  RestLook look(motion, signer);
  std::vector<Seen> frames;
  for (const std::int64_t frame : rest_frames(motion.frame_count())) frames.push_back(look.at(frame));
  const Quaternionf head = usual_head(frames);
  const auto cost = [&](const Seen& seen) {
    return seen.height + beyond(seen.speed, kStill, kSpeed) + beyond(seen.tilt, kUpright, kTilt) +
           beyond(seen.step, kLevel, kStep) + beyond(head.angularDistance(seen.signer_from_head), kUpright, kTilt);
  };
  std::int64_t best = 0;
  float least = std::numeric_limits<float>::infinity();
  for (const Seen& seen : frames) {
    const float value = cost(seen);
    if (!(value < least)) continue;
    least = value;
    best = seen.frame;
  }
  return best;
}

/// The values of the tracks at a frame.
std::vector<float> tracks_at(const MotionSource& motion, std::int64_t frame) {
  std::vector<float> values(motion.tracks().size());
  std::vector<std::span<float>> out;
  for (float& value : values) out.emplace_back(&value, 1);
  motion.read_tracks({frame, frame + 1}, out);
  return values;
}

/// Opens eyelids that are closed in the frame: limits their tracks to the value that a quarter of the frames stay
/// below.
void open_eyes(const MotionSource& motion, std::vector<float>& values) {
  for (std::size_t track = 0; track < values.size(); ++track) {
    if (std::ranges::find(kLidTracks, motion.tracks()[track]) == kLidTracks.end()) continue;
    std::vector<float> seen;
    std::vector<std::span<float>> out(values.size());
    for (const std::int64_t frame : rest_frames(motion.frame_count())) {
      out[track] = std::span(&seen.emplace_back(), 1);
      motion.read_tracks({frame, frame + 1}, out);
    }
    const auto quarter = seen.begin() + static_cast<std::ptrdiff_t>(seen.size() / 4);
    std::nth_element(seen.begin(), quarter, seen.end());
    values[track] = std::min(values[track], *quarter);
  }
}

}  // namespace

RestPose rest_pose_of(const MotionSource& motion, const SignerModel& signer) {
  RestPose rest{.pose = Pose(*motion.skeleton()), .tracks = {}, .frame = rest_frame_of(motion, signer)};
  motion.read({rest.frame, rest.frame + 1}, {rest.pose.rotations, rest.pose.translations});
  rest.tracks = tracks_at(motion, rest.frame);
  open_eyes(motion, rest.tracks);
  return rest;
}

}  // namespace signweave
