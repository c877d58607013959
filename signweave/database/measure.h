#pragma once

#include <string>

#include "signweave/database/recording.h"
#include "signweave/features/phase_features.h"
#include "signweave/kv/kv_store.h"
#include "signweave/semantic_db/segment_table.h"

/// Inside this module only: what is measured of a recording.
namespace signweave {

/// What is measured of a recording as it is stored; where a half is missing or damaged, only why nothing was measured.
RecordingFeatures measure_stored(const kv::ReadTransaction& snapshot, const RecordingInfo& info,
                                 const SegmentChunk& segments);

/// What is wrong with the stored features of a recording with motion and document; empty where a sample of them,
/// measured again, says the same, or there are none of this version.
std::string fault_of_features(const kv::ReadTransaction& snapshot, const RecordingInfo& info,
                              const SegmentChunk& segments);

}  // namespace signweave
