#include "signweave/retarget/character.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <numbers>
#include <string>

#include "signweave/core/error.h"
#include "signweave/retarget/test_character.h"

namespace signweave {
namespace {

using Eigen::Vector3f;

std::string list(const Vector3f& v) {
  return fmt::format("[{},{},{}]", v.x(), v.y(), v.z());
}

/// The JSON of a character with the body of `whole_person`.
std::string text_of(const Skeleton& skeleton) {
  const ModelPose rest = to_model_space(skeleton, Pose(skeleton).view());
  std::string nodes;
  std::string joints;
  for (std::size_t i = 0; i < skeleton.joint_count(); ++i) {
    std::string children;
    for (std::size_t k = 0; k < skeleton.joint_count(); ++k) {
      if (skeleton.joints()[k].parent == static_cast<JointIndex>(i))
        children += fmt::format("{}{}", children.empty() ? "" : ",", k);
    }
    nodes += fmt::format(R"({}{{"name":"{}","translation":{}{}}})", i > 0 ? "," : "", skeleton.joints()[i].name,
                         list(skeleton.joints()[i].offset), children.empty() ? "" : ",\"children\":[" + children + "]");
    joints += fmt::format("{}{}", i > 0 ? "," : "", i);
  }
  std::string hands;
  for (const Side side : kSides) {
    const std::string name = side == Side::left ? "Left" : "Right";
    std::string fingers;
    const char* const ours[] = {"Thumb", "Index", "Middle", "Ring", "Pinky"};
    const char* const theirs[] = {"thumb", "index", "middle", "ring", "little"};
    for (std::size_t f = 0; f < 5; ++f) {
      const std::string joint = name + "Hand" + ours[f];
      const Vector3f last = rest.positions[static_cast<std::size_t>(*skeleton.find(joint + "3"))];
      fingers += fmt::format(
          R"({}"{}":{{"joints":["{}1","{}2","{}3"],"metacarpal":null,"tip":{},"flexionAxis":[0,0,1],"spreadAxis":[0,1,0],)"
          R"("restFlexion":[0,10,0],"limits":{{"flexion":[[-20,90],[0,110],[0,80]],"spread":[-15,20]}}}})",
          f > 0 ? "," : "", theirs[f], joint, joint, joint,
          list(last + Vector3f(side == Side::left ? 0.02f : -0.02f, 0, 0)));
    }
    hands += fmt::format(
        R"({}"{}":{{"wrist":"{}Hand","twist":["{}ForeArm"],"elbow":"{}ForeArm","shoulder":["{}Arm"],"length":0.17,"fingers":{{{}}}}})",
        side == Side::left ? "" : ",", side == Side::left ? "left" : "right", name, name, name, name, fingers);
  }
  return fmt::format(
      R"({{"asset":{{"version":"2.0","extras":{{"signweave":{{"version":1,"character":"made","height":1.7,"eyes":[0,1.6,0.1],)"
      R"("hands":{{{}}},"faceUnits":{{"morphs":{{"jawOpen":["head"],"eyeBlinkLeft":["head"]}}}}}}}}}},)"
      R"("scene":0,"scenes":[{{"nodes":[0]}}],"nodes":[{}],"skins":[{{"joints":[{}]}}]}})",
      hands, nodes, joints);
}

std::string glb(std::string json) {
  while (json.size() % 4 != 0) json += ' ';
  const auto word = [](std::size_t value) {
    std::string bytes;
    for (int i = 0; i < 4; ++i) bytes += static_cast<char>(value >> (8 * i) & 255);
    return bytes;
  };
  return "glTF" + word(2) + word(20 + json.size()) + word(json.size()) + "JSON" + json;
}

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  const std::size_t at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return text.replace(at, from.size(), to);
}

std::string error_of(const std::string& bytes) {
  try {
    read_character_bytes("x.glb", bytes);
  } catch (const Error& error) {
    return error.what();
  }
  return "none";
}

TEST(Character, IsReadFromTheFile) {
  const auto skeleton = whole_person();
  const Character character = read_character_bytes("x.glb", glb(text_of(*skeleton)));
  EXPECT_EQ(character.name, "made");
  EXPECT_EQ(character.skeleton->joint_count(), skeleton->joint_count());
  EXPECT_TRUE(character.body.has_value());
  EXPECT_THAT(character.face_units, testing::ElementsAre("eyeBlinkLeft", "jawOpen"));
  const CharacterFinger& index = character.hand(Side::right).fingers[1];
  EXPECT_EQ(character.skeleton->joint(index.joints[0]).name, "RightHandIndex1");
  EXPECT_NEAR(index.flexion[1].greatest, 110 * std::numbers::pi_v<float> / 180, 1e-5f);
  const PartPlace& tip = character.rig[finger_part(Side::right, Finger::index, FingerPoint::tip)];
  EXPECT_LT((tip.offset - Vector3f(-0.02f, 0, 0)).norm(), 1e-5f);
  EXPECT_NEAR(character.rig[Part::head_top].offset.y(), 1.7f - 1.52f, 1e-4f);
}

TEST(Character, ErrorsAreOneClearLine) {
  using testing::HasSubstr;
  const std::string text = text_of(*whole_person());
  EXPECT_EQ(error_of("no"), "x.glb: not a GLB file");
  EXPECT_THAT(error_of(glb("{")), HasSubstr("x.glb: its JSON cannot be read"));
  EXPECT_THAT(error_of(glb(replaced(text, "\"signweave\"", "\"other\""))), HasSubstr("no asset.extras.signweave"));
  EXPECT_THAT(error_of(glb(replaced(text, "\"version\":1", "\"version\":2"))),
              HasSubstr("only version 1 is supported"));
  EXPECT_THAT(error_of(glb(replaced(text, "\"wrist\":\"LeftHand\"", "\"wrist\":\"Nobody\""))),
              HasSubstr("no joint Nobody"));
  EXPECT_THAT(error_of(glb(replaced(text, "[[-20,90]", "[[90,-20]"))),
              HasSubstr("the lower limit exceeds the upper limit"));
  EXPECT_THAT(error_of(glb(replaced(text, "\"flexionAxis\":[0,0,1]", "\"flexionAxis\":[0,0,9]"))),
              HasSubstr("not a unit vector"));
  EXPECT_THAT(error_of(glb(replaced(text, "\"skins\":[{\"joints\":[0,", "\"skins\":[{\"joints\":[999,"))),
              HasSubstr("x.glb: skins[0].joints[0]: not a valid index"));
  EXPECT_THAT(error_of(glb(replaced(text, "\"children\":[1,", "\"children\":[777,"))),
              HasSubstr("nodes[0].children[0]: not a valid index"));
  EXPECT_THAT(error_of(glb(replaced(text, "\"asset\":", "\"extensionsRequired\":[\"EXT_x\"],\"asset\":"))),
              HasSubstr("x.glb: needs the extension EXT_x"));
  EXPECT_THAT(error_of(glb(replaced(text, "\"name\":\"Spine\",", "\"name\":\"Spine\",\"rotation\":[0,1,0,0],"))),
              HasSubstr("the joint Spine is rotated or scaled at rest"));
}

TEST(Character, ACompressedFileIsReadLikeAPlainOne) {
  // Meshes and images are compressed; one buffer is a placeholder for the decompressed data and has no bytes.
  const std::string text = text_of(*whole_person());
  const std::string packed = replaced(
      text, "\"asset\":",
      R"("extensionsRequired":["EXT_meshopt_compression","EXT_texture_webp","KHR_mesh_quantization"],)"
      R"("buffers":[{"byteLength":4},{"byteLength":99999,"extensions":{"EXT_meshopt_compression":{"fallback":true}}}],)"
      R"("images":[{"bufferView":7,"mimeType":"image/webp"}],"meshes":[{"primitives":[{"attributes":{"POSITION":9}}]}],)"
      R"("asset":)");
  const Character plain = read_character_bytes("x.glb", glb(text));
  const Character same = read_character_bytes("x.glb", glb(packed) + std::string("\4\0\0\0BIN\0\1\2\3\4", 12));
  ASSERT_EQ(plain.skeleton->joint_count(), same.skeleton->joint_count());
  for (std::size_t i = 0; i < plain.skeleton->joint_count(); ++i) {
    EXPECT_EQ(plain.skeleton->joints()[i].name, same.skeleton->joints()[i].name);
    EXPECT_EQ(plain.skeleton->joints()[i].offset, same.skeleton->joints()[i].offset);
  }
  EXPECT_EQ(plain.face_units, same.face_units);
}

TEST(Character, LengthsAreCheckedAgainstTheBytes) {
  const std::string whole = glb(text_of(*whole_person()));
  EXPECT_EQ(error_of(whole), "none");
  // A file truncated anywhere gives an error, never a crash.
  for (std::size_t size = 0; size < whole.size(); size += 1 + size / 7) {
    EXPECT_NE(error_of(whole.substr(0, size)), "none") << size;
  }
  const auto with = [&](std::size_t at, const std::string& bytes) {
    std::string text = whole;
    return text.replace(at, bytes.size(), bytes);
  };
  EXPECT_EQ(error_of(with(4, "\1")), "x.glb: only GLB version 2 is supported");
  EXPECT_EQ(error_of(with(12, "\xFF\xFF\xFF\xFF")), "x.glb: its JSON is longer than the file");
  EXPECT_EQ(error_of(with(16, "BIN ")), "x.glb: a GLB file must begin with JSON");
  EXPECT_EQ(error_of(with(20, "[")), "x.glb: its JSON cannot be read");
}

TEST(Character, AMissingFileIsNotFound) {
  EXPECT_THROW(read_character("/nowhere/x.glb"), Error);
}

}  // namespace
}  // namespace signweave
