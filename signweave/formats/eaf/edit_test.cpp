#include "signweave/formats/eaf/edit.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "signweave/formats/eaf/test_support.h"

namespace signweave::eaf {
namespace {

using namespace testing_support;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;
using testing::SizeIs;

std::string replaced(std::string text, std::string_view from, std::string_view to) {
  const std::size_t at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  EXPECT_EQ(text.find(from, at + 1), std::string::npos) << from << " occurs twice";
  return text.replace(at, from.size(), to);
}

/// Writes a document and checks that it reads back unchanged.
std::string written(const AnnotationDocument& document) {
  std::string text = write_text(document);
  EXPECT_EQ(without_source(read_text("written.eaf", text).document), without_source(document));
  return text;
}

TEST(EafEdit, AnUnchangedDocumentIsWrittenByteForByte) {
  std::size_t files = 0;
  for (const auto& entry : std::filesystem::directory_iterator(testdata("eaf"))) {
    const std::string text = read_file(entry.path());
    EXPECT_EQ(write_text(read(entry.path()).document), text) << entry.path();
    ++files;
  }
  EXPECT_GE(files, 8U);
}

TEST(EafEdit, AChangedLabelChangesItsBytesOnly) {
  AnnotationDocument document = constraints();
  annotation_of(document, "a30").label = "voyelle <é> & co";
  annotation_of(document, "a2").label = "";
  // CVE_REF, EXT_REF and everything around them stay.
  std::string expected =
      replaced(document.source, ">vowel</ANNOTATION_VALUE>", ">voyelle &lt;é&gt; &amp; co</ANNOTATION_VALUE>");
  expected = replaced(expected, ">oh no way<", "><");
  EXPECT_EQ(written(document), expected);
}

TEST(EafEdit, ALabelWithoutItsElementGetsOne) {
  AnnotationDocument document =
      read_text("x",
                "<ANNOTATION_DOCUMENT FORMAT=\"3.0\"><TIME_ORDER><TIME_SLOT TIME_SLOT_ID=\"t\" TIME_VALUE=\"1\"/>"
                "<TIME_SLOT TIME_SLOT_ID=\"u\" TIME_VALUE=\"2\"/></TIME_ORDER><TIER TIER_ID=\"A\">"
                "<ANNOTATION><ALIGNABLE_ANNOTATION ANNOTATION_ID=\"a\" TIME_SLOT_REF1=\"t\" TIME_SLOT_REF2=\"u\"/>"
                "</ANNOTATION><ANNOTATION><ALIGNABLE_ANNOTATION ANNOTATION_ID=\"b\" TIME_SLOT_REF1='u' "
                "TIME_SLOT_REF2='u'><ANNOTATION_VALUE/></ALIGNABLE_ANNOTATION></ANNOTATION></TIER>"
                "</ANNOTATION_DOCUMENT>")
          .document;
  annotation_of(document, "a").label = "one";
  annotation_of(document, "b").label = "two";
  written(document);
}

TEST(EafEdit, ATimeThatIsNotSharedChangesItsSlot) {
  AnnotationDocument document = constraints();
  annotation_of(document, "a16").span.end = 2950ms;
  EXPECT_EQ(written(document), replaced(document.source, "TIME_VALUE=\"2900\"", "TIME_VALUE=\"2950\""));
}

TEST(EafEdit, ABoundaryMovedOnBothSidesStaysOneSlot) {
  AnnotationDocument document = read_text("french.eaf", testfile("french.eaf")).document;
  annotation_of(document, "a2").span.end = annotation_of(document, "a3").span.begin = 1234ms;
  EXPECT_EQ(written(document), replaced(document.source, "TIME_VALUE=\"1200\"", "TIME_VALUE=\"1234\""));
}

TEST(EafEdit, ABoundaryMovedOnOneSideGetsASlotOfItsOwn) {
  AnnotationDocument document = read_text("french.eaf", testfile("french.eaf")).document;
  annotation_of(document, "a3").span.begin = 1234ms;
  const std::string text = written(document);
  EXPECT_THAT(text, HasSubstr("TIME_SLOT_ID=\"ts2\" TIME_VALUE=\"1200\"/>\n        <TIME_SLOT TIME_SLOT_ID=\"ts8\" "
                              "TIME_VALUE=\"1234\"/>\n"));  // in its place in time
  EXPECT_THAT(text, HasSubstr("ANNOTATION_ID=\"a3\" TIME_SLOT_REF1=\"ts8\" TIME_SLOT_REF2=\"ts3\""));
  EXPECT_EQ(tier_bytes(text, "Glose"), tier_bytes(document.source, "Glose"));
}

TEST(EafEdit, AParentMayMoveWithItsUnalignedChildren) {
  AnnotationDocument document = constraints();
  Annotation& parent = annotation_of(document, "a1");
  parent.span = {6000ms, 7200ms};
  std::swap(tier_of(document, "text").annotations[0], tier_of(document, "text").annotations[1]);
  const std::string text = write_text(document);
  const AnnotationDocument again = read_text("x", text).document;
  EXPECT_EQ(times(again, "text"), "a2 2000-5000, a1 6000-7200");
  EXPECT_EQ(times(again, "words"),
            "a13 2000-3000, a14 3000-4000, a15 4000-5000, a10 6000-6400, a11 6400-6800, a12 6800-7200");
  EXPECT_EQ(times(again, "letters"), "a20 6000-6133, a21 6133-6266, a22 6266-6400");
  for (const char* tier : {"letters", "tags", "words", "inner", "text"}) {
    EXPECT_EQ(tier_bytes(text, tier), tier_bytes(document.source, tier));  // the slots have moved
  }
}

TEST(EafEdit, AnUnalignedAnnotationMayBeAligned) {
  AnnotationDocument document = constraints();
  Annotation& first = annotation_of(document, "a10");
  first.span.end = 1500ms;
  first.aligned = true;
  const AnnotationDocument again = reread(document);
  EXPECT_EQ(times(again, "words").substr(0, 46), "a10 1000-1500, a11 1500-1750, a12 1750-2000, a");
  EXPECT_TRUE(again.find_tier("words")->annotations[0].aligned);
  EXPECT_FALSE(again.find_tier("words")->annotations[1].aligned);
}

TEST(EafEdit, ARemovedAnnotationLeavesNothingBehind) {
  AnnotationDocument document = read_text("french.eaf", testfile("french.eaf")).document;
  std::erase_if(tier_of(document, "Phase").annotations, [](const Annotation& one) { return one.id == "a7"; });
  const std::string text = written(document);
  EXPECT_THAT(text, Not(HasSubstr("a7")));
  EXPECT_THAT(text, HasSubstr("</ANNOTATION>\n    </TIER>\n    <LINGUISTIC_TYPE"));
  // ts6 is still the end of a6, ts7 that of the sign
  EXPECT_THAT(text, HasSubstr("ts6"));
  std::erase_if(tier_of(document, "Phase").annotations, [](const Annotation& one) { return one.id == "a6"; });
  EXPECT_THAT(written(document), Not(HasSubstr("ts6")));
}

TEST(EafEdit, AnAddedAnnotationGetsAnIdAndSharesItsNeighboursSlots) {
  AnnotationDocument document = read_text("french.eaf", testfile("french.eaf")).document;
  Tier& phases = tier_of(document, "Phase");
  phases.annotations[1].span.end = 1400ms;  // the stroke ends earlier, a hold takes its place
  phases.annotations.insert(phases.annotations.begin() + 2, {"", "Tenue", {1400ms, 1500ms}, "a1", true});
  const std::string text = write_text(document);
  EXPECT_THAT(text,
              HasSubstr("<ALIGNABLE_ANNOTATION ANNOTATION_ID=\"a8\" TIME_SLOT_REF1=\"ts8\" TIME_SLOT_REF2=\"ts3\">\n"
                        "                <ANNOTATION_VALUE>Tenue</ANNOTATION_VALUE>"));
  EXPECT_THAT(text, HasSubstr("ANNOTATION_ID=\"a3\" TIME_SLOT_REF1=\"ts2\" TIME_SLOT_REF2=\"ts8\""));
  EXPECT_THAT(text, HasSubstr("lastUsedAnnotationId\">8<"));
  phases.annotations[2].id = "a8";
  document.properties[0].second = "8";
  EXPECT_EQ(without_source(read_text("x", text).document), without_source(document));
}

TEST(EafEdit, AChainOfSubdivisionsIsRepairedAroundAChange) {
  AnnotationDocument document = constraints();
  Tier& letters = tier_of(document, "letters");
  letters.annotations.erase(letters.annotations.begin());  // nothing refers to it
  letters.annotations.push_back({"", "!", {}, "a10", false});
  const std::string text = write_text(document);
  EXPECT_THAT(text, HasSubstr("<REF_ANNOTATION ANNOTATION_ID=\"a21\" ANNOTATION_REF=\"a10\">"));
  EXPECT_THAT(text,
              HasSubstr("ANNOTATION_ID=\"a22\" ANNOTATION_REF=\"a10\" EXT_REF=\"er1\" PREVIOUS_ANNOTATION=\"a21\""));
  EXPECT_THAT(text, HasSubstr("ANNOTATION_ID=\"a41\" ANNOTATION_REF=\"a10\" PREVIOUS_ANNOTATION=\"a22\""));
  EXPECT_EQ(times(read_text("x", text).document, "letters"), "a21 1000-1111, a22 1111-1222, a41 1222-1333");
}

TEST(EafEdit, SubdivisionsInFileOrderGetNoChainUnlessTheyChange) {
  const std::string text =
      document({0, 100}, tier("A", "root", "", alignable("p", 1, 2)) +
                             tier("B", "divide", "A", reference("a", "p") + reference("b", "p") + reference("c", "p")));
  AnnotationDocument changed = read_text("x", text).document;
  annotation_of(changed, "b").label = "new";
  EXPECT_EQ(written(changed), replaced(text, "<ANNOTATION_VALUE>b<", "<ANNOTATION_VALUE>new<"));
  Tier& pieces = tier_of(changed, "B");
  std::swap(pieces.annotations[0], pieces.annotations[1]);
  EXPECT_EQ(times(reread(changed), "B"), "b 0-33, a 33-66, c 66-100");
}

TEST(EafEdit, AnnotationsOutOfTimeOrderStayWhereTheyAreInTheFile) {
  const std::string text = document(
      {0, 100, 200, 300}, tier("A", "root", "", alignable("late", 3, 4, "then") + alignable("early", 1, 2, "first")));
  AnnotationDocument changed = read_text("x", text).document;
  annotation_of(changed, "early").label = "new";
  EXPECT_EQ(written(changed), replaced(text, ">first<", ">new<"));
}

TEST(EafEdit, AChangedTierKeepsUnmodelledParts) {
  AnnotationDocument document = constraints();
  Tier& text_tier = tier_of(document, "text");
  text_tier.participant = "Ève \"P1\"";
  text_tier.annotator.clear();
  const std::string expected =
      replaced(document.source, " ANNOTATOR=\"me\" DEFAULT_LOCALE=\"en\" LANG_REF=\"eng\" PARTICIPANT=\"P1\"",
               " DEFAULT_LOCALE=\"en\" LANG_REF=\"eng\" PARTICIPANT=\"Ève &quot;P1&quot;\"");
  EXPECT_EQ(written(document), expected);
}

TEST(EafEdit, ARenamedTierIsMatchedByItsAnnotations) {
  AnnotationDocument document = constraints();
  tier_of(document, "tags").id = "étiquettes";
  EXPECT_EQ(written(document), replaced(document.source, "TIER_ID=\"tags\"", "TIER_ID=\"étiquettes\""));
}

TEST(EafEdit, TiersMayBeAddedRemovedAndReordered) {
  AnnotationDocument document = constraints();
  std::erase_if(document.tiers, [](const Tier& tier) { return tier.id == "tags" || tier.id == "inner"; });
  std::rotate(document.tiers.begin(), document.tiers.begin() + 2, document.tiers.end());  // text, letters, words
  Tier added{"notes", "note", "text", "", "", "nld", {{"a50", "à voir", {1000ms, 2000ms}, "a1", false}}};
  document.tiers.push_back(added);
  document.types.push_back({"note", Stereotype::symbolic_association, "notes"});
  const std::string text = written(document);
  for (const char* tier : {"letters", "words", "text"}) {
    EXPECT_EQ(tier_bytes(text, tier), tier_bytes(document.source, tier));
  }
  EXPECT_THAT(text,
              HasSubstr("    </TIER>\n    <TIER LANG_REF=\"nld\" LINGUISTIC_TYPE_REF=\"note\" PARENT_REF=\"text\" "
                        "TIER_ID=\"notes\">\n        <ANNOTATION>\n            <REF_ANNOTATION"));
  EXPECT_THAT(text, HasSubstr("    <LANGUAGE LANG_ID=\"nld\" LANG_LABEL=\"nld\"/>\n    <CONSTRAINT"));
  EXPECT_THAT(text, HasSubstr("    <CONTROLLED_VOCABULARY CV_ID=\"notes\"/>\n    <EXTERNAL_REF"));
  EXPECT_THAT(text, Not(HasSubstr("ts8")));  // only "inner" used it
}

TEST(EafEdit, ANewTypeBringsItsConstraint) {
  AnnotationDocument document = read_text("x", testfile("empty_elements.eaf")).document;
  document.types.push_back({"phase", Stereotype::time_subdivision, ""});
  document.tiers.push_back({"Phase", "phase", "Gloss", "", "", "", {}});
  const std::string text = written(document);
  EXPECT_THAT(text, HasSubstr("    <TIER LINGUISTIC_TYPE_REF=\"gloss\" TIER_ID=\"Gloss\"/>\n    <TIER "
                              "LINGUISTIC_TYPE_REF=\"phase\" PARENT_REF=\"Gloss\" TIER_ID=\"Phase\"/>\n"));
  EXPECT_THAT(text, HasSubstr("STEREOTYPE=\"Time_Subdivision\"/>\n</ANNOTATION_DOCUMENT>"));
}

TEST(EafEdit, ChangedTypesKeepUnmodelledParts) {
  AnnotationDocument document = constraints();
  document.types.back().controlled_vocabulary = "cv";
  document.types[2].stereotype = Stereotype::time_subdivision;
  EXPECT_EQ(written(document),
            replaced(document.source, "CONSTRAINTS=\"Included_In\"", "CONSTRAINTS=\"Time_Subdivision\""));
}

TEST(EafEdit, LinkedFilesAndPropertiesMayChange) {
  AnnotationDocument document = constraints();
  document.linked_files[0].url = "file:///b.mp4";
  document.linked_files[0].time_origin = 40ms;
  document.linked_files.push_back({"file:///b.bvh", "./b.bvh", "unknown", 0ms, false});
  document.properties[0].second = "urn:example:2";
  document.properties.emplace_back("by", "signweave");
  std::string expected = replaced(document.source, "MEDIA_URL=\"file:///a/b.mp4\" MIME_TYPE=\"video/mp4\"/>",
                                  "MEDIA_URL=\"file:///b.mp4\" MIME_TYPE=\"video/mp4\" TIME_ORIGIN=\"40\"/>\n        "
                                  "<LINKED_FILE_DESCRIPTOR LINK_URL=\"file:///b.bvh\" MIME_TYPE=\"unknown\" "
                                  "RELATIVE_LINK_URL=\"./b.bvh\"/>");
  expected = replaced(expected, "urn:example:1", "urn:example:2");
  expected = replaced(expected, "lastUsedAnnotationId\">40</PROPERTY>",
                      "lastUsedAnnotationId\">40</PROPERTY>\n        <PROPERTY NAME=\"by\">signweave</PROPERTY>");
  EXPECT_EQ(written(document), expected);
}

TEST(EafEdit, EmptyElementsAreOpenedAndMissingOnesAdded) {
  for (const char* name : {"empty_elements.eaf", "nothing.eaf"}) {
    AnnotationDocument document = read_text(name, testfile(name)).document;
    document.author = "\"me\" & <you>";
    document.linked_files.push_back({"a.mp4", "", "video/mp4", 0ms, true});
    document.properties.emplace_back("p", "v");
    if (document.tiers.empty()) {
      document.types = {{"gloss", Stereotype::none, ""}};
      document.tiers = {{"Gloss", "gloss", "", "", "", "", {}}};
    }
    document.tiers[0].annotations = {{"a1", "A", {5ms, 9ms}, "", true}, {"a2", "B", {9ms, 9ms}, "", true}};
    const std::string text = written(document);
    EXPECT_THAT(text, HasSubstr("        <TIME_SLOT TIME_SLOT_ID=\"ts1\" TIME_VALUE=\"5\"/>\n"));
    EXPECT_THAT(text, HasSubstr("    </TIME_ORDER>\n    <TIER LINGUISTIC_TYPE_REF=\"gloss\" TIER_ID=\"Gloss\">\n"));
    EXPECT_THAT(text, HasSubstr("        </ANNOTATION>\n    </TIER>\n    <LINGUISTIC_TYPE"));
    EXPECT_THAT(text, HasSubstr("    </HEADER>\n    <TIME_ORDER>\n"));
  }
}

TEST(EafEdit, LineEndsAndByteOrderMarkStay) {
  AnnotationDocument document = read_text("x", testfile("french_bom_crlf.eaf")).document;
  document.tiers[0].annotations.push_back({"a9", "fin", {3000ms, 3100ms}, "", true});
  const std::string text = written(document);
  EXPECT_TRUE(text.starts_with("\xEF\xBB\xBF<?xml"));
  EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), std::count(text.begin(), text.end(), '\r'));
  EXPECT_EQ(tier_bytes(text, "Phase"), tier_bytes(document.source, "Phase"));
}

