#pragma once

#include <string>
#include <string_view>

namespace signweave {

/// A field of a CSV row (RFC 4180): quoted if it contains a comma, a quote or a line end.
inline std::string csv_field(std::string_view text) {
  if (text.find_first_of(",\"\r\n") == text.npos) return std::string(text);
  std::string quoted = "\"";
  for (const char c : text) quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
  return quoted + '"';
}

}  // namespace signweave
