#include "signweave/database/database.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>

#include "signweave/core/text.h"
#include "signweave/database/catalogue.h"
#include "signweave/formats/eaf.h"
#include "signweave/semantic_db/semantic_db.h"

namespace signweave {

/// Held while a process has the database open for writing. The system lets go of it when the process ends, however it
/// ends, so a crash leaves no lock behind.
class Database::WriterLock {
 public:
  explicit WriterLock(const std::filesystem::path& folder) {
    const std::filesystem::path path = folder / "writer.lock";
    file_ = ::open(path.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666);
    if (file_ < 0) {
      throw Error(ErrorCode::io,
                  fmt::format("{}: cannot be opened for writing: {}", folder.string(), std::strerror(errno)));
    }
    if (::flock(file_, LOCK_EX | LOCK_NB) != 0) {
      ::close(file_);
      throw Error(ErrorCode::conflict, folder.string() +
                                           ": is being changed by another process; try again when that one "
                                           "has ended");
    }
  }
  ~WriterLock() { ::close(file_); }
  WriterLock(const WriterLock&) = delete;
  WriterLock& operator=(const WriterLock&) = delete;

 private:
  int file_ = -1;
};

const RecordingInfo* Contents::find(std::string_view name) const noexcept {
  const auto at =
      std::lower_bound(recordings.begin(), recordings.end(), name,
                       [](const RecordingInfo& info, std::string_view wanted) { return info.name < wanted; });
  return at != recordings.end() && at->name == name ? &*at : nullptr;
}

const RecordingInfo& Contents::at(std::string_view name) const {
  if (const RecordingInfo* info = find(name)) return *info;
  std::vector<std::string> names;
  for (const RecordingInfo& info : recordings) names.push_back(info.name);
  throw Error(ErrorCode::not_found,
              fmt::format("no recording '{}' in this database{}", printable(name), did_you_mean(name, names)));
}

void Database::create(const std::filesystem::path& folder, const CreateOptions& options) {
  kv::create(folder, options.engine);
  const std::unique_ptr<kv::KvStore> store = kv::open(folder, kv::Access::read_write);
  const std::unique_ptr<kv::WriteTransaction> transaction = store->write();
  catalogue::write_head(*transaction, {.access_mode = options.access_mode});
  transaction->commit();
}

Database::Database(const std::filesystem::path& folder, kv::Access access) : folder_(folder), access_(access) {
  // The store first: it tells whether there is a database at all, before a lock file is made.
  store_ = kv::open(folder, access);
  catalogue::read_head(*store_->read());
  if (access == kv::Access::read_write) {
    lock_ = std::make_unique<WriterLock>(folder);
    sweep();
  }
}

Database::~Database() = default;

std::shared_ptr<const Contents> Database::contents() const {
  return contents_of(*store_->read());
}

Snapshot Database::snapshot() const {
  Snapshot made;
  made.database_ = this;
  made.transaction_ = store_->read();
  made.contents_ = contents_of(*made.transaction_);
  return made;
}

std::shared_ptr<const Contents> Database::contents_of(const kv::ReadTransaction& snapshot) const {
  const catalogue::Head head = catalogue::read_head(snapshot);
  const std::lock_guard guard(mutex_);
  if (contents_ && contents_at_ == head.changes) return contents_;

  auto made = std::make_shared<Contents>();
  made->recordings.reserve(head.recordings);
  // A damaged record leaves out its own recording, never the others.
  for (std::uint32_t slot = 0; slot < head.recordings; ++slot) {
    try {
      made->recordings.push_back(catalogue::read_recording(snapshot, slot));
    } catch (const Error& error) {
      made->faults.emplace_back(error.what());
    }
  }
  std::sort(made->recordings.begin(), made->recordings.end(),
            [](const RecordingInfo& a, const RecordingInfo& b) { return a.name < b.name; });
  std::vector<SegmentChunk> chunks(made->recordings.size());
  std::vector<SegmentTable::Source> sources;
  for (std::size_t i = 0; i < chunks.size(); ++i) {
    const RecordingInfo& info = made->recordings[i];
    try {
      if (info.document != 0) chunks[i] = semantic_db::read_segments(snapshot, info.document, info.name);
    } catch (const Error& error) {
      made->faults.emplace_back(error.what());
    }
    sources.push_back({info.name, &chunks[i]});
  }
  made->segments = SegmentTable(sources);

  std::vector<Transition> transitions;
  for (std::uint32_t recording = 0; recording < sources.size(); ++recording) {
    const std::vector<Transition> found = transitions_in(signs_of(made->segments, recording));
    transitions.insert(transitions.end(), found.begin(), found.end());
  }
  made->transitions = summarize(transitions);
  if (contents_ && contents_at_ > head.changes) return made;  // another thread has seen a newer state: it stays
  contents_ = made;
  contents_at_ = head.changes;
  std::erase_if(known_, [&](const auto& entry) {
    return std::none_of(made->recordings.begin(), made->recordings.end(), [&](const RecordingInfo& info) {
      return info.motion && info.motion->generation == entry.first;
    });
  });
  return made;
}

std::shared_ptr<const motion_db::KnownMotion> Database::known(const kv::ReadTransaction& snapshot,
                                                              const motion_db::StoredMotion& stored) const {
  {
    const std::lock_guard guard(mutex_);
    const auto at = known_.find(stored.generation);
    if (at != known_.end()) return at->second;
  }
  auto made = std::make_shared<const motion_db::KnownMotion>(snapshot, stored);
  const std::lock_guard guard(mutex_);
  return known_.try_emplace(stored.generation, std::move(made)).first->second;
}

void Database::require_writable() const {
  if (access_ != kv::Access::read_write) {
    throw Error(ErrorCode::conflict, folder_.string() + ": was opened for reading only");
  }
}

std::optional<std::uint32_t> Database::slot_of(const kv::ReadTransaction& snapshot, std::string_view name) const {
  const catalogue::Head head = catalogue::read_head(snapshot);
  const std::lock_guard guard(mutex_);
  if (slots_at_ != head.changes) {
    slots_.clear();
    for (std::uint32_t slot = 0; slot < head.recordings; ++slot) {
      try {
        slots_.push_back(catalogue::read_recording(snapshot, slot).name);
      } catch (const Error&) {
        slots_.emplace_back();  // damaged: no name is empty, so nothing finds it; `check` tells
      }
    }
    slots_at_ = head.changes;
  }
  const auto at = std::find(slots_.begin(), slots_.end(), name);
  if (at == slots_.end()) return std::nullopt;
  return static_cast<std::uint32_t>(at - slots_.begin());
}

std::optional<RecordingInfo> Database::info(std::string_view name) const {
  const std::unique_ptr<kv::ReadTransaction> snapshot = store_->read();
  const std::optional<std::uint32_t> slot = slot_of(*snapshot, name);
  if (!slot) return std::nullopt;
  return catalogue::read_recording(*snapshot, *slot);
}

std::uint64_t Database::new_generation(const std::optional<motion_db::StoredMotion>& to_sweep, std::uint64_t count) {
  const std::unique_ptr<kv::WriteTransaction> transaction = store_->write();
  catalogue::Head head = catalogue::read_head(*transaction);
  const std::uint64_t first = head.next_generation;
  head.next_generation += count;
  catalogue::write_head(*transaction, head);
  if (to_sweep) {
    catalogue::SweepList list = catalogue::read_sweep_list(*transaction);
    list.push_back(*to_sweep);
    list.back().generation = first;
    catalogue::write_sweep_list(*transaction, list);
  }
  transaction->commit();
  return first;
}

void Database::put(const Recording& recording, const Progress& progress) {
  require_writable();
  if (trimmed(recording.name).empty() || recording.name.size() > 1000 || !is_utf8(recording.name)) {
    throw Error(ErrorCode::bad_input,
                fmt::format("'{}': a recording needs a name of 1 to 1000 bytes of UTF-8", printable(recording.name)));
  }
  if (!recording.motion && !recording.annotation && !this->info(recording.name)) {
    throw Error(ErrorCode::bad_input, recording.name + ": neither motion nor annotation to store");
  }

  // What can fail for the input's sake fails before anything is written.
  std::string source;
  SegmentChunk segments;
  if (recording.annotation) {
    const AnnotationPart& part = *recording.annotation;
    source = part.document.source.empty() ? eaf::write_text(part.document) : part.document.source;
    segments = segments_of(part.document, signs_in(part.document, part.tiers).signs);
  }
  // What is stored keeps one hemisphere from frame to frame, so that whoever joins it need not look at every frame.
  Motion turned;
  const Motion* motion = recording.motion ? &recording.motion->motion : nullptr;
  if (motion != nullptr && !keeps_hemisphere(*motion)) {
    turned = *motion;
    keep_hemisphere(turned);
    motion = &turned;
  }
  std::optional<motion_db::StoredMotion> stored;
  if (motion != nullptr) stored = motion_db::describe(*motion, access_mode(), 0);

  // Generation n for the motion, n + 1 for the document. The motion goes onto the sweep list before its first packet is
  // written and off it in the same transaction that makes the recording visible: a crash between leaves only what the
  // next open sweeps away.
  const std::uint64_t generation = new_generation(stored, 2);
  if (stored) {
    stored->generation = generation;
    try {
      motion_db::put(*store_, *stored, *motion, progress);
    } catch (...) {
      try {
        sweep();
      } catch (const Error&) {  // the disk may be full: what is left is swept at the next open
      }
      throw;
    }
  }

  const std::unique_ptr<kv::WriteTransaction> transaction = store_->write();
  catalogue::Head head = catalogue::read_head(*transaction);
  catalogue::SweepList list = catalogue::read_sweep_list(*transaction);
  const std::optional<std::uint32_t> known = slot_of(*transaction, recording.name);
  const std::uint32_t slot = known.value_or(head.recordings);
  RecordingInfo info;
  if (known) info = catalogue::read_recording(*transaction, slot);
  info.name = recording.name;
  info.signer = recording.signer;
  info.clock = recording.clock;
  info.clock_given = recording.clock_given;
  info.tiers_given = recording.tiers_given;
  info.signer_given = recording.signer_given;
  info.notices = recording.notices;
  if (recording.motion) {
    std::erase_if(list, [&](const motion_db::StoredMotion& one) { return one.generation == generation; });
    if (info.motion) list.push_back(*info.motion);
    info.motion = stored;
    info.layout = recording.motion->layout;
    info.motion_file = recording.motion->file;
    info.motion_fingerprint = recording.motion->fingerprint;
    info.face_file = recording.motion->face_file;
    info.face_fingerprint = recording.motion->face_fingerprint;
  }
  if (recording.annotation) {
    if (info.document != 0) semantic_db::erase(*transaction, info.document);
    info.document = generation + 1;
    info.tiers = recording.annotation->tiers;
    info.annotation_file = recording.annotation->file;
    info.annotation_fingerprint = recording.annotation->fingerprint;
    info.declarations.clear();
    for (const auto& property : recording.annotation->document.properties) {
      if (property.first.starts_with("signweave:")) info.declarations.push_back(property);
    }
    semantic_db::put(*transaction, info.document, source, segments);
  }
  catalogue::write_recording(*transaction, slot, info);
  catalogue::write_sweep_list(*transaction, list);
  if (slot == head.recordings) ++head.recordings;
  ++head.changes;
  catalogue::write_head(*transaction, head);
  transaction->commit();

  {
    const std::lock_guard guard(mutex_);
    if (slots_at_ == head.changes - 1) {  // else a reader has looked again already
      if (slot == slots_.size()) slots_.emplace_back();
      slots_[slot] = info.name;
      slots_at_ = head.changes;
    }
  }
  if (!list.empty()) sweep();
}

std::optional<std::uint32_t> Database::damaged_slot(const kv::ReadTransaction& snapshot, std::string_view name) const {
  const std::uint32_t recordings = catalogue::read_head(snapshot).recordings;
  for (std::uint32_t slot = 0; slot < recordings; ++slot) {
    if (name != fmt::format("catalogue entry {}", slot)) continue;
    try {
      catalogue::read_recording(snapshot, slot);
    } catch (const Error&) {
      return slot;
    }
  }
  return std::nullopt;
}

void Database::remove(std::string_view name) {
  require_writable();
  const std::unique_ptr<kv::WriteTransaction> transaction = store_->write();
  std::optional<std::uint32_t> slot = slot_of(*transaction, name);
  const bool damaged = !slot && (slot = damaged_slot(*transaction, name)).has_value();
  if (!slot) contents()->at(name);  // the error with near matches
  if (!slot) throw Error(ErrorCode::not_found, fmt::format("no recording '{}' in this database", printable(name)));
  catalogue::Head head = catalogue::read_head(*transaction);
  const RecordingInfo info = damaged ? RecordingInfo{} : catalogue::read_recording(*transaction, *slot);
  if (info.document != 0) semantic_db::erase(*transaction, info.document);
  if (info.motion) {
    catalogue::SweepList list = catalogue::read_sweep_list(*transaction);
    list.push_back(*info.motion);
    catalogue::write_sweep_list(*transaction, list);
  }
  const std::uint32_t last = head.recordings - 1;
  if (*slot != last) {
    catalogue::move_recording(*transaction, last, *slot);
  } else {
    catalogue::erase_recording(*transaction, last);
  }
  --head.recordings;
  ++head.changes;
  catalogue::write_head(*transaction, head);
  transaction->commit();
  sweep();
}

void Database::sweep() {
  for (;;) {
    const catalogue::SweepList list = catalogue::read_sweep_list(*store_->read());
    if (list.empty()) return;
    motion_db::erase(*store_, list.back());
    const std::unique_ptr<kv::WriteTransaction> transaction = store_->write();
    catalogue::SweepList rest = catalogue::read_sweep_list(*transaction);
    std::erase(rest, list.back());
    catalogue::write_sweep_list(*transaction, rest);
    transaction->commit();
  }
}

std::vector<Segment> Database::find(const PhaseQuery& query, const FindLimits& limits) const {
  return signweave::find(query, contents()->segments, limits);
}

namespace {

const motion_db::StoredMotion& motion_of(const RecordingInfo& info) {
  if (info.motion) return *info.motion;
  throw Error(ErrorCode::not_found, fmt::format("recording '{}' has no motion; import its motion file too", info.name));
}

}  // namespace

RecordingInfo Database::recording_in(const kv::ReadTransaction& snapshot, std::string_view name) const {
  const std::optional<std::uint32_t> slot = slot_of(snapshot, name);
  if (slot) return catalogue::read_recording(snapshot, *slot);
  contents()->at(name);  // the error with near matches
  throw Error(ErrorCode::conflict, fmt::format("{}: was added just now; try again", printable(name)));
}

// Each of these reads the catalogue and the data it names in one snapshot: what another process does meanwhile is not
// seen.

Motion Database::read(std::string_view name, FrameRange frames, const JointSet& joints,
                      motion_db::ReadCost* cost) const {
  const std::unique_ptr<kv::ReadTransaction> snapshot = store_->read();
  const RecordingInfo info = recording_in(*snapshot, name);
  const motion_db::StoredMotion& stored = motion_of(info);
  return motion_db::read(*snapshot, stored, motion_db::read_skeleton(*snapshot, stored), clamp(frames, stored.frames),
                         joints, cost);
}

std::unique_ptr<MotionSource> Snapshot::motion(const RecordingInfo& recording) const {
  return std::make_unique<motion_db::StoredSource>(transaction_, database_->known(*transaction_, motion_of(recording)));
}

Motion Database::read(std::string_view name) const {
  return read(name, {0, std::numeric_limits<std::int64_t>::max()});
}

Motion Database::read(const Segment& segment) const {
  const std::unique_ptr<kv::ReadTransaction> snapshot = store_->read();
  const RecordingInfo info = recording_in(*snapshot, segment.recording);
  const motion_db::StoredMotion& stored = motion_of(info);
  return motion_db::read(*snapshot, stored, motion_db::read_skeleton(*snapshot, stored),
                         clamp(frames_of(segment.span, info.clock), stored.frames));
}

std::shared_ptr<const Skeleton> Database::skeleton(std::string_view name) const {
  const std::unique_ptr<kv::ReadTransaction> snapshot = store_->read();
  return motion_db::read_skeleton(*snapshot, motion_of(recording_in(*snapshot, name)));
}

AnnotationDocument Database::document(std::string_view name) const {
  const std::unique_ptr<kv::ReadTransaction> snapshot = store_->read();
  const RecordingInfo info = recording_in(*snapshot, name);
  if (info.document == 0) {
    throw Error(ErrorCode::not_found,
                fmt::format("recording '{}' has no annotation; import its annotation file too", info.name));
  }
  const std::string source = semantic_db::read_document(*snapshot, info.document, info.name);
  return eaf::read_text(info.annotation_file.empty() ? info.name : info.annotation_file, source).document;
}

kv::EngineInfo Database::engine() const {
  return store_->info();
}

AccessMode Database::access_mode() const {
  return catalogue::read_head(*store_->read()).access_mode;
}

}  // namespace signweave
