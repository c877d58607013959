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

/// Where the eyes look, as the head sees it: straight ahead of the face is 0. The mean of both eyes, or the one that is
/// known.
struct Gaze {
  float yaw = 0;    ///< degrees to the signer's left
  float pitch = 0;  ///< degrees up
  friend bool operator==(const Gaze&, const Gaze&) = default;
};

/// What gaze is told from, the best first.
enum class GazeFrom : std::uint8_t {
  eye_tracks,    ///< leftEyeYaw, leftEyePitch, rightEyeYaw, rightEyePitch of a face capture
  look_weights,  ///< eyeLookInLeft, eyeLookOutLeft, eyeLookUpLeft, eyeLookDownLeft and those of the right eye
  eye_joints,    ///< the eyes of the skeleton, as they turn against the head
};

/// How far an eye has turned where its weight is 1, degrees: in captures of Live Link Face, which have both, a weight
/// of 0.1 goes with 0.061 radians of the eye across and down, and with 0.044 up. (ours)
inline constexpr float kLookAcross = 35;
inline constexpr float kLookDown = 35;
inline constexpr float kLookUp = 25;

/// Where the gaze of one motion comes from.
struct GazeSource {
  /// What a scalar track adds to the gaze.
  struct Share {
    std::size_t track = 0;  ///< its number among the tracks
    float yaw = 0;          ///< degrees where its value is 1
    float pitch = 0;
  };
  GazeFrom from = GazeFrom::eye_tracks;
  std::vector<Share> shares;                           ///< of tracks and weights
  JointIndex head = kNoJoint;                          ///< of joints
  std::vector<JointIndex> eyes;                        ///< one or two
  Eigen::Vector3f left = Eigen::Vector3f::UnitX();     ///< to the signer's left, in the rest pose's model space
  Eigen::Vector3f forward = Eigen::Vector3f::UnitZ();  ///< straight ahead; up is y
};

/// From scalar tracks of these names; none where there is no eye among them. Rotations are those of Live Link Face:
/// radians, yaw to the signer's right, pitch down. An eye of which no track is there was not captured, for a track that
/// is 0 throughout is not stored.
std::optional<GazeSource> gaze_source(std::span<const std::string> tracks);

/// From the tracks of a motion of at least one frame, else from its eyes' joints: as they turn from the rest pose
/// against the head. None from joints where the rig lacks the head or both eyes, where the rest pose does not stand
/// upright (then nothing tells what is straight ahead), where it has the eyes look more than 45 degrees from what they
/// do mostly, and where they never turn (such joints were not captured). Reads a few frames only.
std::optional<GazeSource> gaze_source(const MotionSource& source, const RigMap& rig, const Pause& pause = {});

/// The gaze of one pose, from joints. The head and the eyes of `pose` are looked at.
Gaze gaze_at(const GazeSource& from, const ModelPose& pose) noexcept;

/// The gaze at some frames, which must lie within the motion: one for each. A value that is no number gives a gaze that
/// is none.
std::vector<Gaze> gaze_over(const MotionSource& source, const GazeSource& from, FrameRange frames,
                            const Pause& pause = {});

}  // namespace signweave
