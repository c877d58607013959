// Compares the OpenAPI document and docs/http.md with the table of routes and real answers.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <set>
#include <thread>

#include "app/server/openapi.h"
#include "app/server/routes.h"
#include "app/server/test_api.h"
#include "signweave/core/atomic_file.h"
#include "signweave/core/version.h"

namespace signweave::server {
namespace {

using nlohmann::json;
using testing::HasSubstr;

const json& document() {
  static const json parsed = json::parse(Api::openapi());
  return parsed;
}

bool is_of_type(const json& value, const std::string& type) {
  if (type == "object") return value.is_object();
  if (type == "array") return value.is_array();
  if (type == "string") return value.is_string();
  if (type == "boolean") return value.is_boolean();
  if (type == "null") return value.is_null();
  if (type == "integer") return value.is_number_integer();
  return type == "number" && value.is_number();
}

/// Violations of a schema by a value: types, required properties, items, references, values, bounds, alternatives.
void check(const json& value, const json& schema, const std::string& where, std::vector<std::string>& faults) {
  if (schema.contains("$ref")) {
    const std::string pointer = schema["$ref"].get<std::string>().substr(1);
    return check(value, document().at(json::json_pointer(pointer)), where, faults);
  }
  if (schema.contains("type")) {
    const json types = schema["type"].is_array() ? schema["type"] : json::array({schema["type"]});
    const bool fits = std::any_of(types.begin(), types.end(),
                                  [&](const json& type) { return is_of_type(value, type.get<std::string>()); });
    if (!fits) faults.push_back(where + " is no " + types.dump() + " but " + value.dump().substr(0, 60));
  }
  if (schema.contains("enum") &&
      std::find(schema["enum"].begin(), schema["enum"].end(), value) == schema["enum"].end()) {
    faults.push_back(where + " is none of " + schema["enum"].dump());
  }
  for (const json& name : schema.value("required", json::array())) {
    if (!value.is_object() || !value.contains(name.get<std::string>()))
      faults.push_back(where + " has no " + name.dump());
  }
  if (value.is_object()) {
    const json properties = schema.value("properties", json::object());
    for (const auto& [name, of] : value.items()) {
      if (properties.contains(name)) {
        check(of, properties[name], where + "." + name, faults);
      } else if (schema.contains("additionalProperties") && schema["additionalProperties"].is_object()) {
        check(of, schema["additionalProperties"], where + "." + name, faults);
      } else if (!properties.empty() && !schema.contains("additionalProperties")) {
        faults.push_back(where + "." + name + " is not described");
      }
    }
  }
  if (value.is_array() && schema.contains("items")) {
    for (std::size_t i = 0; i < value.size(); ++i) {
      check(value[i], schema["items"], where + "[" + std::to_string(i) + "]", faults);
    }
  }
  if (schema.contains("allOf")) {  // each part describes some of the properties
    json whole = {{"properties", json::object()}, {"required", json::array()}};
    for (const json& part : schema["allOf"]) {
      const json of =
          part.contains("$ref") ? document().at(json::json_pointer(part["$ref"].get<std::string>().substr(1))) : part;
      whole["properties"].update(of.value("properties", json::object()));
      for (const json& name : of.value("required", json::array())) whole["required"].push_back(name);
    }
    check(value, whole, where, faults);
  }
  for (const char* choice : {"oneOf", "anyOf"}) {
    if (!schema.contains(choice)) continue;
    std::size_t fitting = 0;
    for (const json& part : schema[choice]) {
      std::vector<std::string> of_part;
      check(value, part, where, of_part);
      fitting += of_part.empty() ? 1 : 0;
    }
    if (fitting == 0 || (fitting > 1 && schema.contains("oneOf"))) {
      faults.push_back(where + " fits " + std::to_string(fitting) + " alternatives");
    }
  }
}

std::vector<std::string> faults_of(const json& value, const std::string& name) {
  std::vector<std::string> faults;
  check(value, {{"$ref", "#/components/schemas/" + name}}, name, faults);
  if (faults.size() > 5) faults.resize(5);
  return faults;
}

/// A real path for a route of the demo database; nullopt for routes that need an upload or a job.
std::optional<Path> demo_path(const Route& route) {
  Path path;
  for (const std::string_view segment : segments_of(route.path)) {
    if (segment == "{database}") {
      path.emplace_back("demo");
    } else if (segment == "{recording}") {
      path.emplace_back("meteo");
    } else if (segment.starts_with('{')) {
      return std::nullopt;
    } else {
      path.emplace_back(segment);
    }
  }
  return path;
}

TEST(ApiDocument, EveryRouteIsInTheDocumentAndInTheDocs) {
  const std::string docs = read_file(std::string(SIGNWEAVE_SOURCE_DIR) + "/docs/http.md");
  std::size_t operations = 0;
  for (const Route& route : routes()) {
    std::string method(route.method);
    for (char& c : method) c = static_cast<char>(c - 'A' + 'a');
    const json& item = document()["paths"].at("/" + std::string(route.path));
    EXPECT_EQ(item.at(method).at("operationId"), std::string(route.id));
    EXPECT_THAT(docs, HasSubstr("`" + std::string(route.method) + " /api/" + std::string(route.path) + "`"));
    if (!route.answer.empty()) {
      EXPECT_TRUE(document()["components"]["schemas"].contains(route.answer)) << route.answer;
    }
  }
  for (const auto& [path, item] : document()["paths"].items()) operations += item.size();
  EXPECT_EQ(operations, routes().size());
}

TEST(ApiDocument, StatesTheVersionOfTheProgram) {
  EXPECT_EQ(document()["info"]["version"], std::string(version()));
}

TEST(ApiDocument, EveryFieldOfTheParametersIsInTheDocs) {
  const std::string docs = read_file(std::string(SIGNWEAVE_SOURCE_DIR) + "/docs/http.md");
  for (const Route& route : routes()) {
    if (route.parameters == nullptr) continue;
    const wire::SchemaWriter writer = route.parameters();
    for (const auto& [name, schema] : writer.properties.items()) {
      EXPECT_THAT(docs, HasSubstr("`" + name + "`")) << route.id;
    }
  }
}

TEST(ApiDocument, EveryAnswerToGetMatchesItsSchema) {
  TestApi api(false, {.sign_time = Milliseconds(300'000)});  // sanitizers are slow
  std::set<std::string> seen;
  for (const Route& route : routes()) {
    const std::optional<Path> path = demo_path(route);
    if (route.method != "GET" || !path || route.answer.empty()) continue;
    std::map<std::string, std::string> query;
    if (route.id == "query") query = {{"text", "gloss = \"MATIN\" -> gloss = \"BROUILLARD\""}};
    if (route.id == "labels") query = {{"tier", "Phase"}};
    if (route.id == "xpath") query = {{"expression", "//TIER[@TIER_ID = \"Gloss\"]"}, {"limit", "3"}};
    if (route.id == "stats") query = {{"pairs", "true"}, {"glosses", "true"}, {"ngrams", "3"}};
    const ApiResponse response = api.get(*path, query);
    ASSERT_EQ(response.status, 200) << route.id << response.body;
    EXPECT_THAT(faults_of(json_in(response), std::string(route.answer)), testing::IsEmpty()) << route.id;
    seen.insert(std::string(route.id));
  }
  EXPECT_GE(seen.size(), 10u);
}

TEST(ApiDocument, AnEvaluationIsAJobWhoseResultFitsItsSchema) {
  TestApi api(false);
  const Path evaluate{"databases", "demo", "evaluate"};
  const std::string job = json_in(api.send("POST", evaluate, {{"method", {"hermite"}}}))["job"];
  json state;
  do {
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
    state = json_in(api.get({"jobs", job}));
    EXPECT_THAT(faults_of(state, "Job"), testing::IsEmpty());
  } while (state["state"] == "waiting" || state["state"] == "running");
  ASSERT_EQ(state["state"], "done") << state;
  const json& result = state["result"];
  EXPECT_THAT(faults_of(result, "Evaluation"), testing::IsEmpty());
  EXPECT_EQ(result["recordings"], 2);
  EXPECT_EQ(result["tasks"][0]["task"], "given");
  EXPECT_THAT(result["plot"].get<std::string>(), HasSubstr("<svg"));
  EXPECT_THAT(result["declarations"].dump(), HasSubstr("not LSF"));
}

TEST(ApiDocument, EveryRouteRefusesInvalidRequests) {
  TestApi api(true);
  for (const Route& route : routes()) {
    Path path;
    for (const std::string_view segment : segments_of(route.path)) {
      path.emplace_back(segment.starts_with('{') ? "nowhere" : segment);
    }
    const bool named = route.path.find('{') != std::string_view::npos;
    const json body = route.source == Source::body ? json::object() : json(nullptr);
    const ApiResponse missing = api.send(std::string(route.method), path, body);
    if (named) {
      EXPECT_THAT(missing.status, testing::AnyOf(404, 400)) << route.id << missing.body;
      EXPECT_THAT(faults_of(json_in(missing), "Fault"), testing::IsEmpty()) << route.id;
    }
    EXPECT_EQ(
        api.api().answer({.method = std::string(route.method), .path = path, .query = {{"nonsense", "1"}}}).status, 400)
        << route.id;
  }
}

TEST(ApiDocument, AnswersToPostAndErrorsMatchTheirSchemas) {
  TestApi api(true);
  const Path sign = {"databases", "demo", "sign"};
  EXPECT_THAT(
      faults_of(json_in(api.send("POST", sign, {{"utterance", "VANNES MATIN"}, {"explain", true}})), "Synthesis"),
      testing::IsEmpty());
  const json channels =
      json_in(api.send("POST", sign, {{"utterance", R"(VANNES{left hold ..; brows up} MATIN{mouth "matin"})"}}));
  EXPECT_THAT(faults_of(channels, "Synthesis"), testing::IsEmpty());
  EXPECT_EQ(channels["lanes"].size(), 1u) << channels["lanes"];
  EXPECT_EQ(channels["movements"].size(), 2u) << channels["movements"];
  EXPECT_THAT(faults_of(json_in(api.send("POST", {"utterance"}, {{"text", "A , r@1..2 B#0 ."}})), "UtteranceText"),
              testing::IsEmpty());
  const std::string parts = R"([A | weak: B r@1..2 @end-1] C{left hold ..; dominant left; gaze @up} [D | left: rest])";
  EXPECT_THAT(faults_of(json_in(api.send("POST", {"utterance"}, {{"text", parts}})), "UtteranceText"),
              testing::IsEmpty());
  const json score = json_in(api.send("POST", sign, {{"utterance", "VANNES MATIN"}, {"format", "score"}}));
  EXPECT_THAT(faults_of(score, "Score"), testing::IsEmpty());
  EXPECT_THAT(faults_of(json_in(api.send("POST", {"databases", "demo", "score"}, score)), "Synthesis"),
              testing::IsEmpty());
  EXPECT_THAT(faults_of(json_in(api.send("POST", sign)), "Fault"), testing::IsEmpty());
  EXPECT_THAT(faults_of(json_in(api.get({"databases", "demo", "query"}, {{"text", "="}})), "Fault"),
              testing::IsEmpty());
  const json upload = json_in(api.send("POST", {"databases", "demo", "uploads"}));
  EXPECT_THAT(faults_of(upload, "Upload"), testing::IsEmpty());
  const Path file = {"databases", "demo", "uploads", upload["upload"], "files", "a.bvh"};
  EXPECT_THAT(faults_of(json_in(api.put(file, "x")), "UploadedFile"), testing::IsEmpty());
  const json begun = json_in(api.send("POST", {"databases", "demo", "uploads", upload["upload"], "import"}));
  EXPECT_THAT(faults_of(begun, "JobBegun"), testing::IsEmpty());
  EXPECT_THAT(faults_of(json_in(api.get({"jobs", begun["job"]})), "Job"), testing::IsEmpty());
  EXPECT_THAT(faults_of(json_in(api.get({"jobs"})), "Jobs"), testing::IsEmpty());
}

}  // namespace
}  // namespace signweave::server
