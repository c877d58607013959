#pragma once

#include <array>
#include <cstdint>
#include <string_view>
#include <vector>

#include "signweave/features/hand_motion.h"
#include "signweave/motion/motion_source.h"

namespace signweave {

/// The pose of a standing or sitting signer who signs nothing.
struct RestPose {
  Pose pose;
  std::vector<float> tracks;  ///< one value for each track of the motion, in its order; the eyes are open
  std::int64_t frame = 0;     ///< frame of the motion that it was taken from
};

/// Finds the captured frame that is most at rest: the body still, both hands low, the trunk upright, the head in its
/// usual orientation. At most kRestFrames frames are examined, evenly spaced over the motion, including its first and
/// last. All heights below the hips count as equally low. If the hands never rest, it is the lowest slow pose; if the
/// signer's hands or shoulders are unknown, the first frame. The motion must have a frame. Throws what reading it
/// throws.
RestPose rest_pose_of(const MotionSource& motion, const SignerModel& signer);
inline constexpr std::int64_t kRestFrames = 202;

/// The tracks that close the eyes, by ARKit's names.
inline constexpr std::array<std::string_view, 2> kLidTracks = {"eyeBlinkLeft", "eyeBlinkRight"};

}  // namespace signweave
