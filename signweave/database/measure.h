#pragma once

#include <string>

#include "signweave/database/recording.h"
#include "signweave/features/phase_features.h"
#include "signweave/kv/kv_store.h"
#include "signweave/semantic_db/segment_table.h"

/// Internal to `database`: the features of recordings.
namespace signweave {

/// Measures a recording as stored; if the motion is missing or damaged, returns only the reason.
RecordingFeatures measure_stored(const kv::ReadTransaction& snapshot, const RecordingInfo& info,
                                 const SegmentChunk& segments);

/// Describes the fault of the stored features of a recording with motion and document; empty if measuring a sample
/// again gives the same values, or no features of this version are stored.
std::string fault_of_features(const kv::ReadTransaction& snapshot, const RecordingInfo& info,
                              const SegmentChunk& segments);

}  // namespace signweave
