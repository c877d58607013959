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

namespace signweave {
class Database;
}

/// The command line. Results go to `out`, everything else to `err`; failure is thrown.
namespace signweave::cli {

using namespace calls;  // what is asked for, and how it is answered: app/calls

/// Where a command speaks, and how.
struct Io {
  std::ostream& out;
  std::ostream& err;
  bool json = false;      ///< --json: one JSON document on `out`
  bool terminal = false;  ///< `err` is a terminal: progress bars may be drawn
  int status = 0;         ///< what the process will end with; a command sets 1 where some of its inputs were at fault
};

/// What a verb does once its words are parsed.
using Run = std::function<void(Io&)>;

/// One verb. `setup` adds its options to `verb` and returns what to run after parsing.
struct Command {
  std::string_view name;
  std::string_view summary;  ///< one line for `signweave --help`
  std::string_view example;  ///< shown by `signweave VERB --help`
  Run (*setup)(CLI::App& verb);
};

/// Every verb, in the order of `--help`. A new verb is a row here and a file command_x.cpp.
std::span<const Command> commands() noexcept;

/// Parses and runs. Returns the exit status: 0 done (also for an empty answer), 1 some input or data is at fault, 2
/// wrong usage. Never throws.
int dispatch(const std::vector<std::string>& words, Io& io);

/// A message as one line, whatever a file's name holds.
std::string one_line(std::string_view text);

/// "signweave: WHERE: text" on `err`.
/// How the command line spells what would fix a fault: "; use --up or --unit", "; use --root-order rotation_first
/// --root-unit m"; empty for none.
std::string advice_of(const Remedies& remedies);

void print_notices(Io& io, const std::vector<Notice>& notices);

/// Tells of recordings that are damaged and therefore left out, on `err`, and sets the exit status to 1.
void report_damage(const Database& database, Io& io);

/// What a call tells of itself: notices and faults in lines on `err`, a fault with exit status 1. Borrows `io`.
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
