#pragma once

#include "signweave/database/database.h"
#include "signweave/database/recording.h"
#include "signweave/kv/kv_store.h"
#include "signweave/semantic_db/segment_chunk.h"

/// Internal to `database`: steps that several changes share.
namespace signweave {

/// Returns the stored segments of a document; none if they are damaged, so that their replacement can be stored.
SegmentChunk segments_if_sound(const kv::ReadTransaction& snapshot, const RecordingInfo& info);

/// Returns the part [from, to) of `whole`, for a step that reports progress from 0 to 1. `whole` must outlive it.
Database::Progress part_of(const Database::Progress& whole, double from, double to);

/// Within a change: makes the motion just written the recording's motion, and puts the previous one on the sweep list.
void make_visible(kv::WriteTransaction& transaction, RecordingInfo& info, const motion_db::StoredMotion& stored);

}  // namespace signweave
