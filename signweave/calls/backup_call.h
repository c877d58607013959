#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "signweave/backup/backup.h"
#include "signweave/calls/field.h"
#include "signweave/calls/listener.h"
#include "signweave/core/answer.h"

namespace signweave {

template <class Visit>
void fields(Visit& visit, const BackupReport& report) {
  visit.type("Backup");
  visit(AnswerField{.name = "state"}, report.state);
  visit(AnswerField{.name = "changed", .help = "false: a state with this content already existed"}, report.changed);
  visit(AnswerField{.name = "recordings"}, report.recordings);
  visit(AnswerField{.name = "bytes", .help = "of all files of the state"}, report.bytes);
  visit(AnswerField{.name = "bytes_written", .help = "of its new files"}, report.bytes_written);
  visit(AnswerField{.name = "states_dropped"}, report.states_dropped);
  visit(AnswerField{.name = "faults", .help = "one line per damaged recording, which is left out"}, report.faults);
}

template <class Visit>
void fields(Visit& visit, const RestoreReport& report) {
  visit.type("Restore");
  visit(AnswerField{.name = "state"}, report.state);
  visit(AnswerField{.name = "made"}, report.made);
  visit(AnswerField{.name = "recordings"}, report.recordings);
  visit(AnswerField{.name = "bytes"}, report.bytes);
  visit(AnswerField{.name = "left_out"}, report.left_out);
}

/// A state that cannot be read has only its number and the reason.
template <class Visit>
void fields(Visit& visit, const BackupState& state) {
  const bool good = state.fault.empty();
  visit.type("BackupState");
  visit(AnswerField{.name = "state"}, state.number);
  visit(AnswerField{.name = "fault", .help = "why it cannot be read"}, given_if(!good, state.fault));
  visit(AnswerField{.name = "made", .help = "UTC, ISO 8601"}, given_if(good, state.made));
  visit(AnswerField{.name = "database"}, given_if(good, state.database));
  visit(AnswerField{.name = "recordings"}, given_if(good, state.recordings));
  visit(AnswerField{.name = "bytes"}, given_if(good, state.bytes));
}

}  // namespace signweave

namespace signweave::calls {

/// Adds the state of a database to a backup.
struct BackupCall {
  std::optional<std::int64_t> keep;
};

template <class Visit>
void fields(Visit& visit, BackupCall& call) {
  visit(Field{.name = "keep",
              .help = "how many states stay in the backup, the newest; all if not given",
              .range = Range{std::int64_t{1}, std::int64_t{1'000'000}},
              .type_name = "N"},
        call.keep);
}

/// Reports faults to the listener. Throws what signweave::backup throws.
BackupReport run(const Database& database, const std::filesystem::path& folder, const BackupCall& call,
                 const Listener& listener);

/// Restores a state of a backup as a database.
struct RestoreCall {
  std::optional<std::int64_t> state;
  std::string engine;
  bool skip_damaged = false;
};

template <class Visit>
void fields(Visit& visit, RestoreCall& call) {
  visit(Field{.name = "state",
              .help = "which state, as 'signweave info BACKUP' numbers them; the newest if not given",
              .range = Range{std::int64_t{1}, std::int64_t{999'999'999}},
              .type_name = "N"},
        call.state);
  visit(Field{.name = "engine", .help = "key-value engine; as it was if not given", .one_of = kv::engines()},
        call.engine);
  visit(Field{.name = "skip_damaged", .help = "leave out recordings whose files are damaged, instead of refusing"},
        call.skip_damaged);
}

/// Reports what is left out to the listener. Throws what signweave::restore throws.
RestoreReport run(const std::filesystem::path& folder, const std::filesystem::path& database, const RestoreCall& call,
                  const Listener& listener);

/// The states of a backup, as returned by backup_states.
struct BackupStatesAnswer {
  std::vector<BackupState> states;
};
template <class Visit>
void fields(Visit& visit, const BackupStatesAnswer& answer) {
  visit.type("BackupStates");
  visit(AnswerField{.name = "states"}, answer.states);
}

}  // namespace signweave::calls
