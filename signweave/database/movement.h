#pragma once

#include <atomic>
#include <cstdint>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <set>
#include <string>
#include <string_view>

#include "signweave/database/recording.h"
#include "signweave/features/gaze.h"
#include "signweave/kv/kv_store.h"
#include "signweave/query/movement.h"
#include "signweave/semantic_db/segments.h"

/// Internal to `database`: the data for query conditions on movement.
namespace signweave {

/// Returns the stored trace of a recording; measured from its motion if none of this version is stored. If the motion
/// is missing or damaged, the trace contains only the reason.
HandTrace trace_stored(const kv::ReadTransaction& snapshot, const RecordingInfo& info, const Pause& pause = {});

/// Caches the data read and measured for queries of one state of a database. Thread-safe. It holds at most kMostBytes,
/// in addition to the entries that a search is using, which stay valid: one recording for the search, and one for each
/// of its conditions on movement.
class MovementCache {
 public:
  explicit MovementCache(std::uint64_t changes) : changes_(changes) {}
  std::uint64_t changes() const noexcept { return changes_; }

  /// The cached data of a recording. All but `info` is valid once its flag is set; one thread determines it while it
  /// holds the mutex.
  struct Entry {
    RecordingInfo info;
    std::string fault;  ///< why `info` could not be read; empty: no fault
    std::mutex finding;
    std::atomic<bool> traced = false;
    std::shared_ptr<const HandTrace> trace;
    std::atomic<bool> measured = false;
    MovementColumns columns;
    std::atomic<bool> eyes_known = false;
    std::optional<GazeSource> eyes;
  };
  /// The entry of a recording (numbered as in Segments), or null.
  std::shared_ptr<Entry> find(std::uint32_t recording) const;
  /// Adds an entry unless another thread has added one; returns the one that is cached.
  std::shared_ptr<Entry> add(std::uint32_t recording, const std::shared_ptr<Entry>& entry);
  /// Call when an entry has grown by this many bytes.
  void grew(std::size_t bytes);

  /// True if remember_track was called for this scalar track.
  bool has_track(std::string_view name) const;
  void remember_track(std::string_view name);

 private:
  void make_room(std::size_t bytes);

  /// Beyond this size all entries are dropped, and read again when needed.
  static constexpr std::size_t kMostBytes = std::size_t{512} << 20U;

  std::uint64_t changes_;
  mutable std::mutex mutex_;
  std::map<std::uint32_t, std::shared_ptr<Entry>> recordings_;
  std::set<std::string, std::less<>> tracks_;  ///< names that a query used and some recording has
  std::size_t bytes_ = 0;
};

}  // namespace signweave
