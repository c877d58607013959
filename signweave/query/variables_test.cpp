// Variables, units and signers in queries.
#include "signweave/query/variables.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <random>
#include <set>

#include "signweave/query/corpus_for_tests.h"
#include "signweave/query/find.h"
#include "signweave/query/parse.h"

namespace signweave {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::Pair;

std::vector<std::string> answers_in(std::string_view text, const Segments& segments = weather_corpus().table()) {
  std::vector<std::string> result;
  for (const Segment& segment : find(parse(text), segments)) {
    result.push_back(fmt::format("{} {} {}..{}", segment.recording, segment.name, segment.span.begin.count(),
                                 segment.span.end.count()));
  }
  return result;
}

std::string fault_of(std::string_view text) {
  try {
    parse(text);
  } catch (const SyntaxError& error) {
    return error.what();
  }
  return "none";
}

/// Signs of four glosses on two tiers, and mouthings of the same words.
TestCorpus random_corpus(unsigned seed) {
  std::mt19937 random(seed);
  const char* const words[] = {"A", "B", "C", "D"};
  TestCorpus corpus;
  for (const char* name : {"one", "two"}) {
    corpus.recording(name).tier("Right").tier("Left").tier("Mouthing").tier("Phase");
    for (const char* tier : {"Right", "Left", "Mouthing"}) {
      Milliseconds at{0};
      for (int i = 0; i < 12; ++i) {
        at += Milliseconds(random() % 3 * 100);
        const TimeSpan span{at, at + Milliseconds(100 + random() % 5 * 100)};
        at = span.end;
        const std::string word = words[random() % 4];
        if (std::string_view(tier) == "Mouthing") {
          corpus.annotation_on(tier, word, span);
        } else {
          corpus.sign(tier, word, span, {}, std::string_view(tier) == "Left" ? Hand::left : Hand::right);
        }
      }
    }
  }
  return corpus;
}

TEST(Variables, HaveOneLabelInEveryPlace) {
  const std::vector<Segment> found =
      find(parse("gloss = $X & hand = right overlaps gloss = $X & hand = left"), weather_corpus().table());
  ASSERT_EQ(found.size(), 2U);
  EXPECT_EQ(found[0].name, "NUAGES");
  EXPECT_THAT(found[0].bindings, ElementsAre(Pair("X", "NUAGES")));
  EXPECT_THAT(found[1].bindings, ElementsAre(Pair("X", "PLUIE")));
  EXPECT_THAT(answers_in("gloss = $X ->[..4s] gloss = $X"), ElementsAre("meteo MATIN MATIN 500..4600"));
  EXPECT_THAT(answers_in("gloss = $X -> gloss = $X"), ElementsAre());
  EXPECT_THAT(answers_in("gloss = \"MATIN\" -> gloss != $X -> gloss = $X"),
              ElementsAre("meteo MATIN NUAGES VANNES 500..3000", "meteo MATIN BROUILLARD PLUIE 4200..6700"));
}

TEST(Variables, GiveTheUnionOverAllLabels) {
  for (unsigned seed = 0; seed < 40; ++seed) {
    const Segments segments = random_corpus(seed).table();
    for (const char* form :
         {"gloss = {0} -> gloss = {0}", "gloss = {0} ->[..300ms] @ gloss = {0}",
          "gloss = {0} overlaps tier(\"Mouthing\") = {0}",
          "gloss =~ /.*/ & hand = right overlaps tier(\"Mouthing\") = {0} overlaps gloss = {0} & hand = left",
          "gloss = {0} & tier(\"Mouthing\") = {0}",
          "tier(\"Mouthing\") = {0} overlaps gloss = {0} & hand = left -> tier(\"Mouthing\") = {0}",
          "gloss = {0} & hand = right overlaps gloss != {0} & hand = left overlaps tier(\"Mouthing\") = {0}"}) {
      std::multiset<std::string> expected;
      for (const char* label : {"\"A\"", "\"B\"", "\"C\"", "\"D\""}) {
        for (std::string& answer : answers_in(fmt::format(fmt::runtime(form), label), segments))
          expected.insert(std::move(answer));
      }
      const std::vector<std::string> all = answers_in(fmt::format(fmt::runtime(form), "$X"), segments);
      const std::multiset<std::string> found(all.begin(), all.end());
      // One sign overlaps mouthings of two labels at once, but is one answer.
      const std::set<std::string> once(expected.begin(), expected.end());
      EXPECT_EQ(std::set<std::string>(found.begin(), found.end()), once) << form << " of seed " << seed;
      EXPECT_LE(found.size(), expected.size());
    }
  }
}

TEST(Variables, AreRejectedWhereTheyHaveNoMeaning) {
  EXPECT_THAT(fault_of("gloss = $X | gloss = \"A\""), HasSubstr("outside |, ! and links"));
  EXPECT_THAT(fault_of("!(gloss = $X)"), HasSubstr("outside |, ! and links"));
  EXPECT_THAT(fault_of("child(gloss = $X)"), HasSubstr("outside |, ! and links"));
  EXPECT_THAT(fault_of("hand = $X"), HasSubstr("stands for a label"));
  EXPECT_THAT(fault_of("gloss =~ $X"), HasSubstr("stands for a label"));
  EXPECT_THAT(fault_of("$X = gloss"), HasSubstr("'$X' stands alone"));
  EXPECT_EQ(fault_of("gloss = $X"), "none");
  std::string many = "gloss = $X";
  for (int i = 0; i < 64; ++i) many += " & gloss = $X";
  EXPECT_THAT(fault_of(many), HasSubstr("more than 64 conditions on variables"));
}

TEST(Units, AreTheSignsBetweenTwoRests) {
  EXPECT_THAT(
      answers_in("unit"),
      ElementsAre("cities VANNES BREST 100..1500", "meteo MATIN NUAGES VANNES 500..3000", "meteo NUAGES 1000..2100",
                  "meteo MATIN BROUILLARD PLUIE AUJOURD'HUI 4200..7400", "meteo PLUIE 6000..6900"));
  EXPECT_THAT(answers_in("@ unit overlaps gloss = \"BREST\""), ElementsAre("cities VANNES BREST 100..1500"));
  EXPECT_THAT(answers_in("unit & hand = left & duration > 1s"), ElementsAre("meteo NUAGES 1000..2100"));
  EXPECT_THAT(answers_in("unit -> unit"),
              ElementsAre("meteo MATIN NUAGES VANNES MATIN BROUILLARD PLUIE AUJOURD'HUI 500..7400",
                          "meteo NUAGES PLUIE 1000..6900"));
  EXPECT_THAT(answers_in("unit & gloss = \"BREST\""), ElementsAre()) << "a unit has no gloss";
  EXPECT_THAT(answers_in("!(unit)"), ElementsAre());
  EXPECT_THAT(answers_in("duration > 2s & recording = meteo"), ElementsAre()) << "signs, as without units";
}

TEST(Signers, AreThoseOfTheirTiersOrRecordings) {
  EXPECT_THAT(answers_in("signer = \"anna\" & gloss = \"VANNES\""), ElementsAre("meteo VANNES 2300..3000"));
  EXPECT_THAT(answers_in("signer != \"anna\" & gloss = \"VANNES\""), ElementsAre("cities VANNES 100..900"));
  EXPECT_THAT(answers_in("signer =~ /AN+A/i & gloss = \"VANNES\""), ElementsAre("meteo VANNES 2300..3000"));
}

TEST(PreparedQuery, CanBeRunAgainAndReturnsRowsWithoutNames) {
  const auto segments = std::make_shared<const Segments>(weather_corpus().table());
  PreparedQuery query(parse("gloss = \"MATIN\" overlaps tier(\"Mouthing\") = \"matin\""), segments);
  const std::vector<Segment> first = query.find();
  ASSERT_EQ(first.size(), 1U);
  EXPECT_EQ(query.find(), first);
  std::vector<FoundRow> rows(7);
  query.find(rows);
  ASSERT_EQ(rows.size(), 1U);
  EXPECT_EQ(rows[0].row, first[0].row);
  EXPECT_EQ(rows[0].span, first[0].span);
  query.find(rows, {.limit = 0, .deadline = {}});
  EXPECT_TRUE(rows.empty());
}

}  // namespace
}  // namespace signweave
