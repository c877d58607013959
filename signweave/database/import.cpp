#include "signweave/database/import.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "signweave/core/atomic_file.h"
#include "signweave/core/text.h"
#include "signweave/database/face_part.h"
#include "signweave/formats/annotation_file.h"

namespace signweave {
namespace {

namespace fs = std::filesystem;

/// True where the file would be read otherwise than it was when it was imported.
bool reads_otherwise(const fs::path& file, const motion_file::ReadOptions& options, const RecordingInfo& known) {
  if (!known.layout) {
    const std::string told = motion_file::told(file, options);
    return !told.empty() && told != known.reading;
  }
  const bvh::Layout& layout = *known.layout;
  return (options.up && *options.up != layout.up) || (options.unit && *options.unit != layout.unit) ||
         (options.root_unit && *options.root_unit != layout.root_unit) || (options.mirror && !layout.mirrored) ||
         (options.root_columns != bvh::RootColumns::declared && options.root_columns != layout.root_columns);
}

/// Which tiers hold signs and phases: as given; else as given before, where the document still has them; else guessed,
/// with a notice that tells.
TierNames tier_names(const AnnotationDocument& document, const ImportOptions& options, const RecordingInfo* known,
                     const std::string& where, std::vector<Notice>& notices) {
  TierNames names{options.sign_tiers, options.phase_tiers, options.phase_labels};
  const bool as_before =
      known != nullptr && known->document != 0 && known->tiers_given &&
      std::all_of(known->tiers.sign_tiers.begin(), known->tiers.sign_tiers.end(),
                  [&](const TierNames::SignTier& tier) { return document.find_tier(tier.id) != nullptr; }) &&
      std::all_of(known->tiers.phase_tiers.begin(), known->tiers.phase_tiers.end(),
                  [&](const std::string& tier) { return document.find_tier(tier) != nullptr; });
  const TierNames other = as_before ? known->tiers : guess_tier_names(document);
  if (names.phase_labels.empty() && as_before) names.phase_labels = known->tiers.phase_labels;
  const bool no_signs = options.no_sign_tier && names.sign_tiers.empty();
  if (names.sign_tiers.empty() && !no_signs) {
    names.sign_tiers = other.sign_tiers;
    std::string told;
    for (const TierNames::SignTier& tier : names.sign_tiers) {
      told += fmt::format("{}'{}'", told.empty() ? "" : ", ", tier.id);
      if (tier.hand != Hand::both) told += fmt::format(" ({} hand)", name_of(tier.hand));
    }
    if (told.empty() && as_before) {
      notices.push_back({where, "no tier is taken for signs, as before", {{"sign_tier", ""}}});
    } else if (told.empty()) {
      notices.push_back({where, "no tier looks like glosses, so no sign was found", {{"sign_tier", ""}}});
    } else if (!as_before) {
      notices.push_back({where, fmt::format("sign tier {} guessed", told)});
    }
  }
  if (names.phase_tiers.empty() && !options.no_phase_tier && !no_signs) {
    names.phase_tiers = other.phase_tiers;
    std::string told;
    for (const std::string& tier : names.phase_tiers) told += fmt::format("{}'{}'", told.empty() ? "" : ", ", tier);
    if (!told.empty() && !as_before) notices.push_back({where, fmt::format("phase tier {} guessed", told)});
  }
  for (const TierNames::SignTier& tier : names.sign_tiers) {
    if (std::ranges::find(names.phase_tiers, tier.id) == names.phase_tiers.end()) continue;
    throw Error(
        ErrorCode::bad_input,
        fmt::format("{}: tier '{}' is taken for signs and for phases; name another for one of them", where, tier.id),
        {{"sign_tier", ""}, {"phase_tier", ""}});
  }
  return names;
}

/// The annotation time of frame 0 that the document itself gives for a motion file, or none.
std::optional<Seconds> linked_origin(const AnnotationDocument& document, const std::string& motion_file) {
  for (const LinkedFile& linked : document.linked_files) {
    for (const std::string& url : {linked.url, linked.relative_url}) {
      if (linked_file_name(url) == motion_file) return -Seconds(linked.time_origin);
    }
  }
  return std::nullopt;
}

/// A clock that a person set, or none. Throws for one that no recording can have.
std::optional<FrameClock> given_clock(const ImportJob& job, const ImportOptions& options, FrameRate rate) {
  FrameClock clock{rate.frame_time(), Seconds(0)};
  if (options.sync.size() == 2) {
    const SyncPoint& first = options.sync[0];
    const SyncPoint& second = options.sync[1];
    if (first.frame == second.frame) {
      throw Error(ErrorCode::bad_input,
                  fmt::format("sync: both points are at frame {:g}; give two frames", first.frame));
    }
    clock.frame_time = (second.time - first.time) / (second.frame - first.frame);
    clock.origin = first.time - first.frame * clock.frame_time;
  } else if (!options.sync.empty()) {
    throw Error(ErrorCode::bad_input, "sync: give two points", {{"offset_ms", ""}});
  } else if (job.offset || options.offset) {
    clock.origin = job.offset ? *job.offset : *options.offset;
  } else {
    return std::nullopt;
  }
  const double drift = clock.frame_time / rate.frame_time();
  if (!(std::abs(clock.origin.count()) <= 1e6) || !(drift > 0.5 && drift < 2.0)) {
    if (options.sync.empty()) {
      throw Error(ErrorCode::bad_input, "offset_ms: an offset is a number of milliseconds, at most 1,000,000,000");
    }
    throw Error(ErrorCode::bad_input,
                fmt::format("sync: frame 0 would be at {:.6g} s and a frame {:.6g} times as long as in the "
                            "motion file; give the two points in the order of their times",
                            clock.origin.count(), drift));
  }
  return clock;
}

/// The notices of the half of a recording that stays: those about its file, and those about the recording come anew.
void keep_notices(const RecordingInfo& known, const std::string& file, std::vector<Notice>& notices) {
  if (file.empty()) return;
  for (const Notice& notice : known.notices) {
    if (notice.where == file || notice.where.ends_with('/' + file) ||
        notice.where.find(file + ':') != std::string::npos) {
      notices.push_back(notice);
    }
  }
}

/// What was guessed of the skeleton, and what is odd about it.
void add_rig_notices(const Motion& motion, const ImportOptions& options, const RecordingInfo* known,
                     const ImportJob& job, std::vector<Notice>& notices) {
  const RigNames names = options.rig ? *options.rig : known != nullptr ? known->rig : RigNames{};
  try {
    for (const Notice& notice : map_rig(motion, names).notices)
      notices.push_back({job.motion->string(), notice.text, notice.remedies});
  } catch (const Error&) {  // names that do not fit: storing it says so
  }
}

/// Signs that lie outside the motion can be found but not signed: say so.
void report_uncovered(const std::vector<Sign>& signs, const FrameClock& clock, std::int64_t frames,
                      const std::string& where, std::vector<Notice>& notices) {
  std::size_t outside = 0;
  std::string first;
  for (const Sign& sign : signs) {
    const FrameRange range = frames_of(sign.span, clock);
    if (range.begin >= 0 && range.end <= frames) continue;
    if (outside++ == 0) first = fmt::format("{} at {} ms", sign.gloss, sign.span.begin.count());
  }
  if (outside == 0) return;
  notices.push_back({where,
                     fmt::format("{} of {} signs lie outside the motion (the first: {}); do both start "
                                 "together?",
                                 outside, signs.size(), first),
                     {{"offset_ms", ""}, {"sync", ""}}});
}

}  // namespace

namespace {

/// What is stored of a job's files already, if anything: under the job's name, or under the shorter name that the same
/// files had before another file of the same stem came beside them.
std::optional<RecordingInfo> find_known(const Database& database, const ImportJob& job, std::uint64_t motion_print,
                                        std::uint64_t annotation_print) {
  for (std::size_t from = job.name_told ? std::string::npos : job.name.rfind('/');
       from != std::string::npos && from > 0; from = job.name.rfind('/', from - 1)) {
    std::optional<RecordingInfo> shorter = database.info(job.name.substr(from + 1));
    if (!shorter) continue;
    if (job.motion ? shorter->motion_fingerprint == motion_print
                   : shorter->annotation_fingerprint == annotation_print) {
      return shorter;
    }
  }
  return database.info(job.name);
}

/// Throws where the recording has another annotation than the one that is to be replaced.
void check_annotation(const std::string& expected, const std::optional<RecordingInfo>& known, const ImportJob& job) {
  const std::string found = known ? annotation_fingerprint(*known) : "none";
  if (found == expected) return;
  throw Error(ErrorCode::conflict,
              fmt::format("{}: the annotation of recording '{}' is no longer {} but {}; look at what is stored now, "
                          "and import again",
                          job.annotation->string(), known ? known->name : job.name, expected, found),
              {{"if_annotation", found}});
}

}  // namespace

std::string annotation_fingerprint(const RecordingInfo& info) {
  return info.document == 0 ? "none" : fmt::format("{:016x}", info.annotation_fingerprint);
}

ImportReport import_recording(Database& database, const ImportJob& job, const ImportOptions& options,
                              const Database::Progress& progress) {
  const std::uint64_t motion_print = job.motion ? motion_file::fingerprint(*job.motion, options.motion) : 0;
  const std::uint64_t annotation_print = job.annotation ? annotation_file::fingerprint(*job.annotation) : 0;
  const std::optional<RecordingInfo> known = find_known(database, job, motion_print, annotation_print);
  const bool motion_known = known && known->motion;
  const bool document_known = known && known->document != 0;
  const bool same_motion = motion_known && known->motion_fingerprint == motion_print &&
                           !reads_otherwise(*job.motion, options.motion, *known);
  // A face is a part of the motion. One that comes to a motion without replaces nothing, so it needs no leave.
  const std::uint64_t face_print = job.face ? file_checksum(*job.face) : 0;
  const bool new_face = job.face && same_motion && known->face_file.empty();
  const Seconds face_before = known ? known->face_offset : Seconds(0);
  const Seconds face_start =
      job.face
          ? given_face_offset(*job.face, job.face_offset ? job.face_offset : options.face_offset, options.face_timecode)
                .value_or(face_before)
          : face_before;
  const bool moved_face = std::abs((face_start - face_before).count()) > 1e-9;
  const bool other_face = job.face && same_motion && !new_face && (known->face_fingerprint != face_print || moved_face);
  const bool new_motion = job.motion && (!same_motion || new_face || other_face || options.replace_motion);

  ImportReport report;
  Recording recording;
  report.name = recording.name = known ? known->name : job.name;
  recording.signer_given = !job.signer.empty() || (known && known->signer_given);
  recording.signer = !job.signer.empty() ? job.signer : recording.signer_given ? known->signer : "";
  if (other_face && !options.replace_motion) {
    throw Error(ErrorCode::conflict,
                fmt::format("{}: {} recording '{}' was imported with", job.face->string(),
                            known->face_fingerprint == face_print ? "lies elsewhere in the motion than the face that"
                                                                  : "is not the face that",
                            recording.name),
                {{"replace_motion", "true"}});
  }
  if (new_motion && motion_known && !new_face && !options.replace_motion) {
    throw Error(
        ErrorCode::conflict,
        fmt::format("{}: is not the motion that recording '{}' was imported from (or is read with other options); "
                    "replace it, or import it under another file name as another recording",
                    job.motion->string(), recording.name),
        {{"replace_motion", "true"}});
  }
  const bool same_annotation = document_known && known->annotation_fingerprint == annotation_print;
  if (options.if_annotation && job.annotation && !same_annotation) check_annotation(*options.if_annotation, known, job);
  const auto half = [](const Database::Progress& whole, double from) {
    return whole ? Database::Progress([&whole, from](double part) { whole(from + part / 2); }) : Database::Progress();
  };

  // The annotation: read where it is new, or where it may have to be read otherwise.
  std::optional<AnnotationDocument> document;
  TierNames names;
  bool new_annotation = false;
  std::vector<Notice> annotation_notices;
  const bool options_about_tiers = !options.sign_tiers.empty() || !options.phase_tiers.empty() ||
                                   !options.phase_labels.empty() || options.no_sign_tier || options.no_phase_tier;
  if (job.annotation && (!same_annotation || options_about_tiers)) {
    const std::string where = job.annotation->string();
    using annotation_file::Unsound;
    const Unsound unsound = options.strict ? Unsound::refused : Unsound::left_out;
    annotation_file::File file = annotation_file::read(*job.annotation, unsound);
    annotation_notices = std::move(file.notices);
    names = tier_names(file.document, options, known ? &*known : nullptr, where, annotation_notices);
    document = std::move(file.document);
    new_annotation = !same_annotation || names != known->tiers;
  } else if (document_known) {
    try {
      document = database.document(recording.name);
      names = known->tiers;
    } catch (const Error& error) {
      // Damaged: the file, which is the same, takes its place.
      if (error.code() != ErrorCode::corrupt || !job.annotation) throw;
      document = annotation_file::read(*job.annotation).document;
      names = known->tiers;
      new_annotation = true;
    }
  }
  recording.tiers_given = options_about_tiers || (known && known->tiers_given);
  std::vector<Sign> signs;
  if (document) {
    const std::string where = job.annotation ? job.annotation->string() : recording.name;
    try {
      SignsFound found = signs_in(*document, names);
      signs = std::move(found.signs);
      for (Notice& notice : found.notices) {
        notice.where = notice.where.empty() ? where : where + ": " + notice.where;
        annotation_notices.push_back(std::move(notice));
      }
    } catch (const Error& error) {  // a tier that was named and is not there: say in which file
      throw Error(error.code(), fmt::format("{}: {}", where, error.what()), error.remedies());
    }
    if (recording.signer.empty() && !signs.empty()) recording.signer = signs[0].signer;
  }

  // The motion.
  FrameRate rate = motion_known ? known->motion->rate : FrameRate{};
  report.frames = motion_known ? known->motion->frames : 0;
  // A motion without a layout may have tracks of its own, which a face before may have stood instead of: it is read
  // anew.
  if ((new_face || other_face) && known->layout) {  // to the motion as it was read then, whatever it was read with
    Motion stored = database.read(recording.name);
    std::vector<ScalarTrack> tracks = stored.take_tracks();
    for (std::size_t i = 0; i < known->own_tracks; ++i) stored.add_track(std::move(tracks[i]));
    recording.motion = MotionPart{.motion = std::move(stored),
                                  .layout = known->layout,
                                  .file = known->motion_file,
                                  .fingerprint = motion_print,
                                  .face_file = {},
                                  .face_fingerprint = 0,
                                  .face_offset = known->face_offset,
                                  .reading = known->reading,
                                  .declarations = known->motion_declarations,
                                  .own_tracks = known->own_tracks,
                                  .rounded_within = known->motion->tolerance};
    keep_notices(*known, known->motion_file, recording.notices);
  } else if (new_motion) {
    motion_file::ReadOptions read_options = options.motion;
    if (known && !known->layout && motion_file::told(*job.motion, options.motion).empty()) {  // as it was told before
      read_options = motion_file::options_told(known->reading);
      read_options.skeleton = options.motion.skeleton;
    }
    read_options.progress = half(progress, 0);
    motion_file::File file = motion_file::read(*job.motion, read_options);
    rate = file.motion.rate();
    report.frames = file.motion.frame_count();
    recording.notices = std::move(file.notices);
    if (report.frames > 0) add_rig_notices(file.motion, options, known ? &*known : nullptr, job, recording.notices);
    recording.motion = MotionPart{.motion = std::move(file.motion),
                                  .layout = std::move(file.layout),
                                  .file = job.motion->filename().string(),
                                  .fingerprint = motion_print,
                                  .face_file = {},
                                  .face_fingerprint = 0};
    recording.motion->declarations = std::move(file.declarations);
    if (!recording.motion->layout) recording.motion->reading = motion_file::told(*job.motion, read_options);
    recording.motion->own_tracks = recording.motion->motion.tracks().size();
    if (!job.face && known && !known->face_file.empty()) {
      recording.notices.push_back({known->face_file, "was not given again, so its face is gone"});
    }
  } else if (known) {
    keep_notices(*known, known->motion_file, recording.notices);
    keep_notices(*known, known->face_file, recording.notices);
  }
  if (new_motion && job.face) {
    recording.motion->own_tracks = add_face(*job.face, face_start, recording.motion->motion, recording.notices);
    recording.motion->face_file = job.face->filename().string();
    recording.motion->face_fingerprint = face_print;
    recording.motion->face_offset = face_start;
  }
  if (new_annotation) {
    recording.notices.insert(recording.notices.end(), annotation_notices.begin(), annotation_notices.end());
  } else if (known) {
    keep_notices(*known, known->annotation_file, recording.notices);
  }

  // The clock: as given now; as given before; as the document says; else both begin together.
  const bool has_motion = new_motion || motion_known;
  bool new_clock = false;
  if (has_motion) {
    const std::string motion_file = job.motion ? job.motion->filename().string() : known->motion_file;
    const std::optional<FrameClock> given = given_clock(job, options, rate);
    recording.clock_given = given || (known && known->clock_given);
    recording.clock = {rate.frame_time(), Seconds(0)};
    if (given) {
      recording.clock = *given;
    } else if (recording.clock_given) {  // with the drift it had, whatever the rate now is
      recording.clock.origin = known->clock.origin;
      if (motion_known) recording.clock.frame_time *= known->clock.frame_time / known->motion->rate.frame_time();
    } else if (document) {
      std::optional<Seconds> origin = linked_origin(*document, motion_file);
      if (!origin && known) origin = linked_origin(*document, known->motion_file);
      recording.clock.origin = origin.value_or(Seconds(0));
    }
  } else if (options.offset || job.offset) {  // for a motion that is to come
    recording.clock = *given_clock(job, options, rate);
    recording.clock_given = true;
  } else if (!options.sync.empty()) {
    throw Error(ErrorCode::bad_input,
                recording.name + ": sync points need the motion; import it too, or give an offset",
                {{"offset_ms", ""}});
  } else if (known) {
    recording.clock = known->clock;
    recording.clock_given = known->clock_given;
  }
  if (known && !new_motion) {
    new_clock = std::abs((recording.clock.origin - known->clock.origin).count()) > 1e-9 ||
                std::abs(recording.clock.frame_time / known->clock.frame_time - 1.0) > 1e-12 ||
                recording.clock_given != known->clock_given;
  }
  recording.rig = options.rig;
  const bool new_rig = known && options.rig && *options.rig != known->rig;
  if (known && !new_motion && !new_annotation && !new_clock && !new_rig && recording.signer == known->signer) {
    if (database.measure(known->name)) report.outcome = ImportOutcome::measured;
    return report;
  }

  if (has_motion && document)
    report_uncovered(signs, recording.clock, report.frames, recording.name, recording.notices);
  if (!has_motion)
    recording.notices.push_back({recording.name, "annotation without motion: it can be searched, not signed"});
  if (!document)
    recording.notices.push_back({recording.name, "motion without annotation: it can be read, not searched"});
  if (new_annotation) {
    recording.annotation = AnnotationPart{.document = std::move(*document),
                                          .tiers = std::move(names),
                                          .file = job.annotation->filename().string(),
                                          .fingerprint = annotation_print};
  }
  try {
    database.put(recording, half(progress, 0.5));
  } catch (const Error& error) {  // of a mapping file that does not fit
    if (options.rig && !options.rig->empty() && error.code() != ErrorCode::io) {
      throw Error(error.code(), fmt::format("{}: its mapping file: {}", recording.name, error.what()),
                  error.remedies());
    }
    if (options.rig || !known || known->rig.empty() || error.code() != ErrorCode::not_found) throw;
    throw Error(error.code(),
                fmt::format("{}: the mapping file of an earlier import says {}; give another, or "
                            "an empty file to forget it",
                            recording.name, error.what()),
                {{"rig", ""}});
  }
  report.signs = signs.size();
  report.tracks = recording.motion ? recording.motion->motion.tracks().size()
                  : motion_known   ? known->motion->tracks.size()
                                   : 0;
  report.notices = recording.notices;
  report.defects = database.info(recording.name)->defects.size();
  if (has_motion && (document_known || new_annotation)) report.not_measured = database.features(recording.name).why_not;
  report.outcome = !known                              ? ImportOutcome::added
                   : new_motion && !motion_known       ? ImportOutcome::motion_added
                   : new_annotation && !document_known ? ImportOutcome::annotation_added
                   : new_face                          ? ImportOutcome::face_added
                   : new_motion                        ? ImportOutcome::motion_replaced
                   : new_annotation                    ? ImportOutcome::annotation_replaced
                                                       : ImportOutcome::clock_changed;
  return report;
}

std::map<std::string, PhaseKind> read_phase_labels(const fs::path& path) {
  constexpr PhaseKind kKinds[] = {PhaseKind::preparation, PhaseKind::stroke, PhaseKind::retraction, PhaseKind::hold};
  std::map<std::string, PhaseKind> labels;
  const std::string text = read_file(path, std::size_t{1} << 20);
  std::size_t line_number = 0;
  for (std::size_t begin = 0; begin < text.size();) {
    const std::size_t end = std::min(text.find('\n', begin), text.size());
    const std::string_view line = trimmed(std::string_view(text).substr(begin, end - begin));
    begin = end + 1;
    ++line_number;
    if (line.empty() || line.front() == '#') continue;
    const std::size_t sign = line.rfind('=');
    const std::string_view kind = sign == line.npos ? std::string_view() : trimmed(line.substr(sign + 1));
    const auto* known = std::find_if(std::begin(kKinds), std::end(kKinds),
                                     [&](PhaseKind candidate) { return name_of(candidate) == kind; });
    if (known == std::end(kKinds)) {
      throw Error(ErrorCode::bad_input, fmt::format("{}:{}: expected LABEL = preparation, stroke, retraction or hold",
                                                    path.string(), line_number));
    }
    labels[fold_case(match_form(line.substr(0, sign)))] = *known;
  }
  return labels;
}

}  // namespace signweave
