#include <cmath>
#include <numbers>

#include "signweave/transition/curves.h"
#include "signweave/transition/fill.h"

namespace signweave {
namespace {

/// From border to border along the shortest arc; `interpolate` gives the fraction at each time in (0, 1).
template <class Interpolation>
struct Between {
  Interpolation interpolate;

  std::size_t terms() const noexcept { return 2; }
  void row(double t, std::int64_t, float* out) const noexcept {
    out[1] = static_cast<float>(interpolate(t));
    out[0] = 1.0f - out[1];
  }
  void coefficients(const Sides& sides, Eigen::Vector3f* out) const noexcept {
    out[0] = sides.left();
    out[1] = sides.right();
  }
};

template <class Interpolation>
void fill_between(const GapJob& job, MutablePoses out, Interpolation interpolate) noexcept {
  fill_curves(job, out, Between<Interpolation>{interpolate}, GapTime::even(job.gap));
}

}  // namespace

void fill_hold(const GapJob& job, MutablePoses out) noexcept {
  fill_between(job, out, [](double) { return 0.0; });
}

void fill_slerp(const GapJob& job, MutablePoses out) noexcept {
  fill_between(job, out, [](double t) { return t; });
}

void fill_sine(const GapJob& job, MutablePoses out) noexcept {
  fill_between(job, out, [](double t) { return 0.5 - 0.5 * std::cos(std::numbers::pi * t); });
}

}  // namespace signweave
