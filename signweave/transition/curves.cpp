#include "signweave/transition/curves.h"

#include <algorithm>
#include <cmath>

#include "signweave/motion/blend.h"

namespace signweave {
namespace {

/// The least squares quadratic through [0, most] of a path whose samples lie `step` seconds apart, looked at in [0].
/// Sums of powers stand in closed form, so that nothing is solved but a 3 × 3 system.
BorderMotion quadratic(std::span<const Eigen::Vector3f> path, double step) noexcept {
  BorderMotion motion;
  const auto wanted = static_cast<std::size_t>(std::llround(kVelocityWindow / std::abs(step)));
  const std::size_t last = std::min(path.size() - 1, std::max<std::size_t>(2, wanted));
  if (last == 0) return motion;
  if (last == 1) {
    motion.velocity = (path[1] - path[0]) / static_cast<float>(step);
    return motion;
  }
  double powers[5] = {};
  Eigen::Vector3d moments[3] = {Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero()};
  for (std::size_t i = 0; i <= last; ++i) {
    const auto t = static_cast<double>(i);
    double power = 1;
    for (int k = 0; k < 5; ++k) {
      powers[k] += power;
      if (k < 3) moments[k] += power * (path[i] - path[0]).cast<double>();
      power *= t;
    }
  }
  Eigen::Matrix3d normal;
  for (int r = 0; r < 3; ++r) {
    for (int c = 0; c < 3; ++c) normal(r, c) = powers[r + c];
  }
  Eigen::Matrix3d right;
  for (int r = 0; r < 3; ++r) right.row(r) = moments[r].transpose();
  const Eigen::Matrix3d fit = normal.inverse() * right;
  motion.velocity = (fit.row(1).transpose() / step).cast<float>();
  motion.acceleration = (2.0 * fit.row(2).transpose() / (step * step)).cast<float>();
  return motion;
}

}  // namespace

BorderMotion motion_before(std::span<const Eigen::Vector3f> path, double hertz) noexcept {
  return quadratic(path, -1.0 / hertz);
}
BorderMotion motion_after(std::span<const Eigen::Vector3f> path, double hertz) noexcept {
  return quadratic(path, 1.0 / hertz);
}

GapTime::GapTime(const Gap& gap) noexcept
    : count_(static_cast<double>(gap.count + 1)),
      seconds_(gap.duration().count()),
      way_(std::min(seconds_, kLongestWay)) {
  if (gap.pause <= Seconds(0)) return;
  pauses_ = true;
  way_ = std::min(way_, std::max(seconds_ - gap.pause.count(), gap.rate.frame_time().count()));
}

GapTime GapTime::even(const Gap& gap) noexcept {
  GapTime time(gap);
  if (!time.pauses_) time.way_ = time.seconds_;
  return time;
}

double GapTime::at(std::int64_t frame) const noexcept {
  const double t = static_cast<double>(frame + 1) / count_;
  if (!(way_ < seconds_)) return t;
  if (pauses_) {
    // The speed falls from 1 to 0 and rises again, as below; between the two it rests.
    const double ease = std::min({kPauseEase, way_, seconds_ - way_});
    const double rest = seconds_ - way_ - ease;
    const double since = t * seconds_;
    const auto eased = [&](double x) { return ease * (x - x * x * x + 0.5 * x * x * x * x); };
    if (since <= ease) return eased(since / ease) / way_;
    if (since <= ease + rest) return 0.5 * ease / way_;
    const double until = 2 * ease + rest;
    if (since < until) return (ease - eased((until - since) / ease)) / way_;
    return (ease + since - until) / way_;
  }
  if (t > 0.5) return 1 - at(static_cast<std::int64_t>(count_) - 2 - frame);
  // The speed falls from 1 to `slow` within `ease`, as 1 − 3x² + 2x³ does.
  const double ease = way_ / 2;
  const double slow = ease / (seconds_ - ease);
  const double since = t * seconds_;
  const double x = std::min(1.0, since / ease);
  const double gone = ease * (x - x * x * x + 0.5 * x * x * x * x);
  return (slow * since + (1 - slow) * gone) / way_;
}

Eigen::Vector3f rotation_vector(const Eigen::Quaternionf& q) noexcept {
  const float sine = q.vec().norm();
  if (sine < 1e-7f) return 2.0f * q.vec() * (q.w() < 0 ? -1.0f : 1.0f);
  return q.vec() * (2.0f * std::atan2(sine, q.w()) / sine);
}

Eigen::Quaternionf rotation_of(const Eigen::Vector3f& vector) noexcept {
  const float square = 0.25f * vector.squaredNorm();  // of the half angle
  if (square > 2.5f || !(square >= 0)) {
    const float half = std::sqrt(square);
    const Eigen::Vector3f axis = vector * (0.5f * std::sin(half) / half);
    return {std::cos(half), axis.x(), axis.y(), axis.z()};
  }
  // The series of sine (over the angle) and cosine, off by less than 1e-7.
  const float y = square;
  const float sine =
      1 - y * (1.0f / 6) *
              (1 - y * (1.0f / 20) *
                       (1 - y * (1.0f / 42) * (1 - y * (1.0f / 72) * (1 - y * (1.0f / 110) * (1 - y * (1.0f / 156))))));
  const float cosine =
      1 - y * (1.0f / 2) *
              (1 - y * (1.0f / 12) *
                       (1 - y * (1.0f / 30) *
                                (1 - y * (1.0f / 56) *
                                         (1 - y * (1.0f / 90) * (1 - y * (1.0f / 132) * (1 - y * (1.0f / 182)))))));
  const Eigen::Vector3f axis = vector * (0.5f * sine);
  return {cosine, axis.x(), axis.y(), axis.z()};
}

Eigen::Vector3f JointReach::operator()(const Eigen::Vector3f& vector) const noexcept {
  if (margin <= 0) return vector;
  const float square = vector.squaredNorm();
  if (!(square > seen * seen)) return vector;
  const float length = std::sqrt(square);
  return vector * ((seen + margin * std::tanh((length - seen) / margin)) / length);
}

JointReach reach_of(const Sides& sides) noexcept {
  float square = 0;
  for (const auto& side : {sides.before, sides.after}) {
    for (const Eigen::Vector3f& vector : side) square = std::max(square, vector.squaredNorm());
  }
  // Radians: about 10° for fingers, 25° for an elbow or a wrist, 45° for a shoulder.
  const float margin = sides.role == JointRole::finger ? 0.17f : sides.role == JointRole::shoulder ? 0.8f : 0.45f;
  return {std::sqrt(square), margin};
}

Eigen::Quaternionf middle_of(const Eigen::Quaternionf& left, const Eigen::Quaternionf& right) noexcept {
  const float sign = left.dot(right) < 0 ? -1.0f : 1.0f;
  Eigen::Quaternionf middle;
  middle.coeffs() = left.coeffs() + sign * right.coeffs();
  const float length = middle.norm();
  if (length < 1e-6f) return left;
  middle.coeffs() /= length;
  return middle;
}

std::int64_t context_frames(const PosesView& side, FrameRate rate) noexcept {
  return std::min(side.frames, std::max<std::int64_t>(4, std::llround(kSeen * rate.hertz()) + 1));
}

Eigen::Quaternionf see_joint(const Gap& gap, std::size_t joint, GapScratch& scratch) {
  const Eigen::Quaternionf left = gap.left().rotations[joint];
  const Eigen::Quaternionf right = gap.right().rotations[joint];
  Eigen::Quaternionf middle = middle_of(left, right);
  const Eigen::Quaternionf back = middle.conjugate();
  // Neighbours keep one hemisphere, so one sign a side lets a way go on beyond half a turn from the middle.
  const auto see = [&](const PosesView& side, std::int64_t border, int step, std::vector<Eigen::Vector3f>& way) {
    const std::int64_t count = context_frames(side, gap.rate);
    const std::size_t joints = side.joints();
    way.resize(static_cast<std::size_t>(count));
    Eigen::Quaternionf last = middle;
    for (std::int64_t k = 0; k < count; ++k) {
      Eigen::Quaternionf q = side.rotations[static_cast<std::size_t>(border + k * step) * joints + joint];
      if (last.dot(q) < 0) q.coeffs() *= -1.0f;
      way[static_cast<std::size_t>(k)] = rotation_vector(back * q);
      last = q;
    }
  };
  see(gap.before, gap.before.frames - 1, -1, scratch.before);
  see(gap.after, 0, 1, scratch.after);
  return middle;
}

Eigen::Vector3f see_translation(const Gap& gap, std::size_t translation, GapScratch& scratch) {
  Eigen::Vector3f middle = 0.5f * (gap.left().translations[translation] + gap.right().translations[translation]);
  const auto see = [&](const PosesView& side, std::int64_t border, int step, std::vector<Eigen::Vector3f>& way) {
    const std::int64_t count = context_frames(side, gap.rate);
    const std::size_t moved = side.moved();
    way.resize(static_cast<std::size_t>(count));
    for (std::int64_t k = 0; k < count; ++k) {
      way[static_cast<std::size_t>(k)] =
          side.translations[static_cast<std::size_t>(border + k * step) * moved + translation] - middle;
    }
  };
  see(gap.before, gap.before.frames - 1, -1, scratch.before);
  see(gap.after, 0, 1, scratch.after);
  return middle;
}

}  // namespace signweave
