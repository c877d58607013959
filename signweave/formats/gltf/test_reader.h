#pragma once

// A reader of glTF for tests, independent of the writer: accessors as numbers, sampled animation, nodes in the scene.

#include <gtest/gtest.h>
#include <tiny_gltf.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cstring>
#include <optional>
#include <string>
#include <vector>

#include "signweave/formats/gltf/gltf.h"
#include "signweave/motion/kinematics.h"

namespace signweave::testing_gltf {

using Eigen::Affine3f;
using Eigen::Quaternionf;
using Eigen::Vector3f;

inline tinygltf::Model loaded(const std::string& bytes, bool binary = true) {
  tinygltf::Model model;
  std::string error;
  std::string warning;
  tinygltf::TinyGLTF loader;
  const bool done =
      binary
          ? loader.LoadBinaryFromMemory(&model, &error, &warning, reinterpret_cast<const unsigned char*>(bytes.data()),
                                        static_cast<unsigned>(bytes.size()))
          : loader.LoadASCIIFromString(&model, &error, &warning, bytes.data(), static_cast<unsigned>(bytes.size()), "");
  EXPECT_TRUE(done) << error;
  EXPECT_EQ(warning, "");
  return model;
}

inline tinygltf::Model written(const Motion& motion, const gltf::WriteOptions& options = {}) {
  return loaded(gltf::to_bytes(motion, options, gltf::Container::binary));
}

/// The elements of an accessor as numbers.
inline std::vector<std::vector<float>> elements(const tinygltf::Model& model, int index) {
  const tinygltf::Accessor& accessor = model.accessors.at(static_cast<std::size_t>(index));
  const tinygltf::BufferView& view = model.bufferViews.at(static_cast<std::size_t>(accessor.bufferView));
  const unsigned char* data = model.buffers.at(0).data.data() + view.byteOffset + accessor.byteOffset;
  const auto parts =
      static_cast<std::size_t>(tinygltf::GetNumComponentsInType(static_cast<std::uint32_t>(accessor.type)));
  const auto size =
      static_cast<std::size_t>(tinygltf::GetComponentSizeInBytes(static_cast<std::uint32_t>(accessor.componentType)));
  EXPECT_LE(accessor.count * parts * size, view.byteLength);
  std::vector<std::vector<float>> rows(accessor.count, std::vector<float>(parts));
  for (std::size_t i = 0; i < accessor.count * parts; ++i) {
    float value = 0;
    if (accessor.componentType == TINYGLTF_COMPONENT_TYPE_FLOAT) {
      std::memcpy(&value, data + i * 4, 4);
    } else if (accessor.componentType == TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE) {
      value = static_cast<float>(data[i]) / (accessor.normalized ? 255.0f : 1.0f);
    } else if (accessor.componentType == TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT) {
      value = static_cast<float>(data[2 * i] + 256 * data[2 * i + 1]);
    } else {
      ADD_FAILURE() << "component type " << accessor.componentType;
    }
    rows[i / parts][i % parts] = value;
  }
  return rows;
}

/// The value of a sampler at a time: linear between keys, held before and after. Rotations are not normalised.
inline std::vector<float> sampled(const tinygltf::Model& model, const tinygltf::AnimationSampler& sampler, float time) {
  EXPECT_EQ(sampler.interpolation, "LINEAR");
  const auto times = elements(model, sampler.input);
  const auto keys = elements(model, sampler.output);
  const std::size_t width = keys.size() / times.size();  // morph weights have several per key
  std::size_t after = 0;
  while (after < times.size() && times[after][0] <= time) ++after;
  const std::size_t before = after == 0 ? 0 : after - 1;
  after = std::min(after, times.size() - 1);
  const float span = times[after][0] - times[before][0];
  const float part = span > 0 ? (time - times[before][0]) / span : 0;
  std::vector<float> value;
  for (std::size_t k = 0; k < width; ++k) {
    for (std::size_t i = 0; i < keys[0].size(); ++i) {
      value.push_back(keys[before * width + k][i] * (1 - part) + keys[after * width + k][i] * part);
    }
  }
  return value;
}

inline Vector3f vector_of(const std::vector<double>& v) {
  return v.empty() ? Vector3f(0, 0, 0) : Vector3f(Eigen::Vector3d(v[0], v[1], v[2]).cast<float>());
}

/// The transform of each node in the scene, with the animation at a time or without it.
inline std::vector<Affine3f> globals(const tinygltf::Model& model, std::optional<float> time) {
  std::vector<Affine3f> locals;
  for (const tinygltf::Node& node : model.nodes) {
    EXPECT_TRUE(node.rotation.empty() && node.scale.empty() && node.matrix.empty());
    locals.push_back(Affine3f(Eigen::Translation3f(vector_of(node.translation))));
  }
  if (time) {
    for (const tinygltf::AnimationChannel& channel : model.animations.at(0).channels) {
      const auto& sampler = model.animations[0].samplers.at(static_cast<std::size_t>(channel.sampler));
      const std::vector<float> value = sampled(model, sampler, *time);
      Affine3f& local = locals[static_cast<std::size_t>(channel.target_node)];
      if (channel.target_path == "rotation") {
        local.linear() = Quaternionf(value[3], value[0], value[1], value[2]).normalized().toRotationMatrix();
      } else if (channel.target_path == "translation") {
        local.translation() = Vector3f(value[0], value[1], value[2]);
      }
    }
  }
  std::vector<Affine3f> result(model.nodes.size(), Affine3f::Identity());
  std::vector<int> open(model.scenes.at(0).nodes);
  for (const int root : open) result[static_cast<std::size_t>(root)] = locals[static_cast<std::size_t>(root)];
  while (!open.empty()) {
    const auto node = static_cast<std::size_t>(open.back());
    open.pop_back();
    for (const int child : model.nodes[node].children) {
      result[static_cast<std::size_t>(child)] = result[node] * locals[static_cast<std::size_t>(child)];
      open.push_back(child);
    }
  }
  return result;
}

inline float time_of(const Motion& motion, std::int64_t frame) {
  return static_cast<float>(static_cast<double>(frame) * motion.rate().frame_time().count());
}

/// The largest distance at a frame between a joint or tip and its position by forward kinematics.
inline float farthest(const Motion& motion, const tinygltf::Model& model, std::int64_t frame) {
  const ModelPose pose = to_model_space(motion.skeleton(), motion.pose(frame));
  const std::vector<Affine3f> nodes = globals(model, time_of(motion, frame));
  const std::size_t joints = motion.skeleton().joint_count();
  float distance = 0;
  for (std::size_t joint = 0; joint < joints; ++joint) {
    distance = std::max(distance, (nodes[joint].translation() - pose.positions[joint]).norm());
  }
  for (std::size_t i = 0; i < motion.skeleton().tips().size(); ++i) {
    const Vector3f place = position_of(motion.skeleton().tips()[i], pose);
    distance = std::max(distance, (nodes[joints + i].translation() - place).norm());
  }
  return distance;
}

inline const tinygltf::AnimationChannel* channel_of(const tinygltf::Model& model, int node, const std::string& path) {
  for (const auto& channel : model.animations.at(0).channels) {
    if (channel.target_node == node && channel.target_path == path) return &channel;
  }
  return nullptr;
}

inline std::size_t keys_of(const tinygltf::Model& model, const tinygltf::AnimationChannel& channel) {
  const auto& sampler = model.animations[0].samplers[static_cast<std::size_t>(channel.sampler)];
  return model.accessors[static_cast<std::size_t>(sampler.output)].count;
}

}  // namespace signweave::testing_gltf
