#pragma once

#include <CLI/CLI.hpp>
#include <cstddef>
#include <string>

namespace signweave::cli {

/// Formats help with lines that fit a narrow terminal and a document.
class HelpFormat : public CLI::Formatter {
 public:
  static constexpr std::size_t kWidth = 100;
  static constexpr std::size_t kIndent = 16;  ///< of the continuation of a long list of words
  std::string make_option_desc(const CLI::Option* option) const override;
  std::string make_option_opts(const CLI::Option* option) const override;
};

/// Wraps the text into lines of at most `width` characters, broken at blanks. The continuation of an indented line is
/// indented by two more.
std::string wrapped(const std::string& text, std::size_t width);

}  // namespace signweave::cli
