#include "signweave/backup/state_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <string_view>
#include <utility>

#include "signweave/core/text.h"

namespace signweave::backup_files {
namespace {

constexpr std::string_view kTitle = "signweave backup 1";

[[noreturn]] void refuse(const std::string& where, std::string_view what) {
  throw Error(ErrorCode::corrupt, fmt::format("{}: {}; restore an older state, or this file from a copy", where, what));
}

/// Removes the first word of a line and returns it.
std::string_view next_word(std::string_view& line) {
  const std::size_t end = std::min(line.find(' '), line.size());
  const std::string_view word = line.substr(0, end);
  line.remove_prefix(std::min(end + 1, line.size()));
  return word;
}

std::uint64_t number_of(std::string_view word, int base, const std::string& where) {
  std::uint64_t number = 0;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), number, base);
  if (error != std::errc{} || end != word.data() + word.size()) refuse(where, "a number is damaged");
  return number;
}

/// A name from a file must not lead out of the folder of parts.
bool is_part_name(std::string_view name) {
  return !name.empty() && name.size() < 200 &&
         std::ranges::all_of(name, [](char c) { return (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '-'; });
}

}  // namespace

std::filesystem::path parts_folder(const std::filesystem::path& backup) {
  return backup / "parts";
}

std::filesystem::path states_folder(const std::filesystem::path& backup) {
  return backup / "states";
}

std::string text_of_state(const State& state) {
  std::string text =
      fmt::format("{}\nstate {}\nmade {}\ndatabase {}\nengine {}\nrecordings {}\ncatalogue {}\n", kTitle, state.number,
                  state.made, printable(state.database), state.engine, state.recordings, state.catalogue);
  for (const auto& [name, stamp] : state.parts) {
    text += fmt::format("part {} {} {:016x}\n", name, stamp.bytes, stamp.checksum);
  }
  for (const std::string& line : state.left_out) text += fmt::format("left out {}\n", printable(line));
  text += fmt::format("checksum {:016x}\n", checksum(bytes_of(text)));
  return text;
}

State state_of_text(std::string_view text, const std::string& where) {
  const std::size_t sum_at = text.rfind("checksum ");
  if (sum_at == text.npos || !text.ends_with('\n')) refuse(where, "it ends too early");
  std::string_view sum = text.substr(sum_at);
  sum.remove_suffix(1);
  next_word(sum);
  if (number_of(sum, 16, where) != checksum(bytes_of(text.substr(0, sum_at)))) {
    refuse(where, "its checksum does not fit");
  }
  State state;
  std::string_view rest = text.substr(0, sum_at);
  bool first = true;
  while (!rest.empty()) {
    const std::size_t end = std::min(rest.find('\n'), rest.size());
    std::string_view line = rest.substr(0, end);
    rest.remove_prefix(std::min(end + 1, rest.size()));
    if (std::exchange(first, false)) {
      if (line == kTitle) continue;
      throw Error(ErrorCode::unsupported,
                  fmt::format("{}: not a backup state that this version of signweave can read", where));
    }
    const std::string_view what = next_word(line);
    if (what == "state") {
      state.number = number_of(line, 10, where);
    } else if (what == "made") {
      state.made = line;
    } else if (what == "database") {
      state.database = line;
    } else if (what == "engine") {
      state.engine = line;
    } else if (what == "recordings") {
      state.recordings = number_of(line, 10, where);
    } else if (what == "catalogue") {
      state.catalogue = line;
    } else if (what == "part") {
      const std::string_view name = next_word(line);
      if (!is_part_name(name)) refuse(where, "the name of a part is damaged");
      Stamp stamp;
      stamp.bytes = number_of(next_word(line), 10, where);
      stamp.checksum = number_of(line, 16, where);
      state.parts.emplace(name, stamp);
    } else if (what == "left") {
      next_word(line);
      state.left_out.emplace_back(line);
    } else {
      refuse(where, "a line that this version of signweave does not know");
    }
  }
  if (!state.parts.contains(state.catalogue)) refuse(where, "it names no catalogue");
  return state;
}

std::vector<std::uint64_t> state_numbers(const std::filesystem::path& backup) {
  std::vector<std::uint64_t> numbers;
  std::error_code error;
  for (const std::filesystem::directory_entry& entry :
       std::filesystem::directory_iterator(states_folder(backup), error)) {
    const std::string name = entry.path().filename().string();
    std::uint64_t number = 0;
    const auto [end, fault] = std::from_chars(name.data(), name.data() + name.size(), number);
    if (fault == std::errc{} && end == name.data() + name.size()) numbers.push_back(number);
  }
  std::ranges::sort(numbers);
  return numbers;
}

std::filesystem::path state_path(const std::filesystem::path& backup, std::uint64_t number) {
  return states_folder(backup) / fmt::format("{:06}", number);
}

State read_state(const std::filesystem::path& backup, std::uint64_t number) {
  const std::filesystem::path path = state_path(backup, number);
  return state_of_text(read_file(path), path.string());
}

}  // namespace signweave::backup_files
