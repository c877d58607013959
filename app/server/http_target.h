#pragma once

#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace signweave::server {

/// A request's target, taken apart and percent-decoded.
struct HttpTarget {
  std::vector<std::string> path;             ///< segments, none of them empty but perhaps the last ("/a/" has one)
  std::map<std::string, std::string> query;  ///< of a name that comes twice the last
};

/// Reads "/api/databases/demo?limit=3". None where it is no path, a % is not followed by two hexadecimal digits, or a
/// segment holds what no name may, a NUL. A slash that was percent-encoded is part of a name, as recordings may have
/// one: whoever makes a path of a file of it has to refuse it.
std::optional<HttpTarget> parse_target(std::string_view target);

/// "%C3%A9t%C3%A9" is "été"; with `plus` "+" is a blank, as forms write it.
std::optional<std::string> percent_decoded(std::string_view text, bool plus);

}  // namespace signweave::server
