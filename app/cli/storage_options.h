#pragma once

#include <optional>
#include <string>

#include "signweave/motion_db/access_mode.h"

namespace CLI {
class App;
class Option;
}  // namespace CLI

namespace signweave::cli {

/// --access-mode MODE, checked while the words are parsed, so that parse_access_mode(mode) is there.
CLI::Option* add_access_mode(CLI::App& verb, std::string& mode);

/// --compact MM: 0, or a length in millimetres; none as long as it is not given.
CLI::Option* add_compact(CLI::App& verb, std::optional<double>& millimetres);

/// "exactly", "within 0.1 mm": how a motion is kept; the tolerance is in metres.
std::string precision_name(float tolerance);

}  // namespace signweave::cli
