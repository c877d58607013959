#include "signweave/database/import_options.h"

#include <fmt/format.h>

#include <algorithm>

#include "signweave/core/atomic_file.h"
#include "signweave/core/text.h"

namespace signweave {

std::map<std::string, PhaseKind> read_phase_labels(const std::filesystem::path& path) {
  constexpr PhaseKind kKinds[] = {PhaseKind::preparation, PhaseKind::stroke, PhaseKind::retraction, PhaseKind::hold};
  std::map<std::string, PhaseKind> labels;
  const std::string text = read_file(path, std::size_t{1} << 20);
  std::size_t line_number = 0;
  for (std::size_t begin = 0; begin < text.size();) {
    const std::size_t end = std::min(text.find('\n', begin), text.size());
    const std::string_view line = trimmed(std::string_view(text).substr(begin, end - begin));
    begin = end + 1;
    ++line_number;
    if (line.empty() || line.front() == '#') continue;
    const std::size_t sign = line.rfind('=');
    const std::string_view kind = sign == line.npos ? std::string_view() : trimmed(line.substr(sign + 1));
    const auto* known = std::find_if(std::begin(kKinds), std::end(kKinds),
                                     [&](PhaseKind candidate) { return name_of(candidate) == kind; });
    if (known == std::end(kKinds)) {
      throw Error(ErrorCode::bad_input, fmt::format("{}:{}: expected LABEL = preparation, stroke, retraction or hold",
                                                    path.string(), line_number));
    }
    labels[fold_case(match_form(line.substr(0, sign)))] = *known;
  }
  return labels;
}

}  // namespace signweave
