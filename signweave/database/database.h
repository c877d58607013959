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
#include "signweave/database/sign_loci.h"
#include "signweave/features/hand_trace.h"
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
struct Mirroring;
struct PreparedRecording;
class WriterLock;

/// A result of an XPath expression over one recording's document: a node that it selects, or its value.
struct XPathAnswer {
  std::string recording;
  xpath::Value value;
};

struct XPathLimits {
  std::optional<std::size_t> limit;  ///< maximum number of answers
  std::optional<std::chrono::steady_clock::time_point> deadline;
  std::vector<std::string> recordings;  ///< names; empty: all with annotation
};

/// The content of a database at one moment. Immutable, so threads may share it.
struct Contents {
  std::vector<RecordingInfo> recordings;  ///< by name
  Segments segments;                      ///< of the recordings, in the same order
  TransitionStats transitions;            ///< over the whole corpus
  std::vector<std::string> faults;        ///< damaged recordings, which are left out: one line each, see `check`

  /// Returns the recording of this name, or null.
  const RecordingInfo* find(std::string_view name) const noexcept;
  /// The same; throws Error{not_found} with near matches if there is none.
  const RecordingInfo& at(std::string_view name) const;
};

/// A database at one moment, with its motions: later changes are not visible. For one thread; the Database must outlive
/// it. Hold it no longer than needed: the space of what is removed or replaced is not reused before it ends.
class Snapshot {
 public:
  const Contents& contents() const noexcept { return *contents_; }
  const std::shared_ptr<const Contents>& shared_contents() const noexcept { return contents_; }

  /// Returns the motion of one of `contents().recordings`. Throws Error{not_found} if it has none, Error{corrupt}.
  std::unique_ptr<MotionSource> motion(const RecordingInfo& recording) const;

  /// Returns the joins of the signs of `contents().recordings[recording]`, from its features; read once until the
  /// database changes. Empty, with the reason, if the features are damaged.
  std::shared_ptr<const RecordingJoins> joins(std::size_t recording) const;

  /// Returns `model_of` of the whole motion of one of `contents().recordings`; measured once until the database
  /// changes. Throws what `motion` throws.
  std::shared_ptr<const SignerModel> signer(const RecordingInfo& recording) const;

  /// Returns how the motion of one of `contents().recordings` is mirrored (mirroring_of); measured once until the
  /// database changes. Throws what `motion` and mirroring_of throw.
  std::shared_ptr<const Mirroring> mirroring(const RecordingInfo& recording) const;

  /// Returns the annotated loci of `contents().recordings[recording]` (loci_in); read once until the database changes.
  /// Empty if it has no annotation. Throws Error{corrupt}.
  std::shared_ptr<const std::vector<AnnotatedLocus>> loci(std::size_t recording) const;

  /// Returns the measures of the phases of `contents().recordings[recording]`, as Database::features does; only the
  /// reason if the record is damaged.
  RecordingFeatures features(std::size_t recording) const;

  /// Returns the trace of both hands of `contents().recordings[recording]`, as stored, or measured now; only the reason
  /// if there is none.
  HandTrace hand_trace(std::size_t recording) const;

  /// Returns the result of learning from the corpus (see Database::learn): the stored record, or learned now if that is
  /// missing, damaged, of another version or of a much older state of the database.
  std::shared_ptr<const semantic_db::Learned> learned() const;

 private:
  template <typename Measured, typename KeptIn, typename Make>
  std::shared_ptr<const Measured> measured_once(const RecordingInfo& recording, KeptIn kept_in, Make make) const;

  friend class Database;
  const Database* database_ = nullptr;
  std::shared_ptr<const kv::ReadTransaction> transaction_;
  std::shared_ptr<const Contents> contents_;
};

/// The space that entries of one kind take.
struct Usage {
  std::string kind;  ///< "packets", "skeletons", "scalar tracks", "documents", "segments", "features", "traces",
                     ///< "weights", "catalogue"; "other": unknown
  std::uint64_t entries = 0;
  std::uint64_t bytes = 0;  ///< of keys and values, without the overhead of the engine
};

/// The layout of the databases that this version writes; it also reads layouts from 2 on.
inline constexpr int kDatabaseLayout = 4;

struct CreateOptions {
  std::string engine = "lmdb";
  AccessMode access_mode;                                 ///< for motions stored later
  float tolerance = 0;                                    ///< for motions stored later, see Storage
  DocumentStorage documents = DocumentStorage::document;  ///< for annotation stored later
};

/// How motions are stored. What is not given stays as it is.
struct Storage {
  std::optional<AccessMode> mode;
  /// Metres. 0 keeps every bit; a greater value gives compact packets, whose joints and tips are within this distance
  /// of their captured positions in every frame (motion_db/quantise.h).
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
/// A change of a recording is atomic for readers, which are never blocked. One process at a time may open a database
/// read_write. Const functions may be called from several threads at once; the others from one.
/// More than fifteen members: the cached data of the newest state is next to the mutex that guards it.
class Database {
 public:
  using Progress = std::function<void(double fraction)>;

