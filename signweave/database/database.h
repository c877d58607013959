#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "signweave/annotation/document.h"
#include "signweave/core/error.h"
#include "signweave/database/recording.h"
#include "signweave/features/transition_stats.h"
#include "signweave/kv/kv_store.h"
#include "signweave/motion/motion.h"
#include "signweave/motion_db/motion_db.h"
#include "signweave/query/find.h"
#include "signweave/query/phase_query.h"
#include "signweave/semantic_db/segment_table.h"

namespace signweave {

class Database;

/// What a database held at one moment. Immutable, so threads may share it.
struct Contents {
  std::vector<RecordingInfo> recordings;  ///< by name
  SegmentTable segments;                  ///< its recordings in the same order
  TransitionStats transitions;            ///< over the whole corpus
  std::vector<std::string> faults;        ///< recordings that are damaged and left out: one line each, see `check`

  /// The recording of this name, or null.
  const RecordingInfo* find(std::string_view name) const noexcept;
  /// The same; Error{not_found} with near matches where there is none.
  const RecordingInfo& at(std::string_view name) const;
};

/// A database as it is at one moment, with its motions: what is changed meanwhile is not seen. It belongs to one thread
/// and lives no longer than its Database; hold it no longer than needed, for the space of what is removed or replaced
/// meanwhile is not used again until it ends.
class Snapshot {
 public:
  const Contents& contents() const noexcept { return *contents_; }
  const std::shared_ptr<const Contents>& shared_contents() const noexcept { return contents_; }

  /// The motion of one of `contents().recordings`. Throws Error{not_found} where it has none, Error{corrupt}.
  std::unique_ptr<MotionSource> motion(const RecordingInfo& recording) const;

 private:
  friend class Database;
  const Database* database_ = nullptr;
  std::shared_ptr<const kv::ReadTransaction> transaction_;
  std::shared_ptr<const Contents> contents_;
};

struct CreateOptions {
  std::string engine = "lmdb";
  AccessMode access_mode;  ///< for motions put later
};

/// A database of recordings: motion and meaning, found together. START HERE.
///
///     Database::create("corpus.db", {});
///     Database db("corpus.db", kv::Access::read_write);
///     db.put(recording);
///     for (const Segment& segment : db.find(parse("gloss = \"VANNES\"")))
///       Motion motion = db.read(segment);
///
/// Readers see a recording whole or not at all, and are never blocked. One process at a time may open it read_write.
/// Const functions may be called from several threads at once; the others from one.
class Database {
 public:
  using Progress = std::function<void(double fraction)>;

  /// Makes an empty database in a folder that must not exist or be empty.
  /// Throws Error{already_exists}, Error{unsupported} (engine), Error{io}.
  static void create(const std::filesystem::path& folder, const CreateOptions& options);

  /// Opens a database. read_write waits for nobody: Error{conflict} where another process has it open so; and sweeps
  /// away what an interrupted change left. Throws Error{not_found}, Error{corrupt}, Error{unsupported}, Error{io}.
  Database(const std::filesystem::path& folder, kv::Access access);
  ~Database();
  Database(const Database&) = delete;
  Database& operator=(const Database&) = delete;

  const std::filesystem::path& folder() const noexcept { return folder_; }

  /// What is in it now; made anew only after a change.
  std::shared_ptr<const Contents> contents() const;

  /// The same, and the motions as they are now.
  Snapshot snapshot() const;

  /// What is known of one recording, without looking at the others; none where there is none of this name.
  std::optional<RecordingInfo> info(std::string_view name) const;

  /// Stores a recording. One of the same name gets the halves that are given replaced (motion, annotation), and its
  /// clock, signer and notices; the other half stays. Quaternions are stored in the hemisphere of the frame before
  /// (q and −q are one rotation), else bit for bit. Whole or not at all, also when `progress` throws or the process
  /// is killed. Throws Error{bad_input} for an empty or overlong name or a new recording without both halves,
  /// Error{io}.
  void put(const Recording& recording, const Progress& progress = {});

  /// Removes a recording. One whose catalogue entry is damaged has no name: it goes by the words with which `check`
  /// tells of it, "catalogue entry N". Throws Error{not_found}.
  void remove(std::string_view name);

  /// The segments that answer a query, by recording name and time.
  std::vector<Segment> find(const PhaseQuery& query, const FindLimits& limits = {}) const;

  /// Frames of a recording's motion (clamped to it), reading only the packets that hold them; all joints where
  /// `joints` is empty, others at rest. Throws Error{not_found} for an unknown recording or one without motion.
  Motion read(std::string_view name, FrameRange frames, const JointSet& joints = {},
              motion_db::ReadCost* cost = nullptr) const;
  /// The whole motion.
  Motion read(std::string_view name) const;
  /// The frames of an answer.
  Motion read(const Segment& segment) const;

  /// The skeleton of a recording's motion.
  std::shared_ptr<const Skeleton> skeleton(std::string_view name) const;

  /// The annotation document as it was stored, `source` included. Throws Error{not_found} where there is none.
  AnnotationDocument document(std::string_view name) const;

  /// One line for every fault found in the stored bytes, naming recording, joints and frames; empty where all is well.
  std::vector<std::string> check(const Progress& progress = {}) const;

  kv::EngineInfo engine() const;
  AccessMode access_mode() const;

 private:
  friend class Snapshot;
  class WriterLock;

  std::shared_ptr<const Contents> contents_of(const kv::ReadTransaction& snapshot) const;
  std::shared_ptr<const motion_db::KnownMotion> known(const kv::ReadTransaction& snapshot,
                                                      const motion_db::StoredMotion& stored) const;

  std::uint64_t new_generation(const std::optional<motion_db::StoredMotion>& to_sweep, std::uint64_t count);
  void sweep();
  void require_writable() const;
  std::optional<std::uint32_t> slot_of(const kv::ReadTransaction& snapshot, std::string_view name) const;
  std::optional<std::uint32_t> damaged_slot(const kv::ReadTransaction& snapshot, std::string_view name) const;
  RecordingInfo recording_in(const kv::ReadTransaction& snapshot, std::string_view name) const;

  std::filesystem::path folder_;
  kv::Access access_;
  std::unique_ptr<WriterLock> lock_;
  std::unique_ptr<kv::KvStore> store_;
  /// [slot] names as of `slots_at_`, so that a long import does not read the catalogue again for each recording.
  mutable std::vector<std::string> slots_;
  mutable std::optional<std::uint64_t> slots_at_;
  mutable std::mutex mutex_;
  mutable std::shared_ptr<const Contents> contents_;
  mutable std::uint64_t contents_at_ = 0;
  mutable std::map<std::uint64_t, std::shared_ptr<const motion_db::KnownMotion>> known_;  ///< by generation
};

}  // namespace signweave
