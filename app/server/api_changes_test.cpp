#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <fstream>
#include <thread>

#include "app/server/test_api.h"

namespace signweave::server {
namespace {

using nlohmann::json;
using testing::HasSubstr;
using testing::StartsWith;

/// A recording that is not in the databases of the tests.
const demo::SyntheticRecording& another() {
  static const demo::SyntheticRecording made = demo::make_recording(demo::corpus_scripts(2).front(), {50, 1}, 7);
  return made;
}
std::string another_bvh() {
  return bvh::write_text(another().motion, bvh::default_layout(another().motion.skeleton()));
}

json import(TestApi& api, const std::string& upload, const json& parameters = json::object()) {
  const ApiResponse begun = api.send("POST", at({"uploads", upload, "import"}), parameters);
  EXPECT_EQ(begun.status, 202) << begun.body;
  return wait_for(api, json_in(begun)["job"]);
}

TEST(ApiChanges, AnUploadIsImported) {
  TestApi api(true);
  const std::string id =
      upload_of(api, {{"soir.bvh", another_bvh()}, {"soir.eaf", eaf::write_text(another().document)}});
  EXPECT_EQ(json_in(api.get(at({"uploads", id})))["files"].size(), 2u);
  const json job = import(api, id, {{"unit", "cm"}});
  EXPECT_EQ(job["state"], "done") << job;
  EXPECT_EQ(job["fraction"], 1);
  const json& recording = job["result"]["recordings"][0];
  EXPECT_EQ(recording["name"], "soir");
  EXPECT_EQ(recording["outcome"], "added");
  EXPECT_THAT(recording["declarations"].dump(), HasSubstr("placeholder"));
  EXPECT_THAT(job.dump(), testing::Not(HasSubstr(api.scratch().string())));
  EXPECT_EQ(json_in(api.get(at({})))["recordings"].size(), 3u);
  EXPECT_THAT(fault_of(api.get(at({"uploads", id}))),
              StartsWith("404"));  // the files are not stored twice after the import
}

json inspect(TestApi& api, const std::string& upload, const json& parameters = json::object()) {
  const ApiResponse begun = api.send("POST", at({"uploads", upload, "inspect"}), parameters);
  EXPECT_EQ(begun.status, 202) << begun.body;
  return wait_for(api, json_in(begun)["job"]);
}

TEST(ApiChanges, AnInspectionReportsWhatAnImportWouldStore) {
  TestApi api(true);
  const std::string id = upload_of(api, {{"soir.bvh", another_bvh()},
                                         {"soir.eaf", eaf::write_text(another().document)},
                                         {"meteo.bvh", another_bvh()},
                                         {"wrong.bvh", "HIERARCHY\nROOT"}});
  const json job = inspect(api, id);
  ASSERT_EQ(job["state"], "done") << job;
  EXPECT_THAT(job.dump(), testing::Not(HasSubstr(api.scratch().string())));
  const json& found = job["result"]["recordings"];
  ASSERT_EQ(found.size(), 3u) << found;
  EXPECT_EQ(found[0]["name"], "meteo");
  EXPECT_EQ(found[0]["known"], true);
  EXPECT_EQ(found[0]["files"]["motion"], "meteo.bvh");
  EXPECT_EQ(found[0]["files"]["face"], nullptr);
  const json& soir = found[1];
  EXPECT_EQ(soir["known"], false);
  EXPECT_EQ(soir["files"]["annotation"], "soir.eaf");
  EXPECT_EQ(soir["frames"], another().motion.frame_count());
  EXPECT_EQ(soir["layout"]["up"], "y");
  EXPECT_EQ(soir["rig"]["parts"]["head"]["joint"], "Head");
  EXPECT_EQ(soir["joints"].size(), another().motion.skeleton().joint_count());
  EXPECT_GT(soir["signs"].get<int>(), 0);
  EXPECT_GT(soir["phases"].get<int>(), soir["signs"].get<int>());
  std::map<std::string, std::string> roles;
  for (const json& tier : soir["tiers"]) roles[tier["tier"]] = tier["role"];
  EXPECT_EQ(roles["Gloss"], "signs");
  EXPECT_EQ(roles["Phase"], "phases");
  EXPECT_THAT(soir["declarations"].dump(), HasSubstr("placeholder"));
  EXPECT_THAT(found[2]["error"].get<std::string>(), StartsWith("wrong.bvh:2: "));
  EXPECT_EQ(api.database().contents()->recordings.size(), 2u);  // nothing was stored
  EXPECT_EQ(json_in(api.get(at({"uploads", id})))["files"].size(), 4u);
  for (const auto& entry : std::filesystem::recursive_directory_iterator(api.scratch())) {
    EXPECT_NE(entry.path().extension(), ".inspected");
  }

  // With corrected parameters it is reported again.
  const json again = inspect(
      api, id, {{"unit", "m"}, {"sign_tier", json::array({"Gloss:right"})}, {"recordings", json::array({"soir"})}});
  ASSERT_EQ(again["result"]["recordings"].size(), 1u);
  EXPECT_EQ(again["result"]["recordings"][0]["layout"]["unit"], 1.0);
  EXPECT_EQ(again["result"]["recordings"][0]["tiers"][0]["hand"], "right");
}

TEST(ApiChanges, AnInspectionReportsWhatAnImportWouldChange) {
  TestApi api(true);
  const std::string bvh = another_bvh();
  const std::string eaf = eaf::write_text(another().document);
  import(api, upload_of(api, {{"a.bvh", bvh}, { "a.eaf", eaf }}));
  const auto plan = [&](const std::vector<std::pair<std::string, std::string>>& files,
                        const json& parameters = json::object()) {
    const json found = inspect(api, upload_of(api, files), parameters)["result"]["recordings"][0];
    EXPECT_FALSE(found.contains("error")) << found;
    return found["plan"];
  };
  EXPECT_EQ(plan({{"b.bvh", bvh}}),
            json({{"recording", "b"}, {"outcome", "added"}, {"changes", {{"motion", "added"}, {"clock", "added"}}}}));
  EXPECT_EQ(plan({{"a.bvh", bvh}, {"a.eaf", eaf}}),
            json({{"recording", "a"}, {"outcome", "unchanged"}, {"changes", json::object()}}));
  AnnotationDocument changed = another().document;
  changed.author = "another author";
  const json replaces = plan({{"a.bvh", bvh}, {"a.eaf", eaf::write_text(changed)}});
  EXPECT_EQ(replaces["outcome"], "annotation replaced");
  EXPECT_EQ(replaces["changes"], json({{"annotation", "replaced"}}));
  const json moves = plan({{"a.eaf", eaf}}, {{"offset_ms", 40}});
  EXPECT_EQ(moves["outcome"], "clock, signer or rig changed");
  EXPECT_EQ(moves["changes"], json({{"clock", "replaced"}}));
  const json refused = plan({{"a.bvh", bvh}}, {{"unit", "m"}});
  EXPECT_EQ(refused["outcome"], "refused");
  EXPECT_THAT(refused["error"].get<std::string>(), StartsWith("a.bvh: is not the motion that recording 'a'"));
  EXPECT_EQ(refused["remedies"], json::parse(R"([{"parameter": "replace_motion", "value": "true"}])"));
  EXPECT_EQ(plan({{"a.bvh", bvh}}, {{"unit", "m"}, {"replace_motion", true}})["outcome"], "motion replaced");
  EXPECT_EQ(api.database().info("a")->motion_facts.layout->unit, 0.01);  // nothing was stored
}

TEST(ApiChanges, SomeRecordingsOfAnUploadAreImportedAndTheOthersLater) {
  TestApi api(true);
  const std::string id = upload_of(api, {{"a.bvh", another_bvh()}, {"b.bvh", another_bvh()}});
  EXPECT_THAT(fault_of(api.send("POST", at({"uploads", id, "import"}), {{"recordings", json::array({"c"})}})),
              HasSubstr("there is no 'c' among these files"));
  const json first = import(api, id, {{"recordings", json::array({"b"})}});
  ASSERT_EQ(first["result"]["recordings"].size(), 1u) << first;
  EXPECT_EQ(first["result"]["recordings"][0]["name"], "b");
  EXPECT_EQ(import(api, id, {{"recordings", json::array({"a"})}, {"up", "z"}})["result"]["recordings"][0]["name"], "a");
  EXPECT_EQ(api.database().contents()->recordings.size(), 4u);
  EXPECT_EQ(api.database().info("a")->motion_facts.layout->up, bvh::UpAxis::z);
  EXPECT_EQ(api.database().info("b")->motion_facts.layout->up, bvh::UpAxis::y);
  EXPECT_EQ(api.send("DELETE", at({"uploads", id})).status, 200);
}

TEST(ApiChanges, AnAnnotationReplacedMeanwhileIsNotOverwritten) {
  TestApi api(true);
  const auto fingerprint = [&] {
    return json_in(api.send("GET", at({"recordings", "a"})))["annotation_fingerprint"].get<std::string>();
  };
  const std::string first = upload_of(api, {{"a.bvh", another_bvh()}, {"a.eaf", eaf::write_text(another().document)}});
  EXPECT_EQ(import(api, first)["result"]["recordings"][0]["outcome"], "added");
  const std::string before = fingerprint();
  AnnotationDocument changed = another().document;
  changed.author = "somebody";
  const std::string theirs = upload_of(api, {{"a.eaf", eaf::write_text(changed)}});
  EXPECT_EQ(import(api, theirs, {{"if_annotation", before}})["result"]["recordings"][0]["outcome"],
            "annotation replaced");
  changed.author = "somebody else";
  const std::string ours = upload_of(api, {{"a.eaf", eaf::write_text(changed)}});
  EXPECT_THAT(fault_of(api.send("POST", at({"uploads", ours, "import"}), {{"if_annotation", "a.eaf"}})),
              HasSubstr("expected annotation_fingerprint"));
  const json looked = inspect(api, ours, {{"if_annotation", before}})["result"]["recordings"][0];
  EXPECT_FALSE(looked.contains("error"));
  EXPECT_EQ(looked["plan"]["outcome"], "refused");
  EXPECT_THAT(looked["plan"]["error"].get<std::string>(), HasSubstr("is no longer " + before));
  EXPECT_EQ(looked["plan"]["remedies"][0]["parameter"], "if_annotation");
  const json refused = import(api, ours, {{"if_annotation", before}})["result"]["recordings"][0];
  EXPECT_EQ(refused["outcome"], "failed");
  EXPECT_THAT(refused["error"].get<std::string>(), HasSubstr("is no longer " + before + " but " + fingerprint()));
}

TEST(ApiChanges, AFileIsRemovedFromAnUpload) {
  TestApi api(true);
  const std::string id = upload_of(api, {{"a.bvh", another_bvh()}, {"b.bvh", "HIERARCHY"}});
  EXPECT_THAT(fault_of(api.send("DELETE", at({"uploads", id, "files", "b.bvj"}))),
              HasSubstr("no file 'b.bvj'; did you mean b.bvh"));
  const json left = json_in(api.send("DELETE", at({"uploads", id, "files", "b.bvh"})));
  ASSERT_EQ(left["files"].size(), 1u);
  EXPECT_EQ(left["files"][0]["file"], "a.bvh");
  const json job = inspect(api, id);
  ASSERT_EQ(job["result"]["recordings"].size(), 1u);
  EXPECT_EQ(import(api, id)["result"]["recordings"][0]["outcome"], "added");
  EXPECT_THAT(fault_of(api.send("DELETE", at({"uploads", id, "files", "a.bvh"}))), StartsWith("404"));
}

TEST(ApiChanges, ATableOfPairsMayGiveARecordingAnotherName) {
  TestApi api(true);
  const std::string id = upload_of(api, {{"a.bvh", another_bvh()}, {"pairs.csv", "a.bvh,,,,,,day 1/a\n"}});
  EXPECT_EQ(inspect(api, id, {{"pairs", "pairs.csv"}})["result"]["recordings"][0]["name"], "day 1/a");
  EXPECT_EQ(import(api, id, {{"pairs", "pairs.csv"}})["result"]["recordings"][0]["name"], "day 1/a");
  EXPECT_TRUE(api.database().info("day 1/a"));
}

TEST(ApiChanges, TiersBothNamedAndDeclaredMissingAreRefused) {
  TestApi api(true);
  const std::string id = upload_of(api, {{"a.eaf", eaf::write_text(another().document)}});
  EXPECT_THAT(fault_of(api.send("POST", at({"uploads", id, "inspect"}),
                                {{"no_phase_tier", true}, {"phase_tier", json::array({"Phase"})}})),
              HasSubstr("no_phase_tier: phase_tier names 'Phase'; give one of the two"));
  const json found = inspect(api, id, {{"no_phase_tier", true}})["result"]["recordings"][0];
  EXPECT_GT(found["signs"].get<int>(), 0);
  EXPECT_EQ(found["phases"], found["signs"]) << found;  // a sign without phases has one stroke
  EXPECT_EQ(inspect(api, id, {{"no_sign_tier", true}})["result"]["recordings"][0]["signs"], 0);
}

TEST(ApiChanges, OnlyTheNewPartOfALongResultIsReturned) {
  TestApi api(true);
  const std::string id = upload_of(api, {{"a.bvh", another_bvh()}, {"b.bvh", "x"}, {"c.bvh", another_bvh()}});
  const json whole = inspect(api, id);
  ASSERT_EQ(whole["result"]["recordings"].size(), 3u);
  const auto from = [&](const char* number) {
    return json_in(api.get({"jobs", whole["job"]}, {{"from", number}}))["result"];
  };
  json rest = whole["result"];
  rest["recordings"].erase(0);
  EXPECT_EQ(from("1"), rest);
  rest["recordings"].clear();
  EXPECT_EQ(from("7"), rest);
  const json list = json_in(api.get({"jobs"}))["jobs"];
  ASSERT_EQ(list.size(), 1u);
  EXPECT_EQ(list[0]["state"], "done");
  EXPECT_FALSE(list[0].contains("result"));
}

TEST(ApiChanges, ErrorsInFilesDoNotContainTheServersFolders) {
  TestApi api(true);
  const json job = import(api, upload_of(api, {{"soir.bvh", "HIERARCHY\nROOT"}}));
  EXPECT_EQ(job["state"], "done");
  EXPECT_EQ(job["result"]["recordings"][0]["outcome"], "failed");
  EXPECT_THAT(job["result"]["recordings"][0]["error"].get<std::string>(), StartsWith("soir.bvh:2: "));
  EXPECT_EQ(api.database().contents()->recordings.size(), 2u);
}

TEST(ApiChanges, OnlyPlainFileNamesAreAccepted) {
  TestApi api(true);
  const std::string id = upload_of(api, {});
  for (const std::string& name : {std::string(".."), std::string("."), std::string("../x.bvh"), std::string("/etc/x"),
                                  std::string("a\\b"), std::string(".hidden"), std::string(""), std::string("a\0b", 3),
                                  std::string("\xff.bvh"), std::string(300, 'a'), std::string("c:x")}) {
    EXPECT_THAT(fault_of(api.put(at({"uploads", id, "files", name}), "x")), StartsWith("400 bad_input")) << name;
  }
  EXPECT_EQ(api.put(at({"uploads", id, "files", "été 天気.bvh"}), "x").status, 200);
  for (const char* name : {"photo.jpg", "film.mp4", "all.zip", "a.bvh.gz", "out.svg"}) {
    EXPECT_THAT(fault_of(api.put(at({"uploads", id, "files", name}), "x")),
                StartsWith(fmt::format("422 unsupported: {}: no import reads files ending in", name)));
  }
  for (const char* name : {"A.BVH", "smile.face.csv", "labels.txt", "labels", "body.rig", "buffer.bin", "spec.xml"}) {
    EXPECT_EQ(api.put(at({"uploads", id, "files", name}), "x").status, 200) << name;
    EXPECT_EQ(api.send("DELETE", at({"uploads", id, "files", name})).status, 200) << name;
  }
  EXPECT_THAT(fault_of(api.send("POST", at({"uploads", id, "import"}), {{"pairs", "../../x"}})), StartsWith("400"));
  EXPECT_THAT(fault_of(api.send("POST", at({"uploads", id, "import"}), {{"rig", "none"}})), StartsWith("404"));
  for (const char* field : {"pairs", "phase_labels", "rig", "skeleton"}) {  // nothing outside the upload is opened
    for (const char* path : {"/etc/passwd", "../x", "/dev/zero"}) {
      EXPECT_THAT(fault_of(api.send("POST", at({"uploads", id, "import"}), {{field, path}})), StartsWith("400"))
          << field << ' ' << path;
    }
  }
  EXPECT_THAT(fault_of(api.send("POST", at({"uploads", id, "import"}), {{"skeleton", "none.asf"}})), StartsWith("404"));
  EXPECT_EQ(api.put(at({"uploads", id, "files", "pairs.csv"}), "/etc/passwd,,x,0\n").status, 200);
  EXPECT_THAT(fault_of(api.send("POST", at({"uploads", id, "import"}), {{"pairs", "pairs.csv"}})),
              HasSubstr("may only name files next to it"));
  EXPECT_THAT(fault_of(api.put(at({"uploads", "0123", "files", "a"}), "x")), StartsWith("404"));
}

TEST(ApiChanges, ABodyInAFileIsMovedOrRemoved) {
  TestApi api(true);
  const std::string id = upload_of(api, {});
  const auto body_in = [&](const char* name) {
    std::ofstream(api.scratch() / name) << "x";
    return api.scratch() / name;
  };
  ApiRequest request{.method = "PUT", .path = at({"uploads", id, "files", "a.bvh"})};
  EXPECT_TRUE(api.api().takes_file(request));
  request.body_file = body_in("one");
  EXPECT_EQ(json_in(api.api().answer(request))["bytes"], 1);
  request.path.back() = "..";
  request.body_file = body_in("two");
  EXPECT_EQ(api.api().answer(request).status, 400);
  EXPECT_FALSE(std::filesystem::exists(api.scratch() / "one"));
  EXPECT_FALSE(std::filesystem::exists(api.scratch() / "two"));
}

TEST(ApiChanges, AnImportThatIsCancelledMidwayChangesNothing) {
  TestApi api(true);
  const std::string id = upload_of(api, {{"soir.bvh", another_bvh()}});
  const std::string job = json_in(api.send("POST", at({"uploads", id, "import"})))["job"];
  for (int i = 0; i < 1'000; ++i) {  // until it is running
    const json state = json_in(api.get({"jobs", job}));
    if (state["fraction"] > 0.0 || state["state"] == "done") break;
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  EXPECT_EQ(api.send("DELETE", {"jobs", job}).status, 202);
  EXPECT_EQ(wait_for(api, job)["state"], "cancelled");
  EXPECT_EQ(api.database().contents()->recordings.size(), 2u);
  EXPECT_EQ(json_in(api.get(at({"check"})))["faults"].size(), 0u);
  EXPECT_EQ(import(api, id)["state"], "done");  // its files still exist
  EXPECT_EQ(api.database().contents()->recordings.size(), 3u);
}

TEST(ApiChanges, ConcurrentReadsContinueDuringAnImport) {
  TestApi api(true);
  const std::string id = upload_of(api, {{"soir.bvh", another_bvh()}});
  std::atomic<bool> over{false};
  std::atomic<int> wrong{0};
  std::vector<std::thread> readers;
  for (int i = 0; i < 2; ++i) {
    readers.emplace_back([&] {
      while (!over) {
        const bool good = api.get(at({"query"}), {{"text", "gloss = \"VANNES\""}}).status == 200 &&
                          api.send("POST", at({"sign"}), {{"utterance", "VANNES"}}).status == 200;
        if (!good) ++wrong;
      }
    });
  }
  EXPECT_EQ(import(api, id)["state"], "done");
  over = true;
  for (std::thread& reader : readers) reader.join();
  EXPECT_EQ(wrong, 0);
}

TEST(ApiChanges, ARecordingIsRemovedButNotWhileAJobChangesTheDatabase) {
  TestApi api(true);
  const std::string id = upload_of(api, {{"soir.bvh", another_bvh()}});
  const std::string job = json_in(api.send("POST", at({"uploads", id, "import"})))["job"];
  EXPECT_THAT(fault_of(api.send("DELETE", at({"recordings", "meteo"}))), StartsWith("409 conflict"));
  EXPECT_THAT(fault_of(api.put(at({"uploads", id, "files", "b.bvh"}), "x")), StartsWith("409 conflict"));
  wait_for(api, job);
  EXPECT_EQ(json_in(api.send("DELETE", at({"recordings", "meteo"}))), (json{{"removed", "meteo"}}));
  EXPECT_THAT(fault_of(api.send("DELETE", at({"recordings", "meteo"}))), StartsWith("404 not_found"));
}

TEST(ApiChanges, MotionsAreStoredInAnotherLayout) {
  TestApi api(true);
  const ApiResponse begun = api.send("POST", at({"relayout"}), {{"access_mode", "by_joint"}});
  ASSERT_EQ(begun.status, 202);
  const json job = wait_for(api, json_in(begun)["job"]);
  EXPECT_EQ(job["result"]["changed"], (json{"meteo", "villes"}));
  EXPECT_EQ(job["result"]["recordings"], 2);
  EXPECT_EQ(job["result"]["faults"], json::array());
  EXPECT_THAT(fault_of(api.send("POST", at({"relayout"}))), StartsWith("400 bad_input: what is to be changed?"));
  EXPECT_THAT(fault_of(api.send("POST", at({"relayout"}), {{"access_mode", "by_john"}})), StartsWith("400"));
  EXPECT_EQ(json_in(api.get({"jobs"}))["jobs"].size(), 1u);
  EXPECT_THAT(fault_of(api.get({"jobs", "9"})), StartsWith("404"));
}

TEST(ApiChanges, AnEvaluationBlocksNoRequestsAndIsCancelled) {
  TestApi api(true);
  const std::string job = json_in(api.send("POST", at({"evaluate"})))["job"];
  EXPECT_THAT(fault_of(api.send("POST", at({"evaluate"}))), StartsWith("409 conflict"));
  EXPECT_EQ(json_in(api.send("DELETE", at({"recordings", "meteo"}))), (json{{"removed", "meteo"}}));
  EXPECT_EQ(api.send("DELETE", {"jobs", job}).status, 202);
  EXPECT_EQ(wait_for(api, job)["state"], "cancelled");
}

TEST(ApiChanges, AnUnfinishedUploadIsRemovedByTheSweep) {
  TestApi api(true, {.upload_idle = Seconds(0)});
  const std::string id = upload_of(api, {});
  upload_of(api, {});
  EXPECT_THAT(fault_of(api.get(at({"uploads", id}))), StartsWith("404"));
  TestApi full(true, {.uploads = 1, .upload_idle = Seconds(3)});  // left by a page that was closed
  const std::string left = upload_of(full, {});
  std::this_thread::sleep_for(std::chrono::milliseconds(600));
  const std::string taken = upload_of(full, {});
  EXPECT_EQ(full.get(at({"uploads", taken})).status, 200);
  EXPECT_THAT(fault_of(full.get(at({"uploads", left}))), StartsWith("404"));
  TestApi slow(true);
  const std::string given_up = upload_of(slow, {{"a.bvh", "x"}});
  EXPECT_EQ(slow.send("DELETE", at({"uploads", given_up})).status, 200);
  EXPECT_TRUE(std::filesystem::is_empty(slow.scratch() / "uploads"));
}

}  // namespace
}  // namespace signweave::server
