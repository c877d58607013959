#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <memory>
#include <ostream>

#include "app/cli/bind.h"
#include "app/cli/command.h"
#include "app/cli/progress.h"
#include "app/wire/text.h"
#include "signweave/calls/change_calls.h"
#include "signweave/calls/table.h"
#include "signweave/database/database.h"

namespace signweave::cli {

Run relayout(CLI::App& verb) {
  struct RelayoutArguments {
    std::string folder;
    calls::RelayoutCall call;
  };
  auto options = std::make_shared<RelayoutArguments>();
  verb.add_option("DB", options->folder, "the database")->required();
  bind(verb, options->call);
  return [options](Io& io) {
    if (const std::string fault = nothing_to_change(options->call); !fault.empty()) {
      throw CLI::ValidationError(fault);
    }
    Database database(options->folder, kv::Access::read_write);
    database.announce("signweave relayout");
    if (options->call.recordings.empty()) report_damage(database, io);
    calls::Relayouted done;
    {
      Progress progress(io, "storing again");
      calls::Listener listener = listener_of(io);
      listener.progress = [&](double fraction) { progress.show(fraction); };
      std::size_t changed = 0;
      try {
        done = calls::run(database, options->call, listener, [&](const std::string&) { ++changed; });
      } catch (const Error& error) {
        if (error.code() != ErrorCode::cancelled) throw;
        throw Error(ErrorCode::cancelled,
                    fmt::format("stopped after {} were stored again; the others are unchanged, and the same "
                                "command continues with them",
                                counted(changed, "recording")));
      }
    }
    learn(database, listener_of(io));
    if (io.json) {
      io.out << text_of(answer_json<nlohmann::json>(done));
      return;
    }
    io.out << fmt::format("{} of {} stored again\n", done.changed.size(), counted(done.recordings, "recording"));
  };
}

}  // namespace signweave::cli
