#include "signweave/formats/eaf/generate.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "signweave/formats/eaf/test_support.h"

namespace signweave::eaf {
namespace {

using namespace testing_support;
using testing::HasSubstr;

AnnotationDocument one_sign() {
  AnnotationDocument document;
  document.author = "signweave";
  document.date = "2026-01-02T03:04:05Z";
  document.linked_files = {{"a.bvh", "./a.bvh", "unknown", 120ms, false}};
  document.types = {{"gloss", Stereotype::none, "signs"}, {"phase", Stereotype::time_subdivision, ""}};
  document.tiers = {{"Gloss", "gloss", "", "Hélène", "", "lsf", {{"a1", "VANNES", {100ms, 600ms}, "", true}}},
                    {"Phase",
                     "phase",
                     "Gloss",
                     "",
                     "",
                     "",
                     {{"", "Préparation", {100ms, 200ms}, "a1", true}, {"", "Stroke", {200ms, 600ms}, "a1", true}}}};
  return document;
}

TEST(EafGenerate, AGeneratedDocumentIsACompleteFile) {
  EXPECT_EQ(write_text(one_sign()), R"(<?xml version="1.0" encoding="UTF-8"?>
<ANNOTATION_DOCUMENT AUTHOR="signweave" DATE="2026-01-02T03:04:05Z" FORMAT="3.0" VERSION="3.0" xmlns:xsi="http://www.w3.org/2001/XMLSchema-instance" xsi:noNamespaceSchemaLocation="http://www.mpi.nl/tools/elan/EAFv3.0.xsd">
    <HEADER MEDIA_FILE="" TIME_UNITS="milliseconds">
        <LINKED_FILE_DESCRIPTOR LINK_URL="a.bvh" MIME_TYPE="unknown" RELATIVE_LINK_URL="./a.bvh" TIME_ORIGIN="120"/>
        <PROPERTY NAME="lastUsedAnnotationId">3</PROPERTY>
    </HEADER>
    <TIME_ORDER>
        <TIME_SLOT TIME_SLOT_ID="ts1" TIME_VALUE="100"/>
        <TIME_SLOT TIME_SLOT_ID="ts2" TIME_VALUE="200"/>
        <TIME_SLOT TIME_SLOT_ID="ts3" TIME_VALUE="600"/>
    </TIME_ORDER>
    <TIER LANG_REF="lsf" LINGUISTIC_TYPE_REF="gloss" PARTICIPANT="Hélène" TIER_ID="Gloss">
        <ANNOTATION>
            <ALIGNABLE_ANNOTATION ANNOTATION_ID="a1" TIME_SLOT_REF1="ts1" TIME_SLOT_REF2="ts3">
                <ANNOTATION_VALUE>VANNES</ANNOTATION_VALUE>
            </ALIGNABLE_ANNOTATION>
        </ANNOTATION>
    </TIER>
    <TIER LINGUISTIC_TYPE_REF="phase" PARENT_REF="Gloss" TIER_ID="Phase">
        <ANNOTATION>
            <ALIGNABLE_ANNOTATION ANNOTATION_ID="a2" TIME_SLOT_REF1="ts1" TIME_SLOT_REF2="ts2">
                <ANNOTATION_VALUE>Préparation</ANNOTATION_VALUE>
            </ALIGNABLE_ANNOTATION>
        </ANNOTATION>
        <ANNOTATION>
            <ALIGNABLE_ANNOTATION ANNOTATION_ID="a3" TIME_SLOT_REF1="ts2" TIME_SLOT_REF2="ts3">
                <ANNOTATION_VALUE>Stroke</ANNOTATION_VALUE>
            </ALIGNABLE_ANNOTATION>
        </ANNOTATION>
    </TIER>
    <LINGUISTIC_TYPE CONTROLLED_VOCABULARY_REF="signs" GRAPHIC_REFERENCES="false" LINGUISTIC_TYPE_ID="gloss" TIME_ALIGNABLE="true"/>
    <LINGUISTIC_TYPE CONSTRAINTS="Time_Subdivision" GRAPHIC_REFERENCES="false" LINGUISTIC_TYPE_ID="phase" TIME_ALIGNABLE="true"/>
    <LANGUAGE LANG_ID="lsf" LANG_LABEL="lsf"/>
    <CONSTRAINT DESCRIPTION="Time subdivision of parent annotation's time interval, no time gaps allowed within this interval" STEREOTYPE="Time_Subdivision"/>
    <CONSTRAINT DESCRIPTION="Symbolic subdivision of a parent annotation. Annotations refering to the same parent are ordered" STEREOTYPE="Symbolic_Subdivision"/>
    <CONSTRAINT DESCRIPTION="1-1 association with a parent annotation" STEREOTYPE="Symbolic_Association"/>
    <CONSTRAINT DESCRIPTION="Time alignable annotations within the parent annotation's time interval, gaps are allowed" STEREOTYPE="Included_In"/>
    <CONTROLLED_VOCABULARY CV_ID="signs"/>
</ANNOTATION_DOCUMENT>
)");
}

TEST(EafGenerate, EveryGoodFileIsReproducedFromItsModelAlone) {
  for (const auto& entry : std::filesystem::directory_iterator(testdata("eaf"))) {
    AnnotationDocument document = without_source(read(entry.path()).document);
    for (Tier& tier : document.tiers) {
      if (document.find_type(tier.type) == nullptr) document.types.push_back({tier.type, Stereotype::none, ""});
    }
    const AnnotationDocument again = reread(document);
    ASSERT_EQ(again.tiers.size(), document.tiers.size());
    for (const Tier& tier : document.tiers) EXPECT_EQ(*again.find_tier(tier.id), tier) << entry.path();
    EXPECT_EQ(again.types, document.types) << entry.path();
    EXPECT_EQ(again.linked_files, document.linked_files) << entry.path();
  }
}

TEST(EafGenerate, WithoutADateTheBytesDoNotDependOnTheClock) {
  AnnotationDocument document = one_sign();
  document.date.clear();
  EXPECT_THAT(write_text(document), HasSubstr("DATE=\"1970-01-01T00:00:00+00:00\""));
}

TEST(EafGenerate, ParentsAreWrittenFirst) {
  AnnotationDocument document = one_sign();
  std::swap(document.tiers[0], document.tiers[1]);
  const AnnotationDocument again = reread(document);
  EXPECT_EQ(again.tiers[0].id, "Gloss");
  EXPECT_EQ(times(again, "Phase"), "a2 100-200, a3 200-600");
}

TEST(EafGenerate, ATypeThatIsOnlyReferredToIsDeclared) {
  AnnotationDocument document = one_sign();
  document.types.clear();
  const File again = read_text("x", write_text(document));
  EXPECT_TRUE(again.notices.empty());
  EXPECT_EQ(again.document.find_type("phase")->stereotype, Stereotype::included_in);
}

TEST(EafGenerate, ATierWithoutATypeIsRefused) {
  AnnotationDocument document = one_sign();
  document.tiers[1].type.clear();
  EXPECT_THROW(write_text(document), Error);
}

TEST(EafGenerate, UnalignedAnnotationsStayUnalignedWhereElanShowsThemThere) {
  AnnotationDocument document = one_sign();
  document.tiers[1].annotations = {{"b1", "", {100ms, 266ms}, "a1", false},
                                   {"b2", "", {266ms, 432ms}, "a1", false},
                                   {"b3", "", {432ms, 600ms}, "a1", false}};
  EXPECT_THAT(write_text(document), HasSubstr("<TIME_SLOT TIME_SLOT_ID=\"ts2\"/>\n"));
  EXPECT_EQ(reread(document).tiers, document.tiers);

  document.tiers[1].annotations[1].span.end = document.tiers[1].annotations[2].span.begin = 500ms;
  const AnnotationDocument again = reread(document);
  EXPECT_EQ(times(again, "Phase"), "b1 100-266, b2 266-500, b3 500-600");  // times before marks
  EXPECT_TRUE(again.find_tier("Phase")->annotations[0].aligned);
}

TEST(EafGenerate, AnyLabelSurvivesARoundTrip) {
  AnnotationDocument document = one_sign();
  document.tiers[0].annotations[0].label = " <&>\"'\r\n\t]]> \u200B é e\u0301 \U0001F44B ";
  document.tiers[0].id = "a\"b'<&>\n\t";
  document.tiers[1].parent = document.tiers[0].id;
  const AnnotationDocument again = reread(document);
  EXPECT_EQ(again.tiers[0].annotations[0].label, document.tiers[0].annotations[0].label);
  EXPECT_EQ(again.tiers[0].id, document.tiers[0].id);
}

}  // namespace
}  // namespace signweave::eaf
