#include "signweave/semantic_db/segment_table.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

namespace signweave {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

Annotation annotation(const std::string& id, const std::string& label, TimeSpan span, const std::string& parent = "") {
  Annotation result;
  result.id = id;
  result.label = label;
  result.span = span;
  result.parent = parent;
  return result;
}

Tier tier(const std::string& id, const std::string& parent, std::vector<Annotation> annotations) {
  Tier result;
  result.id = id;
  result.parent = parent;
  result.annotations = std::move(annotations);
  return result;
}

/// MATIN (preparation, stroke) and a sign without phases, VANNES; a note on MATIN, and a phase outside any sign.
AnnotationDocument weather() {
  AnnotationDocument document;
  document.tiers = {
      tier("Notes", "Gloss", {annotation("n1", "early", {0ms, 500ms}, "g1")}),
      tier("Gloss", "", {annotation("g1", " MATIN", {0ms, 500ms}), annotation("g2", "VANNES", {600ms, 900ms})}),
      tier("Phase", "Gloss",
           {annotation("p1", "prep", {0ms, 200ms}, "g1"), annotation("p2", "S", {200ms, 500ms}, "g1"),
            annotation("p3", "stray", {950ms, 990ms})}),
  };
  return document;
}

Sign sign(const std::string& gloss, TimeSpan span, const std::string& id, std::vector<Phase> phases) {
  Sign result;
  result.gloss = gloss;
  result.span = span;
  result.phases = std::move(phases);
  result.tier = "Gloss";
  result.annotation = id;
  return result;
}

std::vector<Sign> weather_signs() {
  Sign matin =
      sign(" MATIN", {0ms, 500ms}, "g1",
           {{PhaseKind::preparation, {0ms, 200ms}, "prep", "p1"}, {PhaseKind::stroke, {200ms, 500ms}, "S", "p2"}});
  Sign vannes = sign("VANNES", {600ms, 900ms}, "g2", {{PhaseKind::stroke, {600ms, 900ms}, "", ""}});
  vannes.hand = Hand::right;
  vannes.inferred = true;
  return {matin, vannes};
}

std::vector<std::string> texts(const SegmentTable& table, std::span<const RowId> rows) {
  std::vector<std::string> result;
  for (const RowId row : rows) result.emplace_back(std::string(table.text_at(table.text(row))));
  return result;
}

SegmentTable table_of(const SegmentChunk& chunk) {
  const SegmentTable::Source source{"meteo", &chunk};
  return SegmentTable(std::span(&source, 1));
}

TEST(SegmentsOf, EveryAnnotationIsOneRowAndAnInferredStrokeIsOneMore) {
  const SegmentChunk chunk = segments_of(weather(), weather_signs());
  ASSERT_EQ(chunk.rows.size(), 7U);
  std::vector<std::string> rows;
  for (const SegmentRow& row : chunk.rows) {
    rows.push_back(chunk.tiers[row.tier] + "/" + chunk.labels[row.label] + "/" +
                   std::to_string(static_cast<int>(row.kind)) + (row.extra ? "/extra" : ""));
  }
  EXPECT_THAT(rows, ElementsAre("Notes/early/0", "Gloss/MATIN/1", "Gloss/VANNES/1", "Gloss//2/extra", "Phase/prep/2",
                                "Phase/S/2", "Phase/stray/0"));
}

TEST(SegmentsOf, APhaseBelongsToItsSignAndEveryOtherRowToItsParentAnnotation) {
  const SegmentChunk chunk = segments_of(weather(), weather_signs());
  EXPECT_EQ(chunk.rows[0].parent, 1U);
  EXPECT_EQ(chunk.rows[1].parent, kNoRow);
  EXPECT_EQ(chunk.rows[3].parent, 2U);
  EXPECT_EQ(chunk.rows[3].span, (TimeSpan{600ms, 900ms}));
  EXPECT_TRUE(chunk.rows[3].inferred);
  EXPECT_EQ(chunk.rows[3].hand, Hand::right);
  EXPECT_EQ(chunk.rows[4].parent, 1U);
  EXPECT_EQ(chunk.rows[5].phase, PhaseKind::stroke);
  EXPECT_EQ(chunk.rows[6].parent, kNoRow);
}

TEST(SegmentsOf, ALabelIsStoredVerbatimAndInMatchForm) {
  const SegmentChunk chunk = segments_of(weather(), weather_signs());
  EXPECT_EQ(chunk.labels[chunk.rows[1].text], " MATIN");
  EXPECT_EQ(chunk.labels[chunk.rows[1].label], "MATIN");
}

TEST(SegmentsOf, APhaseOfTwoSignsIsAnExtraRowForTheSecond) {
  AnnotationDocument document = weather();
  document.tiers.push_back(tier("Left", "", {annotation("l1", "MATIN", {0ms, 500ms})}));
  std::vector<Sign> signs = weather_signs();
  signs.push_back(signs[0]);
  signs[2].tier = "Left";
  signs[2].annotation = "l1";
  signs[2].hand = Hand::left;
  const SegmentChunk chunk = segments_of(document, signs);
  const SegmentTable table = table_of(chunk);
  const RowId left = table.tier_rows(0, table.find_tier("Left"))->begin;
  ASSERT_EQ(table.children(left).size(), 2U);
  const SegmentRow stroke = table.row(table.children(left)[1]);
  EXPECT_TRUE(stroke.extra);
  EXPECT_FALSE(stroke.inferred);
  EXPECT_EQ(stroke.hand, Hand::left);
  EXPECT_EQ(table.tier_rows(0, table.find_tier("Phase"))->own().size(), 3U);
}

TEST(SegmentsOf, ADocumentWithoutIdsIsMatchedBySpanAndLabel) {
  AnnotationDocument document = weather();
  std::vector<Sign> signs = weather_signs();
  for (Tier& each : document.tiers) {
    for (Annotation& one : each.annotations) one.id = one.parent = "";
  }
  for (Sign& each : signs) {
    each.annotation = "";
    for (Phase& phase : each.phases) phase.annotation = "";
  }
  const SegmentChunk chunk = segments_of(document, signs);
  EXPECT_EQ(chunk.rows[2].kind, RowKind::sign);
  EXPECT_EQ(chunk.rows[5].kind, RowKind::phase);
  EXPECT_EQ(chunk.rows[5].parent, 1U);
}

TEST(SegmentsOf, ASignOfAnotherDocumentIsRejected) {
  std::vector<Sign> signs = weather_signs();
  signs[0].annotation = "g9";
  EXPECT_THROW(segments_of(weather(), signs), Error);
  signs = weather_signs();
  signs[0].phases[0].annotation = "p9";
  EXPECT_THROW(segments_of(weather(), signs), Error);
}

TEST(SegmentBytes, WhatIsEncodedIsDecoded) {
  const SegmentChunk chunk = segments_of(weather(), weather_signs());
  ByteWriter out;
  encode(chunk, out);
  ByteReader in(out.bytes(), "meteo");
  const SegmentChunk back = decode_segments(in);
  in.finish();
  EXPECT_EQ(back.tiers, chunk.tiers);
  EXPECT_EQ(back.labels, chunk.labels);
  EXPECT_EQ(back.rows, chunk.rows);
}

TEST(SegmentBytes, EveryCutIsCorrupt) {
  ByteWriter out;
  encode(segments_of(weather(), weather_signs()), out);
  for (std::size_t size = 0; size < out.size(); ++size) {
    ByteReader in(ByteSpan(out.bytes()).first(size), "meteo");
    EXPECT_THROW(decode_segments(in), Error) << size;
  }
}

RC_GTEST_PROP(SegmentBytes, DamageIsRejectedOrGivesAConsistentTable, ()) {
  ByteWriter out;
  encode(segments_of(weather(), weather_signs()), out);
  Bytes bytes = out.take();
  bytes[*rc::gen::inRange<std::size_t>(0, bytes.size())] = static_cast<std::byte>(*rc::gen::inRange(0, 256));
  try {
    ByteReader in(bytes, "meteo");
    const SegmentChunk chunk = decode_segments(in);
    const SegmentTable table = table_of(chunk);
    for (RowId row = 0; row < table.size(); ++row) {
      for (const RowId child : table.children(row)) RC_ASSERT(table.row(child).parent == row);
    }
  } catch (const Error& error) {
    RC_ASSERT(error.code() == ErrorCode::corrupt || error.code() == ErrorCode::unsupported);
  }
}

TEST(SegmentBytes, RowsOutOfOrderAndIndexesOutOfRangeAreCorrupt) {
  const SegmentChunk good = segments_of(weather(), weather_signs());
  const auto refuses = [](const SegmentChunk& chunk) {
    ByteWriter out;
    encode(chunk, out);
    try {
      ByteReader in(out.bytes(), "meteo");
      decode_segments(in);
    } catch (const Error& error) {
      return error.code() == ErrorCode::corrupt;
    }
    return false;
  };
  EXPECT_FALSE(refuses(good));
  SegmentChunk bad = good;
  std::swap(bad.rows[5], bad.rows[6]);
  EXPECT_TRUE(refuses(bad));
  bad = good;
  bad.rows[0].label = 99;
  EXPECT_TRUE(refuses(bad));
  bad = good;
  bad.rows[0].tier = 99;
  EXPECT_TRUE(refuses(bad));
  bad = good;
  bad.rows[4].parent = 99;
  EXPECT_TRUE(refuses(bad));
  bad = good;
  bad.rows[4].parent = kNoRow;
  EXPECT_TRUE(refuses(bad)) << "a phase has a sign";
  bad = good;
  bad.rows[0].span.end = Milliseconds::max();
  EXPECT_TRUE(refuses(bad));
}

TEST(SegmentBytes, ALaterVersionIsReportedAsSuch) {
  ByteWriter out;
  out.number(std::uint8_t{200});
  ByteReader in(out.bytes(), "meteo");
  try {
    decode_segments(in);
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::unsupported);
  }
}

