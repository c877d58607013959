#pragma once

// An evaluator of glTF for tests, in double precision and independent of the reader: tinygltf loads the file, and every
// node's matrix is multiplied out as the specification says.

#include <gtest/gtest.h>
#include <tiny_gltf.h>

#include <Eigen/Geometry>
#include <cmath>
#include <cstring>
#include <functional>
#include <string>
#include <utility>
#include <vector>

namespace signweave::testing_gltf {

class Evaluator {
 public:
  explicit Evaluator(const std::string& glb) {
    std::string error;
    std::string warning;
    tinygltf::TinyGLTF loader;
    const bool done =
        loader.LoadBinaryFromMemory(&model_, &error, &warning, reinterpret_cast<const unsigned char*>(glb.data()),
                                    static_cast<unsigned>(glb.size()));
    EXPECT_TRUE(done) << error;
  }

  const tinygltf::Model& model() const { return model_; }

  /// From now on `moved` gives the second at which a key lies, from the second that the file gives.
  void move_keys(std::function<double(double)> moved) { moved_ = std::move(moved); }

  /// model_from_node of every node, the first animation being at `time` seconds.
  std::vector<Eigen::Matrix4d> globals(double time) const {
    std::vector<Eigen::Matrix4d> locals;
    for (std::size_t node = 0; node < model_.nodes.size(); ++node) locals.push_back(local(node, time));
    std::vector<Eigen::Matrix4d> result(locals.size());
    std::vector<bool> child(locals.size(), false);
    for (const tinygltf::Node& node : model_.nodes) {
      for (const int one : node.children) child[static_cast<std::size_t>(one)] = true;
    }
    for (std::size_t node = 0; node < locals.size(); ++node) {
      if (!child[node]) place(node, Eigen::Matrix4d::Identity(), locals, result);
    }
    return result;
  }

 private:
  void place(std::size_t node, const Eigen::Matrix4d& above, const std::vector<Eigen::Matrix4d>& locals,
             std::vector<Eigen::Matrix4d>& result) const {
    result[node] = above * locals[node];
    for (const int one : model_.nodes[node].children)
      place(static_cast<std::size_t>(one), result[node], locals, result);
  }

  Eigen::Matrix4d local(std::size_t index, double time) const {
    const tinygltf::Node& node = model_.nodes[index];
    if (!node.matrix.empty()) return Eigen::Map<const Eigen::Matrix4d>(node.matrix.data());
    std::vector<double> t = node.translation.empty() ? std::vector<double>{0, 0, 0} : node.translation;
    std::vector<double> r = node.rotation.empty() ? std::vector<double>{0, 0, 0, 1} : node.rotation;
    std::vector<double> s = node.scale.empty() ? std::vector<double>{1, 1, 1} : node.scale;
    for (const tinygltf::AnimationChannel& channel : model_.animations.at(0).channels) {
      if (channel.target_node != static_cast<int>(index)) continue;
      const auto& sampler = model_.animations[0].samplers.at(static_cast<std::size_t>(channel.sampler));
      const bool turns = channel.target_path == "rotation";
      (turns ? r : channel.target_path == "translation" ? t : s) = value(sampler, time, turns);
    }
    const double norm = std::sqrt(r[0] * r[0] + r[1] * r[1] + r[2] * r[2] + r[3] * r[3]);
    const double x = r[0] / norm, y = r[1] / norm, z = r[2] / norm, w = r[3] / norm;
    Eigen::Matrix3d turn;
    turn << 1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w),  //
        2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w),      //
        2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y);
    Eigen::Matrix4d matrix = Eigen::Matrix4d::Identity();
    for (int axis = 0; axis < 3; ++axis) {
      matrix.block<3, 1>(0, axis) = turn.col(axis) * s[static_cast<std::size_t>(axis)];
      matrix(axis, 3) = t[static_cast<std::size_t>(axis)];
    }
    return matrix;
  }

  std::vector<double> element(int accessor_index, std::size_t row) const {
    const tinygltf::Accessor& accessor = model_.accessors.at(static_cast<std::size_t>(accessor_index));
    const tinygltf::BufferView& view = model_.bufferViews.at(static_cast<std::size_t>(accessor.bufferView));
    const auto parts =
        static_cast<std::size_t>(tinygltf::GetNumComponentsInType(static_cast<std::uint32_t>(accessor.type)));
    const bool floats = accessor.componentType == TINYGLTF_COMPONENT_TYPE_FLOAT;
    const std::size_t size = floats ? 4 : 2;
    const std::size_t stride = view.byteStride == 0 ? parts * size : view.byteStride;
    const unsigned char* const at =
        model_.buffers.at(0).data.data() + view.byteOffset + accessor.byteOffset + row * stride;
    std::vector<double> numbers;
    for (std::size_t part = 0; part < parts; ++part) {
      float number = 0;
      std::int16_t whole = 0;
      if (floats) std::memcpy(&number, at + part * size, size);
      if (!floats) std::memcpy(&whole, at + part * size, size);
      numbers.push_back(floats ? static_cast<double>(number) : std::max(whole / 32767.0, -1.0));
    }
    return numbers;
  }

  std::vector<double> value(const tinygltf::AnimationSampler& sampler, double time, bool turns) const {
    const std::size_t count = model_.accessors.at(static_cast<std::size_t>(sampler.input)).count;
    std::size_t next = 0;
    const auto second_of = [&](std::size_t index) { return moved_(element(sampler.input, index)[0]); };
    while (next < count && second_of(next) <= time) ++next;
    const bool cubic = sampler.interpolation == "CUBICSPLINE";
    const auto key = [&](std::size_t index, std::size_t which) {
      return element(sampler.output, cubic ? 3 * index + which : index);
    };
    if (next == 0) return key(0, 1);
    if (next == count || sampler.interpolation == "STEP") return key(next - 1, 1);
    const double before = second_of(next - 1);
    const double distance = second_of(next) - before;
    const double u = (time - before) / distance;
    std::vector<double> a = key(next - 1, 1);
    std::vector<double> b = key(next, 1);
    std::vector<double> result(a.size());
    if (cubic) {
      const std::vector<double> out = key(next - 1, 2);
      const std::vector<double> in = key(next, 0);
      for (std::size_t i = 0; i < a.size(); ++i) {
        result[i] = (2 * u * u * u - 3 * u * u + 1) * a[i] + distance * (u * u * u - 2 * u * u + u) * out[i] +
                    (-2 * u * u * u + 3 * u * u) * b[i] + distance * (u * u * u - u * u) * in[i];
      }
      return result;
    }
    double first = 1 - u;
    double second = u;
    if (turns) {
      double dot = 0, aa = 0, bb = 0;
      for (std::size_t i = 0; i < 4; ++i) {
        dot += a[i] * b[i];
        aa += a[i] * a[i];
        bb += b[i] * b[i];
      }
      for (std::size_t i = 0; i < 4; ++i) {
        a[i] /= std::sqrt(aa);
        b[i] /= (dot < 0 ? -1 : 1) * std::sqrt(bb);
      }
      const double angle = std::acos(std::min(1.0, std::abs(dot) / std::sqrt(aa * bb)));
      if (angle > 1e-6) {
        first = std::sin((1 - u) * angle) / std::sin(angle);
        second = std::sin(u * angle) / std::sin(angle);
      }
    }
    for (std::size_t i = 0; i < a.size(); ++i) result[i] = first * a[i] + second * b[i];
    return result;
  }

  tinygltf::Model model_;
  std::function<double(double)> moved_ = [](double second) { return second; };
};

}  // namespace signweave::testing_gltf
