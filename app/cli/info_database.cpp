#include "app/cli/info_database.h"

#include <fmt/format.h>

#include <ostream>

#include "app/cli/defect_report.h"
#include "app/cli/rig_report.h"
#include "app/cli/selection_report.h"
#include "app/cli/storage_options.h"
#include "app/cli/table.h"
#include "signweave/core/text.h"
#include "signweave/database/check.h"
#include "signweave/database/database.h"

namespace signweave::cli {

using nlohmann::json;

json json_of(const std::vector<Notice>& notices) {
  json list = json::array();
  for (const Notice& notice : notices) list.push_back({{"where", notice.where}, {"text", notice.text}});
  return list;
}

void print_pairs(Io& io, const nlohmann::ordered_json& fields) {
  std::vector<std::vector<std::string>> rows = {{}};
  for (const auto& [key, value] : fields.items()) {
    if (value.is_array() || value.is_object()) continue;
    rows.push_back({key, value.is_string() ? value.get<std::string>() : value.dump()});
  }
  io.out << format_table(rows).substr(1);
}

namespace {

/// Of a tolerance in metres, without the noise of its last bits.
double millimetres(float tolerance) {
  return std::stod(fmt::format("{:.6g}", 1e3 * tolerance));
}

double mebibytes(std::uint64_t bytes) {
  return static_cast<double>(bytes) / 1048576.0;
}

/// Nothing where looking at every entry meets damage; that is told.
std::vector<Usage> usage_of(const std::string& folder, Io& io) {
  try {
    return usage_in_child(folder);
  } catch (const Error& error) {
    io.err << "signweave: " << one_line(error.what()) << '\n';
    io.status = 1;
    return {};
  }
}

}  // namespace

void info_of_database(const std::string& folder, Io& io) {
  const Database database(folder, kv::Access::read_only);
  const std::shared_ptr<const Contents> contents = database.contents();
  const kv::EngineInfo engine = database.engine();
  if (io.json) {
    json recordings = json::array();
    for (const RecordingInfo& info : contents->recordings) {
      json one = {{"name", info.name},
                  {"signer", info.signer},
                  {"motion_file", info.motion_file},
                  {"annotation_file", info.annotation_file},
                  {"defects", info.defects.size()},
                  {"notices", json_of(info.notices)}};
      if (info.motion) {
        one["frames"] = info.motion->frames;
        one["frames_per_second"] = info.motion->rate.hertz();
        one["joints"] = info.motion->joints;
        one["tracks"] = info.motion->tracks;
        one["face_file"] = info.face_file;
        one["access_mode"] = to_string(info.motion->mode);
        one["compact_mm"] = millimetres(info.motion->tolerance);
        one["packets"] = motion_db::packet_count(*info.motion);
      }
      recordings.push_back(std::move(one));
    }
    json usage = json::array();
    for (const Usage& one : usage_of(folder, io)) {
      usage.push_back({{"kind", one.kind}, {"entries", one.entries}, {"bytes", one.bytes}});
    }
    io.out << json{{"engine", engine.name},
                   {"engine_version", engine.version},
                   {"entries", engine.entries},
                   {"bytes_on_disk", engine.bytes_on_disk},
                   {"layout", database.layout()},
                   {"usage", std::move(usage)},
                   {"access_mode", to_string(database.access_mode())},
                   {"compact_mm", millimetres(database.tolerance())},
                   {"weights", json_of(database.snapshot().join_weights())},
                   {"recordings", std::move(recordings)}}
                  .dump(2, ' ', false, nlohmann::json::error_handler_t::replace)
           << '\n';
    return;
  }
  io.out << fmt::format("{}: {} {}, layout {}, {}, {:.1f} MiB on disk, new motions {}, kept {}\n", folder, engine.name,
                        engine.version, database.layout(), counted(engine.entries, "record"),
                        mebibytes(engine.bytes_on_disk), to_string(database.access_mode()),
                        precision_name(database.tolerance()));
  std::vector<std::vector<std::string>> rows = {{"recording", "signer", "frames", "per second", "seconds", "joints",
                                                 "tracks", "access mode", "packets", "kept", "defects", "signs"}};
  for (std::size_t i = 0; i < contents->recordings.size(); ++i) {
    const RecordingInfo& info = contents->recordings[i];
    std::size_t signs = 0;
    const SegmentTable::RowRange range = contents->segments.recording_rows(static_cast<std::uint32_t>(i));
    for (RowId row = range.begin; row < range.end; ++row)
      signs += contents->segments.row(row).kind == RowKind::sign ? 1 : 0;
    std::vector<std::string> row = {info.name, info.signer};
    if (info.motion) {
      const motion_db::StoredMotion& motion = *info.motion;
      row.insert(row.end(), {std::to_string(motion.frames), to_string(motion.rate),
                             fmt::format("{:.2f}", static_cast<double>(motion.frames) / motion.rate.hertz()),
                             std::to_string(motion.joints), std::to_string(motion.tracks.size()),
                             to_string(motion.mode), std::to_string(motion_db::packet_count(motion)),
                             precision_name(motion.tolerance), std::to_string(info.defects.size())});
    } else {
      row.insert(row.end(), 9, "-");
    }
    row.push_back(info.document != 0 ? std::to_string(signs) : "-");
    rows.push_back(std::move(row));
  }
  if (rows.size() > 1) io.out << format_table(rows);
  std::vector<std::vector<std::string>> kinds = {{"kind", "records", "MiB"}};
  for (const Usage& one : usage_of(folder, io)) {
    kinds.push_back({one.kind, std::to_string(one.entries), fmt::format("{:.3f}", mebibytes(one.bytes))});
  }
  if (kinds.size() > 1) io.out << format_table(kinds);
  io.out << fmt::format("weights of joins: {}\n", describe(database.snapshot().join_weights()));
  for (const std::string& fault : contents->faults) io.err << "signweave: " << fault << '\n';
  if (!contents->faults.empty()) io.status = 1;
}

void info_of_recording(const std::string& folder, const std::string& name, Io& io) {
  const Database database(folder, kv::Access::read_only);
  const std::shared_ptr<const Contents> contents = database.contents();
  const RecordingInfo& info = contents->at(name);
  nlohmann::ordered_json fields = {{"recording", info.name},
                                   {"signer", info.signer},
                                   {"motion_file", info.motion_file},
                                   {"face_file", info.face_file},
                                   {"annotation_file", info.annotation_file}};
  std::optional<SignerModel> model;
  if (info.motion) {
    const Motion motion = database.read(name);
    model = model_of(motion, info.rig);
    fields["frames"] = motion.frame_count();
    fields["frames_per_second"] = motion.rate().hertz();
    fields["seconds"] = std::stod(fmt::format("{:.3f}", motion.duration().count()));
    fields["joints"] = motion.skeleton().joint_count();
    fields["scalar_tracks"] = motion.tracks().size();
    fields["clock_origin_ms"] = std::stod(fmt::format("{:.3f}", 1e3 * info.clock.origin.count() + 0.0));
  }
  const RecordingFeatures features = database.features(name);
  std::size_t known = 0;
  for (const PhaseFeatures& phase : features.phases) known += phase.known ? 1 : 0;
  fields["phases"] = features.phases.size();
  fields["phases_measured"] = known;
  fields["not_measured"] = features.why_not;
  if (model && model->body) {
    fields["shoulder_width_m"] = std::stod(fmt::format("{:.3f}", model->body->shoulder_width));
  }
  if (io.json) {
    fields["notices"] = json_of(info.notices);
    if (model) fields["rig"] = json_of_rig(*database.skeleton(name), model->rig);
    if (model) fields["defects"] = json_of(info.defects, *database.skeleton(name));
    io.out << fields.dump(2, ' ', false, json::error_handler_t::replace) << '\n';
    return;
  }
  print_pairs(io, fields);
  if (model) {
    const std::shared_ptr<const Skeleton> skeleton = database.skeleton(name);
    io.out << table_of(info.defects, *skeleton, {});
    print_rig(*skeleton, model->rig, info.name, io);
  }
  print_notices(io, info.notices);
}

}  // namespace signweave::cli
