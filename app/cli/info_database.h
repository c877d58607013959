#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "app/cli/command.h"

namespace signweave::cli {

/// The contents of a database: its recordings, and the space used by each kind of data.
void info_of_database(const std::string& folder, Io& io);
/// The states of a backup.
void info_of_backup(const std::string& folder, Io& io);
/// Everything known about one of its recordings.
void info_of_recording(const std::string& folder, const std::string& name, Io& io);

/// A row for each field that is neither a list nor an object.
void print_pairs(Io& io, const nlohmann::ordered_json& fields);

}  // namespace signweave::cli
