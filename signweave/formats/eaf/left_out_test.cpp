#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "signweave/formats/eaf/test_support.h"

namespace signweave::eaf {
namespace {

using namespace testing_support;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

std::vector<std::string> notices_of(const File& file) {
  std::vector<std::string> texts;
  for (const Notice& notice : file.notices) texts.push_back(notice.where + ": " + notice.text);
  return texts;
}

/// Two signs, then one that ends before it begins, then another.
const std::string kReversed =
    document({0, 100, 200, 300, 400},
             tier("Gloss", "root", "", alignable("a1", 1, 2) + alignable("a2", 4, 3) + alignable("a3", 4, 5)) +
                 tier("Phase", "fill", "Gloss", alignable("b1", 4, 5)) +
                 tier("Note", "tag", "Gloss", reference("c1", "a1") + reference("c2", "a2")) +
                 tier("Sub", "divide", "Note", reference("d1", "c2") + reference("d2", "c1")));

TEST(EafLeftOut, AReversedAnnotationAndThoseThatReferToIt) {
  const File file = read_text("x.eaf", kReversed);
  EXPECT_EQ(times(file.document, "Gloss"), "a1 0-100, a3 300-400");
  EXPECT_EQ(parents(file.document, "Phase"), "b1<a3");
  EXPECT_EQ(times(file.document, "Note"), "c1 0-100");
  EXPECT_EQ(times(file.document, "Sub"), "d2 0-100");
  EXPECT_THAT(notices_of(file),
              ElementsAre("x.eaf:11: annotation 'a2' begins at 300 ms, after its end at 200 ms: left out; swap its "
                          "slots or correct a TIME_VALUE",
                          "x.eaf:19: annotation 'c2' refers to annotation 'a2', which is left out: left out; correct "
                          "that one",
                          "x.eaf:22: annotation 'd1' refers to annotation 'c2', which is left out: left out; correct "
                          "that one"));
  EXPECT_EQ(file.document.source, kReversed);
  EXPECT_EQ(write_text(file.document), kReversed);
}

TEST(EafLeftOut, IsRefusedOnRequest) {
  try {
    read_text("x.eaf", kReversed, Unsound::refused);
    FAIL() << "not refused";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::bad_input);
    EXPECT_THAT(error.what(), HasSubstr("x.eaf:11: annotation 'a2' begins at 300 ms, after its end at 200 ms; swap"));
  }
}

TEST(EafLeftOut, EveryFileThatIsRefusedForOneAnnotationIsReadWithoutIt) {
  struct Row {
    const char* name;
    const char* says;
    std::size_t annotations;
  };
  const Row rows[] = {
      {"slot_missing", "uses the time slot 'ts9', which TIME_ORDER does not have: left out; add it", 0},
      {"slot_reversed", "'a1' begins at 100 ms, after its end at 0 ms: left out", 0},
      {"slot_reversed_unaligned", "'a2' begins at 66 ms, after its end at 33 ms: left out", 1},
      {"annotation_without_slot", "annotation 'a1' has no TIME_SLOT_REF2: left out; add it", 0},
      {"reference_missing", "annotation 'a2' has no ANNOTATION_REF: left out; add it", 1},
      {"reference_to_nothing", "'a7', which is not in the file: left out; add it or remove this one", 1},
      {"reference_to_other_tier", "not on the parent tier 'Other': left out; refer to one that is", 1},
      {"reference_without_parent_tier", "though its tier has no parent: left out; give the tier", 1},
      {"previous_is_nothing", "make no chain", 2}};
  for (const Row& row : rows) {
    const std::string text = read_file(testdata("eaf_broken") / (std::string(row.name) + ".eaf"));
    const File file = read_text("x.eaf", text);
    std::size_t annotations = 0;
    for (const Tier& tier : file.document.tiers) annotations += tier.annotations.size();
    EXPECT_EQ(annotations, row.annotations) << row.name;
    EXPECT_THAT(notices_of(file), testing::Contains(HasSubstr(row.says))) << row.name;
    EXPECT_EQ(write_text(file.document), text) << row.name;
  }
}

TEST(EafLeftOut, StaysInTheFileWhileTheRestIsChanged) {
  File file = read_text("x.eaf", kReversed);
  Tier& gloss = tier_of(file.document, "Gloss");
  gloss.annotations[0].label = "ANOTHER";
  gloss.annotations.erase(gloss.annotations.begin() +
                          1);  // a3, which shares a slot with the annotation that was left out
  tier_of(file.document, "Phase").annotations.clear();
  Annotation added{.id = "a9", .label = "NEW", .span = {Milliseconds(500), Milliseconds(600)}};
  gloss.annotations.push_back(added);
  const std::string written = write_text(file.document);
  EXPECT_THAT(written, HasSubstr(R"(ANNOTATION_ID="a2" TIME_SLOT_REF1="ts4" TIME_SLOT_REF2="ts3")"));
  EXPECT_THAT(written, HasSubstr(R"(<TIME_SLOT TIME_SLOT_ID="ts4" TIME_VALUE="300"/>)"));
  EXPECT_THAT(written, HasSubstr(R"(<TIME_SLOT TIME_SLOT_ID="ts3" TIME_VALUE="200"/>)"));
  EXPECT_THAT(written, testing::Not(HasSubstr("\"ts5\""))) << "no annotation uses it any more";
  const File again = read_text("x.eaf", written);
  EXPECT_EQ(again.document.find_tier("Gloss")->annotations.size(), 2U);
  EXPECT_EQ(again.document.find_tier("Gloss")->annotations[1].label, "NEW");
  EXPECT_THAT(notices_of(again), testing::Contains(HasSubstr("'a2' begins at 300 ms, after its end at 200 ms: left")));
}

TEST(EafLeftOut, ItsTimesStayIfAnotherWithTheSameSlotIsMoved) {
  File file = read_text("x.eaf", kReversed);
  for (const char* tier : {"Gloss", "Phase"}) {
    tier_of(file.document, tier).annotations.back().span = {Milliseconds(320), Milliseconds(400)};
  }
  const File again = read_text("x.eaf", write_text(file.document));
  EXPECT_EQ(times(again.document, "Gloss"), "a1 0-100, a3 320-400");
  EXPECT_EQ(times(again.document, "Phase"), "b1 320-400");
  EXPECT_THAT(notices_of(again), testing::Contains(HasSubstr("'a2' begins at 300 ms, after its end at 200 ms: left")));
}

TEST(EafLeftOut, ItsIdIsNotGivenToAnother) {
  const std::string text =
      document({0, 100, 200}, tier("Gloss", "root", "", alignable("a1", 1, 2) + alignable("a7", 3, 2)));
  File file = read_text("x.eaf", text);
  Tier& gloss = tier_of(file.document, "Gloss");
  gloss.annotations.push_back({.label = "NEW", .span = {Milliseconds(100), Milliseconds(200)}});
  EXPECT_THAT(write_text(file.document), HasSubstr("ANNOTATION_ID=\"a8\""));
  gloss.annotations.back().id = "a7";
  EXPECT_THROW(write_text(file.document), Error);
}

TEST(EafLeftOut, ASoundFileHasNoNoticeOfIt) {
  EXPECT_THAT(notices_of(read_text("x.eaf", document({0, 100}, tier("Gloss", "root", "", alignable("a1", 1, 2))))),
              IsEmpty());
}

}  // namespace
}  // namespace signweave::eaf
