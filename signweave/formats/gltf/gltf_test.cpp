#include "signweave/formats/gltf/gltf.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <limits>
#include <set>

#include "signweave/core/error.h"
#include "signweave/drawing/test_person.h"
#include "signweave/formats/gltf/test_reader.h"
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
using testing_gltf::channel_of;
using testing_gltf::elements;
using testing_gltf::farthest;
using testing_gltf::globals;
using testing_gltf::keys_of;
using testing_gltf::loaded;
using testing_gltf::sampled;
using testing_gltf::time_of;
using testing_gltf::written;

std::string writing_error(const Motion& motion, gltf::Container container = gltf::Container::binary) {
  try {
    gltf::to_bytes(motion, {}, container);
  } catch (const Error& error) {
    return error.what();
  }
  return "no error";
}

TEST(Gltf, JointsAndTipsAreNodesUnderOneNamedAfterTheMotion) {
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

TEST(Gltf, NodesAreWhereTheJointsAre) {
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

TEST(Gltf, AStillMotionStillHasAnAnimation) {
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

TEST(Gltf, TheBodyMovesWithItsJoints) {
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
  // The face is in front of the head, in its joint's space.
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
  EXPECT_THAT(writing_error(Motion(person(), {100, 1}, 0)), HasSubstr("nothing to show"));
  EXPECT_THAT(writing_error(Motion()), HasSubstr("nothing to show"));
  Motion motion = moving_person(4);
  motion.pose(2).rotations[3] = Quaternionf(0, 0, 0, 0);
  EXPECT_THAT(writing_error(motion), HasSubstr("frame 2: the rotation of 'Neck'"));
  motion = moving_person(4);
  motion.pose(3).translations[0].y() = std::numeric_limits<float>::infinity();
  EXPECT_THAT(writing_error(motion), HasSubstr("frame 3: the translation of 'Hips'"));
  motion = moving_person(4);
  motion.add_track({"jawOpen", {0, std::nanf(""), 0, 0}});
  EXPECT_THAT(writing_error(motion), HasSubstr("frame 1: track 'jawOpen'"));
}

}  // namespace
}  // namespace signweave
