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

/// Kind of a row of the segment table. Stored on disk: never renumber.
enum class RowKind : std::uint8_t {
  annotation = 0,  ///< an annotation of a tier that is neither a sign tier nor a phase tier
  sign = 1,        ///< an annotation of a sign tier
  phase = 2,       ///< a phase of a sign, including an inferred stroke
  unit = 3,        ///< the signs between two rests (the paper's Unity): in a SegmentTable only
};

/// One annotation, sign or phase of one recording.
struct SegmentRow {
  RowKind kind = RowKind::annotation;
  PhaseKind phase = PhaseKind::other;  ///< for a phase row
  Hand hand = Hand::both;              ///< for a sign or phase row
  bool inferred = false;               ///< true for a sign without annotated phases, and for its one stroke
  bool extra = false;                  ///< has no annotation of its own: see `segments_of`
  std::uint32_t recording = 0;         ///< in a SegmentTable only: its number there
  std::uint32_t tier = 0;              ///< index into the tiers of the SegmentChunk or SegmentTable
  std::uint32_t label = 0;             ///< index into the labels: the match form of the label
  std::uint32_t text = 0;              ///< index into the labels: the label verbatim
  TimeSpan span{};
  RowId parent = kNoRow;  ///< the row of the parent annotation; a phase's parent is its sign
  friend bool operator==(const SegmentRow&, const SegmentRow&) = default;
};

/// The segments of one recording as they are stored with its document: rows in a fixed order, parents as indexes into
/// the same list, and the strings they use.
struct SegmentChunk {
  std::vector<std::string> tiers;
  std::vector<std::string> labels;
  std::vector<SegmentRow> rows;  ///< `recording` unused; `parent` relative to this list
};

/// Every annotation of a document once (the annotation of a sign or phase as kind sign or phase), and after each tier's
/// own rows its *extra* rows, which have no annotation of their own: the inferred strokes of the signs of that tier,
/// and a phase that a second sign shares with the first. Ordered by tier, then own before extra, then time; so rows of
/// one tier are neighbours in time.
///
/// A sign is found by its tier and annotation id, a phase by its annotation id; if they have no id (a document not yet
/// written), by span and label. A phase's parent is its sign, whatever the document states; every other row's parent is
/// that of its annotation. Throws Error{bad_input} if a sign or phase is not in the document, or a time is invalid.
SegmentChunk segments_of(const AnnotationDocument& document, std::span<const Sign> signs);

/// segment_chunk.cpp documents the layout. `decode_segments` throws Error{corrupt} for bytes that `encode` cannot have
/// written (indexes out of range, rows out of order), and Error{unsupported} for a later version.
void encode(const SegmentChunk& chunk, ByteWriter& out);
SegmentChunk decode_segments(ByteReader& in);

}  // namespace signweave
