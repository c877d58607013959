#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "app/cli/command.h"
#include "signweave/core/error.h"

namespace signweave::cli {

/// What is in a database: its recordings, and what takes how much space.
void info_of_database(const std::string& folder, Io& io);
/// All that is known of one of its recordings.
void info_of_recording(const std::string& folder, const std::string& name, Io& io);

/// What several kinds of `info` print.
nlohmann::json json_of(const std::vector<Notice>& notices);
/// A row for each field that is neither list nor object.
void print_pairs(Io& io, const nlohmann::ordered_json& fields);

}  // namespace signweave::cli
