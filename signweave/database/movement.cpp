#include "signweave/database/movement.h"

#include <algorithm>
#include <chrono>
#include <set>
#include <thread>

#include "signweave/core/text.h"
#include "signweave/database/catalogue.h"
#include "signweave/database/database.h"
#include "signweave/database/measure.h"
#include "signweave/formats/face/face_csv.h"
#include "signweave/query/stop_check.h"
#include "signweave/semantic_db/semantic_db.h"
#include "signweave/semantic_db/trace_store.h"

namespace signweave {
namespace {

HandTrace no_trace(std::string why_not) {
  HandTrace trace;
  trace.why_not = std::move(why_not);
  return trace;
}

/// Returns the index of a name: an exact match, else one that ignores case, because Live Link Face writes EyeBlinkLeft.
template <typename Names>
std::optional<std::size_t> index_in(const Names& names, std::string_view name) {
  auto at = std::ranges::find(names, name);
  if (at == names.end()) {
    const std::string folded = fold_case(name);
    at = std::ranges::find_if(names, [&](const auto& one) { return fold_case(one) == folded; });
  }
  return at == names.end() ? std::nullopt : std::optional(static_cast<std::size_t>(at - names.begin()));
}

std::optional<std::size_t> stored_track(const RecordingInfo& info, std::string_view name) {
  return info.motion ? index_in(info.motion->tracks, name) : std::nullopt;
}

/// True if a recording has a face: a track with a name that face captures use.
bool is_face(const RecordingInfo& info) {
  const auto known = [](const std::string& track) {
    return std::ranges::find(face_csv::track_names(), track) != face_csv::track_names().end();
  };
  return info.motion && std::ranges::any_of(info.motion->tracks, known);
}

/// True if a track was left out because it is 0 throughout (face_csv::resampled).
bool is_at_rest(const RecordingInfo& info, std::string_view name) {
  return is_face(info) && index_in(face_csv::track_names(), name);
}

/// Returns the rows of a recording in the order of its table.
std::vector<MovementRow> rows_of(const SegmentTable::RecordingRef& part) {
  const SegmentTable& table = *part.table;
  const SegmentTable::RowRange range = table.recording_rows(part.recording);
  std::vector<MovementRow> rows;
  rows.reserve(range.size());
  for (RowId row = range.begin; row < range.end; ++row) {
    const RowId parent = table.parent(row);
    // Movement of a unit is measured over its whole span, as for an annotation.
    const RowKind kind = table.kind(row) == RowKind::unit ? RowKind::annotation : table.kind(row);
    rows.push_back({.kind = kind,
                    .phase = table.phase(row),
                    .parent = range.contains(parent) ? parent - range.begin : kNoRow,
                    .span = table.span(row)});
  }
  return rows;
}

}  // namespace

HandTrace Snapshot::hand_trace(std::size_t recording) const {
  return trace_stored(*transaction_, contents_->recordings[recording]);
}

std::shared_ptr<MovementCache::Entry> MovementCache::find(std::uint32_t recording) const {
  const std::lock_guard guard(mutex_);
  const auto at = recordings_.find(recording);
  return at == recordings_.end() ? nullptr : at->second;
}

std::shared_ptr<MovementCache::Entry> MovementCache::add(std::uint32_t recording, const std::shared_ptr<Entry>& entry) {
  const std::lock_guard guard(mutex_);
  make_room(sizeof(Entry));
  return recordings_.try_emplace(recording, entry).first->second;
}

void MovementCache::grew(std::size_t bytes) {
  const std::lock_guard guard(mutex_);
  make_room(bytes);
}

bool MovementCache::has_track(std::string_view name) const {
  const std::lock_guard guard(mutex_);
  return tracks_.find(name) != tracks_.end();
}

void MovementCache::remember_track(std::string_view name) {
  constexpr std::size_t kMostTracks = 10'000;  // a query may use any name
  const std::lock_guard guard(mutex_);
  if (tracks_.size() < kMostTracks) tracks_.emplace(name);
}

/// The caller must hold the mutex.
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
    // Not owned: `snapshot` outlives the source.
    const std::shared_ptr<const kv::ReadTransaction> borrowed(std::shared_ptr<void>(), &snapshot);
    const motion_db::StoredSource source(borrowed, std::make_shared<motion_db::KnownMotion>(snapshot, *info.motion));
    return trace_hands(source, model_of(source, info.rig, pause), pause);
  } catch (const Error& error) {
    if (error.code() != ErrorCode::corrupt) throw;
    return no_trace(error.what());
  }
}

