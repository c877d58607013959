#pragma once

#include <array>
#include <cstdint>
#include <string_view>
#include <vector>

#include "signweave/features/hand_motion.h"
#include "signweave/motion/motion_source.h"

namespace signweave {

/// How a signer stands (or sits) where nothing is signed.
struct RestPose {
  Pose pose;
  std::vector<float> tracks;  ///< one value for each track of the motion, in its order; the eyes are open
  std::int64_t frame = 0;     ///< of the motion that it was taken from
};

/// The captured frame that is most at rest, of at most kRestFrames that lie evenly over the motion, its first and last
/// among them: the body still, both hands low, the trunk upright, the head as it is mostly held. Hands below the hips
/// are as low as any. Where they never rest it is the lowest slow pose; where the signer's hands or shoulders are not
/// known, the first frame. The motion must have a frame. Throws what reading it throws.
RestPose rest_pose_of(const MotionSource& motion, const SignerModel& signer);
inline constexpr std::int64_t kRestFrames = 202;

/// The tracks that shut the eyes, by ARKit's names.
inline constexpr std::array<std::string_view, 2> kLidTracks = {"eyeBlinkLeft", "eyeBlinkRight"};

}  // namespace signweave
