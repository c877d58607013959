// Texts read and written for clients: utterances, and annotations with further tiers.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "app/server/test_api.h"
#include "signweave/database/import.h"

namespace signweave::server {
namespace {

using nlohmann::json;
using ::testing::HasSubstr;

json utterance(TestApi& api, const std::string& text) {
  return json_in(api.send("POST", {"utterance"}, {{"text", text}}));
}

TEST(Texts, APlaceOfAnUtteranceHasItsSpanInCharacters) {
  TestApi api(false);
  const json read = utterance(api, "手話#2 , \"LE MANS\" 😀 É@1..20 .");
  EXPECT_EQ(read["places"], json::parse(R"([{"gloss": "手話", "token": 2, "begin": 0, "end": 4},
                            {"gloss": "LE MANS", "pause": "comma", "begin": 7, "end": 16},
                            {"gloss": "😀", "begin": 17, "end": 18},
                            {"recording": "É", "from_ms": 1, "to_ms": 20, "begin": 19, "end": 26}])"));
  EXPECT_EQ(read["pause"], "stop");
  EXPECT_EQ(read["faults"], json::array());
}

TEST(Texts, AFaultOfAnUtteranceHasItsPlaceAndItsRemedy) {
  TestApi api(false);
  const json read = utterance(api, "É A#0 😀 \"LE MANS");
  EXPECT_EQ(read["places"].size(), 2u);
  EXPECT_EQ(read["faults"], json::parse(R"([
      {"code": "token_zero", "message": "tokens are counted from 1", "line": 1, "column": 3, "begin": 2, "end": 5,
       "remedies": [{"parameter": "text", "value": "É A 😀 \"LE MANS"}]},
      {"code": "open_quote", "message": "a quote is opened here and never closed", "line": 1, "column": 9, "begin": 8,
       "end": 16, "remedies": [{"parameter": "text", "value": "É A#0 😀 \"LE MANS\""}]}])"));
  EXPECT_FALSE(utterance(api, "\"\"")["faults"][0].contains("remedies"));
}

TEST(Texts, AnEmptyUtteranceHasNeitherPlacesNorFaults) {
  TestApi api(false);
  EXPECT_EQ(utterance(api, " , "), json::parse(R"({"places": [], "pause": "comma", "faults": []})"));
  EXPECT_EQ(utterance(api, ""), json::parse(R"({"places": [], "faults": []})"));
}

TEST(Texts, AnUtteranceHasTheLimitOfSigning) {
  TestApi api(false, {.glosses = 2});
  EXPECT_EQ(utterance(api, "A B")["places"].size(), 2u);
  EXPECT_THAT(fault_of(api.send("POST", {"utterance"}, {{"text", "A B C"}})), HasSubstr("413 too_large"));
}

constexpr const char* kTiers = R"({"tiers": [{"name": "New", "type": "note",
    "annotations": [{"begin_ms": 100, "end_ms": 200, "label": "x"}]}]})";

TEST(Texts, TiersAreWrittenIntoTheStoredAnnotationWhichStays) {
  TestApi api(false);
  const Path annotation = at({"recordings", "meteo", "annotation"});
  const std::string before = api.get(annotation).body;
  const ApiResponse made = api.send("POST", annotation, json::parse(kTiers));
  ASSERT_EQ(made.status, 200) << made.body;
  EXPECT_EQ(made.content_type, "application/xml");
  EXPECT_THAT(header_of(made, "Signweave-Declarations"), HasSubstr("not LSF"));
  const AnnotationDocument document = eaf::read_text("made.eaf", made.body).document;
  const AnnotationDocument was = eaf::read_text("was.eaf", before).document;
  ASSERT_EQ(document.tiers.size(), was.tiers.size() + 1);
  for (const Tier& tier : was.tiers) EXPECT_EQ(*document.find_tier(tier.id), tier);
  EXPECT_EQ(document.tiers.back().annotations.at(0).span, (TimeSpan{100ms, 200ms}));
  EXPECT_EQ(api.get(annotation).body, before);
}

TEST(Texts, TiersAreWrittenOnlyIntoTheExpectedAnnotation) {
  TestApi api(false);
  const std::string now = json_in(api.get(at({"recordings", "meteo"})))["annotation_fingerprint"];
  const auto write = [&](const std::string& expected) {
    return api.api().answer({.method = "POST",
                             .path = at({"recordings", "meteo", "annotation"}),
                             .query = {{"if_annotation", expected}},
                             .content_type = "application/json",
                             .body = kTiers});
  };
  EXPECT_EQ(write(now).status, 200);
  EXPECT_THAT(fault_of(write("none")), HasSubstr("409 conflict: the annotation of 'meteo' has changed"));
}

TEST(Texts, ARecordingWithoutAnnotationGetsADocumentThatLinksItsMotion) {
  TestApi api(true);
  const ApiResponse motion = api.get(at({"recordings", "meteo", "motion"}), {{"to", "100"}});
  const std::string upload = upload_of(api, {{"bare & new.bvh", motion.body}});
  const std::string job = json_in(api.send("POST", at({"uploads", upload, "import"})))["job"];
  ASSERT_EQ(wait_for(api, job)["state"], "done");
  const ApiResponse made = api.send("POST", at({"recordings", "bare & new", "annotation"}), json::parse(kTiers));
  ASSERT_EQ(made.status, 200) << made.body;
  const AnnotationDocument document = eaf::read_text("made.eaf", made.body).document;
  EXPECT_EQ(document.tiers.at(0).id, "New");
  EXPECT_EQ(document.linked_files.at(0).relative_url, "./bare & new.bvh");
  EXPECT_EQ(document.date.substr(0, 2), "20");
}

}  // namespace
}  // namespace signweave::server
