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

/// The semantic database (the paper, section 4.1): annotation documents and their segments, on a key-value store. It is
/// independent of file formats: a document is stored as the bytes it came in. The caller records which documents are
/// visible, under generation numbers that are never reused.
namespace signweave::semantic_db {

/// Stores the segments of a document under its generation, as part of the caller's transaction; documents.h stores the
/// document itself.
void put(kv::WriteTransaction& transaction, std::uint64_t generation, const SegmentChunk& segments);

/// Stores the features of the phases of a document, in the order of their rows; replaces earlier features.
void put_features(kv::WriteTransaction& transaction, std::uint64_t generation, const RecordingFeatures& features);

/// Erases a document and all records derived from it. Idempotent.
void erase(kv::WriteTransaction& transaction, std::uint64_t generation);

/// Calls see(key) for the key of each record of a document and of the records derived from it. Throws Error{corrupt} if
/// the record with the number of records is damaged; `where` names the recording in that error.
void for_each_key(const kv::ReadTransaction& snapshot, std::uint64_t generation, const std::string& where,
                  const std::function<void(ByteSpan key)>& see);

/// The values learned from all recordings, and the state of the database they were learned in.
struct Learned {
  std::uint64_t changes = 0;  ///< the caller's count of changes when it was learned
  JoinWeights weights;        ///< of candidate selection
  /// Fitted to the hands' tasks in annotated transitions; its count is the number of transitions used. `median` is not
  /// used.
  DurationFit durations;
  ResidualModel residuals;           ///< residuals of transitions learned from movements; used only if it wins
  std::uint64_t phased_signs = 0;    ///< signs with annotated phases
  std::uint64_t unphased_signs = 0;  ///< signs without annotated phases
};
/// The key of its record.
Bytes learned_key();
/// Stores it, replacing the earlier record.
void put_learned(kv::WriteTransaction& transaction, const Learned& learned);
/// Reads it as it was put; nullopt if there is none, or another version stored it. Throws Error{corrupt}.
std::optional<Learned> read_learned(const kv::ReadTransaction& snapshot);
/// Version of the learning method: increment it with any change that affects the results.
inline constexpr std::uint16_t kLearnedVersion = 3;

/// The kind of record under a key: "documents", "segments", "features", "segment tables" or "weights"; empty if it is
/// not a record of this database.
std::string_view kind_of(ByteSpan key) noexcept;
/// The generation of the document or segment table whose record has this key; nullopt if it belongs to neither.
std::optional<std::uint64_t> generation_of(ByteSpan key) noexcept;

/// The segments as they were put. Throws Error{corrupt} if the record is missing or its checksum is wrong; `where`
/// names the recording in that error.
SegmentChunk read_segments(const kv::ReadTransaction& snapshot, std::uint64_t generation, const std::string& where);

/// The features as they were put; nullopt if there are none, or another version measured them. Throws Error{corrupt}.
std::optional<RecordingFeatures> read_features(const kv::ReadTransaction& snapshot, std::uint64_t generation,
                                               const std::string& where);

/// The spans of the phase rows, in row order: the phases that features belong to.
std::vector<TimeSpan> phase_spans(const SegmentChunk& segments);

}  // namespace signweave::semantic_db
