#include "signweave/evaluation/aim_errors.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace signweave {
namespace {

using Eigen::Vector3d;
using Eigen::Vector3f;

using HandPath = std::array<PhasePoint, kPhasePoints>;
using PalmPath = Eigen::Matrix<double, 3, static_cast<int>(kPhasePoints)>;

double degrees(double radians) {
  return radians * 180 / std::numbers::pi;
}
double angle_between(const Vector3f& a, const Vector3f& b) {
  return degrees(std::atan2(static_cast<double>(a.cross(b).norm()), static_cast<double>(a.dot(b))));
}
double angle_of(const Eigen::Quaternionf& turn) {
  return degrees(2 * std::atan2(static_cast<double>(turn.vec().norm()), std::abs(static_cast<double>(turn.w()))));
}

PalmPath palm_path_of(const HandPath& hand) {
  PalmPath path;
  for (std::size_t k = 0; k < kPhasePoints; ++k) path.col(static_cast<Eigen::Index>(k)) = hand[k].palm.cast<double>();
  return path;
}

/// Shoulder widths.
double shape_distance(const PalmPath& made, const PalmPath& captured) {
  const Vector3d middle = made.rowwise().mean();
  const Vector3d goal = captured.rowwise().mean();
  const PalmPath a = made.colwise() - middle;
  const PalmPath b = captured.colwise() - goal;
  // A hand that keeps its place has no shape to turn or scale.
  if (a.norm() < 1e-6) return b.norm() / std::sqrt(static_cast<double>(kPhasePoints));
  const Eigen::Matrix4d map = Eigen::umeyama(made, captured, true);
  const PalmPath mapped = (map.topLeftCorner<3, 3>() * made).colwise() + Vector3d(map.topRightCorner<3, 1>());
  return (mapped - captured).norm() / std::sqrt(static_cast<double>(kPhasePoints));
}

}  // namespace

AimErrors aim_errors(const ComparedStroke& made, const ComparedStroke& captured, Side side,
                     const std::optional<Locus>& pointed_at, float unit) {
  const HandPath& a = made.points.hands[static_cast<std::size_t>(side)];
  const HandPath& b = captured.points.hands[static_cast<std::size_t>(side)];
  const double millimetres = 1000 * static_cast<double>(unit);
  AimErrors errors;
  errors.end_mm = millimetres * static_cast<double>((a.back().palm - b.back().palm).norm());
  double squares = 0;
  for (std::size_t k = 0; k < kPhasePoints; ++k) {
    squares += static_cast<double>((a[k].palm - b[k].palm).squaredNorm()) / kPhasePoints;
    errors.turn_degrees += angle_of(a[k].turn * b[k].turn.conjugate()) / kPhasePoints;
  }
  errors.path_mm = millimetres * std::sqrt(squares);
  errors.shape_mm = millimetres * shape_distance(palm_path_of(a), palm_path_of(b));
  const Vector3f moved = b.back().palm - b.front().palm;
  if (pointed_at) {
    const float away = std::max(kNearestPointedAt / std::max(pointed_at->at.norm(), 1e-3f), 1.0f);
    const Vector3f goal = unit * (pointed_at->self ? 1.0f : away) * pointed_at->at;
    errors.aim_degrees = angle_between(made.last.index_tip - made.last.index_base, goal - made.last.index_base);
  } else if (unit * moved.norm() < kNoMovementOfAim) {
    errors.aim_degrees = angle_between(a.back().palm, b.back().palm);
  } else {
    errors.aim_degrees = angle_between(a.back().palm - a.front().palm, moved);
  }
  return errors;
}

}  // namespace signweave
