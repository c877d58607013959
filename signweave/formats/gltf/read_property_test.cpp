#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <nlohmann/json.hpp>
#include <numbers>

#include "signweave/formats/gltf/gltf.h"
#include "signweave/formats/gltf/read.h"
#include "signweave/formats/gltf/test_evaluator.h"
#include "signweave/motion/kinematics.h"

namespace signweave::gltf {
namespace {

using Eigen::Quaternionf;
using Eigen::Vector3f;
using nlohmann::ordered_json;

float number(float most = 1) {
  return most * static_cast<float>(*rc::gen::inRange(-10'000, 10'001)) / 10'000;
}

std::vector<float> random_turn() {
  Eigen::Vector4f q(number(), number(), number(), number());
  if (q.norm() < 0.1f) q = Eigen::Vector4f(0, 0, 0, 1);
  q.normalize();
  return {q.x(), q.y(), q.z(), q.w()};
}

/// A glTF file of random nodes and curves.
class RandomFile {
 public:
  std::string make() {
    add_nodes();
    json_["asset"]["version"] = "2.0";
    json_["animations"] = {{{"channels", ordered_json::array()}, {"samplers", ordered_json::array()}}};
    const int lists = *rc::gen::inRange(1, 4);
    for (int i = 0; i < lists; ++i) add_times();
    for (std::size_t node = 0; node < json_["nodes"].size(); ++node) {
      const bool fixed = json_["nodes"][node].contains("matrix");
      if (fixed) continue;
      if (node == helpers_ || *rc::gen::inRange(0, 4) > 0) add_channel(node, "rotation");
      if (*rc::gen::inRange(0, 3) == 0) add_channel(node, "translation");
      if (node == helpers_ && *rc::gen::inRange(0, 3) == 0) add_channel(node, "scale");
    }
    json_["buffers"] = {{{"byteLength", bytes_.size()}}};
    return glb();
  }

 private:
  /// Adds a chain of helpers, then a tree; the skin determines which nodes are joints.
  void add_nodes() {
    helpers_ = static_cast<std::size_t>(*rc::gen::inRange(0, 3));
    const auto count = helpers_ + static_cast<std::size_t>(*rc::gen::inRange(1, 12));
    ordered_json joints = ordered_json::array();
    for (std::size_t i = 0; i < count; ++i) {
      ordered_json node = {{"name", "n" + std::to_string(i)}};
      const float scale = *rc::gen::element(1.0f, 1.0f, 0.5f, 1.25f, -1.0f);
      const std::vector<float> q = random_turn();
      const std::vector<float> t = {number(), number(), number()};
      if (*rc::gen::inRange(0, 4) == 0) {
        const Eigen::Affine3f matrix =
            Eigen::Translation3f(t[0], t[1], t[2]) * Quaternionf(q[3], q[0], q[1], q[2]) * Eigen::Scaling(scale);
        node["matrix"] = std::vector<float>(matrix.data(), matrix.data() + 16);
      } else {
        node["translation"] = t;
        node["rotation"] = q;
        if (scale != 1) node["scale"] = {scale, scale, scale};
      }
      if (i > 0) {
        const std::size_t parent =
            i <= helpers_
                ? i - 1
                : helpers_ + static_cast<std::size_t>(*rc::gen::inRange<int>(0, static_cast<int>(i - helpers_)));
        json_["nodes"][parent]["children"].push_back(i);
      }
      if (i >= helpers_) joints.push_back(i);
      json_["nodes"].push_back(std::move(node));
    }
    json_["skins"] = {{{"joints", joints}}};
  }

  /// Times at a standard rate with or without gaps, or at arbitrary milliseconds.
  void add_times() {
    const int count = *rc::gen::inRange(1, 8);
    const bool even = *rc::gen::inRange(0, 3) > 0;
    const float rate = *rc::gen::element(24.0f, 25.0f, 30.0f, 60.0f);
    std::vector<float> times;
    int at = *rc::gen::inRange(0, 3);
    for (int i = 0; i < count; ++i) {
      times.push_back(even ? static_cast<float>(at) / rate : static_cast<float>(at) / 1000);
      at += even ? *rc::gen::inRange(1, 4) : *rc::gen::inRange(5, 300);
    }
    times_.push_back(accessor(times, 1, "SCALAR"));
    key_counts_.push_back(times.size());
  }

