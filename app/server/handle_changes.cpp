#include <fmt/format.h>

#include "app/server/answers.h"
#include "app/server/routes.h"
#include "signweave/calls/change_calls.h"

namespace signweave::server {

using nlohmann::json;

wire::SchemaWriter relayout_fields() {
  return wire::schema_of_call<calls::RelayoutCall>();
}

ApiResponse relayout_database(Call& call) {
  const auto parameters = read_parameters<calls::RelayoutCall>(call);
  ServedDatabase& served = call.database();
  if (const std::string fault = calls::nothing_to_change(parameters); !fault.empty()) {
    throw Error(ErrorCode::bad_input, fault);
  }
  for (const std::string& name : parameters.recordings) served.database().contents()->at(name);
  const std::string id =
      call.state.jobs.start({.name = "relayout"}, served.name(), [&served, parameters](JobContext& job) {
        served.change([&](Database& database) {
          const std::size_t wanted =
              parameters.recordings.empty() ? database.contents()->recordings.size() : parameters.recordings.size();
          job.report(answer_json<json>(RelayoutResult{.recordings = wanted, .changed = {}, .faults = {}}));
          const calls::Listener listener{
              .notice = {},
              .fault = [&](const std::string& line, const Remedies&) { job.add("faults", line); },
              .stage = {},
              .progress = [&](double fraction) { job.advance(fraction); }};
          calls::run(database, parameters, listener, [&](const std::string& name) { job.add("changed", name); });
          calls::learn(database, listener);
        });
        return json();  // the result is what was reported
      });
  return json_answer(answer_json(JobBegun{id}), 202);
}

ApiResponse remove_recording(Call& call) {
  const auto parameters = read_parameters<calls::RemoveCall>(call);
  ServedDatabase& served = call.database();
  if (const auto job = call.state.jobs.changing(served.name())) {
    throw Error(ErrorCode::conflict,
                fmt::format("job {} is changing '{}' now; try again when it has ended", *job, served.name()));
  }
  calls::Removed removed;
  served.change([&](Database& database) {
    removed = calls::run(database, parameters);
    calls::learn(database, call.listener());
  });
  return json_answer(answer_json(removed));
}

}  // namespace signweave::server
