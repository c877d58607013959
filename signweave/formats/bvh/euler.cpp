#include "signweave/formats/bvh/euler.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace signweave::bvh {
namespace {

constexpr double kTurn = 2.0 * std::numbers::pi;
/// Below this amplitude the free angle is only rounding noise of a float quaternion. Choosing it arbitrarily changes
/// the rotation by at most 2√2 times as much: 5e-5 degrees.
constexpr double kLocked = 3e-7;

/// Rounds to the nearest whole number, halves away from 0, as std::round does; inline, and for magnitudes below 2^51.
double rounded(double value) noexcept {
  const double nearest = (value + 0x1.8p52) - 0x1.8p52;  // halves to even
  const double rest = value - nearest;
  return std::abs(rest) == 0.5 && (rest > 0) == (value > 0) ? nearest + 2 * rest : nearest;
}

double nearest_to(double target, double angle, double period) noexcept {
  return angle + period * rounded((target - angle) / period);
}

/// atan(x)/x for |x| ≤ tan(π/8) as a polynomial in x², found with Remez' algorithm; the largest error is 4e-17 before
/// rounding.
constexpr double kArc[] = {1.0,
                           -0.33333333333328712408,
                           0.19999999998907539796,
                           -0.14285714184872211932,
                           0.11111106327510640028,
                           -0.090907762640195258103,
                           0.076899956119065511162,
                           -0.066405782075719984999,
                           0.05690050180209784712,
                           -0.043527054560358846979,
                           0.021189480326038705031};

/// Computes std::atan2(rises, runs) within 4e-16 for finite numbers. It has no branches, so that the compiler
/// vectorizes it and none is mispredicted: most of the time of writing a file was spent here.
void directions(std::span<const double> rises, std::span<const double> runs, std::span<double> angles) noexcept {
  constexpr double kEighth = 0.41421356237309503;  // tan(π/8)
  constexpr double kHalf = std::numbers::pi / 2;
  const double* const rise_of = rises.data();
  const double* const run_of = runs.data();
  double* const out = angles.data();
  const std::size_t count = angles.size();
  for (std::size_t i = 0; i < count; ++i) {
    const double rise = std::abs(rise_of[i]);
    const double run = std::abs(run_of[i]);
    const double least = std::min(rise, run);
    const double most = std::max(rise, run) + 1e-290;  // 0/0 is 0 here, without denormal numbers, which are slow
    // Either near 0, or near π/4, where atan((a − b)/(a + b)) remains: `oblique` is 0 or 1.
    const double oblique = 0.5 + std::copysign(0.5, least - kEighth * most);
    const double t = (least - oblique * most) / (most + oblique * least);
    const double u = t * t;
    const double arc =
        t *
        (kArc[0] +
         u * (kArc[1] +
              u * (kArc[2] +
                   u * (kArc[3] +
                        u * (kArc[4] +
                             u * (kArc[5] +
                                  u * (kArc[6] + u * (kArc[7] + u * (kArc[8] + u * (kArc[9] + u * kArc[10]))))))))));
    double angle = oblique * (kHalf / 2) + arc;
    // Measured from the other axis if the direction is steep; mirrored if the run is negative, including −0.
    const double axis = std::copysign(kHalf / 2, run - rise);
    angle = (kHalf / 2 - axis) + std::copysign(1.0, axis) * angle;
    const double side = std::copysign(kHalf, run_of[i]);
    angle = (kHalf - side) + std::copysign(1.0, side) * angle;
    out[i] = std::copysign(angle, rise_of[i]);
  }
}

double length(double x, double y) noexcept {
  return std::sqrt(x * x + y * y);
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

/// +1 if the second axis follows the first in x → y → z → x, else −1.
double handedness(int first, int second) noexcept {
  return second == (first + 1) % 3 ? 1.0 : -1.0;
}

/// A joint's rotation as three directions, from which its angles are computed.
struct Directions {
  std::array<double, 3> rises{};
  std::array<double, 3> runs{1, 1, 1};
};

Directions one_axis(const Eigen::Quaterniond& q, int axis) noexcept {
  return {.rises = {q.vec()[axis]}, .runs = {q.w(), 1, 1}};
}

// The two half angles p, r of the product that comes nearest to q maximise (cos p, sin p) M (cos r, sin r)ᵀ, where M
// holds q's components; written in p − r and p + r the two terms reach their maxima independently.
Directions two_axes(const Eigen::Quaterniond& q, int first, int second) noexcept {
  const double third = handedness(first, second) * q.vec()[3 - first - second];
  const double a = q.vec()[first];
  const double b = q.vec()[second];
  return {.rises = {a + b, a - b}, .runs = {q.w() - third, q.w() + third, 1}};
}

// With half angles A, B, C and s the handedness of the axes, a product of three rotations has the components
//   w + b  = (cos B + sin B) cos(A + sC)      a + sc = (cos B + sin B) sin(A + sC)
//   w − b  = (cos B − sin B) cos(A − sC)      a − sc = (cos B − sin B) sin(A − sC)
// so sum, difference and B follow without subtracting nearly equal numbers, even at gimbal lock.
Directions three_axes(const Eigen::Quaterniond& q, const RotationOrder& order) noexcept {
  const double a = q.vec()[order.axes[0]];
  const double b = q.vec()[order.axes[1]];
  const double c = handedness(order.axes[0], order.axes[1]) * q.vec()[order.axes[2]];
  const double plus = length(q.w() + b, a + c);
  const double minus = length(q.w() - b, a - c);
  return {.rises = {a + c, a - c, minus}, .runs = {q.w() + b, q.w() - b, plus}};
}

Directions directions_of(const Eigen::Quaterniond& rotation, const RotationOrder& order) noexcept {
  if (order.count == 3) return three_axes(rotation, order);
  if (order.count == 2) return two_axes(rotation, order.axes[0], order.axes[1]);
  if (order.count == 1) return one_axis(rotation, order.axes[0]);
  return {};
}

/// The angles from the three directions; `minus` and `plus` are the third's rise and run.
Angles of_three_axes(const double* found, double minus, double plus, double s, const Angles* before) noexcept {
  double sum = found[0];
  double difference = found[1];
  const double middle = std::numbers::pi / 2 - 2.0 * found[2];
  if (minus < kLocked || plus < kLocked) {
    if (before != nullptr) {
      const double sum_before = ((*before)[0] + s * (*before)[2]) / 2;
      const double difference_before = ((*before)[0] - s * (*before)[2]) / 2;
      // q and −q are the same rotation, so the rest is known up to half a turn.
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

/// The angles from `found`, the angles of the three directions with the given rises and runs.
Angles settled(const double* found, const double* rises, const double* runs, const RotationOrder& order,
               const Angles* before) noexcept {
  if (order.count == 0) return {};
  Angles angles{2.0 * found[0], 0, 0};
  if (order.count == 2) angles = {found[0] + found[1], found[0] - found[1], 0};
  if (order.count == 3) {
    angles = of_three_axes(found, rises[2], runs[2], handedness(order.axes[0], order.axes[1]), before);
  }
  if (before == nullptr) return unwrapped(angles, {});
  const Angles direct = unwrapped(angles, *before);
  if (order.count < 3) return direct;
  // The first and last angle turned by half a turn and the middle one mirrored give the same rotation.
  const Angles other = unwrapped({angles[0] + kTurn / 2, std::numbers::pi - angles[1], angles[2] + kTurn / 2}, *before);
  return distance(other, *before) < distance(direct, *before) ? other : direct;
}

}  // namespace

RotationOrder rotation_order(std::span<const Channel> channels) noexcept {
  RotationOrder order;
  for (const Channel channel : channels) {
    if (is_rotation(channel) && order.count < 3) order.axes[static_cast<std::size_t>(order.count++)] = axis_of(channel);
  }
  return order;
}

Angles angles_of(const Eigen::Quaterniond& rotation, const RotationOrder& order, const Angles* before) noexcept {
  const Directions where = directions_of(rotation, order);
  std::array<double, 3> found{};
  directions(where.rises, where.runs, found);
  return settled(found.data(), where.rises.data(), where.runs.data(), order, before);
}

AngleFinder::AngleFinder(std::vector<RotationOrder> orders)
    : orders_(std::move(orders)),
      angles_(orders_.size()),
      rises_(3 * orders_.size()),
      runs_(3 * orders_.size()),
      found_(3 * orders_.size()) {}

std::span<const Angles> AngleFinder::next(std::span<const Eigen::Quaterniond> rotations) noexcept {
  for (std::size_t joint = 0; joint < orders_.size(); ++joint) {
    const Directions where = directions_of(rotations[joint], orders_[joint]);
    std::copy(where.rises.begin(), where.rises.end(), &rises_[3 * joint]);
    std::copy(where.runs.begin(), where.runs.end(), &runs_[3 * joint]);
  }
  directions(rises_, runs_, found_);
  for (std::size_t joint = 0; joint < orders_.size(); ++joint) {
    const std::size_t at = 3 * joint;
    angles_[joint] =
        settled(&found_[at], &rises_[at], &runs_[at], orders_[joint], is_first_ ? nullptr : &angles_[joint]);
  }
  is_first_ = false;
  return angles_;
}

}  // namespace signweave::bvh
