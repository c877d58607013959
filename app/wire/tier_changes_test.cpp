// The rules of writing tiers into an annotation: names, types, overlaps, and that everything else stays.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "app/wire/tier_changes.h"
#include "signweave/core/error.h"
#include "signweave/formats/eaf/eaf.h"

namespace signweave::wire {
namespace {

using namespace calls;

using testing::ElementsAre;
using testing::HasSubstr;

constexpr const char* kAnnotated = R"(<?xml version="1.0" encoding="UTF-8"?>
<!DOCTYPE x [<!ENTITY a "<TIER>">]>
<ANNOTATION_DOCUMENT AUTHOR='Zoé &amp; "co"' DATE="2026-01-01T00:00:00+00:00" FORMAT="3.0">
    <HEADER MEDIA_FILE="" TIME_UNITS="milliseconds">
        <PROPERTY NAME="lastUsedAnnotationId">144</PROPERTY>
    </HEADER>
    <!-- <TIER TIER_ID="no"> -->
    <TIME_ORDER>
        <TIME_SLOT TIME_SLOT_ID="ts1" TIME_VALUE="100"/>
        <TIME_SLOT TIME_SLOT_ID="ts9"/>
        <TIME_SLOT TIME_SLOT_ID="x"   TIME_VALUE="300" ></TIME_SLOT>
    </TIME_ORDER>
    <TIER LINGUISTIC_TYPE_REF="gloss" TIER_ID="Gloss" PARTICIPANT="Zoé">
        <ANNOTATION>
          <ALIGNABLE_ANNOTATION ANNOTATION_ID="a1" TIME_SLOT_REF1="ts1" TIME_SLOT_REF2="x" EXT_REF="er1" CVE_REF="cve7">
            <ANNOTATION_VALUE><![CDATA[A </TIER> B]]></ANNOTATION_VALUE></ALIGNABLE_ANNOTATION></ANNOTATION>
    </TIER>
    <TIER LINGUISTIC_TYPE_REF="gloss" TIER_ID="query 1"/>
    <TIER LINGUISTIC_TYPE_REF="mine" TIER_ID="Note" PARENT_REF="Gloss"/>
    <LINGUISTIC_TYPE LINGUISTIC_TYPE_ID="gloss" TIME_ALIGNABLE="true"/>
    <LINGUISTIC_TYPE LINGUISTIC_TYPE_ID="mine" CONSTRAINTS="Time_Subdivision" TIME_ALIGNABLE="true"/>
    <LOCALE LANGUAGE_CODE="en"/>
    <EXTERNAL_REF EXT_REF_ID="er1" TYPE="iso12620" VALUE="http://www.isocat.org/datcat/DC-1"/>
</ANNOTATION_DOCUMENT>
)";

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  for (std::size_t begin = 0; begin < text.size();) {
    const std::size_t end = std::min(text.find('\n', begin), text.size());
    lines.push_back(text.substr(begin, end - begin));
    begin = end + 1;
  }
  return lines;
}

/// The annotations of a tier of a written document, "begin..end label".
std::vector<std::string> annotations_of(const AnnotationDocument& document, const std::string& tier) {
  std::vector<std::string> found;
  if (document.find_tier(tier) == nullptr) return {"no such tier"};
  for (const Annotation& one : document.find_tier(tier)->annotations) {
    found.push_back(std::to_string(one.span.begin.count()) + ".." + std::to_string(one.span.end.count()) + ' ' +
                    one.label);
  }
  return found;
}

AnnotationDocument annotated() {
  return eaf::read_text("x.eaf", kAnnotated).document;
}
std::string written(const std::string& changes) {
  return eaf::write_text(with_tiers(annotated(), tier_changes_from_json(changes)));
}
std::string refusal(const std::string& changes) {
  try {
    with_tiers(annotated(), tier_changes_from_json(changes));
  } catch (const Error& error) {
    return error.what();
  }
  return "taken";
}

TEST(Annotate, SpreadsOverlappingAnnotationsOverTiersAndChangesNothingElse) {
  const std::string changes = R"({"tiers": [{"name": "query", "type": "query answers", "spread": true, "annotations": [
      {"begin_ms": 500, "end_ms": 800, "label": "B & <C>"}, {"begin_ms": 0, "end_ms": 600, "label": "A"},
      {"begin_ms": 600, "end_ms": 700, "label": "É"}]}]})";
  const std::string text = written(changes);
  const AnnotationDocument document = eaf::read_text("written.eaf", text).document;
  EXPECT_THAT(annotations_of(document, "query 1"), ElementsAre());
  EXPECT_THAT(annotations_of(document, "query 2"), ElementsAre("0..600 A", "600..700 É"));
  EXPECT_THAT(annotations_of(document, "query 3"), ElementsAre("500..800 B & <C>"));
  EXPECT_EQ(document.find_tier("query 3")->type, "query answers");
  // Only the line with the last annotation number differs; times, references and unmodelled elements stay.
  const std::vector<std::string> after = lines_of(text);
  for (const std::string& line : lines_of(kAnnotated)) {
    if (line.find("lastUsedAnnotationId") == line.npos) EXPECT_THAT(after, testing::Contains(line));
  }
  EXPECT_THAT(text, HasSubstr(">147</PROPERTY>"));
  EXPECT_THAT(text, HasSubstr("ANNOTATION_ID=\"a145\""));
}

