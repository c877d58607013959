#include <fmt/format.h>

#include <algorithm>

#include "signweave/annotation/declarations.h"
#include "signweave/core/text.h"
#include "signweave/database/catalogue.h"
#include "signweave/database/change_steps.h"
#include "signweave/database/database.h"
#include "signweave/database/measure.h"
#include "signweave/database/movement.h"
#include "signweave/database/tables.h"
#include "signweave/formats/eaf/eaf.h"
#include "signweave/motion_db/quantise.h"
#include "signweave/semantic_db/semantic_db.h"
#include "signweave/semantic_db/table_store.h"
#include "signweave/semantic_db/trace_store.h"

// Stores a recording. Whatever can fail because of the input fails before anything is written. Then the motion is
// written, still invisible, and one transaction makes everything visible.

namespace signweave {

/// The data that `put` computes before its transaction.
struct PreparedRecording {
  std::string source;         ///< of the document
  std::string specification;  ///< of the document; may be empty
  SegmentChunk segments;      ///< of the document; empty if neither document nor motion is stored
  RigNames rig;
  bool new_rig = false;  ///< other rig names for the stored motion
  std::optional<motion_db::StoredMotion> stored;
  std::optional<RecordingFeatures> features;
  std::optional<HandTrace> trace;
  std::vector<Defect> defects;  ///< meaningful if there is a new motion or new rig names
};

namespace {

/// Removes the folder of a file, which a database does not store: `…/a.eaf: Gloss` becomes `a.eaf: Gloss`.
void drop_folder(std::string& where, const std::string& file) {
  if (file.empty()) return;
  const std::size_t at = where.rfind('/' + file);
  if (at != std::string::npos) where.erase(0, at + 1);
}

void prepare_document(const AnnotationPart& part, PreparedRecording& prepared) {
  const bool has_source = !part.document.source.empty();
  prepared.source = has_source ? part.document.source : eaf::write_text(part.document);
  if (has_source) prepared.specification = part.document.specification;
  prepared.segments = segments_of(part.document, signs_in(part.document, part.tiers).signs);
}

/// A motion as it is stored.
struct StorableMotion {
  std::optional<Motion> changed;  ///< none: as it was given
  float tolerance = 0;
  bool rounds = false;  ///< half of the progress has been reported by rounding
};

/// Brings a motion into the form in which it is stored, and measures it.
StorableMotion prepare_motion(const Recording& recording, const catalogue::Head& head, bool has_document,
                              const Database::Progress& progress, PreparedRecording& prepared) {
  const Motion* motion = &recording.motion->motion;
  const SignerModel model = model_of(*motion, prepared.rig);
  prepared.defects = find_defects(*motion, model.rig);  // of the motion as given
  StorableMotion storable{.changed = {}, .tolerance = recording.motion->rounded_within};
  // A stored motion keeps one hemisphere from frame to frame, so that code that joins clips need not check each frame.
  if (!keeps_hemisphere(*motion)) {
    storable.changed = *motion;
    keep_hemisphere(*storable.changed);
    motion = &*storable.changed;
  }
  storable.rounds = storable.tolerance == 0 && head.tolerance > 0;
  if (storable.rounds) {
    storable.tolerance = head.tolerance;
    storable.changed = motion_db::quantise(*motion, head.tolerance, part_of(progress, 0, 0.5));
    motion = &*storable.changed;
  }
  // The motion is measured as it will be read, so that measuring it again gives the same values.
  const SignerModel read_model = storable.changed ? model_of(*motion, prepared.rig) : model;
  prepared.features = measure_phases(*motion, read_model, semantic_db::phase_spans(prepared.segments), recording.clock);
  prepared.features->noise = capture_noise(*motion);
  if (has_document) prepared.trace = trace_hands(*motion, read_model);
  return storable;
}

/// The defects of a stored motion under other rig names.
std::vector<Defect> defects_under(const RigNames& rig, const Motion& motion, const RecordingInfo& before) {
  std::vector<Defect> defects = find_defects(motion, map_rig(motion, rig));
  for (const Defect& defect : before.defects) {  // only the given motion had flips, the stored one has none
    if (defect.kind == DefectKind::quaternion_flip) defects.push_back(defect);
  }
  return defects;
}

/// Sets everything that is stored of a recording except its halves. `info` still names the previous files.
void describe_in(RecordingInfo& info, const Recording& recording) {
  info.name = recording.name;
  info.signer = recording.signer;
  info.clock = recording.clock;
  info.clock_given = recording.clock_given;
  info.tiers_given = recording.tiers_given;
  info.signer_given = recording.signer_given;
  info.notices = recording.notices;
  const MotionFacts& facts = recording.motion ? recording.motion->facts : info.motion_facts;
  for (Notice& notice : info.notices) {
    for (const std::string& file :
         {facts.file, facts.face_file, recording.annotation ? recording.annotation->file : info.annotation_file}) {
      drop_folder(notice.where, file);
    }
  }
}

void describe_motion_in(RecordingInfo& info, const MotionPart& part) {
  const MotionFacts old = std::exchange(info.motion_facts, part.facts);
  if (part.facts.face_file.empty()) {
    info.motion_facts.own_tracks = static_cast<std::uint32_t>(part.motion.tracks().size());
  }
  std::erase_if(info.declarations,
                [&](const auto& one) { return std::ranges::find(old.declarations, one) != old.declarations.end(); });
  merge_declarations(info.motion_facts.declarations, info.declarations);
}

/// Stores a document in place of the recording's previous one.
void put_document(kv::WriteTransaction& transaction, const AnnotationPart& part, PreparedRecording& prepared,
                  catalogue::Head& head, RecordingInfo& info) {
  if (info.document != 0) {
    // The hands' trace depends on motion and rig only.
    if (!prepared.trace && !prepared.new_rig) prepared.trace = trace_stored(transaction, info);
    semantic_db::erase(transaction, info.document);
  }
  info.document = head.next_generation++;
  info.tiers = part.tiers;
  info.annotation_file = part.file;
  info.annotation_fingerprint = part.fingerprint;
  info.declarations = declarations_of(part.document);
  merge_declarations(info.motion_facts.declarations, info.declarations);
  semantic_db::put_document(transaction, info.document, prepared.source, prepared.specification, head.documents);
  semantic_db::put(transaction, info.document, prepared.segments);
}

/// Stores the measures of a recording with a document. They depend on document, clock and rig.
void put_measures(kv::WriteTransaction& transaction, const RecordingInfo& info, bool new_document,
                  const PreparedRecording& prepared) {
  const std::optional<HandTrace>& trace = prepared.trace;
  if (trace || prepared.new_rig || new_document) {
    if (!trace) semantic_db::erase_trace(transaction, info.document);
    semantic_db::put_trace(transaction, info.document, trace ? *trace : trace_stored(transaction, info));
  }
  semantic_db::put_features(
      transaction, info.document,
      prepared.features ? *prepared.features : measure_stored(transaction, info, prepared.segments));
}

}  // namespace

void require_recording_name(std::string_view name) {
  if (!trimmed(name).empty() && name.size() <= 1000 && is_utf8(name)) return;
  throw Error(ErrorCode::bad_input,
              fmt::format("'{}': a recording needs a name of 1 to 1000 bytes of UTF-8", printable(name)));
}

void Database::require_unchanged(const kv::ReadTransaction& snapshot, const KnownRecordings& known) const {
  for (const auto& [name, expected] : known) {
    const std::optional<std::uint32_t> slot = slot_of(snapshot, name);
    const bool same =
        slot.has_value() == expected.has_value() && (!slot || catalogue::read_recording(snapshot, *slot) == *expected);
    if (same) continue;
    throw Error(
        ErrorCode::conflict,
        fmt::format("recording '{}' has changed since its import was planned; import it again", printable(name)));
  }
}

void Database::require_unchanged(const KnownRecordings& known) const {
  require_unchanged(*store_->read(), known);
}

void Database::put(const Recording& recording, const Progress& progress, const KnownRecordings& known) {
  require_writable();
  require_recording_name(recording.name);
  require_unchanged(known);
  const std::optional<RecordingInfo> before = info(recording.name);
  if (!recording.motion && !recording.annotation && !before) {
    throw Error(ErrorCode::bad_input, recording.name + ": neither motion nor annotation to store");
  }
  PreparedRecording prepared;
  prepared.rig = recording.rig ? *recording.rig : before ? before->rig : RigNames{};
  const bool document_stays = !recording.annotation && before && before->document != 0;
  if (recording.annotation) prepare_document(*recording.annotation, prepared);
  if (recording.motion) {
    const catalogue::Head head = catalogue::read_head(*store_->read());
    if (document_stays) prepared.segments = segments_if_sound(*store_->read(), *before);
    const bool has_document = recording.annotation || document_stays;
    const StorableMotion storable = prepare_motion(recording, head, has_document, progress, prepared);
    prepared.stored = write_motion(storable.changed ? *storable.changed : recording.motion->motion, head.access_mode,
                                   storable.tolerance, part_of(progress, storable.rounds ? 0.5 : 0, 1));
  } else if (before && before->motion && prepared.rig != before->rig) {
    prepared.new_rig = true;
    prepared.defects = defects_under(prepared.rig, read(recording.name), *before);
  }
  commit(recording, std::move(prepared), known);
  sweep();
}

void Database::commit(const Recording& recording, PreparedRecording prepared, const KnownRecordings& known) {
  const std::unique_ptr<kv::WriteTransaction> transaction = store_->write();
  require_unchanged(*transaction, known);
  catalogue::Head head = catalogue::read_head(*transaction);
  const std::optional<std::uint32_t> stored = slot_of(*transaction, recording.name);
  const std::uint32_t slot = stored.value_or(head.recordings);
  RecordingInfo info;
  if (stored) info = catalogue::read_recording(*transaction, slot);
  describe_in(info, recording);
  info.rig = prepared.rig;
  if (prepared.new_rig || recording.motion) info.defects = std::move(prepared.defects);
  if (recording.motion) {
    make_visible(*transaction, info, *prepared.stored);
    describe_motion_in(info, *recording.motion);
  }
  if (recording.annotation) {
    put_document(*transaction, *recording.annotation, prepared, head, info);
  } else if (info.document != 0 && !recording.motion) {
    prepared.segments = segments_if_sound(*transaction, info);
  }
  if (info.document != 0) put_measures(*transaction, info, recording.annotation.has_value(), prepared);
  catalogue::write_recording(*transaction, slot, info);
  if (!stored) ++head.recordings;
  ++head.changes;
  catalogue::write_head(*transaction, head);
  tables::put(*transaction, info, prepared.segments, stored.has_value());
  transaction->commit();
  remember_slot(slot, info.name, head.changes);
}

}  // namespace signweave
