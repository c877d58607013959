#include "app/cli/validators.h"

#include <fmt/format.h>

#include <algorithm>

#include "signweave/core/text.h"

namespace signweave::cli {

CLI::Validator one_of(const std::vector<std::string>& names) {
  CLI::Validator validator = CLI::IsMember(names);
  validator.operation([names](std::string& text) {
    if (std::ranges::find(names, text) != names.end()) return std::string();
    const std::string meant = did_you_mean(text, names);
    return fmt::format("'{}' is none of {}{}", printable(text), fmt::join(names, ", "), meant);
  });
  return validator;
}

CLI::Validator within(const calls::Range& range) {
  return std::visit(
      [&](auto least) {
        using Number = decltype(least);
        const auto most = std::get<Number>(range.most);
        CLI::Validator validator = CLI::Range(least, most);
        validator.operation([least, most](std::string& text) {
          Number value{};
          const char* const what = std::is_floating_point_v<Number> ? "number" : "whole number";
          if (!CLI::detail::lexical_cast(text, value)) {
            return fmt::format("'{}' is no {}; give one from {} to {}", printable(text), what, least, most);
          }
          if (value >= least && value <= most) return std::string();
          return fmt::format("{} is out of range; give a {} from {} to {}", printable(text), what, least, most);
        });
        return validator;
      },
      range.least);
}

}  // namespace signweave::cli
