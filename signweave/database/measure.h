#pragma once

#include <string>

#include "signweave/database/recording.h"
#include "signweave/features/phase_features.h"
#include "signweave/kv/kv_store.h"
#include "signweave/semantic_db/segment_table.h"

/// Internal to `database`: what is measured of a recording.
namespace signweave {

/// Measures a recording as it is stored; if a half is missing or damaged, returns only why nothing was measured.
RecordingFeatures measure_stored(const kv::ReadTransaction& snapshot, const RecordingInfo& info,
                                 const SegmentChunk& segments);

/// Returns what is wrong with the stored features of a recording with motion and document; empty if a sample of them
/// measures the same again, or none of this version are stored.
std::string fault_of_features(const kv::ReadTransaction& snapshot, const RecordingInfo& info,
                              const SegmentChunk& segments);

}  // namespace signweave