TEST(Annotate, ReplacesATierWithItsPersonsAndProperties) {
  const std::string once = written(R"json({"tiers": [{"name": "Phase RH (checked)", "type": "mine",
      "annotator": "signweave, checked by A <b>", "participant": "Zoé", "annotations": [
      {"begin_ms": 150, "end_ms": 400, "label": "stroke"}, {"begin_ms": 50, "end_ms": 150, "label": "preparation"}]}],
      "properties": [{"name": "Phases (checked)", "value": "all & sundry"}]})json");
  const AnnotationDocument first = eaf::read_text("once.eaf", once).document;
  const Tier& tier = *first.find_tier("Phase RH (checked)");
  EXPECT_THAT(annotations_of(first, tier.id), ElementsAre("50..150 preparation", "150..400 stroke"));
  EXPECT_EQ(tier.annotator + '|' + tier.participant + '|' + tier.type, "signweave, checked by A <b>|Zoé|mine 2");
  EXPECT_THAT(once, HasSubstr("all &amp; sundry"));
  const TierChanges again = tier_changes_from_json(R"json({"remove": ["Phase RH (checked)"],
      "tiers": [{"name": "Phase RH (checked)", "type": "mine",
      "annotations": [{"begin_ms": 200, "end_ms": 400, "label": "hold"}]}],
      "properties": [{"name": "Phases (checked)", "value": "none"}]})json");
  const std::string twice = eaf::write_text(with_tiers(first, again));
  const AnnotationDocument second = eaf::read_text("twice.eaf", twice).document;
  EXPECT_THAT(annotations_of(second, "Phase RH (checked)"), ElementsAre("200..400 hold"));
  EXPECT_EQ(second.find_tier("Phase RH (checked)")->type, "mine 2");
  EXPECT_EQ(second.find_tier("Phase RH (checked)")->participant, "");
  EXPECT_THAT(twice, HasSubstr(">none</PROPERTY>"));
  EXPECT_EQ(twice.find("sundry"), std::string::npos);
  EXPECT_THAT(annotations_of(second, "Gloss"), ElementsAre("100..300 A </TIER> B"));
}

TEST(Annotate, NoChangeGivesTheSameBytes) {
  EXPECT_EQ(written("{}"), kAnnotated);
}

TEST(Annotate, RefusesChangesThatNoDocumentCanHold) {
  EXPECT_EQ(refusal(R"({"remove": ["Gloss"]})"), "tier 'Gloss' is the parent of 'Note': remove that first");
  EXPECT_EQ(refusal(R"({"remove": ["Note", "Gloss"]})"), "taken");
  EXPECT_THAT(refusal(R"({"remove": ["Glos"]})"), HasSubstr("no tier 'Glos'; did you mean Gloss?"));
  EXPECT_THAT(refusal(R"({"tiers": [{"name": "A", "type": "t", "annotations": [
      {"begin_ms": 0, "end_ms": 9, "label": ""}, {"begin_ms": 8, "end_ms": 10, "label": ""}]}]})"),
              HasSubstr("'spread' puts them onto several tiers"));
  EXPECT_THAT(refusal(R"({"tiers": [{"name": "A", "type": "t", "annotations": [{"begin_ms": 1.5}]}]})"),
              HasSubstr("tiers[0].annotations[0].begin_ms: expected a whole number"));
  EXPECT_EQ(refusal(R"({"tiers": {}})"), "tiers: expected a list");
  EXPECT_EQ(refusal(R"({"tiers": [1]})").substr(0, 9), "tiers[0].");
  EXPECT_THAT(refusal(R"({"properties": [{"name": "A"}]})"), HasSubstr("properties[0].value: missing"));
  EXPECT_THAT(refusal(R"({"removes": []})"), HasSubstr("did you mean remove?"));
  EXPECT_THROW(written(R"({"tiers": [{"name": "Note", "type": "t", "annotations": []}]})"), Error);
}

TEST(Annotate, ADocumentOfAnotherFormatBecomesEaf) {
  AnnotationDocument anvil = annotated();
  anvil.source_format = SourceFormat::anvil;
  anvil.source = "<annotation/>";
  const std::string text = eaf::write_text(with_tiers(
      anvil,
      tier_changes_from_json(
          R"({"tiers": [{"name": "A", "type": "t", "annotations": [{"begin_ms": 1, "end_ms": 2, "label": "x"}]}]})")));
  const AnnotationDocument document = eaf::read_text("x.eaf", text).document;
  EXPECT_THAT(annotations_of(document, "A"), ElementsAre("1..2 x"));
  EXPECT_THAT(annotations_of(document, "Gloss"), ElementsAre("100..300 A </TIER> B"));
}

}  // namespace
}  // namespace signweave::wire
