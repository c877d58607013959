#include "signweave/calls/backup_call.h"

namespace signweave::calls {

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
  for (const std::string& fault : report.faults) listener.report_fault(fault);
  return report;
}

RestoreReport run(const std::filesystem::path& folder, const std::filesystem::path& database, const RestoreCall& call,
                  const Listener& listener) {
  RestoreOptions options{.engine = call.engine, .skip_damaged = call.skip_damaged};
  if (call.state) options.state = static_cast<std::uint64_t>(*call.state);
  RestoreReport report = restore(folder, database, options, progress_of(listener));
  for (const std::string& line : report.left_out) listener.report_fault(line);
  return report;
}

}  // namespace signweave::calls
