#include "signweave/database/tables.h"

#include <set>

#include "signweave/database/catalogue.h"
#include "signweave/database/database.h"
#include "signweave/semantic_db/semantic_db.h"
#include "signweave/semantic_db/table_store.h"

namespace signweave::tables {
namespace {

/// Calls change(next), where `next` takes generations from the head. If the stored tables are damaged or missing (a
/// database of an older layout), rebuilds them from the recordings' own segments.
template <typename Change>
bool change_tables(kv::WriteTransaction& transaction, Change&& change) {
  catalogue::Head head = catalogue::read_head(transaction);
  const semantic_db::NextGeneration next = [&] { return head.next_generation++; };
  bool changed = true;
  try {
    changed = change(next);
  } catch (const Error& error) {
    if (error.code() != ErrorCode::corrupt) throw;
    std::vector<std::string> faults;
    semantic_db::replace_tables(transaction, table_of_all(transaction, faults), next);
  }
  if (changed) catalogue::write_head(transaction, head);
  return changed;
}

}  // namespace

SegmentTable table_of(const RecordingInfo& info, const SegmentChunk& segments) {
  const SegmentTable::Source source{info.name, &segments, info.signer, &info.tiers};
  return SegmentTable(std::span(&source, 1));
}

SegmentTable table_of_all(const kv::ReadTransaction& snapshot, std::vector<std::string>& faults) {
  const std::uint32_t recordings = catalogue::read_head(snapshot).recordings;
  std::vector<RecordingInfo> infos;
  std::vector<SegmentChunk> chunks;
  infos.reserve(recordings);
  chunks.reserve(recordings);
  std::vector<SegmentTable::Source> sources;
  for (std::uint32_t slot = 0; slot < recordings; ++slot) {
    try {
      infos.push_back(catalogue::read_recording(snapshot, slot));
    } catch (const Error& error) {
      faults.emplace_back(error.what());
      continue;
    }
    const RecordingInfo& info = infos.back();
    chunks.emplace_back();
    try {
      if (info.document != 0) chunks.back() = semantic_db::read_segments(snapshot, info.document, info.name);
    } catch (const Error& error) {
      faults.emplace_back(error.what());
    }
    sources.push_back({info.name, &chunks.back(), info.signer, &info.tiers});
  }
  return SegmentTable(sources);
}

void put(kv::WriteTransaction& transaction, const RecordingInfo& info, const SegmentChunk& segments, bool was_there) {
  change_tables(transaction, [&](const semantic_db::NextGeneration& next) {
    const std::vector<std::string> replaced(was_there ? 1 : 0, info.name);
    semantic_db::add_table(transaction, table_of(info, segments), replaced, next);
    return true;
  });
}

void remove(kv::WriteTransaction& transaction, const std::string& name) {
  change_tables(transaction, [&](const semantic_db::NextGeneration& next) {
    if (name.empty()) throw Error(ErrorCode::corrupt, "the name of the removed recording is unknown");
    semantic_db::remove_from_tables(transaction, name, next);
    return true;
  });
}

void rebuild(kv::WriteTransaction& transaction) {
  catalogue::Head head = catalogue::read_head(transaction);
  std::vector<std::string> faults;
  const SegmentTable table = table_of_all(transaction, faults);
  if (!faults.empty()) throw Error(ErrorCode::corrupt, faults.front());
  semantic_db::replace_tables(transaction, table, [&] { return head.next_generation++; });
  catalogue::write_head(transaction, head);
}

bool merge(kv::WriteTransaction& transaction) {
  return change_tables(transaction, [&](const semantic_db::NextGeneration& next) {
    return semantic_db::merge_tables(transaction, next);
  });
}

}  // namespace signweave::tables

namespace signweave {

std::shared_ptr<const Segments> Database::stored_segments(
    const std::shared_ptr<const kv::ReadTransaction>& snapshot) const {
  const std::uint64_t changes = catalogue::read_head(*snapshot).changes;
  {
    const std::lock_guard guard(mutex_);
    if (segments_ && segments_at_ == changes) return segments_;
  }
  std::optional<Segments> read;
  try {
    read = semantic_db::read_tables(snapshot);
  } catch (const Error& error) {
    if (error.code() != ErrorCode::corrupt) throw;  // `check` reports it
  }
  std::vector<std::string> faults;
  auto made =
      std::make_shared<const Segments>(read ? *std::move(read) : Segments(tables::table_of_all(*snapshot, faults)));
  const std::lock_guard guard(mutex_);
  if (segments_ && segments_at_ > changes) return made;  // keep the newer state that another thread has cached
  segments_ = made;
  segments_at_ = changes;
  return made;
}

std::shared_ptr<const Segments> Database::segments() const {
  return stored_segments(store_->read());
}

bool Database::merge() {
  require_writable();
  const std::unique_ptr<kv::WriteTransaction> transaction = store_->write();
  if (!tables::merge(*transaction)) return false;
  catalogue::Head head = catalogue::read_head(*transaction);
  ++head.changes;
  catalogue::write_head(*transaction, head);
  transaction->commit();
  return true;
}

}  // namespace signweave
