#include "signweave/calls/info_call.h"

#include <fmt/format.h>

#include "signweave/calls/defect_report.h"
#include "signweave/calls/rig_answer.h"
#include "signweave/calls/selection_report.h"
#include "signweave/database/import.h"
#include "signweave/formats/file_format.h"

namespace signweave::calls {

double millimetres(float tolerance) {
  return std::stod(fmt::format("{:.6g}", 1e3 * tolerance));
}

double rounded_to_thousandths(double value) {
  return std::stod(fmt::format("{:.3f}", value + 0.0));
}

DatabaseInfo run_info(const Database& database, const std::function<std::vector<Usage>()>& usage,
                      const Listener& listener) {
  DatabaseInfo info{.contents = database.contents(),
                    .engine = database.engine(),
                    .layout = database.layout(),
                    .usage = {},
                    .access_mode = database.access_mode(),
                    .tolerance = database.tolerance(),
                    .documents = database.document_storage(),
                    .weights = {},
                    .residuals = {}};
  try {
    info.usage = usage();
  } catch (const Error& error) {
    listener.report_fault(error.what());
  }
  const std::shared_ptr<const semantic_db::Learned> learned = database.snapshot().learned();
  info.weights = learned->weights;
  info.residuals = learned->residuals;
  return info;
}

std::vector<RecordingRow> recording_rows(const Contents* contents) {
  std::vector<RecordingRow> rows;
  if (contents == nullptr) return rows;
  for (const RecordingInfo& info : contents->recordings) rows.push_back({&info});
  return rows;
}

RecordingDetails run(const Database& database, const RecordingCall& call) {
  const std::shared_ptr<const Contents> contents = database.contents();
  RecordingDetails details{.info = contents->at(call.recording)};
  const RecordingInfo& info = details.info;
  if (info.motion) {
    const Motion motion = database.read(info.name);
    details.model = model_of(motion, info.rig);
    details.frames = motion.frame_count();
    details.frames_per_second = motion.rate().hertz();
    details.seconds = rounded_to_thousandths(motion.duration().count());
    details.joints = static_cast<std::size_t>(motion.skeleton().joint_count());
    details.scalar_tracks = motion.tracks().size();
  }
  const RecordingFeatures features = database.features(info.name);
  for (const PhaseFeatures& phase : features.phases) details.phases_measured += phase.known ? 1 : 0;
  details.phases = features.phases.size();
  details.not_measured = features.why_not;
  if (details.model) details.skeleton = database.skeleton(info.name);
  return details;
}

std::vector<FileFormat> formats_answer() {
  const std::span<const FileFormat> formats = file_formats();
  return {formats.begin(), formats.end()};
}

std::vector<std::vector<std::string>> format_rows() {
  std::vector<std::vector<std::string>> rows = {{"extension", "reads", "writes", "holds", "is lost"}};
  for (const FileFormat& format : file_formats()) {
    rows.push_back({std::string(format.extension), format.reads ? "yes" : "no", format.writes() ? "yes" : "no",
                    std::string(format.holds), std::string(format.lost)});
  }
  return rows;
}

}  // namespace signweave::calls
