#pragma once

#include <cstdint>
#include <limits>
#include <span>
#include <string>
#include <string_view>
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
  unit = 3,        ///< the signs between two rests (the paper's Unity): of a SegmentTable only
};

/// One annotation, sign or phase of one recording.
struct SegmentRow {
  RowKind kind = RowKind::annotation;
  PhaseKind phase = PhaseKind::other;  ///< of a phase row
  Hand hand = Hand::both;              ///< of a sign or phase row
  bool inferred = false;               ///< of a sign without annotated phases, and of its one stroke
  bool extra = false;                  ///< stands for no annotation of its own: see `segments_of`
  std::uint32_t recording = 0;         ///< of a SegmentTable only: its number there
  std::uint32_t tier = 0;              ///< index into SegmentChunk::tiers, or of a SegmentTable
  std::uint32_t label = 0;             ///< likewise of the labels: the match form of the label
  std::uint32_t text = 0;              ///< likewise: the label verbatim
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

}  // namespace signweave
