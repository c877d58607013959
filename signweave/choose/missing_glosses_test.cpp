#include "signweave/choose/missing_glosses.h"

#include <gmock/gmock.h>

#include "signweave/annotation/document.h"

namespace signweave {
namespace {

using namespace std::chrono_literals;
using testing::ElementsAre;
using testing::IsEmpty;

Segments corpus() {
  AnnotationDocument document;
  Tier tier;
  tier.id = "Gloss";
  std::vector<Sign> signs;
  Milliseconds begin{0};
  for (const char* gloss : {"VANNES", "MATIN", "LE MANS", "ÉTÉ", "DÉJÀ", "DEJA", "VANNES"}) {
    Annotation annotation;
    annotation.id = std::to_string(begin.count());
    annotation.label = gloss;
    annotation.span = {begin, begin + 90ms};
    Sign sign;
    sign.gloss = gloss;
    sign.span = annotation.span;
    sign.tier = tier.id;
    sign.annotation = annotation.id;
    sign.inferred = true;
    sign.phases.push_back({PhaseKind::stroke, sign.span, "", ""});
    tier.annotations.push_back(annotation);
    signs.push_back(sign);
    begin += 100ms;
  }
  document.tiers.push_back(tier);
  const SegmentChunk chunk = segments_of(document, signs);
  const std::vector<SegmentTable::Source> sources = {{"meteo", &chunk, ""}};
  return Segments(SegmentTable(sources));
}

struct Fault {
  std::string text, suggestion;
};
Fault fault_of(std::string_view utterance) {
  try {
    require_glosses(parse_utterance(utterance), corpus());
  } catch (const MissingGlosses& error) {
    EXPECT_EQ(error.code(), ErrorCode::not_found);
    return {error.what(), error.suggestion};
  }
  return {};
}

TEST(MissingGlosses, NoneAreMissingIfAllExist) {
  EXPECT_NO_THROW(require_glosses(parse_utterance("VANNES MATIN#7 \"LE MANS\" \"meteo\"@0..10"), corpus()));
}

TEST(MissingGlosses, AllAreNamedWithSuggestions) {
  EXPECT_EQ(fault_of("VANES").text, "no sign 'VANES' in this database; did you mean VANNES?");
  EXPECT_EQ(fault_of("vannes , matin").text,
            "no signs 'vannes' and 'matin' in this database; did you mean VANNES , MATIN?");
  EXPECT_EQ(fault_of("vannes , matin").suggestion, "VANNES , MATIN");
  EXPECT_EQ(fault_of("deja").text, "no sign 'deja' in this database; did you mean DEJA or DÉJÀ?");
  EXPECT_EQ(fault_of("soleil").text, "no sign 'soleil' in this database");
  EXPECT_EQ(fault_of("soleil").suggestion, "");
  EXPECT_EQ(fault_of("soleil ete VANNES").text,
            "no signs 'soleil' and 'ete' in this database; did you mean ÉTÉ for 'ete'?");
  EXPECT_EQ(fault_of("matin#2 VANNES").suggestion, "MATIN#2 VANNES");
}

TEST(MissingGlosses, WordsOfOneGlossAreCombined) {
  EXPECT_EQ(fault_of("MATIN LE MANS").text, "no sign 'LE MANS' in this database; did you mean MATIN \"LE MANS\"?");
  EXPECT_EQ(fault_of("le mans , ete").suggestion, "\"LE MANS\" , ÉTÉ");
  EXPECT_EQ(fault_of("le , mans").suggestion, "") << "there is a pause between";
}

TEST(MissingGlosses, AreFoldedIfExactlyOneGlossMatches) {
  std::vector<Notice> notices;
  const Utterance folded = with_folded_glosses(parse_utterance("vannes . le mans MATIN ete"), corpus(), notices);
  EXPECT_EQ(to_string(folded), "VANNES . \"LE MANS\" MATIN ÉTÉ");
  std::vector<std::string> said;
  for (const Notice& notice : notices) said.push_back(notice.text);
  EXPECT_THAT(said,
              ElementsAre("'vannes' is signed as VANNES", "'le mans' is signed as LE MANS", "'ete' is signed as ÉTÉ"));
  const Utterance in_channels = parse_utterance("{neg: le mans vannes} MATIN{weak hold ..+1} ete");
  EXPECT_EQ(to_string(with_folded_glosses(in_channels, corpus(), notices)),
            "{neg: \"LE MANS\" VANNES} MATIN{weak hold ..+1} ÉTÉ");
  const Utterance in_parts =
      parse_utterance("[vannes ete | weak: vannes rest matin#2 | head: ete] [MATIN | weak: Matin]");
  notices.clear();
  EXPECT_EQ(to_string(with_folded_glosses(in_parts, corpus(), notices)),
            "[VANNES ÉTÉ | weak: VANNES rest MATIN#2 | head: ÉTÉ] [MATIN | weak: MATIN]");
  EXPECT_EQ(notices.size(), 6u);
  EXPECT_EQ(fault_of("[ete | weak: vanes]").suggestion, "[ÉTÉ | weak: VANNES]");
  EXPECT_THROW(with_folded_glosses(parse_utterance("vanes"), corpus(), notices), MissingGlosses)
      << "similar is not the same";
  EXPECT_THROW(with_folded_glosses(parse_utterance("deja"), corpus(), notices), MissingGlosses) << "two glosses match";
  notices.clear();
  EXPECT_EQ(to_string(with_folded_glosses(parse_utterance("MATIN"), corpus(), notices)), "MATIN");
  EXPECT_THAT(notices, IsEmpty());
}

TEST(MissingGlosses, LociStayAtTheirPlaces) {
  std::vector<Notice> notices;
  const auto folded = [&](const char* text) {
    return to_string(with_folded_glosses(parse_utterance(text), corpus(), notices));
  };
  EXPECT_EQ(folded("le{@a = @left; to @a} mans matin{@b = @a; to @b}"),
            "\"LE MANS\"{@a = @left; to @a} MATIN{@b = @a; to @b}");
  EXPECT_THROW(folded("le mans{to @left}"), MissingGlosses) << "a changed place is not the end of another gloss";
  EXPECT_THROW(folded("le mans{@a = @left}"), MissingGlosses);
}

}  // namespace
}  // namespace signweave
