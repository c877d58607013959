#include "signweave/query/find.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "signweave/query/corpus_for_tests.h"
#include "signweave/query/explain.h"
#include "signweave/query/parse.h"

namespace signweave {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

const SegmentTable& weather() {
  static const SegmentTable table = weather_corpus().table();
  return table;
}

std::string shown(const Segment& segment) {
  return fmt::format("{} {} {}..{}", segment.recording, segment.name, segment.span.begin.count(),
                     segment.span.end.count());
}

std::vector<std::string> answers(std::string_view text, const FindLimits& limits = {}) {
  std::vector<std::string> result;
  for (const Segment& segment : find(parse(text), weather(), limits)) result.push_back(shown(segment));
  return result;
}

TEST(Find, AGlossGivesItsSigns) {
  EXPECT_THAT(answers("gloss = \"VANNES\""), ElementsAre("cities VANNES 100..900", "meteo VANNES 2300..3000"));
  EXPECT_THAT(answers("gloss = VANNES"), ElementsAre("cities VANNES 100..900", "meteo VANNES 2300..3000"));
  EXPECT_THAT(answers("gloss = \"LORIENT\""), IsEmpty());
}

TEST(Find, LabelsMatchTrimmedAndInNfc) {
  TestCorpus corpus;
  corpus.recording("r").tier("Gloss").tier("Phase");
  corpus.sign("Gloss", "E\xCC\x81T\xC3\x89 ", {0ms, 10ms});
  const SegmentTable table = corpus.table();
  EXPECT_EQ(find(parse("gloss = \" \xC3\x89T\xC3\x89\""), table).size(), 1U);
  EXPECT_EQ(find(parse("gloss =~ /\xC3\x89TE\xCC\x81/"), table).size(), 1U);
}

TEST(Find, ARegularExpressionMatchesTheWholeLabel) {
  EXPECT_THAT(answers("gloss =~ /NUAGE.*/"), ElementsAre("meteo NUAGES 1000..2000", "meteo NUAGES 1000..2100"));
  EXPECT_THAT(answers("gloss =~ /NUAGE/"), IsEmpty());
  EXPECT_THAT(answers("gloss =~ /vann../i"), ElementsAre("cities VANNES 100..900", "meteo VANNES 2300..3000"));
}

TEST(Find, ConditionsJoinedByAndHoldForOneSegment) {
  EXPECT_THAT(answers("gloss = \"VANNES\" & recording = \"meteo\""), ElementsAre("meteo VANNES 2300..3000"));
  EXPECT_THAT(answers("gloss != \"VANNES\" & recording != \"meteo\""), ElementsAre("cities BREST 1000..1500"));
}

TEST(Find, APhaseConditionMakesThePhasesTheAnswer) {
  EXPECT_THAT(answers("gloss = \"VANNES\" & phase = stroke"),
              ElementsAre("cities VANNES stroke 300..700", "meteo VANNES stroke 2400..2900"));
  EXPECT_THAT(answers("phase = stroke & duration > 450ms"),
              ElementsAre("meteo NUAGES stroke 1000..2100", "meteo VANNES stroke 2400..2900",
                          "meteo PLUIE stroke 6000..6900", "meteo PLUIE stroke 6200..6700"));
  EXPECT_THAT(answers("phase = hold"), ElementsAre("cities BREST hold 1200..1500"));
  EXPECT_THAT(answers("phase =~ /re.*/ & recording = \"cities\""), ElementsAre("cities VANNES retraction 700..900"));
}

TEST(Find, ATierAloneGivesItsAnnotations) {
  EXPECT_THAT(answers("tier(\"Mouthing\") =~ /.*u.*/"),
              ElementsAre("meteo nuage 1100..1900", "meteo pluie 6050..6500"));
  EXPECT_THAT(answers("tier(\"Gloss\") = \"BREST\""), ElementsAre("cities BREST 1000..1500"));
  EXPECT_THAT(answers("tier(\"Mouthings\") = \"pluie\""), IsEmpty());
}

TEST(Find, ATierJoinedToAGlossMeansOverlap) {
  EXPECT_THAT(answers("gloss = \"PLUIE\" & tier(\"Mouthing\") = \"pluie\" & hand = right"),
              ElementsAre("meteo PLUIE 6000..6700"));
  EXPECT_THAT(answers("gloss =~ /.*/ & recording = meteo & hand = right & !(tier(\"Mouthing\") =~ /.*/)"),
              ElementsAre("meteo VANNES 2300..3000", "meteo MATIN 4200..4600", "meteo BROUILLARD 4900..5600",
                          "meteo AUJOURD'HUI 7000..7400"));
}

TEST(Find, TimesAndRecordingsAloneGiveSigns) {
  EXPECT_THAT(answers("begin >= 7s"), ElementsAre("meteo AUJOURD'HUI 7000..7400"));
  EXPECT_THAT(answers("recording = \"cities\""), ElementsAre("cities VANNES 100..900", "cities BREST 1000..1500"));
}

TEST(Find, AlternativesMayRangeOverDifferentKinds) {
  EXPECT_THAT(answers("gloss = \"BREST\" | phase = hold | tier(\"Mouthing\") = \"pluie\""),
              ElementsAre("cities BREST 1000..1500", "cities BREST hold 1200..1500", "meteo pluie 6050..6500"));
  EXPECT_THAT(answers("(gloss = \"BREST\" | gloss = \"PLUIE\") & phase = stroke & hand != left"),
              ElementsAre("cities BREST stroke 1000..1200", "meteo PLUIE stroke 6200..6700"));
}

TEST(Find, ParentsAndChildrenAreFollowed) {
  EXPECT_THAT(answers("parent(gloss = \"BREST\")"),
              ElementsAre("cities BREST stroke 1000..1200", "cities BREST hold 1200..1500"));
  EXPECT_THAT(answers("gloss =~ /.*/ & parent(tier(\"Sentence\") =~ /.*rain/) & duration < 500ms"),
              ElementsAre("meteo MATIN 4200..4600", "meteo AUJOURD'HUI 7000..7400"));
  EXPECT_THAT(answers("child(phase = hold)"), ElementsAre("cities BREST 1000..1500"));
  EXPECT_THAT(answers("phase = retraction & ancestor(tier(\"Sentence\") =~ /.*rain/)"),
              ElementsAre("meteo BROUILLARD retraction 5200..5600"));
  EXPECT_THAT(answers("descendant(gloss = \"MATIN\" & phase = stroke & begin > 4s)"),
              ElementsAre("meteo Tomorrow, fog and rain 4000..9000", "meteo MATIN 4200..4600"));
}

TEST(Find, ASequenceOfNeighboursSpansFirstToLast) {
  const std::vector<Segment> found = find(parse("gloss = \"MATIN\" -> gloss = \"NUAGES\""), weather());
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(shown(found[0]), "meteo MATIN NUAGES 500..2000");
  ASSERT_EQ(found[0].parts.size(), 2U);
  EXPECT_EQ(found[0].parts[1].name, "NUAGES");
  EXPECT_EQ(found[0].parts[1].span, (TimeSpan{1'000ms, 2'000ms}));
  EXPECT_EQ(found[0].row, found[0].parts[0].row);
  EXPECT_THAT(answers("gloss = \"MATIN\" -> gloss = \"VANNES\""), IsEmpty());
  EXPECT_THAT(answers("gloss = MATIN -> gloss = NUAGES -> gloss = VANNES"),
              ElementsAre("meteo MATIN NUAGES VANNES 500..3000"));
}

TEST(Find, AGapHasBoundsInMilliseconds) {
  EXPECT_THAT(answers("gloss = MATIN ->[..500ms] gloss = BROUILLARD"),
              ElementsAre("meteo MATIN BROUILLARD 4200..5600"));
  EXPECT_THAT(answers("gloss = MATIN ->[..299ms] gloss = BROUILLARD"), IsEmpty());
  EXPECT_THAT(answers("gloss = MATIN ->[300ms..300ms] gloss = BROUILLARD"),
              ElementsAre("meteo MATIN BROUILLARD 4200..5600"));
  EXPECT_THAT(answers("gloss = NUAGES & hand = right ->[2.9s..] gloss = PLUIE"),
              ElementsAre("meteo NUAGES PLUIE 1000..6700"));
}

TEST(Find, PhasesFollowEachOtherOnTheirTier) {
  EXPECT_THAT(
      answers("phase = stroke -> phase = stroke"),
      ElementsAre("meteo MATIN stroke NUAGES stroke 650..1400", "meteo NUAGES stroke NUAGES stroke 1000..1800",
                  "meteo NUAGES stroke PLUIE stroke 1000..6900", "meteo MATIN stroke BROUILLARD stroke 4300..5200",
                  "meteo PLUIE stroke AUJOURD'HUI stroke 6200..7400"))
      << "inferred strokes follow each other, as their signs do";
}

TEST(Find, PhasesThatTwoSignsShareAreFoundForBoth) {
  TestCorpus corpus;
  corpus.recording("r").tier("Gloss").tier("Left").tier("Phase");
  const std::vector<TestCorpus::PhaseToBe> phases = {{PhaseKind::preparation, 10ms}, {PhaseKind::stroke, 20ms}};
  corpus.sign("Gloss", "A", {0ms, 20ms}, phases, Hand::right);
  corpus.twin("Left", "B", Hand::left);
  const SegmentTable table = corpus.table();
  const auto names = [&](std::string_view text) {
    std::vector<std::string> result;
    for (const Segment& segment : find(parse(text), table)) result.push_back(segment.name);
    return result;
  };
  EXPECT_THAT(names("gloss = B & phase = stroke"), ElementsAre("B stroke"));
  EXPECT_THAT(names("phase = preparation -> phase = stroke"),
              ElementsAre("A preparation A stroke", "B preparation B stroke"));
  EXPECT_THAT(names("gloss = B & phase = preparation ->[..0ms] phase = stroke"), ElementsAre("B preparation B stroke"));
  EXPECT_THAT(names("tier(\"Phase\") = s"), ElementsAre("A stroke")) << "one annotation, one answer";
}

TEST(Find, ARelationKeepsSegmentsWithAPartner) {
  EXPECT_THAT(answers("gloss = \"PLUIE\" overlaps tier(\"Mouthing\") = \"pluie\""),
              ElementsAre("meteo PLUIE 6000..6700", "meteo PLUIE 6000..6900"));
  EXPECT_THAT(answers("gloss = \"PLUIE\" overlaps @ tier(\"Mouthing\") = \"pluie\""),
              ElementsAre("meteo pluie 6050..6500"));
  EXPECT_THAT(answers("tier(\"Mouthing\") =~ /.*/ during gloss =~ /NU.*/"), ElementsAre("meteo nuage 1100..1900"));
  EXPECT_THAT(answers("gloss = PLUIE & hand = left starts gloss = PLUIE"), ElementsAre("meteo PLUIE 6000..6900"));
  EXPECT_THAT(answers("gloss = PLUIE & !starts(hand = left)"), ElementsAre("meteo PLUIE 6000..6900"));
}

TEST(Find, ThePartnerIsTheFirstInTime) {
  TestCorpus corpus;
  corpus.recording("r").tier("Late").tier("Gloss").tier("Phase").tier("Early");
  corpus.sign("Gloss", "A", {0ms, 100ms});
  corpus.annotation_on("Late", "x", {50ms, 60ms});
  corpus.annotation_on("Early", "x", {10ms, 20ms});
  corpus.annotation_on("Early", "x", {20ms, 30ms});
  const SegmentTable table = corpus.table();
  const std::vector<Segment> found = find(parse("gloss = A overlaps (tier(Late) = x | tier(Early) = x)"), table);
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].parts[1].span, (TimeSpan{10ms, 20ms}));
}