  /// Creates an empty database in a folder that does not exist or is empty.
  /// Throws Error{already_exists}, Error{unsupported} (engine), Error{io}.
  static void create(const std::filesystem::path& folder, const CreateOptions& options);

  /// Opens a database. With read_write it does not wait: it throws Error{conflict} if another process has it open
  /// read_write; and it erases what an interrupted change left. Throws Error{not_found}, Error{corrupt},
  /// Error{unsupported}, Error{io}.
  Database(const std::filesystem::path& folder, kv::Access access);
  ~Database();
  Database(const Database&) = delete;
  Database& operator=(const Database&) = delete;

  const std::filesystem::path& folder() const noexcept { return folder_; }

  /// If open read_write, sets the name by which errors in other processes refer to this one, such as "signweave serve
  /// at http://…".
  void announce(std::string_view who) noexcept;

  /// Returns the current content; read again only after a change.
  std::shared_ptr<const Contents> contents() const;

  /// Returns the current state with the motions.
  Snapshot snapshot() const;

  /// Returns the catalogue entry of one recording, without reading the others; none if no recording has this name.
  std::optional<RecordingInfo> info(std::string_view name) const;

  /// Stores a recording. If one of the same name exists, the given halves (motion, annotation), clock, signer and
  /// notices are replaced; a half that is not given stays. Quaternions are stored in the hemisphere of the previous
  /// frame (q and −q are one rotation), else bit for bit. Atomic, even if `progress` throws or the process is killed.
  /// Throws Error{bad_input} for an empty or overlong name or a new recording without both halves, Error{conflict} if
  /// `known` is not what the database holds, Error{io}.
  void put(const Recording& recording, const Progress& progress = {}, const KnownRecordings& known = {});

  /// Throws Error{conflict} unless the database holds exactly these recordings under these names.
  void require_unchanged(const KnownRecordings& known) const;

  /// Removes a recording. One with a damaged catalogue entry has no name: it is removed as "catalogue entry N", as
  /// `check` reports it. Throws Error{not_found}.
  void remove(std::string_view name);

  /// Stores a recording's motion in another form; false if it is stored so already, or there is no motion. Another
  /// access mode keeps every bit; a tolerance, for a motion that has none yet, rounds once. Readers see the old packets
  /// or the new, never both; if `progress` throws or the process is killed, the old ones stay. Throws Error{not_found},
  /// Error{corrupt} if the motion is damaged (it stays as it is), Error{conflict} for another tolerance than the one
  /// that it was rounded with.
  bool relayout(std::string_view name, const Storage& to, const Progress& progress = {});

  /// Measures the phases of a recording again if the stored measures are missing, damaged or of another version; false
  /// if they are current. Not needed after other changes, which measure themselves.
  bool measure(std::string_view name);

  /// True if the measures are current, so that `measure` would do nothing. Throws Error{not_found}.
  bool is_measured(std::string_view name) const;

  /// Learns from the current corpus the weights for choosing signs by their joins, the durations of transitions and the
  /// captured movements, and stores them; false if the stored record is recent enough: at most a sixteenth of all
  /// changes came after it. Call it once after some changes: without it, each signing learns again.
  bool learn();

  /// Sets how motions are stored from now on.
  void set_storage(const Storage& storage);

  /// Merges the segment tables that imports left into one, which is faster to query; false if there is nothing to do.
  /// Call it once after some changes.
  bool merge();

  /// Returns the current segments. Does not need `contents`, so a query of a large database does not wait for its
  /// catalogue.
  std::shared_ptr<const Segments> segments() const;

  /// Returns the segments that match a query, by recording name and time; those of like(…) by distance. `counts`, if
  /// given, receives the extent of the search.
  std::vector<Segment> find(const PhaseQuery& query, const FindLimits& limits = {}, FindCounts* counts = nullptr) const;

  /// Reads frames of a recording's motion (clamped to it), and only the packets that contain them; all joints if
  /// `joints` is empty, else the others are at rest. Throws Error{not_found} for an unknown recording or one without
  /// motion.
  Motion read(std::string_view name, FrameRange frames, const JointSet& joints = {},
              motion_db::ReadCost* cost = nullptr) const;
  /// Reads the whole motion.
  Motion read(std::string_view name) const;
  /// Reads the frames of a segment.
  Motion read(const Segment& segment) const;

  /// Returns the skeleton of a recording's motion.
  std::shared_ptr<const Skeleton> skeleton(std::string_view name) const;