TEST(SegmentTable, IndexesLeadToTheRows) {
  const SegmentChunk first = segments_of(weather(), weather_signs());
  const SegmentChunk second = first;
  const SegmentTable::Source sources[] = {{"cities", &first}, {"meteo", &second}};
  const SegmentTable table(sources);
  EXPECT_EQ(table.size(), 16U);
  const std::uint32_t vannes = table.find_text("VANNES");
  EXPECT_THAT(table.with_label(RowKind::sign, vannes), ElementsAre(2U, 10U));
  EXPECT_THAT(table.with_label(RowKind::phase, vannes), IsEmpty());
  EXPECT_THAT(table.phases(PhaseKind::stroke), ElementsAre(3U, 6U, 11U, 14U));
  EXPECT_THAT(table.phases(PhaseKind::hold), IsEmpty());
  EXPECT_EQ(table.find_recording("meteo"), 1U);
  EXPECT_EQ(table.find_text("BREST"), SegmentTable::kNone);
  EXPECT_EQ(table.find_tier("Mouthing"), SegmentTable::kNone);
  EXPECT_EQ(table.recording_rows(1), (SegmentTable::RowRange{8, 16}));
  EXPECT_EQ(table.tier_rows(1, table.find_tier("Gloss"))->own(), (SegmentTable::RowRange{9, 11}));
  EXPECT_EQ(table.tiers_of(1)[1].extra(), (SegmentTable::RowRange{11, 12}));
  EXPECT_THAT(texts(table, table.children(9)), ElementsAre("prep", "early", "S"));
  EXPECT_EQ(table.row(12).recording, 1U);
  EXPECT_THAT(table.units(), ElementsAre(4U, 12U));
  EXPECT_EQ(table.span(12), (TimeSpan{0ms, 900ms})) << "from the first sign to the last";
  EXPECT_THAT(table.glosses(), ElementsAre("MATIN", "VANNES"));
}

