#include "signweave/semantic_db/segment_bytes.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "signweave/kv/sealed.h"

namespace signweave {
namespace {

using testing::HasSubstr;

constexpr const char* kWhere = "table";

/// This many signs with a stroke each: most lists are longer than one block of the check.
SegmentTable large_table() {
  constexpr int kSigns = 20'000;
  SegmentChunk chunk{.tiers = {"Gloss", "Phase"}, .labels = {"stroke"}, .rows = {}};
  for (int i = 0; i < kSigns; ++i) {
    chunk.labels.push_back("G" + std::to_string(i));
    const auto label = static_cast<std::uint32_t>(i + 1);
    chunk.rows.push_back({.kind = RowKind::sign,
                          .label = label,
                          .text = label,
                          .span = {Milliseconds(2'000 * i), Milliseconds(2'000 * i + 500)}});
  }
  for (std::uint32_t i = 0; i < kSigns; ++i) {
    chunk.rows.push_back(
        {.kind = RowKind::phase, .phase = PhaseKind::stroke, .tier = 1, .span = chunk.rows[i].span, .parent = i});
  }
  const SegmentTable::Source source{"r", &chunk};
  return SegmentTable(std::span(&source, 1));
}

/// Offsets of the lists, by the layout in segment_bytes.h.
struct Places {
  TableCounts counts{};
  std::size_t at = kTableHead;

