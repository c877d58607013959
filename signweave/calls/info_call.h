#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "signweave/calls/defect_report.h"
#include "signweave/calls/field.h"
#include "signweave/calls/listener.h"
#include "signweave/calls/rig_answer.h"
#include "signweave/calls/selection_report.h"
#include "signweave/core/answer.h"
#include "signweave/database/check.h"
#include "signweave/database/database.h"
#include "signweave/database/import.h"
#include "signweave/features/hand_motion.h"
#include "signweave/formats/file_format.h"

namespace signweave {

template <class Visit>
void fields(Visit& visit, const Usage& usage) {
  visit.type("Usage");
  visit(AnswerField{.name = "kind"}, usage.kind);
  visit(AnswerField{.name = "entries"}, usage.entries);
  visit(AnswerField{.name = "bytes"}, usage.bytes);
}
template <class Visit>
void fields(Visit& visit, const CheckResult& result) {
  visit.type("Check");
  visit(AnswerField{.name = "recordings"}, result.recordings);
  visit(AnswerField{.name = "faults"}, result.faults);
}
template <class Visit>
void fields(Visit& visit, const FileFormat& format) {
  visit.type("FileFormat");
  visit(AnswerField{.name = "extension"}, format.extension);
  visit(AnswerField{.name = "ending", .help = "the former name of extension"}, format.extension);
  visit(AnswerField{.name = "name"}, format.name);
  visit(AnswerField{.name = "reads"}, format.reads);
  visit(AnswerField{.name = "writes"}, format.writes());
  visit(AnswerField{.name = "holds"}, format.holds);
  visit(AnswerField{.name = "lost"}, format.lost);
}

}  // namespace signweave

