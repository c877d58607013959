#include "app/cli/storage_options.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>

#include "signweave/core/text.h"

namespace signweave::cli {

CLI::Option* add_access_mode(CLI::App& verb, std::string& mode) {
  return verb
      .add_option("--access-mode", mode, "how motions are cut: full, by_frame[:P], by_joint, by_joint_and_frame[:P]")
      ->check([](const std::string& text) {
        return parse_access_mode(text) ? std::string()
                                       : "'" + printable(text) +
                                             "' is no access mode: full, by_frame:P, by_joint or by_joint_and_frame:P, "
                                             "P a number of frames from 1 on";
      });
}

CLI::Option* add_compact(CLI::App& verb, std::optional<double>& millimetres) {
  return verb
      .add_option(
          "--compact", millimetres,
          "store motions rounded, no joint or fingertip further than MM from where it was (0.1 takes an eighth to a "
          "quarter of the space); 0: exactly")
      ->type_name("MM")
      ->check([](const std::string& text) {
        double value = 0;
        const bool number = CLI::detail::lexical_cast(text, value);
        return number && (value == 0 || (value >= 0.0001 && value <= 100))
                   ? std::string()
                   : "'" + printable(text) + "' is no distance in millimetres: 0.0001 to 100, or 0 for exactly";
      });
}

std::string precision_name(float tolerance) {
  return tolerance > 0 ? fmt::format("within {:.6g} mm", 1e3 * tolerance) : "exactly";
}

}  // namespace signweave::cli