TEST(SegmentTable, AnEmptyTableReturnsEmptyResults) {
  const SegmentTable table;
  EXPECT_THAT(table.glosses(), IsEmpty());
  EXPECT_THAT(table.phases(PhaseKind::stroke), IsEmpty());
  EXPECT_THAT(table.with_label(RowKind::sign, 0), IsEmpty());
  EXPECT_EQ(table.tier_rows(0, 0), nullptr);
  EXPECT_EQ(table.recording_count(), 0U);
}

TEST(SegmentTable, OverlappingAnnotationsOfOneTierAreMarked) {
  AnnotationDocument document = weather();
  EXPECT_TRUE(table_of(segments_of(document, {})).tiers_of(0)[1].apart());
  document.tiers[1].annotations[0].span.end = 650ms;
  EXPECT_FALSE(table_of(segments_of(document, {})).tiers_of(0)[1].apart());
}

TEST(SegmentTable, ADuplicateRecordingIsRejected) {
  const SegmentChunk chunk;
  const SegmentTable::Source sources[] = {{"meteo", &chunk}, {"meteo", &chunk}};
  EXPECT_THROW(SegmentTable{sources}, Error);
}

TEST(SegmentTable, ARestOfASecondEndsAUnit) {
  SegmentChunk chunk{.tiers = {"Gloss"}, .labels = {"A"}, .rows = {}};
  for (const TimeSpan span : {TimeSpan{0ms, 400ms}, TimeSpan{1'399ms, 1'500ms}, TimeSpan{2'500ms, 2'600ms}}) {
    chunk.rows.push_back({.kind = RowKind::sign, .span = span});
  }
  const SegmentTable table = table_of(chunk);
  ASSERT_EQ(table.units().size(), 2U);
  EXPECT_EQ(table.span(table.units()[0]), (TimeSpan{0ms, 1'500ms}));
  EXPECT_EQ(table.span(table.units()[1]), (TimeSpan{2'500ms, 2'600ms}));
}

TEST(SegmentTable, TimesBeyondAMonthAreStored) {
  SegmentChunk chunk{.tiers = {"T"}, .labels = {"A"}, .rows = {}};
  chunk.rows.push_back({.span = {-5ms, 3'000'000'000ms}});
  const SegmentTable table = table_of(chunk);
  EXPECT_EQ(table.span(0), (TimeSpan{-5ms, 3'000'000'000ms}));
}

TEST(SegmentTable, ItsBytesAreATableAtAnyAddress) {
  const SegmentTable table = table_of(segments_of(weather(), weather_signs()));
  auto bytes = std::make_shared<Bytes>(table.bytes().begin(), table.bytes().end());
  bytes->insert(bytes->begin(), std::byte{0});
  const SegmentTable moved = SegmentTable::open(ByteSpan(*bytes).subspan(1), bytes, "here");
  EXPECT_EQ(moved.size(), table.size());
  for (RowId row = 0; row < table.size(); ++row) EXPECT_EQ(moved.row(row), table.row(row));
}

TEST(SegmentTable, EveryCutOfItsBytesIsCorrupt) {
  const SegmentTable table = table_of(segments_of(weather(), weather_signs()));
  for (std::size_t size = 0; size < table.bytes().size(); ++size) {
    const auto cut =
        std::make_shared<const Bytes>(table.bytes().begin(), table.bytes().begin() + static_cast<int>(size));
    EXPECT_THROW(SegmentTable::open(*cut, cut, "cut"), Error) << size;
  }
}

RC_GTEST_PROP(SegmentTable, DamageIsRejectedOrGivesATableThatCanBeRead, ()) {
  const SegmentTable table = table_of(segments_of(weather(), weather_signs()));
  const auto bytes = std::make_shared<Bytes>(table.bytes().begin(), table.bytes().end());
  (*bytes)[*rc::gen::inRange<std::size_t>(0, bytes->size())] = static_cast<std::byte>(*rc::gen::inRange(0, 256));
  try {
    const SegmentTable damaged = SegmentTable::open(*bytes, bytes, "damaged");
    std::size_t letters = 0;
    for (RowId row = 0; row < damaged.size(); ++row) {
      letters += damaged.text_at(damaged.label(row)).size() + damaged.tier_at(damaged.tier(row)).size() +
                 damaged.recording_at(damaged.recording(row)).size();
      for (const RowId child : damaged.children(row)) RC_ASSERT(child < damaged.size());
      for (const RowId other : damaged.with_label(damaged.kind(row), damaged.label(row))) {
        RC_ASSERT(other < damaged.size());
      }
      if (damaged.kind(row) == RowKind::phase) RC_ASSERT(damaged.parent(row) < damaged.size());
    }
    damaged.find_text("VANNES");
    RC_ASSERT(letters < 100'000'000U);
  } catch (const Error& error) {
    RC_ASSERT(error.code() == ErrorCode::corrupt || error.code() == ErrorCode::unsupported);
  }
}

}  // namespace
}  // namespace signweave
