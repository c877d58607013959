#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <string>
#include <vector>

#include "signweave/annotation/sign.h"
#include "signweave/core/atomic_file.h"
#include "signweave/formats/eaf/eaf.h"

/// Annotation files by other authors, in the folder SIGNWEAVE_SHARED_DATA.
namespace signweave {
namespace {

std::filesystem::path shared(std::string_view path) {
  return std::filesystem::path(SIGNWEAVE_SHARED_DATA) / path;
}

std::vector<std::filesystem::path> annotation_files() {
  std::vector<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(SIGNWEAVE_SHARED_DATA)) {
    if (entry.path().extension() == ".eaf") files.push_back(entry.path());
  }
  std::sort(files.begin(), files.end());
  return files;
}

/// The bytes from one tier's start tag to the next, in file order.
std::vector<std::string> tier_bytes(const std::string& text) {
  std::vector<std::string> tiers;
  std::size_t at = text.find("<TIER ");
  while (at != std::string::npos) {
    const std::size_t next = text.find("<TIER ", at + 1);
    tiers.push_back(text.substr(at, std::min(next, text.find("<LINGUISTIC_TYPE ", at)) - at));
    at = next;
  }
  return tiers;
}

TEST(SharedEaf, ThereAreAtLeast36Files) {
  EXPECT_GE(annotation_files().size(), 36U);
}

TEST(SharedEaf, EveryFileIsReadWithoutANoticeAndWrittenByteForByte) {
  for (const std::filesystem::path& path : annotation_files()) {
    const eaf::File file = eaf::read(path);
    EXPECT_TRUE(file.notices.empty()) << path << ": " << file.notices.front().where << ": "
                                      << file.notices.front().text;
    EXPECT_EQ(eaf::write_text(file.document), read_file(path)) << path;
  }
}

TEST(SharedEaf, OneChangedLabelLeavesEveryOtherTiersBytes) {
  for (const std::filesystem::path& path : annotation_files()) {
    const AnnotationDocument before = eaf::read(path).document;
    for (std::size_t t = 0; t < before.tiers.size(); ++t) {
      AnnotationDocument after = before;
      if (after.tiers[t].annotations.empty()) continue;
      after.tiers[t].annotations.back().label = "changé <&>";
      const std::string text = eaf::write_text(after);
      AnnotationDocument again = eaf::read_text("after.eaf", text).document;
      again.source = after.source;
      EXPECT_TRUE(again == after) << path << " " << after.tiers[t].id;
      const std::vector<std::string> was = tier_bytes(before.source);
      const std::vector<std::string> is = tier_bytes(text);
      ASSERT_EQ(was.size(), before.tiers.size()) << path;
      ASSERT_EQ(is.size(), was.size()) << path;
      for (std::size_t i = 0; i < was.size(); ++i) EXPECT_EQ(is[i] == was[i], i != t) << path << " " << i;
    }
  }
}

TEST(SharedEaf, EveryFileIsRestoredFromItsModelAlone) {
  for (const std::filesystem::path& path : annotation_files()) {
    AnnotationDocument document = eaf::read(path).document;
    document.source.clear();
    const AnnotationDocument again = eaf::read_text("made.eaf", eaf::write_text(document)).document;
    EXPECT_TRUE(again.tiers == document.tiers) << path;
    EXPECT_TRUE(again.linked_files == document.linked_files) << path;
  }
}

std::size_t unaligned(const Tier& tier) {
  return static_cast<std::size_t>(std::count_if(tier.annotations.begin(), tier.annotations.end(),
                                                [](const Annotation& one) { return !one.aligned; }));
}

TEST(SharedEaf, PympiHasItsUnalignedAnnotationsInsideTheirParents) {
  for (const char* name : {"2.7", "2.8", "3.0"}) {
    const AnnotationDocument document = eaf::read(shared("eaf/pympi/sample_" + std::string(name) + ".eaf")).document;
    ASSERT_EQ(document.tiers.size(), 6U);
    EXPECT_EQ(document.format, name);
    const Tier& sentences = *document.find_tier("text");
    const Tier& words = *document.find_tier("words-timesub");
    EXPECT_EQ(unaligned(sentences), 0U);
    // 1,572 unaligned slots, each between two words of one sentence: four in each of the 393 sentences that have any.
    EXPECT_EQ(words.annotations.size(), 1995U);
    EXPECT_EQ(unaligned(words), 1965U);
    EXPECT_EQ(unaligned(*document.find_tier("gest_included")), 0U);
    std::size_t interpolated = 0;
    for (std::size_t i = 0; i < words.annotations.size(); ++i) {
      const Annotation& word = words.annotations[i];
      const Annotation& sentence = sentences.annotations.at(i / 5);
      EXPECT_EQ(word.parent, sentence.id);
      EXPECT_TRUE(sentence.span.contains(word.span));
      EXPECT_GT(word.span.duration(), 0ms);
      if (i % 5 != 0) {
        EXPECT_EQ(word.span.begin, words.annotations[i - 1].span.end);
        if (!word.aligned && !words.annotations[i - 1].aligned) ++interpolated;
      }
    }
    EXPECT_EQ(interpolated, 1572U);
    EXPECT_EQ(words.annotations[10].span, (TimeSpan{8000ms, 8600ms}));  // a fifth of 8,000 to 11,000
  }
}

TEST(SharedEaf, TheThreeVersionsOfPympiHoldTheSameAnnotations) {
  const AnnotationDocument oldest = eaf::read(shared("eaf/pympi/sample_2.7.eaf")).document;
  const AnnotationDocument middle = eaf::read(shared("eaf/pympi/sample_2.8.eaf")).document;
  const AnnotationDocument newest = eaf::read(shared("eaf/pympi/sample_3.0.eaf")).document;
  EXPECT_TRUE(middle.tiers == newest.tiers);
  ASSERT_EQ(oldest.tiers.size(), newest.tiers.size());
  for (std::size_t t = 0; t < newest.tiers.size(); ++t) {
    EXPECT_EQ(oldest.tiers[t].id, newest.tiers[t].id);
    EXPECT_EQ(oldest.tiers[t].type, newest.tiers[t].type);
    EXPECT_TRUE(oldest.tiers[t].annotations == newest.tiers[t].annotations) << newest.tiers[t].id;
    EXPECT_EQ(oldest.tiers[t].language, "");  // 2.7 has no languages
  }
  EXPECT_EQ(newest.find_tier("text")->language, "eng");
  EXPECT_TRUE(oldest.types == newest.types);
}

TEST(SharedEaf, OurOwnAnnotationsHoldSignsThatTheirPhasesFill) {
  std::size_t signs = 0;
  for (const std::filesystem::path& path : annotation_files()) {
    if (path.string().find("/bvh/") == std::string::npos) continue;
    const AnnotationDocument document = eaf::read(path).document;
    const TierNames names = guess_tier_names(document);
    ASSERT_EQ(names.sign_tiers.size(), 1U) << path;
    EXPECT_EQ(names.sign_tiers[0].id, "Gloss");
    EXPECT_EQ(names.phase_tiers, std::vector<std::string>{"Phase"});
    const SignsFound found = signs_in(document, names);
    EXPECT_TRUE(found.notices.empty()) << path << ": " << found.notices.front().text;
    for (const Sign& sign : found.signs) {
      EXPECT_FALSE(sign.inferred);
      EXPECT_TRUE(sign.stroke_span().has_value());
      ++signs;
    }
  }
  EXPECT_GE(signs, 8U);
}

TEST(SharedEaf, FilesWithoutSignTiersGiveNoGuess) {
  for (const std::filesystem::path& path : annotation_files()) {
    if (path.string().find("/eaf/") == std::string::npos) continue;
    const TierNames names = guess_tier_names(eaf::read(path).document);
    EXPECT_TRUE(names.sign_tiers.empty()) << path;
    EXPECT_TRUE(names.phase_tiers.empty()) << path;
  }
}

}  // namespace
}  // namespace signweave