TEST(Find, AFaultyTierWithOverlapsIsSearchedCompletely) {
  TestCorpus corpus;
  corpus.recording("r").tier("Gloss").tier("Phase");
  corpus.sign("Gloss", "A", {0ms, 100ms});
  corpus.sign("Gloss", "A", {10ms, 20ms});
  corpus.sign("Gloss", "B", {30ms, 40ms});
  corpus.sign("Gloss", "C", {90ms, 95ms});
  const SegmentTable table = corpus.table();
  const auto count = [&](std::string_view text) { return find(parse(text), table).size(); };
  EXPECT_EQ(count("gloss = A ->[..10ms] gloss = B"), 1U);
  EXPECT_EQ(count("gloss = A ->[..100ms] gloss = C"), 1U);
  EXPECT_EQ(count("gloss = C overlaps gloss = A"), 1U);
}

TEST(Find, AMarkMakesOnePartTheAnswer) {
  const std::vector<Segment> found = find(parse("gloss = MATIN -> @ gloss =~ /.*/"), weather());
  ASSERT_EQ(found.size(), 2U);
  EXPECT_EQ(shown(found[0]), "meteo NUAGES 1000..2000");
  EXPECT_EQ(found[0].parts.size(), 2U);
  EXPECT_THAT(answers("@ gloss = MATIN ->[..10s] recording = meteo"),
              ElementsAre("meteo MATIN 500..1000", "meteo MATIN 4200..4600"))
      << "each answer once, regardless of the number of its partners";
}