  explicit Places(ByteSpan bytes) { std::memcpy(&counts, bytes.data() + 2 * sizeof(std::uint32_t), sizeof counts); }
  std::size_t next(std::size_t count, std::size_t width = sizeof(std::uint32_t)) {
    const std::size_t here = at;
    at += (count * width + 7) / 8 * 8;
    return here;
  }
};

std::string refusal(const Bytes& bytes) {
  try {
    TableBytes::open(bytes, {}, kWhere);
  } catch (const Error& error) {
    return error.what();
  }
  return "accepted";
}

/// The message if the number at an offset is replaced.
template <typename T>
std::string refusal_with(Bytes bytes, std::size_t at, T value) {
  std::memcpy(bytes.data() + at, &value, sizeof value);
  return refusal(bytes);
}

struct ListOf {
  std::size_t at = 0;
  std::size_t count = 0;
  std::uint32_t bad = 0;
  const char* message = "";
};

TEST(SegmentBytes, AnOutOfRangeNumberIsRejectedInEveryList) {
  const SegmentTable table = large_table();
  const Bytes good(table.bytes().begin(), table.bytes().end());
  ASSERT_EQ(refusal(good), "accepted");
  Places places(good);
  const TableCounts& n = places.counts;
  std::vector<ListOf> lists;
  const auto below = [&](std::size_t count, std::uint32_t bound, const char* message) {
    lists.push_back({places.next(count), count, bound, message});
  };
  const auto ascending = [&](std::size_t count, const char* message) {
    lists.push_back({places.next(count + 1), count + 1, kNoRow, message});
  };
  ascending(n.texts, "texts out of order");
  places.next(n.text_bytes, 1);
  ascending(n.tiers, "texts out of order");
  places.next(n.tier_bytes, 1);
  ascending(n.recordings, "texts out of order");
  places.next(n.recording_bytes, 1);
  ascending(n.recordings, "tiers out of order");
  ascending(n.recordings, "recordings out of order");
  const std::size_t tiers = places.next(n.places, sizeof(SegmentTable::TierRows));
  below(n.texts, n.texts, "labels out of range");
  below(n.slots, n.texts, "texts out of range");
  ascending(n.texts, "labels out of order");
  below(n.rows - n.units, n.rows, "rows out of range");
  for (const std::uint32_t labels : n.labels_of_kinds) below(labels, n.texts, "labels out of range");
  for (const std::uint32_t phases : n.phases) below(phases, n.rows, "phases out of range");
  below(n.units, n.rows, "units out of range");
  places.next(n.rows);
  places.next(n.rows);
  below(n.rows, n.texts, "texts out of range");
  const std::size_t parents = places.at;
  below(n.rows, n.rows, "parents out of range");
  below(n.rows, n.places, "tiers out of range");
  const std::size_t flags = places.next(n.rows, sizeof(std::uint16_t));
  ascending(n.rows, "children out of order");
  below(n.children, n.rows, "children out of range");
  ASSERT_EQ(places.at, good.size());

  std::size_t tried = 0;
  for (const ListOf& list : lists) {
    for (const std::size_t i : {std::size_t{0}, list.count / 2, std::size_t{16'383}, std::size_t{16'384},
                                std::size_t{32'768}, list.count - 1}) {
      if (i >= list.count) continue;
      ++tried;
      EXPECT_THAT(refusal_with(good, list.at + i * sizeof(std::uint32_t), list.bad), HasSubstr(list.message))
          << i << " of " << list.count;
    }
  }
  EXPECT_GT(tried, 80U);

  // An error visible only across blocks: the last number of one block is greater than the first of the next.
  const std::size_t children = flags + (n.rows * sizeof(std::uint16_t) + 7) / 8 * 8;
  EXPECT_THAT(refusal_with(good, children + 16'384 * sizeof(std::uint32_t), std::uint32_t{1}),
              HasSubstr("children out of order"));

  // A list that never decreases but does not begin with 0.
  EXPECT_THAT(refusal_with(good, children, std::uint32_t{1}), HasSubstr("children out of order"));

  // Rows with an invalid kind, phase or hand; a phase without a sign.
  for (const std::size_t row : {0U, 4'095U, 4'096U, 20'000U, 32'768U, n.rows - 1}) {
    for (const unsigned bad : {1U << 9, 1U << 15, 5U << 2, 6U << 2, 7U << 2, 3U << 5}) {
      EXPECT_THAT(refusal_with(good, flags + row * sizeof(std::uint16_t), static_cast<std::uint16_t>(bad)),
                  HasSubstr("rows of a kind that does not exist"))
          << row << ", " << bad;
    }
    for (const unsigned fine : {1U, 4U << 2, 2U << 5, 1U << 7, 1U << 8}) {
      EXPECT_EQ(refusal_with(good, flags + row * sizeof(std::uint16_t), static_cast<std::uint16_t>(fine)), "accepted");
    }
  }
  std::size_t phases = 0;
  for (RowId row = 0; row < table.size(); row += 1'111) {
    const bool phase = table.kind(row) == RowKind::phase;
    phases += phase ? 1 : 0;
    EXPECT_THAT(refusal_with(good, parents + row * sizeof(std::uint32_t), kNoRow),
                HasSubstr(phase ? "rows of a kind that does not exist" : "accepted"))
        << row;
  }
  EXPECT_GT(phases, 10U);

  // Tiers.
  for (const SegmentTable::TierRows& bad :
       {SegmentTable::TierRows{1, 0, 0, 0, 0, 0}, SegmentTable::TierRows{0, 2, 0, 0, 0, 0},
        SegmentTable::TierRows{0, 0, 2, 1, 3, 4}, SegmentTable::TierRows{0, 0, 1, 3, 2, 4},
        SegmentTable::TierRows{0, 0, 1, 2, 4, 3}, SegmentTable::TierRows{0, 0, 1, 2, 3, n.rows + 1},
        SegmentTable::TierRows{0, 0, 1, 2, 3, 4, n.texts}}) {
    EXPECT_THAT(refusal_with(good, tiers, bad), HasSubstr("an invalid tier"));
  }
}

TEST(SegmentBytes, InvalidCountsAreRejected) {
  const SegmentTable table = large_table();
  const Bytes good(table.bytes().begin(), table.bytes().end());
  for (std::size_t i = 0; i < sizeof(TableCounts) / sizeof(std::uint32_t); ++i) {
    for (const std::uint32_t bad : {0x7fff'ffffU, kNoRow}) {
      EXPECT_THAT(refusal_with(good, (2 + i) * sizeof(std::uint32_t), bad), HasSubstr("damaged")) << i;
    }
  }
}

TEST(SegmentBytes, AnInvalidHeadIsRejected) {
  const SegmentTable table = large_table();
  const Bytes good(table.bytes().begin(), table.bytes().end());
  const std::size_t rows = (2 + 17) * sizeof(std::uint32_t);
  EXPECT_THAT(refusal_with(good, 0, std::uint32_t{0}), HasSubstr("an invalid head"));
  EXPECT_THAT(refusal_with(good, sizeof(std::uint32_t), std::uint32_t{2}), HasSubstr("an invalid head"));
  EXPECT_THAT(refusal_with(good, rows, kNoRow), HasSubstr("an invalid head"));
  EXPECT_THAT(refusal_with(good, rows, kNoRow - 1), HasSubstr("damaged"));
}

TEST(SegmentBytes, TheHashTableHasAFreeSlotAndNothingFollowsTheTable) {
  const SegmentTable table = large_table();
  Bytes good(table.bytes().begin(), table.bytes().end());
  const std::size_t slots = (2 + 7) * sizeof(std::uint32_t);
  const std::uint32_t count = Places(good).counts.slots;
  for (const std::uint32_t bad : {0U, 1U, 16'384U, count - 1, count + 1}) {
    EXPECT_THAT(refusal_with(good, slots, bad), HasSubstr("an invalid table of texts")) << bad;
  }
  good.resize(good.size() + 8);
  EXPECT_THAT(refusal(good), HasSubstr("bytes are left over"));
}

TEST(SegmentBytes, TheChecksumOfASealedTableIsReportedFirst) {
  const SegmentTable table = large_table();
  const Bytes good = kv::sealed(table.bytes());
  const SegmentTable read = TableBytes::open_sealed(good, {}, kWhere);
  ASSERT_EQ(read.size(), table.size());
  EXPECT_EQ(read.find_text("G77"), table.find_text("G77"));
  for (std::size_t at = 0; at < good.size(); at += at < 400 ? 1 : 9'973) {
    Bytes bad = good;
    bad[at] ^= std::byte{0x80};
    try {
      TableBytes::open_sealed(bad, {}, kWhere);
      FAIL() << at;
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ErrorCode::corrupt);
      EXPECT_THAT(error.what(), HasSubstr("its checksum does not fit")) << at;
    }
  }
  for (const std::size_t size : {std::size_t{0}, std::size_t{7}, std::size_t{8}, good.size() - 1}) {
    EXPECT_THROW(TableBytes::open_sealed(ByteSpan(good).first(size), {}, kWhere), Error) << size;
  }
}

TEST(SegmentBytes, ASealedTableWithAGoodChecksumIsStillChecked) {
  const SegmentTable table = large_table();
  Bytes bytes(table.bytes().begin(), table.bytes().end());
  const std::uint32_t bad = kNoRow - 1;
  std::memcpy(bytes.data() + bytes.size() - 2 * sizeof bad, &bad, sizeof bad);  // in the last list, the children
  try {
    TableBytes::open_sealed(kv::sealed(bytes), {}, kWhere);
    FAIL();
  } catch (const Error& error) {
    EXPECT_THAT(error.what(), HasSubstr("children out of range"));
  }
  std::memcpy(bytes.data(), &bad, sizeof bad);
  try {
    TableBytes::open_sealed(kv::sealed(bytes), {}, kWhere);
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::unsupported);
  }
}

}  // namespace
}  // namespace signweave
