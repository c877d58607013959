#include "app/cli/help_format.h"

#include <algorithm>
#include <sstream>

namespace signweave::cli {
namespace {

/// Characters, not bytes.
std::size_t length_of(const std::string& text) {
  return static_cast<std::size_t>(
      std::ranges::count_if(text, [](char c) { return (static_cast<unsigned char>(c) & 0xC0U) != 0x80; }));
}

}  // namespace

std::string wrapped(const std::string& text, std::size_t width) {
  std::istringstream lines(text);
  std::string result;
  for (std::string line; std::getline(lines, line);) {
    if (!result.empty()) result += '\n';
    const std::string indent(std::min(line.find_first_not_of(' '), line.size()), ' ');
    std::istringstream words(line);
    std::size_t filled = 0;
    bool first = true;
    for (std::string word; words >> word;) {
      if (filled > 0 && filled + 1 + length_of(word) > width) {
        result += '\n';
        filled = 0;
        first = false;
      }
      const std::string before = filled > 0 ? " " : first ? indent : indent + (indent.empty() ? "" : "  ");
      result += before + word;
      filled += before.size() + length_of(word);
    }
  }
  return result;
}

std::string HelpFormat::make_group(std::string group, bool is_positional,
                                   std::vector<const CLI::Option*> options) const {
  if (group == kHidden) return {};
  return Formatter::make_group(std::move(group), is_positional, std::move(options));
}

std::string HelpFormat::make_option_desc(const CLI::Option* option) const {
  return wrapped(Formatter::make_option_desc(option), kWidth - get_column_width());
}

std::string HelpFormat::make_option_opts(const CLI::Option* option) const {
  // A list of words needs no type name.
  constexpr std::string_view kListed = " TEXT:{";
  std::string text = Formatter::make_option_opts(option);
  if (!text.starts_with(kListed)) return text;
  text.replace(0, kListed.size(), " {");
  constexpr std::size_t kMost = 80;  // in addition to the option's name
  if (text.size() > kMost) text.insert(text.rfind(',', kMost - 1) + 1, "\n" + std::string(kIndent, ' '));
  return text;
}

}  // namespace signweave::cli
