#include "signweave/query/vocabulary.h"

#include <gmock/gmock.h>

#include "signweave/query/corpus_for_tests.h"
#include "signweave/query/find.h"
#include "signweave/query/parse.h"

namespace signweave {
namespace {

using namespace std::chrono_literals;
using testing::Contains;
using testing::ElementsAre;
using testing::IsSupersetOf;

SegmentTable corpus(const std::string& recording, const std::vector<std::string>& glosses) {
  TestCorpus corpus;
  corpus.recording(recording).tier("Gloss").tier("Phase");
  Milliseconds begin{0};
  for (const std::string& gloss : glosses) {
    corpus.sign("Gloss", gloss, {begin, begin + 100ms});
    begin += 200ms;
  }
  return corpus.table();
}

std::vector<std::string> shown_words(const Vocabulary& words) {
  std::vector<std::string> result;
  for (const auto& [gloss, tokens] : words.glosses) result.push_back(fmt::format("{} {}", gloss, tokens));
  return result;
}

TEST(Vocabulary, CountsOverAllTables) {
  const Segments segments({{corpus("a", {"PLUIE", "LE MANS", "PLUIE"}), 1}, {corpus("b", {"PLUIE ", "VANNES"}), 2}});
  const Vocabulary words = vocabulary(segments);
  EXPECT_THAT(shown_words(words), ElementsAre("LE MANS 1", "PLUIE 3", "VANNES 1"));
  EXPECT_THAT(words.recordings, ElementsAre("a", "b"));
  EXPECT_THAT(words.tiers, Contains("Gloss"));
  for (const auto& [gloss, tokens] : words.glosses) {
    EXPECT_EQ(find(parse("gloss = \"" + gloss + "\""), segments).size(), tokens);
  }
}

TEST(Vocabulary, OmitsRemovedRecordings) {
  const std::vector<Segments::Tombstone> gone = {{"a", 5}};
  const Segments segments({{corpus("a", {"PLUIE", "BREST"}), 1}, {corpus("b", {"PLUIE"}), 2}}, gone);
  const Vocabulary words = vocabulary(segments);
  EXPECT_THAT(shown_words(words), ElementsAre("PLUIE 1"));
  EXPECT_THAT(words.recordings, ElementsAre("b"));
}

TEST(Vocabulary, CountsTheLabelsOfATier) {
  const auto mouthed = [](const std::string& recording, const std::vector<std::string>& labels) {
    TestCorpus corpus;
    corpus.recording(recording).tier("Gloss").tier("Phase");
    corpus.sign("Gloss", "PLUIE", {0ms, 90ms});
    corpus.tier("Mouthing");
    for (std::size_t i = 0; i < labels.size(); ++i) corpus.annotation(labels[i], {i * 100ms, i * 100ms + 50ms});
    return corpus.table();
  };
  const std::vector<Segments::Tombstone> gone = {{"c", 5}};
  const Segments segments({{mouthed("a", {"nuage", "", "Pluie ", "nuage"}), 1},
                           {mouthed("b", {"pluie", "nuage"}), 2},
                           {mouthed("c", {"gone", "nuage"}), 3},
                           {corpus("d", {"nuage"}), 4}},
                          gone);
  std::vector<std::string> shown;
  for (const auto& [label, annotations] : labels_of(segments, "Mouthing")) {
    shown.push_back(fmt::format("{} {}", label, annotations));
    EXPECT_EQ(find(parse("tier(\"Mouthing\") = \"" + label + "\""), segments).size(), annotations);
  }
  EXPECT_THAT(shown, ElementsAre("Pluie 1", "nuage 3", "pluie 1"));
  EXPECT_THAT(labels_of(segments, "mouthing"), testing::IsEmpty());
  // Phases are on a tier of their own, including those inferred for signs without phases; the latter are not
  // annotations.
  EXPECT_THAT(labels_of(segments, "Phase"), testing::IsEmpty());
}

TEST(Vocabulary, HasTheWordsOfTheLanguage) {
  const LanguageWords words = language_words();
  EXPECT_THAT(words.fields, IsSupersetOf({"gloss", "phase", "tier", "duration", "signer"}));
  EXPECT_THAT(words.links, IsSupersetOf({"overlaps", "during", "equals"}));
  EXPECT_THAT(words.phases, IsSupersetOf({"stroke", "hold"}));
  EXPECT_THAT(words.functions, IsSupersetOf({"speed", "like", "track", "gaze"}));
  for (const std::string& point : words.points) EXPECT_NO_THROW(parse("speed(" + point + ") > 1 m/s")) << point;
}

}  // namespace
}  // namespace signweave
