#include "signweave/notation/utterance.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "signweave/core/error.h"

namespace signweave {
namespace {

using testing::HasSubstr;

std::string fault_in_utterance(const std::string& text) {
  try {
    parse_utterance(text);
  } catch (const Error& error) {
    return error.what();
  }
  return "no fault";
}

GlossRef only_gloss(const std::string& text) {
  const Utterance utterance = parse_utterance(text);
  EXPECT_EQ(utterance.places.size(), 1u) << text;
  return utterance.places.at(0).gloss;
}

TEST(Utterance, GlossesAreSeparatedByBlanksOfAnyKind) {
  const Utterance utterance = parse_utterance("  MATIN\tNUAGES\n PLUIE ");
  ASSERT_EQ(utterance.places.size(), 3u);
  EXPECT_EQ(utterance.places[1].gloss.gloss, "NUAGES");
}

TEST(Utterance, OnlyDoubleQuotesQuoteAndTheirContentIsLiteral) {
  EXPECT_EQ(only_gloss("AUJOURD'HUI").gloss, "AUJOURD'HUI");
  EXPECT_EQ(only_gloss("\"LE MANS\""), (GlossRef{"LE MANS", 0}));
  EXPECT_EQ(only_gloss("\"LE MANS\"#2"), (GlossRef{"LE MANS", 2}));
  EXPECT_EQ(only_gloss("\"A#3\""), (GlossRef{"A#3", 0}));
  EXPECT_EQ(only_gloss("\"a\\b 'c'\"").gloss, "a\\b 'c'");
}

TEST(Utterance, GlossesOfRealCorporaNeedNoQuotes) {
  EXPECT_EQ(only_gloss("#BANK").gloss, "#BANK");
  EXPECT_EQ(only_gloss("$INDEX1").gloss, "$INDEX1");
  EXPECT_EQ(only_gloss("A=B").gloss, "A=B");
  EXPECT_EQ(only_gloss("MATIN#3"), (GlossRef{"MATIN", 3}));
  EXPECT_EQ(only_gloss("#3").gloss, "#3");
  EXPECT_EQ(only_gloss("手話").gloss, "手話");
  EXPECT_EQ(only_gloss("gloss@A").gloss, "gloss@A");
}

TEST(Utterance, APieceOfARecordingIsNamedInMilliseconds) {
  const Place place = parse_utterance("\"ISL Thanks\"@1200..3400").places.at(0);
  EXPECT_EQ(place.kind, Place::Kind::piece);
  EXPECT_EQ(place.recording, "ISL Thanks");
  EXPECT_EQ(place.span, (TimeSpan{1'200ms, 3'400ms}));
  EXPECT_EQ(parse_utterance("meteo@0..100").places.at(0).recording, "meteo");
}

TEST(Utterance, CommasAndFullStopsAloneArePausesBetweenSigns) {
  const Utterance utterance = parse_utterance(". A , B . C \",\" .");
  ASSERT_EQ(utterance.places.size(), 4u);
  EXPECT_EQ(utterance.places[0].pause_before, 0ms);
  EXPECT_EQ(utterance.places[1].pause_before, kComma);
  EXPECT_EQ(utterance.places[2].pause_before, kFullStop);
  EXPECT_EQ(utterance.places[3].gloss.gloss, ",");
}

TEST(Utterance, ErrorsNameTheColumnAndTheFix) {
  EXPECT_THAT(fault_in_utterance("A \"LE MANS"), HasSubstr("utterance:1:3: a quote is opened here and never closed"));
  EXPECT_THAT(fault_in_utterance(""), HasSubstr("no sign in it"));
  EXPECT_THAT(fault_in_utterance(" , ."), HasSubstr("no sign in it"));
  EXPECT_THAT(fault_in_utterance("MATIN#0"), HasSubstr("counted from 1"));
  EXPECT_THAT(fault_in_utterance("\"A\"#x"), HasSubstr("neither #TOKEN nor @BEGIN..END"));
  EXPECT_THAT(fault_in_utterance("\"A\"@500..400"), HasSubstr("must end after it begins"));
  EXPECT_THAT(fault_in_utterance("\"  \""), HasSubstr("an empty name"));
}

TEST(Utterance, ColumnsCountCharacters) {
  EXPECT_THAT(fault_in_utterance("手話 É \"LE MANS"), HasSubstr("utterance:1:6: a quote"));
}

TEST(UtteranceText, SaysWhereEachPlaceIsInBytes) {
  const UtteranceText read = read_utterance(" 手話#2 , \"LE MANS\" r@1..20 .");
  EXPECT_EQ(read.utterance, parse_utterance("手話#2 , \"LE MANS\" r@1..20"));
  EXPECT_EQ(read.spans, (std::vector<WordSpan>{{1, 9}, {12, 21}, {22, 29}}));
  EXPECT_EQ(read.pause_after, kFullStop);
  EXPECT_TRUE(read.faults.empty());
}

TEST(UtteranceText, ReportsEveryFaultWithItsWordAndReadsTheRest) {
  const UtteranceText read = read_utterance("A É#0 B \"C\"x , \"\" r@5..5 D \"E F");
  EXPECT_EQ(read.utterance, parse_utterance("A B , D"));
  std::vector<std::string> faults;
  for (const UtteranceFault& fault : read.faults) {
    faults.push_back(std::string(name_of(fault.kind)) + ' ' + std::to_string(fault.at.begin) + ' ' +
                     std::to_string(fault.at.end));
  }
  EXPECT_EQ(faults, (std::vector<std::string>{"token_zero 2 6", "bad_suffix 9 13", "empty_name 16 18",
                                              "piece_order 19 25", "open_quote 28 32"}));
}

TEST(UtteranceText, WithoutASignIsNoFault) {
  EXPECT_TRUE(read_utterance(" \t ").faults.empty());
  EXPECT_EQ(read_utterance(", .").pause_after, kFullStop);
  EXPECT_EQ(read_utterance(std::string(1'000'001, 'A')).faults.at(0).kind, UtteranceFault::Kind::too_long);
}

TEST(UtteranceText, AFaultNamesTheWordThatWouldBeRight) {
  const auto replacement = [](const std::string& text) { return read_utterance(text).faults.at(0).replacement; };
  EXPECT_EQ(replacement("A \"LE MANS"), "\"LE MANS\"");
  EXPECT_EQ(replacement("MATIN#0 B"), "MATIN");
  EXPECT_EQ(replacement("A \""), "");
  EXPECT_EQ(replacement("r@5..5"), "");
}

TEST(UtteranceText, ReportsOnlySoManyFaults) {
  std::string text;
  for (int i = 0; i < 100; ++i) text += "A#0 B ";
  const UtteranceText read = read_utterance(text);
  EXPECT_EQ(read.faults.size(), kMostUtteranceFaults);
  EXPECT_EQ(read.utterance.places.size(), 100u);
}

RC_GTEST_PROP(Utterance, PrintedTextParsesToTheSameUtterance, ()) {
  const auto name = rc::gen::nonEmpty(
      rc::gen::container<std::string>(rc::gen::element('A', 'b', '#', '3', '@', '.', ',', '\'', ' ')));
  Utterance utterance;
  const int count = *rc::gen::inRange(1, 6);
  for (int i = 0; i < count; ++i) {
    Place place;
    std::string text = *name;
    RC_PRE(text.find_first_not_of(' ') != std::string::npos);
    if (*rc::gen::arbitrary<bool>()) {
      place.gloss = {text, *rc::gen::inRange<std::size_t>(0, 4)};
    } else {
      place.kind = Place::Kind::piece;
      place.recording = text;
      place.span.begin = Milliseconds(*rc::gen::inRange(0, 100));
      place.span.end = place.span.begin + Milliseconds(*rc::gen::inRange(1, 100));
    }
    if (i > 0) place.pause_before = *rc::gen::element(0ms, kComma, kFullStop);
    utterance.places.push_back(place);
  }
  RC_ASSERT(parse_utterance(to_string(utterance)) == utterance);
}

}  // namespace
}  // namespace signweave
