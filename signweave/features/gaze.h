#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "signweave/core/time.h"
#include "signweave/features/from_source.h"
#include "signweave/motion/kinematics.h"
#include "signweave/motion/motion_source.h"
#include "signweave/rig/rig_map.h"

namespace signweave {

/// The direction of gaze relative to the head: straight ahead of the face is 0. The mean of both eyes, or the one that
/// is known.
struct Gaze {
  float yaw = 0;    ///< degrees to the signer's left
  float pitch = 0;  ///< degrees up
  friend bool operator==(const Gaze&, const Gaze&) = default;
};

/// The sources of gaze, in order of preference.
enum class GazeFrom : std::uint8_t {
  eye_tracks,    ///< leftEyeYaw, leftEyePitch, rightEyeYaw, rightEyePitch of a face capture
  look_weights,  ///< eyeLookInLeft, eyeLookOutLeft, eyeLookUpLeft, eyeLookDownLeft and those of the right eye
  eye_joints,    ///< the skeleton's eye joints, relative to the head
};

/// The rotation of an eye at weight 1, degrees. In captures of Live Link Face, which have both, a weight of 0.1
/// corresponds to 0.061 radians horizontally and down, and to 0.044 up. (ours)
inline constexpr float kLookAcross = 35;
inline constexpr float kLookDown = 35;
inline constexpr float kLookUp = 25;

/// The source of the gaze of one motion.
struct GazeSource {
  /// The contribution of one scalar track to the gaze.
  struct Share {
    std::size_t track = 0;  ///< index of the track
    float yaw = 0;          ///< degrees at value 1
    float pitch = 0;
  };
  GazeFrom from = GazeFrom::eye_tracks;
  std::vector<Share> shares;                           ///< for tracks and weights
  JointIndex head = kNoJoint;                          ///< for joints
  std::vector<JointIndex> eyes;                        ///< one or two
  Eigen::Vector3f left = Eigen::Vector3f::UnitX();     ///< to the signer's left, in the rest pose's model space
  Eigen::Vector3f forward = Eigen::Vector3f::UnitZ();  ///< straight ahead; up is y
};

/// Returns the gaze source for scalar tracks with these names; nullopt if there is no eye among them. Rotations follow
/// Live Link Face: radians, yaw to the signer's right, pitch down. An eye without any track counts as not captured,
/// because tracks that are 0 throughout are not stored.
std::optional<GazeSource> gaze_source(std::span<const std::string> tracks);

/// Returns the gaze source of a motion of at least one frame: its tracks, else its eye joints, as rotated from the rest
/// pose relative to the head. Joints are not used if the rig lacks the head or both eyes, if the rest pose is not
/// upright (straight ahead is undefined then), if it makes the eyes look more than 45 degrees away from their mean
/// direction, or if they never rotate (such joints were not captured). Reads only a few frames.
std::optional<GazeSource> gaze_source(const MotionSource& source, const RigMap& rig, const Pause& pause = {});

/// Returns the gaze of one pose, from joints. Only the head and the eyes of `pose` are used.
Gaze gaze_at(const GazeSource& from, const ModelPose& pose) noexcept;

/// Returns the gaze at each of `frames`, which must lie within the motion. Non-finite input values give non-finite
/// gaze.
std::vector<Gaze> gaze_over(const MotionSource& source, const GazeSource& from, FrameRange frames,
                            const Pause& pause = {});

}  // namespace signweave
