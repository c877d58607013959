#include "signweave/choose/notices.h"

#include <fmt/format.h>

#include <cmath>

#include "signweave/core/text.h"

namespace signweave {

Notice notice_left_out(const std::string& recording, const Sign& sign) {
  return {recording, fmt::format("'{}' at {} ms has no stroke and stands at a cut: it is left out",
                                 printable(sign.gloss), sign.span.begin.count())};
}

std::optional<Notice> notice_without_captured(std::string_view method, std::size_t captured) {
  if (captured > 0) return std::nullopt;
  return Notice{"", fmt::format("no annotated transition of this skeleton in this database: '{}' goes by none, "
                                "and makes the likeliest way",
                                method)};
}

std::optional<Notice> notice_without_durations(const DurationFit& durations) {
  if (durations.count > 0) return std::nullopt;
  return Notice{"",
                fmt::format("no transition in this database to measure: {} ms taken",
                            std::llround(1000.0 * durations.mean.count())),
                {{"duration", ""}}};
}

void add_declarations(const RecordingInfo& recording, DeclarationSet& declarations) {
  for (const auto& [name, value] : recording.declarations) {
    if (name != "signweave:synthesis") declarations.emplace(name, value);
  }
}

}  // namespace signweave