TEST(EafEdit, OtherEncodingsBecomeUtf8WhenChanged) {
  for (const char* name : {"french_utf16.eaf", "french_latin1.eaf"}) {
    AnnotationDocument document = read_text(name, testfile(name)).document;
    const std::string original = testfile("french.eaf");
    document.tiers[1].annotations[0].label = "手";
    const std::string text = written(document);
    EXPECT_TRUE(text.starts_with("<?xml version=\"1.0\" encoding=\"UTF-8\"?>")) << text.substr(0, 60);
    EXPECT_EQ(text.size(), replaced(original,
                                    "<ANNOTATION_VALUE>Préparation</ANNOTATION_VALUE>\n            "
                                    "</ALIGNABLE_ANNOTATION>\n        </ANNOTATION>\n        <ANNOTATION>\n"
                                    "            <ALIGNABLE_ANNOTATION ANNOTATION_ID=\"a3\"",
                                    "<ANNOTATION_VALUE>手</ANNOTATION_VALUE>\n            "
                                    "</ALIGNABLE_ANNOTATION>\n        </ANNOTATION>\n        <ANNOTATION>\n"
                                    "            <ALIGNABLE_ANNOTATION ANNOTATION_ID=\"a3\"")
                                   .size() -
                               (std::string_view(name) == "french_latin1.eaf" ? 2 : 0));  // its apostrophe
  }
}

