#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <span>

#include "signweave/query/movement.h"
#include "signweave/query/movement_term.h"

/// Internal to this module: where a point is, moves and points in signer-centred space.
namespace signweave {

/// A point that moves less than this goes toward nothing, shoulder widths. (ours)
inline constexpr float kLeastMove = 0.1f;
/// From knuckle to tip a stretched finger has at least this part of its length: its joints bend by some 50° in all.
inline constexpr float kStretched = 0.93f;

/// Where a point is at the first and at the last moment; signer-centred, shoulder widths.
struct PointEnds {
  Eigen::Vector3f begin = Eigen::Vector3f::Zero();
  Eigen::Vector3f end = Eigen::Vector3f::Zero();
};

/// The value of a term with `is_of_ends`: degrees, or shoulder widths for a distance. kNotKnown if a position is not,
/// and for a movement that is shorter than kLeastMove or comes no nearer to the locus.
float place_over(const MovementTerm& term, const PointEnds& ends, const Eigen::Vector3f& locus) noexcept;

/// The angle at an index finger's knuckle between its tip and a locus, at the last frame of the spans of a row, in
/// degrees. kNotKnown if there is no span, it lies outside the motion, the rig lacks the finger's knuckle or tip, or
/// the finger is bent. Throws what `movement` throws.
float pointing_over(const Movement& movement, std::uint32_t recording, Side side, std::span<const TimeSpan> spans,
                    const Eigen::Vector3f& locus);

}  // namespace signweave
