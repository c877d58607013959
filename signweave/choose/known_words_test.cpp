#include "signweave/choose/known_words.h"

#include <gtest/gtest.h>

#include "signweave/annotation/document.h"

namespace signweave {
namespace {

/// Two recordings, each with one sign of these glosses, the second out of date.
Segments corpus(const char* current, const char* removed) {
  const auto chunk_of = [](const char* gloss) {
    AnnotationDocument document;
    document.tiers.push_back({});
    Tier& tier = document.tiers.back();
    tier.id = "Gloss";
    Annotation annotation;
    annotation.id = "a1";
    annotation.label = gloss;
    annotation.span = {Milliseconds(0), Milliseconds(90)};
    tier.annotations.push_back(annotation);
    Sign sign;
    sign.gloss = gloss;
    sign.span = annotation.span;
    sign.tier = tier.id;
    sign.annotation = annotation.id;
    return segments_of(document, std::vector<Sign>{sign});
  };
  const SegmentChunk first = chunk_of(current);
  const SegmentChunk second = chunk_of(removed);
  const std::vector<SegmentTable::Source> sources = {{"one", &first, ""}, {"two", &second, ""}};
  const std::vector<Segments::Tombstone> tombstones = {{"two", 2}};
  return Segments({{SegmentTable(sources), 1}}, tombstones);
}

TEST(KnownWords, AGlossIsKnownInItsMatchForm) {
  const Segments segments = corpus("E\u0301TE\u0301{A}", "GONE");
  EXPECT_TRUE(has_gloss(segments, "ÉTÉ{A}"));
  EXPECT_TRUE(has_gloss(segments, " ÉTÉ{A} "));
  EXPECT_FALSE(has_gloss(segments, "été{a}"));
  EXPECT_FALSE(has_gloss(segments, "ÉTÉ"));
}

TEST(KnownWords, NamesThatAreNoCurrentGlossAreUnknown) {
  const Segments segments = corpus("A", "GONE");
  EXPECT_FALSE(has_gloss(segments, "GONE"));
  EXPECT_FALSE(has_gloss(segments, "Gloss")) << "a tier";
  EXPECT_FALSE(has_gloss(segments, "one")) << "a recording";
}

}  // namespace
}  // namespace signweave
