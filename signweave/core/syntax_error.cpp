#include "signweave/core/syntax_error.h"

#include <algorithm>

namespace signweave {

std::size_t count_characters(std::string_view text) noexcept {
  return static_cast<std::size_t>(
      std::count_if(text.begin(), text.end(), [](char c) { return (static_cast<unsigned char>(c) & 0xC0) != 0x80; }));
}

TextPosition position_in(std::string_view text, std::size_t offset) noexcept {
  const std::string_view before = text.substr(0, std::min(offset, text.size()));
  const std::size_t line_feed = before.rfind('\n');
  const std::size_t begin = line_feed == before.npos ? 0 : line_feed + 1;
  const std::string_view rest = text.substr(begin);
  return {.line = 1 + static_cast<std::size_t>(std::count(before.begin(), before.end(), '\n')),
          .column = 1 + count_characters(before.substr(begin)),
          .line_text = rest.substr(0, rest.find('\n')),
          .offset = before.size() - begin};
}

}  // namespace signweave
