// Slerp of many joints at once. Plain loops over the components of the quaternions, which the compiler vectorises: no
// branch, no call. All in single precision; the result differs from slerp in double precision by less than 1e-6 radians
// (slerp_test.cpp).

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "signweave/core/vector_loops.h"
#include "signweave/motion/blend.h"

namespace signweave {
namespace {

constexpr float kHalfPi = 1.57079632679f;

/// Sine on [0, pi / 2]: the Taylor series to x^11, with an error of at most 6e-8.
[[gnu::always_inline]] inline float sine_first_quadrant(float x) noexcept {
  const float y = x * x;
  const float high = 2.7557319e-6f - y * 2.5052108e-8f;
  return x * (1.0f + y * (-1.6666667e-1f + y * (8.3333333e-3f + y * (-1.9841270e-4f + y * high))));
}

/// Sine on [0, pi].
[[gnu::always_inline]] inline float sine(float x) noexcept {
  return sine_first_quadrant(kHalfPi - std::fabs(kHalfPi - x));
}

/// Arc cosine on [0, 1], with an error of at most 2e-8 (Abramowitz and Stegun, Handbook of Mathematical Functions,
/// 4.4.46).
[[gnu::always_inline]] inline float arc_cosine(float x) noexcept {
  float p = -0.0012624911f;
  p = p * x + 0.0066700901f;
  p = p * x - 0.0170881256f;
  p = p * x + 0.0308918810f;
  p = p * x - 0.0501743046f;
  p = p * x + 0.0889789874f;
  p = p * x - 0.2145988016f;
  p = p * x + 1.5707963050f;
  return std::sqrt(1.0f - x) * p;
}

/// Limit of the cosine between two quaternions: at this distance the arc is a straight line within float precision, and
/// its sine is still nonzero.
constexpr float kNearest = 0.9999995f;

enum class Arc { shorter, as_signed };

/// The components of one quaternion.
struct Numbers {
  float x, y, z, w;
};

template <Arc arc>
[[gnu::always_inline]] inline Numbers slerp_one(Numbers a, Numbers b, float t) noexcept {
  const float dot = a.x * b.x + a.y * b.y + a.z * b.z + a.w * b.w;
  const float size = std::min(std::fabs(dot), kNearest);
  const float acute = arc_cosine(size);
  // Takes the longer arc only if requested, and not if all arcs are equally long.
  const bool longer = arc == Arc::as_signed && dot < 0.0f && dot > -0.9995f;
  const float angle = longer ? 2.0f * kHalfPi - acute : acute;
  const float inverse = 1.0f / sine(angle);
  const float from = sine((1.0f - t) * angle) * inverse;
  const float to_size = sine(t * angle) * inverse;
  const float to = longer ? to_size : std::copysign(to_size, dot);
  const Numbers sum{from * a.x + to * b.x, from * a.y + to * b.y, from * a.z + to * b.z, from * a.w + to * b.w};
  const float scale = 1.0f / std::sqrt(sum.x * sum.x + sum.y * sum.y + sum.z * sum.z + sum.w * sum.w);
  return {sum.x * scale, sum.y * scale, sum.z * scale, sum.w * scale};
}

[[gnu::always_inline]] inline Numbers load(const float* at) noexcept {
  return {at[0], at[1], at[2], at[3]};
}
[[gnu::always_inline]] inline void store(Numbers q, float* at) noexcept {
  at[0] = q.x;
  at[1] = q.y;
  at[2] = q.z;
  at[3] = q.w;
}

const float* numbers(std::span<const Eigen::Quaternionf> rotations) noexcept {
  return rotations.empty() ? nullptr : rotations.front().coeffs().data();
}
float* numbers(std::span<Eigen::Quaternionf> rotations) noexcept {
  return rotations.empty() ? nullptr : rotations.front().coeffs().data();
}

template <Arc arc>
[[gnu::always_inline]] inline void slerp_all(const float* a, const float* b, float t, float* out,
                                             std::size_t count) noexcept {
  SIGNWEAVE_INDEPENDENT
  for (std::size_t i = 0; i < count; ++i) {
    store(slerp_one<arc>(load(a + 4 * i), load(b + 4 * i), t), out + 4 * i);
  }
}

/// Returns a rotation turned further by half of a rotation vector.
[[gnu::always_inline]] inline Numbers turned(Numbers q, float hx, float hy, float hz) noexcept {
  const float y = hx * hx + hy * hy + hz * hz;  // the half angle squared, at most (pi / 2)²
  // Taylor series of cos h and sin h / h in h², with errors of at most 5e-7 and 6e-8.
  const float w =
      1.0f + y * (-0.5f + y * (4.1666667e-2f + y * (-1.3888889e-3f + y * (2.4801587e-5f + y * -2.7557319e-7f))));
  const float high = 2.7557319e-6f - y * 2.5052108e-8f;
  const float s = 1.0f + y * (-1.6666667e-1f + y * (8.3333333e-3f + y * (-1.9841270e-4f + y * high)));
  const float x = hx * s;
  const float v = hy * s;
  const float z = hz * s;
  return {q.w * x + q.x * w + q.y * z - q.z * v, q.w * v + q.y * w + q.z * x - q.x * z,
          q.w * z + q.z * w + q.x * v - q.y * x, q.w * w - q.x * x - q.y * v - q.z * z};
}

/// The number of joints computed at a time, on the stack.
constexpr std::size_t kBlock = 64;

/// One array per component: the layout that vectorises best.
struct Block {
  float x[kBlock], y[kBlock], z[kBlock], w[kBlock];
};

/// Pointers to one array per component of a side's joints.
struct Side {
  const float *x, *y, *z, *w, *vx, *vy, *vz;

