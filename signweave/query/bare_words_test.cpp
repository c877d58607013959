#include "signweave/query/bare_words.h"

#include <gmock/gmock.h>

#include "signweave/query/corpus_for_tests.h"

namespace signweave {
namespace {

using namespace std::chrono_literals;
using testing::ElementsAre;
using testing::IsEmpty;
using testing::Optional;

Segments corpus() {
  TestCorpus corpus = weather_corpus();
  corpus.recording("cars").tier("Gloss").tier("Phase");
  corpus.sign("Gloss", "LE MANS", {0ms, 500ms});
  corpus.sign("Gloss", "ÉTÉ", {600ms, 900ms});
  corpus.sign("Gloss", "vannes", {1'000ms, 1'300ms});
  corpus.sign("Gloss", "IX(loc)", {1'400ms, 1'500ms});
  return Segments(corpus.table());
}

std::vector<std::string> found(std::vector<std::string> words, std::optional<std::size_t> limit = {}) {
  std::vector<std::string> shown;
  for (const auto& [segment, match] : find_words(words, corpus(), {.limit = limit, .deadline = {}})) {
    shown.push_back(
        fmt::format("{} {} {} {}", word_of(match), segment.recording, segment.name, segment.span.begin.count()));
  }
  return shown;
}

std::vector<std::string> hints_of(std::vector<std::string> words) {
  std::vector<std::string> texts;
  for (const Notice& hint : word_hints(words, corpus())) texts.push_back(hint.text);
  return texts;
}

TEST(BareWords, AreSplitAtUsualSeparators) {
  EXPECT_THAT(bare_words("VANNES"), Optional(ElementsAre("VANNES")));
  EXPECT_THAT(bare_words(" vannes,\tmatin;  nuages\u00A0pluie\n"),
              Optional(ElementsAre("vannes", "matin", "nuages", "pluie")));
  EXPECT_THAT(bare_words("\"LE MANS\" “LE MANS” «LE MANS» matin"),
              Optional(ElementsAre("LE MANS", "LE MANS", "LE MANS", "matin")));
  EXPECT_THAT(bare_words(R"("say \"no\" \\")"), Optional(ElementsAre(R"(say "no" \)")));
  EXPECT_THAT(bare_words("aujourd'hui peut-être IX-1 A/B ça!"),
              Optional(ElementsAre("aujourd'hui", "peut-être", "IX-1", "A/B", "ça!")));
}

TEST(BareWords, AreAbsentIfTheTextHasAnOperator) {
  for (const char* text : {"", "  ", ",", "\"\"", "gloss = \"VANNES\"", "a & b", "a|b", "(a", "a -> b", "!a", "@stroke",
                           "$X", "duration<2s", "\"VANNES", "“VANNES\"", "/V.*/"}) {
    EXPECT_EQ(bare_words(text), std::nullopt) << text;
  }
  std::string many;
  for (int i = 0; i < 65; ++i) many += "a ";
  EXPECT_EQ(bare_words(many), std::nullopt);
}

TEST(FindWords, TheExactGlossComesFirstThenLooseMatches) {
  EXPECT_THAT(found({"VANNES"}),
              ElementsAre("exact cities VANNES 100", "exact meteo VANNES 2300", "folded cars vannes 1000",
                          "label meteo This morning, clouds over Vannes 0"));
  EXPECT_THAT(found({"vannes"}, 2), ElementsAre("exact cars vannes 1000", "folded cities VANNES 100"));
  EXPECT_THAT(found({"ete"}), ElementsAre("folded cars ÉTÉ 600"));
}

TEST(FindWords, OtherTiersComeLast) {
  EXPECT_THAT(found({"Pluie"}),
              ElementsAre("folded meteo PLUIE 6000", "folded meteo PLUIE 6000", "label meteo pluie 6050"));
  EXPECT_THAT(found({"fog"}), ElementsAre("label meteo Tomorrow, fog and rain 4000"));
}

TEST(FindWords, AWordOfAGlossIsFoundFromItsBeginning) {
  EXPECT_THAT(found({"mans"}), ElementsAre("part cars LE MANS 0"));
  EXPECT_THAT(found({"le", "mans"}), ElementsAre("folded cars LE MANS 0"));
  EXPECT_THAT(found({"brou"}), ElementsAre("part meteo BROUILLARD 4900"));
  EXPECT_THAT(found({"rouillard"}), IsEmpty());
}

TEST(FindWords, SeveralMatchASequenceOrElseAnyOfThem) {
  EXPECT_THAT(found({"matin", "nuages"}), ElementsAre("sequence meteo MATIN NUAGES 500"));
  EXPECT_THAT(found({"nuages", "matin"}), ElementsAre("some meteo MATIN 500", "some meteo NUAGES 1000",
                                                      "some meteo NUAGES 1000", "some meteo MATIN 4200"));
  EXPECT_THAT(found({"nothing", "fits"}), IsEmpty());
}

TEST(FindWords, StopsInTime) {
  const std::atomic<bool> cancel = true;
  const Segments segments = corpus();
  TestCorpus many;
  many.recording("a").tier("Gloss").tier("Phase");
  for (int i = 0; i < 2'000; ++i) many.sign("Gloss", "A", {i * 10ms, i * 10ms + 5ms});
  EXPECT_THROW(find_words({"a"}, Segments(many.table()), {.limit = {}, .deadline = {}, .cancel = &cancel}), Error);
}

TEST(WordHints, NameSimilarGlosses) {
  EXPECT_THAT(hints_of({"VANES"}), ElementsAre("nothing is called \"VANES\"; did you mean VANNES?"));
  EXPECT_THAT(hints_of({"Meteo"}),
              ElementsAre("nothing is called \"Meteo\"; it is a recording: did you mean recording = \"meteo\"?"));
  EXPECT_THAT(hints_of({"strokes"}), ElementsAre("nothing is called \"strokes\""));
  EXPECT_THAT(hints_of({"stroke"}), ElementsAre("nothing is called \"stroke\"; did you mean phase = stroke?"));
  EXPECT_THAT(hints_of({"vannes"}), IsEmpty());
}

TEST(WordHints, AGlossThatContainsAnOperatorIsRecognised) {
  EXPECT_TRUE(is_loosely_a_gloss("ix(LOC)", corpus()));
  EXPECT_FALSE(is_loosely_a_gloss("ix(", corpus()));
}

}  // namespace
}  // namespace signweave
