#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

// The library's namespace, declared here so that other files need not include its long header.
#include <tiny_gltf.h>

#include "signweave/core/time.h"

namespace signweave::gltf {

/// A glTF model under construction: numbers are appended to its one buffer, each list with its own view and accessor,
/// four-byte aligned. Every function returns the accessor's index.
class Document {
 public:
  /// Holds at most `most_bytes` of numbers: a call that would exceed it throws Error{unsupported} with the text
  /// `too_large`.
  Document(std::size_t most_bytes, std::string too_large);

  /// One number each; with bounds if they are the times of an animation.
  int scalars(std::span<const float> values, bool with_bounds = false);
  struct VectorUse {
    bool vertices = false;  ///< vertex attributes rather than keys
    bool with_bounds = false;
  };
  /// Vertex attributes (positions and targets have bounds, normals have none), or the keys of an animation.
  int vectors(std::span<const Eigen::Vector3f> values, VectorUse use);
  /// Keys of rotations: x, y, z, w.
  int quaternions(std::span<const Eigen::Vector4f> values);
  int matrices(std::span<const Eigen::Matrix4f> values);
  /// JOINTS_0: each vertex moves with one joint.
  int joints(std::span<const int> values);
  /// The WEIGHTS_0 that go with it: all weight on the first joint.
  int full_weights(std::size_t count);
  int indices(std::span<const std::uint32_t> values);

  tinygltf::Model& model() { return model_; }
  const tinygltf::Model& model() const { return model_; }

 private:
  int add(const void* bytes, std::size_t size, std::size_t count, int component, int type, int target);
  template <typename T>
  int add_list(std::span<const T> values, std::size_t count, int component, int type, int target) {
    return add(values.data(), values.size_bytes(), count, component, type, target);
  }

  tinygltf::Model model_;
  std::size_t most_bytes_;
  std::string too_large_;
};

/// The time of each frame, in seconds. Throws Error{unsupported} if two are equal: glTF's times are floats and must
/// increase.
std::vector<float> key_times(FrameRate rate, std::int64_t frames);

}  // namespace signweave::gltf
