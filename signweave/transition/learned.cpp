#include "signweave/transition/learned.h"

#include <algorithm>
#include <cmath>

#include "signweave/transition/fill.h"
#include "signweave/transition/kriging.h"

namespace signweave {
namespace {

/// Blend weight from the kriged trajectory to the cubic through both borders with their velocities. Kriging is best for
/// hands; the cubic is more robust with noisy captures, and for joints that do not carry hands. Tuned on captured spans
/// (docs/evaluation.md).
float lean_of(JointRole role) noexcept {
  switch (role) {
    case JointRole::trunk:
    case JointRole::shoulder:
    case JointRole::elbow:
      return 0.25f;
    case JointRole::other_arm:
      return 0.5f;
    case JointRole::other:
    case JointRole::finger:
      return 1.0f;
  }
  return 1.0f;
}

/// The share of a border's velocity that fingers keep; they hardly continue their movement.
constexpr float kFingerVelocity = 0.25f;

/// The velocity at a border away from the gap, of the parabola through it and the next two frames. The next frame must
/// continue it, otherwise the seam has a kink.
Eigen::Vector3f velocity_at(std::span<const Eigen::Vector3f> path, double hertz) noexcept {
  if (path.size() < 2) return Eigen::Vector3f::Zero();
  const auto rate = static_cast<float>(hertz);
  if (path.size() == 2) return rate * (path[1] - path[0]);
  return 0.5f * rate * (4 * path[1] - 3 * path[0] - path[2]);
}

/// The kriged trajectory, blended slightly with the cubic, plus the learned correction.
struct Learned {
  Kriging kriging;
  const TransitionModel& model;

  std::size_t terms() const noexcept { return kriging.terms() + kBends + 4; }
  void row(double t, std::int64_t frame, float* out) const noexcept {
    kriging.row(t, frame, out);
    float* next = out + kriging.terms();
    for (const double bend : bends_at(t)) *next++ = static_cast<float>(bend);
    const double square = t * t;
    const double cube = square * t;
    *next++ = static_cast<float>(2 * cube - 3 * square + 1);
    *next++ = static_cast<float>(cube - 2 * square + t);
    *next++ = static_cast<float>(3 * square - 2 * cube);
    *next++ = static_cast<float>(cube - square);
  }
  void coefficients(const Sides& sides, Eigen::Vector3f* out) const noexcept {
    kriging.coefficients(sides, out);
    const float lean = lean_of(sides.role);
    for (std::size_t i = 0; i < kriging.terms(); ++i) out[i] *= 1.0f - lean;
    const auto corrections = corrections_of(model, sides);
    Eigen::Vector3f* next = std::copy(corrections.begin(), corrections.end(), out + kriging.terms());
    const float share = sides.role == JointRole::finger ? kFingerVelocity : 1.0f;
    const float damped = lean * share * static_cast<float>(sides.seconds);
    *next++ = lean * sides.left();
    *next++ = damped * -velocity_at(sides.before, sides.hertz);
    *next++ = lean * sides.right();
    *next++ = damped * velocity_at(sides.after, sides.hertz);
  }
};

}  // namespace

BetweenKnots between_knots(double seconds) noexcept {
  if (!(seconds > kKnots.front())) return {0, 0};
  for (std::size_t i = 0; i + 1 < kKnots.size(); ++i) {
    if (seconds < kKnots[i + 1]) return {i, std::log(seconds / kKnots[i]) / std::log(kKnots[i + 1] / kKnots[i])};
  }
  return {kKnots.size() - 2, 1};
}

std::array<double, kBends> bends_at(double t) noexcept {
  const double x = 2 * t - 1;
  const double bump = 16 * t * t * (1 - t) * (1 - t);
  return {bump, bump * x, bump * (1.5 * x * x - 0.5), bump * (2.5 * x * x * x - 1.5 * x)};
}

std::array<Eigen::Vector3f, kTraits> traits_of(const Sides& sides) noexcept {
  const auto seconds = static_cast<float>(sides.seconds);
  return {sides.right() - sides.left(), seconds * motion_before(sides.before, sides.hertz).velocity,
          seconds * motion_after(sides.after, sides.hertz).velocity};
}

float damping_of(const TransitionModel& model, Damped which, JointGroup group, double seconds) noexcept {
  const BetweenKnots at = between_knots(seconds);
  const auto of = [&](std::size_t knot) {
    return model.damping[knot][static_cast<std::size_t>(group)][static_cast<std::size_t>(which)];
  };
  return of(at.lower) + static_cast<float>(at.part) * (of(at.lower + 1) - of(at.lower));
}

std::array<Eigen::Vector3f, kBends> corrections_of(const TransitionModel& model, const Sides& sides) noexcept {
  std::array<Eigen::Vector3f, kBends> corrections;
  corrections.fill(Eigen::Vector3f::Zero());
  if (!sides.rotation || sides.role == JointRole::other || sides.role == JointRole::finger) return corrections;
  const BetweenKnots at = between_knots(sides.seconds);
  const auto traits = traits_of(sides);
  const std::size_t first = (static_cast<std::size_t>(sides.role) - 1) * kBends * kTraits;
  const Bends& lower = model.bends[at.lower];
  const Bends& upper = model.bends[at.lower + 1];
  const auto part = static_cast<float>(at.part);
  for (std::size_t bend = 0; bend < kBends; ++bend) {
    for (std::size_t trait = 0; trait < kTraits; ++trait) {
      const std::size_t i = first + bend * kTraits + trait;
      corrections[bend] += (lower[i] + part * (upper[i] - lower[i])) * traits[trait];
    }
  }
  return corrections;
}

void fill_learned(const GapJob& job, MutablePoses out) noexcept {
  const GapTime time(job.gap);
  fill_curves(job, out, Learned{Kriging(job.gap, time, job.scratch.numbers), job.model}, time);
}

}  // namespace signweave
