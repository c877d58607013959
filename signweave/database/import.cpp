#include "signweave/database/import.h"

namespace signweave {
namespace {

/// Returns the half of `whole` that begins at `from`. `whole` must outlive the result.
Database::Progress half_of(const Database::Progress& whole, double from) {
  if (!whole) return {};
  return [&whole, from](double fraction) { whole(from + fraction / 2); };
}

}  // namespace

ImportReport apply(Database& database, const ImportPlan& plan, const Database::Progress& progress) {
  const Recording& recording = plan.recording;
  ImportReport report{.name = recording.name,
                      .outcome = plan.outcome,
                      .frames = plan.frames,
                      .tracks = plan.tracks,
                      .signs = plan.signs,
                      .defects = 0,
                      .not_measured = {},
                      .notices = recording.notices};
  if (plan.outcome == ImportOutcome::unchanged || plan.outcome == ImportOutcome::measured) {
    database.require_unchanged(plan.known);
    if (plan.outcome == ImportOutcome::measured) database.measure(recording.name);
    return report;
  }
  database.put(recording, progress, plan.known);
  const std::optional<RecordingInfo> info = database.info(recording.name);
  report.defects = info->defects.size();
  if (info->motion && info->document != 0) report.not_measured = database.features(recording.name).why_not;
  return report;
}

ImportReport import_recording(Database& database, const ImportJob& job, const ImportOptions& options,
                              const Database::Progress& progress) {
  ImportOptions reading = options;
  reading.motion.progress = half_of(progress, 0);
  return apply(database, plan_import(database, job, reading), half_of(progress, 0.5));
}

}  // namespace signweave