TEST(Find, AGroupIsOneSegment) {
  const std::vector<Segment> found =
      find(parse("(gloss = MATIN -> gloss = NUAGES) overlaps tier(\"Mouthing\") = \"matin\""), weather());
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(shown(found[0]), "meteo MATIN NUAGES 500..2000");
  ASSERT_EQ(found[0].parts.size(), 3U);
  EXPECT_EQ(found[0].parts[2].name, "matin");
  EXPECT_THAT(answers("(gloss = MATIN -> gloss = NUAGES) & duration > 1500ms"), IsEmpty());
  EXPECT_THAT(answers("(gloss = MATIN -> gloss = NUAGES) & duration = 1500ms"),
              ElementsAre("meteo MATIN NUAGES 500..2000"));
  EXPECT_THAT(answers("gloss = MATIN overlaps (gloss = MATIN -> gloss = NUAGES)"), IsEmpty())
      << "no annotation is on both sides";
}

TEST(Find, AMarkInAPartnerMakesItTheAnswer) {
  EXPECT_THAT(answers("tier(\"Mouthing\") = \"matin\" overlaps (gloss = MATIN -> @ gloss = NUAGES)"),
              ElementsAre("meteo NUAGES 1000..2000"));
  EXPECT_THAT(answers("tier(\"Mouthing\") = \"matin\" overlaps @ (gloss = MATIN -> gloss = NUAGES)"),
              ElementsAre("meteo MATIN NUAGES 500..2000"));
}

