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

/// Flexion and spread of the fingers: a description of the handshape that is independent of hand size and rig.
struct Handshape {
  static constexpr std::size_t kSize = 15;
  /// Thumb to little finger, three values each: flexion at the knuckle, flexion beyond it (mean of the joints), both
  /// from 0 (straight) to 1 (fully bent, 90°), and spread from the next finger towards the thumb, from 0 (together) to
  /// 1 (45°; index from thumb 90°). The thumb's knuckle is the joint near the wrist; its flexion is how far its first
  /// bone points out of the palm. The thumb's third value is the position of its tip across the palm, from 0 (next to
  /// the index) to 1 (at the little finger).
  std::array<float, kSize> values{};
};
/// Root mean square difference, in [0, 1].
float distance(const Handshape& a, const Handshape& b) noexcept;

/// Parts that a hand can touch, as capsules and spheres of the body. Bits of a set.
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
  Eigen::Vector3f position = Eigen::Vector3f::Zero();      ///< centre of the palm; signer-centred, shoulder widths
  Eigen::Vector3f velocity = Eigen::Vector3f::Zero();      ///< metres a second, signer's axes, smoothed
  Eigen::Vector3f acceleration = Eigen::Vector3f::Zero();  ///< metres a second squared, signer's axes, smoothed
  float curvature = 0;                                     ///< of the path, 1/metre; 0 below kLeastSpeed
  Eigen::Vector3f palm = Eigen::Vector3f::Zero();          ///< unit, out of the palm, signer's axes; zero: no fingers
  Eigen::Vector3f fingers =
      Eigen::Vector3f::Zero();                      ///< unit, wrist to middle knuckle, signer's axes; zero: no fingers
  Eigen::Vector3f elbow = Eigen::Vector3f::Zero();  ///< signer-centred, shoulder widths; zero: no elbow
  float openness = 0;                               ///< 0 a fist to 1 a flat hand; 0 without fingers
  Handshape handshape;                              ///< zero without fingers
  Contact contact = Contact::none;
};

/// The posture of the trunk at one frame.
struct TrunkFrame {
  /// From the pelvis to the midpoint of the shoulders, unit, signer's axes: (0, 1, 0) upright; zero: no pelvis.
  Eigen::Vector3f lean = Eigen::Vector3f::Zero();
  /// Sine of the rotation of the hips relative to the shoulders about the vertical; 0: no hips.
  float twist = 0;
};

/// Both hands of a signer over some frames.
struct HandMotion {
  struct OneHand {
    std::string why_not;            ///< empty, or the reason why this hand is not measured ("no left wrist")
    std::string why_no_fingers;     ///< empty, or the reason why palm, openness and handshape are missing
    std::vector<HandFrame> frames;  ///< [frame - range.begin]; empty if why_not is set
  };
  FrameRange range;
  std::array<OneHand, 2> hands;       ///< [Side]
  std::vector<float> hands_distance;  ///< [frame] metres between the palms; empty unless both hands are measured
  std::vector<TrunkFrame> trunk;      ///< [frame - range.begin]; empty if no hand is measured
};

/// Data computed once per motion, needed to measure any part of it.
struct SignerModel {
  RigMap rig;
  std::optional<SignerBody> body;  ///< nullopt: nothing can be measured
};

/// Measures some frames of a motion (clamped to it). Frames around the range are read for smoothing if the motion has
/// them, so that a part gives bit-identical results to the whole. Velocity and acceleration are those of a quadratic
/// fitted over a window of kSmoothing around the frame (Savitzky and Golay 1964), at least three frames wide.
HandMotion measure_hands(const Motion& motion, const SignerModel& model, FrameRange range);

inline constexpr Seconds kSmoothing{0.1};
/// Below this speed, a hand's path is given no curvature. Metres a second. (ours)
inline constexpr float kLeastSpeed = 0.1f;

}  // namespace signweave
