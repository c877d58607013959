#pragma once

#include <cstdint>
#include <limits>
#include <span>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "signweave/annotation/document.h"
#include "signweave/annotation/sign.h"
#include "signweave/core/bytes.h"
#include "signweave/core/time.h"

namespace signweave {

using RowId = std::uint32_t;
inline constexpr RowId kNoRow = std::numeric_limits<RowId>::max();

/// What a row of the segment table is. Stored on disk: never renumber.
enum class RowKind : std::uint8_t {
  annotation = 0,  ///< an annotation of any tier that is neither sign tier nor phase tier
  sign = 1,        ///< an annotation of a sign tier
  phase = 2,       ///< a phase of a sign; an inferred stroke too
};

/// One annotation, sign or phase of one recording.
struct SegmentRow {
  RowKind kind = RowKind::annotation;
  PhaseKind phase = PhaseKind::other;  ///< of a phase row
  Hand hand = Hand::both;              ///< of a sign or phase row
  bool inferred = false;               ///< of a sign without annotated phases, and of its one stroke
  bool extra = false;                  ///< stands for no annotation of its own: see `segments_of`
  std::uint32_t recording = 0;         ///< index into SegmentTable::recordings()
  std::uint32_t tier = 0;              ///< index into SegmentTable::tiers()
  std::uint32_t label = 0;             ///< index into SegmentTable::labels(): the match form of the label
  std::uint32_t text = 0;              ///< index into SegmentTable::labels(): the label verbatim
  TimeSpan span{};
  RowId parent = kNoRow;  ///< the row of the parent annotation; a phase's parent is its sign
  friend bool operator==(const SegmentRow&, const SegmentRow&) = default;
};

/// The segments of one recording as they are stored beside its document: rows in a fixed order, parents as indexes into
/// the same list, and the strings they use.
struct SegmentChunk {
  std::vector<std::string> tiers;
  std::vector<std::string> labels;
  std::vector<SegmentRow> rows;  ///< `recording` unused; `parent` relative to this list
};

/// Every annotation of a document once (a sign's and a phase's annotation as kind sign and phase), and after each
/// tier's own rows its *extra* rows, which stand for no annotation of their own: the inferred strokes of the signs of
/// that tier, and a phase that a second sign shares with the first. Ordered by tier, then own before extra, then time;
/// so rows of one tier are neighbours in time.
///
/// A sign is found by its tier and annotation id, a phase by its annotation id; where they have none (a document not
/// yet written) by span and label. A phase's parent is its sign, whatever the document says; every other row's parent
/// is that of its annotation. Throws Error{bad_input} where a sign or phase is not in the document, or a time is no
/// time.
SegmentChunk segments_of(const AnnotationDocument& document, std::span<const Sign> signs);

/// The layout is drawn in segment_chunk.cpp. `decode_segments` throws Error{corrupt} on bytes that `encode` cannot have
/// written (indexes out of range, rows out of order), and Error{unsupported} on a later version.
void encode(const SegmentChunk& chunk, ByteWriter& out);
SegmentChunk decode_segments(ByteReader& in);

/// The segments of all recordings, with indexes. Immutable once built, so threads may share it.
class SegmentTable {
 public:
  struct Source {
    std::string recording;
    const SegmentChunk* chunk;  ///< borrowed during construction only
  };
  SegmentTable() = default;
  /// Numbers the rows recording by recording, in the order of `sources`. Throws Error{unsupported} past 2^32 − 1 rows,
  /// Error{already_exists} where a name comes twice.
  explicit SegmentTable(std::span<const Source> sources);

  std::span<const SegmentRow> rows() const noexcept { return rows_; }
  const SegmentRow& row(RowId id) const noexcept { return rows_[id]; }
  std::span<const std::string> recordings() const noexcept { return recordings_; }
  std::span<const std::string> tiers() const noexcept { return tiers_; }
  std::span<const std::string> labels() const noexcept { return labels_; }

  /// Index of a label in match form, or none (max of uint32_t). Likewise for tiers (verbatim) and recordings.
  static constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();
  std::uint32_t find_label(std::string_view match_form) const noexcept;
  std::uint32_t find_tier(std::string_view id) const noexcept;
  std::uint32_t find_recording(std::string_view name) const noexcept;

  /// All rows of one kind with a label, ascending by row (so by recording, tier, time).
  std::span<const RowId> with_label(RowKind kind, std::uint32_t label) const noexcept;
  /// All phase rows of a phase kind, ascending.
  std::span<const RowId> phases(PhaseKind kind) const noexcept;
  /// The labels that rows of a kind have, ascending, each once.
  std::span<const std::uint32_t> labels_of(RowKind kind) const noexcept;
  /// [begin, end) of row ids.
  struct RowRange {
    RowId begin = 0;
    RowId end = 0;
    std::size_t size() const noexcept { return end - begin; }
    bool contains(RowId row) const noexcept { return begin <= row && row < end; }
    friend bool operator==(RowRange, RowRange) = default;
  };
  /// The rows of one tier of one recording.
  struct TierRows {
    std::uint32_t tier = kNone;
    RowRange own;       ///< the annotations of the tier, in time order
    RowRange extra;     ///< what stands for no annotation of its own (see `segments_of`), in time order
    bool apart = true;  ///< no two of `own` overlap, nor two of `extra`, so their ends ascend too
  };
  /// The tiers of a recording that have rows, ascending by tier.
  std::span<const TierRows> tiers_of(std::uint32_t recording) const noexcept;
  /// The annotations of one tier of one recording, in time order; empty where it has none.
  RowRange tier_rows(std::uint32_t recording, std::uint32_t tier) const noexcept;
  RowRange recording_rows(std::uint32_t recording) const noexcept;
  /// The rows whose parent is `row`, in time order.
  std::span<const RowId> children(RowId row) const noexcept;
  /// Every gloss (match form of sign rows), sorted, once.
  std::vector<std::string> glosses() const;

 private:
  void add(const Source& source);
  void index_tiers();
  void index_labels();
  void index_children();

  std::vector<SegmentRow> rows_;
  std::vector<std::string> recordings_;
  std::vector<std::string> tiers_;
  std::vector<std::string> labels_;
  std::unordered_map<std::string, std::uint32_t> label_index_;
  std::unordered_map<std::string, std::uint32_t> tier_index_;
  std::unordered_map<std::string, std::uint32_t> recording_index_;
  std::vector<RowRange> recording_rows_;                            ///< [recording]
  std::vector<std::vector<TierRows>> tier_rows_;                    ///< [recording]
  std::unordered_map<std::uint64_t, std::vector<RowId>> by_label_;  ///< kind << 32 | label
  std::vector<std::vector<std::uint32_t>> labels_of_;               ///< [RowKind]
  std::vector<std::vector<RowId>> by_phase_;                        ///< [PhaseKind]
  std::vector<std::uint32_t> children_begin_;                       ///< [row], into child_list_
  std::vector<RowId> child_list_;
};

}  // namespace signweave
