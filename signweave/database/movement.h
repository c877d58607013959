#pragma once

#include <atomic>
#include <cstdint>
#include <map>
#include <memory>
#include <mutex>
#include <string>

#include "signweave/database/recording.h"
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

  struct Recording {
    RecordingInfo info;
    std::shared_ptr<const HandTrace> trace;
    std::mutex measuring;
    std::atomic<bool> measured = false;
    MovementColumns columns;  ///< once measured
  };
  /// The entry of a recording (numbered as in Segments), or null.
  std::shared_ptr<Recording> find(std::uint32_t recording) const;
  /// Adds an entry, unless another thread did; in either case what is there.
  std::shared_ptr<Recording> add(std::uint32_t recording, std::shared_ptr<Recording> entry);
  /// An entry's columns were measured.
  void grew(const Recording& entry);

 private:
  void make_room(std::size_t bytes);

  /// Beyond so many bytes all is let go of, and read again when it is asked for.
  static constexpr std::size_t kMostBytes = std::size_t{512} << 20U;

  std::uint64_t changes_;
  mutable std::mutex mutex_;
  std::map<std::uint32_t, std::shared_ptr<Recording>> recordings_;
  std::size_t bytes_ = 0;
};

}  // namespace signweave
