#include "signweave/drawing/svg_text.h"

#include "signweave/core/text.h"

namespace signweave {

std::string svg_text(std::string_view text) {
  const bool readable = is_utf8(text);
  std::string result;
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    switch (c) {
      case '&':
        result += "&amp;";
        break;
      case '<':
        result += "&lt;";
        break;
      case '>':
        result += "&gt;";
        break;
      case '"':
        result += "&quot;";
        break;
      default:
        // XML allows no control characters except white space, not even escaped.
        if (byte < 0x20) {
          result += ' ';
        } else if (byte >= 0x7f && !readable) {
          result += '?';
        } else {
          result += c;
        }
    }
  }
  return result;
}

double svg_ems(std::string_view text) {
  double width = 0;
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    if ((byte & 0xc0U) == 0x80) continue;  // continuation byte of a character
    const bool wide = byte >= 0xe3;        // East Asian scripts, pictographs
    const bool capital = c >= 'A' && c <= 'Z';
    width += wide ? 1.0 : capital ? 0.7 : 0.6;
  }
  return width;
}

}  // namespace signweave
