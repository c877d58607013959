#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace signweave::gltf {

enum class Interpolation { step, linear, cubic };

/// The times of keys, shared by curves.
struct KeyTimes {
  std::span<const float> seconds;  ///< [key] ascending
  std::vector<double> frames;  ///< [key] their positions among the motion's frames; filled in when its rate is known
  bool one_a_frame = false;    ///< key i is at frame i
};

/// The keys of one property of one node, as in the file. Borrows its numbers.
struct Curve {
  std::string place;  ///< "animation 0, channel 3"
  Interpolation interpolation = Interpolation::linear;
  std::shared_ptr<KeyTimes> times;
  std::span<const float> values;  ///< [key][part]; cubic: [key][tangent in, value, tangent out][part]
  std::size_t parts = 0;          ///< 3, 4 (x, y, z, w), or as many as a mesh has morph targets

  std::size_t key_count() const { return times->seconds.size(); }
  /// The value at a key.
  std::span<const float> key(std::size_t index) const {
    const std::size_t row = interpolation == Interpolation::cubic ? 3 * index + 1 : index;
    return values.subspan(row * parts, parts);
  }
  /// The tangent that arrives at a key of a cubic curve, or that leaves it; parts per second.
  std::span<const float> tangent(std::size_t index, bool leaving) const {
    return values.subspan((3 * index + (leaving ? 2 : 0)) * parts, parts);
  }
};

/// True if any part of any key differs by more than `most` from the first key's, or a cubic curve does so between keys.
bool changes(const Curve& curve, float most);

/// Evaluates a curve at positions among the motion's frames, fastest if they ascend. Before the first key and after the
/// last, their values hold. Borrows the curve.
class CurveReader {
 public:
  /// `frame_seconds`: the duration of a frame, for the tangents of cubic curves.
  CurveReader(const Curve& curve, double frame_seconds) : curve_(&curve), frame_seconds_(frame_seconds) {}

  /// Returns [part] at a position, not normalized. Valid until the next call.
  std::span<const double> at(double frame);
  /// The same for a rotation, which is interpolated linearly along the shorter arc; unit.
  Eigen::Quaterniond rotation_at(double frame);
  /// The same for a translation or scale.
  Eigen::Vector3d vector_at(double frame);

 private:
  struct Between {
    std::size_t key;  ///< the last one at or before the position, otherwise the first
    double part;      ///< 0 at that key, 1 at the next
  };
  Between between(double frame);

  const Curve* curve_;
  double frame_seconds_;
  std::size_t key_ = 0;
  std::vector<double> values_;
};

/// A unit quaternion from four numbers x, y, z, w; the identity if their norm is zero.
Eigen::Quaterniond unit_rotation(std::span<const float> xyzw);

}  // namespace signweave::gltf
