#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "signweave/backup/part_file.h"

/// The text file that says what a state of a backup is: its parts with their checksums. Internal to `backup`.
namespace signweave::backup_files {

struct State {
  std::uint64_t number = 0;
  std::string made;      ///< "2026-11-26T14:45:36Z"
  std::string database;  ///< the name of its folder, without the path
  std::string engine;
  std::uint64_t recordings = 0;
  std::map<std::string, Stamp> parts;  ///< by file name
  std::string catalogue;               ///< which of them is the catalogue
  std::vector<std::string> left_out;   ///< a line for each damaged recording that is not in it
  friend bool operator==(const State&, const State&) = default;
};

std::filesystem::path parts_folder(const std::filesystem::path& backup);
std::filesystem::path states_folder(const std::filesystem::path& backup);

std::string text_of_state(const State& state);
/// Throws Error{corrupt} where the text is not what `text_of_state` gives, to the last byte; `where` names the file.
State state_of_text(std::string_view text, const std::string& where);

/// The numbers of the states that are there, ascending, damaged ones too.
std::vector<std::uint64_t> state_numbers(const std::filesystem::path& backup);
std::filesystem::path state_path(const std::filesystem::path& backup, std::uint64_t number);
State read_state(const std::filesystem::path& backup, std::uint64_t number);

}  // namespace signweave::backup_files
