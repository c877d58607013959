#include "signweave/formats/gltf/character.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstring>
#include <limits>
#include <nlohmann/json.hpp>

#include "signweave/core/error.h"
#include "signweave/motion/skeleton.h"

namespace signweave::gltf {
namespace {

using nlohmann::json;
using testing::HasSubstr;

/// A character with two joints, a face with two targets and four bytes that must be preserved.
json character_json() {
  return json::parse(R"({
    "asset": {"version": "2.0", "extras": {"signweave": {"version": 1}}},
    "buffers": [{"byteLength": 4}],
    "bufferViews": [{"buffer": 0, "byteLength": 4}],
    "accessors": [{"bufferView": 0, "componentType": 5126, "count": 1, "type": "SCALAR"}],
    "meshes": [{"primitives": [{"attributes": {"POSITION": 0}}], "extras": {"targetNames": ["jawOpen", "eyeBlinkLeft"]}}],
    "nodes": [{"name": "root", "children": [1]}, {"name": "head"}, {"name": "face", "mesh": 0}]
  })");
}

std::string glb(const std::string& text, const std::string& bytes = "keep") {
  std::string chunk = text;
  chunk.resize((chunk.size() + 3) / 4 * 4, ' ');
  const auto number = [](std::size_t value) {
    const auto small = static_cast<std::uint32_t>(value);
    std::string out(4, '\0');
    std::memcpy(out.data(), &small, 4);
    return out;
  };
  return "glTF" + number(2) + number(28 + chunk.size() + bytes.size()) + number(chunk.size()) + "JSON" + chunk +
         number(bytes.size()) + std::string("BIN\0", 4) + bytes;
}

struct ReadCharacter {
  json document;
  std::string bytes;
  std::vector<float> floats(std::size_t accessor) const {
    const json& one = document["accessors"][accessor];
    const json& view = document["bufferViews"][one["bufferView"].get<std::size_t>()];
    std::vector<float> values(view["byteLength"].get<std::size_t>() / 4);
    std::memcpy(values.data(), bytes.data() + view["byteOffset"].get<std::size_t>(), values.size() * 4);
    return values;
  }
  /// The keys of a node's channel; empty if it has none.
  std::vector<float> keys(int node, const std::string& path) const {
    const json& animation = document["animations"][0];
    for (const json& channel : animation["channels"]) {
      if (channel["target"]["node"] != node || channel["target"]["path"] != path) continue;
      return floats(animation["samplers"][channel["sampler"].get<std::size_t>()]["output"].get<std::size_t>());
    }
    return {};
  }
};

ReadCharacter read_character_text(const std::string& file) {
  std::uint32_t size = 0;
  std::uint32_t all = 0;
  std::memcpy(&all, file.data() + 8, 4);
  std::memcpy(&size, file.data() + 12, 4);
  EXPECT_EQ(all, file.size());
  return {json::parse(file.substr(20, size)), file.substr(28 + size)};
}

Motion motion() {
  const auto skeleton = std::make_shared<const Skeleton>(
      std::vector<Joint>{{.name = "root", .parent = kNoJoint, .offset = {0, 1, 0}, .translated = true},
                         {.name = "head", .parent = 0, .offset = {0, 0.5F, 0}, .translated = false}},
      std::vector<Tip>{});
  Motion made(skeleton, FrameRate{50, 1}, 3);
  for (int frame = 0; frame < 3; ++frame) {
    const Eigen::Quaternionf turn(Eigen::AngleAxisf(0.1F * static_cast<float>(frame), Eigen::Vector3f::UnitY()));
    made.pose(frame).rotations[1] = frame == 1 ? Eigen::Quaternionf(-turn.coeffs()) : turn;
    made.pose(frame).translations[0] = {0, 1, 0.25F * static_cast<float>(frame)};
  }
  made.add_track({"eyeBlinkLeft", {0, 0.5F, 1}});
  made.add_track({"unknown", {1, 1, 1}});
  return made;
}

ErrorCode code_of(const std::string& file, const Motion& with, std::string& text) {
  try {
    on_character("x.glb", file, with, {});
  } catch (const Error& error) {
    text = error.what();
    return error.code();
  }
  ADD_FAILURE() << "nothing was thrown";
  return ErrorCode::io;
}

TEST(GltfCharacter, AMotionIsAddedAndTheOriginalContentStays) {
  const ReadCharacter made =
      read_character_text(on_character("x.glb", glb(character_json().dump()), motion(),
                                       {.name = "signing", .declarations = {{"signweave:placeholder", "no LSF"}}}));
  EXPECT_EQ(made.bytes.substr(0, 4), "keep");
  EXPECT_EQ(made.document["meshes"], character_json()["meshes"]);
  EXPECT_EQ(made.document["nodes"], character_json()["nodes"]);
  EXPECT_EQ(made.document["asset"]["extras"]["signweave:placeholder"], "no LSF");
  EXPECT_EQ(made.document["asset"]["extras"]["signweave"]["version"], 1);
  EXPECT_EQ(made.document["buffers"][0]["byteLength"], made.bytes.size());
  ASSERT_EQ(made.document["animations"].size(), 1u);
  EXPECT_EQ(made.document["animations"][0]["name"], "signing");

  const json& sampler = made.document["animations"][0]["samplers"][0];
  const auto times = made.floats(sampler["input"].get<std::size_t>());
  EXPECT_THAT(times, testing::ElementsAre(0, testing::FloatEq(0.02F), testing::FloatEq(0.04F)));
  EXPECT_THAT(made.keys(0, "translation"), testing::ElementsAre(0, 1, 0, 0, 1, 0.25F, 0, 1, 0.5F));
  EXPECT_TRUE(made.keys(0, "rotation").empty()) << "it never turns";
  const auto turns = made.keys(1, "rotation");
  ASSERT_EQ(turns.size(), 12u);
  EXPECT_FLOAT_EQ(turns[5], std::sin(0.05F)) << "in the hemisphere of the frame before";
  EXPECT_THAT(made.keys(2, "weights"), testing::ElementsAre(0, 0, 0, 0.5F, 0, 1));
}

TEST(GltfCharacter, AMotionWithoutTracksLeavesTheFaceAlone) {
  Motion without = motion();
  without.take_tracks();
  EXPECT_TRUE(
      read_character_text(on_character("x.glb", glb(character_json().dump()), without, {})).keys(2, "weights").empty());
}

TEST(GltfCharacter, FilesOtherThanPlainGlbAreRefused) {
  std::string text;
  const std::string good = glb(character_json().dump());
  EXPECT_EQ(code_of("no", motion(), text), ErrorCode::bad_input);
  EXPECT_EQ(text, "x.glb: not a GLB: it does not begin with glTF");
  EXPECT_EQ(code_of(good.substr(0, good.size() - 1), motion(), text), ErrorCode::bad_input);
  EXPECT_EQ(text, "x.glb: not a GLB: it ends within a chunk");
  EXPECT_EQ(code_of(glb("{"), motion(), text), ErrorCode::bad_input);
  EXPECT_THAT(text, HasSubstr("x.glb: not as glTF specifies"));
  EXPECT_EQ(code_of(glb("{}"), motion(), text), ErrorCode::bad_input);
  json packed = character_json();
  packed["extensionsRequired"] = {"EXT_meshopt_compression"};
  EXPECT_EQ(code_of(glb(packed.dump()), motion(), text), ErrorCode::unsupported);
  EXPECT_THAT(text, HasSubstr("the file is packed (EXT_meshopt_compression)"));
  json meshless = character_json();
  meshless["nodes"][2]["mesh"] = 7;
  EXPECT_EQ(code_of(glb(meshless.dump()), motion(), text), ErrorCode::bad_input);
}

TEST(GltfCharacter, NumbersThatAreNotFiniteAreRefused) {
  std::string text;
  Motion broken = motion();
  broken.pose(1).rotations[1].x() = std::numeric_limits<float>::quiet_NaN();
  EXPECT_EQ(code_of(glb(character_json().dump()), broken, text), ErrorCode::bad_input);
  EXPECT_EQ(text, "frame 1: the rotation of 'head' is not a finite number; glTF allows no other");
}

}  // namespace
}  // namespace signweave::gltf
