#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <memory>
#include <ostream>

#include "app/cli/bind.h"
#include "app/cli/command.h"
#include "app/cli/progress.h"
#include "app/wire/text.h"
#include "signweave/calls/backup_call.h"
#include "signweave/calls/table.h"
#include "signweave/core/text.h"
#include "signweave/database/compact_file.h"

namespace signweave::cli {

Run backup(CLI::App& verb) {
  struct BackupArguments {
    std::string database;
    std::string folder;
    calls::BackupCall call;
  };
  auto options = std::make_shared<BackupArguments>();
  verb.add_option("DB", options->database, "the database; other processes may write to it meanwhile")->required();
  verb.add_option("BACKUP", options->folder,
                  "folder of the backup: a new one, or an older backup, to which changes are added")
      ->required();
  bind(verb, options->call);
  return [options](Io& io) {
    const Database database(options->database, kv::Access::read_only);
    BackupReport report;
    {
      Progress progress(io, "backing up",
                        "stopped; the backup still has its previous states, and the same command continues");
      calls::Listener listener = listener_of(io);
      listener.progress = [&](double fraction) { progress.show(fraction); };
      report = calls::run(database, options->folder, options->call, listener);
    }
    if (io.json) {
      io.out << text_of(answer_json<nlohmann::json>(report));
      return;
    }
    io.out << fmt::format(
        "{}: {} {}, {}, {}, of which {} were written{}\n", options->folder,
        report.changed ? "state" : "nothing changed since state", report.state, counted(report.recordings, "recording"),
        size_text(report.bytes), size_text(report.bytes_written),
        report.states_dropped > 0 ? fmt::format("; {} dropped", counted(report.states_dropped, "older state")) : "");
  };
}

Run restore(CLI::App& verb) {
  struct RestoreArguments {
    std::string folder;
    std::string database;
    calls::RestoreCall call;
  };
  auto options = std::make_shared<RestoreArguments>();
  verb.add_option("BACKUP", options->folder, "folder of the backup")->required();
  verb.add_option("DB", options->database, "folder to create; must not exist or be empty")->required();
  bind(verb, options->call);
  return [options](Io& io) {
    RestoreReport report;
    {
      Progress progress(io, "restoring", "stopped; no database was created");
      calls::Listener listener = listener_of(io);
      listener.progress = [&](double fraction) { progress.show(fraction); };
      report = calls::run(options->folder, options->database, options->call, listener);
    }
    if (io.json) {
      io.out << text_of(answer_json<nlohmann::json>(report));
      return;
    }
    io.out << fmt::format("{}: {} of state {}, {}\n", options->database, counted(report.recordings, "recording"),
                          report.state, report.made);
  };
}

Run compact_file(CLI::App& verb) {
  auto folder = std::make_shared<std::string>();
  verb.add_option("DB", *folder, "the database; no other process may have it open")->required();
  return [folder](Io& io) {
    kv::Compacted done;
    {
      Progress progress(io, "compacting", "stopped; the database is unchanged");
      done = signweave::compact_file(*folder, [&](double fraction) { progress.show(fraction); });
    }
    if (io.json) {
      io.out << text_of(nlohmann::json{{"bytes_before", done.before}, {"bytes_after", done.after}});
      return;
    }
    io.out << fmt::format("{}: {} before, {} now\n", *folder, size_text(done.before), size_text(done.after));
  };
}

}  // namespace signweave::cli
