#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "signweave/features/join.h"
#include "signweave/features/phase_features.h"
#include "signweave/kv/kv_store.h"
#include "signweave/semantic_db/segment_table.h"

/// The semantic database (the paper, section 4.1): annotation documents and the segments in them, on a key-value store.
/// It knows no file format: a document is kept as the bytes that came. Which documents are visible is the caller's
/// record, under a generation number that is never used twice.
namespace signweave::semantic_db {

/// Stores a document and its segments under a generation, as part of the caller's transaction.
void put(kv::WriteTransaction& transaction, std::uint64_t generation, std::string_view document,
         const SegmentChunk& segments);

/// Stores what was measured of the phases of a document's segments, in the order of their rows; instead of what was.
void put_features(kv::WriteTransaction& transaction, std::uint64_t generation, const RecordingFeatures& features);

/// Erases all three. Doing it twice is harmless.
void erase(kv::WriteTransaction& transaction, std::uint64_t generation);

/// The weights that were learned from all recordings together, and of which state of the database they are.
struct StoredWeights {
  std::uint64_t changes = 0;  ///< the caller's count of changes when they were learned
  JoinWeights weights;
};
/// Stores them instead of what was.
void put_weights(kv::WriteTransaction& transaction, const StoredWeights& weights);
/// As they were put; none where there are none, or another version learned. Throws Error{corrupt}.
std::optional<StoredWeights> read_weights(const kv::ReadTransaction& snapshot);
/// The number of the way of learning: count it up with any change that gives other weights.
inline constexpr std::uint16_t kWeightsVersion = 1;

/// What the record under a key is: "documents", "segments", "features" or "weights"; empty where it is none of this
/// database's.
std::string_view kind_of(ByteSpan key) noexcept;
/// The generation of the document whose record the key names; none where it belongs to no document.
std::optional<std::uint64_t> generation_of(ByteSpan key) noexcept;

/// The bytes as they were put. Throws Error{corrupt} where the record is missing or its checksum is wrong; `where`
/// names the recording in that error.
std::string read_document(const kv::ReadTransaction& snapshot, std::uint64_t generation, const std::string& where);

/// The segments as they were put; throws likewise.
SegmentChunk read_segments(const kv::ReadTransaction& snapshot, std::uint64_t generation, const std::string& where);

/// The features as they were put; none where there are none, or another version measured. Throws Error{corrupt}.
std::optional<RecordingFeatures> read_features(const kv::ReadTransaction& snapshot, std::uint64_t generation,
                                               const std::string& where);

/// The spans of the phase rows, in the order of the rows: those that features belong to.
std::vector<TimeSpan> phase_spans(const SegmentChunk& segments);

}  // namespace signweave::semantic_db

namespace signweave {

/// A sign row and its phases as the Sign that they were made of (without its annotation ids and signer).
Sign sign_at(const SegmentTable& table, RowId row);

/// All signs of a recording, by tier as the table lists them, then time.
std::vector<Sign> signs_of(const SegmentTable& table, std::uint32_t recording);

/// Which phase rows each of them has, [sign][phase]: their places among all phase rows of the recording, which is the
/// order of its features.
std::vector<std::vector<std::size_t>> phase_places_of(const SegmentTable& table, std::uint32_t recording);

/// Those of its main sign tier, the one with most signs (of several, the first): what a run of signs means where each
/// hand has a tier of its own.
std::vector<Sign> main_signs_of(const SegmentTable& table, std::uint32_t recording);

}  // namespace signweave
