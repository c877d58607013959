#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "signweave/core/running_checksum.h"
#include "signweave/semantic_db/segment_table.h"

namespace signweave {

// The bytes of a SegmentTable. All numbers are little-endian, every list begins at a multiple of 8 bytes from the
// start, and the lists are in the order below, with the lengths given by the head:
//
//   u32 version = 1 | u32 wide (0 or 1) | u32 × 19 counts, in the order of TableCounts | u32 0
//   texts        u32 × (texts + 1) begins | their characters (UTF-8)         tiers, recordings: likewise
//   recordings   u32 × (recordings + 1) first place | u32 × (recordings + 1) first row
//   places       TierRows × places
//   labels       u32 × texts: the match form of each text | u32 × slots | u32 × (texts + 1) | u32 × rows without units
//   kinds        u32 × labels of annotations, signs, phases | u32 × rows of each phase kind | u32 × units
//   rows         i32 × rows begins, i32 × rows ends (wide: i64 × 2 × rows) | u32 × rows text | u32 × rows parent
//                u32 × rows place | u16 × rows flags | u32 × (rows + 1) first child | u32 × children
//
// A place is one tier of one recording. Slots are an open hash table of the texts, inserted in the order of their
// numbers: text i is in the first slot from checksum(text) & (slots − 1) onwards that was free at that time. The number
// of slots is a power of two, and at least one stays free.

/// Lengths of the lists.
struct TableCounts {
  std::uint32_t texts, text_bytes;
  std::uint32_t tiers, tier_bytes;
  std::uint32_t recordings, recording_bytes;
  std::uint32_t places;
  std::uint32_t slots;
  std::array<std::uint32_t, 3> labels_of_kinds;
  std::array<std::uint32_t, 5> phases;
  std::uint32_t units;
  std::uint32_t rows;
  std::uint32_t children;
};
static_assert(sizeof(TableCounts) == 19 * sizeof(std::uint32_t));

inline constexpr std::uint32_t kTableVersion = 1;
inline constexpr std::size_t kTableHead = 2 * sizeof(std::uint32_t) + sizeof(TableCounts) + sizeof(std::uint32_t);
static_assert(kTableHead % 8 == 0);
/// Annotations, signs and phases; units have no labels.
inline constexpr std::size_t kListedKinds = 3;

/// The lists a table is built from, without its indexes.
struct TableLists {
  std::vector<std::string> texts, tiers, recordings;
  std::vector<std::uint32_t> labels_of_texts;
  std::vector<std::uint32_t> recording_tiers = {0}, recording_begins = {0};
  std::vector<SegmentTable::TierRows> places;
  std::vector<TimeSpan> spans;  ///< [row], as are the following
  std::vector<std::uint32_t> texts_of_rows, places_of_rows;
  std::vector<RowId> parents;
  std::vector<std::uint16_t> flags;

  RowId rows() const noexcept { return static_cast<RowId>(spans.size()); }
};

/// Writes and reads these bytes.
class TableBytes {
 public:
  static std::uint16_t flags_of(const SegmentRow& row) noexcept;
  /// Throws Error{unsupported} if a count does not fit in 32 bits.
  static Bytes write(const TableLists& lists);
  /// As SegmentTable::open.
  static SegmentTable open(ByteSpan bytes, std::shared_ptr<const void> owner, const std::string& where);
  /// The same for a sealed record (kv/sealed.h). Also throws Error{corrupt} if the checksum does not match; that error
  /// takes precedence over all others.
  static SegmentTable open_sealed(ByteSpan record, std::shared_ptr<const void> owner, const std::string& where);

 private:
  class Reader;
  static SegmentTable open_adding(ByteSpan bytes, std::shared_ptr<const void> owner, const std::string& where,
                                  RunningChecksum* sum);
};

}  // namespace signweave
