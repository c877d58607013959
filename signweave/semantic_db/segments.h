#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "signweave/semantic_db/segment_table.h"

namespace signweave {

/// The segments of a database: several tables with disjoint recordings. Immutable; threads may share it.
///
/// Recordings are numbered by name over all tables. The number of a row is its number in its table plus the number of
/// rows of the tables before that one, so rows of one recording are in the order of their table.
class Segments {
 public:
  /// Marks entries of a recording as out of date in all tables older than `generation`.
  struct Tombstone {
    std::string recording;
    std::uint64_t generation = 0;
    friend bool operator==(const Tombstone&, const Tombstone&) = default;
  };
  struct Aged {
    SegmentTable table;
    std::uint64_t generation = 0;
  };
  /// One table, and which of its recordings are current.
  struct Member {
    SegmentTable table;
    RowId first = 0;                     ///< offset added to its row numbers
    std::vector<std::uint32_t> numbers;  ///< [recording of the table] its number here; kNone: not current
    bool whole = true;                   ///< all are current
  };

  Segments() = default;
  /// One table with all recordings.
  Segments(SegmentTable table);  // implicit: a table is the segments of its recordings
  explicit Segments(std::vector<Aged> tables, std::span<const Tombstone> tombstones = {});

  static constexpr std::uint32_t kNone = SegmentTable::kNone;

  std::span<const Member> members() const noexcept { return members_; }
  /// Number of rows of current recordings.
  std::size_t row_count() const noexcept { return rows_; }

  std::uint32_t recording_count() const noexcept { return static_cast<std::uint32_t>(recordings_.size()); }
  std::string_view recording_name(std::uint32_t recording) const noexcept;
  /// kNone if there is no recording of this name.
  std::uint32_t find_recording(std::string_view name) const noexcept;
  /// The table and index of a recording. Row numbers there and here differ by `first_row`.
  SegmentTable::RecordingRef part(std::uint32_t recording) const noexcept {
    return {&members_[recordings_[recording].first].table, recordings_[recording].second};
  }
  RowId first_row(std::uint32_t recording) const noexcept { return members_[recordings_[recording].first].first; }

  // Values of a row, which must belong to a current recording.

  RowKind kind(RowId row) const noexcept { return in_table(row, &SegmentTable::kind); }
  PhaseKind phase(RowId row) const noexcept { return in_table(row, &SegmentTable::phase); }
  Hand hand(RowId row) const noexcept { return in_table(row, &SegmentTable::hand); }
  bool inferred(RowId row) const noexcept { return in_table(row, &SegmentTable::inferred); }
  TimeSpan span(RowId row) const noexcept { return in_table(row, &SegmentTable::span); }
  std::uint32_t recording(RowId row) const noexcept;
  std::string_view label(RowId row) const noexcept;  ///< match form
  std::string_view text(RowId row) const noexcept;   ///< verbatim
  std::string_view tier(RowId row) const noexcept;
  RowId parent(RowId row) const noexcept;
  /// The rows whose parent is `row`, in time order.
  class Rows;
  Rows children(RowId row) const noexcept;
  SegmentTable::RowRange recording_rows(std::uint32_t recording) const noexcept;
  /// The own rows of the tier a row is on.
  SegmentTable::RowRange tier_rows_of(RowId row) const noexcept;
  /// The own rows of a tier of a recording; empty if there is no such tier.
  SegmentTable::RowRange tier_rows(std::uint32_t recording, std::string_view tier) const noexcept;

  /// The signs with a gloss (match form), by recording, then row.
  std::vector<RowId> signs_with(std::string_view gloss) const;
  /// All glosses (match form), sorted, without duplicates.
  std::vector<std::string> glosses() const;
  std::vector<std::string> recordings() const;
  /// The ids of all tiers, sorted, without duplicates.
  std::vector<std::string> tiers() const;

 private:
  const Member& member_of(RowId row) const noexcept {
    std::size_t at = members_.size() - 1;
    while (members_[at].first > row) --at;
    return members_[at];
  }
  template <typename Value>
  Value in_table(RowId row, Value (SegmentTable::*column)(RowId) const noexcept) const noexcept {
    const Member& member = member_of(row);
    return (member.table.*column)(row - member.first);
  }

  std::vector<Member> members_;
  std::vector<std::pair<std::uint32_t, std::uint32_t>>
      recordings_;  ///< [recording] index of the member, and the number in it
  std::size_t rows_ = 0;
};

/// Rows of one table, numbered over all tables.
class Segments::Rows {
 public:
  class Iterator {
   public:
    Iterator(const RowId* at, RowId first) noexcept : at_(at), first_(first) {}
    RowId operator*() const noexcept { return *at_ + first_; }
    Iterator& operator++() noexcept {
      ++at_;
      return *this;
    }
    bool operator==(const Iterator& other) const noexcept { return at_ == other.at_; }

   private:
    const RowId* at_;
    RowId first_;
  };
  Rows(std::span<const RowId> rows, RowId first) noexcept : rows_(rows), first_(first) {}
  Iterator begin() const noexcept { return {rows_.data(), first_}; }
  Iterator end() const noexcept { return {rows_.data() + rows_.size(), first_}; }

 private:
  std::span<const RowId> rows_;
  RowId first_;
};

inline Segments::Rows Segments::children(RowId row) const noexcept {
  const Member& member = member_of(row);
  return {member.table.children(row - member.first), member.first};
}

/// The Sign that a sign row and its phases were built from (without its annotation ids and signer).
Sign sign_at(const Segments& segments, RowId row);

/// All signs of a recording, by tier in the order of the table, then time.
std::vector<Sign> signs_of(const Segments& segments, std::uint32_t recording);

/// The phase rows of each sign, [sign][phase]: their indexes among all phase rows of the recording, which is the order
/// of its features.
std::vector<std::vector<std::size_t>> phase_places_of(const Segments& segments, std::uint32_t recording);

/// The signs of its main sign tier, the one with most signs (of several, the first): the tier used for runs of signs if
/// each hand has a tier of its own.
std::vector<Sign> main_signs_of(const Segments& segments, std::uint32_t recording);

}  // namespace signweave
