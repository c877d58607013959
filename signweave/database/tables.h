#pragma once

#include <string>

#include "signweave/database/recording.h"
#include "signweave/kv/kv_store.h"
#include "signweave/semantic_db/segments.h"

/// The segment tables as part of a change of a database. Internal to `database` and `backup`.
namespace signweave::tables {

/// Returns the table of one recording.
SegmentTable table_of(const RecordingInfo& info, const SegmentChunk& segments);

/// Returns the table of all recordings, built from their own segments; adds a line for each one left out as damaged.
SegmentTable table_of_all(const kv::ReadTransaction& snapshot, std::vector<std::string>& faults);

/// Within a change, after the catalogue is written: a recording was added or changed. Takes generations from the head.
void put(kv::WriteTransaction& transaction, const RecordingInfo& info, const SegmentChunk& segments, bool was_there);
/// A recording was removed; if `name` is empty, all are read again.
void remove(kv::WriteTransaction& transaction, const std::string& name);
/// Rebuilds one table of all recordings. Throws Error{corrupt} if a recording's own segments are damaged.
void rebuild(kv::WriteTransaction& transaction);
/// Merges many tables into few; false if there are few already.
bool merge(kv::WriteTransaction& transaction);

}  // namespace signweave::tables
