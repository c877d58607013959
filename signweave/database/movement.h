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

/// Inside this module only: what conditions on movement are answered from.
namespace signweave {

/// The trace of a recording as it is stored; measured from its motion where nothing of this version is stored, and only
/// why there is none where the motion is missing or damaged.
HandTrace trace_stored(const kv::ReadTransaction& snapshot, const RecordingInfo& info, const Pause& pause = {});

/// What was read and measured for queries of one state of a database, so that the next query need not. Threads may
/// share it. It keeps at most kMostBytes; what a search has in hand stays valid beside that: one recording for itself,
/// and one for each of its conditions on movement.
class MovementCache {
 public:
  explicit MovementCache(std::uint64_t changes) : changes_(changes) {}
  std::uint64_t changes() const noexcept { return changes_; }

  /// What is known of a recording. All but `info` is there once its flag says so; it is found by one thread, which has
  /// the mutex meanwhile.
  struct Recording {
    RecordingInfo info;
    std::string fault;  ///< why nothing is known; empty: all is well
    std::mutex finding;
    std::atomic<bool> traced = false;
    std::shared_ptr<const HandTrace> trace;
    std::atomic<bool> measured = false;
    MovementColumns columns;
    std::atomic<bool> eyes_known = false;
    std::optional<GazeSource> eyes;
  };
  /// The entry of a recording (numbered as in Segments), or null.
  std::shared_ptr<Recording> find(std::uint32_t recording) const;
  /// Adds an entry, unless another thread did; in either case what is there.
  std::shared_ptr<Recording> add(std::uint32_t recording, const std::shared_ptr<Recording>& entry);
  /// So many bytes came to an entry.
  void grew(std::size_t bytes);

  /// Whether it was `remember`ed that some recording has this scalar track.
  bool has_track(std::string_view name) const;
  void remember_track(std::string_view name);

 private:
  void make_room(std::size_t bytes);

  /// Beyond so many bytes all is let go of, and read again when it is asked for.
  static constexpr std::size_t kMostBytes = std::size_t{512} << 20U;

  std::uint64_t changes_;
  mutable std::mutex mutex_;
  std::map<std::uint32_t, std::shared_ptr<Recording>> recordings_;
  std::set<std::string, std::less<>> tracks_;  ///< that queries asked for
  std::size_t bytes_ = 0;
};

}  // namespace signweave
