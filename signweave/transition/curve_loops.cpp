#include "signweave/transition/curve_loops.h"

#include <algorithm>

#include "signweave/core/vector_loops.h"
#include "signweave/transition/curves.h"

namespace signweave::curve_loops {
namespace {

/// Twice the arcsine of the root of `square` over that root, by its series: off by less than 2e-8 of it up to
/// kSeriesSquare. The rotation vector of a unit quaternion is its vector times this of the vector's square.
[[gnu::always_inline]] inline float angle_over_sine(float square) noexcept {
  const float x = square;
  float sum = 1 + x * (289.0f / 342);
  sum = 1 + x * (225.0f / 272) * sum;
  sum = 1 + x * (169.0f / 210) * sum;
  sum = 1 + x * (121.0f / 156) * sum;
  sum = 1 + x * (81.0f / 110) * sum;
  sum = 1 + x * (49.0f / 72) * sum;
  sum = 1 + x * (25.0f / 42) * sum;
  sum = 1 + x * (9.0f / 20) * sum;
  sum = 1 + x * (1.0f / 6) * sum;
  return 2 * sum;
}
constexpr float kSeriesSquare = 0.25f;    // half an angle of 30°
constexpr float kSeriesQuarter = 0.617f;  // a quarter of an angle of 45°

/// Where each number of some rotations lies, [x y z w][count].
struct Planes {
  const float* x;
  const float* y;
  const float* z;
  const float* w;
};
[[gnu::always_inline]] inline Planes planes_of(const float* rotations, std::size_t count) noexcept {
  return {rotations, rotations + count, rotations + 2 * count, rotations + 3 * count};
}

}  // namespace

void follow(const Eigen::Quaternionf* pose, const std::size_t* joints, std::size_t count, float* last) noexcept {
  for (std::size_t i = 0; i < count; ++i) {
    const Eigen::Quaternionf& q = pose[joints[i]];
    float* const at = last + i;
    const float dot = at[0] * q.x() + at[count] * q.y() + at[2 * count] * q.z() + at[3 * count] * q.w();
    const float sign = dot < 0 ? -1.0f : 1.0f;
    at[0] = sign * q.x();
    at[count] = sign * q.y();
    at[2 * count] = sign * q.z();
    at[3 * count] = sign * q.w();
  }
}

SIGNWEAVE_VECTOR_CLONES void see_rotations(const float* q, const float* middles, std::size_t count, std::size_t width,
                                           float* out) noexcept {
  const auto [qx, qy, qz, qw] = planes_of(q, count);
  const auto [mx, my, mz, mw] = planes_of(middles, count);
  float* const ox = out;
  float* const oy = out + width;
  float* const oz = out + 2 * width;
  int far = 0;
  SIGNWEAVE_INDEPENDENT
  for (std::size_t i = 0; i < count; ++i) {
    const float x = mw[i] * qx[i] - qw[i] * mx[i] - (my[i] * qz[i] - mz[i] * qy[i]);
    const float y = mw[i] * qy[i] - qw[i] * my[i] - (mz[i] * qx[i] - mx[i] * qz[i]);
    const float z = mw[i] * qz[i] - qw[i] * mz[i] - (mx[i] * qy[i] - my[i] * qx[i]);
    const float w = mw[i] * qw[i] + mx[i] * qx[i] + my[i] * qy[i] + mz[i] * qz[i];
    const float square = x * x + y * y + z * z;
    const float factor = angle_over_sine(square);
    far |= static_cast<int>(!(square <= kSeriesSquare)) | static_cast<int>(!(w > 0));
    ox[i] = factor * x;
    oy[i] = factor * y;
    oz[i] = factor * z;
  }
  if (far == 0) return;
  for (std::size_t i = 0; i < count; ++i) {
    const Eigen::Quaternionf turn =
        Eigen::Quaternionf(mw[i], -mx[i], -my[i], -mz[i]) * Eigen::Quaternionf(qw[i], qx[i], qy[i], qz[i]);
    if (turn.w() > 0 && turn.vec().squaredNorm() <= kSeriesSquare) continue;
    const Eigen::Vector3f vector = rotation_vector(turn);
    for (Eigen::Index axis = 0; axis < 3; ++axis) out[static_cast<std::size_t>(axis) * width + i] = vector[axis];
  }
}

SIGNWEAVE_VECTOR_CLONES void add_up(std::span<const float> row, const float* ways, std::size_t width,
                                    float* out) noexcept {
  constexpr std::size_t kBlock = 16;
  std::size_t begin = 0;
  for (; begin + kBlock <= width; begin += kBlock) {
    float sum[kBlock] = {};
    for (std::size_t term = 0; term < row.size(); ++term) {
      const float* const way = ways + term * width + begin;
      for (std::size_t i = 0; i < kBlock; ++i) sum[i] += row[term] * way[i];
    }
    std::copy_n(sum, kBlock, out + begin);
  }
  for (; begin < width; ++begin) {
    float sum = 0;
    for (std::size_t term = 0; term < row.size(); ++term) sum += row[term] * ways[term * width + begin];
    out[begin] = sum;
  }
}

SIGNWEAVE_VECTOR_CLONES void keep_within(const JointReach* reaches, std::size_t count, std::size_t width,
                                         float* vectors) noexcept {
  float* const vx = vectors;
  float* const vy = vectors + width;
  float* const vz = vectors + 2 * width;
  SIGNWEAVE_INDEPENDENT
  for (std::size_t i = 0; i < count; ++i) {
    const float x = vx[i];
    const float y = vy[i];
    const float z = vz[i];
    const float scale = reaches[i].scale(x * x + y * y + z * z);
    vx[i] = scale * x;
    vy[i] = scale * y;
    vz[i] = scale * z;
  }
}

SIGNWEAVE_VECTOR_CLONES void turn_by(const float* vectors, const float* middles, std::size_t count, std::size_t width,
                                     float* q) noexcept {
  const auto [mx, my, mz, mw] = planes_of(middles, count);
  const float* const vx = vectors;
  const float* const vy = vectors + width;
  const float* const vz = vectors + 2 * width;
  float* const ox = q;
  float* const oy = q + count;
  float* const oz = q + 2 * count;
  float* const ow = q + 3 * count;
  int far = 0;
  SIGNWEAVE_INDEPENDENT
  for (std::size_t i = 0; i < count; ++i) {
    const float x = vx[i];
    const float y = vy[i];
    const float z = vz[i];
    const float square = 0.0625f * (x * x + y * y + z * z);  // of a quarter of the angle
    far |= static_cast<int>(!(square <= kSeriesQuarter));
    // Sine (over the quarter angle) and cosine by their series, off by less than 3e-8, and the half angle's from them.
    const float sine =
        1 - square * (1.0f / 6) * (1 - square * (1.0f / 20) * (1 - square * (1.0f / 42) * (1 - square * (1.0f / 72))));
    const float cosine =
        1 - square * (1.0f / 2) *
                (1 - square * (1.0f / 12) *
                         (1 - square * (1.0f / 30) * (1 - square * (1.0f / 56) * (1 - square * (1.0f / 90)))));
    const float w = 1 - 2 * square * sine * sine;
    const float factor = 0.5f * sine * cosine;
    const float tx = factor * x;
    const float ty = factor * y;
    const float tz = factor * z;
    ox[i] = mw[i] * tx + mx[i] * w + my[i] * tz - mz[i] * ty;
    oy[i] = mw[i] * ty + my[i] * w + mz[i] * tx - mx[i] * tz;
    oz[i] = mw[i] * tz + mz[i] * w + mx[i] * ty - my[i] * tx;
    ow[i] = mw[i] * w - mx[i] * tx - my[i] * ty - mz[i] * tz;
  }
  if (far == 0) return;
  for (std::size_t i = 0; i < count; ++i) {
    const Eigen::Vector3f vector(vectors[i], vectors[width + i], vectors[2 * width + i]);
    if (0.0625f * vector.squaredNorm() <= kSeriesQuarter) continue;
    const Eigen::Quaternionf turn = Eigen::Quaternionf(mw[i], mx[i], my[i], mz[i]) * rotation_of(vector);
    for (Eigen::Index axis = 0; axis < 4; ++axis) q[static_cast<std::size_t>(axis) * count + i] = turn.coeffs()[axis];
  }
}

}  // namespace signweave::curve_loops
