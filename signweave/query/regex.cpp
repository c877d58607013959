#include "signweave/query/regex.h"

#include <cstdint>

#include "signweave/core/text.h"

namespace signweave {

std::unique_ptr<RE2> compile(const Regex& regex) {
  RE2::Options options;
  options.set_log_errors(false);
  options.set_max_mem(std::int64_t{1} << 20);  // a pattern that needs more is slow to compile, too
  options.set_case_sensitive(!regex.ignore_case);
  // match_form() also trims, which would change the meaning of the pattern.
  const std::string_view inner = trimmed(regex.pattern);
  const std::size_t before = inner.empty() ? 0 : static_cast<std::size_t>(inner.data() - regex.pattern.data());
  const std::string pattern =
      inner.empty() ? regex.pattern
                    : regex.pattern.substr(0, before) + match_form(inner) + regex.pattern.substr(before + inner.size());
  return std::make_unique<RE2>(pattern, options);
}

}  // namespace signweave
