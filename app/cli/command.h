#pragma once

#include <functional>
#include <iosfwd>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "signweave/core/error.h"

namespace CLI {
class App;
}

namespace signweave::calls {
struct Listener;
}

namespace signweave::wire {}

namespace signweave {
class Database;
}

/// The command line. Results go to `out`, everything else to `err`; errors are thrown.
namespace signweave::cli {

using namespace calls;  // requests and their answers: signweave/calls
using namespace wire;   // answers as JSON: app/wire

/// The output streams of a command, and how to write to them.
struct Io {
  std::ostream& out;
  std::ostream& err;
  bool json = false;      ///< --json: one JSON document on `out`
  bool terminal = false;  ///< `err` is a terminal: progress bars may be drawn
  int status = 0;         ///< the exit status of the process; a command sets 1 if some of its inputs were at fault
};

/// The action of a verb, run after its options have been parsed.
using Run = std::function<void(Io&)>;

/// One verb. `setup` adds its options to `verb` and returns what to run after parsing.
struct Command {
  std::string_view name;
  std::string_view summary;  ///< one line for `signweave --help`
  std::string_view example;  ///< shown by `signweave VERB --help`
  Run (*setup)(CLI::App& verb);
};

/// All verbs, in the order of `--help`. A new verb is a row here and a file command_x.cpp.
std::span<const Command> commands() noexcept;

/// Parses and runs a command line. Returns the exit status: 0 success (also for an empty answer), 1 some input or data
/// is at fault, 2 wrong usage. Never throws.
int dispatch(const std::vector<std::string>& words, Io& io);

/// A message on one line, even if a file name in it contains line breaks.
std::string one_line(std::string_view text);

/// "signweave: WHERE: text" on `err`.
/// How the command line spells what would fix a fault: "; use --up or --unit", "; use --root-order rotation_first
/// --root-unit m"; empty for none.
std::string advice_of(const Remedies& remedies);

void print_notices(Io& io, const std::vector<Notice>& notices);

/// Reports on `err` recordings that are damaged and therefore left out, and sets the exit status to 1.
void report_damage(const Database& database, Io& io);

/// Prints the notices and faults of a call as lines on `err`; a fault sets exit status 1. Borrows `io`.
calls::Listener listener_of(Io& io);

Run create(CLI::App& verb);
Run import(CLI::App& verb);
Run remove(CLI::App& verb);
Run info(CLI::App& verb);
Run check(CLI::App& verb);
Run relayout(CLI::App& verb);
Run backup(CLI::App& verb);
Run restore(CLI::App& verb);
Run compact_file(CLI::App& verb);
Run query(CLI::App& verb);
Run xpath(CLI::App& verb);
Run sign(CLI::App& verb);
Run edit(CLI::App& verb);
Run convert(CLI::App& verb);
Run export_recording(CLI::App& verb);
Run segment(CLI::App& verb);
Run stats(CLI::App& verb);
Run evaluate(CLI::App& verb);
Run serve(CLI::App& verb);
Run render(CLI::App& verb);
Run formats(CLI::App& verb);

}  // namespace signweave::cli
