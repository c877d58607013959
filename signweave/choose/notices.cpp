#include "signweave/choose/notices.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "signweave/core/text.h"

namespace signweave {

Notice notice_left_out(const std::string& recording, const Sign& sign) {
  return {recording, fmt::format("'{}' at {} ms has no stroke and is at a cut, so it is left out",
                                 printable(sign.gloss), sign.span.begin.count())};
}

std::optional<Notice> notice_without_captured(std::string_view method, std::size_t captured) {
  if (captured > 0) return std::nullopt;
  return Notice{"", fmt::format("'{}' found no annotated transitions of this skeleton in this database; "
                                "falling back to kriging",
                                method)};
}

std::optional<Notice> notice_without_durations(const DurationFit& durations) {
  if (durations.count > 0) return std::nullopt;
  return Notice{"",
                fmt::format("no measurable transitions in this database; using {} ms",
                            std::llround(1000.0 * durations.mean.count())),
                {{"duration", ""}}};
}

void add_declarations(const RecordingInfo& recording, Declarations& declarations) {
  for (const auto& one : recording.declarations) {
    if (one.first == "signweave:synthesis") continue;
    const auto at = std::ranges::lower_bound(declarations, one);
    if (at == declarations.end() || *at != one) declarations.insert(at, one);
  }
}

}  // namespace signweave