  void add_channel(std::size_t node, const char* path) {
    const bool turns = path[0] == 'r';
    const auto list = static_cast<std::size_t>(*rc::gen::inRange<int>(0, static_cast<int>(times_.size())));
    const std::string interpolation = *rc::gen::element<std::string>("LINEAR", "STEP", "CUBICSPLINE");
    const bool cubic = interpolation == "CUBICSPLINE";
    std::vector<float> values;
    for (std::size_t key = 0; key < key_counts_[list] * (cubic ? 3 : 1); ++key) {
      std::vector<float> value = {number(), number(), number()};
      // In steps too large to be mistaken for rounding.
      if (path[0] == 's')
        value.assign(3, (cubic && key % 3 != 1 ? 0.0f : 1.0f) + 0.05f * static_cast<float>(*rc::gen::inRange(-10, 11)));
      if (turns) value = random_turn();
      // Tangents that do not lead a quaternion through zero.
      if (cubic && key % 3 != 1) {
        for (float& one : value) one *= 0.1f;
      }
      if (turns && cubic && key % 3 == 1) value = {value[0] * 0.3f, value[1] * 0.3f, value[2] * 0.3f, 0.9f};
      values.insert(values.end(), value.begin(), value.end());
    }
    ordered_json& animation = json_["animations"][0];
    const std::size_t sampler = animation["samplers"].size();
    animation["samplers"].push_back({{"input", times_[list]},
                                     {"output", accessor(values, turns ? 4 : 3, turns ? "VEC4" : "VEC3")},
                                     {"interpolation", interpolation}});
    animation["channels"].push_back({{"sampler", sampler}, {"target", {{"node", node}, {"path", path}}}});
  }

  std::size_t accessor(const std::vector<float>& values, std::size_t parts, const char* type) {
    json_["bufferViews"].push_back({{"buffer", 0}, {"byteOffset", bytes_.size()}, {"byteLength", values.size() * 4}});
    bytes_.append(reinterpret_cast<const char*>(values.data()), values.size() * 4);
    json_["accessors"].push_back({{"bufferView", json_["bufferViews"].size() - 1},
                                  {"componentType", 5126},
                                  {"count", values.size() / parts},
                                  {"type", type}});
    return json_["accessors"].size() - 1;
  }

  std::string glb() const {
    std::string text = json_.dump();
    text.resize((text.size() + 3) / 4 * 4, ' ');
    std::string out = "glTF";
    const auto add = [&](std::size_t value) {
      const auto narrow = static_cast<std::uint32_t>(value);
      out.append(reinterpret_cast<const char*>(&narrow), 4);
    };
    add(2);
    add(28 + text.size() + bytes_.size());
    add(text.size());
    out += "JSON" + text;
    add(bytes_.size());
    out.append("BIN\0", 4);
    return out + bytes_;
  }

