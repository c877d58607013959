#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "signweave/database/database.h"

/// Copies a database to a folder of plain files, and restores it from them (docs/store.md, *Backups*).
///
///     backup(database, "/archive/corpus.backup");
///     restore("/archive/corpus.backup", "corpus.db");
///
/// A backup contains states. Each is the whole database as of one moment; what several states have in common is stored
/// only once. A motion is one file; an annotation document, with the measurements that belong to it, is another. So a
/// state costs only what changed since the previous one. Files are never modified: they are created atomically or
/// removed.
namespace signweave {

using BackupProgress = std::function<void(double fraction)>;

struct BackupOptions {
  std::optional<std::size_t> keep;  ///< keeps only this many of the newest states, at least 1; empty: keeps all
};

struct BackupReport {
  std::uint64_t state = 0;  ///< the number of the state with the database's current content
  bool changed = true;      ///< false: that state already existed
  std::uint64_t recordings = 0;
  std::uint64_t bytes = 0;          ///< size of all files of the state
  std::uint64_t bytes_written = 0;  ///< size of its new files
  std::uint64_t states_dropped = 0;
  std::vector<std::string> faults;  ///< one line per damaged recording, which is left out
};

/// Adds a state of the database, as it is now, to the backup in `folder`, which is created if missing. Does not wait
/// for concurrent writers and does not see their changes. A record whose checksum does not match is not copied. Unless
/// it can be measured again, its recording is left out, and older states keep their copy of it. If the backup fails,
/// `progress` throws or the process is killed, the earlier states remain unchanged. Throws Error{bad_input} for a
/// folder with other content, Error{conflict} if another process writes to it, Error{io}, Error{corrupt} if the
/// catalogue's head is damaged.
BackupReport backup(const Database& database, const std::filesystem::path& folder, const BackupOptions& options = {},
                    const BackupProgress& progress = {});

/// True if `backup` created the folder.
bool is_backup(const std::filesystem::path& folder);

struct BackupState {
  std::uint64_t number = 0;
  std::string made;      ///< UTC, ISO 8601
  std::string database;  ///< the name of the database's folder
  std::uint64_t recordings = 0;
  std::uint64_t bytes = 0;
  std::string fault;  ///< why it cannot be read; then only the number is set
};

/// The states, oldest first. Throws Error{not_found} if there is no backup.
std::vector<BackupState> backup_states(const std::filesystem::path& folder);

/// Reads every byte of every state. Returns one line per fault.
std::vector<std::string> check_backup(const std::filesystem::path& folder, const BackupProgress& progress = {});

struct RestoreOptions {
  std::optional<std::uint64_t> state;  ///< empty: the newest
  std::string engine;                  ///< empty: the original engine
  bool skip_damaged = false;           ///< leaves out recordings whose files are damaged, instead of failing
};

struct RestoreReport {
  std::uint64_t state = 0;
  std::string made;
  std::uint64_t recordings = 0;
  std::uint64_t bytes = 0;
  std::vector<std::string> left_out;  ///< one line per recording left out, now or when the state was made
};

/// Restores a database from a state of a backup, after checking all its files. `database` must not exist or be an empty
/// folder; it is created atomically. Throws Error{not_found} for a missing backup or state, Error{already_exists},
/// Error{corrupt} if files are damaged or missing, Error{unsupported} (engine), Error{io}.
RestoreReport restore(const std::filesystem::path& folder, const std::filesystem::path& database,
                      const RestoreOptions& options = {}, const BackupProgress& progress = {});

}  // namespace signweave
