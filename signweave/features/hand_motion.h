#pragma once

#include <Eigen/Core>
#include <array>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "signweave/motion/motion.h"
#include "signweave/rig/rig_map.h"
#include "signweave/rig/signer_space.h"

namespace signweave {

/// How bent and spread the fingers are: what stays of a handshape when hand size and rig do not matter.
struct Handshape {
  static constexpr std::size_t kSize = 15;
  /// Thumb to little finger, three each: flexion at the knuckle, flexion beyond it (mean of the joints), both 0
  /// straight to 1 fully bent (90°), and spread from the next finger towards the thumb, 0 together to 1 (45°; index
  /// from thumb 90°). The thumb's knuckle is that near the wrist, its flexion how far its first bone stands out of the
  /// palm; its third number tells how far its end lies across the palm, 0 beside the index to 1 at the little finger.
  std::array<float, kSize> values{};
};
/// Root mean square difference, in [0, 1].
float distance(const Handshape& a, const Handshape& b) noexcept;

/// What the hands can touch, as capsules and spheres of the body. Bits of a set.
enum class Contact : std::uint8_t {
  none = 0,
  hands = 1,  ///< the other hand
  head = 2,
  torso = 4,
};
constexpr Contact operator|(Contact a, Contact b) noexcept {
  return static_cast<Contact>(static_cast<unsigned>(a) | static_cast<unsigned>(b));
}
constexpr bool has(Contact set, Contact one) noexcept {
  return (static_cast<unsigned>(set) & static_cast<unsigned>(one)) != 0;
}

/// One hand at one frame.
struct HandFrame {
  Eigen::Vector3f position = Eigen::Vector3f::Zero();      ///< middle of the palm; signer-centred, shoulder widths
  Eigen::Vector3f velocity = Eigen::Vector3f::Zero();      ///< metres a second, signer's axes, smoothed
  Eigen::Vector3f acceleration = Eigen::Vector3f::Zero();  ///< metres a second squared, signer's axes, smoothed
  float curvature = 0;                                     ///< of the path, 1/metre; 0 below kLeastSpeed
  Eigen::Vector3f palm = Eigen::Vector3f::Zero();          ///< unit, out of the palm, signer's axes; zero: no fingers
  Eigen::Vector3f fingers = Eigen::Vector3f::Zero();  ///< unit, wrist to middle knuckle, signer's axes; zero likewise
  Eigen::Vector3f elbow = Eigen::Vector3f::Zero();    ///< signer-centred, shoulder widths; zero: no elbow
  float openness = 0;                                 ///< 0 a fist to 1 a flat hand; 0 without fingers
  Handshape handshape;                                ///< zero without fingers
  Contact contact = Contact::none;
};

/// How the trunk stands at one frame.
struct TrunkFrame {
  /// From the pelvis to between the shoulders, unit, signer's axes: (0, 1, 0) upright; zero: no pelvis.
  Eigen::Vector3f lean = Eigen::Vector3f::Zero();
  /// Sine of the angle about the vertical by which the hips turn against the shoulders; 0: no hips.
  float twist = 0;
};

/// Both hands of a signer over some frames.
struct HandMotion {
  struct OneHand {
    std::string why_not;            ///< empty, or why there is nothing of this hand ("no left wrist")
    std::string why_no_fingers;     ///< empty, or why palm, openness and handshape are absent
    std::vector<HandFrame> frames;  ///< [frame - range.begin]; empty where why_not is not
  };
  FrameRange range;
  std::array<OneHand, 2> hands;       ///< [Side]
  std::vector<float> hands_distance;  ///< [frame] metres between the palms; empty without both hands
  std::vector<TrunkFrame> trunk;      ///< [frame - range.begin]; empty where no hand is measured
};

/// What is needed once per motion to measure any part of it.
struct SignerModel {
  RigMap rig;
  std::optional<SignerBody> body;  ///< none: nothing below can be measured
};

/// Measures some frames of a motion (clamped to it). Frames beside the range are read for smoothing where the motion
/// has them, so that a part gives the same numbers as the whole, to the bit. Velocity and acceleration are those of a
/// quadratic fitted over a window of kSmoothing around the frame (Savitzky and Golay 1964), at least three frames wide.
HandMotion measure_hands(const Motion& motion, const SignerModel& model, FrameRange range);

inline constexpr Seconds kSmoothing{0.1};
/// Where a hand is slower its path has no curvature. Metres a second. (ours)
inline constexpr float kLeastSpeed = 0.1f;

}  // namespace signweave
