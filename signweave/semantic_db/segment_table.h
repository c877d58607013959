#pragma once

#include <cstdint>
#include <limits>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "signweave/annotation/sign.h"
#include "signweave/core/bytes.h"
#include "signweave/core/time.h"
#include "signweave/semantic_db/segment_chunk.h"

namespace signweave {

/// The segments of some recordings as columns, with indexes. The table is one contiguous run of bytes used as stored,
/// so opening it only costs its validation. Immutable; threads may share it.
///
/// Rows are numbered recording by recording, the recordings by name, and within one as in its chunk; the units of a
/// sign tier follow its rows. Texts, tiers and recordings are numbered within the table. More than fifteen members:
/// each is a column or an index.
class SegmentTable {
 public:
  struct Source {
    std::string recording;
    const SegmentChunk* chunk = nullptr;  ///< borrowed during construction only
    std::string signer = {};              ///< signer of all tiers without a signer in `tiers`; may be empty
    const TierNames* tiers = nullptr;     ///< borrowed during construction only; null: as if empty
  };
  SegmentTable() = default;
  /// Throws Error{unsupported} for more than 2^32 − 1 rows, Error{already_exists} if a name occurs twice.
  explicit SegmentTable(std::span<const Source> sources);

  /// A recording of a table.
  struct RecordingRef {
    const SegmentTable* table = nullptr;
    std::uint32_t recording = 0;
  };
  /// The table of recordings taken from other tables. Throws as the constructor does.
  static SegmentTable merged(std::span<const RecordingRef> parts);

  /// A table on such bytes; segment_bytes.h documents the layout. `owner` keeps them alive. Throws Error{corrupt}
  /// naming `where` if the bytes are not a table, and Error{unsupported} for a later version.
  static SegmentTable open(ByteSpan bytes, std::shared_ptr<const void> owner, const std::string& where);
  /// Valid while the table, or a copy of it, is alive.
  ByteSpan bytes() const noexcept { return bytes_; }

  std::uint32_t size() const noexcept { return size_; }
  std::uint32_t recording_count() const noexcept { return static_cast<std::uint32_t>(recording_tiers_.size()) - 1; }

  // Columns. A row, text, tier or recording must belong to the table.

  RowKind kind(RowId row) const noexcept { return static_cast<RowKind>(flags_[row] & 3U); }
  PhaseKind phase(RowId row) const noexcept { return static_cast<PhaseKind>(flags_[row] >> 2 & 7U); }
  Hand hand(RowId row) const noexcept { return static_cast<Hand>(flags_[row] >> 5 & 3U); }
  bool inferred(RowId row) const noexcept { return (flags_[row] & kInferred) != 0; }
  bool extra(RowId row) const noexcept { return (flags_[row] & kExtra) != 0; }
  Milliseconds begin(RowId row) const noexcept {
    return Milliseconds(begins_.empty() ? wide_[2 * std::size_t{row}] : begins_[row]);
  }
  Milliseconds end(RowId row) const noexcept {
    return Milliseconds(begins_.empty() ? wide_[2 * std::size_t{row} + 1] : ends_[row]);
  }
  TimeSpan span(RowId row) const noexcept { return {begin(row), end(row)}; }
  /// Indexes of texts: the label verbatim, and in match form.
  std::uint32_t text(RowId row) const noexcept { return texts_of_rows_[row]; }
  std::uint32_t label(RowId row) const noexcept { return labels_of_texts_[texts_of_rows_[row]]; }
  RowId parent(RowId row) const noexcept { return parents_[row]; }
  std::uint32_t tier(RowId row) const noexcept { return places_[places_of_rows_[row]].tier; }
  std::uint32_t recording(RowId row) const noexcept { return places_[places_of_rows_[row]].recording; }
  /// All columns of a row.
  SegmentRow row(RowId id) const noexcept;

  std::string_view text_at(std::uint32_t text) const noexcept { return texts_.at(text); }
  std::string_view tier_at(std::uint32_t tier) const noexcept { return tiers_.at(tier); }
  std::string_view recording_at(std::uint32_t recording) const noexcept { return recordings_.at(recording); }
  std::uint32_t text_count() const noexcept { return texts_.size(); }
  std::uint32_t tier_count() const noexcept { return tiers_.size(); }

  static constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();
  /// The text of a label in match form, or kNone. The same for tiers (verbatim) and recordings.
  std::uint32_t find_text(std::string_view match_form) const noexcept;
  std::uint32_t find_tier(std::string_view id) const noexcept;
  std::uint32_t find_recording(std::string_view name) const noexcept;

  /// All rows of one kind with a label, ascending by row (so by recording, tier, time).
  std::span<const RowId> with_label(RowKind kind, std::uint32_t label) const noexcept;
  /// All phase rows of a phase kind, and all units, ascending.
  std::span<const RowId> phases(PhaseKind kind) const noexcept;
  std::span<const RowId> units() const noexcept;
  /// The labels that rows of a kind have, ascending, without duplicates. Units have no labels.
  std::span<const std::uint32_t> labels_of(RowKind kind) const noexcept;

