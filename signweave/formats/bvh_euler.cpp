#include "signweave/formats/bvh_euler.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace signweave::bvh {
namespace {

constexpr double kTurn = 2.0 * std::numbers::pi;
/// Below this amplitude the free angle is only rounding noise of a float quaternion. Choosing it moves the rotation by
/// at most 2√2 times as much: 5e-5 degrees.
constexpr double kLocked = 3e-7;

double nearest_to(double target, double angle, double period) noexcept {
  return angle + period * std::round((target - angle) / period);
}

double distance(const Angles& a, const Angles& b) noexcept {
  double sum = 0;
  for (std::size_t i = 0; i < 3; ++i) sum += (a[i] - b[i]) * (a[i] - b[i]);
  return sum;
}

Angles unwrapped(Angles angles, const Angles& before) noexcept {
  for (std::size_t i = 0; i < 3; ++i) angles[i] = nearest_to(before[i], angles[i], kTurn);
  return angles;
}

/// +1 where the second axis follows the first in x → y → z → x, else −1.
double handedness(int first, int second) noexcept {
  return second == (first + 1) % 3 ? 1.0 : -1.0;
}

Angles one_axis(const Eigen::Quaterniond& q, int axis) noexcept {
  return {2.0 * std::atan2(q.vec()[axis], q.w()), 0, 0};
}

// The two half angles p, r of the product that comes nearest to q maximise (cos p, sin p) M (cos r, sin r)ᵀ, where M
// holds q's components; written in p − r and p + r the two terms reach their maxima independently.
Angles two_axes(const Eigen::Quaterniond& q, int first, int second) noexcept {
  const double third = handedness(first, second) * q.vec()[3 - first - second];
  const double a = q.vec()[first];
  const double b = q.vec()[second];
  const double difference = std::atan2(a - b, q.w() + third);
  const double sum = std::atan2(a + b, q.w() - third);
  return {sum + difference, sum - difference, 0};
}

// With half angles A, B, C and s the handedness of the axes, a product of three turns has the components
//   w + b  = (cos B + sin B) cos(A + sC)      a + sc = (cos B + sin B) sin(A + sC)
//   w − b  = (cos B − sin B) cos(A − sC)      a − sc = (cos B − sin B) sin(A − sC)
// so that sum, difference and B fall out without a subtraction of near numbers, at gimbal lock too.
Angles three_axes(const Eigen::Quaterniond& q, const RotationOrder& order, const Angles* before) noexcept {
  const double s = handedness(order.axes[0], order.axes[1]);
  const double a = q.vec()[order.axes[0]];
  const double b = q.vec()[order.axes[1]];
  const double c = s * q.vec()[order.axes[2]];
  const double plus = std::hypot(q.w() + b, a + c);
  const double minus = std::hypot(q.w() - b, a - c);
  double sum = std::atan2(a + c, q.w() + b);
  double difference = std::atan2(a - c, q.w() - b);
  const double middle = std::numbers::pi / 2 - 2.0 * std::atan2(minus, plus);

  if (minus < kLocked || plus < kLocked) {
    if (before != nullptr) {
      const double sum_before = ((*before)[0] + s * (*before)[2]) / 2;
      const double difference_before = ((*before)[0] - s * (*before)[2]) / 2;
      // q and −q are one rotation, so what is left is known up to half a turn.
      sum = plus < kLocked ? sum_before : nearest_to(sum_before, sum, kTurn / 2);
      difference = minus < kLocked ? difference_before : nearest_to(difference_before, difference, kTurn / 2);
      const double direct = nearest_to((*before)[1], middle, kTurn);
      const double mirrored = nearest_to((*before)[1], std::numbers::pi - middle, kTurn);
      const bool direct_is_nearer = std::abs(direct - (*before)[1]) <= std::abs(mirrored - (*before)[1]);
      return {sum + difference, direct_is_nearer ? direct : mirrored, s * (sum - difference)};
    }
    (plus < kLocked ? sum : difference) = plus < kLocked ? difference : sum;
  }
  return {sum + difference, middle, s * (sum - difference)};
}

}  // namespace

void turn(Eigen::Quaterniond& rotation, int axis, double radians) noexcept {
  const double c = std::cos(radians / 2);
  const double s = std::sin(radians / 2);
  const int next = (axis + 1) % 3;
  const int last = (axis + 2) % 3;
  const double w = rotation.w();
  const Eigen::Vector3d v = rotation.vec();
  rotation.w() = c * w - s * v[axis];
  rotation.vec()[axis] = c * v[axis] + s * w;
  rotation.vec()[next] = c * v[next] + s * v[last];
  rotation.vec()[last] = c * v[last] - s * v[next];
}

RotationOrder rotation_order(std::span<const Channel> channels) noexcept {
  RotationOrder order;
  for (const Channel channel : channels) {
    if (is_rotation(channel) && order.count < 3) order.axes[static_cast<std::size_t>(order.count++)] = axis_of(channel);
  }
  return order;
}

Angles angles_of(const Eigen::Quaterniond& rotation, const RotationOrder& order, const Angles* before) noexcept {
  if (order.count == 0) return {};
  Angles angles{};
  if (order.count == 1) angles = one_axis(rotation, order.axes[0]);
  if (order.count == 2) angles = two_axes(rotation, order.axes[0], order.axes[1]);
  if (order.count == 3) angles = three_axes(rotation, order, before);
  if (before == nullptr) return unwrapped(angles, {});
  const Angles direct = unwrapped(angles, *before);
  if (order.count < 3) return direct;
  // Half a turn of the first and the last with the middle one mirrored is the same rotation.
  const Angles other = unwrapped({angles[0] + kTurn / 2, std::numbers::pi - angles[1], angles[2] + kTurn / 2}, *before);
  return distance(other, *before) < distance(direct, *before) ? other : direct;
}

}  // namespace signweave::bvh
