#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "signweave/formats/eaf/test_support.h"

namespace signweave::eaf {
namespace {

using namespace testing_support;
using testing::ElementsAre;
using testing::IsEmpty;
using testing::Pair;
using testing::SizeIs;

std::vector<std::string> labels(const Tier& tier) {
  std::vector<std::string> result;
  for (const Annotation& one : tier.annotations) result.push_back(one.label);
  return result;
}

std::vector<std::string> lines(const std::vector<Notice>& notices) {
  std::vector<std::string> result;
  for (const Notice& one : notices) result.push_back(one.where + ": " + one.text);
  return result;
}

TEST(EafRead, ThePapersExampleInFrench) {
  const File file = read_text("french.eaf", testfile("french.eaf"));
  EXPECT_THAT(lines(file.notices), IsEmpty());
  const AnnotationDocument& document = file.document;
  EXPECT_EQ(document.date, "2026-01-02T03:04:05+01:00");
  EXPECT_EQ(document.format, "3.0");
  ASSERT_THAT(document.tiers, SizeIs(2));
  const Tier& glosses = document.tiers[0];
  EXPECT_EQ(glosses.id, "Glose");
  EXPECT_EQ(glosses.type, "gloss");
  EXPECT_EQ(glosses.participant, "Hélène");
  EXPECT_THAT(labels(glosses), ElementsAre("MÉTÉO", "À-VANNES (L’été)"));
  EXPECT_EQ(times(document, "Glose"), "a1 1000-1700, a5 1700-2300");
  EXPECT_EQ(parents(document, "Phase"), "a2<a1, a3<a1, a4<a1, a6<a5, a7<a5");
  EXPECT_EQ(document.find_type("phase")->stereotype, Stereotype::time_subdivision);
  EXPECT_THAT(document.properties, ElementsAre(Pair("lastUsedAnnotationId", "7")));
}

TEST(EafRead, LinkedFilesKeepTheirTimeOrigin) {
  const AnnotationDocument document = read_text("french.eaf", testfile("french.eaf")).document;
  EXPECT_THAT(document.linked_files,
              ElementsAre(LinkedFile{"file:///corpus/météo.mp4", "./météo.mp4", "video/mp4", 1240ms, true},
                          LinkedFile{"file:///corpus/météo.bvh", "", "unknown", 120ms, false}));
}

TEST(EafRead, EveryEncodingGivesTheSameDocument) {
  const AnnotationDocument document = without_source(read_text("x", testfile("french.eaf")).document);
  EXPECT_EQ(without_source(read_text("x", testfile("french_utf16.eaf")).document), document);
  EXPECT_EQ(without_source(read_text("x", testfile("french_bom_crlf.eaf")).document), document);
  AnnotationDocument plain = document;  // ISO-8859-1 has no such apostrophe
  plain.tiers[0].annotations[1].label = "À-VANNES (L'été)";
  EXPECT_EQ(without_source(read_text("x", testfile("french_latin1.eaf")).document), plain);

  const std::string text = testfile("french.eaf");
  for (const bool big : {false, true}) {  // without a byte order mark
    for (const std::size_t width : {2U, 4U}) {
      std::string wide;
      for (const char c : std::string_view("<ANNOTATION_DOCUMENT FORMAT='3.0'/>")) {
        std::string unit(width, '\0');
        unit[big ? width - 1 : 0] = c;
        wide += unit;
      }
      EXPECT_EQ(read_text("x", wide).document.format, "3.0");
    }
  }
}

TEST(EafRead, CharactersBeyondSixteenBitsAreReadFromUtf16) {
  std::string wide = "\xFF\xFE";
  const std::string_view name = "<ANNOTATION_DOCUMENT FORMAT='3.0' AUTHOR='";
  for (const char c : name) wide += std::string{c, '\0'};
  wide += "\x3D\xD8\x4B\xDC";  // U+1F44B
  for (const char c : std::string_view("'/>")) wide += std::string{c, '\0'};
  EXPECT_EQ(read_text("x", wide).document.author, "👋");
}

TEST(EafRead, LabelsOfEveryScriptAreVerbatim) {
  const File file = read_text("scripts.eaf", testfile("scripts.eaf"));
  EXPECT_THAT(lines(file.notices), IsEmpty());
  EXPECT_EQ(file.document.tiers[0].id, "注釈");
  EXPECT_THAT(labels(file.document.tiers[0]), ElementsAre("手話", "شكرا", "СПАСИБО", "e\u0301te\u0301", "   ",
                                                          "👋🏽 & <b> \"", "<raw> & cooked", "two\nlines\t"));
}

TEST(EafRead, AllConstraintsWithChildrenBeforeTheirParents) {
  const File file = read_text("constraints.eaf", testfile("constraints.eaf"));
  EXPECT_THAT(lines(file.notices), IsEmpty());
  const AnnotationDocument& document = file.document;
  EXPECT_THAT(document.types,
              ElementsAre(TierType{"text", Stereotype::none, ""}, TierType{"word", Stereotype::time_subdivision, ""},
                          TierType{"inner", Stereotype::included_in, ""},
                          TierType{"letter", Stereotype::symbolic_subdivision, ""},
                          TierType{"tag", Stereotype::symbolic_association, "cv"}));
  EXPECT_EQ(document.tiers.front().id, "letters");
  EXPECT_EQ(document.tiers.back().id, "text");
  EXPECT_EQ(document.tiers.back().annotator, "me");
  EXPECT_EQ(document.tiers.back().language, "eng");
  EXPECT_EQ(times(document, "text"), "a1 1000-2000, a2 2000-5000");
  EXPECT_EQ(times(document, "words"),
            "a10 1000-1333, a11 1333-1666, a12 1666-2000, a13 2000-3000, a14 3000-4000, a15 4000-5000");
  EXPECT_EQ(parents(document, "words"), "a10<a1, a11<a1, a12<a1, a13<a2, a14<a2, a15<a2");
  EXPECT_EQ(times(document, "letters"), "a20 1000-1111, a21 1111-1222, a22 1222-1333");
  EXPECT_EQ(parents(document, "letters"), "a20<a10, a21<a10, a22<a10");
  EXPECT_EQ(times(document, "tags"), "a30 1111-1222");
  EXPECT_EQ(parents(document, "inner"), "a16<a13");
  EXPECT_TRUE(document.find_tier("inner")->annotations[0].aligned);
  EXPECT_FALSE(document.find_tier("words")->annotations[0].aligned);
  EXPECT_FALSE(document.find_tier("tags")->annotations[0].aligned);
}

TEST(EafRead, EntitiesOfADoctypeAreNotExpanded) {
  const File file = read_text("entities.eaf", testfile("entities.eaf"));
  EXPECT_EQ(file.document.tiers.at(0).annotations.at(0).label, "&c;");
  EXPECT_THAT(lines(file.notices),
              ElementsAre("entities.eaf:2: has a DOCTYPE: entities that it defines are not expanded"));
}

TEST(EafRead, OdditiesAreNotices) {
  const File file = read_text("version_9.eaf", testfile("version_9.eaf"));
  EXPECT_THAT(lines(file.notices),
              ElementsAre("version_9.eaf:2: EAF version '9.1' is not one of 2.6 to 3.0: read as 3.0",
                          "version_9.eaf:10: tier 'Gloss' is of type 'glos', which is not in the file",
                          "version_9.eaf:17: annotation 'a2' has no length: both its slots are at 100 ms"));
  EXPECT_EQ(times(file.document, "Gloss"), "a1 0-100, a2 100-100");
}

TEST(EafRead, KnownVersionsAreReadWithoutANotice) {
  for (const char* version : {"2.6", "2.7", "2.8", "3.0"}) {
    EXPECT_THAT(read_text("x", fmt::format("<ANNOTATION_DOCUMENT FORMAT=\"{}\"/>", version)).notices, IsEmpty());
  }
}

TEST(EafRead, TiersThatDoNotFitTheirTypesAreNotices) {
  const File file = read_text("x", document({0, 100}, tier("A", "fill", "", alignable("a1", 1, 2)) +
                                                          tier("B", "root", "A", alignable("a2", 1, 2)) +
                                                          tier("C", "divide", "A", alignable("a3", 1, 2)) +
                                                          tier("D", "fill", "A", reference("a4", "a1"))));
  EXPECT_THAT(lines(file.notices),
              ElementsAre("x:6: tier 'A' has no parent, though its type 'fill' needs one",
                          "x:9: tier 'B' has a parent, but its type 'root' has no constraint: read as Included_In",
                          "x:12: tier 'C' has annotations with times, which its type does not allow",
                          "x:15: tier 'D' has annotations without times, which its type does not allow"));
  EXPECT_EQ(parents(file.document, "B"), "a2<a1");
  EXPECT_EQ(parents(file.document, "C"), "a3<a1");
  EXPECT_EQ(times(file.document, "D"), "a4 0-100");
}

TEST(EafRead, OverlapsOnATierAreNotices) {
  const File file =
      read_text("x", document({0, 50, 100, 150}, tier("A", "root", "", alignable("a1", 1, 3) + alignable("a2", 2, 4))));
  EXPECT_THAT(lines(file.notices), ElementsAre("x:10: annotation 'a2' overlaps 'a1' on the same tier"));
}

TEST(EafRead, AnUnknownConstraintIsANotice) {
  const File file = read_text("x",
                              "<ANNOTATION_DOCUMENT FORMAT=\"3.0\">\n<LINGUISTIC_TYPE LINGUISTIC_TYPE_ID=\"t\" "
                              "CONSTRAINTS=\"Sideways\"/></ANNOTATION_DOCUMENT>");
  EXPECT_THAT(lines(file.notices), ElementsAre("x:2: type 't' has the unknown constraint 'Sideways': taken as none"));
}

TEST(EafRead, TheSourceIsKept) {
  const std::string text = testfile("french_utf16.eaf");
  EXPECT_EQ(read_text("x", text).document.source, text);
}

}  // namespace
}  // namespace signweave::eaf
