#include "signweave/database/movement.h"

#include <algorithm>
#include <chrono>
#include <thread>

#include "signweave/database/catalogue.h"
#include "signweave/database/database.h"
#include "signweave/database/measure.h"
#include "signweave/query/watch.h"
#include "signweave/semantic_db/semantic_db.h"
#include "signweave/semantic_db/trace_store.h"

namespace signweave {
namespace {

HandTrace no_trace(std::string why_not) {
  HandTrace trace;
  trace.why_not = std::move(why_not);
  return trace;
}

/// The rows of a recording as its table has them.
std::vector<MovementRow> rows_of(const SegmentTable::Part& part) {
  const SegmentTable& table = *part.table;
  const SegmentTable::RowRange range = table.recording_rows(part.recording);
  std::vector<MovementRow> rows;
  rows.reserve(range.size());
  for (RowId row = range.begin; row < range.end; ++row) {
    const RowId parent = table.parent(row);
    // A unit moves as long as it lasts.
    const RowKind kind = table.kind(row) == RowKind::unit ? RowKind::annotation : table.kind(row);
    rows.push_back({.kind = kind,
                    .phase = table.phase(row),
                    .parent = range.contains(parent) ? parent - range.begin : kNoRow,
                    .span = table.span(row)});
  }
  return rows;
}

}  // namespace

std::shared_ptr<MovementCache::Recording> MovementCache::find(std::uint32_t recording) const {
  const std::lock_guard guard(mutex_);
  const auto at = recordings_.find(recording);
  return at == recordings_.end() ? nullptr : at->second;
}

std::shared_ptr<MovementCache::Recording> MovementCache::add(std::uint32_t recording,
                                                             std::shared_ptr<Recording> entry) {
  std::size_t bytes = sizeof(Recording);
  for (const auto& points : entry->trace->points) bytes += points.size() * sizeof(TraceSample);
  const std::lock_guard guard(mutex_);
  make_room(bytes);
  return recordings_.try_emplace(recording, std::move(entry)).first->second;
}

void MovementCache::grew(const Recording& entry) {
  std::size_t bytes = 0;
  for (const std::vector<float>& column : entry.columns) bytes += column.size() * sizeof(float);
  const std::lock_guard guard(mutex_);
  make_room(bytes);
}

/// The mutex must be held.
void MovementCache::make_room(std::size_t bytes) {
  if (bytes_ + bytes > kMostBytes) {
    recordings_.clear();
    bytes_ = 0;
  }
  bytes_ += bytes;
}

HandTrace trace_stored(const kv::ReadTransaction& snapshot, const RecordingInfo& info, const Pause& pause) {
  if (!info.motion) return no_trace("there is no motion");
  try {
    if (info.document != 0) {
      if (auto stored = semantic_db::read_trace(snapshot, info.document, info.name, pause)) return *std::move(stored);
    }
    if (info.motion->frames == 0) return no_trace("the motion has no frame");
    // Borrowed for as long as this takes.
    const std::shared_ptr<const kv::ReadTransaction> lent(std::shared_ptr<void>(), &snapshot);
    const motion_db::StoredSource source(lent, std::make_shared<motion_db::KnownMotion>(snapshot, *info.motion));
    return trace_hands(source, model_of(source, info.rig, pause), pause);
  } catch (const Error& error) {
    if (error.code() != ErrorCode::corrupt) throw;
    return no_trace(error.what());
  }
}

/// Movement of the state that a transaction sees.
class StoredMovement : public Movement {
 public:
  StoredMovement(const Database& database, std::shared_ptr<const kv::ReadTransaction> transaction,
                 std::shared_ptr<const Segments> segments, std::shared_ptr<MovementCache> cache)
      : database_(&database),
        transaction_(std::move(transaction)),
        segments_(std::move(segments)),
        cache_(std::move(cache)) {}

  /// From now on it stops where `limits` say so.
  void begin(const FindLimits& limits) { watch_.begin(limits); }
  void pause() const override { watch_.check(); }

  ColumnValues column(Column column, std::uint32_t recording) const override {
    MovementCache::Recording& entry = at(recording);
    if (!entry.measured.load(std::memory_order_acquire)) measure(recording, entry);
    return {entry.columns[place_of(column)], entry_};
  }
  float shoulder_width(std::uint32_t recording) const override { return at(recording).trace->shoulder_width; }
  FrameClock clock(std::uint32_t recording) const override { return at(recording).info.clock; }
  std::shared_ptr<const HandTrace> hands(std::uint32_t recording) const override { return at(recording).trace; }

