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

std::vector<std::string> shown(const Vocabulary& words) {
  std::vector<std::string> result;
  for (const auto& [gloss, tokens] : words.glosses) result.push_back(fmt::format("{} {}", gloss, tokens));
  return result;
}

TEST(Vocabulary, CountsWhatIsFoundOverAllTables) {
  const Segments segments({{corpus("a", {"PLUIE", "LE MANS", "PLUIE"}), 1}, {corpus("b", {"PLUIE ", "VANNES"}), 2}});
  const Vocabulary words = vocabulary(segments);
  EXPECT_THAT(shown(words), ElementsAre("LE MANS 1", "PLUIE 3", "VANNES 1"));
  EXPECT_THAT(words.recordings, ElementsAre("a", "b"));
  EXPECT_THAT(words.tiers, Contains("Gloss"));
  for (const auto& [gloss, tokens] : words.glosses) {
    EXPECT_EQ(find(parse("gloss = \"" + gloss + "\""), segments).size(), tokens);
  }
}

TEST(Vocabulary, LeavesOutWhatIsNoMore) {
  const std::vector<Segments::Tombstone> gone = {{"a", 5}};
  const Segments segments({{corpus("a", {"PLUIE", "BREST"}), 1}, {corpus("b", {"PLUIE"}), 2}}, gone);
  const Vocabulary words = vocabulary(segments);
  EXPECT_THAT(shown(words), ElementsAre("PLUIE 1"));
  EXPECT_THAT(words.recordings, ElementsAre("b"));
}

TEST(Vocabulary, HasTheWordsThatQueriesAreMadeOf) {
  const LanguageWords words = language_words();
  EXPECT_THAT(words.fields, IsSupersetOf({"gloss", "phase", "tier", "duration", "signer"}));
  EXPECT_THAT(words.links, IsSupersetOf({"overlaps", "during", "equals"}));
  EXPECT_THAT(words.phases, IsSupersetOf({"stroke", "hold"}));
  EXPECT_THAT(words.functions, IsSupersetOf({"speed", "like", "track", "gaze"}));
  for (const std::string& point : words.points) EXPECT_NO_THROW(parse("speed(" + point + ") > 1 m/s")) << point;
}

}  // namespace
}  // namespace signweave
