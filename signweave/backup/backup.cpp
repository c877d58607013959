#include "signweave/backup/backup.h"

#include <fcntl.h>
#include <fmt/chrono.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <cstring>
#include <set>

#include "signweave/backup/part_file.h"
#include "signweave/backup/state_file.h"
#include "signweave/database/catalogue.h"
#include "signweave/semantic_db/semantic_db.h"

namespace signweave {

namespace fs = std::filesystem;
using backup_files::Stamp;
using backup_files::State;

namespace {

constexpr const char* kTitleFile = "signweave-backup";
constexpr std::string_view kTitle =
    "A backup of a signweave database. `signweave restore` makes the database again; `signweave check` reads every "
    "byte.\n";

/// A lock held while a process writes to a backup; the system releases it when the process ends, however it ends.
class BackupLock {
 public:
  explicit BackupLock(const fs::path& folder)
      : file_(::open((folder / "lock").c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666)) {
    if (file_ < 0) {
      throw Error(ErrorCode::io, fmt::format("{}: cannot be written: {}", folder.string(), std::strerror(errno)));
    }
    if (::flock(file_, LOCK_EX | LOCK_NB) != 0) {
      ::close(file_);
      throw Error(ErrorCode::conflict,
                  folder.string() + ": another process writes to this backup; try again when it has finished");
    }
  }
  ~BackupLock() { ::close(file_); }
  BackupLock(const BackupLock&) = delete;
  BackupLock& operator=(const BackupLock&) = delete;

 private:
  int file_ = -1;
};

/// Makes the entries of a folder survive a power failure.
void sync_folder(const fs::path& folder) {
  const int handle = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  const int code = handle < 0 ? -1 : ::fsync(handle);
  const int error = errno;
  if (handle >= 0) ::close(handle);
  if (code != 0)
    throw Error(ErrorCode::io, fmt::format("{}: cannot be written: {}", folder.string(), std::strerror(error)));
}

void make_folder(const fs::path& folder) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (error) throw Error(ErrorCode::io, fmt::format("{}: cannot be created: {}", folder.string(), error.message()));
}

/// Turns the folder into a backup, or checks that it is one, and that it is not inside the database.
void prepare(const fs::path& folder, const fs::path& database) {
  std::error_code error;
  const fs::path inside = fs::weakly_canonical(folder, error).lexically_relative(fs::weakly_canonical(database, error));
  if (!inside.empty() && *inside.begin() != "..") {
    throw Error(ErrorCode::bad_input,
                fmt::format("{}: is inside the database; name a folder outside of it, preferably on another disk",
                            folder.string()));
  }
  if (!is_backup(folder)) {
    if (fs::exists(folder, error) && (!fs::is_directory(folder, error) || !fs::is_empty(folder, error))) {
      throw Error(ErrorCode::bad_input,
                  fmt::format("{}: neither a backup nor an empty folder; name a new one", folder.string()));
    }
    make_folder(folder);
    AtomicFile title(folder / kTitleFile);
    title.write(kTitle);
    title.commit();
  }
  make_folder(backup_files::parts_folder(folder));
  make_folder(backup_files::states_folder(folder));
}

/// True if the record is intact: the checksum in front of it matches.
bool is_sound(ByteSpan record) {
  std::uint64_t sum = 0;
  if (record.size() < sizeof sum) return false;
  std::memcpy(&sum, record.data(), sizeof sum);
  return checksum(record.subspan(sizeof sum)) == sum;
}

/// True for records that can be measured again from motion and annotation; missing ones are recomputed.
bool is_measured(ByteSpan key) {
  const std::string_view kind = semantic_db::kind_of(key);
  return kind == "features" || kind == "traces" || kind == "weights";
}

using KeyList = std::function<void(const std::function<void(ByteSpan key)>&)>;

/// Builds one state.
class Writer {
 public:
  Writer(const fs::path& folder, const kv::ReadTransaction& snapshot) : folder_(folder), snapshot_(snapshot) {
    for (const std::uint64_t number : backup_files::state_numbers(folder)) {
      try {
        const State state = backup_files::read_state(folder, number);
        known_.insert(state.parts.begin(), state.parts.end());
      } catch (const Error&) {  // the parts that it named are written again
      }
    }
  }

