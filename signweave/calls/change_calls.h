#pragma once

#include <optional>
#include <string>
#include <vector>

#include "signweave/calls/field.h"
#include "signweave/calls/listener.h"
#include "signweave/core/answer.h"
#include "signweave/database/database.h"

namespace signweave::calls {

/// Each returns what is wrong with the value; empty if it is valid.
std::string check_access_mode(const std::string& text);
std::string check_compact(const std::string& text);
std::string check_documents(const std::string& text);

/// The fields of `create` and `relayout` that say how motions and documents are stored.
Field access_mode_field();
Field compact_field();
Field documents_field();

/// Removes a recording.
struct RemoveCall {
  std::string recording;
};

template <class Visit>
void fields(Visit& visit, RemoveCall& call) {
  visit(Field{.name = "recording",
              .help = "name of the recording, or 'catalogue entry N' for one that check finds damaged",
              .words = "RECORDING",
              .required = true},
        call.recording);
}

struct Removed {
  std::string recording;
};
template <class Visit>
void fields(Visit& visit, const Removed& removed) {
  visit.type("Removed");
  visit(AnswerField{.name = "removed", .help = "the name of the recording"}, removed.recording);
}

/// Throws Error{not_found}. Call `learn` afterwards.
Removed run(Database& database, const RemoveCall& call);

/// Stores motions in another access mode or tolerance, and annotation documents in another form.
struct RelayoutCall {
  std::string access_mode;
  std::optional<double> compact;  ///< millimetres
  std::string documents;
  std::vector<std::string> recordings;
};

template <class Visit>
void fields(Visit& visit, RelayoutCall& call) {
  visit(access_mode_field(), call.access_mode);
  visit(compact_field(), call.compact);
  visit(documents_field(), call.documents);
  visit(Field{.name = "recordings",
              .help = "recordings to store again; without any, all of them and those that are imported later",
              .words = "RECORDING"},
        call.recordings);
}

/// Returns why there is nothing to do; empty if there is something.
std::string nothing_to_change(const RelayoutCall& call);

struct Relayouted {
  std::size_t recordings = 0;        ///< number that were to be stored again
  std::vector<std::string> changed;  ///< names
};
template <class Visit>
void fields(Visit& visit, const Relayouted& done) {
  visit.type("Relayouted");
  visit(AnswerField{.name = "recordings", .help = "how many were to be stored again"}, done.recordings);
  visit(AnswerField{.name = "changed", .help = "the names of those that were"}, done.changed);
}

/// A recording that fails is reported to the listener, and the others continue. Throws Error{not_found} for an unknown
/// name before anything is changed, and Error{bad_input} if nothing is to be changed. Calls `changed` for each
/// recording as soon as it is stored again; these stay changed if the rest is cancelled. Call `learn` afterwards.
Relayouted run(Database& database, const RelayoutCall& call, const Listener& listener,
               const std::function<void(const std::string&)>& changed = {});

}  // namespace signweave::calls
