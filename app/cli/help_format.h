#pragma once

#include <CLI/CLI.hpp>
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace signweave::cli {

/// Formats help with lines that fit a narrow terminal and a document.
class HelpFormat : public CLI::Formatter {
 public:
  static constexpr std::size_t kWidth = 100;
  static constexpr std::size_t kIndent = 16;             ///< of the continuation of a long list of words
  static constexpr std::string_view kHidden = "former";  ///< the group of options that help does not list
  std::string make_group(std::string group, bool is_positional, std::vector<const CLI::Option*> options) const override;
  std::string make_option_desc(const CLI::Option* option) const override;
  std::string make_option_opts(const CLI::Option* option) const override;
};

/// Wraps the text into lines of at most `width` characters, broken at blanks. The continuation of an indented line is
/// indented by two more.
std::string wrapped(const std::string& text, std::size_t width);

}  // namespace signweave::cli