/// Movement in the state that a transaction sees.
class StoredMovement : public Movement {
 public:
  StoredMovement(const Database& database, std::shared_ptr<const kv::ReadTransaction> transaction,
                 std::shared_ptr<const Segments> segments, std::shared_ptr<MovementCache> cache)
      : database_(&database),
        transaction_(std::move(transaction)),
        segments_(std::move(segments)),
        cache_(std::move(cache)) {}

  /// From now on every operation stops as `limits` require.
  void begin(const FindLimits& limits) { stop_check_.begin(limits); }
  void pause() const override { stop_check_.check(); }

  ColumnValues column(Column column, std::uint32_t recording) const override {
    MovementCache::Entry& entry = at(recording);
    find_once(entry, entry.measured, [&] { measure(recording, entry); });
    return {entry.columns[place_of(column)], entry_};
  }
  float shoulder_width(std::uint32_t recording) const override { return hands(recording)->shoulder_width; }
  FrameClock clock(std::uint32_t recording) const override { return at(recording).info.clock; }
  std::shared_ptr<const HandTrace> hands(std::uint32_t recording) const override {
    MovementCache::Entry& entry = at(recording);
    find_once(entry, entry.traced, [&] { trace(entry); });
    return entry.trace;
  }
  std::int64_t frame_count(std::uint32_t recording) const override {
    const RecordingInfo& info = at(recording).info;
    return info.motion ? info.motion->frames : 0;
  }

  std::vector<float> track(std::uint32_t recording, std::string_view name, FrameRange frames) const override {
    const TrackPlace& place = place_of_track(recording, name);
    const auto count = static_cast<std::size_t>(frames.size());
    if (!place.stored) return std::vector<float>(place.at_rest ? count : 0);
    std::vector<float> values(count);
    std::vector<std::span<float>> wanted(at(recording).info.motion->tracks.size());
    wanted[*place.stored] = values;
    source(recording).read_tracks(frames, wanted);
    return values;
  }
  std::vector<Gaze> gaze(std::uint32_t recording, FrameRange frames) const override {
    MovementCache::Entry& entry = at(recording);
    if (!entry.info.motion) return {};
    find_once(entry, entry.eyes_known, [&] {
      entry.eyes = gaze_source(entry.info.motion->tracks);
      if (!entry.eyes && entry.info.motion->frames > 0) {
        entry.eyes = gaze_source(source(recording), model(recording).rig, [this] { pause(); });
      }
    });
    if (!entry.eyes) return {};
    return gaze_over(source(recording), *entry.eyes, frames, [this] { pause(); });
  }
  bool has_track(std::string_view name) const override {
    if (cache_->has_track(name)) return true;
    const bool found = visit_catalogue(
        [&](const RecordingInfo& info) { return !stored_track(info, name) && !is_at_rest(info, name); });
    if (found) cache_->remember_track(name);
    return found;
  }
  std::vector<std::string> tracks() const override {
    std::set<std::string> names;
    visit_catalogue([&](const RecordingInfo& info) {
      if (info.motion) names.insert(info.motion->tracks.begin(), info.motion->tracks.end());
      if (is_face(info)) names.insert(face_csv::track_names().begin(), face_csv::track_names().end());
      return true;
    });
    return {names.begin(), names.end()};
  }

  std::vector<PointTrack> points(std::uint32_t recording, std::span<const Part> parts,
                                 FrameRange range) const override {
    if (!at(recording).info.motion) return std::vector<PointTrack>(parts.size());
    return track_points(source(recording), model(recording), parts, range, [this] { pause(); });
  }

 private:
  struct TrackPlace {
    std::optional<std::size_t> stored;
    bool at_rest = false;  ///< not stored, because it is 0 throughout
  };
  const TrackPlace& place_of_track(std::uint32_t recording, std::string_view name) const {
    const RecordingInfo& info = at(recording).info;
    auto found = track_places_.find(name);
    if (found == track_places_.end()) {
      const std::optional<std::size_t> stored = stored_track(info, name);
      found = track_places_.emplace(name, TrackPlace{stored, !stored && is_at_rest(info, name)}).first;
    }
    return found->second;
  }

  /// Returns the motion of a recording that has one. Only the last one is held: callers go through the recordings in
  /// order.
  const MotionSource& source(std::uint32_t recording) const {
    if (source_of_ != recording) {
      source_of_.reset();
      model_.reset();
      const motion_db::StoredMotion& stored = *at(recording).info.motion;
      source_ = std::make_unique<motion_db::StoredSource>(transaction_, database_->known(*transaction_, stored));
      source_of_ = recording;
    }
    return *source_;
  }
  const SignerModel& model(std::uint32_t recording) const {
    const MotionSource& motion = source(recording);
    if (!model_) model_ = model_of(motion, at(recording).info.rig, [this] { pause(); });
    return *model_;
  }

