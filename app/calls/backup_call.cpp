#include "app/calls/backup_call.h"

namespace signweave::calls {

using nlohmann::json;

namespace {

BackupProgress progress_of(const Listener& listener) {
  return [&listener](double fraction) { listener.advance(fraction); };
}

}  // namespace

BackupReport run(const Database& database, const std::filesystem::path& folder, const BackupCall& call,
                 const Listener& listener) {
  BackupOptions options;
  if (call.keep) options.keep = static_cast<std::size_t>(*call.keep);
  BackupReport report = backup(database, folder, options, progress_of(listener));
  for (const std::string& fault : report.faults) listener.blame(fault);
  return report;
}

json json_of(const BackupReport& report) {
  return {{"state", report.state},
          {"changed", report.changed},
          {"recordings", report.recordings},
          {"bytes", report.bytes},
          {"bytes_written", report.bytes_written},
          {"states_dropped", report.states_dropped},
          {"faults", report.faults}};
}

RestoreReport run(const std::filesystem::path& folder, const std::filesystem::path& database, const RestoreCall& call,
                  const Listener& listener) {
  RestoreOptions options{.engine = call.engine, .skip_damaged = call.skip_damaged};
  if (call.state) options.state = static_cast<std::uint64_t>(*call.state);
  RestoreReport report = restore(folder, database, options, progress_of(listener));
  for (const std::string& line : report.left_out) listener.blame(line);
  return report;
}

json json_of(const RestoreReport& report) {
  return {{"state", report.state},
          {"made", report.made},
          {"recordings", report.recordings},
          {"bytes", report.bytes},
          {"left_out", report.left_out}};
}

json json_of(const std::vector<BackupState>& states) {
  json list = json::array();
  for (const BackupState& state : states) {
    json one = {{"state", state.number}};
    if (!state.fault.empty()) {
      one["fault"] = state.fault;
    } else {
      one["made"] = state.made;
      one["database"] = state.database;
      one["recordings"] = state.recordings;
      one["bytes"] = state.bytes;
    }
    list.push_back(std::move(one));
  }
  return {{"states", std::move(list)}};
}

}  // namespace signweave::calls