TEST(EafEdit, ADoctypeAndCommentsStay) {
  AnnotationDocument document = read_text("x", testfile("entities.eaf")).document;
  document.author = "me";
  EXPECT_EQ(written(document), replaced(document.source, "AUTHOR=\"\"", "AUTHOR=\"me\""));
  document = read_text("x", testfile("scripts.eaf")).document;
  document.tiers[0].annotations[6].label = "cooked";
  EXPECT_EQ(written(document), replaced(document.source, "<![CDATA[<raw> & cooked]]>", "cooked"));
}

TEST(EafEdit, OddTiersStayAsTheyAre) {
  const std::string text =
      document({0, 100, 200, 300}, tier("A", "fill", "", alignable("a1", 1, 2) + alignable("a9", 3, 4)) +
                                       tier("C", "divide", "A", alignable("a3", 1, 2)) +
                                       tier("D", "fill", "A", reference("a4", "a1")) +
                                       tier("E", "lost", "A", reference("a5", "a1")));
  AnnotationDocument document = read_text("x", text).document;
  tier_of(document, "A").annotations[1].label = "new";
  EXPECT_EQ(written(document), replaced(text, "TIME_SLOT_REF1=\"ts3\" TIME_SLOT_REF2=\"ts4\"><ANNOTATION_VALUE>x<",
                                        "TIME_SLOT_REF1=\"ts3\" TIME_SLOT_REF2=\"ts4\"><ANNOTATION_VALUE>new<"));
}

