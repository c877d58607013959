#include "signweave/database/import_plan.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "signweave/core/atomic_file.h"
#include "signweave/database/plan_annotation.h"
#include "signweave/database/plan_clock.h"
#include "signweave/database/plan_input.h"
#include "signweave/database/plan_motion.h"
#include "signweave/formats/annotation_file.h"

namespace signweave {
namespace {

JobFingerprints fingerprints_of(const ImportJob& job, const ImportOptions& options) {
  return {.motion = job.motion ? motion_file::fingerprint(*job.motion, options.motion) : 0,
          .annotation = job.annotation ? annotation_file::fingerprint(*job.annotation) : 0,
          .face = job.face ? file_checksum(*job.face) : 0};
}

/// Returns the stored recording of a job: of the job's name, or of the shorter name that the same files had before
/// another file of the same stem was added. Null if there is none. Adds every entry that it reads to `known`, which
/// owns the result.
const RecordingInfo* find_stored(const Database& database, const ImportJob& job, const JobFingerprints& prints,
                                 KnownRecordings& known) {
  const auto look_up = [&](const std::string& name) -> const std::optional<RecordingInfo>& {
    return known.emplace(name, database.info(name)).first->second;
  };
  for (std::size_t from = job.given_name ? std::string::npos : job.name.rfind('/');
       from != std::string::npos && from > 0; from = job.name.rfind('/', from - 1)) {
    const std::optional<RecordingInfo>& shorter = look_up(job.name.substr(from + 1));
    if (!shorter) continue;
    if (job.motion ? shorter->motion_facts.fingerprint == prints.motion
                   : shorter->annotation_fingerprint == prints.annotation) {
      return &*shorter;
    }
  }
  const std::optional<RecordingInfo>& stored = look_up(job.name);
  return stored ? &*stored : nullptr;
}

PartChange change_of(bool before, bool after, bool same) {
  if (!before) return after ? PartChange::added : PartChange::none;
  if (!after) return PartChange::removed;
  return same ? PartChange::kept : PartChange::replaced;
}

bool same_clock(const PlannedClock& a, const FrameClock& clock, bool given) {
  return std::abs((a.clock.origin - clock.origin).count()) <= 1e-9 &&
         std::abs(a.clock.frame_time / clock.frame_time - 1.0) <= 1e-12 && a.given == given;
}

std::string signer_of(const PlanInput& input, const std::vector<Sign>& signs) {
  if (!input.job.signer.empty()) return input.job.signer;
  const bool given = input.known != nullptr && input.known->signer_given;
  if (given && !input.known->signer.empty()) return input.known->signer;
  return signs.empty() ? std::string() : signs[0].signer;
}

/// The changes of motion and face.
void decide_motion_changes(const PlanInput& input, const MotionDecision& decision, ImportChanges& changes) {
  const bool new_face_only = decision.face_added || decision.face_changed;
  changes.motion =
      change_of(input.motion_known(), input.motion_known() || decision.stores, !decision.stores || new_face_only);
  const bool had_face = input.known != nullptr && !input.known->motion_facts.face_file.empty();
  changes.face = change_of(had_face, decision.stores ? input.job.face.has_value() : had_face, !decision.stores);
}

/// The changes of clock, signer and rig names.
void decide_setting_changes(const PlanInput& input, const PlannedClock& clock, const std::string& signer,
                            bool has_motion, ImportChanges& changes) {
  const RecordingInfo none;
  const RecordingInfo& known = input.known != nullptr ? *input.known : none;
  const bool had_clock = known.motion || known.clock_given;
  changes.clock = change_of(had_clock, has_motion || clock.given, same_clock(clock, known.clock, known.clock_given));
  changes.signer = change_of(!known.signer.empty(), !signer.empty(), signer == known.signer);
  const RigNames& rig = input.options.rig ? *input.options.rig : known.rig;
  changes.rig = change_of(!known.rig.empty(), !rig.empty(), rig == known.rig);
}

bool changes_nothing(const ImportChanges& changes) {
  const PartChange all[] = {changes.motion, changes.face,   changes.annotation,
                            changes.clock,  changes.signer, changes.rig};
  return std::ranges::all_of(
      all, [](PartChange change) { return change == PartChange::none || change == PartChange::kept; });
}

ImportOutcome outcome_of(bool known, const ImportChanges& changes, const MotionDecision& motion) {
  if (!known) return ImportOutcome::added;
  if (changes.motion == PartChange::added) return ImportOutcome::motion_added;
  if (changes.annotation == PartChange::added) return ImportOutcome::annotation_added;
  if (motion.face_added) return ImportOutcome::face_added;
  if (motion.stores) return ImportOutcome::motion_replaced;
  if (changes.annotation == PartChange::replaced) return ImportOutcome::annotation_replaced;
  return ImportOutcome::clock_changed;
}

/// Adds the notices about the recording as a whole.
void add_whole_notices(const ImportPlan& plan, const std::vector<Sign>& signs, bool has_motion, bool has_document,
                       std::vector<Notice>& notices) {
  const std::string& name = plan.recording.name;
  if (has_motion && has_document) report_uncovered(signs, plan.recording.clock, plan.frames, name, notices);
  if (!has_motion) notices.push_back({name, "annotation without motion: it can be searched, not signed"});
  if (!has_document) notices.push_back({name, "motion without annotation: it can be read, not searched"});
}

/// Fills in the recording to be stored. Moves from `motion` and `annotation`.
void fill_recording(const PlanInput& input, PlannedMotion& motion, PlannedAnnotation& annotation, ImportPlan& plan) {
  Recording& recording = plan.recording;
  const bool has_motion = motion.part || input.motion_known();
  recording.rig = input.options.rig;
  recording.notices = std::move(motion.notices);
  recording.notices.insert(recording.notices.end(), annotation.notices.begin(), annotation.notices.end());
  add_whole_notices(plan, annotation.signs, has_motion, annotation.document.has_value(), recording.notices);
  plan.signs = annotation.signs.size();
  plan.tracks = motion.part            ? motion.part->motion.tracks().size()
                : input.motion_known() ? input.known->motion->tracks.size()
                                       : 0;
  recording.motion = std::move(motion.part);
  if (!annotation.stores) return;
  recording.annotation = AnnotationPart{.document = std::move(*annotation.document),
                                        .tiers = std::move(annotation.tiers),
                                        .file = input.job.annotation->filename().string(),
                                        .fingerprint = input.fingerprints.annotation};
}

}  // namespace

std::string annotation_fingerprint(const RecordingInfo& info) {
  return info.document == 0 ? "none" : fmt::format("{:016x}", info.annotation_fingerprint);
}

ImportPlan plan_import(const Database& database, const ImportJob& job, const ImportOptions& options) {
  ImportPlan plan;
  const JobFingerprints fingerprints = fingerprints_of(job, options);
  const RecordingInfo* known = find_stored(database, job, fingerprints, plan.known);
  const PlanInput input{database, job, options, fingerprints, known};
  Recording& recording = plan.recording;
  recording.name = input.name();

  const MotionDecision decision = decide_motion(input);
  PlannedAnnotation annotation = plan_annotation(input);
  PlannedMotion motion = plan_motion(input, decision);
  const PlannedClock clock = plan_clock(input, motion, annotation.document);
  plan.frames = motion.frames;

  const bool has_motion = motion.part || input.motion_known();
  const std::string signer = signer_of(input, annotation.signs);
  decide_motion_changes(input, decision, plan.changes);
  plan.changes.annotation = change_of(input.document_known(), annotation.document.has_value(), !annotation.stores);
  decide_setting_changes(input, clock, signer, has_motion, plan.changes);
  if (known != nullptr && changes_nothing(plan.changes)) {
    if (!database.is_measured(known->name)) plan.outcome = ImportOutcome::measured;
    return plan;
  }
  require_recording_name(recording.name);
  check_rig(input, motion);
  plan.outcome = outcome_of(known != nullptr, plan.changes, decision);
  recording.signer = signer;
  recording.signer_given = !job.signer.empty() || (known != nullptr && known->signer_given);
  recording.tiers_given = annotation.tiers_given;
  recording.clock = clock.clock;
  recording.clock_given = clock.given;
  fill_recording(input, motion, annotation, plan);
  return plan;
}

}  // namespace signweave
