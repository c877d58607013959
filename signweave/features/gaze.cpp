#include "signweave/features/gaze.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace signweave {
namespace {

using Eigen::Vector3f;

constexpr float kDegrees = 180 / std::numbers::pi_v<float>;

/// The contribution of one track to the gaze of its eye, degrees at value 1.
struct EyeTrack {
  std::string_view name;  ///< "@" is replaced by the side
  float yaw[2];           ///< [Side]
  float pitch;
};
// Yaw and pitch of Live Link Face are positive to the right and down. "In" is towards the nose.
constexpr std::array kRotations = {EyeTrack{"@EyeYaw", {-kDegrees, -kDegrees}, 0},
                                   EyeTrack{"@EyePitch", {0, 0}, -kDegrees}};
constexpr std::array kWeights = {EyeTrack{"eyeLookIn@", {-kLookAcross, kLookAcross}, 0},
                                 EyeTrack{"eyeLookOut@", {kLookAcross, -kLookAcross}, 0},
                                 EyeTrack{"eyeLookUp@", {0, 0}, kLookUp}, EyeTrack{"eyeLookDown@", {0, 0}, -kLookDown}};

std::string sided(std::string_view name, Side side) {
  const std::size_t at = name.find('@');
  const bool first = at == 0;
  const char* const word = side == Side::left ? (first ? "left" : "Left") : (first ? "right" : "Right");
  return std::string(name.substr(0, at)).append(word).append(name.substr(at + 1));
}

template <typename EyeTracks>
std::vector<GazeSource::Share> shares_of(const EyeTracks& kinds, std::span<const std::string> tracks) {
  std::vector<GazeSource::Share> all;
  int eyes = 0;
  for (const Side side : kSides) {
    const std::size_t before = all.size();
    for (const EyeTrack& kind : kinds) {
      const auto at = std::ranges::find(tracks, sided(kind.name, side));
      if (at == tracks.end()) continue;
      all.push_back(
          {static_cast<std::size_t>(at - tracks.begin()), kind.yaw[static_cast<std::size_t>(side)], kind.pitch});
    }
    if (all.size() > before) ++eyes;
  }
  for (GazeSource::Share& share : all) {
    share.yaw /= static_cast<float>(eyes);
    share.pitch /= static_cast<float>(eyes);
  }
  return all;
}

/// Returns the direction of an eye in the axes of the rest pose, relative to the head.
Vector3f look(const GazeSource& from, JointIndex eye, const ModelPose& pose) {
  const Eigen::Quaternionf& head = pose.rotations[static_cast<std::size_t>(from.head)];
  return head.conjugate() * (pose.rotations[static_cast<std::size_t>(eye)] * from.forward);
}

/// Determines left and straight ahead from head and eyes in the rest pose; returns false if the rest pose is not
/// upright.
bool find_axes(const Skeleton& skeleton, const RigMap& rig, GazeSource& source) {
  constexpr float kUpright = 0.5f;  // component of a unit vector: within 60 degrees
  const ModelPose rest = to_model_space(skeleton, Pose(skeleton).view());
  const auto place = [&](Part part) { return position_of(rig[part], rest); };
  std::optional<Vector3f> left;
  for (const Part pair : {Part::left_eye, Part::left_upper_arm, Part::left_thigh}) {
    const Part other = of(Side::right, pair);
    if (left || !rig.has(pair) || !rig.has(other)) continue;
    const Vector3f across = (place(pair) - place(other)).normalized();
    if (std::hypot(across.x(), across.z()) > kUpright) left = Vector3f(across.x(), 0, across.z()).normalized();
  }
  if (!left) return false;
  for (const Part below : {Part::neck, Part::chest, Part::spine, Part::pelvis}) {
    if (!rig.has(below) || rig[below].joint == source.head) continue;
    if (!((place(Part::head) - place(below)).normalized().y() > kUpright)) return false;
    source.left = *left;
    source.forward = left->cross(Vector3f::UnitY());
    return true;
  }
  return false;
}

/// Keeps the eyes that rotate in any of a few frames and whose mean direction is plausible as a gaze.
void keep_captured(const MotionSource& source, GazeSource& from, const Pause& pause) {
  constexpr std::int64_t kFrames = 240;
  constexpr float kTurned = 0.5f / kDegrees;
  constexpr float kFarthest = 45 / kDegrees;
  std::vector<JointIndex> joints = from.eyes;
  joints.push_back(from.head);
  const JointChains chains(*source.skeleton(), joints);
  Motion motion;
  motion.reset(source.skeleton(), source.rate(), 1);
  ModelPose pose;
  const std::int64_t count = std::min(source.frame_count(), kFrames);
  std::vector<Vector3f> first(from.eyes.size());
  std::vector<Vector3f> sum(from.eyes.size(), Vector3f::Zero());
  std::vector<bool> turns(from.eyes.size(), false);
  for (std::int64_t i = 0; i < count; ++i) {
    if (pause && i % 16 == 0) pause();
    const std::int64_t frame = count == 1 ? 0 : i * (source.frame_count() - 1) / (count - 1);
    source.read({frame, frame + 1}, motion.poses({0, 1}));
    chains.to_model_space(motion.pose(0), pose);
    for (std::size_t eye = 0; eye < from.eyes.size(); ++eye) {
      const Vector3f now = look(from, from.eyes[eye], pose);
      if (i == 0) first[eye] = now;
      if ((now - first[eye]).norm() > kTurned) turns[eye] = true;
      sum[eye] += now;
    }
  }
  std::vector<JointIndex> kept;
  for (std::size_t eye = 0; eye < from.eyes.size(); ++eye) {
    if (turns[eye] && sum[eye].normalized().dot(from.forward) > std::cos(kFarthest)) kept.push_back(from.eyes[eye]);
  }
  from.eyes = std::move(kept);
}

std::optional<GazeSource> from_joints(const MotionSource& source, const RigMap& rig, const Pause& pause) {
  GazeSource result;
  result.from = GazeFrom::eye_joints;
  result.head = rig[Part::head].joint;
  for (const Part eye : {Part::left_eye, Part::right_eye}) {
    if (rig.has(eye) && rig[eye].joint != result.head) result.eyes.push_back(rig[eye].joint);
  }
  if (result.head == kNoJoint || result.eyes.empty() || source.frame_count() == 0) return std::nullopt;
  if (!find_axes(*source.skeleton(), rig, result)) return std::nullopt;
  keep_captured(source, result, pause);
  return result.eyes.empty() ? std::nullopt : std::optional(std::move(result));
}

}  // namespace

