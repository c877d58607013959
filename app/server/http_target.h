#pragma once

#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace signweave::server {

/// A request's target, split and percent-decoded.
struct HttpTarget {
  std::vector<std::string> path;             ///< segments; only the last may be empty ("/a/" ends in an empty one)
  std::map<std::string, std::string> query;  ///< the last value of a repeated name
};

/// Parses "/api/databases/demo?limit=3". Nullopt if it is not a path, a % is not followed by two hexadecimal digits, or
/// a segment contains a NUL, which no name may. A percent-encoded slash is part of a name, because names of recordings
/// may contain one: code that builds a file path from a name has to refuse it.
std::optional<HttpTarget> parse_target(std::string_view target);

/// "%C3%A9t%C3%A9" is "été"; with `plus`, "+" is a blank, as in forms.
std::optional<std::string> percent_decoded(std::string_view text, bool plus);

}  // namespace signweave::server