TEST(Find, VariablesApplyInsidePartnerSequences) {
  TestCorpus corpus;
  corpus.recording("r").tier("Gloss").tier("Phase").tier("Mouth");
  corpus.sign("Gloss", "A", {0ms, 10ms});
  corpus.sign("Gloss", "B", {20ms, 30ms});
  corpus.sign("Gloss", "A", {40ms, 50ms});
  corpus.annotation_on("Mouth", "A", {0ms, 3ms});
  corpus.annotation_on("Mouth", "B", {4ms, 25ms});
  corpus.annotation_on("Mouth", "A", {26ms, 60ms});
  const SegmentTable table = corpus.table();
  const auto bound = [&](const char* text) {
    std::vector<std::string> result;
    for (const Segment& segment : find(parse(text), table)) {
      std::string line = shown(segment);
      for (const auto& [name, value] : segment.bindings) line += ' ' + name + '=' + value;
      result.push_back(line);
    }
    return result;
  };
  EXPECT_THAT(bound("gloss = $X overlaps (tier(\"Mouth\") = $Y -> tier(\"Mouth\") = $X)"),
              ElementsAre("r A 0..10 X=A Y=B", "r B 20..30 X=B Y=A", "r A 40..50 X=A Y=B"));
  EXPECT_THAT(bound("gloss = $X overlaps (@ tier(\"Mouth\") = $X -> tier(\"Mouth\") != $X)"),
              ElementsAre("r A 0..3 X=A", "r B 4..25 X=B"));
}

TEST(Find, ALimitGivesTheFirstAnswers) {
  EXPECT_THAT(answers("gloss =~ /.*/", {.limit = 3, .deadline = {}}),
              ElementsAre("cities VANNES 100..900", "cities BREST 1000..1500", "meteo MATIN 500..1000"));
  EXPECT_THAT(answers("gloss =~ /.*/", {.limit = 0, .deadline = {}}), IsEmpty());
}

TEST(Find, ACancelOrADeadlineStopsIt) {
  const std::atomic<bool> cancel = true;
  const auto code_of = [](const FindLimits& limits) {
    try {
      answers("gloss = VANNES", limits);
    } catch (const Error& error) {
      return error.code();
    }
    return ErrorCode::io;
  };
  EXPECT_EQ(code_of({.limit = {}, .deadline = {}, .cancel = &cancel}), ErrorCode::cancelled);
  EXPECT_EQ(code_of({.limit = {}, .deadline = std::chrono::steady_clock::now()}), ErrorCode::cancelled);
}

