#pragma once

#include <Eigen/Geometry>

#include "signweave/formats/bvh/bvh.h"

/// Conversion between a BVH file's space and ours (metres, Y up, right-handed). Internal to formats/bvh.
namespace signweave::bvh {

/// One change of basis for the whole file, rest pose and frames alike: offset' = unit · C · offset, q' = C q C⁻¹. It
/// only swaps and negates components, so a round trip gives the same bits.
struct Space {
  UpAxis up = UpAxis::y;
  bool mirrored = false;  ///< C also reflects x

  Eigen::Vector3f to_ours(const Eigen::Vector3f& v) const noexcept {
    const Eigen::Vector3f turned = up == UpAxis::z ? Eigen::Vector3f(v.x(), v.z(), -v.y()) : v;
    return mirrored ? Eigen::Vector3f(-turned.x(), turned.y(), turned.z()) : turned;
  }
  Eigen::Vector3f to_file(const Eigen::Vector3f& v) const noexcept {
    const Eigen::Vector3f turned = mirrored ? Eigen::Vector3f(-v.x(), v.y(), v.z()) : v;
    return up == UpAxis::z ? Eigen::Vector3f(turned.x(), -turned.z(), turned.y()) : turned;
  }
  Eigen::Quaternionf to_ours(const Eigen::Quaternionf& q) const noexcept { return with_axis(q, to_ours(axis(q))); }
  Eigen::Quaternionf to_file(const Eigen::Quaternionf& q) const noexcept { return with_axis(q, to_file(axis(q))); }

 private:
  // The axis of a rotation is a pseudovector: a reflection reverses it once more.
  Eigen::Vector3f axis(const Eigen::Quaternionf& q) const noexcept {
    return mirrored ? Eigen::Vector3f(-q.vec()) : Eigen::Vector3f(q.vec());
  }
  static Eigen::Quaternionf with_axis(const Eigen::Quaternionf& q, const Eigen::Vector3f& v) noexcept {
    return {q.w(), v.x(), v.y(), v.z()};
  }
};

/// Converts a length of the file to metres; the writer searches for numbers that this converts back to the same bits.
inline float to_metres(float length, double unit) noexcept {
  return static_cast<float>(static_cast<double>(length) * unit);
}

}  // namespace signweave::bvh