TEST(EafEdit, ATypeThatBecomesSymbolicTurnsItsAnnotationsIntoReferences) {
  AnnotationDocument document = constraints();
  document.types[2].stereotype = Stereotype::symbolic_association;
  Annotation& inner = annotation_of(document, "a16");
  inner.aligned = false;
  inner.span = annotation_of(document, "a13").span;
  EXPECT_THAT(written(document), HasSubstr("<REF_ANNOTATION ANNOTATION_ID=\"a16\" ANNOTATION_REF=\"a13\">"));
}

TEST(EafEdit, SlotsOutOfOrderStayAndNewOnesGoToTheEnd) {
  const std::string text =
      document({200, 300, 0, 100}, tier("A", "root", "", alignable("a1", 1, 2) + alignable("a2", 3, 4)));
  AnnotationDocument changed = read_text("x", text).document;
  changed.tiers[0].annotations.push_back({"a3", "", {500ms, 600ms}, "", true});
  const std::string result = written(changed);
  EXPECT_THAT(result, HasSubstr("<TIME_SLOT TIME_SLOT_ID=\"ts4\" TIME_VALUE=\"100\"/>\n        <TIME_SLOT "
                                "TIME_SLOT_ID=\"ts5\" TIME_VALUE=\"500\"/>\n        <TIME_SLOT TIME_SLOT_ID=\"ts6\""));
}

}  // namespace
}  // namespace signweave::eaf
