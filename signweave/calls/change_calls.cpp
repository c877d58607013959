#include "signweave/calls/change_calls.h"

#include <fmt/format.h>

#include <charconv>
#include <cmath>

#include "signweave/core/text.h"

namespace signweave::calls {

std::string check_access_mode(const std::string& text) {
  if (parse_access_mode(text)) return {};
  return fmt::format(
      "'{}' is not an access mode: full, by_frame:P, by_joint or by_joint_and_frame:P, P a number of frames from 1 on",
      printable(text));
}

std::string check_compact(const std::string& text) {
  double value = 0;
  const char* end = text.data() + text.size();
  const auto [parsed, error] = std::from_chars(text.data(), end, value);
  if (error == std::errc{} && parsed == end && (value == 0 || (value >= 0.0001 && value <= 100))) return {};
  return fmt::format("'{}' is not a distance in millimetres: 0.0001 to 100, or 0 for exactly", printable(text));
}

Field access_mode_field() {
  return {.name = "access_mode",
          .help = "how motions are cut: full, by_frame[:P], by_joint, by_joint_and_frame[:P]",
          .check = check_access_mode};
}

Field compact_field() {
  return {.name = "compact",
          .help =
              "store motions rounded, no joint or fingertip further than MM from where it was (0.1 takes an eighth "
              "to a quarter of the space); 0: exactly",
          .check = check_compact,
          .type_name = "MM"};
}

std::string check_documents(const std::string& text) {
  if (parse_document_storage(text)) return {};
  return fmt::format("'{}' is not a document storage: document or node", printable(text));
}

Field documents_field() {
  return {.name = "documents",
          .help = "how annotation is stored: document (each in one record) or node (every annotation a record)",
          .check = check_documents};
}

Removed run(Database& database, const RemoveCall& call) {
  database.remove(call.recording);
  return {call.recording};
}

std::string nothing_to_change(const RelayoutCall& call) {
  const bool nothing = call.access_mode.empty() && !call.compact && call.documents.empty();
  return nothing ? "what is to be changed? give access_mode, compact, documents or several of them" : "";
}

Relayouted run(Database& database, const RelayoutCall& call, const Listener& listener,
               const std::function<void(const std::string&)>& changed) {
  if (const std::string fault = nothing_to_change(call); !fault.empty()) throw Error(ErrorCode::bad_input, fault);
  Storage storage;
  if (!call.access_mode.empty()) storage.mode = parse_access_mode(call.access_mode);
  if (call.compact) storage.tolerance = static_cast<float>(*call.compact / 1e3);
  const std::optional<DocumentStorage> documents = parse_document_storage(call.documents);
  std::vector<std::string> names = call.recordings;
  const bool all = names.empty();
  if (all) {
    const std::shared_ptr<const Contents> contents = database.contents();
    for (const RecordingInfo& info : contents->recordings) names.push_back(info.name);
  } else {
    for (const std::string& name : names)
      database.contents()->at(name);  // throws for an unknown name before anything changes
  }
  // Motions already rounded stay rounded; for the whole database, 0 applies only to later imports.
  Storage stored = storage;
  if (all && storage.tolerance == 0.0f) stored.tolerance.reset();
  Relayouted done{.recordings = names.size()};
  bool whole = all && database.contents()->faults.empty();
  for (std::size_t i = 0; i < names.size(); ++i) {
    const auto advance = [&](double fraction) {
      listener.advance((static_cast<double>(i) + fraction) / static_cast<double>(names.size()));
    };
    try {
      bool stored_again = database.relayout(names[i], stored, advance);
      if (documents && database.relayout_document(names[i], *documents)) stored_again = true;
      if (!database.measure(names[i]) && !stored_again) continue;
      done.changed.push_back(names[i]);
      if (changed) changed(names[i]);
    } catch (const Error& error) {  // the others continue
      if (error.code() == ErrorCode::cancelled) throw;
      listener.report_fault(fmt::format("{}: {}", names[i], error.what()), error.remedies());
      whole = false;
    }
  }
  if (whole) database.set_storage(storage);
  if (whole && documents) database.set_document_storage(*documents);
  return done;
}

}  // namespace signweave::calls
