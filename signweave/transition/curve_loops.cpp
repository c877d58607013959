#include "signweave/transition/curve_loops.h"

#include <algorithm>
#include <cstdint>
#include <cstring>

#include "signweave/core/vector_loops.h"
#include "signweave/transition/curves.h"

namespace signweave::curve_loops {
namespace {

/// 2 · arcsin(√square) / √square by its series; the relative error is below 2e-8 up to kSeriesSquare. The rotation
/// vector of a unit quaternion is its vector part multiplied by this function of that part's square.
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

/// Pointers to the components of rotations stored as [x y z w][count].
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

SIGNWEAVE_VECTOR_CLONES void see_farthest(std::span<const float> seen, std::size_t count, std::size_t width,
                                          float* farthest) noexcept {
  for (const float* at = seen.data(); at != seen.data() + seen.size(); at += 3 * width) {
    SIGNWEAVE_INDEPENDENT
    for (std::size_t i = 0; i < count; ++i) {
      const float x = at[i];
      const float y = at[width + i];
      const float z = at[2 * width + i];
      const float square = x * x + (y * y + z * z);
      farthest[i] = farthest[i] < square ? square : farthest[i];
    }
  }
}

SIGNWEAVE_VECTOR_CLONES void add_differences(std::span<const float> weights, const float* seen, std::size_t width,
                                             float factor, float* out) noexcept {
  std::fill_n(out, width, 0.0f);
  for (std::size_t sample = 1; sample < weights.size(); ++sample) {
    const float weight = weights[sample];
    const float* const at = seen + sample * width;
    SIGNWEAVE_INDEPENDENT
    for (std::size_t i = 0; i < width; ++i) out[i] += weight * (at[i] - seen[i]);
  }
  for (std::size_t i = 0; i < width; ++i) out[i] *= factor;
}

SIGNWEAVE_VECTOR_CLONES void add_up(std::span<const float> row, const float* vectors, std::size_t stride,
                                    std::size_t width, float* out) noexcept {
  if (width < kLanes) {
    for (std::size_t i = 0; i < width; ++i) {
      float sum = 0;
      for (std::size_t term = 0; term < row.size(); ++term) sum += row[term] * vectors[term * stride + i];
      out[i] = sum;
    }
    return;
  }
  std::fill_n(out, width, 0.0f);
  for (std::size_t term = 0; term < row.size(); ++term) {
    const float* const vector = vectors + term * stride;
    SIGNWEAVE_INDEPENDENT
    for (std::size_t i = 0; i < width; ++i) out[i] += row[term] * vector[i];
  }
}

namespace {

/// One value for each joint of a block. Processing two blocks at once hides the latency of sums.
using OneBlock = float __attribute__((vector_size(kLanes * sizeof(float))));
using TwoBlocks = float __attribute__((vector_size(2 * kLanes * sizeof(float))));
template <class Lanes>
inline constexpr std::size_t kWidth = sizeof(Lanes) / sizeof(float);

template <class Lanes>
[[gnu::always_inline]] inline void read(const float* from, Lanes& out) noexcept {
  std::memcpy(&out, from, sizeof out);
}
template <class Lanes>
[[gnu::always_inline]] inline void write(const Lanes& lanes, float* to) noexcept {
  std::memcpy(to, &lanes, sizeof lanes);
}
/// True if a comparison is true in any lane.
template <class Answers>
[[gnu::always_inline]] inline bool any(const Answers& answers) noexcept {
  std::uint64_t pairs[sizeof answers / sizeof(std::uint64_t)];
  std::memcpy(pairs, &answers, sizeof pairs);
  std::uint64_t all = 0;
  for (const std::uint64_t pair : pairs) all |= pair;
  return all != 0;
}

/// Rotation vectors.
template <class Lanes>
struct Block {
  Lanes x;
  Lanes y;
  Lanes z;
};

template <class Lanes>
[[gnu::always_inline]] inline void add_up_block(std::span<const float> row, const float* vectors, std::size_t width,
                                                Block<Lanes>& out) noexcept {
  out = Block<Lanes>{};
  for (const float weight : row) {
    Lanes x;
    Lanes y;
    Lanes z;
    read(vectors, x);
    read(vectors + width, y);
    read(vectors + 2 * width, z);
    out.x += weight * x;
    out.y += weight * y;
    out.z += weight * z;
    vectors += 3 * width;
  }
}

/// Most blocks are within their reaches; roots and quotients are computed only for the others.
template <class Lanes>
[[gnu::always_inline]] inline void keep_within(const float* seen, const float* margins, Block<Lanes>& block) noexcept {
  Lanes least;
  Lanes margin;
  read(seen, least);
  read(margins, margin);
  const Lanes square = block.x * block.x + block.y * block.y + block.z * block.z;
  const Lanes none = {};
  if (!any((square > least * least) & (margin > none))) return;
  float squares[kWidth<Lanes>];
  float scales[kWidth<Lanes>];
  write(square, squares);
  SIGNWEAVE_INDEPENDENT
  for (std::size_t i = 0; i < kWidth<Lanes>; ++i) scales[i] = JointReach{seen[i], margins[i]}.scale(squares[i]);
  Lanes scale;
  read(scales, scale);
  block.x *= scale;
  block.y *= scale;
  block.z *= scale;
}

/// Returns true if an angle is too large for the series.
template <class Lanes>
[[gnu::always_inline]] inline bool turn_block(const Block<Lanes>& block, const Planes& middles, std::size_t count,
                                              float* q) noexcept {
  const Lanes& x = block.x;
  const Lanes& y = block.y;
  const Lanes& z = block.z;
  const Lanes square = 0.0625f * (x * x + y * y + z * z);  // square of a quarter of the angle
  // Sine (divided by the quarter angle) and cosine by their series, with errors below 3e-8; from them those of the half
  // angle.
  const Lanes sine =
      1 - square * (1.0f / 6) * (1 - square * (1.0f / 20) * (1 - square * (1.0f / 42) * (1 - square * (1.0f / 72))));
  const Lanes cosine =
      1 - square * (1.0f / 2) *
              (1 - square * (1.0f / 12) *
                       (1 - square * (1.0f / 30) * (1 - square * (1.0f / 56) * (1 - square * (1.0f / 90)))));
  const Lanes w = 1 - 2 * square * sine * sine;
  const Lanes factor = 0.5f * sine * cosine;
  const Lanes tx = factor * x;
  const Lanes ty = factor * y;
  const Lanes tz = factor * z;
  Lanes mx;
  Lanes my;
  Lanes mz;
  Lanes mw;
  read(middles.x, mx);
  read(middles.y, my);
  read(middles.z, mz);
  read(middles.w, mw);
  const Lanes qx = mw * tx + mx * w + my * tz - mz * ty;
  const Lanes qy = mw * ty + my * w + mz * tx - mx * tz;
  const Lanes qz = mw * tz + mz * w + mx * ty - my * tx;
  const Lanes qw = mw * w - mx * tx - my * ty - mz * tz;
  write(qx, q);
  write(qy, q + count);
  write(qz, q + 2 * count);
  write(qw, q + 3 * count);
  const Lanes most = Lanes{} + kSeriesQuarter;
  return any(~(square <= most));
}

template <class Lanes>
[[gnu::noinline]] void turn_far_ones(const Block<Lanes>& block, const Planes& middles, std::size_t count,
                                     float* q) noexcept {
  for (std::size_t i = 0; i < kWidth<Lanes>; ++i) {
    const auto lane = static_cast<int>(i);
    const Eigen::Vector3f vector(block.x[lane], block.y[lane], block.z[lane]);
    if (0.0625f * vector.squaredNorm() <= kSeriesQuarter) continue;
    const Eigen::Quaternionf turn =
        Eigen::Quaternionf(middles.w[i], middles.x[i], middles.y[i], middles.z[i]) * rotation_of(vector);
    for (Eigen::Index axis = 0; axis < 4; ++axis) q[static_cast<std::size_t>(axis) * count + i] = turn.coeffs()[axis];
  }
}

template <class Lanes>
[[gnu::always_inline]] inline void make_block(std::span<const float> row, const Turns& turns, std::size_t begin,
                                              float* q) noexcept {
  Block<Lanes> block;
  add_up_block(row, turns.vectors + begin, turns.width, block);
  keep_within(turns.reaches.seen.data() + begin, turns.reaches.margins.data() + begin, block);
  const Planes middles = planes_of(turns.middles, turns.count);
  const Planes of_block = {middles.x + begin, middles.y + begin, middles.z + begin, middles.w + begin};
  if (turn_block(block, of_block, turns.count, q + begin)) turn_far_ones(block, of_block, turns.count, q + begin);
}

}  // namespace

SIGNWEAVE_VECTOR_CLONES void make_turns(std::span<const float> row, const Turns& turns, float* q) noexcept {
  std::size_t begin = 0;
  for (; begin + 2 * kLanes <= turns.count; begin += 2 * kLanes) make_block<TwoBlocks>(row, turns, begin, q);
  for (; begin < turns.count; begin += kLanes) make_block<OneBlock>(row, turns, begin, q);
}

}  // namespace signweave::curve_loops
