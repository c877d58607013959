#include "signweave/formats/gltf.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>
#include <tiny_gltf.h>

#include <cmath>
#include <cstring>
#include <fstream>
#include <limits>
#include <set>

#include "signweave/core/atomic_file.h"
#include "signweave/core/error.h"
#include "signweave/formats/gltf_document.h"
#include "signweave/formats/test_person.h"
#include "signweave/motion/kinematics.h"

namespace signweave {
namespace {

using Eigen::Affine3f;
using Eigen::Quaternionf;
using Eigen::Vector3f;
using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

tinygltf::Model loaded(const std::string& bytes, bool binary = true) {
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

tinygltf::Model written(const Motion& motion, const gltf::WriteOptions& options = {}) {
  return loaded(gltf::to_bytes(motion, options, gltf::Container::binary));
}

/// What an accessor's elements hold, as numbers.
std::vector<std::vector<float>> elements(const tinygltf::Model& model, int index) {
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
std::vector<float> sampled(const tinygltf::Model& model, const tinygltf::AnimationSampler& sampler, float time) {
  EXPECT_EQ(sampler.interpolation, "LINEAR");
  const auto times = elements(model, sampler.input);
  const auto keys = elements(model, sampler.output);
  const std::size_t width = keys.size() / times.size();  // morph weights have several a key
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

Vector3f vector_of(const std::vector<double>& v) {
  return v.empty() ? Vector3f(0, 0, 0) : Vector3f(Eigen::Vector3d(v[0], v[1], v[2]).cast<float>());
}

/// Where each node is in the scene; with the animation at a time, or without.
std::vector<Affine3f> globals(const tinygltf::Model& model, std::optional<float> time) {
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

float time_of(const Motion& motion, std::int64_t frame) {
  return static_cast<float>(static_cast<double>(frame) * motion.rate().frame_time().count());
}

/// The farthest that a joint or tip is from where forward kinematics puts it, at a frame.
float farthest(const Motion& motion, const tinygltf::Model& model, std::int64_t frame) {
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

const tinygltf::AnimationChannel* channel_of(const tinygltf::Model& model, int node, const std::string& path) {
  for (const auto& channel : model.animations.at(0).channels) {
    if (channel.target_node == node && channel.target_path == path) return &channel;
  }
  return nullptr;
}

std::size_t keys_of(const tinygltf::Model& model, const tinygltf::AnimationChannel& channel) {
  const auto& sampler = model.animations[0].samplers[static_cast<std::size_t>(channel.sampler)];
  return model.accessors[static_cast<std::size_t>(sampler.output)].count;
}

std::string error_of(const Motion& motion, gltf::Container container = gltf::Container::binary) {
  try {
    gltf::to_bytes(motion, {}, container);
  } catch (const Error& error) {
    return error.what();
  }
  return "no error";
}

TEST(Gltf, JointsAndTipsAreNodesUnderOneThatIsNamedLikeTheMotion) {
  const Motion motion = moving_person(4);
  const tinygltf::Model model = written(motion, {.name = "meteo", .declarations = {}, .head = {}});
  const Skeleton& skeleton = motion.skeleton();
  std::set<std::string> names;
  for (const tinygltf::Node& node : model.nodes) EXPECT_TRUE(names.insert(node.name).second) << node.name << " twice";
  EXPECT_EQ(model.nodes[0].name, "Hips");
  EXPECT_TRUE(names.contains("LeftFinger") && names.contains("LeftFinger 8")) << "eight of one name";
  EXPECT_TRUE(names.contains("Head tip"));
  for (JointIndex joint = 1; joint < static_cast<JointIndex>(skeleton.joint_count()); ++joint) {
    const auto parent = static_cast<std::size_t>(skeleton.joint(joint).parent);
    EXPECT_THAT(model.nodes[parent].children, Contains(joint));
  }
  const auto top = static_cast<std::size_t>(model.scenes[0].nodes[0]);
  EXPECT_EQ(model.nodes[top].name, "meteo");
  EXPECT_THAT(model.nodes[top].children, ElementsAre(0));
  EXPECT_EQ(model.animations[0].name, "meteo");
}

TEST(Gltf, NodesStandWhereTheJointsDo) {
  const Motion motion = moving_person(30);
  const tinygltf::Model model = written(motion);
  for (const std::int64_t frame : {0, 1, 13, 29}) EXPECT_LT(farthest(motion, model, frame), 1e-5f) << "frame " << frame;
}

RC_GTEST_PROP(GltfProperty, NodesStandWhereTheJointsDo, ()) {
  const int count = *rc::gen::inRange(1, 40);
  const std::int64_t frames = *rc::gen::inRange(1, 6);
  const auto number = [] { return static_cast<float>(*rc::gen::inRange(-1000, 1000)) / 1000; };
  std::vector<Joint> joints;
  std::vector<Tip> tips;
  for (int i = 0; i < count; ++i) {
    joints.push_back({.name = *rc::gen::element<std::string>("Head", "", "Arm", "d\xC3\xA9j\xC3\xA0", "\xFF", "a b"),
                      .parent = i == 0 ? kNoJoint : *rc::gen::inRange(0, i),
                      .offset = {number(), number(), number()},
                      .translated = i == 0 || *rc::gen::inRange(0, 4) == 0});
    if (*rc::gen::inRange(0, 3) == 0) tips.push_back({i, {number(), number(), number()}});
  }
  Motion motion(std::make_shared<const Skeleton>(joints, tips), {30'000, 1'001}, frames);
  for (std::int64_t frame = 0; frame < frames; ++frame) {
    for (Quaternionf& rotation : motion.pose(frame).rotations) {
      if (*rc::gen::inRange(0, 3) == 0) continue;
      rotation = Quaternionf(number(), number(), number(), number() + 0.0005f).normalized();
    }
    for (Vector3f& translation : motion.pose(frame).translations) translation = {number(), number(), number()};
  }
  if (*rc::gen::inRange(0, 2) == 0) {
    motion.add_track({"jawOpen", std::vector<float>(static_cast<std::size_t>(frames), number())});
    motion.add_track({"other", std::vector<float>(static_cast<std::size_t>(frames), number())});
  }
  const tinygltf::Model model = written(motion);
  for (std::int64_t frame = 0; frame < frames; ++frame) RC_ASSERT(farthest(motion, model, frame) < 1e-4f);
}

TEST(Gltf, TimesAreFramesOverRateAndSharedByAll) {
  Motion motion = moving_person(50);
  const tinygltf::Model model = written(motion);
  std::set<int> inputs;
  for (const auto& sampler : model.animations[0].samplers) inputs.insert(sampler.input);
  ASSERT_EQ(inputs.size(), 1u);
  const auto times = elements(model, *inputs.begin());
  ASSERT_EQ(times.size(), 50u);
  EXPECT_EQ(times[49][0], 0.49f);
  EXPECT_EQ(channel_of(model, 0, "translation") != nullptr, true);
}

TEST(Gltf, BoundsAreThoseOfTheNumbers) {
  Motion motion = moving_person(10);
  motion.add_track({"jawOpen", std::vector<float>(10, 0.5f)});
  const tinygltf::Model model = written(motion);
  int bounded = 0;
  for (std::size_t i = 0; i < model.accessors.size(); ++i) {
    const tinygltf::Accessor& accessor = model.accessors[i];
    if (accessor.minValues.empty()) continue;
    ++bounded;
    const auto rows = elements(model, static_cast<int>(i));
    for (std::size_t part = 0; part < rows[0].size(); ++part) {
      float low = rows[0][part];
      float high = low;
      for (const auto& row : rows) {
        low = std::min(low, row[part]);
        high = std::max(high, row[part]);
      }
      EXPECT_EQ(accessor.minValues[part], low);
      EXPECT_EQ(accessor.maxValues[part], high);
    }
  }
  EXPECT_EQ(bounded, 4) << "body, face, its target, times";
}

TEST(Gltf, NeighbouringRotationsLieInOneHemisphereAtUnitLength) {
  Motion motion = moving_person(12);
  for (std::int64_t frame = 1; frame < 12; frame += 2) {
    for (Quaternionf& rotation : motion.pose(frame).rotations) rotation.coeffs() *= -1.001f;  // the same rotation
  }
  const tinygltf::Model model = written(motion);
  for (const auto& channel : model.animations[0].channels) {
    if (channel.target_path != "rotation") continue;
    const auto keys = elements(model, model.animations[0].samplers[static_cast<std::size_t>(channel.sampler)].output);
    ASSERT_EQ(keys.size(), 12u);
    for (std::size_t i = 0; i < keys.size(); ++i) {
      const Eigen::Vector4f key(keys[i].data());
      EXPECT_NEAR(key.norm(), 1, 1e-6f);
      const Eigen::Vector4f before(keys[i > 0 ? i - 1 : 0].data());
      EXPECT_GT(key.dot(before), 0);
    }
  }
  EXPECT_LT(farthest(motion, model, 7), 0.01f);
}

TEST(Gltf, AJointThatNeverMovesHasOneKeyOrNone) {
  Motion motion(person(), {100, 1}, 20);
  for (std::int64_t frame = 0; frame < 20; ++frame) {
    motion.pose(frame).rotations[1] = Quaternionf(Eigen::AngleAxisf(0.5f, Vector3f::UnitZ()));
    motion.pose(frame).rotations[2] =
        Quaternionf(Eigen::AngleAxisf(0.01f * static_cast<float>(frame), Vector3f::UnitZ()));
  }
  const tinygltf::Model model = written(motion);
  EXPECT_EQ(channel_of(model, 0, "rotation"), nullptr);
  EXPECT_EQ(channel_of(model, 0, "translation"), nullptr);
  EXPECT_EQ(keys_of(model, *channel_of(model, 1, "rotation")), 1u);
  EXPECT_EQ(keys_of(model, *channel_of(model, 2, "rotation")), 20u);
  EXPECT_LT(farthest(motion, model, 19), 1e-5f);
}

TEST(Gltf, AStillMotionHasAnAnimationAllTheSame) {
  const tinygltf::Model model = written(Motion(person(), {100, 1}, 1));
  EXPECT_EQ(model.animations.at(0).channels.size(), 1u);
}

TEST(Gltf, TheSkinIsBoundInTheRestPose) {
  const Motion motion = moving_person(5);
  const tinygltf::Model model = written(motion);
  ASSERT_EQ(model.skins.size(), 1u);
  const auto matrices = elements(model, model.skins[0].inverseBindMatrices);
  const std::vector<Affine3f> rest = globals(model, std::nullopt);
  const std::size_t bones = motion.skeleton().joint_count() + motion.skeleton().tips().size();
  ASSERT_EQ(model.skins[0].joints.size(), bones);
  ASSERT_EQ(matrices.size(), bones);
  for (std::size_t i = 0; i < bones; ++i) {
    const Eigen::Matrix4f inverse(matrices[i].data());
    const Eigen::Matrix4f product = rest[static_cast<std::size_t>(model.skins[0].joints[i])].matrix() * inverse;
    EXPECT_LT((product - Eigen::Matrix4f::Identity()).norm(), 1e-5f);
  }
}

TEST(Gltf, TheBodyGoesWithItsJoints) {
  const Motion motion = moving_person(9);
  const tinygltf::Model model = written(motion);
  const auto& attributes = model.meshes.at(0).primitives.at(0).attributes;
  const auto positions = elements(model, attributes.at("POSITION"));
  const auto joints = elements(model, attributes.at("JOINTS_0"));
  const auto weights = elements(model, attributes.at("WEIGHTS_0"));
  const auto matrices = elements(model, model.skins[0].inverseBindMatrices);
  for (const std::int64_t frame : {0, 8}) {
    const std::vector<Affine3f> nodes = globals(model, time_of(motion, frame));
    Vector3f low(1e9f, 1e9f, 1e9f);
    Vector3f high = -low;
    Vector3f body_low = low;
    Vector3f body_high = high;
    for (std::size_t i = 0; i < motion.skeleton().joint_count(); ++i) {
      low = low.cwiseMin(nodes[i].translation());
      high = high.cwiseMax(nodes[i].translation());
    }
    for (std::size_t i = 0; i < positions.size(); ++i) {
      ASSERT_THAT(weights[i], ElementsAre(1, 0, 0, 0));
      ASSERT_THAT(std::vector<float>(joints[i].begin() + 1, joints[i].end()), ElementsAre(0, 0, 0));
      const auto joint = static_cast<std::size_t>(joints[i][0]);
      const Vector3f place = nodes[joint] * (Eigen::Matrix4f(matrices[joint].data()) *
                                             Eigen::Vector4f(positions[i][0], positions[i][1], positions[i][2], 1))
                                                .head<3>();
      body_low = body_low.cwiseMin(place);
      body_high = body_high.cwiseMax(place);
      EXPECT_LT((place - nodes[joint].translation()).norm(), 0.5f) << "farther from its joint than any bone is long";
    }
    EXPECT_LT((body_low - low).cwiseAbs().maxCoeff(), 0.3f);
    EXPECT_LT((body_high - high).cwiseAbs().maxCoeff(), 0.3f);
  }
  const auto node = static_cast<std::size_t>(model.scenes[0].nodes.at(1));
  EXPECT_EQ(model.nodes[node].skin, 0) << "a skinned mesh hangs under no joint";
}

TEST(Gltf, TracksTheFaceCanShowAreItsWeightsAndTheOthersExtras) {
  Motion motion = moving_person(3);
  motion.add_track({"tongueOut", {0, 0.25f, 0.5f}});
  motion.add_track({"jawOpen", {0, 1, 0.5f}});
  motion.add_track({"eyeBlinkLeft", {1, 0, 1}});
  const tinygltf::Model model = written(motion);
  ASSERT_EQ(model.meshes.size(), 2u);
  const tinygltf::Mesh& face = model.meshes[1];
  EXPECT_EQ(face.primitives[0].targets.size(), 2u);
  const tinygltf::Value& names = face.extras.Get("targetNames");
  ASSERT_EQ(names.ArrayLen(), 2u);
  EXPECT_EQ(names.Get(0).Get<std::string>(), "jawOpen");
  EXPECT_EQ(names.Get(1).Get<std::string>(), "eyeBlinkLeft");

  const auto node = std::find_if(model.nodes.begin(), model.nodes.end(), [](const auto& one) { return one.mesh == 1; });
  const auto index = static_cast<int>(node - model.nodes.begin());
  EXPECT_THAT(model.nodes[static_cast<std::size_t>(*motion.skeleton().find("Head"))].children, Contains(index));
  const auto* channel = channel_of(model, index, "weights");
  ASSERT_NE(channel, nullptr);
  const auto& sampler = model.animations[0].samplers[static_cast<std::size_t>(channel->sampler)];
  EXPECT_THAT(sampled(model, sampler, 0.01f), ElementsAre(1, 0));
  EXPECT_THAT(sampled(model, sampler, 0.02f), ElementsAre(0.5f, 1));

  const tinygltf::Value& tracks = model.animations[0].extras.Get("tracks");
  ASSERT_EQ(tracks.ArrayLen(), 1u);
  EXPECT_EQ(tracks.Get(0).Get("name").Get<std::string>(), "tongueOut");
  EXPECT_EQ(tracks.Get(0).Get("rate").GetNumberAsDouble(), 100);
  ASSERT_EQ(tracks.Get(0).Get("values").ArrayLen(), 3u);
  EXPECT_EQ(tracks.Get(0).Get("values").Get(1).GetNumberAsDouble(), 0.25);
}

TEST(Gltf, AFaceIsDrawnOnTheHeadAndOnNothingElse) {
  Motion motion = moving_person(2);
  EXPECT_EQ(written(motion).meshes.size(), 1u) << "no face without tracks";
  motion.add_track({"jawOpen", {0, 1}});
  // The face lies before the head, in its joint's space.
  const tinygltf::Model model = written(motion);
  for (const auto& position : elements(model, model.meshes[1].primitives[0].attributes.at("POSITION"))) {
    EXPECT_GT(position[2], 0.02f);
    EXPECT_GT(position[1], 0);
    EXPECT_LT(position[1], 0.25f);
  }
  const JointIndex other = *motion.skeleton().find("Neck");
  const tinygltf::Model named = written(motion, {.name = "x", .declarations = {}, .head = other});
  EXPECT_EQ(named.nodes[static_cast<std::size_t>(other)].children.size(), 2u) << "the head, and a face";

  Motion snake(
      std::make_shared<const Skeleton>(std::vector<Joint>{{"a", kNoJoint, {0, 0, 0}, true}, {"b", 0, {0, 1, 0}, false}},
                                       std::vector<Tip>()),
      {100, 1}, 2);
  snake.add_track({"jawOpen", {0, 1}});
  const tinygltf::Model headless = written(snake);
  EXPECT_EQ(headless.meshes.size(), 1u);
  EXPECT_EQ(headless.animations[0].extras.Get("tracks").ArrayLen(), 1u);
}

TEST(Gltf, WhatTheSourcesDeclareIsInTheAsset) {
  const tinygltf::Model model = written(
      moving_person(2), {.name = "x",
                         .declarations = {{"signweave:placeholder", "no signs"}, {"signweave:placeholder", "at all"}},
                         .head = {}});
  EXPECT_EQ(model.asset.generator, "signweave");
  EXPECT_EQ(model.asset.extras.Get("signweave:placeholder").Get<std::string>(), "no signs; at all");
  EXPECT_THAT(written(moving_person(2)).asset.extras.Keys(), IsEmpty());
}

TEST(Gltf, TheTextFormHoldsTheSame) {
  const Motion motion = moving_person(7);
  const std::string text = gltf::to_bytes(motion, {}, gltf::Container::text);
  EXPECT_EQ(text[0], '{');
  const tinygltf::Model model = loaded(text, false);
  EXPECT_EQ(model.buffers[0].data, written(motion).buffers[0].data);
  EXPECT_LT(farthest(motion, model, 6), 1e-5f);
}

TEST(Gltf, RefusesWhatItCannotHold) {
  EXPECT_THAT(error_of(Motion(person(), {100, 1}, 0)), HasSubstr("nothing to show"));
  EXPECT_THAT(error_of(Motion()), HasSubstr("nothing to show"));
  Motion motion = moving_person(4);
  motion.pose(2).rotations[3] = Quaternionf(0, 0, 0, 0);
  EXPECT_THAT(error_of(motion), HasSubstr("frame 2: the rotation of 'Neck'"));
  motion = moving_person(4);
  motion.pose(3).translations[0].y() = std::numeric_limits<float>::infinity();
  EXPECT_THAT(error_of(motion), HasSubstr("frame 3: the translation of 'Hips'"));
  motion = moving_person(4);
  motion.add_track({"jawOpen", {0, std::nanf(""), 0, 0}});
  EXPECT_THAT(error_of(motion), HasSubstr("frame 1: track 'jawOpen'"));
}

TEST(GltfDocument, FramesWhoseTimesFallTogetherAreRefused) {
  EXPECT_EQ(gltf::key_times({30'000, 1'001}, 3)[2], static_cast<float>(2 * 1001 / 30'000.0));
  EXPECT_NO_THROW(gltf::key_times({100, 1}, 1'000'000));  // nearly three hours
  try {
    gltf::key_times({1'000'000, 1}, (1 << 24) + 3);
    FAIL() << "no error";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::unsupported);
    EXPECT_THAT(error.what(), HasSubstr("glTF cannot tell its time"));
  }
}

TEST(GltfDocument, RefusesToPassItsLimit) {
  gltf::Document document(40, "too large for a test");
  const std::vector<float> numbers(8, 1.0f);
  document.scalars(numbers);
  EXPECT_NO_THROW(document.scalars(std::span(numbers).first(2)));
  try {
    document.scalars(std::span(numbers).first(1));
    FAIL() << "no error";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::unsupported);
    EXPECT_STREQ(error.what(), "too large for a test");
  }
}

TEST(GltfDocument, JointsBeyondAByteTakeTwo) {
  gltf::Document document(1000, "");
  const std::vector<int> joints = {0, 256, 65'000};
  const int index = document.joints(joints);
  EXPECT_EQ(elements(document.model(), index)[2][0], 65'000);
}

class GltfFile : public testing::Test {
 protected:
  GltfFile() {
    std::string name = (std::filesystem::temp_directory_path() / "gltf_test.XXXXXX").string();
    folder_ = mkdtemp(name.data());
  }
  ~GltfFile() override { std::filesystem::remove_all(folder_); }
  std::filesystem::path folder_;
};

TEST_F(GltfFile, TheEndingSaysWhich) {
  gltf::write(folder_ / "a.GLTF", moving_person(2), {});
  gltf::write(folder_ / "a.glb", moving_person(2), {});
  EXPECT_EQ(read_file(folder_ / "a.GLTF"), gltf::to_bytes(moving_person(2), {}, gltf::Container::text));
  EXPECT_EQ(read_file(folder_ / "a.glb"), gltf::to_bytes(moving_person(2), {}, gltf::Container::binary));
}

TEST_F(GltfFile, AFaultLeavesTheOldFile) {
  std::ofstream(folder_ / "a.glb") << "old";
  Motion motion = moving_person(2);
  motion.pose(1).translations[0].x() = std::nanf("");
  try {
    gltf::write(folder_ / "a.glb", motion, {});
    FAIL() << "no error";
  } catch (const Error& error) {
    EXPECT_THAT(error.what(), HasSubstr("a.glb: frame 1: the translation"));
  }
  EXPECT_EQ(read_file(folder_ / "a.glb"), "old");
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder_), {}), 1) << "no temporary file is left";
  EXPECT_THROW(gltf::write(folder_ / "none" / "a.glb", moving_person(2), {}), Error);
}

}  // namespace
}  // namespace signweave
