#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "signweave/database/database.h"

/// Copies of a database in a folder of plain files, and the database made of them again (docs/store.md, *Backups*).
///
///     backup(database, "/archive/corpus.backup");
///     restore("/archive/corpus.backup", "corpus.db");
///
/// A backup holds states. Each is the whole database as it was at one moment; what several states have in common lies
/// in the folder once. A motion is a file, an annotation document with what was measured beside it another, so a state
/// costs what changed since the one before. Files are never changed: they appear whole, or go.
namespace signweave {

using BackupProgress = std::function<void(double fraction)>;

struct BackupOptions {
  std::optional<std::size_t> keep;  ///< only so many states stay, the newest; at least 1; none: all
};

struct BackupReport {
  std::uint64_t state = 0;  ///< the number of the state that holds the database as it is
  bool changed = true;      ///< false: that state was there
  std::uint64_t recordings = 0;
  std::uint64_t bytes = 0;          ///< of all files of the state
  std::uint64_t bytes_written = 0;  ///< of those that were not there
  std::uint64_t states_dropped = 0;
  std::vector<std::string> faults;  ///< a line for each damaged recording, which is left out
};

/// Adds a state of the database, as it is now, to the backup in `folder`, which is made where it is missing. Whoever
/// writes to the database meanwhile is not waited for, and not seen. A record whose checksum does not fit is not
/// copied: its recording is left out, and older states keep what they hold of it. When it fails, `progress` throws or
/// the process is killed, the states are those that were there.
/// Throws Error{bad_input} for a folder that holds something else, Error{conflict} where another process writes to it,
/// Error{io}, Error{corrupt} where the catalogue's head is damaged.
BackupReport backup(const Database& database, const std::filesystem::path& folder, const BackupOptions& options = {},
                    const BackupProgress& progress = {});

/// True for a folder that `backup` made.
bool is_backup(const std::filesystem::path& folder);

struct BackupState {
  std::uint64_t number = 0;
  std::string made;      ///< UTC, ISO 8601
  std::string database;  ///< the name of the database's folder
  std::uint64_t recordings = 0;
  std::uint64_t bytes = 0;
  std::string fault;  ///< why it cannot be read; then there is nothing else but the number
};

/// The states, the oldest first. Throws Error{not_found} where there is no backup.
std::vector<BackupState> backup_states(const std::filesystem::path& folder);

/// Reads every byte of every state: one line for each fault.
std::vector<std::string> check_backup(const std::filesystem::path& folder, const BackupProgress& progress = {});

struct RestoreOptions {
  std::optional<std::uint64_t> state;  ///< none: the newest
  std::string engine;                  ///< empty: as it was
  bool skip_damaged = false;           ///< leaves out the recordings whose files are damaged, instead of refusing
};

struct RestoreReport {
  std::uint64_t state = 0;
  std::string made;
  std::uint64_t recordings = 0;
  std::uint64_t bytes = 0;
  std::vector<std::string> left_out;  ///< a line for each recording that was, now or when the state was made
};

/// Makes a database of a state of a backup, every file of it checked first. `database` must not exist, or be an empty
/// folder; it appears whole or not at all. Throws Error{not_found} for a backup or state that is not there,
/// Error{already_exists}, Error{corrupt} where files are damaged or missing, Error{unsupported} (engine), Error{io}.
RestoreReport restore(const std::filesystem::path& folder, const std::filesystem::path& database,
                      const RestoreOptions& options = {}, const BackupProgress& progress = {});

}  // namespace signweave
