#include <CLI/CLI.hpp>
#include <ostream>

#include "app/cli/command.h"
#include "app/wire/text.h"
#include "signweave/calls/info_call.h"
#include "signweave/calls/table.h"

namespace signweave::cli {

Run formats(CLI::App&) {
  return [](Io& io) {
    io.out << (io.json ? text_of(answer_json<nlohmann::json>(calls::formats_answer()))
                       : format_table(calls::format_rows()));
  };
}

}  // namespace signweave::cli
