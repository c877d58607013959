#include "signweave/formats/anvil/anvil.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <fstream>

#include "signweave/annotation/sign.h"
#include "signweave/core/text.h"
#include "signweave/formats/annotation_file.h"
#include "signweave/formats/eaf/test_support.h"

namespace signweave::anvil {
namespace {

using eaf::testing_support::testdata;
using eaf::testing_support::times;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::SizeIs;

const Tier& tier(const File& file, std::string_view id) {
  const Tier* found = file.document.find_tier(id);
  if (found == nullptr) throw std::out_of_range(std::string(id));
  return *found;
}

std::vector<std::string> labels_of_tier(const File& file, std::string_view id) {
  std::vector<std::string> list;
  for (const Annotation& one : tier(file, id).annotations) list.push_back(one.label);
  return list;
}

Stereotype stereotype(const File& file, std::string_view id) {
  return file.document.find_type(tier(file, id).type)->stereotype;
}

File signs() {
  return read(testdata("anvil") / "signs.anvil");
}

std::string anvil_text(std::string_view tracks) {
  return fmt::format("<annotation><head/><body>{}</body></annotation>", tracks);
}

TEST(Anvil, TracksBecomeTiersWithTheirFullNames) {
  const File file = signs();
  std::vector<std::string> names;
  for (const Tier& one : file.document.tiers) names.push_back(one.id);
  EXPECT_THAT(names,
              ElementsAre("wave", "Hands.sentence", "Hands.sentence.mode", "Hands.Gloss", "Hands.Gloss.handedness",
                          "Hands.Gloss.comment", "Hands.Gloss.see", "Hands.Phase", "Hands.mouthing", "nod"));
  EXPECT_THAT(file.notices, IsEmpty());
}

TEST(Anvil, SecondsAreRoundedToMilliseconds) {
  EXPECT_EQ(times(signs().document, "Hands.Gloss"), "a2 500-1250, a3 1250-2000, a4 3000-3500");
}

TEST(Anvil, TheLabelIsTheTokenOrTheAttributeWithTheTracksName) {
  const File file = signs();
  EXPECT_THAT(labels_of_tier(file, "Hands.Gloss"), ElementsAre("BONJOUR", "TOUS", ""));
  EXPECT_THAT(labels_of_tier(file, "Hands.Phase"),
              ElementsAre("preparation", "stroke", "retraction", "preparation", "stroke", "hold"));
}

TEST(Anvil, TheLabelIsTheAttributeThatTheSpecificationDisplays) {
  EXPECT_THAT(labels_of_tier(signs(), "Hands.sentence"), ElementsAre("Bonjour à tous"));
}

TEST(Anvil, OtherAttributesAreAssociatedOneToOne) {
  const File file = signs();
  EXPECT_EQ(times(file.document, "Hands.Gloss.handedness"), "a2.2 500-1250, a3.2 1250-2000");
  EXPECT_EQ(eaf::testing_support::parents(file.document, "Hands.Gloss.handedness"), "a2.2<a2, a3.2<a3");
  EXPECT_EQ(stereotype(file, "Hands.Gloss.handedness"), Stereotype::symbolic_association);
  EXPECT_THAT(labels_of_tier(file, "Hands.Gloss.comment"), ElementsAre("looks & smiles"));
  EXPECT_THAT(labels_of_tier(file, "Hands.Gloss.see"), ElementsAre("Hands.Gloss[0], nod[0]"));
}

TEST(Anvil, ValueSetsAreVocabularies) {
  const File file = signs();
  const auto vocabulary = [&](std::string_view id) {
    return file.document.find_type(tier(file, id).type)->controlled_vocabulary;
  };
  EXPECT_EQ(vocabulary("Hands.Gloss.handedness"), "hands");
  EXPECT_EQ(vocabulary("Hands.Phase"), "Hands.Phase.Phase");
  EXPECT_EQ(vocabulary("Hands.Gloss"), "");
}

TEST(Anvil, SpansRunFromElementToElement) {
  const File file = signs();
  EXPECT_EQ(times(file.document, "Hands.sentence"), "a1 500-2000");
  EXPECT_EQ(stereotype(file, "Hands.sentence"), Stereotype::none);
}

TEST(Anvil, SubdivisionsFillTheirReferencesInOrderOfTime) {
  const File file = signs();
  EXPECT_EQ(times(file.document, "Hands.Phase"),
            "a8 500-700, a9 700-1100, a10 1100-1250, a5 1250-1500, a6 1500-1750, a7 1750-2000");
  EXPECT_EQ(eaf::testing_support::parents(file.document, "Hands.Phase"), "a8<a2, a9<a2, a10<a2, a5<a3, a6<a3, a7<a3");
  EXPECT_EQ(stereotype(file, "Hands.Phase"), Stereotype::time_subdivision);
  EXPECT_FALSE(tier(file, "Hands.Phase").annotations[4].aligned) << "its end was not in the file";
}

TEST(Anvil, SubdivisionsWithGapsLieInsideTheirReferences) {
  const File file = read_text("x", anvil_text("<track name='a' type='primary'><el start='0' end='2'/></track>"
                                              "<track name='b' type='subdivision' ref='a'><el-group ref='0'>"
                                              "<el start='0.5' end='0.75'/><el start='1'/></el-group></track>"));
  EXPECT_EQ(times(file.document, "b"), "a2 500-750, a3 1000-2000");
  EXPECT_EQ(stereotype(file, "b"), Stereotype::included_in);
}

TEST(Anvil, SingletonsTakeTheTimeOfTheirReference) {
  const File file = signs();
  EXPECT_EQ(times(file.document, "Hands.mouthing"), "a11 1250-2000");
  EXPECT_EQ(stereotype(file, "Hands.mouthing"), Stereotype::symbolic_association);
}

TEST(Anvil, PointsLastAMillisecondAndNeverOverlap) {
  EXPECT_EQ(times(signs().document, "nod"), "a12 900-900, a13 900-901");
}

TEST(Anvil, TheHeadGivesFilesAndProperties) {
  const AnnotationDocument document = signs().document;
  ASSERT_THAT(document.linked_files, SizeIs(2));
  EXPECT_EQ(document.linked_files[0].url, "signs.mp4");
  EXPECT_EQ(document.linked_files[0].mime_type, "video/mp4");
  EXPECT_TRUE(document.linked_files[0].media);
  EXPECT_EQ(document.linked_files[1].url, "signs.bvh");
  EXPECT_FALSE(document.linked_files[1].media);
  EXPECT_EQ(document.author, "Test person");
  EXPECT_THAT(document.properties, ElementsAre(testing::Pair("coder", "Test person"),
                                               testing::Pair("signweave:placeholder", "made by hand for a test")));
}

TEST(Anvil, WithoutSpecificationTheFirstAttributeIsTheLabel) {
  const std::string text = read_file(testdata("anvil") / "signs.anvil");
  const File file = read_text("signs.anvil", text);
  EXPECT_EQ(file.document.find_tier("Hands.sentence.mode"), nullptr);
  EXPECT_THAT(labels_of_tier(file, "Hands.sentence"), ElementsAre("Bonjour à tous"));
  EXPECT_THAT(labels_of_tier(file, "Hands.Gloss"), ElementsAre("BONJOUR", "TOUS", ""));
  EXPECT_THAT(labels_of_tier(file, "nod"), ElementsAre("0.5", "1"));
}

TEST(Anvil, AMissingSpecificationIsANotice) {
  const std::filesystem::path folder = testing::TempDir() + "/anvil_alone";
  std::filesystem::create_directories(folder / "inner");
  // Only the file's own folder counts, not the folder that the name refers to.
  std::filesystem::copy_file(testdata("anvil") / "signs.xml", folder / "signs.xml",
                             std::filesystem::copy_options::overwrite_existing);
  const std::filesystem::path file = folder / "inner" / "signs.anvil";
  std::filesystem::copy_file(testdata("anvil") / "signs.anvil", file,
                             std::filesystem::copy_options::overwrite_existing);
  const File found = read(file);
  ASSERT_THAT(found.notices, SizeIs(1));
  EXPECT_EQ(found.notices[0].text, "its specification 'signs.xml' is not in its folder; read without it");
  EXPECT_EQ(specification_of(file), std::filesystem::path());
  EXPECT_EQ(specification_of(testdata("anvil") / "signs.anvil"), testdata("anvil") / "signs.xml");
}

TEST(Anvil, Utf16ReadsTheSame) {
  const File file = read(testdata("anvil") / "signs_utf16.anvil");
  EXPECT_EQ(file.document.tiers, signs().document.tiers);
  EXPECT_EQ(annotation_file::format_of(file.document.source), SourceFormat::anvil);
}

TEST(Anvil, TheTextAndItsSpecificationReadBackAsTheFile) {
  const File file = signs();
  EXPECT_EQ(annotation_file::read_text("again", file.document.source, file.document.specification).document,
            file.document);
}

TEST(Anvil, IsWrittenAsEaf) {
  const File file = signs();
  const std::string text = eaf::write_text(file.document);
  const AnnotationDocument again = annotation_file::read_text("written.eaf", text).document;
  EXPECT_EQ(again.source_format, SourceFormat::eaf);
  ASSERT_EQ(again.tiers.size(), file.document.tiers.size());
  for (const Tier& one : file.document.tiers) {
    const Tier* same = again.find_tier(one.id);
    ASSERT_NE(same, nullptr) << one.id;
    EXPECT_EQ(same->parent, one.parent);
    ASSERT_EQ(same->annotations.size(), one.annotations.size()) << one.id;
    for (std::size_t i = 0; i < one.annotations.size(); ++i) {
      EXPECT_EQ(same->annotations[i].id, one.annotations[i].id);
      EXPECT_EQ(same->annotations[i].label, one.annotations[i].label);
      EXPECT_EQ(same->annotations[i].span, one.annotations[i].span) << one.id << ' ' << one.annotations[i].id;
    }
  }
}

TEST(Anvil, ItsSignsAndPhasesAreFound) {
  const AnnotationDocument document = signs().document;
  const TierNames names = guess_tier_names(document);
  ASSERT_THAT(names.sign_tiers, SizeIs(1));
  EXPECT_EQ(names.sign_tiers[0].id, "Hands.Gloss");
  EXPECT_THAT(names.phase_tiers, ElementsAre("Hands.Phase"));
}

TEST(Anvil, AnAttributesTierNeverTakesATracksName) {
  const File file = read_text("x", anvil_text("<track name='a' type='primary'><el start='0' end='1'>"
                                              "<attribute name='token'>x</attribute><attribute name='b'>y</attribute>"
                                              "</el></track><track name='a.b' type='primary'/>"));
  EXPECT_THAT(labels_of_tier(file, "a.b (attribute)"), ElementsAre("y"));
  EXPECT_THAT(labels_of_tier(file, "a.b"), IsEmpty());
}

TEST(Anvil, OverlapsAreNotices) {
  const File file = read_text("x", anvil_text("\n<track name='a' type='primary'><el start='0' end='2'/>\n"
                                              "<el start='1' end='3'/></track>"));
  ASSERT_THAT(file.notices, SizeIs(1));
  EXPECT_EQ(file.notices[0].where, "x:3");
  EXPECT_EQ(file.notices[0].text, "element 1 overlaps element 0 on track 'a'");
}

TEST(Anvil, AChainOfTracksMayBeLong) {
  std::string tracks;
  constexpr int kLength = 20'000;
  for (int i = kLength; i > 0; --i) {
    tracks += fmt::format("<track name='t{}' type='span' ref='t{}'><el start='0' end='0'/></track>", i, i - 1);
  }
  tracks += "<track name='t0' type='primary'><el start='1' end='2'/></track>";
  const File file = read_text("x", anvil_text(tracks));
  EXPECT_EQ(times(file.document, fmt::format("t{}", kLength)), "a1 1000-2000");
}

TEST(Anvil, TheFingerprintChangesWithTheSpecification) {
  const std::filesystem::path folder = testing::TempDir() + "/anvil_print";
  std::filesystem::create_directories(folder);
  for (const char* name : {"signs.anvil", "signs.xml"}) {
    std::filesystem::copy_file(testdata("anvil") / name, folder / name,
                               std::filesystem::copy_options::overwrite_existing);
  }
  const std::uint64_t before = annotation_file::fingerprint(folder / "signs.anvil");
  EXPECT_EQ(annotation_file::fingerprint(folder / "signs.anvil"), before);
  std::ofstream(folder / "signs.xml", std::ios::app) << "<!-- changed -->\n";
  EXPECT_NE(annotation_file::fingerprint(folder / "signs.anvil"), before);
}

RC_GTEST_PROP(AnvilProperty, AnyElementsReadAndAreWrittenAsEaf, ()) {
  // Primary elements one after another, each divided into parts.
  std::string primary;
  std::string pieces;
  std::int64_t at = 0;
  std::vector<TimeSpan> spans;
  const int count = *rc::gen::inRange(0, 12);
  for (int i = 0; i < count; ++i) {
    const std::int64_t begin = at + *rc::gen::inRange<std::int64_t>(0, 500);
    const std::int64_t end = begin + *rc::gen::inRange<std::int64_t>(1, 2000);
    at = end;
    spans.push_back({Milliseconds(begin), Milliseconds(end)});
    primary += fmt::format("<el index='{}' start='{:.3f}' end='{:.3f}'><attribute name='token'>{}</attribute></el>", i,
                           static_cast<double>(begin) / 1e3, static_cast<double>(end) / 1e3, i);
    const int parts = *rc::gen::inRange(0, 4);
    if (parts > 0) pieces += fmt::format("<el-group ref='{}'>", i);
    for (int k = 0; k < parts; ++k) pieces += fmt::format("<el index='{}'/>", 10 * i + k);
    if (parts > 0) pieces += "</el-group>";
  }
  const File file = read_text("x", anvil_text("<track name='p' type='subdivision' ref='s'>" + pieces +
                                              "</track><track name='s' type='primary'>" + primary + "</track>"));
  const Tier& signs = tier(file, "s");
  RC_ASSERT(signs.annotations.size() == spans.size());
  for (std::size_t i = 0; i < spans.size(); ++i) RC_ASSERT(signs.annotations[i].span == spans[i]);
  const AnnotationDocument again = eaf::read_text("y", eaf::write_text(file.document)).document;
  for (const Tier& one : file.document.tiers) {
    for (std::size_t i = 0; i < one.annotations.size(); ++i) {
      RC_ASSERT(again.find_tier(one.id)->annotations[i].span == one.annotations[i].span);
    }
  }
}

/// Names without ".anvil".
std::vector<std::string> broken_anvil_files() {
  std::vector<std::string> files;
  for (const auto& entry : std::filesystem::directory_iterator(testdata("anvil_broken"))) {
    if (entry.path().extension() == ".anvil") files.push_back(entry.path().stem().string());
  }
  std::sort(files.begin(), files.end());
  return files;
}

class BrokenAnvil : public testing::TestWithParam<std::string> {};

TEST_P(BrokenAnvil, IsRefusedWithOneClearLine) {
  const std::filesystem::path folder = testdata("anvil_broken");
  const std::string expected(trimmed(read_file(folder / (GetParam() + ".expected"))));
  try {
    read(folder / (GetParam() + ".anvil"));
    FAIL() << "was read";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::bad_input);
    EXPECT_EQ(error.what(), (folder / "").string() + expected);
  }
}

INSTANTIATE_TEST_SUITE_P(Testdata, BrokenAnvil, testing::ValuesIn(broken_anvil_files()),
                         [](const auto& one) { return one.param; });

TEST(BrokenAnvil, EveryPrefixOfAFileIsReadOrRefused) {
  const std::string whole = read_file(testdata("anvil") / "signs.anvil");
  for (std::size_t size = 0; size + 2 < whole.size(); ++size) {
    EXPECT_THROW(read_text("cut.anvil", std::string_view(whole).substr(0, size)), Error) << size;
  }
}

}  // namespace
}  // namespace signweave::anvil
