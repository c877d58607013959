#pragma once

#include <CLI/CLI.hpp>
#include <cstddef>
#include <string>

namespace signweave::cli {

/// Help of lines that a narrow terminal and a document hold.
class HelpFormat : public CLI::Formatter {
 public:
  static constexpr std::size_t kWidth = 100;
  static constexpr std::size_t kIndent = 16;  ///< of what a long list of words goes on with
  std::string make_option_desc(const CLI::Option* option) const override;
  std::string make_option_opts(const CLI::Option* option) const override;
};

/// The text in lines of at most so many letters, broken at blanks. What an indented line goes on
/// with is indented by two more.
std::string wrapped(const std::string& text, std::size_t width);

}  // namespace signweave::cli