  /// Returns the name of the part with the records under these keys, and writes the part if it does not exist. Its name
  /// contains a digest of its records' checksums, so different content has a different name. Throws Error{corrupt} if a
  /// record is missing or damaged.
  std::pair<std::string, Stamp> part(std::string_view kind, std::uint64_t number, const KeyList& for_each_key,
                                     const std::string& where) {
    RunningChecksum digest;
    Bytes buffer;
    const auto get = [&](ByteSpan key) {
      const std::optional<ByteSpan> value = snapshot_.get(key, buffer);
      if (!value || value->size() < sizeof(std::uint64_t)) refuse(where);
      return *value;
    };
    for_each_key([&](ByteSpan key) {
      const ByteSpan value = get(key);
      digest.add(key);
      digest.add(value.first(sizeof(std::uint64_t)));
    });
    const std::string name = fmt::format("{}-{}-{:016x}", kind, number, digest.value());
    const fs::path path = backup_files::parts_folder(folder_) / name;
    std::error_code error;
    if (const auto at = known_.find(name); at != known_.end() && fs::file_size(path, error) == at->second.bytes)
      return *at;
    backup_files::PartWriter file(path);
    for_each_key([&](ByteSpan key) {
      const ByteSpan value = get(key);
      if (is_sound(value)) {
        file.add(key, value);
      } else if (!is_measured(key)) {
        refuse(where);
      }
    });
    const Stamp stamp = file.commit();
    written_ += stamp.bytes;
    known_.insert_or_assign(name, stamp);
    return {name, stamp};
  }

  std::uint64_t written() const noexcept { return written_; }

 private:
  [[noreturn]] static void refuse(const std::string& where) {
    throw Error(ErrorCode::corrupt, where + ": a stored record is missing or damaged");
  }

  const fs::path& folder_;
  const kv::ReadTransaction& snapshot_;
  std::map<std::string, Stamp> known_;
  std::uint64_t written_ = 0;
};

/// Removes files that a killed process left unfinished, and parts that no state names.
void drop_unnamed(const fs::path& folder) {
  std::set<std::string> named;
  for (const std::uint64_t number : backup_files::state_numbers(folder)) {
    try {
      for (const auto& [name, stamp] : backup_files::read_state(folder, number).parts) named.insert(name);
    } catch (const Error&) {
      return;  // the parts of a damaged state are unknown and may still be needed
    }
  }
  std::vector<fs::path> unnamed;
  for (const fs::directory_entry& entry : fs::directory_iterator(backup_files::parts_folder(folder))) {
    if (!named.contains(entry.path().filename().string())) unnamed.push_back(entry.path());
  }
  std::error_code error;
  for (const fs::path& path : unnamed) fs::remove(path, error);
}

std::uint64_t sum_of_bytes(const State& state) {
  std::uint64_t sum = 0;
  for (const auto& [name, stamp] : state.parts) sum += stamp.bytes;
  return sum;
}

/// The newest readable state.
std::optional<State> newest_state(const fs::path& folder) {
  std::vector<std::uint64_t> numbers = backup_files::state_numbers(folder);
  for (; !numbers.empty(); numbers.pop_back()) {
    try {
      return backup_files::read_state(folder, numbers.back());
    } catch (const Error&) {
    }
  }
  return std::nullopt;
}

}  // namespace

bool is_backup(const fs::path& folder) {
  std::error_code error;
  return fs::is_regular_file(folder / kTitleFile, error);
}

