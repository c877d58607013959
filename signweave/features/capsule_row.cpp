#include "signweave/features/capsule_row.h"

#include <algorithm>
#include <cmath>

#include "signweave/core/vector_loops.h"

namespace signweave {
namespace {

constexpr float kNone = -1e6f;  ///< radius of an unused slot, which makes its clearance large

}  // namespace

void CapsuleRow::add(const Capsule& capsule) noexcept {
  if (count == 0) radius.fill(kNone);
  const Eigen::Vector3f along = capsule.to - capsule.from;
  from_x[count] = capsule.from.x();
  from_y[count] = capsule.from.y();
  from_z[count] = capsule.from.z();
  along_x[count] = along.x();
  along_y[count] = along.y();
  along_z[count] = along.z();
  square[count] = along.squaredNorm();
  radius[count] = capsule.radius;
  ++count;
}

void CapsuleRow::clear() noexcept {
  count = 0;
  radius.fill(kNone);
}

Capsule CapsuleRow::operator[](std::size_t i) const noexcept {
  const Eigen::Vector3f from(from_x[i], from_y[i], from_z[i]);
  return {from, from + Eigen::Vector3f(along_x[i], along_y[i], along_z[i]), radius[i]};
}

SIGNWEAVE_VECTOR_CLONES void clearances(const Capsule& one, const CapsuleRow& row, std::size_t begin,
                                        CapsuleRow::Numbers& out) noexcept {
  constexpr float kPoint = 1e-12f;
  constexpr std::size_t kBlock = 8;
  const float fx = one.from.x(), fy = one.from.y(), fz = one.from.z();
  const float ux = one.to.x() - fx, uy = one.to.y() - fy, uz = one.to.z() - fz;
  const float uu = std::max(ux * ux + uy * uy + uz * uz, kPoint);
  const float inverse = 1 / uu;
  for (std::size_t block = begin / kBlock * kBlock; block < row.count; block += kBlock) {
    SIGNWEAVE_INDEPENDENT
    for (std::size_t i = block; i < block + kBlock; ++i) {
      const float vx = row.along_x[i], vy = row.along_y[i], vz = row.along_z[i];
      const float wx = fx - row.from_x[i], wy = fy - row.from_y[i], wz = fz - row.from_z[i];
      const float vv = row.square[i] > kPoint ? row.square[i] : kPoint;
      const float uv = ux * vx + uy * vy + uz * vz;
      const float uw = ux * wx + uy * wy + uz * wz;
      const float vw = vx * wx + vy * wy + vz * wz;
      // The closest points of the lines, then clamped to both capsules, one after the other.
      const float across = uu * vv - uv * uv;
      float s = across > 1e-6f * uu * vv ? (uv * vw - uw * vv) / across : 0.0f;
      s = s > 0 ? s : 0.0f;
      s = s < 1 ? s : 1.0f;
      float t = (uv * s + vw) / vv;
      t = t > 0 ? t : 0.0f;
      t = t < 1 ? t : 1.0f;
      s = (uv * t - uw) * inverse;
      s = s > 0 ? s : 0.0f;
      s = s < 1 ? s : 1.0f;
      const float x = wx + s * ux - t * vx;
      const float y = wy + s * uy - t * vy;
      const float z = wz + s * uz - t * vz;
      out[i] = std::sqrt(x * x + y * y + z * z) - one.radius - row.radius[i];
    }
  }
}

CapsuleRow moved(const CapsuleRow& row, const Eigen::Matrix3f& turn, const Eigen::Vector3f& shift) noexcept {
  CapsuleRow out = row;
  for (std::size_t i = 0; i < row.count; ++i) {
    const Eigen::Vector3f from = turn * Eigen::Vector3f(row.from_x[i], row.from_y[i], row.from_z[i]) + shift;
    const Eigen::Vector3f along = turn * Eigen::Vector3f(row.along_x[i], row.along_y[i], row.along_z[i]);
    out.from_x[i] = from.x();
    out.from_y[i] = from.y();
    out.from_z[i] = from.z();
    out.along_x[i] = along.x();
    out.along_y[i] = along.y();
    out.along_z[i] = along.z();
  }
  return out;
}

}  // namespace signweave
