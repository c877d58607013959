#include <CLI/CLI.hpp>
#include <ostream>

#include "app/calls/info_call.h"
#include "app/calls/table.h"
#include "app/cli/command.h"

namespace signweave::cli {

Run formats(CLI::App&) {
  return [](Io& io) { io.out << (io.json ? text_of(calls::formats_json()) : format_table(calls::format_rows())); };
}

}  // namespace signweave::cli