  Side(const CoastingRotations& joints, std::size_t first)
      : x(joints.number(0) + first),
        y(joints.number(1) + first),
        z(joints.number(2) + first),
        w(joints.number(3) + first),
        vx(joints.number(4) + first),
        vy(joints.number(5) + first),
        vz(joints.number(6) + first) {}
  [[gnu::always_inline]] Numbers at(std::size_t i) const noexcept { return {x[i], y[i], z[i], w[i]}; }
  [[gnu::always_inline]] Numbers turned(std::size_t i, float half) const noexcept {
    return signweave::turned(at(i), half * vx[i], half * vy[i], half * vz[i]);
  }
};

[[gnu::always_inline]] inline void put(Numbers q, std::size_t i, Block& out) noexcept {
  out.x[i] = q.x;
  out.y[i] = q.y;
  out.z[i] = q.z;
  out.w[i] = q.w;
}

SIGNWEAVE_VECTOR_CLONES
void blend_coasting_both(Side a, float a_half, Side b, float b_half, float t, std::size_t count, Block& out) noexcept {
  SIGNWEAVE_INDEPENDENT
  for (std::size_t i = 0; i < count; ++i) {
    put(slerp_one<Arc::as_signed>(a.turned(i, a_half), b.turned(i, b_half), t), i, out);
  }
}
SIGNWEAVE_VECTOR_CLONES
void blend_coasting_a(Side a, float a_half, Side b, float t, std::size_t count, Block& out) noexcept {
  SIGNWEAVE_INDEPENDENT
  for (std::size_t i = 0; i < count; ++i) put(slerp_one<Arc::as_signed>(a.turned(i, a_half), b.at(i), t), i, out);
}
SIGNWEAVE_VECTOR_CLONES
void blend_coasting_b(Side a, Side b, float b_half, float t, std::size_t count, Block& out) noexcept {
  SIGNWEAVE_INDEPENDENT
  for (std::size_t i = 0; i < count; ++i) put(slerp_one<Arc::as_signed>(a.at(i), b.turned(i, b_half), t), i, out);
}

}  // namespace

void slerp(std::span<const Eigen::Quaternionf> a, std::span<const Eigen::Quaternionf> b, float t,
           std::span<Eigen::Quaternionf> out) noexcept {
  slerp_all<Arc::shorter>(numbers(a), numbers(b), t, numbers(out), out.size());
}

void slerp_as_signed(std::span<const Eigen::Quaternionf> a, std::span<const Eigen::Quaternionf> b, float t,
                     std::span<Eigen::Quaternionf> out) noexcept {
  slerp_all<Arc::as_signed>(numbers(a), numbers(b), t, numbers(out), out.size());
}

void CoastingRotations::assign(std::span<const Eigen::Quaternionf> rotations,
                               std::span<const Eigen::Vector3f> velocities) {
  count_ = rotations.size();
  numbers_.resize(7 * count_);
  for (std::size_t i = 0; i < count_; ++i) {
    for (std::size_t k = 0; k < 4; ++k) numbers_[k * count_ + i] = rotations[i].coeffs()[static_cast<Eigen::Index>(k)];
    for (std::size_t k = 0; k < 3; ++k) numbers_[(4 + k) * count_ + i] = velocities[i][static_cast<Eigen::Index>(k)];
  }
}

void CoastingRotations::coast(float frames) {
  for (std::size_t i = 0; i < count_; ++i) {
    const Numbers q = Side(*this, 0).turned(i, 0.5f * frames);
    numbers_[i] = q.x;
    numbers_[count_ + i] = q.y;
    numbers_[2 * count_ + i] = q.z;
    numbers_[3 * count_ + i] = q.w;
  }
}

void slerp_coasting(const CoastingRotations& a, float a_frames, const CoastingRotations& b, float b_frames, float t,
                    std::span<Eigen::Quaternionf> out) noexcept {
  Block block;
  for (std::size_t first = 0; first < out.size(); first += kBlock) {
    const std::size_t count = std::min(kBlock, out.size() - first);
    const Side left(a, first);
    const Side right(b, first);
    if (b_frames == 0.0f) {
      blend_coasting_a(left, 0.5f * a_frames, right, t, count, block);
    } else if (a_frames == 0.0f) {
      blend_coasting_b(left, right, 0.5f * b_frames, t, count, block);
    } else {
      blend_coasting_both(left, 0.5f * a_frames, right, 0.5f * b_frames, t, count, block);
    }
    float* const result = numbers(out) + 4 * first;
    for (std::size_t i = 0; i < count; ++i) store({block.x[i], block.y[i], block.z[i], block.w[i]}, result + 4 * i);
  }
}

}  // namespace signweave