  /// Returns the annotation document as it was stored, with `source`. Throws Error{not_found} if there is none.
  AnnotationDocument document(std::string_view name) const;

  /// Returns one annotation of a recording's document by its id (StoredAnnotation), or none. In `node` storage nothing
  /// else of the document is read. Throws Error{not_found} for an unknown recording or one without annotation.
  std::optional<StoredAnnotation> annotation(std::string_view recording, std::string_view id) const;
  /// Returns the annotations of a tier, in document order; none if there is no such tier. Throws likewise.
  std::vector<StoredAnnotation> tier(std::string_view recording, std::string_view tier) const;

  /// Evaluates an XPath expression over the documents; answers by recording name, then in document order. In `node`
  /// storage, if a part of the document is sufficient, only its records are read. Throws Error{not_found} for an
  /// unknown recording, Error{cancelled} after the deadline.
  std::vector<XPathAnswer> xpath(const xpath::Expression& expression, const XPathLimits& limits = {}) const;

  /// Stores a recording's annotation document in the given form; false if it is stored so already, or there is none.
  /// Readers see the old records or the new, even after a crash.
  bool relayout_document(std::string_view name, DocumentStorage storage);
  /// Returns how a recording's document is stored; none if it has none.
  std::optional<DocumentStorage> document_storage(std::string_view name) const;
  /// Returns how documents are stored from now on.
  DocumentStorage document_storage() const;
  void set_document_storage(DocumentStorage storage);

  /// Returns the measures of a recording's phases: one entry for each of its phase rows in the segment table, in their
  /// order. Measured now if nothing of this version is stored.
  RecordingFeatures features(std::string_view name) const;

  /// Returns the current records: for code that copies them, such as a backup.
  std::unique_ptr<kv::ReadTransaction> records() const { return store_->read(); }

  kv::EngineInfo engine() const;
  /// Returns the space taken by packets, documents, …, the largest first. Reads every key.
  std::vector<Usage> usage() const;
  /// Returns how motions are stored from now on: access mode, and tolerance in metres.
  AccessMode access_mode() const;
  float tolerance() const;
  /// Returns the layout of the catalogue, kDatabaseLayout or an older one; the next change writes the newest.
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

  /// The transaction of `put`.
  void commit(const Recording& recording, PreparedRecording prepared, const KnownRecordings& known);
  void require_unchanged(const kv::ReadTransaction& snapshot, const KnownRecordings& known) const;
  /// Writes a motion under a new generation, which is on the sweep list until a change makes it visible; verifies it.
  motion_db::StoredMotion write_motion(const Motion& motion, AccessMode mode, float tolerance,
                                       const Progress& progress);
  /// Caches the name of a slot, set by change number `changes`, so that the names need not be read again.
  void remember_slot(std::uint32_t slot, const std::string& name, std::uint64_t changes);
  /// Erases the motions on the sweep list.
  void sweep();
  /// Erases the records that no recording refers to, provided that all recordings are readable.
  void sweep_unnamed();
  void require_writable() const;
  std::optional<std::uint32_t> slot_of(const kv::ReadTransaction& snapshot, std::string_view name) const;
  std::optional<std::uint32_t> damaged_slot(const kv::ReadTransaction& snapshot, std::string_view name) const;
  RecordingInfo recording_in(const kv::ReadTransaction& snapshot, std::string_view name) const;

  std::filesystem::path folder_;
  kv::Access access_;
  std::unique_ptr<WriterLock> lock_;
  std::unique_ptr<kv::KvStore> store_;
  /// [slot] names as of change `slots_at_`, so that a long import does not read the catalogue for each recording.
  mutable std::vector<std::string> slots_;
  mutable std::optional<std::uint64_t> slots_at_;
  mutable std::mutex mutex_;
  mutable std::shared_ptr<const Contents> contents_;
  mutable std::uint64_t contents_at_ = 0;
  mutable std::shared_ptr<const Segments> segments_;
  mutable std::uint64_t segments_at_ = 0;
  mutable std::shared_ptr<MovementCache> movement_;  ///< of the newest state that was queried
  mutable std::map<std::uint64_t, std::shared_ptr<const motion_db::KnownMotion>> known_;  ///< by generation
  /// What was read or measured of the recordings of contents_.
  struct Kept {
    std::map<std::size_t, std::shared_ptr<const RecordingJoins>> joins;              ///< by recording
    std::map<std::size_t, std::shared_ptr<const std::vector<AnnotatedLocus>>> loci;  ///< by recording
    std::map<std::uint64_t, std::shared_ptr<const SignerModel>> signers;             ///< by generation
    std::map<std::uint64_t, std::shared_ptr<const Mirroring>> mirrorings;            ///< by generation
    std::shared_ptr<const semantic_db::Learned> learned;
  };
  mutable Kept kept_;
};

}  // namespace signweave
