#pragma once

#include <chrono>
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
#include "signweave/database/joins.h"
#include "signweave/database/recording.h"
#include "signweave/features/phase_features.h"
#include "signweave/features/transition_stats.h"
#include "signweave/kv/kv_store.h"
#include "signweave/motion/motion.h"
#include "signweave/motion_db/motion_db.h"
#include "signweave/query/find.h"
#include "signweave/query/phase_query.h"
#include "signweave/semantic_db/documents.h"
#include "signweave/semantic_db/segments.h"
#include "signweave/semantic_db/semantic_db.h"
#include "signweave/xpath/expression.h"

namespace signweave {

class CheckListener;
class Database;
class MovementCache;
class WriterLock;

/// What an XPath expression says of one recording's document: a node that it selects, or its value.
struct XPathAnswer {
  std::string recording;
  xpath::Value value;
};

struct XPathLimits {
  std::optional<std::size_t> limit;  ///< at most so many answers
  std::optional<std::chrono::steady_clock::time_point> deadline;
  std::vector<std::string> recordings;  ///< names; empty: all that have annotation
};

/// What a database held at one moment. Immutable, so threads may share it.
struct Contents {
  std::vector<RecordingInfo> recordings;  ///< by name
  Segments segments;                      ///< its recordings in the same order
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

  /// What is known of the joins of the signs of `contents().recordings[recording]`, from its features; read once as
  /// long as nothing in the database changes. Nothing is known where the features are damaged.
  std::shared_ptr<const RecordingJoins> joins(std::size_t recording) const;

  /// As `model_of` has the whole motion of one of `contents().recordings`; measured once as long as nothing in the
  /// database changes. Throws what `motion` does.
  std::shared_ptr<const SignerModel> signer(const RecordingInfo& recording) const;

  /// What was measured of the phases of `contents().recordings[recording]`, as Database::features; where the record is
  /// damaged nothing, and why.
  RecordingFeatures features(std::size_t recording) const;

  /// What the corpus teaches (see Database::learn): as stored; learned now where what is stored is damaged, of another
  /// version or of a state of the database that is long gone, or nothing is.
  std::shared_ptr<const semantic_db::Learned> learned() const;

 private:
  friend class Database;
  const Database* database_ = nullptr;
  std::shared_ptr<const kv::ReadTransaction> transaction_;
  std::shared_ptr<const Contents> contents_;
};

/// Entries of one kind.
struct Usage {
  std::string kind;  ///< "packets", "skeletons", "scalar tracks", "documents", "segments", "features", "traces",
                     ///< "weights", "catalogue"; "other": not ours
  std::uint64_t entries = 0;
  std::uint64_t bytes = 0;  ///< of keys and values, without what the engine spends beside them
};

/// The layout of the databases that this version writes; it reads those of layouts 2 and later too.
inline constexpr int kDatabaseLayout = 4;

struct CreateOptions {
  std::string engine = "lmdb";
  AccessMode access_mode;                                 ///< for motions put later
  float tolerance = 0;                                    ///< for motions put later, see Storage
  DocumentStorage documents = DocumentStorage::document;  ///< for annotation put later
};

/// How motions are stored, in part: what is none stays as it is.
struct Storage {
  std::optional<AccessMode> mode;
  /// Metres. 0 keeps every bit; more makes compact packets, whose joints and tips lie within so much of where they were
  /// captured, in every frame (motion_db/quantise.h).
  std::optional<float> tolerance;
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
/// More than fifteen members: what is known of the newest state lies beside the mutex that guards it.
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

  /// Where it is open for changing: the name that errors in other processes give to this one, such as "signweave serve
  /// at http://…".
  void announce(std::string_view who) noexcept;

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

  /// Stores a recording's motion anew; false where it is stored so already, or there is no motion. Another access mode
  /// keeps every bit; a tolerance, for a motion that has none yet, rounds once. Readers see the old packets or the new,
  /// never both; when `progress` throws or the process is killed, the old stay. Throws Error{not_found}, Error{corrupt}
  /// where the motion is damaged (it stays as it is), Error{conflict} for another tolerance than the one that it was
  /// rounded with.
  bool relayout(std::string_view name, const Storage& to, const Progress& progress = {});

  /// Measures the phases of a recording anew where what is stored of them was measured by another version, is
  /// damaged, or nothing is; false where it is current. Whatever else changes a recording measures by itself.
  bool measure(std::string_view name);

  /// Learns from the corpus as it is now what weighs how much where signs are chosen by their joins, and how long
  /// transitions take, and stores it;
  /// false where what is stored still holds: no more than a sixteenth of all changes came after it. Call it once after
  /// some changes: without it, whoever signs learns again.
  bool learn();

