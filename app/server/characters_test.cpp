// The parts that show motion: frames for programs that draw, characters, linked media, and the results of a drawing
// page.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstring>
#include <fstream>

#include "app/server/test_api.h"
#include "app/server/test_frames.h"
#include "app/server/test_server.h"
#include "signweave/motion/kinematics.h"
#include "signweave/retarget/test_character.h"
#include "signweave/rig/test_rig.h"

namespace signweave::server {
namespace {

using nlohmann::json;
using ::testing::HasSubstr;
using ::testing::StartsWith;

calls::SharedCharacter made_character(const std::filesystem::path& file = "woman.glb",
                                      const std::shared_ptr<const Skeleton>& skeleton = whole_person()) {
  return std::make_shared<const calls::CharacterFile>(
      calls::CharacterFile{.name = "woman", .path = file, .plain = file, .character = character_of(skeleton)});
}

constexpr float kAnkle = 0.08F;  ///< metres above the floor

std::shared_ptr<const Skeleton> person_on_feet() {
  const std::shared_ptr<const Skeleton> person = whole_person();
  std::vector<Joint> joints(person->joints().begin(), person->joints().end());
  for (const std::string side : {"Left", "Right"}) {
    joints.push_back({side + "Leg", *person->find(side + "UpLeg"), {0, -0.42F, 0}, false});
    joints.push_back(
        {side + "Foot", static_cast<JointIndex>(joints.size()) - 1, {0, -0.95F + 0.46F + kAnkle, 0}, false});
  }
  return std::make_shared<const Skeleton>(std::move(joints), std::vector(person->tips().begin(), person->tips().end()));
}

TestApi& with_character() {
  static TestApi api(false);
  static const bool once = [] {
    api.served().characters = calls::Characters(made_character());
    return true;
  }();
  EXPECT_TRUE(once);
  return api;
}

TEST(FramesAnswer, HasTheMotionOfTheDatabase) {
  const Frames got = frames_in(with_character().get(at({"recordings", "villes", "motion"}),
                                                    {{"format", "frames"}, {"from", "1000"}, {"to", "9000"}}));
  const Motion motion = with_character().database().read("villes", {100, 900});
  ASSERT_EQ(got.poses.size(), 800u) << "more than one message";
  EXPECT_EQ(got.head["origin_ms"], 1000.0);
  EXPECT_EQ(got.head["recording"], "villes");
  EXPECT_EQ(got.head["rig"]["parts"]["head"]["joint"], "Head");
  EXPECT_THAT(got.head["declarations"].dump(), HasSubstr("placeholder"));
  EXPECT_FALSE(got.head.contains("pace"));
  EXPECT_FALSE(got.head.contains("report"));
  for (std::size_t frame = 0; frame < got.poses.size(); ++frame) {
    const PoseView pose = motion.pose(static_cast<std::int64_t>(frame));
    for (std::size_t joint = 0; joint < pose.rotations.size(); ++joint) {
      ASSERT_LE(pose.rotations[joint].angularDistance(got.poses[frame].rotations[joint]), 1e-3);
    }
    ASSERT_LE((pose.translations[0] - got.poses[frame].translations[0]).norm(), 3e-5F);
    for (std::size_t track = 0; track < motion.tracks().size(); ++track) {
      ASSERT_EQ(motion.tracks()[track].values[frame], got.tracks[frame][track]);
    }
  }
}

TEST(FramesAnswer, ReportsRegeneratedFrames) {
  const auto part = [&](std::map<std::string, std::string> more) {
    std::map<std::string, std::string> query = {{"format", "frames"}, {"from", "28000"}, {"to", "31000"}};
    query.merge(more);
    return frames_in(with_character().get(at({"recordings", "meteo", "motion"}), std::move(query)));
  };
  const Frames plain = part({});
  for (const TransitionMethod& method : transition_methods()) {
    const Frames made = part({{"regenerate", "28500..28800,29800..30100"}, {"transition", std::string(method.name)}});
    ASSERT_EQ(made.poses.size(), plain.poses.size());
    EXPECT_EQ(made.head["report"]["regenerated"].size(), 2u);
    EXPECT_EQ(made.head["report"]["regenerated"][1]["begin_ms"], 29'800);
    EXPECT_EQ(made.head["report"]["regenerated"][1]["method"], method.name);
    std::size_t changed = 0;
    for (std::size_t frame = 0; frame < plain.poses.size(); ++frame) {
      const bool inside = (frame >= 50 && frame < 80) || (frame >= 180 && frame < 210);
      const bool same = std::ranges::equal(made.poses[frame].rotations, plain.poses[frame].rotations,
                                           [](const auto& a, const auto& b) { return a.coeffs() == b.coeffs(); }) &&
                        made.poses[frame].translations == plain.poses[frame].translations;
      EXPECT_TRUE(same || inside) << method.name << ' ' << frame;
      changed += same ? 0 : 1;
    }
    EXPECT_GE(changed, 30u) << method.name;
  }
  const Frames shown = part({{"regenerate", "28500..28800"}, {"character", "woman"}});
  EXPECT_EQ(shown.poses.size(), plain.poses.size());
  EXPECT_EQ(shown.head["report"]["regenerated"].size(), 1u);
}

TEST(FramesAnswer, ReportsHowTheResultWasMade) {
  const json sign = {{"utterance", "VANNES MATIN"}, {"format", "frames"}};
  const Frames got = frames_in(with_character().send("POST", at({"sign"}), sign));
  EXPECT_EQ(got.head["report"]["signs"].size(), 2u);
  EXPECT_EQ(got.head["report"]["frames"], got.poses.size());
  EXPECT_EQ(got.head["origin_ms"], 0.0);
}

TEST(Characters, AreListedAndAMissingOneIsNamed) {
  const json list = json_in(with_character().get({"characters"}))["characters"];
  ASSERT_EQ(list.size(), 1u);
  EXPECT_EQ(list[0]["name"], "woman");
  const auto ask = [&](const char* name) {
    return fault_of(with_character().get(at({"recordings", "villes", "motion"}), {{"character", name}}));
  };
  EXPECT_EQ(ask("womam"), "404 not_found: no character 'womam'; did you mean woman?");
  EXPECT_THAT(fault_of(with_character().get({"characters", "man"})), StartsWith("404 not_found: no character 'man'"));
}

TEST(Characters, MotionsComeInTheirJoints) {
  const std::string last_joint = whole_person()->joints().back().name;
  const auto whole = frames_in(
      with_character().get(at({"recordings", "villes", "motion"}), {{"format", "frames"}, {"character", "woman"}}));
  EXPECT_EQ(whole.head["character"], "woman");
  EXPECT_EQ(whole.head["joints"].back()["name"], last_joint);
  // A range of a recording is retargeted to the character as the whole recording is.
  const auto part =
      frames_in(with_character().get(at({"recordings", "villes", "motion"}),
                                     {{"format", "frames"}, {"character", "woman"}, {"from", "3000"}, {"to", "3100"}}));
  ASSERT_EQ(part.poses.size(), 10u);
  for (std::size_t i = 0; i < part.poses.size(); ++i) {
    for (std::size_t joint = 0; joint < part.poses[i].rotations.size(); ++joint) {
      ASSERT_EQ(part.poses[i].rotations[joint].coeffs(), whole.poses[300 + i].rotations[joint].coeffs());
    }
    ASSERT_EQ(part.poses[i].translations[0], whole.poses[300 + i].translations[0]);
  }
  const auto signed_frames = frames_in(with_character().send(
      "POST", at({"sign"}), {{"utterance", "VANNES MATIN"}, {"format", "frames"}, {"character", "woman"}}));
  EXPECT_EQ(signed_frames.head["joints"].back()["name"], last_joint);
  EXPECT_EQ(signed_frames.head["report"]["signs"].size(), 2u);
  const std::string bvh =
      with_character()
          .send("POST", at({"sign"}), {{"utterance", "VANNES"}, {"character", "woman"}, {"format", "bvh"}})
          .body;
  EXPECT_THAT(bvh, HasSubstr("JOINT " + last_joint));
}

TEST(Characters, StandOnTheirFeetWhereTheSignerDoes) {
  TestApi api(false);
  api.served().characters = calls::Characters(made_character("woman.glb", person_on_feet()));
  const Character& character = api.served().characters.at("woman")->character;
  const Frames shown =
      frames_in(api.get(at({"recordings", "villes", "motion"}), {{"format", "frames"}, {"character", "woman"}}));
  for (std::size_t frame = 0; frame < shown.poses.size(); frame += 500) {
    const ModelPose pose = to_model_space(*character.skeleton, shown.poses[frame].view());
    EXPECT_NEAR(position_of(character.rig[Part::left_foot], pose).y(), kAnkle, 0.01F) << frame;
  }
}

TEST(Characters, AreShownByStreams) {
  testing::TestServer server;
  server.databases.characters = calls::Characters(made_character());
  testing::StreamClient client(server.port());
  client.say(R"({"type":"open","pace":"fast","idle":"end","batch":60,"rate":60,"character":"woman"})");
  client.say(R"({"type":"sign","utterance":"DEMAIN MATIN"})");
  const json header = client.next("header");
  EXPECT_EQ(header["character"], "woman");
  EXPECT_EQ(header["joints"].size(), whole_person()->joint_count());
  ASSERT_TRUE(client.next_frames());
  EXPECT_EQ(client.next("end")["type"], "end");
  testing::StreamClient other(server.port());
  other.say(R"({"type":"open","character":"nobody"})");
  EXPECT_THAT(other.next("error")["message"].get<std::string>(), HasSubstr("no character 'nobody'"));
}

TEST(Characters, TheirFileIsSentCompletely) {
  const kv::TestFolder folder;
  std::ofstream(folder / "woman.glb") << "glTF and more";
  testing::TestServer server;
  server.databases.characters = calls::Characters(made_character(folder / "woman.glb"));
  const auto answer = testing::get(server.port(), "/api/characters/woman");
  EXPECT_EQ(answer.body, "glTF and more");
  EXPECT_THAT(answer.head, HasSubstr("Content-Type: model/gltf-binary\r\n"));
  EXPECT_THAT(answer.head, HasSubstr("ETag: "));
  EXPECT_EQ(testing::get(server.port(), "/api/characters/woman", "Range: bytes=0-3\r\n").body, "glTF");
  std::filesystem::remove(folder / "woman.glb");
  EXPECT_EQ(testing::get(server.port(), "/api/characters/woman").status, 404);
}

TEST(Media, AreThoseThatTheAnnotationLinksAndTheServerHas) {
  const kv::TestFolder folder;
  TestApi api(true);
  AnnotationDocument document = api.database().document("villes");
  document.source = {};
  document.linked_files.push_back({.url = "file:///C:/corpus/villes%20face.mp4",
                                   .relative_url = "",
                                   .mime_type = "video/mp4",
                                   .time_origin = Milliseconds(40),
                                   .media = true});
  document.linked_files.push_back({.url = "file:///away.mp4",
                                   .relative_url = "../../.away.mp4",
                                   .mime_type = "video/mp4",
                                   .time_origin = {},
                                   .media = true});
  api.served().at("demo").change([&](Database& database) {
    Recording recording;
    recording.name = "villes";
    recording.annotation = AnnotationPart{.document = document, .tiers = {}, .file = "villes.eaf", .fingerprint = 1};
    database.put(recording);
  });
  api.served().media = folder / "";
  const auto list = [&] { return json_in(api.get(at({"recordings", "villes", "media"})))["media"]; };
  EXPECT_THAT(list().dump(), ::testing::Not(HasSubstr("/api/")));
  std::ofstream(folder / "villes face.mp4") << "film";
  std::ofstream(folder / ".away.mp4") << "hidden";
  json film;
  for (const json& one : list()) {
    if (one["file"] == "villes face.mp4") film = one;
  }
  EXPECT_EQ(film["origin_ms"], 40);
  const std::string url = film["url"];
  EXPECT_THAT(url, StartsWith("/api/databases/demo/recordings/villes/media/"));
  const ApiResponse sent = api.get(at({"recordings", "villes", "media", url.substr(url.rfind('/') + 1)}));
  EXPECT_EQ(sent.content_type, "video/mp4");
  EXPECT_EQ(sent.file, folder / "villes face.mp4");
  EXPECT_EQ(list().back()["url"], nullptr) << "hidden, and elsewhere";
  for (const char* number : {"99", "x", "-1", "1 "}) {
    EXPECT_THAT(fault_of(api.get(at({"recordings", "villes", "media", number}))), StartsWith("404 not_found"))
        << number;
  }
}

TEST(Renders, AcceptFilesOfTheCurrentRendering) {
  const kv::TestFolder folder;
  TestApi api(false);
  std::filesystem::create_directory(folder / "drawn");
  const auto put = [&](const char* render, const char* file) {
    std::ofstream(folder / "body") << "bytes";
    return api.api().answer(
        {.method = "PUT", .path = {"renders", render, file}, .body = {}, .body_file = folder / "body"});
  };
  EXPECT_THAT(fault_of(put("secret", "done")), StartsWith("404 not_found: no rendering with this name"));
  EXPECT_FALSE(std::filesystem::exists(folder / "body")) << "it is moved away";
  api.served().render = Render{.id = "secret", .folder = folder / "drawn"};
  EXPECT_THAT(fault_of(put("guessed", "done")), StartsWith("404 not_found"));
  for (const char* bad : {"..", ".done", "A.webm", "a/b", ""}) {
    EXPECT_THAT(fault_of(put("secret", bad)), StartsWith("400 bad_input")) << bad;
  }
  EXPECT_EQ(put("secret", "00001.png").status, 200);
  EXPECT_TRUE(std::filesystem::exists(folder / "drawn" / "00001.png"));
  const std::optional<ApiResponse> refusal = api.api().refusal({.method = "PUT", .path = {"renders", "no", "x"}});
  ASSERT_TRUE(refusal);
  EXPECT_EQ(refusal->status, 404);
}

}  // namespace
}  // namespace signweave::server