namespace signweave::calls {

/// Converts a tolerance from metres, rounding off the noise of its last bits.
double millimetres(float tolerance);
double rounded_to_thousandths(double value);

/// What a database holds.
struct DatabaseInfo {
  std::shared_ptr<const Contents> contents;
  kv::EngineInfo engine;
  int layout = 0;
  std::vector<Usage> usage;  ///< empty if reading every entry met damage
  AccessMode access_mode;
  float tolerance = 0;
  DocumentStorage documents = DocumentStorage::document;  ///< of later imports
  JoinWeights weights;
  ResidualModel residuals;  ///< what was learned from captured movements
};

/// `usage` reads every entry: Database::usage, or usage_in_child. Its errors are reported to the listener.
DatabaseInfo run_info(const Database& database, const std::function<std::vector<Usage>()>& usage,
                      const Listener& listener);

/// A row of the list of recordings. Borrows its data.
struct RecordingRow {
  const RecordingInfo* info = nullptr;
};
template <class Visit>
void fields(Visit& visit, const RecordingRow& row) {
  static const RecordingInfo no_recording;
  static const motion_db::StoredMotion no_motion;
  const RecordingInfo& info = row.info == nullptr ? no_recording : *row.info;
  const bool moving = info.motion.has_value();
  const motion_db::StoredMotion& motion = moving ? *info.motion : no_motion;
  visit.type("RecordingRow");
  visit(AnswerField{.name = "name"}, info.name);
  visit(AnswerField{.name = "signer"}, info.signer);
  visit(AnswerField{.name = "motion_file"}, info.motion_facts.file);
  visit(AnswerField{.name = "annotation_file"}, info.annotation_file);
  visit(AnswerField{.name = "face_file"}, given_if(moving, info.motion_facts.face_file));
  visit(AnswerField{.name = "defects", .help = "how many"}, info.defects.size());
  visit(AnswerField{.name = "notices"}, info.notices);
  visit(AnswerField{.name = "frames"}, given_if(moving, motion.frames));
  visit(AnswerField{.name = "frames_per_second"}, given_if(moving, moving ? motion.rate.hertz() : 0.0));
  visit(AnswerField{.name = "joints"}, given_if(moving, motion.joints));
  visit(AnswerField{.name = "tracks"}, given_if(moving, motion.tracks));
  visit(AnswerField{.name = "access_mode"}, given_if(moving, to_string(motion.mode)));
  visit(AnswerField{.name = "compact_mm", .help = "0: exact"}, given_if(moving, millimetres(motion.tolerance)));
  visit(AnswerField{.name = "packets"}, given_if(moving, moving ? motion_db::packet_count(motion) : std::size_t{0}));
}
std::vector<RecordingRow> recording_rows(const Contents* contents);

template <class Visit>
void fields(Visit& visit, const DatabaseInfo& info) {
  visit.type("Database");
  visit(AnswerField{.name = "engine"}, info.engine.name);
  visit(AnswerField{.name = "engine_version"}, info.engine.version);
  visit(AnswerField{.name = "entries"}, info.engine.entries);
  visit(AnswerField{.name = "bytes_on_disk"}, info.engine.bytes_on_disk);
  visit(AnswerField{.name = "bytes_free", .help = "of those: what compact-file would give back; null: not known"},
        OrNull{info.engine.bytes_free});
  visit(AnswerField{.name = "layout"}, info.layout);
  visit(AnswerField{.name = "usage"}, info.usage);
  visit(AnswerField{.name = "access_mode"}, to_string(info.access_mode));
  visit(AnswerField{.name = "compact_mm", .help = "0: motions are stored exactly"}, millimetres(info.tolerance));
  visit(AnswerField{.name = "documents",
                    .help = "how annotation that is imported later is stored",
                    .one_of = {"document", "node"}},
        name_of(info.documents));
  visit(AnswerField{.name = "weights"}, info.weights);
  visit(AnswerField{.name = "transitions"}, info.residuals);
  visit(AnswerField{.name = "recordings"}, recording_rows(info.contents.get()));
}

/// Everything known about one recording.
struct RecordingCall {
  std::string recording;
};

template <class Visit>
void fields(Visit& visit, RecordingCall& call) {
  visit(Field{.name = "recording", .help = "name of the recording", .words = "RECORDING", .required = true},
        call.recording);
}

/// What `info` reports about a recording.
struct RecordingDetails {
  RecordingInfo info;
  std::optional<SignerModel> model;  ///< none without motion
  std::shared_ptr<const Skeleton> skeleton;
  std::int64_t frames = 0;  ///< this and the next four: of the motion
  double frames_per_second = 0;
  double seconds = 0;
  std::size_t joints = 0;
  std::size_t scalar_tracks = 0;
  std::size_t phases = 0;
  std::size_t phases_measured = 0;
  std::string not_measured;  ///< why phases were not measured; empty: they were
};

/// Visits the details that are a single number or text.
template <class Visit>
void figure_fields(Visit& visit, const RecordingDetails& details) {
  const RecordingInfo& info = details.info;
  const bool moving = details.model.has_value();
  visit(AnswerField{.name = "recording"}, info.name);
  visit(AnswerField{.name = "signer"}, info.signer);
  visit(AnswerField{.name = "motion_file"}, info.motion_facts.file);
  visit(AnswerField{.name = "face_file"}, info.motion_facts.face_file);
  visit(AnswerField{.name = "annotation_file"}, info.annotation_file);
  visit(AnswerField{.name = "frames"}, given_if(moving, details.frames));
  visit(AnswerField{.name = "frames_per_second"}, given_if(moving, details.frames_per_second));
  visit(AnswerField{.name = "seconds"}, given_if(moving, details.seconds));
  visit(AnswerField{.name = "joints"}, given_if(moving, details.joints));
  visit(AnswerField{.name = "scalar_tracks"}, given_if(moving, details.scalar_tracks));
  visit(AnswerField{.name = "clock_origin_ms", .help = "the annotation time of frame 0"},
        given_if(moving, rounded_to_thousandths(1e3 * info.clock.origin.count())));
  visit(AnswerField{.name = "phases"}, details.phases);
  visit(AnswerField{.name = "phases_measured"}, details.phases_measured);
  visit(AnswerField{.name = "not_measured", .help = "why phases were not measured"}, details.not_measured);
  const bool known = moving && details.model->body;
  visit(AnswerField{.name = "shoulder_width_m"},
        given_if(known, known ? rounded_to_thousandths(details.model->body->shoulder_width) : 0.0));
}

template <class Visit>
void fields(Visit& visit, const RecordingDetails& details) {
  const bool moving = details.model.has_value();
  visit.type("Recording");
  figure_fields(visit, details);
  visit(AnswerField{.name = "annotation_fingerprint", .help = "identifies its annotation; none if there is none"},
        annotation_fingerprint(details.info));
  visit(AnswerField{.name = "notices"}, details.info.notices);
  visit(AnswerField{.name = "rig"},
        given_if(moving, moving ? rig_answer(*details.skeleton, details.model->rig) : RigAnswer()));
  visit(AnswerField{.name = "defects"},
        given_if(moving, moving ? defect_rows(details.info.defects, *details.skeleton) : std::vector<DefectRow>()));
}

/// Throws Error{not_found}.
RecordingDetails run(const Database& database, const RecordingCall& call);

/// The file formats.
std::vector<FileFormat> formats_answer();
/// The file formats and what each can hold, as rows; the heading first.
std::vector<std::vector<std::string>> format_rows();

}  // namespace signweave::calls
