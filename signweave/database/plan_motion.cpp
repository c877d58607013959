#include "signweave/database/plan_motion.h"

#include <fmt/format.h>

#include <cmath>

#include "signweave/database/face_part.h"

namespace signweave {
namespace {

/// True if the motion file would be read with other options than when it was imported.
bool reads_otherwise(const PlanInput& input) {
  const motion_file::ReadOptions& options = input.options.motion;
  if (!input.known->motion_facts.layout) {
    const std::string reading = motion_file::given_options(*input.job.motion, options);
    return !reading.empty() && reading != input.known->motion_facts.reading;
  }
  const bvh::Layout& layout = *input.known->motion_facts.layout;
  return (options.up && *options.up != layout.up) || (options.unit && *options.unit != layout.unit) ||
         (options.root_unit && *options.root_unit != layout.root_unit) || (options.mirror && !layout.mirrored) ||
         (options.root_columns != bvh::RootColumns::declared && options.root_columns != layout.root_columns);
}

Seconds planned_face_offset(const PlanInput& input) {
  const Seconds before = input.known != nullptr ? input.known->motion_facts.face_offset : Seconds(0);
  const ImportJob& job = input.job;
  if (!job.face) return before;
  const std::optional<Seconds> given = job.face_offset ? job.face_offset : input.options.face_offset;
  return given_face_offset(*job.face, given, input.options.face_timecode).value_or(before);
}

[[noreturn]] void refuse_face(const PlanInput& input) {
  const bool same_file = input.known->motion_facts.face_fingerprint == input.fingerprints.face;
  throw Error(
      ErrorCode::conflict,
      fmt::format("{}: {} recording '{}' was imported with", input.job.face->string(),
                  same_file ? "lies elsewhere in the motion than the face that" : "is not the face that", input.name()),
      {{"replace_motion", "true"}});
}

[[noreturn]] void refuse_motion(const PlanInput& input) {
  throw Error(
      ErrorCode::conflict,
      fmt::format("{}: is not the motion that recording '{}' was imported from (or is read with other options); "
                  "replace it, or import it under another file name as another recording",
                  input.job.motion->string(), input.name()),
      {{"replace_motion", "true"}});
}

/// Adds notices about guesses and peculiarities of the skeleton.
void add_rig_notices(const PlanInput& input, const Motion& motion, std::vector<Notice>& notices) {
  const RigNames& names = input.options.rig        ? *input.options.rig
                          : input.known != nullptr ? input.known->rig
                                                   : RigNames{};
  try {
    for (const Notice& notice : map_rig(motion, names).notices) {
      notices.push_back({input.job.motion->string(), notice.text, notice.remedies});
    }
  } catch (const Error&) {  // names that do not fit: check_rig reports them, after the other errors
  }
}

/// Returns the stored motion without its face, with the facts of its import.
MotionPart stored_part(const PlanInput& input) {
  const RecordingInfo& known = *input.known;
  Motion stored = input.database.read(known.name);
  std::vector<ScalarTrack> tracks = stored.take_tracks();
  for (std::size_t i = 0; i < known.motion_facts.own_tracks; ++i) stored.add_track(std::move(tracks[i]));
  MotionPart part{.motion = std::move(stored), .facts = known.motion_facts, .rounded_within = known.motion->tolerance};
  part.facts.face_file.clear();
  part.facts.face_fingerprint = 0;
  return part;
}

/// Reads the motion file. If no options are given, those of an earlier import apply.
MotionPart part_from_file(const PlanInput& input, std::vector<Notice>& notices) {
  const ImportJob& job = input.job;
  motion_file::ReadOptions options = input.options.motion;
  if (input.known != nullptr && !input.known->motion_facts.layout &&
      motion_file::given_options(*job.motion, options).empty()) {
    options = motion_file::options_in(input.known->motion_facts.reading);
    options.skeleton = input.options.motion.skeleton;
    options.progress = input.options.motion.progress;
  }
  motion_file::File file = motion_file::read(*job.motion, options);
  notices = std::move(file.notices);
  if (file.motion.frame_count() > 0) add_rig_notices(input, file.motion, notices);
  MotionFacts facts{.layout = std::move(file.layout),
                    .file = job.motion->filename().string(),
                    .fingerprint = input.fingerprints.motion,
                    .declarations = std::move(file.declarations),
                    .own_tracks = static_cast<std::uint32_t>(file.motion.tracks().size())};
  if (!facts.layout) facts.reading = motion_file::given_options(*job.motion, options);
  return {.motion = std::move(file.motion), .facts = std::move(facts)};
}

void put_face_on(MotionPart& part, const PlanInput& input, Seconds offset, std::vector<Notice>& notices) {
  part.facts.own_tracks = static_cast<std::uint32_t>(add_face(*input.job.face, offset, part.motion, notices));
  part.facts.face_file = input.job.face->filename().string();
  part.facts.face_fingerprint = input.fingerprints.face;
  part.facts.face_offset = offset;
}

}  // namespace

void keep_notices(const RecordingInfo& known, const std::string& file, std::vector<Notice>& notices) {
  if (file.empty()) return;
  for (const Notice& notice : known.notices) {
    if (notice.where == file || notice.where.ends_with('/' + file) ||
        notice.where.find(file + ':') != std::string::npos) {
      notices.push_back(notice);
    }
  }
}

MotionDecision decide_motion(const PlanInput& input) {
  const RecordingInfo* known = input.known;
  const bool same_motion = input.job.motion && input.motion_known() &&
                           known->motion_facts.fingerprint == input.fingerprints.motion && !reads_otherwise(input);
  MotionDecision decision{.face_offset = planned_face_offset(input)};
  if (input.job.face && same_motion) {
    const Seconds before = known->motion_facts.face_offset;
    const bool moved = std::abs((decision.face_offset - before).count()) > 1e-9;
    decision.face_added = known->motion_facts.face_file.empty();
    decision.face_changed =
        !decision.face_added && (known->motion_facts.face_fingerprint != input.fingerprints.face || moved);
  }
  const bool replace = input.options.replace_motion;
  decision.stores = input.job.motion && (!same_motion || decision.face_added || decision.face_changed || replace);
  if (decision.face_changed && !replace) refuse_face(input);
  // A first face replaces nothing, so options.replace_motion is not needed.
  if (decision.stores && input.motion_known() && !decision.face_added && !replace) refuse_motion(input);
  return decision;
}

PlannedMotion plan_motion(const PlanInput& input, const MotionDecision& decision) {
  const RecordingInfo* known = input.known;
  PlannedMotion planned;
  if (input.motion_known()) {
    planned.rate = known->motion->rate;
    planned.frames = known->motion->frames;
  }
  if (!decision.stores) {
    if (known != nullptr) {
      keep_notices(*known, known->motion_facts.file, planned.notices);
      keep_notices(*known, known->motion_facts.face_file, planned.notices);
    }
    return planned;
  }
  // Without a layout the motion file may have tracks that an earlier face replaced, so it is read again.
  if ((decision.face_added || decision.face_changed) && known->motion_facts.layout) {
    planned.part = stored_part(input);
    keep_notices(*known, known->motion_facts.file, planned.notices);
  } else {
    planned.part = part_from_file(input, planned.notices);
    planned.rate = planned.part->motion.rate();
    planned.frames = planned.part->motion.frame_count();
    if (!input.job.face && known != nullptr && !known->motion_facts.face_file.empty()) {
      planned.notices.push_back({known->motion_facts.face_file, "was not given again, so its face is gone"});
    }
  }
  if (input.job.face) put_face_on(*planned.part, input, decision.face_offset, planned.notices);
  return planned;
}

void check_rig(const PlanInput& input, const PlannedMotion& motion) {
  const RigNames before = input.known != nullptr ? input.known->rig : RigNames{};
  const RigNames& names = input.options.rig ? *input.options.rig : before;
  const bool changed = input.motion_known() && names != before;
  if (names.empty() || motion.frames == 0 || (!motion.part && !changed)) return;
  try {
    map_rig(motion.part ? motion.part->motion : input.database.read(input.name()), names);
  } catch (const Error& error) {
    if (input.options.rig && error.code() != ErrorCode::io) {
      throw Error(error.code(), fmt::format("{}: its mapping file: {}", input.name(), error.what()), error.remedies());
    }
    if (input.options.rig || error.code() != ErrorCode::not_found) throw;
    throw Error(error.code(),
                fmt::format("{}: the mapping file of an earlier import says {}; give another, or "
                            "an empty file to forget it",
                            input.name(), error.what()),
                {{"rig", ""}});
  }
}

}  // namespace signweave
