#include "app/wire/read.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "app/wire/call_schema.h"
#include "signweave/calls/change_calls.h"
#include "signweave/calls/export_call.h"
#include "signweave/calls/import_call.h"
#include "signweave/calls/query_call.h"
#include "signweave/calls/synthesis_call.h"
#include "signweave/core/error.h"

namespace signweave::wire {
namespace {

using namespace calls;

using nlohmann::json;
using testing::HasSubstr;

template <class Call, class Source>
std::string fault_of(const Source& source) {
  try {
    read_call<Call>(source);
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

TEST(ReadCall, FieldsNotGivenKeepTheirDefaults) {
  const SignCall call = read_call<SignCall>(json{{"utterance", "VANNES"}});
  EXPECT_EQ(call.utterance, "VANNES");
  EXPECT_EQ(call.how.transition, transition_methods().front().name);
  EXPECT_EQ(call.how.tempo, 1);
}

TEST(ReadCall, JsonAndTextsGiveTheSameCall) {
  const ImportCall from_json = read_call<ImportCall>(
      json{{"sign_tier", {"Gloss:right", "Gloss:left"}}, {"offset_ms", -12.5}, {"mirror", true}, {"unit", 0.01}});
  const ImportCall from_texts = read_call<ImportCall>(
      Texts{{"sign_tier", "Gloss:right,Gloss:left"}, {"offset_ms", "-12.5"}, {"mirror", ""}, {"unit", "0.01"}});
  for (const ImportCall& call : {from_json, from_texts}) {
    EXPECT_EQ(call.sign_tiers, (std::vector<std::string>{"Gloss:right", "Gloss:left"}));
    EXPECT_EQ(call.offset_ms, -12.5);
    EXPECT_TRUE(call.reading.mirror);
    EXPECT_EQ(call.reading.unit, "0.01");
  }
}

TEST(ReadCall, ANumberIsAcceptedForATextOnlyIfTheFieldAllowsIt) {
  EXPECT_EQ(read_call<SignCall>(json{{"utterance", "A"}, {"duration", 300}}).how.duration, "300");
  EXPECT_EQ(read_call<SignCall>(json{{"utterance", "A"}, {"rate", 29.97}}).how.rate, "29.97");
  EXPECT_EQ(fault_of<SignCall>(json{{"utterance", 3}}), "utterance: expected a text, not 3");
}

TEST(ReadCall, JunctionsAreAListOfCommandLineTexts) {
  const SignCall call = read_call<SignCall>(json{{"utterance", "A B C"}, {"junctions", {"1=sine", "2=450ms,x1.5"}}});
  const SynthesisOptions options = options_of(call.how);
  ASSERT_EQ(options.junctions.size(), 2u);
  EXPECT_EQ(options.junctions.at(1).method, find_transition_method("sine"));
  EXPECT_EQ(options.junctions.at(2), (JunctionChoice{nullptr, Milliseconds(450), 1.5}));
  EXPECT_TRUE(options_of(read_call<SignCall>(json{{"utterance", "A"}}).how).junctions.empty());
  EXPECT_THAT(fault_of<SignCall>(json{{"utterance", "A"}, {"junctions", {"1=hermit"}}}),
              HasSubstr("junctions: 'hermit' is not a method"));
  EXPECT_THAT(fault_of<EditCall>(json{{"recording", "x"}, {"junctions", {1}}}),
              HasSubstr("junctions: expected a list of texts, not 1 in it"));
  EXPECT_THROW(options_of(read_call<SignCall>(json{{"utterance", "A"}, {"junctions", {"1=sine", "1=x2"}}}).how), Error);
}

TEST(ReadCall, FaultsNameTheField) {
  EXPECT_THAT(fault_of<QueryCall>(json{{"limit", 3}}), HasSubstr("text: missing"));
  EXPECT_THAT(fault_of<QueryCall>(json{{"text", "x"}, {"limit", -1}}),
              HasSubstr("limit: expected a whole number from 1"));
  EXPECT_THAT(fault_of<QueryCall>(json{{"text", "x"}, {"limit", 1.5}}), HasSubstr("not 1.5"));
  EXPECT_THAT(fault_of<QueryCall>(json{{"text", "x"}, {"timeout_ms", 18446744073709551615u}}),
              HasSubstr("timeout_ms: expected"));
  EXPECT_THAT(fault_of<QueryCall>(json{{"text", "x"}, {"explain", 1}}), HasSubstr("expected true or false, not 1"));
  EXPECT_THAT(fault_of<QueryCall>(json{{"text", nullptr}}), HasSubstr("expected a text, not null"));
  EXPECT_THAT(fault_of<SignCall>(json{{"utterance", "A"}, {"tempo", 5}}),
              HasSubstr("tempo: expected a number from 0.25"));
  EXPECT_THAT(fault_of<SignCall>(json{{"utterance", "A"}, {"duration", "soon"}}),
              HasSubstr("duration: 'soon' is neither"));
  EXPECT_THAT(fault_of<RelayoutCall>(json{{"recordings", "meteo"}}), HasSubstr("recordings: expected a list of texts"));
  EXPECT_THAT(fault_of<RelayoutCall>(json{{"compact", 1000}}), HasSubstr("compact: '1000' is not a distance"));
  EXPECT_THAT(fault_of<RelayoutCall>(json{{"acces_mode", "full"}}), HasSubstr("did you mean access_mode?"));
}

TEST(ReadCall, FieldsOfThePathAreNotAcceptedElsewhere) {
  EXPECT_EQ(read_call<RemoveCall>(Texts{}, Texts{{"recording", "meteo"}}).recording, "meteo");
  EXPECT_THROW(read_call<RemoveCall>(Texts{{"recording", "x"}}, Texts{{"recording", "meteo"}}), Error);
}

TEST(ReadCall, AFormerNameIsAcceptedWithOneNotice) {
  for (const bool texts : {false, true}) {
    std::vector<Notice> notices;
    const ExportCall call =
        texts ? read_call<ExportCall>(Texts{{"recording", "meteo"}, {"remake", "1..2,4..5"}}, {}, &notices)
              : read_call<ExportCall>(json{{"recording", "meteo"}, {"remake", {"1..2", "4..5"}}}, {}, &notices);
    EXPECT_EQ(call.regenerate, (std::vector<std::string>{"1..2", "4..5"}));
    EXPECT_THAT(notices, testing::ElementsAre(Notice{.where = "", .text = "'remake' is now 'regenerate'"}));
  }
  EXPECT_EQ(fault_of<ExportCall>(json{{"recording", "meteo"}, {"remake", {"1..2"}}, {"regenerate", {"1..2"}}}),
            "regenerate: also given as 'remake', its former name");
  EXPECT_THAT(fault_of<ExportCall>(json{{"recording", "meteo"}, {"remak", {"1..2"}}}),
              testing::Not(HasSubstr("did you mean remake")));
  EXPECT_EQ(schema_of_call<ExportCall>().properties["remake"]["deprecated"], true);
}

TEST(ParseBody, FaultsHaveLineAndColumn) {
  const auto fault = [](std::string_view text) -> std::string {
    try {
      parse_body(text);
    } catch (const Error& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_THAT(fault("{\"é\": 1,\n \"b\" 2}"), HasSubstr("body:2:6: this is not JSON"));
  EXPECT_THAT(fault("{\"a\": "), HasSubstr("it ends too early"));
  EXPECT_THAT(fault("{\"a\": 1e999}"), HasSubstr("out of range"));
  EXPECT_EQ(parse_body(" \n"), json::object());
}

TEST(ParseBody, TooDeepNestingIsRefusedBeforeParsing) {
  const auto nested = [](std::size_t depth) { return std::string(depth, '[') + std::string(depth, ']'); };
  EXPECT_EQ(parse_body(nested(64)).size(), 1u);
  EXPECT_EQ(parse_body("{\"\\\"" + nested(200'000) + "\": \"" + nested(100) + "\"}").size(), 1u) << "in texts";
  for (const std::string& text : {nested(65), std::string(200'000, '['), "{\"a\":\n" + nested(200'000) + "}"}) {
    try {
      parse_body(text);
      ADD_FAILURE() << text.substr(0, 100);
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ErrorCode::bad_input);
      EXPECT_THAT(error.what(), HasSubstr("nested deeper than 64"));
    }
  }
}

TEST(SchemaOfCall, GivesTypesBoundsAndDefaults) {
  const SchemaWriter sign = schema_of_call<SignCall>();
  EXPECT_EQ(sign.required, std::vector<std::string>{"utterance"});
  EXPECT_EQ(sign.properties["tempo"]["type"], "number");
  EXPECT_EQ(sign.properties["tempo"]["maximum"], 4.0);
  EXPECT_EQ(sign.properties["tempo"]["default"], 1.0);
  EXPECT_EQ(sign.properties["duration"]["type"], (nlohmann::ordered_json{"string", "number"}));
  EXPECT_EQ(sign.properties["align"]["enum"], (nlohmann::ordered_json{"auto", "ground", "none"}));
  EXPECT_EQ(schema_of_call<ImportCall>().properties["sign_tier"]["items"]["type"], "string");
}

}  // namespace
}  // namespace signweave::wire
