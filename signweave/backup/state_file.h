#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "signweave/backup/part_file.h"

/// The text file that describes a state of a backup: its parts with their checksums. Internal to `backup`.
namespace signweave::backup_files {

struct State {
  std::uint64_t number = 0;
  std::string made;      ///< "2026-11-26T14:45:36Z"
  std::string database;  ///< the name of the database's folder, without the path
  std::string engine;
  std::uint64_t recordings = 0;
  std::map<std::string, Stamp> parts;  ///< by file name
  std::string catalogue;               ///< the file name of the part with the catalogue
  std::vector<std::string> left_out;   ///< one line per damaged recording, which the state lacks
  friend bool operator==(const State&, const State&) = default;
};

std::filesystem::path parts_folder(const std::filesystem::path& backup);
std::filesystem::path states_folder(const std::filesystem::path& backup);

std::string text_of_state(const State& state);
/// Throws Error{corrupt} if the text is not exactly what `text_of_state` writes; `where` names the file.
State state_of_text(std::string_view text, const std::string& where);

/// The numbers of all existing states, ascending, including damaged ones.
std::vector<std::uint64_t> state_numbers(const std::filesystem::path& backup);
std::filesystem::path state_path(const std::filesystem::path& backup, std::uint64_t number);
State read_state(const std::filesystem::path& backup, std::uint64_t number);

}  // namespace signweave::backup_files
