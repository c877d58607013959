#include "signweave/evaluation/collection_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <utility>

#include "signweave/core/text.h"
#include "signweave/evaluation/recording_rows.h"

namespace signweave {
namespace {

bool is_left_out(const std::string& name, std::span<const EvaluatedMotion> recordings,
                 std::span<const std::string> left_out) {
  const auto names = [&](const std::string& whole) { return names_recording(name, whole); };
  return std::ranges::any_of(left_out, names) && std::ranges::none_of(recordings, names, &EvaluatedMotion::name);
}

}  // namespace

void read_collections(TextReader& table, std::span<EvaluatedMotion> recordings, std::span<const std::string> left_out) {
  std::map<std::size_t, std::size_t> line_of;  // [recording]
  bool heading = true;
  bool any = false;
  while (!table.peek().empty()) {
    const std::vector<std::string> fields = csv_fields(table);
    if (fields.size() == 1 && fields[0].empty()) continue;
    if (std::exchange(heading, false) && fold_case(fields[0]) == "recording") continue;
    if (fields.size() < 2 || fields.size() > 3) {
      table.fail(fmt::format("{} column{}; a row has recording, collection, and may have the signer", fields.size(),
                             fields.size() == 1 ? "" : "s"));
    }
    if (fields[0].empty()) table.fail("no recording is named; the first column names one");
    any = true;
    if (is_left_out(fields[0], recordings, left_out)) continue;
    const std::size_t index = recording_named(fields[0], recordings, table);
    const auto [known, is_new] = line_of.try_emplace(index, table.line());
    if (!is_new) {
      table.fail(
          fmt::format("'{}' has a row already, in line {}; remove one of them", printable(fields[0]), known->second));
    }
    EvaluatedMotion& recording = recordings[index];
    if (!fields[1].empty()) recording.collection = fields[1];
    if (fields.size() == 3 && !fields[2].empty()) recording.performer = fields[2];
  }
  if (!any) {
    throw Error(
        ErrorCode::bad_input,
        fmt::format("{}: no row in it; a row has recording, collection, and may have the signer", table.name()));
  }
}

}  // namespace signweave