  std::vector<PointTrack> points(std::uint32_t recording, std::span<const Part> parts,
                                 FrameRange range) const override {
    const RecordingInfo& info = at(recording).info;
    if (!info.motion) return std::vector<PointTrack>(parts.size());
    const Pause pauses = [this] { pause(); };
    if (motion_of_ != recording) {  // rows come recording by recording
      motion_of_.reset();
      source_ = std::make_unique<motion_db::StoredSource>(transaction_, database_->known(*transaction_, *info.motion));
      model_ = model_of(*source_, info.rig, pauses);
      motion_of_ = recording;
    }
    return track_points(*source_, model_, parts, range, pauses);
  }

 private:
  MovementCache::Recording& at(std::uint32_t recording) const {
    if (at_ != recording) {
      pause();
      std::shared_ptr<MovementCache::Recording> entry = cache_->find(recording);
      entry_ = entry ? std::move(entry) : cache_->add(recording, read(recording));
      at_ = recording;
    }
    return *entry_;
  }

  std::shared_ptr<MovementCache::Recording> read(std::uint32_t recording) const {
    auto entry = std::make_shared<MovementCache::Recording>();
    try {
      entry->info = database_->recording_in(*transaction_, segments_->recording_name(recording));
      entry->trace = std::make_shared<const HandTrace>(trace_stored(*transaction_, entry->info, [this] { pause(); }));
    } catch (const Error& error) {  // a damaged entry of the catalogue
      if (error.code() != ErrorCode::corrupt && error.code() != ErrorCode::not_found) throw;
      entry->trace = std::make_shared<const HandTrace>(no_trace(error.what()));
    }
    return entry;
  }

  void measure(std::uint32_t recording, MovementCache::Recording& entry) const {
    std::unique_lock lock(entry.measuring, std::defer_lock);
    while (!lock.try_lock()) {  // another search does; this one may have to stop before it has
      pause();
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    if (entry.measured.load(std::memory_order_acquire)) return;
    pause();
    const std::vector<MovementRow> rows = rows_of(segments_->part(recording));
    RecordingFeatures features;
    if (entry.info.document != 0 && entry.trace->samples() != 0) {
      try {
        if (auto stored =
                semantic_db::read_features(*transaction_, entry.info.document, entry.info.name, [this] { pause(); })) {
          features = *std::move(stored);
        }
      } catch (const Error& error) {
        if (error.code() != ErrorCode::corrupt) throw;  // `check` tells of it; the trace says nearly the same
      }
    }
    pause();
    entry.columns = measure_rows(rows, features, *entry.trace, entry.info.clock, [this] { pause(); });
    cache_->grew(entry);
    entry.measured.store(true, std::memory_order_release);
  }

  const Database* database_;
  std::shared_ptr<const kv::ReadTransaction> transaction_;
  std::shared_ptr<const Segments> segments_;
  std::shared_ptr<MovementCache> cache_;
  mutable std::optional<std::uint32_t> at_;
  mutable std::shared_ptr<MovementCache::Recording> entry_;
  Watch watch_;
  mutable std::optional<std::uint32_t> motion_of_;
  mutable std::unique_ptr<motion_db::StoredSource> source_;
  mutable SignerModel model_;
};

std::unique_ptr<Movement> Database::movement_of(const std::shared_ptr<const kv::ReadTransaction>& snapshot,
                                                const std::shared_ptr<const Segments>& segments) const {
  const std::uint64_t changes = catalogue::read_head(*snapshot).changes;
  std::shared_ptr<MovementCache> cache;
  {
    const std::lock_guard guard(mutex_);
    if (!movement_ || movement_->changes() < changes) movement_ = std::make_shared<MovementCache>(changes);
    cache = movement_;
  }
  if (cache->changes() != changes) cache = std::make_shared<MovementCache>(changes);  // of an older state: for itself
  return std::make_unique<StoredMovement>(*this, snapshot, segments, std::move(cache));
}

std::vector<Segment> Database::find(const PhaseQuery& query, const FindLimits& limits, FindCounts* counts) const {
  const std::shared_ptr<const kv::ReadTransaction> snapshot = store_->read();
  const std::shared_ptr<const Segments> segments = stored_segments(snapshot);
  const std::unique_ptr<Movement> movement = movement_of(snapshot, segments);
  static_cast<StoredMovement&>(*movement).begin(limits);
  PreparedQuery prepared(query, segments, movement.get(), limits);
  std::vector<Segment> found = prepared.find(limits);
  if (counts != nullptr) *counts = prepared.counts();
  return found;
}

}  // namespace signweave
