#include "signweave/query/place_over.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>

#include "signweave/space/locus.h"

namespace signweave {
namespace {

using Eigen::Vector3f;

/// Degrees; kNotKnown if one of them is zero or not finite.
float angle_between(const Vector3f& a, const Vector3f& b) noexcept {
  const float cross = a.cross(b).norm();
  const float dot = a.dot(b);
  if (!(a.squaredNorm() > 0 && b.squaredNorm() > 0 && std::isfinite(cross) && std::isfinite(dot))) return kNotKnown;
  return std::atan2(cross, dot) * 180 / std::numbers::pi_v<float>;
}

float component_of(const Vector3f& at, Component component) noexcept {
  if (!at.allFinite()) return kNotKnown;
  const SpaceAngles angles = angles_of(at);
  if (component == Component::azimuth) return angles.azimuth;
  return component == Component::elevation ? angles.elevation : angles.distance;
}

}  // namespace

float place_over(const MovementTerm& term, const PointEnds& ends, const Vector3f& locus) noexcept {
  if (term.quantity == Quantity::from) return component_of(ends.begin, term.component);
  if (term.quantity == Quantity::to) return component_of(ends.end, term.component);
  const Vector3f moved = ends.end - ends.begin;
  const Vector3f ahead = locus - ends.begin;
  const bool nearer = (locus - ends.end).squaredNorm() < ahead.squaredNorm();
  return nearer && moved.norm() >= kLeastMove ? angle_between(moved, ahead) : kNotKnown;
}

float pointing_over(const Movement& movement, std::uint32_t recording, Side side, std::span<const TimeSpan> spans,
                    const Vector3f& locus) {
  if (spans.empty()) return kNotKnown;
  const FrameRange frames = measured_frames(spans.back(), movement.clock(recording), movement.frame_count(recording));
  if (frames.empty()) return kNotKnown;
  constexpr std::array kPoints = {FingerPoint::proximal, FingerPoint::intermediate, FingerPoint::distal,
                                  FingerPoint::tip};
  std::array<Part, kPoints.size()> parts{};
  for (std::size_t i = 0; i < parts.size(); ++i) parts[i] = finger_part(side, Finger::index, kPoints[i]);
  const std::vector<PointTrack> tracks = movement.points(recording, parts, {frames.end - 1, frames.end});
  if (tracks.size() != parts.size() || tracks.front().empty() || tracks.back().empty()) return kNotKnown;
  const Vector3f knuckle = tracks.front().front().position;
  const Vector3f tip = tracks.back().front().position;
  Vector3f last = knuckle;
  float length = 0;
  for (const PointTrack& track : tracks) {  // a joint that the rig lacks is left out
    if (track.empty()) continue;
    length += (track.front().position - last).norm();
    last = track.front().position;
  }
  if (!((tip - knuckle).norm() >= kStretched * length)) return kNotKnown;
  return angle_between(tip - knuckle, locus - knuckle);
}

}  // namespace signweave
