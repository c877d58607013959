#include "signweave/inflection/phase_points.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "signweave/inflection/slots.h"
#include "signweave/inflection/turns.h"

namespace signweave {
namespace {

using inflection::slot;
using inflection::wrapped;

using Eigen::Vector3f;

/// Straighter arms have no swivel. Metres.
constexpr float kStraight = 1e-4f;

PhasePoint phase_point_of(const HandInSpace& hand, float unit) {
  return {.palm = hand.palm / unit, .turn = hand.turn, .swivel = swivel_of(hand)};
}

PhasePoint point_between(const PhasePoint& a, const PhasePoint& b, float share) {
  const float turn = wrapped(b.swivel - a.swivel);
  return {.palm = a.palm + share * (b.palm - a.palm),
          .turn = a.turn.slerp(share, b.turn),
          .swivel = wrapped(a.swivel + share * turn)};
}

/// Reads poses of a stroke.
class PointReader {
 public:
  PointReader(StrokeChanger& changer, const MotionSource& source, const CapturedStroke& stroke,
              const ChangePose& change)
      : changer_(changer), source_(source), stroke_(stroke), change_(change), pose_(changer.skeleton()) {}

  /// [Side] at a frame counted from the stroke's first.
  std::array<PhasePoint, 2> at(std::int64_t frame) {
    const std::int64_t place = stroke_.core.begin + frame;
    source_.read({place, place + 1}, {pose_.rotations, pose_.translations});
    if (change_) {
      change_(static_cast<float>(frame) / static_cast<float>(std::max<std::int64_t>(stroke_.core.size() - 1, 1)),
              pose_.view());
    }
    std::array<PhasePoint, 2> points;
    for (const Side side : kSides) {
      if (!changer_.has(side)) continue;
      points[slot(side)] = phase_point_of(changer_.look(std::as_const(pose_).view(), stroke_.space, side),
                                          changer_.body().shoulder_width);
    }
    return points;
  }

 private:
  StrokeChanger& changer_;
  const MotionSource& source_;
  const CapturedStroke& stroke_;
  const ChangePose& change_;
  Pose pose_;
};

}  // namespace

double frame_of_point(std::size_t point, std::int64_t frames) noexcept {
  return static_cast<double>(point) * static_cast<double>(frames - 1) / static_cast<double>(kPhasePoints - 1);
}

float swivel_of(const HandInSpace& hand) noexcept {
  const Vector3f line = hand.wrist - hand.shoulder;
  const float length = line.norm();
  if (length < kStraight) return 0;
  const Vector3f axis = line / length;
  const auto across = [&](const Vector3f& v) -> Vector3f { return v - v.dot(axis) * axis; };
  const Vector3f elbow = across(hand.elbow - hand.shoulder);
  const Vector3f down = across(-Vector3f::UnitY());
  if (elbow.norm() < kStraight || down.norm() < kStraight) return 0;
  return std::atan2(axis.dot(down.cross(elbow)), down.dot(elbow));
}

PhasePoints phase_points(StrokeChanger& changer, const MotionSource& source, const CapturedStroke& stroke,
                         const ChangePose& change) {
  PointReader reader(changer, source, stroke, change);
  PhasePoints points;
  for (std::size_t k = 0; k < kPhasePoints; ++k) {
    const double place = frame_of_point(k, stroke.core.size());
    const auto frame = static_cast<std::int64_t>(place);
    const auto share = static_cast<float>(place - static_cast<double>(frame));
    std::array<PhasePoint, 2> hands = reader.at(frame);
    if (share > 0 && frame + 1 < stroke.core.size()) {
      const std::array<PhasePoint, 2> next = reader.at(frame + 1);
      for (std::size_t side = 0; side < 2; ++side) hands[side] = point_between(hands[side], next[side], share);
    }
    for (std::size_t side = 0; side < 2; ++side) points.hands[side][k] = hands[side];
  }
  for (const Side side : kSides) {
    points.used[slot(side)] = changer.has(side) && (side == stroke.dominant || stroke.together());
  }
  return points;
}

PhasePoints phase_points(StrokeChanger& changer, const MotionSource& source, const CapturedStroke& stroke) {
  return phase_points(changer, source, stroke, {});
}

}  // namespace signweave