BackupReport backup(const Database& database, const fs::path& folder, const BackupOptions& options,
                    const BackupProgress& progress) {
  prepare(folder, database.folder());
  const BackupLock lock(folder);
  const std::unique_ptr<kv::ReadTransaction> snapshot = database.records();
  const catalogue::Head head = catalogue::read_head(*snapshot);
  Writer writer(folder, *snapshot);
  State state;
  std::vector<std::uint32_t> sound;  // slots
  for (std::uint32_t slot = 0; slot < head.recordings; ++slot) {
    if (progress) progress(static_cast<double>(slot) / head.recordings);
    try {
      const RecordingInfo info = catalogue::read_recording(*snapshot, slot);
      std::map<std::string, Stamp> parts;
      if (info.motion) {
        parts.insert(writer.part(
            "motion", info.motion->generation, [&](const auto& see) { motion_db::for_each_key(*info.motion, see); },
            info.name + ": motion"));
      }
      if (info.document != 0) {
        parts.insert(writer.part(
            "annotation", info.document,
            [&](const auto& see) { semantic_db::for_each_key(*snapshot, info.document, info.name, see); },
            info.name + ": annotation"));
      }
      state.parts.merge(parts);
      sound.push_back(slot);
    } catch (const Error& error) {
      if (error.code() != ErrorCode::corrupt) throw;
      state.left_out.push_back(fmt::format("{}; it is left out, see signweave check", error.what()));
    }
  }
  const auto [catalogue, stamp] = writer.part(
      "catalogue", head.changes,
      [&](const auto& see) {
        see(catalogue::head_key());
        for (const std::uint32_t slot : sound) see(catalogue::slot_key(slot));
        if (snapshot->get(semantic_db::learned_key())) see(semantic_db::learned_key());
      },
      "catalogue");
  state.parts.emplace(catalogue, stamp);
  state.catalogue = catalogue;
  state.recordings = sound.size();
  state.engine = database.engine().name;
  state.database = fs::weakly_canonical(database.folder()).filename().string();

  BackupReport report{.recordings = sound.size(),
                      .bytes = sum_of_bytes(state),
                      .bytes_written = writer.written(),
                      .faults = state.left_out};
  const std::vector<std::uint64_t> numbers = backup_files::state_numbers(folder);
  std::optional<State> newest = newest_state(folder);
  sync_folder(backup_files::parts_folder(folder));
  if (newest && newest->number == numbers.back() && newest->parts == state.parts &&
      newest->left_out == state.left_out) {
    report.state = newest->number;
    report.changed = false;
  } else {
    state.number = numbers.empty() ? 1 : numbers.back() + 1;
    state.made = fmt::format("{:%Y-%m-%dT%H:%M:%SZ}",
                             fmt::gmtime(std::chrono::system_clock::to_time_t(std::chrono::system_clock::now())));
    AtomicFile file(backup_files::state_path(folder, state.number));
    file.write(backup_files::text_of_state(state));
    file.commit();
    sync_folder(backup_files::states_folder(folder));
    report.state = state.number;
  }
  if (options.keep) {
    std::vector<std::uint64_t> all = backup_files::state_numbers(folder);
    const std::size_t keep = std::max<std::size_t>(*options.keep, 1);
    for (std::size_t i = 0; i + keep < all.size(); ++i) {
      fs::remove(backup_files::state_path(folder, all[i]));
      ++report.states_dropped;
    }
    if (report.states_dropped > 0) sync_folder(backup_files::states_folder(folder));
  }
  drop_unnamed(folder);
  return report;
}

std::vector<BackupState> backup_states(const fs::path& folder) {
  if (!is_backup(folder)) {
    throw Error(ErrorCode::not_found, folder.string() + ": not a signweave backup (make one with 'signweave backup')");
  }
  std::vector<BackupState> states;
  for (const std::uint64_t number : backup_files::state_numbers(folder)) {
    BackupState& shown = states.emplace_back(BackupState{.number = number});
    try {
      const State state = backup_files::read_state(folder, number);
      shown.made = state.made;
      shown.database = state.database;
      shown.recordings = state.recordings;
      shown.bytes = sum_of_bytes(state);
    } catch (const Error& error) {
      shown.fault = error.what();
    }
  }
  return states;
}

std::vector<std::string> check_backup(const fs::path& folder, const BackupProgress& progress) {
  std::vector<std::string> faults;
  std::map<std::string, std::pair<Stamp, std::uint64_t>> parts;  // and the newest state that contains it
  const std::vector<BackupState> states = backup_states(folder);
  for (const BackupState& shown : states) {
    if (!shown.fault.empty()) {
      faults.push_back(shown.fault);
      continue;
    }
    const State state = backup_files::read_state(folder, shown.number);
    for (const auto& [name, stamp] : state.parts) parts[name] = {stamp, shown.number};
  }
  std::size_t done = 0;
  for (const auto& [name, known] : parts) {
    if (progress) progress(static_cast<double>(done++) / static_cast<double>(parts.size()));
    const fs::path path = backup_files::parts_folder(folder) / name;
    const std::string fault = backup_files::fault_of_part(path, known.first);
    if (fault.empty()) continue;
    faults.push_back(
        fmt::format("{}: {}; state {} needs it; take the file from a copy, or remove it and back the database up again",
                    path.string(), fault, known.second));
  }
  return faults;
}

}  // namespace signweave
