#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "signweave/inflection/stroke_changer.h"
#include "signweave/motion/motion_source.h"

namespace signweave {

/// A captured stroke at some of its frames, evenly spaced, with the first and the last one.
struct CapturedStroke {
  struct Sample {
    Pose pose;
    float time = 0;                    ///< in the stroke, from 0 to 1
    std::array<HandInSpace, 2> hands;  ///< [Side]; of arms that are unknown: not set
    std::array<Contact, 2> touched{};  ///< [Side]
    std::array<WristBend, 2> bend{};   ///< [Side]
  };
  FrameRange core;
  StrokeSpace space;
  std::vector<Sample> samples;        ///< not empty
  std::array<HandDepths, 2> depth{};  ///< [Side] in trunk and head, at the deepest sample
  HandsMeeting meeting;
  std::array<float, 2> path_length{};  ///< [Side] of the palm, metres
  bool touch = false;                  ///< the hands touch each other in some sample
  bool both_move = false;              ///< neither hand rests, and none moves much less than the other
  Side dominant = Side::right;         ///< the hand with the longer path

  const HandInSpace& first(Side side) const noexcept { return samples.front().hands[static_cast<std::size_t>(side)]; }
  const HandInSpace& last(Side side) const noexcept { return samples.back().hands[static_cast<std::size_t>(side)]; }
  /// The hands are changed together.
  bool together() const noexcept { return touch || both_move; }
  /// The palm of a hand, or the middle between both that are changed together.
  Eigen::Vector3f palm(const Sample& sample, Side side) const noexcept;
};

/// Reads a stroke, `core`, at kStrokeSamples frames at most. Precondition: the changer has an arm. Throws
/// Error{corrupt} as the source.
CapturedStroke captured_stroke(StrokeChanger& changer, const MotionSource& source, FrameRange core);
inline constexpr std::int64_t kStrokeSamples = 17;

/// A hand that moves less than this share of the other's path is not changed with it, unless they touch. (ours)
inline constexpr float kMovesToo = 0.4f;

}  // namespace signweave
