#include <algorithm>

#include "signweave/transition/curves.h"
#include "signweave/transition/fill.h"
#include "signweave/transition/learned.h"

namespace signweave {
namespace {

/// A cubic with given position and velocity at both borders (Hermite). The velocities are damped by the model.
struct Hermite {
  const TransitionModel& model;

  std::size_t terms() const noexcept { return 4; }
  void row(double t, std::int64_t, float* out) const noexcept {
    const double square = t * t;
    const double cube = square * t;
    out[0] = static_cast<float>(2 * cube - 3 * square + 1);
    out[1] = static_cast<float>(cube - 2 * square + t);
    out[2] = static_cast<float>(3 * square - 2 * cube);
    out[3] = static_cast<float>(cube - square);
  }
  void coefficients(const Sides& sides, Eigen::Vector3f* out) const noexcept {
    const float damped =
        static_cast<float>(sides.seconds) * damping_of(model, Damped::velocity, sides.group, sides.seconds);
    out[0] = sides.left();
    out[1] = damped * motion_before(sides.before, sides.hertz).velocity;
    out[2] = sides.right();
    out[3] = damped * motion_after(sides.after, sides.hertz).velocity;
  }
};

/// A polynomial of degree five with given position, velocity and acceleration at both borders.
struct Quintic {
  const TransitionModel& model;

  std::size_t terms() const noexcept { return 6; }
  void row(double t, std::int64_t, float* out) const noexcept {
    const double t2 = t * t;
    const double t3 = t2 * t;
    const double t4 = t3 * t;
    const double t5 = t4 * t;
    out[3] = static_cast<float>(10 * t3 - 15 * t4 + 6 * t5);
    out[0] = 1.0f - out[3];
    out[1] = static_cast<float>(t - 6 * t3 + 8 * t4 - 3 * t5);
    out[2] = static_cast<float>(0.5 * t2 - 1.5 * t3 + 1.5 * t4 - 0.5 * t5);
    out[4] = static_cast<float>(-4 * t3 + 7 * t4 - 3 * t5);
    out[5] = static_cast<float>(0.5 * t3 - t4 + 0.5 * t5);
  }
  void coefficients(const Sides& sides, Eigen::Vector3f* out) const noexcept {
    const auto seconds = static_cast<float>(sides.seconds);
    const float speed = seconds * damping_of(model, Damped::quintic_velocity, sides.group, sides.seconds);
    const float force = seconds * seconds * damping_of(model, Damped::quintic_acceleration, sides.group, sides.seconds);
    const BorderMotion before = motion_before(sides.before, sides.hertz);
    const BorderMotion after = motion_after(sides.after, sides.hertz);
    out[0] = sides.left();
    out[1] = speed * before.velocity;
    out[2] = force * before.acceleration;
    out[3] = sides.right();
    out[4] = speed * after.velocity;
    out[5] = force * after.acceleration;
  }
};

/// The right side is extrapolated backwards into the gap, starting from rest; the left border's offset from it fades
/// out with its position and velocity (after Bollo, Inertialization, GDC 2018: a quintic that ends at rest).
struct Inertialize {
  double seconds;

  static constexpr double kRun = 0.15;  ///< seconds in which the right side starts from rest. (ours)

  std::size_t terms() const noexcept { return 4; }
  void row(double t, std::int64_t, float* out) const noexcept {
    const double t3 = t * t * t;
    const double t4 = t3 * t;
    const double t5 = t4 * t;
    const double place = 1 - (10 * t3 - 15 * t4 + 6 * t5);
    const double speed = t - 6 * t3 + 8 * t4 - 3 * t5;
    const double run = std::min(kRun, seconds);
    const double left = (1 - t) * seconds;  // time until the right border
    const double distance = left >= run ? run / 2 : left - left * left / (2 * run);
    out[0] = static_cast<float>(place);
    out[1] = static_cast<float>(speed);
    out[2] = 1.0f;
    out[3] = static_cast<float>(-distance);
  }
  void coefficients(const Sides& sides, Eigen::Vector3f* out) const noexcept {
    const double run = std::min(kRun, seconds);
    const Eigen::Vector3f speed = motion_after(sides.after, sides.hertz).velocity;
    out[2] = sides.right();
    out[3] = speed;
    const Eigen::Vector3f start = sides.right() - static_cast<float>(run / 2) * speed;
    // If the run fills the whole gap, the target starts moving at the left border, with speed 0 there.
    out[0] = sides.left() - start;
    out[1] = static_cast<float>(seconds) * motion_before(sides.before, sides.hertz).velocity;
  }
};

}  // namespace

void fill_hermite(const GapJob& job, MutablePoses out) noexcept {
  fill_curves(job, out, Hermite{job.model}, GapTime(job.gap));
}

void fill_quintic(const GapJob& job, MutablePoses out) noexcept {
  fill_curves(job, out, Quintic{job.model}, GapTime(job.gap));
}

void fill_inertialize(const GapJob& job, MutablePoses out) noexcept {
  const GapTime time(job.gap);
  fill_curves(job, out, Inertialize{time.seconds()}, time);
}

}  // namespace signweave
