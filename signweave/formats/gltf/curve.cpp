#include "signweave/formats/gltf/curve.h"

#include <algorithm>
#include <cmath>

namespace signweave::gltf {
namespace {

Eigen::Quaterniond normalised(const Eigen::Quaterniond& q) {
  const double norm = q.norm();
  return norm > 1e-12 ? Eigen::Quaterniond(q.coeffs() / norm) : Eigen::Quaterniond::Identity();
}

}  // namespace

Eigen::Quaterniond unit_rotation(std::span<const float> xyzw) {
  return normalised(Eigen::Quaterniond(xyzw[3], xyzw[0], xyzw[1], xyzw[2]));
}

bool changes(const Curve& curve, float most) {
  const std::span<const float> first = curve.key(0);
  const std::size_t keys = curve.key_count();
  for (std::size_t key = 1; key < keys; ++key) {
    const std::span<const float> value = curve.key(key);
    for (std::size_t i = 0; i < curve.parts; ++i) {
      if (!(std::abs(value[i] - first[i]) <= most)) return true;
    }
  }
  if (curve.interpolation != Interpolation::cubic || keys < 2) return false;
  for (std::size_t key = 0; key < keys; ++key) {
    for (std::size_t i = 0; i < curve.parts; ++i) {
      if (curve.tangent(key, false)[i] != 0 || curve.tangent(key, true)[i] != 0) return true;
    }
  }
  return false;
}

CurveReader::Between CurveReader::between(double frame) {
  const std::vector<double>& keys = curve_->times->frames;
  if (frame < keys[key_]) {  // backwards, or before the first
    const auto after = std::upper_bound(keys.begin(), keys.end(), frame);
    key_ = after == keys.begin() ? 0 : static_cast<std::size_t>(after - keys.begin()) - 1;
  }
  for (int steps = 0; key_ + 1 < keys.size() && keys[key_ + 1] <= frame; ++steps) {
    if (steps < 8) {
      ++key_;
    } else {  // far ahead
      key_ = static_cast<std::size_t>(std::upper_bound(keys.begin(), keys.end(), frame) - keys.begin()) - 1;
    }
  }
  if (frame <= keys[key_] || key_ + 1 == keys.size()) return {key_, 0};
  return {key_, (frame - keys[key_]) / (keys[key_ + 1] - keys[key_])};
}

std::span<const double> CurveReader::at(double frame) {
  const auto [key, part] = between(frame);
  values_.resize(curve_->parts);
  const std::span<const float> first = curve_->key(key);
  if (part == 0 || curve_->interpolation == Interpolation::step) {
    std::copy(first.begin(), first.end(), values_.begin());
    return values_;
  }
  const std::span<const float> second = curve_->key(key + 1);
  if (curve_->interpolation == Interpolation::linear) {
    for (std::size_t i = 0; i < values_.size(); ++i) {
      values_[i] = (1 - part) * static_cast<double>(first[i]) + part * static_cast<double>(second[i]);
    }
    return values_;
  }
  const double seconds = (curve_->times->frames[key + 1] - curve_->times->frames[key]) * frame_seconds_;
  const std::span<const float> leaving = curve_->tangent(key, true);
  const std::span<const float> arriving = curve_->tangent(key + 1, false);
  const double t = part;
  const double t2 = t * t;
  const double t3 = t2 * t;
  for (std::size_t i = 0; i < values_.size(); ++i) {
    values_[i] = (2 * t3 - 3 * t2 + 1) * static_cast<double>(first[i]) +
                 seconds * (t3 - 2 * t2 + t) * static_cast<double>(leaving[i]) +
                 (3 * t2 - 2 * t3) * static_cast<double>(second[i]) +
                 seconds * (t3 - t2) * static_cast<double>(arriving[i]);
  }
  return values_;
}

Eigen::Quaterniond CurveReader::rotation_at(double frame) {
  const auto [key, part] = between(frame);
  if (part != 0 && curve_->interpolation == Interpolation::linear) {
    return normalised(unit_rotation(curve_->key(key)).slerp(part, unit_rotation(curve_->key(key + 1))));
  }
  const std::span<const double> value = at(frame);
  return normalised(Eigen::Quaterniond(value[3], value[0], value[1], value[2]));
}

Eigen::Vector3d CurveReader::vector_at(double frame) {
  const std::span<const double> value = at(frame);
  return {value[0], value[1], value[2]};
}

}  // namespace signweave::gltf
