#include "app/calls/info_call.h"

#include <fmt/format.h>

#include "app/calls/defect_report.h"
#include "app/calls/rig_json.h"
#include "app/calls/selection_report.h"
#include "signweave/database/import.h"
#include "signweave/formats/file_format.h"

namespace signweave::calls {

using nlohmann::json;

namespace {

/// Of a tolerance in metres, without the noise of its last bits.
double millimetres(float tolerance) {
  return std::stod(fmt::format("{:.6g}", 1e3 * tolerance));
}

}  // namespace

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
    listener.blame(error.what());
  }
  const std::shared_ptr<const semantic_db::Learned> learned = database.snapshot().learned();
  info.weights = learned->weights;
  info.residuals = learned->residuals;
  return info;
}

json json_of(const DatabaseInfo& info) {
  json recordings = json::array();
  for (const RecordingInfo& recording : info.contents->recordings) {
    json one = {{"name", recording.name},
                {"signer", recording.signer},
                {"motion_file", recording.motion_file},
                {"annotation_file", recording.annotation_file},
                {"defects", recording.defects.size()},
                {"notices", json_of(recording.notices)}};
    if (recording.motion) {
      one["frames"] = recording.motion->frames;
      one["frames_per_second"] = recording.motion->rate.hertz();
      one["joints"] = recording.motion->joints;
      one["tracks"] = recording.motion->tracks;
      one["face_file"] = recording.face_file;
      one["access_mode"] = to_string(recording.motion->mode);
      one["compact_mm"] = millimetres(recording.motion->tolerance);
      one["packets"] = motion_db::packet_count(*recording.motion);
    }
    recordings.push_back(std::move(one));
  }
  json usage = json::array();
  for (const Usage& one : info.usage) {
    usage.push_back({{"kind", one.kind}, {"entries", one.entries}, {"bytes", one.bytes}});
  }
  return {{"engine", info.engine.name},
          {"engine_version", info.engine.version},
          {"entries", info.engine.entries},
          {"bytes_on_disk", info.engine.bytes_on_disk},
          {"bytes_free", info.engine.bytes_free ? json(*info.engine.bytes_free) : json(nullptr)},
          {"layout", info.layout},
          {"usage", std::move(usage)},
          {"access_mode", to_string(info.access_mode)},
          {"compact_mm", millimetres(info.tolerance)},
          {"documents", name_of(info.documents)},
          {"weights", json_of(info.weights)},
          {"transitions", json_of(info.residuals)},
          {"recordings", std::move(recordings)}};
}

RecordingDetails run(const Database& database, const RecordingCall& call) {
  const std::shared_ptr<const Contents> contents = database.contents();
  RecordingDetails details{.info = contents->at(call.recording)};
  const RecordingInfo& info = details.info;
  details.figures = {{"recording", info.name},
                     {"signer", info.signer},
                     {"motion_file", info.motion_file},
                     {"face_file", info.face_file},
                     {"annotation_file", info.annotation_file}};
  if (info.motion) {
    const Motion motion = database.read(info.name);
    details.model = model_of(motion, info.rig);
    details.figures["frames"] = motion.frame_count();
    details.figures["frames_per_second"] = motion.rate().hertz();
    details.figures["seconds"] = std::stod(fmt::format("{:.3f}", motion.duration().count()));
    details.figures["joints"] = motion.skeleton().joint_count();
    details.figures["scalar_tracks"] = motion.tracks().size();
    details.figures["clock_origin_ms"] = std::stod(fmt::format("{:.3f}", 1e3 * info.clock.origin.count() + 0.0));
  }
  const RecordingFeatures features = database.features(info.name);
  std::size_t known = 0;
  for (const PhaseFeatures& phase : features.phases) known += phase.known ? 1 : 0;
  details.figures["phases"] = features.phases.size();
  details.figures["phases_measured"] = known;
  details.figures["not_measured"] = features.why_not;
  if (details.model && details.model->body) {
    details.figures["shoulder_width_m"] = std::stod(fmt::format("{:.3f}", details.model->body->shoulder_width));
  }
  if (details.model) details.skeleton = database.skeleton(info.name);
  return details;
}

nlohmann::ordered_json json_of(const RecordingDetails& details) {
  nlohmann::ordered_json report = details.figures;
  report["annotation_fingerprint"] = annotation_fingerprint(details.info);
  report["notices"] = json_of(details.info.notices);
  if (details.model) report["rig"] = json_of_rig(*details.skeleton, details.model->rig);
  if (details.model) report["defects"] = json_of(details.info.defects, *details.skeleton);
  return report;
}

json json_of(const CheckResult& result) {
  return {{"recordings", result.recordings}, {"faults", result.faults}};
}

std::vector<std::vector<std::string>> format_rows() {
  std::vector<std::vector<std::string>> rows = {{"ending", "reads", "writes", "holds", "is lost"}};
  for (const FileFormat& format : file_formats()) {
    rows.push_back({std::string(format.extension), format.reads ? "yes" : "no", format.writes ? "yes" : "no",
                    std::string(format.holds), std::string(format.lost)});
  }
  return rows;
}

json formats_json() {
  json list = json::array();
  for (const FileFormat& format : file_formats()) {
    list.push_back({{"ending", format.extension},
                    {"name", format.name},
                    {"reads", format.reads},
                    {"writes", format.writes},
                    {"holds", format.holds},
                    {"lost", format.lost}});
  }
  return list;
}

}  // namespace signweave::calls
