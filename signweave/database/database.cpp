#include "signweave/database/database.h"

#include <fmt/format.h>

#include <algorithm>

#include "signweave/core/text.h"
#include "signweave/database/catalogue.h"
#include "signweave/database/tables.h"
#include "signweave/database/writer_lock.h"
#include "signweave/formats/annotation_file.h"
#include "signweave/semantic_db/semantic_db.h"

namespace signweave {

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

namespace {

/// Opens the store. If another process has it open, adds its announced name to the error, which the engine lacks.
std::unique_ptr<kv::KvStore> open_store(const std::filesystem::path& folder, kv::Access access) {
  try {
    return kv::open(folder, access);
  } catch (const Error& error) {
    const std::string who = error.code() == ErrorCode::conflict ? writer_of(folder) : "";
    if (who.empty()) throw;
    throw Error(ErrorCode::conflict, fmt::format("{} (it is {})", error.what(), who));
  }
}

}  // namespace

Database::Database(const std::filesystem::path& folder, kv::Access access) : folder_(folder), access_(access) {
  // The store first: without a database this throws before a lock file is created.
  store_ = open_store(folder, access);
  catalogue::read_head(*store_->read());
  if (access == kv::Access::read_write) {
    lock_ = std::make_unique<WriterLock>(folder);
    kv::drop_unfinished(folder);
    sweep();
  }
}

Database::~Database() = default;

void Database::announce(std::string_view who) noexcept {
  if (lock_) lock_->announce(who);
}

std::shared_ptr<const Contents> Database::contents() const {
  return contents_of(store_->read());
}

Snapshot Database::snapshot() const {
  Snapshot made;
  made.database_ = this;
  made.transaction_ = store_->read();
  made.contents_ = contents_of(made.transaction_);
  return made;
}

std::shared_ptr<const Contents> Database::contents_of(
    const std::shared_ptr<const kv::ReadTransaction>& transaction) const {
  const kv::ReadTransaction& snapshot = *transaction;
  const catalogue::Head head = catalogue::read_head(snapshot);
  const std::shared_ptr<const Segments> segments = stored_segments(transaction);
  const std::lock_guard guard(mutex_);
  if (contents_ && contents_at_ == head.changes) return contents_;

  auto made = std::make_shared<Contents>();
  made->recordings.reserve(head.recordings);
  // A damaged record excludes its own recording only.
  for (std::uint32_t slot = 0; slot < head.recordings; ++slot) {
    try {
      made->recordings.push_back(catalogue::read_recording(snapshot, slot));
    } catch (const Error& error) {
      made->faults.emplace_back(error.what());
    }
  }
  std::sort(made->recordings.begin(), made->recordings.end(),
            [](const RecordingInfo& a, const RecordingInfo& b) { return a.name < b.name; });
  const auto same = [](const RecordingInfo& info, const std::string& name) { return info.name == name; };
  if (std::ranges::equal(made->recordings, segments->recordings(), same)) {
    made->segments = *segments;
  } else {  // the tables still contain a recording whose entry is damaged, or are damaged themselves
    made->faults.clear();
    made->segments = Segments(tables::table_of_all(snapshot, made->faults));
  }

  std::vector<AnnotatedTransition> transitions;
  for (std::uint32_t recording = 0; recording < made->recordings.size(); ++recording) {
    const std::vector<AnnotatedTransition> found = transitions_in(signs_of(made->segments, recording));
    transitions.insert(transitions.end(), found.begin(), found.end());
  }
  made->transitions = summarize(transitions);
  if (contents_ && contents_at_ > head.changes) return made;  // keep the newer state that another thread has cached
  contents_ = made;
  contents_at_ = head.changes;
  kept_ = {};
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

std::optional<std::uint32_t> Database::slot_of(const kv::ReadTransaction& snapshot, std::string_view name) const {
  const catalogue::Head head = catalogue::read_head(snapshot);
  const std::lock_guard guard(mutex_);
  if (slots_at_ != head.changes) {
    slots_.clear();
    for (std::uint32_t slot = 0; slot < head.recordings; ++slot) {
      try {
        slots_.push_back(catalogue::read_recording(snapshot, slot).name);
      } catch (const Error&) {
        slots_.emplace_back();  // damaged: no name is empty, so no search finds it; `check` reports it
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

namespace {

const motion_db::StoredMotion& motion_of(const RecordingInfo& info) {
  if (info.motion) return *info.motion;
  throw Error(ErrorCode::not_found, fmt::format("recording '{}' has no motion; import its motion file too", info.name));
}

}  // namespace

RecordingInfo Database::recording_in(const kv::ReadTransaction& snapshot, std::string_view name) const {
  const std::optional<std::uint32_t> slot = slot_of(snapshot, name);
  if (slot) return catalogue::read_recording(snapshot, *slot);
  contents()->at(name);  // throws the error with near matches
  throw Error(ErrorCode::conflict, fmt::format("{}: was added just now; try again", printable(name)));
}

// Each of the following reads the catalogue and the data it refers to in one snapshot, so changes that another process
// makes meanwhile are not visible.

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
  return annotation_file::read_text(info.annotation_file.empty() ? info.name : info.annotation_file, source,
                                    semantic_db::read_specification(*snapshot, info.document, info.name))
      .document;
}

kv::EngineInfo Database::engine() const {
  return store_->info();
}

std::vector<Usage> Database::usage() const {
  std::vector<Usage> list;
  store_->visit([&](ByteSpan key, std::size_t value_size) {
    std::string_view kind = motion_db::kind_of(key);
    if (kind.empty()) kind = semantic_db::kind_of(key);
    if (kind.empty()) kind = catalogue::is_key(key) ? "catalogue" : "other";
    auto at = std::ranges::find(list, kind, &Usage::kind);
    if (at == list.end()) at = list.insert(list.end(), Usage{.kind = std::string(kind)});
    ++at->entries;
    at->bytes += key.size() + value_size;
  });
  std::ranges::sort(list, std::greater{}, &Usage::bytes);
  return list;
}

int Database::layout() const {
  return catalogue::read_head(*store_->read()).layout;
}

float Database::tolerance() const {
  return catalogue::read_head(*store_->read()).tolerance;
}

AccessMode Database::access_mode() const {
  return catalogue::read_head(*store_->read()).access_mode;
}

}  // namespace signweave
