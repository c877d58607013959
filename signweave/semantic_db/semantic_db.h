#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "signweave/features/duration_fit.h"
#include "signweave/features/join.h"
#include "signweave/features/phase_features.h"
#include "signweave/features/residual_model.h"
#include "signweave/kv/kv_store.h"
#include "signweave/semantic_db/documents.h"
#include "signweave/semantic_db/segments.h"

/// The semantic database (the paper, section 4.1): annotation documents and the segments in them, on a key-value store.
/// It knows no file format: a document is kept as the bytes that came. Which documents are visible is the caller's
/// record, under a generation number that is never used twice.
namespace signweave::semantic_db {

/// Stores the segments of a document under its generation, as part of the caller's transaction; documents.h stores the
/// document itself.
void put(kv::WriteTransaction& transaction, std::uint64_t generation, const SegmentChunk& segments);

/// Stores what was measured of the phases of a document's segments, in the order of their rows; instead of what was.
void put_features(kv::WriteTransaction& transaction, std::uint64_t generation, const RecordingFeatures& features);

/// Erases a document and everything beside it. Doing it twice is harmless.
void erase(kv::WriteTransaction& transaction, std::uint64_t generation);

/// Calls see(key) for the key of each record of a document and of what lies beside it. Throws Error{corrupt} where the
/// record that tells how many there are is damaged; `where` names the recording in that error.
void for_each_key(const kv::ReadTransaction& snapshot, std::uint64_t generation, const std::string& where,
                  const std::function<void(ByteSpan key)>& see);

/// What all recordings together taught, and in which state of the database.
struct Learned {
  std::uint64_t changes = 0;  ///< the caller's count of changes when it was learned
  JoinWeights weights;        ///< of the selection
  /// Fitted on what the hands had to do in annotated transitions; its count is of those that it looked at. `median` is
  /// not used.
  DurationFit durations;
  ResidualModel residuals;           ///< what movements teach of transitions; looked at only where it wins
  std::uint64_t phased_signs = 0;    ///< that have annotated phases
  std::uint64_t unphased_signs = 0;  ///< that have none
};
/// The key of its record.
Bytes learned_key();
/// Stores it instead of what was.
void put_learned(kv::WriteTransaction& transaction, const Learned& learned);
/// As it was put; none where there is none, or another version learned. Throws Error{corrupt}.
std::optional<Learned> read_learned(const kv::ReadTransaction& snapshot);
/// The number of the method of learning: count it up with any change that gives other numbers.
inline constexpr std::uint16_t kLearnedVersion = 3;

/// What the record under a key is: "documents", "segments", "features", "segment tables" or "weights"; empty where it
/// is none of this database's.
std::string_view kind_of(ByteSpan key) noexcept;
/// The generation of the document, or segment table, whose record the key names; none where it belongs to none.
std::optional<std::uint64_t> generation_of(ByteSpan key) noexcept;

/// The segments as they were put. Throws Error{corrupt} where the record is missing or its checksum is wrong; `where`
/// names the recording in that error.
SegmentChunk read_segments(const kv::ReadTransaction& snapshot, std::uint64_t generation, const std::string& where);

/// The features as they were put; none where there are none, or another version measured. Throws Error{corrupt}.
std::optional<RecordingFeatures> read_features(const kv::ReadTransaction& snapshot, std::uint64_t generation,
                                               const std::string& where);

/// The spans of the phase rows, in the order of the rows: those that features belong to.
std::vector<TimeSpan> phase_spans(const SegmentChunk& segments);

}  // namespace signweave::semantic_db
