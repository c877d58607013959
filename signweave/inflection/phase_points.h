#pragma once

#include <Eigen/Geometry>
#include <array>
#include <cstddef>
#include <functional>

#include "signweave/inflection/captured_stroke.h"

namespace signweave {

/// The moments of a stroke at which it is described, evenly spaced from the first to the last frame.
inline constexpr std::size_t kPhasePoints = 12;

/// One hand at one moment of a stroke, in the axes of the stroke's space.
struct PhasePoint {
  Eigen::Vector3f palm = Eigen::Vector3f::Zero();            ///< shoulder widths from between the shoulders
  Eigen::Quaternionf turn = Eigen::Quaternionf::Identity();  ///< the wrist joint's rotation
  /// Of the elbow about the line from shoulder to wrist, from the elbow that hangs down; radians, -π to π.
  float swivel = 0;
};

/// A stroke at kPhasePoints moments.
struct PhasePoints {
  std::array<std::array<PhasePoint, kPhasePoints>, 2> hands;  ///< [Side]
  std::array<bool, 2> used{};                                 ///< [Side] the hand acts in this stroke
};

/// The frame, relative to the first one and usually between two, at a phase point of a stroke of some frames.
double frame_of_point(std::size_t point, std::int64_t frames) noexcept;
/// The elbow's swivel in a pose; 0 if the elbow is on the line from shoulder to wrist.
float swivel_of(const HandInSpace& hand) noexcept;

/// Describes a stroke; between frames, hands are interpolated. Precondition: the changer has an arm. Throws
/// Error{corrupt} as the source.
PhasePoints phase_points(StrokeChanger& changer, const MotionSource& source, const CapturedStroke& stroke);

/// Changes a pose of a stroke at a time of it, from 0 to 1.
using ChangePose = std::function<void(float time, MutablePoseView pose)>;
/// The same of a stroke whose poses are changed first, in the space of the captured one.
PhasePoints phase_points(StrokeChanger& changer, const MotionSource& source, const CapturedStroke& stroke,
                         const ChangePose& change);

}  // namespace signweave
