#include "signweave/evaluation/recording_rows.h"

#include <fmt/format.h>

#include <filesystem>

#include "signweave/core/text.h"

namespace signweave {
namespace {

std::string without_extension(const std::string& name) {
  return std::filesystem::path(name).extension() == ".bvh" ? name.substr(0, name.size() - 4) : name;
}

}  // namespace

std::vector<std::string> csv_fields(TextReader& reader) {
  std::vector<std::string> fields = {""};
  bool quoted = false;
  const std::string_view line = reader.rest_of_line();
  for (std::size_t i = 0; i < line.size(); ++i) {
    const char c = line[i];
    if (quoted && c == '"' && i + 1 < line.size() && line[i + 1] == '"') {
      fields.back() += c;
      ++i;
    } else if (c == '"' && (quoted || trimmed(fields.back()).empty())) {
      quoted = !quoted;
    } else if (c == ',' && !quoted) {
      fields.emplace_back();
    } else {
      fields.back() += c;
    }
  }
  if (quoted) reader.fail("a quote is opened and never closed; close it");
  for (std::string& field : fields) field = trimmed(field);
  return fields;
}

bool names_recording(const std::string& name, const std::string& whole) {
  return fmt::format("/{}", without_extension(whole)).ends_with(fmt::format("/{}", without_extension(name)));
}

std::size_t recording_named(const std::string& name, std::span<const EvaluatedMotion> recordings,
                            const TextReader& reader) {
  std::vector<std::size_t> found;
  std::vector<std::string> known;
  for (std::size_t i = 0; i < recordings.size(); ++i) {
    const std::string& whole = recordings[i].name;
    if (whole == name) return i;
    if (names_recording(name, whole)) found.push_back(i);
    known.push_back(std::filesystem::path(whole).filename().string());
  }
  if (found.size() == 1) return found[0];
  if (found.empty()) {
    reader.fail(fmt::format("no evaluated recording is named '{}'{}", printable(name), did_you_mean(name, known)));
  }
  reader.fail(fmt::format("'{}' is the name of {} recordings; give its folder too", printable(name), found.size()));
}

}  // namespace signweave
