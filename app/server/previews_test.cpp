// A preview of what an import would store.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

#include "app/server/test_api.h"
#include "app/server/test_frames.h"

namespace signweave::server {
namespace {

using nlohmann::json;
using ::testing::HasSubstr;
using ::testing::StartsWith;

/// A recording of the demo signer at a frame rate.
std::string demo_bvh(FrameRate rate) {
  const demo::SyntheticRecording made = demo::make_recording(demo::corpus_scripts(1).front(), rate, 7);
  return bvh::write_text(made.motion, bvh::default_layout(made.motion.skeleton()));
}
const std::string& slow_bvh() {
  static const std::string text = demo_bvh({50, 1});
  return text;
}

ApiResponse preview_of(TestApi& api, const std::string& upload, const json& parameters) {
  return api.send("POST", at({"uploads", upload, "preview"}), parameters);
}

TEST(Preview, EqualsWhatIsStored) {
  TestApi api(true);
  int number = 0;
  for (const json& parameters :
       {json::object(), json{{"unit", "m"}}, json{{"up", "z"}}, json{{"mirror", true}}, json{{"root_unit", "mm"}},
        json{{"root_order", "rotation_first"}, {"up", "z"}, {"sign_tier", json::array({"Gloss"})}}}) {
    const std::string name = "take" + std::to_string(++number);
    const std::string upload = upload_of(api, {{name + ".bvh", slow_bvh()}});
    json wanted = parameters;
    wanted["file"] = name + ".bvh";
    wanted["at"] = 0.25;
    wanted["seconds"] = 2;
    const Frames shown = frames_in(preview_of(api, upload, wanted));
    EXPECT_EQ(api.database().info(name), std::nullopt) << "a preview stores nothing";
    const json imported =
        wait_for(api, json_in(api.send("POST", at({"uploads", upload, "import"}), parameters))["job"]);
    ASSERT_EQ(imported["result"]["recordings"][0]["outcome"], "added") << imported;
    const Motion stored = api.database().read(name);
    const auto first = shown.head["report"]["piece"]["first_frame"].get<std::int64_t>();
    EXPECT_EQ(first, stored.frame_count() / 4);
    ASSERT_EQ(shown.poses.size(), 100u);
    for (std::int64_t frame = 0; frame < 100; ++frame) {
      const PoseView pose = stored.pose(first + frame);
      const Pose& seen = shown.poses[static_cast<std::size_t>(frame)];
      ASSERT_LE((pose.translations[0] - seen.translations[0]).norm(), 3e-5F) << parameters << " frame " << frame;
      for (std::size_t joint = 0; joint < pose.rotations.size(); ++joint) {
        ASSERT_LE(pose.rotations[joint].angularDistance(seen.rotations[joint]), 1e-3)
            << parameters << " joint " << joint;
      }
    }
    const Joint& joint = stored.skeleton().joint(1);
    EXPECT_FLOAT_EQ(shown.head["joints"][1]["offset"][1], joint.offset.y()) << parameters;
  }
}

TEST(Preview, DescribesItsSource) {
  TestApi api(true);
  const std::string upload = upload_of(api, {{"soir.bvh", slow_bvh()}});
  const Frames shown = frames_in(preview_of(api, upload, {{"file", "soir.bvh"}}));
  const std::int64_t all = bvh::read_text("soir.bvh", slow_bvh()).motion.frame_count();
  const std::int64_t first = all / 2;
  EXPECT_EQ(shown.head["report"]["piece"], (json{{"first_frame", first},
                                                 {"end_frame", first + 200},
                                                 {"step", 1},
                                                 {"of_frames", all},
                                                 {"frames_per_second", 50.0}}));
  EXPECT_EQ(shown.head["recording"], "soir.bvh");
  EXPECT_EQ(shown.head["rate"], 50.0);
  EXPECT_EQ(shown.head["origin_ms"], 20.0 * static_cast<double>(first));
  EXPECT_EQ(shown.head["rig"]["parts"]["head"]["joint"], "Head");
}

TEST(Preview, ContainsTheDeclarationsOfAFile) {
  TestApi api(true);
  const std::string glb =
      api.get(at({"recordings", "villes", "motion"}), {{"format", "glb"}, {"from", "0"}, {"to", "3000"}}).body;
  const std::string upload = upload_of(api, {{"part.glb", glb}});
  const ApiResponse response = preview_of(api, upload, {{"file", "part.glb"}, {"seconds", 1}});
  EXPECT_THAT(frames_in(response).head["declarations"].dump(), HasSubstr("placeholder"));
  EXPECT_THAT(header_of(response, "Signweave-Declarations"), HasSubstr("placeholder"));
}

TEST(Preview, HasAFewHundredFramesAtMost) {
  TestApi api(true);
  const std::string upload = upload_of(api, {{"fast.bvh", demo_bvh({240, 1})}});
  const Frames shown = frames_in(preview_of(api, upload, {{"file", "fast.bvh"}, {"seconds", 10}, {"at", 1}}));
  EXPECT_EQ(shown.head["rate"], 60.0);
  EXPECT_EQ(shown.poses.size(), 600u);
  const json& piece = shown.head["report"]["piece"];
  EXPECT_EQ(piece["step"], 4);
  EXPECT_EQ(piece["end_frame"], piece["of_frames"]) << "it begins early enough to last as long";
  EXPECT_EQ(fault_of(preview_of(api, upload, {{"file", "fast.bvh"}, {"seconds", 3600}})),
            "400 bad_input: seconds: expected a number from 0.1 to 10, not 3600");
  EXPECT_THAT(fault_of(preview_of(api, upload, {{"file", "fast.bvh"}, {"at", -1}})), StartsWith("400 bad_input: at: "));
}

TEST(Preview, WorksDuringAJobOfTheSameUpload) {
  TestApi api(true);
  const std::string upload = upload_of(api, {{"soir.bvh", slow_bvh()}});
  const ApiResponse inspection = api.send("POST", at({"uploads", upload, "inspect"}));
  EXPECT_EQ(preview_of(api, upload, {{"file", "soir.bvh"}}).status, 200);
  EXPECT_EQ(wait_for(api, json_in(inspection)["job"])["state"], "done");
}

TEST(Preview, OfAFileReplacedMeanwhileShowsTheOldOne) {
  TestApi api(true);
  const std::string upload = upload_of(api, {{"soir.bvh", slow_bvh()}});
  std::ifstream open_file(api.scratch() / "uploads" / upload / "soir.bvh", std::ios::binary);
  EXPECT_EQ(api.put(at({"uploads", upload, "files", "soir.bvh"}), "short").status, 200);
  const std::string read{std::istreambuf_iterator<char>(open_file), {}};
  EXPECT_EQ(read, slow_bvh());
}

TEST(Preview, ReportsErrorsOnOneLine) {
  TestApi api(true);
  const std::string upload =
      upload_of(api, {{"soir.bvh", slow_bvh()}, {"wrong.bvh", "HIERARCHY\nROOT"}, {"soir.eaf", "<x/>"}});
  const auto fault = [&](const json& parameters) { return fault_of(preview_of(api, upload, parameters)); };
  EXPECT_THAT(fault(json::object()), StartsWith("400 bad_input: file: "));
  EXPECT_EQ(fault({{"file", "other.bvh"}}), "404 not_found: file: the upload has no file 'other.bvh'; put it first");
  EXPECT_THAT(fault({{"file", "../soir.bvh"}}), StartsWith("400 bad_input: '../soir.bvh' is not a plain file name"));
  EXPECT_THAT(fault({{"file", "wrong.bvh"}}), StartsWith("400 bad_input: wrong.bvh:2: "));
  EXPECT_THAT(fault({{"file", "soir.eaf"}}), StartsWith("422 unsupported: soir.eaf: "));
  EXPECT_THAT(fault({{"file", "soir.bvh"}, {"unit", "miles"}}), StartsWith("400 bad_input: unit: "));
  EXPECT_THAT(fault({{"file", "soir.bvh"}, {"rig", "parts.rig"}}), StartsWith("404 not_found: rig: "));
  EXPECT_THAT(fault({{"file", "soir.bvh"}, {"colour", "red"}}), HasSubstr("colour"));
  EXPECT_THAT(fault_of(preview_of(api, "nowhere", {{"file", "soir.bvh"}})), StartsWith("404 not_found: no upload"));
}

TEST(Preview, RequiresAWritableDatabase) {
  TestApi api(false);
  EXPECT_THAT(fault_of(preview_of(api, "any", {{"file", "soir.bvh"}})), StartsWith("403 read_only: "));
}

TEST(Preview, EndsWhenItsTimeIsOver) {
  TestApi api(true, {.sign_time = Milliseconds(0)});
  const std::string upload = upload_of(api, {{"soir.bvh", slow_bvh()}});
  EXPECT_EQ(fault_of(preview_of(api, upload, {{"file", "soir.bvh"}})),
            "503 cancelled: the call took longer than the server allows; ask for less");
}

}  // namespace
}  // namespace signweave::server
