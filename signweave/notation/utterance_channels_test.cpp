#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <set>

#include "signweave/core/error.h"
#include "signweave/notation/utterance.h"

namespace signweave {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::StartsWith;

SignRef gloss(std::string name, std::size_t token = 0) {
  return {.kind = SignRef::Kind::gloss, .gloss = {std::move(name), token}, .recording = {}, .span = {}};
}

PlacePart part(BodyPart which, std::vector<SignRef> signs, std::size_t places = 1) {
  PlacePart made{.part = which, .signs = {}, .places = places};
  for (SignRef& sign : signs) made.signs.push_back({std::move(sign), {}});
  return made;
}

std::string fault_in(const std::string& text, const UtteranceWords& words = {}) {
  try {
    return to_string(parse_utterance(text, words));
  } catch (const Error& error) {
    return error.what();
  }
}

/// "KIND BEGIN END" of each fault.
std::vector<std::string> faults_in(const std::string& text, const UtteranceWords& words = {}) {
  std::vector<std::string> rows;
  for (const UtteranceFault& fault : read_utterance(text, words).faults) {
    rows.push_back(std::string(name_of(fault.kind)) + ' ' + std::to_string(fault.at.begin) + ' ' +
                   std::to_string(fault.at.end));
  }
  return rows;
}

std::string mended(const std::string& text, const UtteranceWords& words = {}) {
  const UtteranceFault fault = read_utterance(text, words).faults.at(0);
  return std::string(text).replace(fault.at.begin, fault.at.end - fault.at.begin, fault.replacement);
}

UtteranceWords glosses(std::set<std::string, std::less<>> known) {
  return {.is_gloss = [known = std::move(known)](std::string_view word) { return known.contains(word); },
          .is_expression = {}};
}

std::vector<std::string> names_of(const Utterance& utterance) {
  std::vector<std::string> names;
  for (const Place& place : utterance.places) names.push_back(place.gloss.gloss);
  return names;
}

TEST(UtteranceChannels, ABracketGivesPartsToItsPlaces) {
  const Utterance one = parse_utterance("X [A | weak: B#2 | head: r@1..20]");
  EXPECT_TRUE(one.places[0].parts.empty());
  SignRef piece{.kind = SignRef::Kind::piece, .gloss = {}, .recording = "r", .span = {1ms, 20ms}};
  EXPECT_EQ(one.places[1].parts, (std::vector{part(BodyPart::weak, {gloss("B", 2)}), part(BodyPart::head, {piece})}));
  const Utterance two = parse_utterance("[A , B|weak:C D E]");
  EXPECT_EQ(two.places[0].parts, std::vector{part(BodyPart::weak, {gloss("C"), gloss("D"), gloss("E")}, 2)});
  EXPECT_EQ(two.places[1].pause_before, kComma);
  EXPECT_EQ(names_of(parse_utterance("[A B]")), (std::vector<std::string>{"A", "B"}));
}

TEST(UtteranceChannels, EveryPartHasItsNames) {
  for (const BodyPart which : kBodyParts) {
    const std::string text = "[A | " + std::string(name_of(which)) + ": B]";
    EXPECT_EQ(parse_utterance(text).places[0].parts, std::vector{part(which, {gloss("B")})}) << text;
  }
  const auto part_in = [](const std::string& text) { return parse_utterance(text).places[0].parts.at(0).part; };
  EXPECT_EQ(part_in("A{fingers: B}"), BodyPart::dominant_fingers);
  EXPECT_EQ(part_in("A{fingers right: B}"), BodyPart::right_fingers);
  EXPECT_EQ(part_in("A{ fingers   weak : B }"), BodyPart::weak_fingers);
}

TEST(UtteranceChannels, SyncMarksFollowTheSignOfAPart) {
  const Utterance read = parse_utterance("[A | weak: B @begin+200 @end-100 C @end]");
  const std::vector<PartSign>& signs = read.places[0].parts[0].signs;
  EXPECT_EQ(signs[0].sync, (std::vector<SyncMark>{{SyncMark::Anchor::begin, 200ms}, {SyncMark::Anchor::end, -100ms}}));
  EXPECT_EQ(signs[1].sync, (std::vector<SyncMark>{{SyncMark::Anchor::end, 0ms}}));
}

TEST(UtteranceChannels, AHoldLastsFromThePlaceBeforeItsBracket) {
  EXPECT_EQ(parse_utterance("A [B C | weak: hold]").holds, (std::vector<HandHold>{{BodyPart::weak, 0, 2}}));
  EXPECT_EQ(parse_utterance("A [B | weak: \"hold\"]").places[1].parts,
            std::vector{part(BodyPart::weak, {gloss("hold")})});
}

TEST(UtteranceChannels, AHandRestsNextToAndBetweenSigns) {
  PlacePart one = part(BodyPart::weak, {{}});
  one.signs[0].rest = true;
  EXPECT_EQ(parse_utterance("[A | weak: rest]").places[0].parts, std::vector{one});
  PlacePart between = part(BodyPart::left, {gloss("X"), {}, gloss("Y")}, 2);
  between.signs[1].rest = true;
  EXPECT_EQ(parse_utterance("[A B | left: X rest Y]").places[0].parts, std::vector{between});
  EXPECT_EQ(fault_in("A{weak ..+1: rest} B"), "[A B | weak: rest]");
  EXPECT_EQ(parse_utterance("[A | weak: \"rest\"]").places[0].parts,
            std::vector{part(BodyPart::weak, {gloss("rest")})});
  EXPECT_EQ(parse_utterance("[A | weak: rest]", glosses({"rest"})).places[0].parts,
            std::vector{part(BodyPart::weak, {gloss("rest")})});
  EXPECT_EQ(names_of(parse_utterance("rest [rest | weak: A]")), (std::vector<std::string>{"rest", "rest"}));
  EXPECT_THAT(faults_in("[A | head: rest] B{fingers: X rest}"), ElementsAre("bad_option 5 15", "bad_option 19 34"));
  EXPECT_THAT(faults_in("[A | weak: rest @begin] [A | weak: rest hold]"),
              ElementsAre("bad_sync 16 22", "bad_option 40 44"));
}

TEST(UtteranceChannels, AHoldLastsUntilANamedPlace) {
  const auto hold = [](const std::string& text) { return parse_utterance(text).holds.at(0); };
  EXPECT_EQ(hold("A C{weak hold ..C} B C C"), (HandHold{BodyPart::weak, 1, 3}));
  EXPECT_EQ(hold("A{left hold ..C#2} C#1 C#2"), (HandHold{BodyPart::left, 0, 2}));
  EXPECT_EQ(hold("A{weak hold ..\"LE MANS\"} \"LE MANS\"#1"), (HandHold{BodyPart::weak, 0, 1}));
  EXPECT_EQ(hold("A{weak hold ..+2} B C D"), (HandHold{BodyPart::weak, 0, 2}));
  EXPECT_EQ(hold("A{weak hold ..} B C D"), (HandHold{BodyPart::weak, 0, 3}));
  EXPECT_EQ(hold("[A B]{weak hold ..} C"), (HandHold{BodyPart::weak, 1, 2}));
}

TEST(UtteranceChannels, PlacesHaveADominantHand) {
  EXPECT_EQ(parse_utterance("A{dominant left} B").places[0].dominant, Side::left);
  const Utterance scope = parse_utterance("{dominant left: A B{dominant right}} C");
  EXPECT_EQ(scope.places[0].dominant, Side::left);
  EXPECT_EQ(scope.places[1].dominant, Side::right);
  EXPECT_FALSE(scope.places[2].dominant);
}

TEST(UtteranceChannels, NonManualsCoverPlaces) {
  using Kind = NonManual::Kind;
  const auto read = [](const std::string& text) { return parse_utterance(text).non_manuals; };
  EXPECT_THAT(
      read("X A{mouth \"il pleut\"; gaze @left; brows up -5}"),
      ElementsAre(NonManual{Kind::mouthing, "il pleut", 1, 1, 0ms, 0ms}, NonManual{Kind::gaze, "left", 1, 1, 0ms, 0ms},
                  NonManual{Kind::expression, "brows up", 1, 1, -5ms, 0ms}));
  EXPECT_THAT(read("{topic; gaze @addressee: A B} {neg +0 -40: {brows up: C} D}"),
              ElementsAre(NonManual{Kind::expression, "topic", 0, 1, 0ms, 0ms},
                          NonManual{Kind::gaze, "addressee", 0, 1, 0ms, 0ms},
                          NonManual{Kind::expression, "neg", 2, 3, 0ms, -40ms},
                          NonManual{Kind::expression, "brows up", 2, 2, 0ms, 0ms}));
  EXPECT_THAT(read("A{neg; topic ..C} B C"), ElementsAre(NonManual{Kind::expression, "topic", 0, 2, 0ms, 0ms},
                                                         NonManual{Kind::expression, "neg", 0, 0, 0ms, 0ms}));
  EXPECT_THAT(read("[A B]{neg}"), ElementsAre(NonManual{Kind::expression, "neg", 0, 1, 0ms, 0ms}));
}

TEST(UtteranceChannels, TextsWithoutBracketsMeanWhatTheyMeant) {
  EXPECT_EQ(
      names_of(parse_utterance("A++ (2h)A fs:A A=B A|B A;B @left @end hold A/B <A>")),
      (std::vector<std::string>{"A++", "(2h)A", "fs:A", "A=B", "A|B", "A;B", "@left", "@end", "hold", "A/B", "<A>"}));
}

TEST(UtteranceChannels, AGlossOfTheDatabaseIsThatGloss) {
  const UtteranceWords known = glosses({"[X]", "{A}", "A{b", "(2h)A", "fs:B", "B|C", "hold", "@begin", "D]", "E{f}"});
  const Utterance read =
      parse_utterance("[X] {A}#2 A{b E{f}{neg} [(2h)A D] | weak: fs:B B|C | left: hold @begin]", known);
  EXPECT_EQ(names_of(read), (std::vector<std::string>{"[X]", "{A}", "A{b", "E{f}", "(2h)A", "D]"}));
  EXPECT_EQ(read.places[1].gloss.token, 2U);
  EXPECT_EQ(read.places[4].parts, (std::vector{part(BodyPart::weak, {gloss("fs:B"), gloss("B|C")}, 2),
                                               part(BodyPart::left, {gloss("hold"), gloss("@begin")}, 2)}));
  EXPECT_EQ(read.non_manuals.at(0).first, 3U);
  EXPECT_EQ(parse_utterance(to_string(read)), read) << "without the database";
  EXPECT_EQ(parse_utterance("A{weak hold ..fs:B} fs:B", known).holds.at(0).until, 1U);
  EXPECT_EQ(parse_utterance("A{weak ..fs:B: D]} fs:B", known).places[0].parts,
            std::vector{part(BodyPart::weak, {gloss("D]")}, 2)});
}

TEST(UtteranceChannels, FewAndShortBeginningsOfAWordAreTriedAsGlosses) {
  std::size_t calls = 0;
  std::size_t longest = 0;
  const UtteranceWords counted{.is_gloss =
                                   [&](std::string_view word) {
                                     ++calls;
                                     longest = std::max(longest, word.size());
                                     return false;
                                   },
                               .is_expression = {}};
  read_utterance("A" + std::string(900, ']'), counted);
  EXPECT_EQ(calls, 16U);
  EXPECT_EQ(longest, 16U);
  read_utterance("A]" + std::string(990, 'A') + "]" + std::string(100, 'A') + "] B", counted);
  EXPECT_EQ(longest, 992U);
}

TEST(UtteranceChannels, OnlyTheWordsOfTheirFunctionAreExpressions) {
  const UtteranceWords known{.is_gloss = {}, .is_expression = [](std::string_view name) { return name == "brows up"; }};
  EXPECT_EQ(fault_in("{brows  up: A}", known), "A{brows up}");
  EXPECT_THAT(fault_in("{brows down: A}", known), StartsWith("utterance:1:2: no expression 'brows down'"));
}

TEST(UtteranceChannels, AnUnknownExpressionIsAnsweredWithSimilarOnes) {
  UtteranceWords known{.is_gloss = {}, .is_expression = [](std::string_view) { return false; }};
  std::vector<std::string> near = {"brows up"};
  known.near_expressions = [&](std::string_view) { return near; };
  EXPECT_EQ(fault_in("A{brows  upp +0 -40}", known),
            "utterance:1:3: no expression 'brows upp'; did you mean brows up?");
  EXPECT_EQ(mended("A{brows  upp +0 -40}", known), "A{brows up +0 -40}");
  EXPECT_EQ(mended("A{brows ..+1 upp} B", known), "A{} B");
  near.emplace_back("brows");
  EXPECT_EQ(fault_in("{brow: A}", known), "utterance:1:2: no expression 'brow'; did you mean brows up or brows?");
  near = {"left eye"};
  EXPECT_EQ(mended("{eye: A}", known), "{\"left eye\": A}");
}

TEST(UtteranceChannels, QuotesSettleTheRest) {
  EXPECT_EQ(to_string(parse_utterance("\"[X]\" \"{A}\"#2 \"A{b\" \"A\"\"B C\"")),
            "\"[X]\" \"{A}\"#2 \"A{b\" \"A\"\"B C\"");
  EXPECT_EQ(parse_utterance("\"A\"\"B C\"").places[0].gloss.gloss, "A\"B C");
  EXPECT_EQ(parse_gloss_ref("\"A\"\"B C\"#2", "edit"), (GlossRef{"A\"B C", 2}));
}

TEST(UtteranceChannels, HasACanonicalText) {
  EXPECT_EQ(fault_in("[A|weak:B|head:C]"), "[A | weak: B | head: C]");
  EXPECT_EQ(fault_in("A{fingers right:B;weak:C;mouth \"a\";neg +0 +0}"),
            "[A{right fingers: B; mouth \"a\"; neg} | weak: C]");
  EXPECT_EQ(fault_in("A [B C | weak: hold]"), "A{weak hold ..+2} B C");
  EXPECT_EQ(fault_in("{topic: {gaze @left: A B}} , {neg +0 -40: [C D | weak: E]}"),
            "{topic; gaze @left: A B} , {neg +0 -40: [C D | weak: E]}");
  EXPECT_EQ(fault_in("A{a ..+1} B{b ..+1} C"), "{a: A B{b ..+1}} C");
  EXPECT_EQ(fault_in("A{weak ..+1: X} B{weak: Y}"), "[A B{weak: Y} | weak: X]");
  EXPECT_EQ(fault_in("A{a ..+1} [B C | weak: X]"), "A{a ..+1} [B C | weak: X]");
  EXPECT_EQ(fault_in("[A B{a ..+1} | weak: X] C"), "[A B{a ..+1} | weak: X] C");
  EXPECT_EQ(fault_in("[{a: A B} C | weak: X]{b}"), "{b: [{a: A B} C | weak: X]}");
}

TEST(UtteranceChannels, EachFaultHasItsSpan) {
  EXPECT_THAT(faults_in("A{b"), ElementsAre("open_bracket 0 3"));
  EXPECT_THAT(faults_in("B A{b C D{e} E"), ElementsAre("open_bracket 2 5"));
  EXPECT_THAT(faults_in("[A B"), ElementsAre("open_bracket 0 2"));
  EXPECT_THAT(faults_in("A {x: B"), ElementsAre("open_bracket 2 5"));
  EXPECT_THAT(faults_in("A] B"), ElementsAre("stray_bracket 0 2"));
  EXPECT_THAT(faults_in("A[1] } [B]C"), ElementsAre("stray_bracket 0 4", "stray_bracket 5 6", "stray_bracket 10 11"));
  EXPECT_THAT(faults_in("[A [B] C | weak: D]"), ElementsAre("nested_bracket 3 6"));
  EXPECT_THAT(faults_in("A [] {A} {x: }"), ElementsAre("empty_group 2 4", "empty_group 5 8", "empty_group 9 14"));
  EXPECT_THAT(faults_in("[A | weak: ]"), ElementsAre("empty_group 9 11"));
  EXPECT_THAT(faults_in("[A | waek: B | C | : D]"),
              ElementsAre("unknown_part 5 9", "unknown_part 15 16", "unknown_part 19 20"));
  EXPECT_THAT(faults_in("[A{weak: B} | weak: C | head: D | head: E]"),
              ElementsAre("repeated_part 14 18", "repeated_part 34 38"));
  EXPECT_THAT(faults_in("A{weak hold ..; weak hold ..+1} B"), ElementsAre("repeated_part 16 30"));
  EXPECT_THAT(faults_in("A{gaze left; mouth a b; ; weak B; weak hold; neg +0 +0 +0; neg -x; head hold ..}"),
              ElementsAre("bad_option 2 11", "bad_option 13 22", "bad_option 24 25", "bad_option 26 32",
                          "bad_option 34 43", "bad_option 45 57", "bad_option 63 65", "bad_option 67 79"));
  EXPECT_THAT(faults_in("{weak hold ..: A} {topic ..: A}"), ElementsAre("bad_option 1 13", "bad_option 19 27"));
  EXPECT_THAT(faults_in("[A | weak: B @begin+x @begin @begin]"), ElementsAre("bad_sync 13 21", "bad_sync 29 35"));
  EXPECT_THAT(faults_in("[@end | weak: @end B]"), ElementsAre("bad_sync 1 5", "bad_sync 14 18"));
  EXPECT_THAT(faults_in("[A |"), ElementsAre("unknown_part 3 4"));
  EXPECT_THAT(faults_in("[A | weak: B , C]"), ElementsAre("pause_in_part 13 14"));
  EXPECT_THAT(faults_in("[A | weak: hold] B"), ElementsAre("nothing_to_hold 11 15"));
  EXPECT_THAT(faults_in("A{weak hold ..C} B{weak hold ..+1; neg ..}"),
              ElementsAre("no_such_place 12 15", "no_such_place 29 33"));
  EXPECT_THAT(faults_in("A{mouth \"" + std::string(1'001, 'a') + "\"}"), ElementsAre("long_mouthing 8 1011"));
  EXPECT_THAT(faults_in("A{mouth \"x} B"), ElementsAre("open_quote 8 13"));
  EXPECT_THAT(faults_in("A{mouth \" \"} B#0{neg} [C | weak: D#0]"),
              ElementsAre("empty_name 8 11", "token_zero 13 16", "token_zero 33 36"));
}

TEST(UtteranceChannels, OneMistakeIsOneFault) {
  EXPECT_EQ(faults_in("{x: A#0} [A#0 | weak: hold] A{weak hold ..A}").size(), 2U);
  EXPECT_EQ(faults_in("{x: [A | weak: B}").size(), 1U);
  EXPECT_EQ(faults_in("{x: A ] B").size(), 1U);
  EXPECT_EQ(faults_in("[A | weak: B{neg; topic} C]").size(), 1U);
}

TEST(UtteranceChannels, FaultsAreMendedWhereTheMendIsKnown) {
  EXPECT_EQ(mended("A{b C"), "\"A{b\" C");
  EXPECT_EQ(mended("A] C"), "\"A]\" C");
  EXPECT_EQ(mended("C [X"), "C \"[X\"");
  EXPECT_EQ(mended("{A}"), "\"{A}\"");
  EXPECT_EQ(mended("{x: A]}"), "{x: \"A]\"}");
  EXPECT_EQ(mended("[A], B"), "[A] , B");
  EXPECT_EQ(mended("[A | waek: B]"), "[A | weak: B]");
  EXPECT_EQ(mended("A{gaze left}"), "A{gaze @left}");
  EXPECT_EQ(mended("A{mouth il pleut}"), "A{mouth \"il pleut\"}");
  EXPECT_EQ(mended("[A | weak: @x]"), "[A | weak: \"@x\"]");
  EXPECT_EQ(mended("A [B | weak: C hold]"), "A [B | weak: C \"hold\"]");
}

TEST(UtteranceChannels, ErrorsNameTheLine) {
  EXPECT_THAT(fault_in("A\n手 B\n É ] C"), StartsWith("utterance:3:4: ']' closes nothing"));
  EXPECT_THAT(fault_in("\n\nA#0"), StartsWith("utterance:3:1: "));
}

TEST(UtteranceChannels, DepthIsLimitedAndReportedOnce) {
  const auto nested = [](const std::string& open, std::size_t count, const std::string& close) {
    std::string text;
    for (std::size_t i = 0; i < count; ++i) text += open;
    text += "A";
    for (std::size_t i = 0; i < count; ++i) text += close;
    return faults_in(text);
  };
  EXPECT_THAT(nested("{x: ", kMostUtteranceDepth, "}"), ElementsAre());
  for (const std::string open : {"{x: ", "[", "{", "{ ", "[ ", "A{", "[A | weak: ", "{[", "A{weak: B{"}) {
    for (const std::string close : {"", "}", " ]"}) {
      EXPECT_THAT(nested(open, 10'000, close), ElementsAre(StartsWith("too_deep "))) << open << close;
    }
  }
}

double ns_a_byte(const std::string& text) {
  const auto begin = std::chrono::steady_clock::now();
  read_utterance(text, {.is_gloss = [](std::string_view) { return false; }, .is_expression = {}});
  const std::chrono::duration<double, std::nano> time = std::chrono::steady_clock::now() - begin;
  return time.count() / static_cast<double>(text.size());
}

/// Twenty times the text costs less than five times as much a byte; other programs may disturb all but one attempt.
bool grows_linearly(const std::string& piece) {
  std::string text;
  while (text.size() < 60'000) text += piece;
  const std::string small = text.substr(0, text.size() / 20);
  for (int attempt = 0; attempt < 20; ++attempt) {
    const double least = std::max({5.0, ns_a_byte(small), ns_a_byte(small)});
    if (ns_a_byte(text) < 5 * least) return true;
  }
  return false;
}

TEST(UtteranceChannels, TimeIsLinearInTheLength) {
  for (const std::string piece : {"VANNES MATIN#3 ",
                                  "[A | weak: B @end-1] ",
                                  "A{weak hold ..A#7} ",
                                  "A{mouth \"a\"; x ..} ",
                                  "{x: A B} ",
                                  "A{b ",
                                  "[A B ",
                                  "A] ",
                                  "[A|weak:B|weak:B|",
                                  "{x:A}",
                                  "\"",
                                  "A{b \"",
                                  "; ",
                                  "A{x;;;;",
                                  "[A | weak: B, ",
                                  "{x: [A] {x: B} ",
                                  "]",
                                  "[A]{x}[",
                                  "A{..B:",
                                  "A{to @left} ",
                                  "A{@a=@b;",
                                  "A{@a = @left; to @a} ",
                                  "A{at @b} ",
                                  "{@a = @left: A} ",
                                  "{slow: A B} ",
                                  "A{to:@,",
                                  "A{at @9999} ",
                                  "A{along @left ",
                                  "[A|"}) {
    EXPECT_TRUE(grows_linearly(piece)) << piece;
  }
}

}  // namespace
}  // namespace signweave
