#include <fcntl.h>
#include <fmt/format.h>
#include <signal.h>
#include <unistd.h>

#include <cerrno>
#include <charconv>
#include <set>

#include "signweave/backup/backup.h"
#include "signweave/backup/part_file.h"
#include "signweave/backup/state_file.h"
#include "signweave/database/catalogue.h"
#include "signweave/database/tables.h"

namespace signweave {

namespace fs = std::filesystem;
using backup_files::Stamp;
using backup_files::State;

namespace {

State chosen_state(const fs::path& folder, const std::optional<std::uint64_t>& wanted) {
  const std::vector<BackupState> states = backup_states(folder);  // throws if there is no backup
  if (wanted) {
    for (const BackupState& state : states) {
      if (state.number == *wanted) return backup_files::read_state(folder, *wanted);
    }
    std::string known;
    for (const BackupState& state : states) known += fmt::format("{}{}", known.empty() ? "" : ", ", state.number);
    throw Error(ErrorCode::not_found, fmt::format("{}: no state {}; there {} {}", folder.string(), *wanted,
                                                  states.size() == 1 ? "is" : "are", known.empty() ? "none" : known));
  }
  if (states.empty()) {
    throw Error(ErrorCode::not_found, folder.string() + ": contains no state; the backup did not finish, run it again");
  }
  return backup_files::read_state(folder, states.back().number);
}

/// The damaged or missing parts, each with what is wrong. Throws if nothing can be restored from the rest.
std::map<std::string, std::string> damaged_parts(const fs::path& folder, const State& state, bool skip,
                                                 const BackupProgress& progress) {
  std::map<std::string, std::string> damaged;
  std::uint64_t bytes = 0, done = 0;
  for (const auto& [name, stamp] : state.parts) bytes += stamp.bytes;
  for (const auto& [name, stamp] : state.parts) {
    if (progress) progress(static_cast<double>(done) / static_cast<double>(bytes));
    done += stamp.bytes;
    const std::string fault = backup_files::fault_of_part(backup_files::parts_folder(folder) / name, stamp);
    if (!fault.empty()) damaged.emplace(name, fault);
  }
  if (damaged.empty() || (skip && !damaged.contains(state.catalogue))) return damaged;
  const auto& [name, fault] = damaged.contains(state.catalogue) ? *damaged.find(state.catalogue) : *damaged.begin();
  throw Error(
      ErrorCode::corrupt,
      fmt::format("{}: {}{}; take it from a copy, or restore an older state{}",
                  (backup_files::parts_folder(folder) / name).string(), fault,
                  damaged.size() > 1 ? fmt::format(", and {} more", damaged.size() - 1) : "",
                  damaged.contains(state.catalogue) ? "" : ", or without its recording"),
      damaged.contains(state.catalogue) ? Remedies{{"state", ""}} : Remedies{{"state", ""}, {"skip_damaged", ""}});
}

/// Puts records in transactions of bounded size.
class BoundedPuts {
 public:
  explicit BoundedPuts(kv::KvStore& store) : store_(store) {}
  void put(ByteSpan key, ByteSpan value) {
    if (!transaction_) transaction_ = store_.write();
    transaction_->put(key, value);
    bytes_ += value.size();
    if (++puts_ >= kMostPuts || bytes_ >= kMostBytes) flush();
  }
  void flush() {
    if (transaction_) transaction_->commit();
    transaction_.reset();
    puts_ = bytes_ = 0;
  }