  ordered_json json_;
  std::string bytes_;
  std::vector<std::size_t> times_;
  std::vector<std::size_t> key_counts_;
  std::size_t helpers_ = 0;
};

double degrees_between(const Eigen::Quaterniond& a, const Eigen::Quaterniond& b) {
  const Eigen::Quaterniond off = a.conjugate() * b;
  return 2 * std::atan2(off.vec().norm(), std::abs(off.w())) * 180 / std::numbers::pi;
}

std::vector<float> numbers_of(const tinygltf::Model& model, int accessor_index) {
  const auto& accessor = model.accessors[static_cast<std::size_t>(accessor_index)];
  const auto& view = model.bufferViews[static_cast<std::size_t>(accessor.bufferView)];
  std::vector<float> numbers(view.byteLength / 4);
  std::memcpy(numbers.data(), model.buffers[0].data.data() + view.byteOffset, view.byteLength);
  return numbers;
}

/// Whether a scale, the same along all axes, changes.
bool grows(const tinygltf::Model& model, const tinygltf::AnimationSampler& sampler) {
  const bool cubic = sampler.interpolation == "CUBICSPLINE";
  const std::vector<float> scales = numbers_of(model, sampler.output);
  if (numbers_of(model, sampler.input).size() < 2) return false;
  for (std::size_t at = 0; at < scales.size(); at += 3) {
    const bool tangent = cubic && at / 3 % 3 != 1;
    if (scales[at] != (tangent ? 0 : scales[cubic ? 3 : 0])) return true;
  }
  return false;
}

/// The times of all keys of curves that move a joint, ascending. A scale moves joints if it changes and other joints
/// are below.
std::vector<double> keys_of_joints(const tinygltf::Model& model, const Motion& motion) {
  std::vector<double> keys;
  for (const tinygltf::AnimationChannel& channel : model.animations[0].channels) {
    const tinygltf::Node& node = model.nodes[static_cast<std::size_t>(channel.target_node)];
    if (!motion.skeleton().find(node.name)) continue;
    const auto& sampler = model.animations[0].samplers[static_cast<std::size_t>(channel.sampler)];
    if (channel.target_path == "scale" && (node.children.empty() || !grows(model, sampler))) continue;
    for (const float time : numbers_of(model, sampler.input)) keys.push_back(static_cast<double>(time));
  }
  std::sort(keys.begin(), keys.end());
  return keys;
}

/// Whether the reader would treat a key as being at a frame although it is only close to one. A steep curve, or a step,
/// then has a different value in that frame.
bool is_any_key_moved(const std::vector<double>& keys, double start, double hertz) {
  return std::ranges::any_of(keys, [&](double key) {
    const double frame = (key - start) * hertz;
    const double off = std::abs(frame - std::round(frame));
    return off > 1e-6 * hertz && off < 2e-3;
  });
}

// Compares position and rotation of each joint, for a random tree with scales, matrices, helpers and curves of all
// kinds.
RC_GTEST_PROP(GltfReadProperty, KinematicsAreThoseOfAnIndependentEvaluator, ()) {
  const std::string bytes = RandomFile().make();
  testing_gltf::Evaluator evaluator(bytes);
  ReadOptions options;
  if (*rc::gen::inRange(0, 4) == 0) options.rate = FrameRate{97, 1};
  const ReadFile file = read_bytes("random", bytes, {}, options);
  const std::vector<double> keys = keys_of_joints(evaluator.model(), file.motion);
  const double start = keys.empty() ? 0 : keys.front();
  const double hertz = file.motion.rate().hertz();
  RC_PRE(!is_any_key_moved(keys, start, hertz));
  const auto time_of = [&](double frame) { return start + frame / hertz; };
  // A key that differs from a frame only by a float's rounding is at that frame: with a step or a steep curve the
  // difference matters.
  evaluator.move_keys([&](double second) {
    const double frame = std::round((second - start) * hertz);
    return std::abs(second - time_of(frame)) < 1e-6 ? time_of(frame) : second;
  });
  for (std::int64_t frame = 0; frame < file.motion.frame_count(); ++frame) {
    const std::vector<Eigen::Matrix4d> nodes = evaluator.globals(time_of(static_cast<double>(frame)));
    const ModelPose pose = to_model_space(file.motion.skeleton(), file.motion.pose(frame));
    for (std::size_t node = 0; node < nodes.size(); ++node) {
      const auto joint = file.motion.skeleton().find(evaluator.model().nodes[node].name);
      if (!joint) continue;
      const auto index = static_cast<std::size_t>(*joint);
      const Eigen::Vector3d place = nodes[node].topRightCorner<3, 1>();
      const double off = (pose.positions[index].cast<double>() - place).norm();
      if (!(off < 1e-5))
        RC_FAIL("node " + std::to_string(node) + " in frame " + std::to_string(frame) + " is off by " +
                std::to_string(off) + " m");
      Eigen::Matrix3d turn = nodes[node].topLeftCorner<3, 3>();
      turn /= std::cbrt(turn.determinant());
      const double degrees = degrees_between(pose.rotations[index].cast<double>(), Eigen::Quaterniond(turn));
      if (!(degrees < 0.01))
        RC_FAIL("node " + std::to_string(node) + " in frame " + std::to_string(frame) + " is off by " +
                std::to_string(degrees) + " degrees");
    }
  }
}

Motion random_motion() {
  const int count = *rc::gen::inRange(1, 20);
  std::vector<Joint> joints;
  std::vector<Tip> tips;
  for (int i = 0; i < count; ++i) {
    joints.push_back({.name = (i % 2 == 0 ? "Arm " : "d\xC3\xA9j\xC3\xA0:") + std::to_string(i),
                      .parent = i == 0 ? kNoJoint : *rc::gen::inRange(0, i),
                      .offset = {number(), number(), number()},
                      .translated = i == 0 || *rc::gen::inRange(0, 4) == 0});
    if (*rc::gen::inRange(0, 3) == 0) tips.push_back({i, {number(), number(), number()}});
  }
  const FrameRate rate = *rc::gen::element(FrameRate{30, 1}, FrameRate{100, 1}, FrameRate{30'000, 1'001},
                                           FrameRate{37, 1}, FrameRate{25, 2}, FrameRate{1'000, 1}, FrameRate{5, 1});
  Motion motion(std::make_shared<const Skeleton>(joints, tips), rate, *rc::gen::inRange(2, 40));
  for (std::int64_t frame = 0; frame < motion.frame_count(); ++frame) {
    const MutablePoseView pose = motion.pose(frame);
    for (Quaternionf& rotation : pose.rotations) {
      if (*rc::gen::inRange(0, 3) == 0) continue;
      const std::vector<float> q = random_turn();
      rotation = Quaternionf(q[3], q[0], q[1], q[2]);
    }
    for (Vector3f& translation : pose.translations) translation = {number(), number(), number()};
  }
  // So that the keys determine the rate.
  motion.pose(0).rotations[0] = Quaternionf(1, 0, 0, 0);
  motion.pose(1).rotations[0] = Quaternionf(0, 1, 0, 0);
  keep_hemisphere(motion);
  for (const char* const name : {"gaze", "jawOpen"}) {
    if (*rc::gen::inRange(0, 2) == 0) continue;
    ScalarTrack track{.name = name, .values = {}};
    for (std::int64_t frame = 0; frame < motion.frame_count(); ++frame) track.values.push_back(number());
    motion.add_track(std::move(track));
  }
  return motion;
}

// What our own writer wrote is read back: skeleton, rate, poses, tips, tracks.
RC_GTEST_PROP(GltfReadProperty, WhatWasWrittenComesBack, ()) {
  const Motion motion = random_motion();
  const Container container = *rc::gen::element(Container::binary, Container::text);
  const ReadFile file = read_bytes("written", to_bytes(motion, {.name = "said"}, container), {});
  const Motion& back = file.motion;
  RC_ASSERT(file.take == "said");
  RC_ASSERT(back.rate() == motion.rate());
  RC_ASSERT(back.frame_count() == motion.frame_count());
  const Skeleton& skeleton = motion.skeleton();
  RC_ASSERT(back.skeleton().joint_count() == skeleton.joint_count());
  for (std::size_t i = 0; i < skeleton.joint_count(); ++i) {
    RC_ASSERT(back.skeleton().joints()[i].name == skeleton.joints()[i].name);
    RC_ASSERT(back.skeleton().joints()[i].parent == skeleton.joints()[i].parent);
  }
  RC_ASSERT(back.skeleton().tips().size() == skeleton.tips().size());
  for (std::size_t i = 0; i < skeleton.tips().size(); ++i) RC_ASSERT(back.skeleton().tips()[i] == skeleton.tips()[i]);
  for (std::int64_t frame = 0; frame < motion.frame_count(); ++frame) {
    for (std::size_t joint = 0; joint < skeleton.joint_count(); ++joint) {
      const Quaternionf a = motion.pose(frame).rotations[joint];
      const Quaternionf b = back.pose(frame).rotations[joint];
      RC_ASSERT((a.conjugate() * b).vec().norm() * 2 < 1e-5f);
      const auto index = static_cast<JointIndex>(joint);
      const auto place = [&](const Motion& of) {
        const auto moved = of.skeleton().translation_of(index);
        return moved ? of.pose(frame).translations[*moved] : of.skeleton().joint(index).offset;
      };
      RC_ASSERT((place(motion) - place(back)).norm() < 1e-6f);
    }
  }
  RC_ASSERT(back.tracks().size() == motion.tracks().size());
  for (const ScalarTrack& track : motion.tracks()) {
    RC_ASSERT(std::ranges::find(back.tracks(), track) != back.tracks().end());
  }
}

}  // namespace
}  // namespace signweave::gltf