TEST(Find, ADeadlineStopsAQueryThatWouldNeverEnd) {
  TestCorpus corpus;
  corpus.recording("r").tier("Gloss").tier("Phase");
  for (int i = 0; i < 2'000; ++i) corpus.sign("Gloss", "A", {Milliseconds(10 * i), Milliseconds(10 * i + 10)});
  const SegmentTable table = corpus.table();
  const PhaseQuery query =
      parse("gloss = A ->[0s..] gloss = A ->[0s..] gloss = A ->[0s..] gloss = A ->[0s..] gloss = B");
  const auto begin = std::chrono::steady_clock::now();
  EXPECT_THROW(
      find(parse("gloss = A ->[0s..] gloss = A ->[0s..] @ gloss = A"), table, {.limit = 1, .deadline = begin + 50ms}),
      Error);
  EXPECT_LT(std::chrono::steady_clock::now() - begin, 10s);
  EXPECT_THAT(find(query, table), IsEmpty()) << "it starts from the rarest place";
}

TEST(Find, ALimitStopsAQueryThatWouldNeverEnd) {
  TestCorpus corpus;
  corpus.recording("r").tier("Gloss").tier("Phase");
  for (int i = 0; i < 2'000; ++i) corpus.sign("Gloss", "A", {Milliseconds(10 * i), Milliseconds(10 * i + 10)});
  const SegmentTable table = corpus.table();
  const PhaseQuery query = parse("gloss = A ->[0s..] gloss = A ->[0s..] gloss = A ->[0s..] gloss = A");  // 7e11
  const std::vector<Segment> found = find(query, table, {.limit = 100, .deadline = {}});
  ASSERT_EQ(found.size(), 100U);
  EXPECT_EQ(found.front().span, (TimeSpan{0ms, 40ms}));
  EXPECT_EQ(found.back().span.begin, 0ms);
}

TEST(Find, TooManyAnswersAreAnError) {
  TestCorpus corpus;
  corpus.recording("r").tier("Gloss").tier("Phase");
  for (int i = 0; i < 1'000; ++i) corpus.sign("Gloss", "A", {Milliseconds(10 * i), Milliseconds(10 * i + 10)});
  const SegmentTable table = corpus.table();
  const PhaseQuery query = parse("gloss = A ->[0s..] gloss = A ->[0s..] gloss = A");  // 166 million
  try {
    find(query, table);
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::bad_input);
    EXPECT_THAT(error.what(), HasSubstr("more than 5000000 answers, or 10000000 parts of them"));
  }
  EXPECT_EQ(find(query, table, {.limit = 1, .deadline = {}}).size(), 1U);
}

TEST(Find, AnInterruptedSearchLeavesNoState) {
  TestCorpus corpus;
  corpus.recording("r").tier("Gloss").tier("Phase");
  for (int i = 0; i < 4'000; ++i) {
    corpus.sign("Gloss", i < 2 ? "B" : "A", {Milliseconds(10 * i), Milliseconds(10 * i + 10)});
  }
  PreparedQuery query(parse("gloss = $X ->[0s..] gloss = $X"), std::make_shared<const Segments>(corpus.table()));
  EXPECT_THROW(query.find(), Error);  // there are too many pairs of A
  const std::vector<Segment> found = query.find({.limit = 1, .deadline = {}});
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found.front().name, "B B");
}

TEST(Find, OfSeveralMatchesOfAnAnswerTheFirstInTimeIsReported) {
  TestCorpus corpus;
  corpus.recording("r").tier("Left").tier("Right").tier("Phase").tier("M");
  corpus.sign("Left", "LATE", {1'500ms, 2'000ms});
  corpus.sign("Right", "EARLY", {1'000ms, 1'400ms});
  corpus.annotation_on("M", "m", {900ms, 2'100ms});
  const std::vector<Segment> found = find(parse("gloss =~ /.*/ overlaps @ tier(\"M\") = m"), corpus.table());
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found.front().tier, "M");
  ASSERT_EQ(found.front().parts.size(), 2U);
  EXPECT_EQ(found.front().parts.front().name, "EARLY");
}

TEST(Find, ReportsTheTierOfAnAnswer) {
  const auto tier_of = [](std::string_view text) { return find(parse(text), weather()).front().tier; };
  EXPECT_EQ(tier_of("gloss = VANNES"), "Gloss");
  EXPECT_EQ(tier_of("gloss = VANNES & phase = stroke"), "Phase");
  EXPECT_EQ(tier_of("tier(\"Mouthing\") = \"matin\""), "Mouthing");
  EXPECT_EQ(tier_of("unit"), "Gloss");
  EXPECT_EQ(tier_of("gloss = MATIN -> gloss = NUAGES"), "Gloss");
}

TEST(Find, ALongUnitIsNamedAfterItsFirstSigns) {
  TestCorpus corpus;
  corpus.recording("r").tier("Gloss").tier("Phase");
  for (int i = 0; i < 70; ++i) corpus.sign("Gloss", "A", {Milliseconds(10 * i), Milliseconds(10 * i + 10)});
  const std::vector<Segment> found = find(parse("unit"), corpus.table());
  ASSERT_EQ(found.size(), 1U);
  std::string name;
  for (int i = 0; i < 64; ++i) name += "A ";
  EXPECT_EQ(found.front().name, name + "…");
}

TEST(Find, AnEmptyTableHasNoAnswers) {
  for (const char* text : {"gloss = A", "phase = stroke", "tier(\"X\") = \"a\"", "duration > 1ms", "parent(gloss = A)",
                           "gloss =~ /.*/ -> gloss = A", "gloss = A overlaps gloss = B", "!(recording = \"r\")"}) {
    EXPECT_THAT(find(parse(text), SegmentTable()), IsEmpty()) << text;
  }
}

TEST(Hints, NameNearMatchesOfAnUnknownGlossTierOrRecording) {
  const auto texts = [](std::string_view text) {
    std::vector<std::string> result;
    for (const Notice& notice : hints(parse(text), weather())) result.push_back(notice.text);
    return result;
  };
  EXPECT_THAT(texts("gloss = \"VANES\""), ElementsAre("no sign has the gloss \"VANES\"; did you mean VANNES?"));
  EXPECT_THAT(texts("!(tier(\"Mouthin\") = \"x\")"),
              ElementsAre("no recording has a tier \"Mouthin\"; did you mean Mouthing?"));
  EXPECT_THAT(texts("recording = \"metio\" -> parent(gloss = \"MATI\")"),
              ElementsAre(HasSubstr("did you mean meteo?"), HasSubstr("did you mean MATIN?")));
  EXPECT_THAT(texts("gloss =~ /VANN/"), ElementsAre(HasSubstr("/VANN/")));
  EXPECT_THAT(texts("gloss = \"VANNES\" & tier(\"Mouthing\") = \"nothing\""), IsEmpty());
}

TEST(Explain, SaysWhichIndexIsUsed) {
  const auto explained = [](std::string_view text) { return explain(parse(text), weather()); };
  EXPECT_EQ(explained("gloss = VANNES & phase = stroke"),
            "gloss = \"VANNES\" & phase = stroke\n"
            "1. look up about 6 rows: the gloss index and the phases of its signs (gloss = \"VANNES\")\n"
            "2. keep those with gloss = \"VANNES\" & phase = stroke\n");
  EXPECT_THAT(explained("phase = stroke & duration > 300ms"), HasSubstr("the phase index (phase = stroke)"));
  EXPECT_THAT(explained("duration > 300ms"), HasSubstr("all rows"));
  EXPECT_THAT(explained("parent(gloss = BREST) & duration > 1ms"), HasSubstr("the children of the gloss index"));
  EXPECT_THAT(explained("gloss =~ /.*/ -> gloss = BREST"), HasSubstr("1. look up about 1 rows: the gloss index"));
  EXPECT_EQ(
      explained("(gloss = MATIN -> gloss = NUAGES) & duration < 2s overlaps (gloss = VANNES -> gloss = BREST)"),
      "(gloss = \"MATIN\" -> gloss = \"NUAGES\") & duration < 2000ms overlaps (gloss = \"VANNES\" -> gloss = "
      "\"BREST\")\n"
      "1. look up about 2 rows: the gloss index (gloss = \"MATIN\")\n"
      "2. keep those with gloss = \"MATIN\"\n"
      "3. the row directly after: keep those with gloss = \"NUAGES\"\n"
      "4. keep those where (gloss = \"MATIN\" -> gloss = \"NUAGES\") has duration < 2000ms\n"
      "5. find the partner: (gloss = \"MATIN\" -> gloss = \"NUAGES\") overlaps a match found in its recording by:\n"
      "6.    look up about 1 rows: the gloss index (gloss = \"BREST\")\n"
      "7.    keep those with gloss = \"BREST\"\n"
      "8.    the row directly before: keep those with gloss = \"VANNES\"\n");
  EXPECT_THAT(explained("duration > 1ms overlaps tier(\"Mouthing\") = \"pluie\""), HasSubstr("the label index"));
}

}  // namespace
}  // namespace signweave