 private:
  static constexpr std::size_t kMostPuts = 512;
  static constexpr std::size_t kMostBytes = std::size_t{16} << 20;
  kv::KvStore& store_;
  std::unique_ptr<kv::WriteTransaction> transaction_;
  std::size_t puts_ = 0, bytes_ = 0;
};

/// The part of a motion or document in a state; null if there is none.
const std::string* part_of(const State& state, std::string_view kind, std::uint64_t generation) {
  const std::string begin = fmt::format("{}-{}-", kind, generation);
  const auto at = state.parts.lower_bound(begin);
  return at != state.parts.end() && at->first.starts_with(begin) ? &at->first : nullptr;
}

/// Writes the catalogue of the restored records in one transaction, so that it appears atomically.
void write_catalogue(kv::KvStore& store, const fs::path& part, const State& state,
                     const std::map<std::string, std::string>& damaged, RestoreReport& report) {
  const std::unique_ptr<kv::WriteTransaction> transaction = store.write();
  std::uint32_t recordings = 0;
  const Bytes first_slot = catalogue::slot_key(0);
  backup_files::read_part(part, [&](ByteSpan key, ByteSpan value) {
    const bool recording = key.size() == first_slot.size() && key[0] == first_slot[0];
    transaction->put(recording ? catalogue::slot_key(recordings++) : Bytes(key.begin(), key.end()), value);
  });
  for (std::uint32_t slot = 0; slot < recordings;) {
    const RecordingInfo info = catalogue::read_recording(*transaction, slot);
    std::string fault;
    const auto find_fault = [&](std::string_view kind, std::uint64_t generation) {
      const std::string* name = part_of(state, kind, generation);
      if (name == nullptr) {
        fault = fmt::format("the state has no {} of it", kind);
      } else if (const auto at = damaged.find(*name); at != damaged.end()) {
        fault = fmt::format("{}: {}", at->first, at->second);
      }
    };
    if (info.motion) find_fault("motion", info.motion->generation);
    if (info.document != 0 && fault.empty()) find_fault("annotation", info.document);
    if (fault.empty()) {
      ++slot;
      continue;
    }
    report.left_out.push_back(fmt::format("{}: left out: {}", info.name, fault));
    if (--recordings > slot) {
      catalogue::move_recording(*transaction, recordings, slot);
    } else {
      catalogue::erase_recording(*transaction, slot);
    }
  }
  catalogue::Head head = catalogue::read_head(*transaction);
  if (head.recordings != recordings) ++head.changes;
  head.recordings = recordings;
  catalogue::write_head(*transaction, head);
  tables::rebuild(*transaction);
  transaction->commit();
  report.recordings = recordings;
}

void fill(const fs::path& database, const fs::path& folder, const State& state,
          const std::map<std::string, std::string>& damaged, const BackupProgress& progress, RestoreReport& report) {
  const std::unique_ptr<kv::KvStore> store = kv::open(database, kv::Access::read_write);
  BoundedPuts puts(*store);
  std::uint64_t bytes = 0;
  for (const auto& [name, stamp] : state.parts) bytes += stamp.bytes;
  for (const auto& [name, stamp] : state.parts) {
    if (name == state.catalogue || damaged.contains(name)) continue;
    backup_files::read_part(backup_files::parts_folder(folder) / name,
                            [&](ByteSpan key, ByteSpan value) { puts.put(key, value); });
    report.bytes += stamp.bytes;
    if (progress) progress(static_cast<double>(report.bytes) / static_cast<double>(bytes));
  }
  puts.flush();
  write_catalogue(*store, backup_files::parts_folder(folder) / state.catalogue, state, damaged, report);
}

BackupProgress between(const BackupProgress& whole, double from, double to) {
  if (!whole) return {};
  return [&whole, from, to](double fraction) { whole(from + fraction * (to - from)); };
}

/// Removes what killed restores of this database left: "NAME.PID.part" of a process that no longer runs.
void drop_left(const fs::path& database) {
  std::error_code error;
  const std::string begin = database.filename().string() + ".";
  for (const fs::directory_entry& entry : fs::directory_iterator(fs::absolute(database).parent_path(), error)) {
    const std::string name = entry.path().filename().string();
    if (!name.starts_with(begin) || !name.ends_with(".part")) continue;
    pid_t process = 0;
    const char* const last = name.data() + name.size() - std::string_view(".part").size();
    const auto [end, fault] = std::from_chars(name.data() + begin.size(), last, process);
    if (fault != std::errc{} || end != last || process <= 0) continue;
    if (::kill(process, 0) != 0 && errno == ESRCH) fs::remove_all(entry.path(), error);
  }
}

/// A temporary folder that becomes the database when it is complete, and is removed on failure.
class Unfinished {
 public:
  explicit Unfinished(const fs::path& database) : database_(database), path_(database) {
    drop_left(database);
    path_ += fmt::format(".{}.part", ::getpid());
  }
  ~Unfinished() {
    std::error_code ignored;
    if (!path_.empty()) fs::remove_all(path_, ignored);
  }
  Unfinished(const Unfinished&) = delete;
  Unfinished& operator=(const Unfinished&) = delete;

  const fs::path& path() const noexcept { return path_; }
  void finish() {
    std::error_code error;
    fs::rename(path_, database_, error);  // also replaces an empty folder
    if (error) {
      throw Error(ErrorCode::io,
                  fmt::format("{}: cannot be moved into place: {}", database_.string(), error.message()));
    }
    path_.clear();
    const int parent = ::open(fs::absolute(database_).parent_path().c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    if (parent < 0) return;
    ::fsync(parent);
    ::close(parent);
  }

 private:
  fs::path database_;
  fs::path path_;
};

}  // namespace

RestoreReport restore(const fs::path& folder, const fs::path& database, const RestoreOptions& options,
                      const BackupProgress& progress) {
  fs::path target = database.lexically_normal();
  if (!target.has_filename()) target = target.parent_path();  // "corpus.db/"
  std::error_code error;
  if (fs::exists(target, error) && (!fs::is_directory(target, error) || !fs::is_empty(target, error))) {
    throw Error(ErrorCode::already_exists, target.string() + ": already exists; name a new database");
  }
  const State state = chosen_state(folder, options.state);
  const std::map<std::string, std::string> damaged =
      damaged_parts(folder, state, options.skip_damaged, between(progress, 0, 0.3));
  RestoreReport report{.state = state.number, .made = state.made, .left_out = state.left_out};
  Unfinished unfinished(target);
  kv::create(unfinished.path(), options.engine.empty() ? state.engine : options.engine);
  fill(unfinished.path(), folder, state, damaged, between(progress, 0.3, 1), report);
  unfinished.finish();
  return report;
}

}  // namespace signweave