std::optional<GazeSource> gaze_source(std::span<const std::string> tracks) {
  GazeSource result;
  result.shares = shares_of(kRotations, tracks);
  if (!result.shares.empty()) return result;
  result.from = GazeFrom::look_weights;
  result.shares = shares_of(kWeights, tracks);
  return result.shares.empty() ? std::nullopt : std::optional(std::move(result));
}

std::optional<GazeSource> gaze_source(const MotionSource& source, const RigMap& rig, const Pause& pause) {
  std::optional<GazeSource> result = gaze_source(source.tracks());
  return result ? result : from_joints(source, rig, pause);
}

Gaze gaze_at(const GazeSource& from, const ModelPose& pose) noexcept {
  Gaze gaze;
  for (const JointIndex eye : from.eyes) {
    const Vector3f direction = look(from, eye, pose);
    const float ahead = direction.dot(from.forward);
    const float across = direction.dot(from.left);
    gaze.yaw += std::atan2(across, ahead) * kDegrees / static_cast<float>(from.eyes.size());
    gaze.pitch +=
        std::atan2(direction.y(), std::hypot(across, ahead)) * kDegrees / static_cast<float>(from.eyes.size());
  }
  return gaze;
}

std::vector<Gaze> gaze_over(const MotionSource& source, const GazeSource& from, FrameRange frames, const Pause& pause) {
  std::vector<Gaze> result;
  result.reserve(static_cast<std::size_t>(std::max<std::int64_t>(frames.size(), 0)));
  if (from.from == GazeFrom::eye_joints) {
    std::vector<JointIndex> joints = from.eyes;
    joints.push_back(from.head);
    const JointChains chains(*source.skeleton(), joints);
    Motion motion;
    ModelPose pose;
    for_pieces(frames, pause, [&](FrameRange piece) {
      motion.reset(source.skeleton(), source.rate(), piece.size());
      source.read(piece, motion.poses({0, piece.size()}));
      for (std::int64_t frame = 0; frame < piece.size(); ++frame) {
        chains.to_model_space(motion.pose(frame), pose);
        result.push_back(gaze_at(from, pose));
      }
    });
    return result;
  }
  std::vector<std::vector<float>> values(from.shares.size());
  std::vector<std::span<float>> wanted(source.tracks().size());
  for_pieces(frames, pause, [&](FrameRange piece) {
    for (std::size_t i = 0; i < values.size(); ++i) {
      values[i].resize(static_cast<std::size_t>(piece.size()));
      wanted[from.shares[i].track] = values[i];
    }
    source.read_tracks(piece, wanted);
    for (std::size_t frame = 0; frame < static_cast<std::size_t>(piece.size()); ++frame) {
      Gaze gaze;
      for (std::size_t i = 0; i < values.size(); ++i) {
        gaze.yaw += from.shares[i].yaw * values[i][frame];
        gaze.pitch += from.shares[i].pitch * values[i][frame];
      }
      result.push_back(gaze);
    }
  });
  return result;
}

}  // namespace signweave
