#pragma once

#include <string>

#include "signweave/database/recording.h"
#include "signweave/kv/kv_store.h"
#include "signweave/semantic_db/segments.h"

/// The segment tables as part of a change of a database. Internal to `database` and `backup`.
namespace signweave::tables {

/// The table of one recording.
SegmentTable table_of(const RecordingInfo& info, const SegmentChunk& segments);

/// The table of all recordings, made from their own segments; one line for each that is damaged and left out.
SegmentTable table_of_all(const kv::ReadTransaction& snapshot, std::vector<std::string>& faults);

/// In a change, after the catalogue is written: a recording came, or changed. Takes generations from the head.
void put(kv::WriteTransaction& transaction, const RecordingInfo& info, const SegmentChunk& segments, bool was_there);
/// A recording is gone; one without a name, and all are looked at again.
void remove(kv::WriteTransaction& transaction, const std::string& name);
/// One table of all, whatever is there; throws Error{corrupt} where a recording's own segments are damaged.
void remake(kv::WriteTransaction& transaction);
/// Few tables again; false where there are few.
bool merge(kv::WriteTransaction& transaction);

}  // namespace signweave::tables
