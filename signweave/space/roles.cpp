#include "signweave/space/roles.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <vector>

#include "signweave/core/error.h"
#include "signweave/core/text.h"
#include "signweave/core/text_reader.h"

namespace signweave {
namespace {

constexpr std::size_t kMostLines = 1'000'000;
constexpr std::array kRoles = {SpaceRole::none, SpaceRole::forward, SpaceRole::backward, SpaceRole::aim,
                               SpaceRole::both};

/// The columns of a table, for its errors.
struct Columns {
  std::string_view header;   ///< in lower case
  std::string_view example;  ///< "GLOSS,ROLE, such as INVITER,backward"
};

struct Pair {
  std::string first;
  std::string second;
};

/// Splits a line at its comma, behind a field in quotes if there is one. None if it is something else.
std::optional<Pair> split(std::string_view line) {
  Pair pair;
  std::size_t at = 0;
  if (line.starts_with('"')) {
    for (at = 1;; ++at) {
      if (at >= line.size()) return std::nullopt;
      if (line[at] == '"' && (++at >= line.size() || line[at] != '"')) break;
      pair.first += line[at];
    }
  } else {
    at = std::min(line.find(','), line.size());
    pair.first = trimmed(line.substr(0, at));
    if (pair.first.find('"') != std::string::npos) return std::nullopt;
  }
  if (at >= line.size() || line[at] != ',') return std::nullopt;
  std::string_view second = trimmed(line.substr(at + 1));
  if (second.size() > 1 && second.front() == '"' && second.back() == '"') {  // a locus may be a point
    second = second.substr(1, second.size() - 2);
  } else if (second.find(',') != second.npos) {
    return std::nullopt;
  }
  pair.second = second;
  return pair;
}

/// Calls `take` with each row of a table of two columns, whose first is in match form.
template <class Take>
void read_pairs(TextReader& reader, const Columns& columns, Take&& take) {
  bool first = true;
  std::size_t lines = 0;
  while (!reader.peek().empty()) {
    if (++lines > kMostLines) reader.fail(fmt::format("more than {} lines; split the file", kMostLines));
    const std::string line(reader.rest_of_line());
    const bool header = first && fold_case(line) == columns.header;
    if (line.starts_with('#') || header) {
      first = first && !header;
      continue;
    }
    first = false;
    if (!is_utf8(line)) reader.fail("the line is not UTF-8; save the file as UTF-8");
    std::optional<Pair> pair = split(line);
    if (!pair) reader.fail(fmt::format("expected {}; found '{}'", columns.example, printable(line)));
    pair->first = match_form(pair->first);
    if (pair->first.empty() || pair->first.size() > kLongestRoleGloss) {
      reader.fail(
          fmt::format("the first field has {} bytes; give one of 1 to {}", pair->first.size(), kLongestRoleGloss));
    }
    take(*pair);
  }
}

/// The lines in which keys were given, for the errors of those that are given again.
class LinesOfKeys {
 public:
  void add(TextReader& reader, const std::string& key) {
    const auto [at, added] = lines_.try_emplace(key, reader.line());
    if (!added) reader.fail(fmt::format("'{}' is in line {} already; keep one of them", printable(key), at->second));
    if (lines_.size() > kMostSpaceRoles) reader.fail(fmt::format("more than {} rows; remove some", kMostSpaceRoles));
  }

 private:
  std::map<std::string, std::size_t> lines_;
};

SpaceRole role_of_word(TextReader& reader, std::string_view word) {
  const std::string folded = fold_case(word);
  for (const SpaceRole role : kRoles) {
    if (folded == name_of(role)) return role;
  }
  std::vector<std::string> known;
  for (const SpaceRole role : kRoles) known.emplace_back(name_of(role));
  const std::string hint = did_you_mean(folded, known);
  reader.fail(fmt::format("no role '{}'{}", printable(word), hint.empty() ? "; give " + either_of(known) : hint));
}

SpaceRoles read_roles(TextReader& reader) {
  SpaceRoles roles;
  LinesOfKeys lines;
  read_pairs(reader, {"gloss,role", "GLOSS,ROLE, such as INVITER,backward"}, [&](const Pair& pair) {
    lines.add(reader, pair.first);
    roles.emplace(pair.first, role_of_word(reader, pair.second));
  });
  return roles;
}

LocusWords read_words(TextReader& reader) {
  LocusWords words = usual_locus_words();
  LinesOfKeys lines;
  read_pairs(reader, {"word,locus", "WORD,LOCUS, such as 3a,left"}, [&](const Pair& pair) {
    const std::string word = fold_case(pair.first);
    lines.add(reader, word);
    try {
      const std::string_view locus = pair.second;
      words.insert_or_assign(word, read_locus(locus.substr(locus.starts_with('@') ? 1 : 0)));
    } catch (const Error& error) {
      reader.fail(error.what());
    }
  });
  return words;
}

}  // namespace

std::string_view name_of(SpaceRole role) noexcept {
  constexpr std::array<std::string_view, kRoles.size()> kNames = {"none", "forward", "backward", "aim", "both"};
  return kNames[static_cast<std::size_t>(role)];
}

std::optional<SpaceRole> role_of(const SpaceRoles& roles, std::string_view gloss) {
  const auto at = roles.find(match_form(gloss));
  return at == roles.end() ? std::nullopt : std::optional(at->second);
}

SpaceRoles read_space_roles(const std::filesystem::path& path) {
  TextReader reader(path);
  return read_roles(reader);
}

SpaceRoles read_space_roles_text(const std::string& file, std::string_view text) {
  TextReader reader(file, text);
  return read_roles(reader);
}

LocusWords usual_locus_words() {
  LocusWords words;
  const auto add = [&](std::string_view word, std::string_view locus) {
    words.emplace(word, LocusRef{.kind = LocusRef::Kind::name, .name = std::string(locus), .numbers = {}});
  };
  add("1", "self");
  add("2", "addressee");
  add("3a", "left");
  add("3b", "right");
  for (const std::string_view same : {"i", "j", "k"}) add(same, same);
  for (const std::string_view same : built_in_loci()) add(same, same);
  return words;
}

LocusWords read_locus_words(const std::filesystem::path& path) {
  TextReader reader(path);
  return read_words(reader);
}

LocusWords read_locus_words_text(const std::string& file, std::string_view text) {
  TextReader reader(file, text);
  return read_words(reader);
}

}  // namespace signweave
