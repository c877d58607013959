#include "app/cli/info_database.h"
#include "app/wire/text.h"

#include <fmt/format.h>

#include <ostream>

#include "app/cli/rig_report.h"
#include "signweave/calls/backup_call.h"
#include "signweave/calls/defect_report.h"
#include "signweave/calls/info_call.h"
#include "signweave/calls/selection_report.h"
#include "signweave/calls/table.h"
#include "signweave/core/text.h"
#include "signweave/database/check.h"
#include "signweave/database/database.h"

namespace signweave::cli {

void print_pairs(Io& io, const nlohmann::ordered_json& fields) {
  std::vector<std::vector<std::string>> rows = {{}};
  for (const auto& [key, value] : fields.items()) {
    if (value.is_array() || value.is_object()) continue;
    rows.push_back({key, value.is_string() ? value.get<std::string>() : value.dump()});
  }
  io.out << format_table(rows).substr(1);
}

namespace {

/// "exactly", "within 0.1 mm": the precision of a stored motion; the tolerance is in metres.
std::string precision_name(float tolerance) {
  return tolerance > 0 ? fmt::format("within {:.6g} mm", 1e3 * tolerance) : "exactly";
}

double mebibytes(std::uint64_t bytes) {
  return static_cast<double>(bytes) / 1048576.0;
}

}  // namespace

void info_of_database(const std::string& folder, Io& io) {
  const Database database(folder, kv::Access::read_only);
  const calls::DatabaseInfo found = run_info(
      database, [&] { return usage_in_child(folder); }, listener_of(io));
  if (io.json) {
    io.out << text_of(answer_json<nlohmann::json>(found));
    return;
  }
  const kv::EngineInfo& engine = found.engine;
  const Contents& contents = *found.contents;
  io.out << fmt::format("{}: {} {}, layout {}, {}, {:.1f} MiB on disk{}, new motions {}, kept {}{}\n", folder,
                        engine.name, engine.version, found.layout, counted(engine.entries, "record"),
                        mebibytes(engine.bytes_on_disk),
                        engine.bytes_free ? fmt::format(" ({:.1f} free)", mebibytes(*engine.bytes_free)) : "",
                        to_string(found.access_mode), precision_name(found.tolerance),
                        found.documents == DocumentStorage::node ? ", documents node" : "");
  std::vector<std::vector<std::string>> rows = {{"recording", "signer", "frames", "per second", "seconds", "joints",
                                                 "tracks", "access mode", "packets", "kept", "defects", "signs"}};
  for (std::size_t i = 0; i < contents.recordings.size(); ++i) {
    const RecordingInfo& info = contents.recordings[i];
    std::size_t signs = 0;
    const SegmentTable::RowRange range = contents.segments.recording_rows(static_cast<std::uint32_t>(i));
    for (RowId row = range.begin; row < range.end; ++row) signs += contents.segments.kind(row) == RowKind::sign ? 1 : 0;
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
  for (const Usage& one : found.usage) {
    kinds.push_back({one.kind, std::to_string(one.entries), fmt::format("{:.3f}", mebibytes(one.bytes))});
  }
  if (kinds.size() > 1) io.out << format_table(kinds);
  io.out << fmt::format("weights of joins: {}\n", describe(found.weights));
  io.out << fmt::format("transitions: {}\n", describe(found.residuals));
  for (const std::string& fault : contents.faults) io.err << "signweave: " << fault << '\n';
  if (!contents.faults.empty()) io.status = 1;
}

void info_of_backup(const std::string& folder, Io& io) {
  const std::vector<BackupState> states = backup_states(folder);
  if (io.json) {
    io.out << text_of(answer_json<nlohmann::json>(calls::BackupStatesAnswer{states}));
    return;
  }
  std::vector<std::vector<std::string>> rows = {{"state", "made", "database", "recordings", "size"}};
  for (const BackupState& state : states) {
    rows.push_back({std::to_string(state.number), state.made, state.database, std::to_string(state.recordings),
                    size_text(state.bytes)});
    if (state.fault.empty()) continue;
    rows.pop_back();
    io.err << "signweave: " << one_line(state.fault) << '\n';
    io.status = 1;
  }
  io.out << format_table(rows);
}

void info_of_recording(const std::string& folder, const std::string& name, Io& io) {
  const Database database(folder, kv::Access::read_only);
  const calls::RecordingDetails found = calls::run(database, calls::RecordingCall{.recording = name});
  if (io.json) {
    io.out << text_of(answer_json(found));
    return;
  }
  AnswerJsonWriter<nlohmann::ordered_json> figures;
  calls::figure_fields(figures, found);
  print_pairs(io, figures.object);
  if (found.model) {
    io.out << table_of(found.info.defects, *found.skeleton, {});
    print_rig(*found.skeleton, found.model->rig, found.info.name, io);
  }
  print_notices(io, found.info.notices);
}

}  // namespace signweave::cli
