#include "app/server/api.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "app/server/test_api.h"

namespace signweave::server {
namespace {

using nlohmann::json;
using testing::HasSubstr;
using testing::StartsWith;

/// Shared by all tests that change nothing.
TestApi& reading() {
  static TestApi api(false);
  return api;
}

TEST(Api, ListsTheServedDatabases) {
  const json list = json_in(reading().get({"databases"}))["databases"];
  ASSERT_EQ(list.size(), 1u);
  EXPECT_THAT(list[0]["declarations"].dump(), HasSubstr("placeholder shapes"));
  json row = list[0];
  row.erase("declarations");
  EXPECT_EQ(row, (json{{"name", "demo"}, {"writable", false}, {"recordings", 2}}));
}

TEST(Api, AWrongPathIsNotFoundWithNearMatches) {
  EXPECT_THAT(fault_of(reading().get({"databases", "dem"})), StartsWith("404 not_found: no database 'dem'"));
  EXPECT_THAT(fault_of(reading().get({"databases", "dem"})), HasSubstr("did you mean demo?"));
  EXPECT_THAT(fault_of(reading().get(at({"qery"}))), HasSubstr("did you mean /api/databases/demo/query"));
  EXPECT_THAT(fault_of(reading().get({})), StartsWith("404"));
}

TEST(Api, AnErrorForAWrongMethodListsTheAllowedOnes) {
  const ApiResponse response = reading().send("PATCH", at({"query"}));
  EXPECT_THAT(fault_of(response), StartsWith("405 method_not_allowed"));
  EXPECT_EQ(header_of(response, "Allow"), "GET, POST");
}

TEST(Api, QueriesAreAnsweredAsTheCommandLineDoes) {
  const ApiResponse response = reading().get(at({"query"}), {{"text", "gloss = \"VANNES\""}, {"limit", "2"}});
  ASSERT_EQ(response.status, 200);
  const json answers = json_in(response);
  ASSERT_EQ(answers.size(), 2u);
  EXPECT_EQ(answers[0]["name"], "VANNES");
  EXPECT_EQ(answers[0]["tier"], "Gloss");
  EXPECT_EQ(answers[0]["recording"], "villes");
  EXPECT_EQ(answers, json_in(reading().send("POST", at({"query"}), {{"text", "gloss = \"VANNES\""}, {"limit", 2}})));
  const ApiResponse csv = reading().get(at({"query"}), {{"text", "gloss = \"VANNES\""}, {"format", "csv"}});
  EXPECT_THAT(csv.body, StartsWith("recording,tier,name,begin ms,end ms\nvilles,Gloss,VANNES,"));
  EXPECT_EQ(csv.content_type, "text/csv; charset=utf-8");
  EXPECT_THAT(json_in(reading().get(at({"query"}), {{"text", "phase = stroke"}, {"explain", "true"}}))["plan"].dump(),
              HasSubstr("stroke"));
}

TEST(Api, AnErrorInAQueryHasItsPosition) {
  const ApiResponse response = reading().get(at({"query"}), {{"text", "gloss = "}});
  EXPECT_THAT(fault_of(response), StartsWith("400 bad_input: query:1:9"));
  EXPECT_EQ(json_in(response)["error"]["caret"], "gloss = \n        ^");
}

TEST(Api, ResultsBuiltFromPlaceholdersAreDeclared) {
  for (const auto& [path, query] : std::vector<std::pair<Path, std::map<std::string, std::string>>>{
           {{"databases"}, {}},
           {{"databases", "demo"}, {}},
           {at({"query"}), {{"text", "gloss = \"VANNES\""}}},
           {at({"stats"}), {}},
           {at({"recordings", "meteo"}), {}},
           {at({"recordings", "meteo", "motion"}), {{"from", "1000"}, {"to", "1100"}}},
           {at({"recordings", "meteo", "annotation"}), {}},
           {at({"recordings", "meteo", "segment"}), {}}}) {
    EXPECT_THAT(header_of(reading().get(path, query), "Signweave-Declarations"), HasSubstr("placeholder shapes"))
        << testing::PrintToString(path);
  }
  const json report = json_in(reading().send("POST", at({"sign"}), {{"utterance", "VANNES"}}));
  EXPECT_THAT(report["declarations"].dump(), HasSubstr("placeholder shapes"));
}

TEST(Api, UnknownFieldsAndWrongValuesAreNamed) {
  const auto fault = [](std::map<std::string, std::string> query) {
    return fault_of(reading().get(at({"query"}), std::move(query)));
  };
  EXPECT_EQ(fault({{"text", "phase = stroke"}, {"limt", "2"}}), "400 bad_input: no field 'limt'; did you mean limit?");
  EXPECT_THAT(fault({}), StartsWith("400 bad_input: text: missing"));
  EXPECT_THAT(fault({{"text", "phase = stroke"}, {"limit", "0"}}), HasSubstr("limit: expected a number from 1"));
  EXPECT_THAT(fault({{"text", "phase = stroke"}, {"limit", "x"}}), HasSubstr("limit: expected a whole number"));
  EXPECT_THAT(fault({{"text", "phase = stroke"}, {"explain", "perhaps"}}), HasSubstr("explain: expected true or"));
  EXPECT_THAT(fault({{"text", "phase = stroke"}, {"format", "csw"}}), HasSubstr("did you mean csv?"));
  EXPECT_THAT(fault_of(reading().get({"databases"}, {{"x", "1"}})), StartsWith("400 bad_input: no field 'x'"));
}

TEST(Api, ABodyMustBeJsonAndDeclareIt) {
  ApiRequest request{.method = "POST", .path = at({"sign"}), .body = "{\n  \"utterance\": VANNES}"};
  request.content_type = "text/plain";
  EXPECT_THAT(fault_of(reading().api().answer(request)), StartsWith("415 unsupported_media_type"));
  request.content_type = "application/json; charset=utf-8";
  EXPECT_THAT(fault_of(reading().api().answer(request)), StartsWith("400 bad_input: body:2:"));
  request.body = "[1]";
  EXPECT_THAT(fault_of(reading().api().answer(request)), StartsWith("400 bad_input: expected a JSON object"));
  request.body = std::string(100'000, '[');
  EXPECT_THAT(fault_of(reading().api().answer(request)), StartsWith("400 bad_input: body:1:65"));
}

TEST(Api, SignsAReportOrAFile) {
  const json report = json_in(reading().send("POST", at({"sign"}), {{"utterance", "VANNES MATIN"}, {"tempo", 1.5}}));
  EXPECT_EQ(report["signs"].size(), 2u);
  EXPECT_EQ(report["junctions"].size(), 1u);
  const auto file = [&](const char* format) {
    return reading().send("POST", at({"sign"}), {{"utterance", "VANNES MATIN"}, {"format", format}});
  };
  EXPECT_THAT(file("bvh").body, StartsWith("HIERARCHY"));
  EXPECT_THAT(file("glb").body, StartsWith("glTF"));
  EXPECT_THAT(file("eaf").body, HasSubstr("<ANNOTATION_DOCUMENT"));
  EXPECT_THAT(file("svg").body, HasSubstr("placeholder shapes"));
  EXPECT_THAT(file("csv").body, StartsWith("frame,time_s,"));
  EXPECT_THAT(file("rotations.csv").body, StartsWith("frame,time_s,Hips.tx,"));
  EXPECT_THAT(fault_of(file("fbx")),
              StartsWith("400 bad_input: format: 'fbx' is none of bvh, glb, gltf, eaf, json, csv, "
                         "rotations.csv, face.csv, svg, frames"));
  EXPECT_EQ(json_in(file("json"))["motion"]["frames"], json_in(file("json"))["frames"]);
  EXPECT_EQ(header_of(file("glb"), "Content-Disposition"), "attachment; filename*=UTF-8''signing.glb");
  ApiRequest accepting{.method = "POST", .path = at({"sign"}), .content_type = "application/json"};
  accepting.accept = "model/gltf-binary;q=0.9, */*";
  accepting.body = R"({"utterance": "VANNES"})";
  EXPECT_EQ(reading().api().answer(accepting).content_type, "model/gltf-binary");
  accepting.accept = "application/json, text/plain, */*";
  EXPECT_EQ(reading().api().answer(accepting).content_type, "application/json");
}

TEST(Api, JunctionsAreMadeAsRequested) {
  const json sign = {{"utterance", "VANNES MATIN PLUIE"}, {"junctions", {"2=sine,450ms,x1.5"}}};
  const json made = json_in(reading().send("POST", at({"sign"}), sign))["junctions"];
  ASSERT_EQ(made.size(), 2u);
  EXPECT_FALSE(made[0].contains("chosen"));
  EXPECT_EQ(made[1]["number"], 2);
  EXPECT_EQ(made[1]["method"], "sine");
  EXPECT_EQ(made[1]["chosen"], (json{{"method", "sine"}, {"duration_ms", 450}, {"tempo", 1.5}}));
  EXPECT_EQ(made[1]["frames"]["end"].get<int>() - made[1]["frames"]["begin"].get<int>(), 30);
  const auto fault = [&](const char* junction) {
    return fault_of(reading().send("POST", at({"sign"}), {{"utterance", "VANNES MATIN"}, {"junctions", {junction}}}));
  };
  EXPECT_THAT(fault("1=sin"), StartsWith("400 bad_input: junctions: 'sin' is not a method"));
  EXPECT_THAT(fault("3=sine"), StartsWith("400 bad_input: no junction 3"));
}

/// A score sent with some parameters.
ApiResponse sent_score(const std::string& score, std::map<std::string, std::string> query = {}) {
  return reading().api().answer({.method = "POST",
                                 .path = at({"score"}),
                                 .query = std::move(query),
                                 .content_type = "application/json",
                                 .body = score});
}

TEST(Api, ReturnsScoresAndRendersThem) {
  const auto signed_as = [](const char* format) {
    return reading().send("POST", at({"sign"}), {{"utterance", "VANNES MATIN PLUIE"}, {"format", format}}).body;
  };
  const std::string score = signed_as("score");
  EXPECT_EQ(sent_score(score, {{"format", "bvh"}}).body, signed_as("bvh"));
  EXPECT_EQ(sent_score(score, {{"format", "eaf"}}).body, signed_as("eaf"));
  const json report = json_in(sent_score(score));
  EXPECT_EQ(report["signs"][2]["place"], 2);
  EXPECT_EQ(report["junctions"][1]["to_clip"], 2);
  EXPECT_THAT(report["declarations"].dump(), HasSubstr("not LSF"));
  const ApiResponse part = sent_score(score, {{"format", "bvh"}, {"frames", "10..30"}});
  EXPECT_THAT(part.body, HasSubstr("Frames: 20"));
  const auto header = [](const auto& one) { return one.first == "Signweave-Declarations"; };
  EXPECT_TRUE(std::ranges::any_of(part.headers, header));
}

TEST(Api, RefusesScoresThatCannotBeRendered) {
  const std::string score =
      reading().send("POST", at({"sign"}), {{"utterance", "VANNES MATIN"}, {"format", "score"}}).body;
  EXPECT_THAT(fault_of(sent_score("")), HasSubstr("the body must be a score"));
  EXPECT_THAT(fault_of(sent_score("{}")), HasSubstr("score: the whole: it must be a score"));
  EXPECT_THAT(fault_of(sent_score(score, {{"frames", "10..30"}})), HasSubstr("also request a format of motion"));
  EXPECT_THAT(fault_of(sent_score(score, {{"frames", "10..30"}, {"format", "eaf"}})),
              HasSubstr("eaf describes a whole score: omit frames"));
  EXPECT_THAT(fault_of(sent_score(score, {{"frames", "30..10"}, {"format", "bvh"}})), HasSubstr("expected FROM..TO"));
  EXPECT_THAT(fault_of(sent_score(score, {{"frames", "10..99999"}, {"format", "bvh"}})),
              HasSubstr("are not in a score"));
  EXPECT_THAT(fault_of(sent_score(score, {{"tempo", "2"}})), HasSubstr("tempo"));
  json changed = json::parse(score);
  changed["clips"][0]["source"]["fingerprint"] = "1";
  EXPECT_EQ(sent_score(changed.dump()).status, 409);
  changed["clips"][0]["source"]["recording"] = "elsewhere";
  EXPECT_EQ(sent_score(changed.dump()).status, 404);
  TestApi small(false, {.glosses = 1});
  EXPECT_EQ(small.send("POST", at({"score"}), json::parse(score)).status, 413);
  TestApi shorter(false, {.frames = 100});
  EXPECT_EQ(shorter.send("POST", at({"score"}), json::parse(score)).status, 413);
}

TEST(Api, AnUnknownGlossHasNearMatches) {
  const std::string fault = fault_of(reading().send("POST", at({"sign"}), {{"utterance", "VANES"}}));
  EXPECT_THAT(fault, StartsWith("404 not_found"));
  EXPECT_THAT(fault, HasSubstr("VANNES"));
  EXPECT_THAT(fault_of(reading().send("POST", at({"sign"}), {{"utterance", "VANNES"}, {"transition", "gop"}})),
              HasSubstr("transition: 'gop' is none of"));
  EXPECT_THAT(fault_of(reading().send("POST", at({"sign"}), {{"utterance", "VANNES"}, {"signing_space", true}})),
              HasSubstr("svg"));
}

TEST(Api, EditsARecording) {
  const json edit = {{"recording", "meteo"}, {"replace", {"BRETAGNE=VANNES"}}};
  EXPECT_GT(json_in(reading().send("POST", at({"edit"}), edit))["signs"].size(), 10u);
  EXPECT_THAT(fault_of(reading().send("POST", at({"edit"}), {{"recording", "meteo"}})), StartsWith("400 bad_input"));
  EXPECT_THAT(fault_of(reading().send("POST", at({"edit"}), {{"recording", "met"}, {"replace", {"A=B"}}})),
              StartsWith("404 not_found"));
}

TEST(Api, ExportsARecordingOrAPartOfIt) {
  const ApiResponse part =
      reading().get(at({"recordings", "meteo", "motion"}), {{"from", "1000"}, {"to", "2000"}, {"format", "csv"}});
  EXPECT_EQ(std::count(part.body.begin(), part.body.end(), '\n'), 101);
  for (const char* none : {"eaf", "fbx"}) {
    EXPECT_THAT(
        fault_of(reading().get(at({"recordings", "meteo", "motion"}), {{"format", none}})),
        HasSubstr(std::string(none) + "' is none of bvh, glb, gltf, json, csv, rotations.csv, face.csv, svg, frames"));
  }
  EXPECT_THAT(reading().get(at({"recordings", "meteo", "annotation"})).body, HasSubstr("<ANNOTATION_DOCUMENT"));
  EXPECT_THAT(fault_of(reading().get(at({"recordings", "meteo", "motion"}), {{"joints", "LeftHnad"}})),
              HasSubstr("did you mean LeftHand"));
  EXPECT_THAT(fault_of(reading().get(at({"recordings", "mteo", "motion"}))), StartsWith("404 not_found"));
  // The field names are those of the API, not of the command line.
  EXPECT_THAT(fault_of(reading().get(at({"recordings", "meteo", "motion"}), {{"from", "2"}, {"to", "1"}})),
              HasSubstr("'from' must be before 'to'"));
  const auto regenerated = [&](const char* regenerate, const char* transition) {
    return reading().get(at({"recordings", "meteo", "motion"}),
                         {{"from", "1000"}, {"to", "2000"}, {"regenerate", regenerate}, {"transition", transition}});
  };
  EXPECT_THAT(regenerated("1400..1600", "hermite").body, StartsWith("HIERARCHY"));
  EXPECT_THAT(fault_of(regenerated("1400-1600", "hermite")),
              StartsWith("400 bad_input: regenerate: '1400-1600': expected FROM"));
  EXPECT_THAT(fault_of(regenerated("1400..1600", "hermit")), HasSubstr("did you mean hermite"));
  EXPECT_THAT(fault_of(regenerated("1400..2000", "hermite")),
              StartsWith("400 bad_input: regenerate 1400..2000: 3 captured"));
}

TEST(Api, CountsChecksAndEvaluates) {
  EXPECT_EQ(json_in(reading().get(at({"check"}))), (json{{"recordings", 2}, {"faults", json::array()}}));
  EXPECT_THAT(reading().get(at({"stats"}), {{"format", "svg"}}).body, HasSubstr("<svg"));
  EXPECT_THAT(fault_of(reading().get(at({"stats"}), {{"format", "csv"}, {"pairs", ""}, {"glosses", "true"}})),
              HasSubstr("give one of pairs, glosses, ngrams and loci"));
  EXPECT_THAT(fault_of(reading().get(at({"stats"}), {{"recording", "x"}})), StartsWith("404"));
  EXPECT_THAT(fault_of(reading().send("POST", at({"evaluate"}), {{"method", {"gap", "slrp"}}})),
              HasSubstr("no method"));
  EXPECT_THAT(reading().get(at({"recordings", "meteo", "segment"}), {{"format", "eaf"}}).body, HasSubstr("proposed"));
}

TEST(Api, LimitsAreEnforced) {
  TestApi small(true, {.query_time = Milliseconds(5'000),
                       .answers = 3,
                       .sign_time = Milliseconds(0),
                       .glosses = 2,
                       .frames = 300,
                       .upload_bytes = 10,
                       .uploads = 1});
  const ApiResponse bounded = small.get(at({"query"}), {{"text", "phase = stroke"}});
  EXPECT_EQ(json_in(bounded).size(), 3u);
  EXPECT_THAT(header_of(bounded, "Signweave-Notices"), HasSubstr("the first"));
  EXPECT_THAT(fault_of(small.send("POST", at({"sign"}), {{"utterance", "VANNES VANNES VANNES"}})),
              StartsWith("413 too_large"));
  EXPECT_THAT(fault_of(small.send("POST", at({"sign"}), {{"utterance", "VANNES VANNES"}, {"rate", "2000"}})),
              HasSubstr("more than 300 frames"));
  const std::string id = json_in(small.send("POST", at({"uploads"})))["upload"];
  EXPECT_THAT(fault_of(small.send("POST", at({"uploads"}))), StartsWith("503 busy"));
  EXPECT_EQ(small.put(at({"uploads", id, "files", "a.bvh"}), "12345678").status, 200);
  EXPECT_THAT(fault_of(small.put(at({"uploads", id, "files", "b.bvh"}), "123")), StartsWith("413 too_large"));
  EXPECT_EQ(small.put(at({"uploads", id, "files", "a.bvh"}), "1234567890").status, 200);  // replaces the first one
}

TEST(Api, ADatabaseServedForReadingIsNotChanged) {
  for (const auto& [method, path] : std::vector<std::pair<std::string, Path>>{
           {"DELETE", at({"recordings", "meteo"})}, {"POST", at({"relayout"})}, {"POST", at({"uploads"})}}) {
    EXPECT_THAT(fault_of(reading().send(method, path)), StartsWith("403 read_only"));
  }
}

}  // namespace
}  // namespace signweave::server