  /// Calls `use(info)` for all readable recordings until it returns false; true if it did.
  template <typename Use>
  bool visit_catalogue(Use&& use) const {
    const std::uint32_t count = catalogue::read_head(*transaction_).recordings;
    for (std::uint32_t slot = 0; slot < count; ++slot) {
      pause();
      try {
        if (!use(catalogue::read_recording(*transaction_, slot))) return true;
      } catch (const Error& error) {
        if (error.code() != ErrorCode::corrupt) throw;  // `check` reports it
      }
    }
    return false;
  }

  MovementCache::Entry& at(std::uint32_t recording) const {
    if (at_ != recording) {
      pause();
      std::shared_ptr<MovementCache::Entry> entry = cache_->find(recording);
      entry_ = entry ? std::move(entry) : cache_->add(recording, read(recording));
      at_ = recording;
      track_places_.clear();
    }
    return *entry_;
  }

  std::shared_ptr<MovementCache::Entry> read(std::uint32_t recording) const {
    auto entry = std::make_shared<MovementCache::Entry>();
    try {
      entry->info = database_->recording_in(*transaction_, segments_->recording_name(recording));
    } catch (const Error& error) {  // a damaged entry of the catalogue
      if (error.code() != ErrorCode::corrupt && error.code() != ErrorCode::not_found) throw;
      entry->fault = error.what();
    }
    return entry;
  }

  /// Calls `find()`, which fills in a part of an entry, unless another thread has already done so.
  template <typename Find>
  void find_once(MovementCache::Entry& entry, std::atomic<bool>& found, Find&& find) const {
    if (found.load(std::memory_order_acquire)) return;
    std::unique_lock lock(entry.finding, std::defer_lock);
    while (!lock.try_lock()) {  // another search fills it in; this one may be stopped while it waits
      pause();
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    if (found.load(std::memory_order_acquire)) return;
    pause();
    find();
    found.store(true, std::memory_order_release);
  }

  void trace(MovementCache::Entry& entry) const {
    HandTrace found = no_trace(entry.fault);
    if (entry.fault.empty()) {
      try {
        found = trace_stored(*transaction_, entry.info, [this] { pause(); });
      } catch (const Error& error) {  // a rig that does not fit the skeleton
        if (error.code() != ErrorCode::corrupt && error.code() != ErrorCode::not_found) throw;
        found = no_trace(error.what());
      }
    }
    std::size_t bytes = 0;
    for (const auto& points : found.points) bytes += points.size() * sizeof(TraceSample);
    entry.trace = std::make_shared<const HandTrace>(std::move(found));
    cache_->grew(bytes);
  }

  void measure(std::uint32_t recording, MovementCache::Entry& entry) const {
    if (!entry.traced.load(std::memory_order_acquire)) {
      trace(entry);
      entry.traced.store(true, std::memory_order_release);
    }
    const std::vector<MovementRow> rows = rows_of(segments_->part(recording));
    RecordingFeatures features;
    if (entry.info.document != 0 && entry.trace->samples() != 0) {
      try {
        if (auto stored =
                semantic_db::read_features(*transaction_, entry.info.document, entry.info.name, [this] { pause(); })) {
          features = *std::move(stored);
        }
      } catch (const Error& error) {
        if (error.code() != ErrorCode::corrupt) throw;  // `check` reports it; the trace serves nearly as well
      }
    }
    pause();
    entry.columns = measure_rows(rows, features, *entry.trace, entry.info.clock, [this] { pause(); });
    std::size_t bytes = 0;
    for (const std::vector<float>& column : entry.columns) bytes += column.size() * sizeof(float);
    cache_->grew(bytes);
  }

  const Database* database_;
  std::shared_ptr<const kv::ReadTransaction> transaction_;
  std::shared_ptr<const Segments> segments_;
  std::shared_ptr<MovementCache> cache_;
  mutable std::optional<std::uint32_t> at_;
  mutable std::shared_ptr<MovementCache::Entry> entry_;
  mutable std::map<std::string, TrackPlace, std::less<>> track_places_;  ///< of the recording `at_`
  StopCheck stop_check_;
  mutable std::optional<std::uint32_t> source_of_;  ///< the recording of `source_` and `model_`
  mutable std::unique_ptr<motion_db::StoredSource> source_;
  mutable std::optional<SignerModel> model_;  ///< once it was needed
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
  if (cache->changes() != changes) cache = std::make_shared<MovementCache>(changes);  // an older state has its own
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