  /// How motions are stored that are put from now on.
  void set_storage(const Storage& storage);

  /// Where importing left several segment tables, makes one of them, so that a query has one to look at; false where
  /// there is nothing to do. Call it once after some changes.
  bool merge();

  /// What is searched, as it is now. Without `contents`, so a query of a large database does not wait for its
  /// catalogue.
  std::shared_ptr<const Segments> segments() const;

  /// The segments that answer a query, by recording name and time; those of like(…) by distance. `counts` tells what
  /// the search was about.
  std::vector<Segment> find(const PhaseQuery& query, const FindLimits& limits = {}, FindCounts* counts = nullptr) const;

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

  /// One annotation of a recording's document by its id (StoredAnnotation); none where there is none. In `node` storage
  /// nothing else of the document is read. Throws Error{not_found} for an unknown recording or one without annotation.
  std::optional<StoredAnnotation> annotation(std::string_view recording, std::string_view id) const;
  /// Those of a tier, in the order of the document; none where there is no such tier. Throws likewise.
  std::vector<StoredAnnotation> tier(std::string_view recording, std::string_view tier) const;

  /// What an XPath expression says of the documents, by recording name, then in the order of the document. In `node`
  /// storage only the records that it is about are read, where a part of the document tells. Throws Error{not_found}
  /// for an unknown recording, Error{cancelled} when the time is over.
  std::vector<XPathAnswer> xpath(const xpath::Expression& expression, const XPathLimits& limits = {}) const;

  /// Stores a recording's annotation document in the other way; false where it is stored so already, or there is none.
  /// Readers see the old records or the new, and so does whoever opens the database after a crash.
  bool relayout_document(std::string_view name, DocumentStorage storage);
  /// How a recording's document is stored; none where it has none.
  std::optional<DocumentStorage> document_storage(std::string_view name) const;
  /// How documents are stored that are put from now on.
  DocumentStorage document_storage() const;
  void set_document_storage(DocumentStorage storage);

  /// What was measured of a recording's phases: one entry for each phase row of it in the segment table, in their
  /// order. Measured now where nothing of this version is stored.
  RecordingFeatures features(std::string_view name) const;

  /// The records themselves, as they are now: for code that copies them, such as a backup.
  std::unique_ptr<kv::ReadTransaction> records() const { return store_->read(); }

  kv::EngineInfo engine() const;
  /// What takes how much space: packets, documents, …, the largest first. Looks at every entry.
  std::vector<Usage> usage() const;
  /// How motions are stored that are put from now on: access mode, and tolerance in metres.
  AccessMode access_mode() const;
  float tolerance() const;
  /// The layout of its catalogue, kDatabaseLayout or an older one; the next change makes it the newest.
  int layout() const;

 private:
  friend class Snapshot;
  friend class StoredMovement;
  friend void check_slots(const Database& database, std::uint32_t first, CheckListener& listener);

  std::shared_ptr<const Contents> contents_of(const std::shared_ptr<const kv::ReadTransaction>& transaction) const;
  std::shared_ptr<const Segments> stored_segments(const std::shared_ptr<const kv::ReadTransaction>& snapshot) const;
  std::unique_ptr<Movement> movement_of(const std::shared_ptr<const kv::ReadTransaction>& snapshot,
                                        const std::shared_ptr<const Segments>& segments) const;
  std::shared_ptr<const motion_db::KnownMotion> known(const kv::ReadTransaction& snapshot,
                                                      const motion_db::StoredMotion& stored) const;

  /// Writes a motion under a new generation, on the sweep list until a change makes it visible, and reads it back.
  motion_db::StoredMotion write_motion(const Motion& motion, AccessMode mode, float tolerance,
                                       const Progress& progress);
  /// After a change that gave a slot this name, number `changes`: the names need not be read again.
  void remember_slot(std::uint32_t slot, const std::string& name, std::uint64_t changes);
  /// Erases what is on the sweep list.
  void sweep();
  /// Erases the records that no readable recording names, where all recordings are readable.
  void sweep_unnamed();
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
  mutable std::shared_ptr<const Segments> segments_;
  mutable std::uint64_t segments_at_ = 0;
  mutable std::shared_ptr<MovementCache> movement_;  ///< of the newest state that was asked about
  mutable std::map<std::uint64_t, std::shared_ptr<const motion_db::KnownMotion>> known_;  ///< by generation
  mutable std::map<std::size_t, std::shared_ptr<const RecordingJoins>> joins_;   ///< of contents_, by recording
  mutable std::map<std::uint64_t, std::shared_ptr<const SignerModel>> signers_;  ///< of contents_, by generation
  mutable std::shared_ptr<const semantic_db::Learned> learned_;                  ///< of contents_
};

}  // namespace signweave