  /// [begin, end) of row ids.
  struct RowRange {
    RowId begin = 0;
    RowId end = 0;
    std::size_t size() const noexcept { return end - begin; }
    bool contains(RowId row) const noexcept { return begin <= row && row < end; }
    friend bool operator==(RowRange, RowRange) = default;
  };
  /// The rows of one tier of one recording, as they are stored.
  struct TierRows {
    std::uint32_t recording = 0;
    std::uint32_t tier = kNone;
    RowId begin = 0;
    RowId own_end = 0;
    RowId extra_end = 0;
    RowId unit_end = 0;
    std::uint32_t signer = 0;  ///< text; the empty text if no signer is named
    std::uint32_t order = 0;   ///< 1: `apart`

    RowRange own() const noexcept { return {begin, own_end}; }         ///< the annotations of the tier, in time order
    RowRange extra() const noexcept { return {own_end, extra_end}; }   ///< see `segments_of`, in time order
    RowRange units() const noexcept { return {extra_end, unit_end}; }  ///< of a sign tier, in time order
    /// Whether no two of `own` overlap, nor two of `extra`, so their ends ascend too. Units never overlap.
    bool apart() const noexcept { return order != 0; }
  };
  /// The tiers of a recording that have rows, ascending by tier.
  std::span<const TierRows> tiers_of(std::uint32_t recording) const noexcept {
    return places_.subspan(recording_tiers_[recording], recording_tiers_[recording + 1] - recording_tiers_[recording]);
  }
  /// The rows of the tier a row belongs to.
  const TierRows& tier_rows_of(RowId row) const noexcept { return places_[places_of_rows_[row]]; }
  /// The rows of a tier of a recording, or null.
  const TierRows* tier_rows(std::uint32_t recording, std::uint32_t tier) const noexcept;
  RowRange recording_rows(std::uint32_t recording) const noexcept {
    return {recording_begins_[recording], recording_begins_[recording + 1]};
  }
  /// The rows whose parent is `row`, in time order.
  std::span<const RowId> children(RowId row) const noexcept {
    return child_list_.subspan(child_begins_[row], child_begins_[row + 1] - child_begins_[row]);
  }
  /// All glosses (match form of sign rows), sorted, without duplicates.
  std::vector<std::string> glosses() const;

 private:
  friend class TableBytes;

  /// Concatenated texts.
  struct Texts {
    std::span<const std::uint32_t> begins = {};  ///< one more entry than texts
    const char* characters = nullptr;
    std::uint32_t size() const noexcept { return begins.empty() ? 0 : static_cast<std::uint32_t>(begins.size()) - 1; }
    std::string_view at(std::uint32_t i) const noexcept { return {characters + begins[i], begins[i + 1] - begins[i]}; }
  };
  static constexpr unsigned kInferred = 128;
  static constexpr unsigned kExtra = 256;
  static constexpr std::uint32_t kNoTiers[1] = {0};

  std::shared_ptr<const void> owner_;
  ByteSpan bytes_;
  std::uint32_t size_ = 0;
  Texts texts_, tiers_, recordings_;
  std::span<const std::uint32_t> recording_tiers_ = kNoTiers;   ///< [recording] index into places_, and one more entry
  std::span<const std::uint32_t> recording_begins_ = kNoTiers;  ///< [recording] the first row, and one more entry
  std::span<const TierRows> places_;                            ///< by recording, then tier
  std::span<const std::uint32_t> labels_of_texts_;              ///< [text]
  std::span<const std::uint32_t> text_slots_;                   ///< hash table of texts; kNone: empty
  std::span<const std::uint32_t> rows_of_labels_;               ///< [text] index into by_label_, and one more entry
  std::span<const RowId> by_label_;                             ///< by label, then kind, then row
  std::span<const std::uint32_t> labels_of_kinds_[3];
  std::span<const RowId> by_phase_[5];
  std::span<const RowId> units_;
  std::span<const std::int32_t> begins_, ends_;  ///< milliseconds; empty if some do not fit
  std::span<const std::int64_t> wide_;           ///< used then: begin and end of each row
  std::span<const std::uint32_t> texts_of_rows_;
  std::span<const RowId> parents_;
  std::span<const std::uint32_t> places_of_rows_;
  std::span<const std::uint16_t> flags_;
  std::span<const std::uint32_t> child_begins_;  ///< [row] index into child_list_, and one more entry
  std::span<const RowId> child_list_;
};

/// The first row of a range for which `later` holds; the end of the range if there is none. Binary search: `later` must
/// hold for all rows after the first one for which it holds.
template <typename Later>
RowId first_row(SegmentTable::RowRange rows, Later&& later) {
  while (rows.begin < rows.end) {
    const RowId middle = rows.begin + (rows.end - rows.begin) / 2;
    if (later(middle)) {
      rows.end = middle;
    } else {
      rows.begin = middle + 1;
    }
  }
  return rows.begin;
}

}  // namespace signweave
