#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "signweave/core/error.h"
#include "signweave/notation/utterance.h"

namespace signweave {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::StartsWith;

std::string space_text(const std::string& text, const UtteranceWords& words = {}) {
  try {
    return to_string(parse_utterance(text, words));
  } catch (const Error& error) {
    return error.what();
  }
}

/// "KIND BEGIN END" of each fault.
std::vector<std::string> space_faults(const std::string& text, const UtteranceWords& words = {}) {
  std::vector<std::string> rows;
  for (const UtteranceFault& fault : read_utterance(text, words).faults) {
    rows.push_back(std::string(name_of(fault.kind)) + ' ' + std::to_string(fault.at.begin) + ' ' +
                   std::to_string(fault.at.end));
  }
  return rows;
}

SpaceChange change_in(const std::string& text, std::size_t place = 0) {
  return parse_utterance(text).places.at(place).space;
}

SpaceChange with_words(float size, float speed, bool mirrored = false) {
  SpaceChange change;
  change.size = size;
  change.speed = speed;
  change.mirrored = mirrored;
  return change;
}

TEST(UtteranceSpace, ASignGoesFromALocusToAnother) {
  SpaceChange wanted;
  wanted.from = read_locus("self");
  wanted.to = read_locus("30/10");
  for (const char* text : {"A{from @self to @30/10}", "A{from:@self to:@30/10}", "A{to @+30/+10 from : @self}",
                           "A{from @self; to: @30/10}", "[A | weak: B]{from @self to @30/10}"}) {
    EXPECT_EQ(change_in(text), wanted) << text;
  }
  EXPECT_EQ(change_in("A{to @left}").to, read_locus("left"));
  EXPECT_FALSE(change_in("A{to @left}").from);
  EXPECT_EQ(change_in("A{at:@0.3,0.1,0.8}").at, read_locus("0.3,0.1,0.8"));
  EXPECT_EQ(change_in("A{past @front}").past, read_locus("front"));
  const SpaceChange along = change_in("A{along @left @front @right; unturned}");
  EXPECT_EQ(along.along, (std::vector{read_locus("left"), read_locus("front"), read_locus("right")}));
  EXPECT_TRUE(along.keeps_turn);
}

TEST(UtteranceSpace, StrokesAreChangedByWordsAndNumbers) {
  EXPECT_EQ(change_in("A{big; slow; mirrored}"), with_words(kBig, kSlow, true));
  EXPECT_EQ(change_in("A{small; fast}"), with_words(kSmall, kFast));
  EXPECT_EQ(change_in("A{size 1.3; speed .75}"), with_words(1.3f, 0.75f));
  const SpaceChange numbers = change_in("A{move 10/+0/-5; turn -1.5/30/0; scale 1/1.5/1}");
  EXPECT_EQ(numbers.move, (std::array<float, 3>{10, 0, -5}));
  EXPECT_EQ(numbers.turn, (std::array<float, 3>{-1.5f, 30, 0}));
  EXPECT_EQ(numbers.scale, (std::array<float, 3>{1, 1.5f, 1}));
  EXPECT_EQ(change_in("A{scale 1.2}").scale, (std::array<float, 3>{1.2f, 1.2f, 1.2f}));
  EXPECT_EQ(change_in("A{move -10/0/0}").move[0], -10);
  const SpaceChange plural = change_in("A{plural}");
  EXPECT_TRUE(plural.outward);
  EXPECT_EQ(plural.repetitions, kPluralRepetitions);
  EXPECT_EQ(change_in("A{plural 4}").repetitions, 4U);
  EXPECT_EQ(change_in("A{repeat 3}").repetitions, 3U);
  EXPECT_FALSE(change_in("A{repeat 3}").outward);
}

TEST(UtteranceSpace, ScopesAndBracketsSpreadSizeSpeedAndMirroring) {
  EXPECT_EQ(space_text("{slow: A{fast} [B C{big}]{small; mirrored}} D"),
            "A{speed 1.33} B{size 0.75; speed 0.75; mirrored} C{size 1.3; speed 0.75; mirrored} D");
  EXPECT_EQ(space_text("{big: A{size 1} B}"), "A B{size 1.3}") << "an inner one counts, whatever it is";
  EXPECT_EQ(space_text("[A{big} | weak: B]{small}"), "[A{size 1.3} | weak: B]");
  for (const char* option : {"from @self to @left", "at @left", "along @left @right", "past @left", "plural",
                             "repeat 2", "move 1/0/0", "turn 1/0/0", "scale 2", "unturned"}) {
    EXPECT_THAT(space_text(std::string("{") + option + ": A}"),
                HasSubstr("1:2: this changes a single sign; put it directly behind the sign: A{"))
        << option;
    EXPECT_THAT(space_text(std::string("[A B]{") + option + "}"), HasSubstr("the bracket has several")) << option;
  }
}

TEST(UtteranceSpace, ALocusIsSetUpFromItsPlaceOn) {
  const Utterance read = parse_utterance("A{@a = @left} {@b=@a: B C{@a =@-30}} D{to @a} {slow; @c= @b: E}");
  EXPECT_EQ(read.loci, (std::vector<LocusSetup>{{"a", read_locus("left"), 0},
                                                {"b", read_locus("a"), 1},
                                                {"a", read_locus("-30"), 2},
                                                {"c", read_locus("b"), 4}}));
  EXPECT_EQ(parse_utterance("{@a = @left: A{@b = @a}}").loci.at(1).name, "b") << "outer ones first";
  EXPECT_EQ(space_text("X [A B]{@a = @left}"), "X A{@a = @left} B");
  EXPECT_EQ(space_text("A{to @a; @a = @left}"), "A{@a = @left; to @a}") << "its own place knows it";
  EXPECT_EQ(space_text("A{@e\xCC\x81 = @left} B{to @\xC3\xA9}"), "A{@\xC3\xA9 = @left} B{to @\xC3\xA9}") << "in NFC";
}

TEST(UtteranceSpace, AnUnknownLocusIsAnsweredWithTheMend) {
  EXPECT_EQ(space_text("A{to @b}"),
            "utterance:1:6: there is no locus '@b'; set it up at a sign before: SIGN{@b = @left}");
  EXPECT_EQ(space_text("A{to @lefft}"), "utterance:1:6: there is no locus '@lefft'; did you mean left?");
  EXPECT_EQ(space_text("A{from @b to @left} B{@b = @left}"),
            "utterance:1:8: the locus '@b' is set up later, at place 2; set it up before it is used");
  EXPECT_THAT(space_text("A{@a = @b}"), StartsWith("utterance:1:3: there is no locus '@b'"));
  EXPECT_THAT(space_faults("A{along @left @b} B{at @c} C{past @d}"),
              ElementsAre("unknown_locus 14 16", "unknown_locus 23 25", "unknown_locus 34 36"));
  const UtteranceText read = read_utterance("A{from @b to @left; slow} B{along @b @left; unturned}");
  EXPECT_FALSE(read.utterance.places.at(0).space.from) << "what is unknown is left out";
  EXPECT_TRUE(read.utterance.places.at(0).space.to);
  EXPECT_EQ(read.utterance.places.at(1).space, SpaceChange{});
  UtteranceWords follows;
  follows.follows = true;
  EXPECT_EQ(space_text("A{to @b; @c = @b}", follows), "A{@c = @b; to @b}") << "set up before the utterance";
  EXPECT_EQ(space_faults("A{@a = @200} B{to @a}").size(), 1U) << "one mistake is one fault";
}

TEST(UtteranceSpace, EachFaultHasItsSpan) {
  EXPECT_THAT(space_faults("A{to @200; @a = @0/99; @left = @right; @1 = @left; at @\"x\"}"),
              ElementsAre("bad_locus 5 9", "bad_locus 11 21", "bad_locus 23 37", "bad_locus 39 49", "bad_locus 54 55"));
  EXPECT_THAT(space_faults("A{@a; @a b = @left; @a = left; @a == @left; @\"a\" = @left; @a = @left ..}"),
              ElementsAre("bad_option 2 4", "bad_option 6 18", "bad_option 20 29", "bad_option 31 42",
                          "bad_option 44 56", "bad_option 58 71"));
  EXPECT_THAT(
      space_faults("A{from @left @right; at @left to @left; from @left x; along @left; past @left \"to\" @left}"),
      ElementsAre("bad_option 2 19", "bad_option 21 38", "bad_option 40 52", "bad_option 54 65", "bad_option 67 88"));
  EXPECT_THAT(
      space_faults("A{move 1/2; turn 300/1/1/1; size 1/2; size 9; repeat 0; repeat 2.5; plural 11; speed 1e99}"),
      ElementsAre("bad_option 2 10", "bad_option 12 26", "bad_option 28 36", "bad_option 38 44", "bad_option 46 54",
                  "bad_option 56 66", "bad_option 68 77", "bad_option 79 89"));
  EXPECT_THAT(
      space_faults("A{slow; speed 1; repeat 2; plural; to @left; to @left} B{@a = @left; @a = @right}"),
      ElementsAre("repeated_option 8 15", "repeated_option 27 33", "repeated_option 45 53", "repeated_option 69 80"));
  EXPECT_THAT(space_faults("A{slow ..+1; to @left ..} B"), ElementsAre("bad_option 2 11", "bad_option 13 24"));
  EXPECT_THAT(space_faults("A{at @left; to @left} B{unturned} [C{move 1/1/1} | weak: D]{move 1/1/1}"),
              ElementsAre("bad_option 12 20", "bad_option 24 32", "repeated_option 60 70"));
  EXPECT_THAT(space_text("A{size 9}"), HasSubstr("a size is 9; give one from 0.1 to 5"));
  EXPECT_THAT(space_text("[A | weak: B{at @left}]"), HasSubstr("a sign of a part has no options"));
}

TEST(UtteranceSpace, WhatAnExpressionCanBeCalledStillIsOne) {
  const auto expression = [](const std::string& text) { return parse_utterance(text).non_manuals.at(0).what; };
  EXPECT_EQ(expression("A{from here}"), "from here");
  EXPECT_EQ(expression("A{at}"), "at");
  EXPECT_EQ(expression("A{slow nod}"), "slow nod");
  EXPECT_EQ(expression("A{move on}"), "move on");
  EXPECT_EQ(expression("A{move -5}"), "move") << "an offset, as before";
  EXPECT_EQ(expression("A{big +0 -40}"), "big");
  EXPECT_EQ(space_text("A{\"slow\"; \"size 1.3\"}"), "A{\"slow\"; \"size 1.3\"}");
  const UtteranceWords known{.is_gloss = {}, .is_expression = [](std::string_view name) { return name == "slow"; }};
  EXPECT_EQ(space_text("A{slow} {slow: B C} D{fast}", known), "A{\"slow\"} {\"slow\": B C} D{speed 1.33}");
  EXPECT_EQ(expression("A{gaze @30/10}"), "30/10");
  for (const char* text : {"A@left", "@a=@left", "A:@left", "from @self to @a slow plural", "move 10/0/-5"}) {
    EXPECT_EQ(space_text(text), text) << "outside of brackets";
  }
}

}  // namespace
}  // namespace signweave
