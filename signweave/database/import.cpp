#include "signweave/database/import.h"

#include <fmt/format.h>

#include <algorithm>

#include "signweave/core/atomic_file.h"
#include "signweave/core/text.h"
#include "signweave/formats/eaf.h"

namespace signweave {
namespace {

namespace fs = std::filesystem;

std::uint64_t fingerprint(const fs::path& file, std::string_view options) {
  return checksum(bytes_of(fmt::format("{:x} {}", file_checksum(file), options)));
}

/// Everything that changes how a motion file is read.
std::string describe(const bvh::ReadOptions& options) {
  return fmt::format("up {} unit {} root {} columns {} mirror {}", options.up ? static_cast<int>(*options.up) : -1,
                     options.unit.value_or(0), options.root_unit.value_or(0), static_cast<int>(options.root_columns),
                     options.mirror);
}

/// Everything that changes what an annotation file means.
std::string describe(const ImportOptions& options, const ImportJob& job) {
  std::string text = fmt::format("signer {} offset {} {}", job.signer, options.offset.value_or(Seconds(-1e9)).count(),
                                 job.offset.value_or(Seconds(-1e9)).count());
  for (const SyncPoint& sync : options.sync) text += fmt::format(" sync {} {}", sync.frame, sync.time.count());
  for (const TierNames::SignTier& tier : options.sign_tiers) {
    text += fmt::format(" sign {:?} {} {}", tier.id, static_cast<int>(tier.hand), tier.signer);
  }
  for (const std::string& tier : options.phase_tiers) text += fmt::format(" phase {:?}", tier);
  for (const auto& [label, kind] : options.phase_labels)
    text += fmt::format(" label {:?} {}", label, static_cast<int>(kind));
  return text;
}

std::string quoted_list(const std::vector<std::string>& names) {
  std::string text;
  for (const std::string& name : names) text += (text.empty() ? "'" : ", '") + name + "'";
  return text;
}

/// The given tiers, else the guessed ones, with a notice that tells.
TierNames tier_names(const AnnotationDocument& document, const ImportOptions& options, const std::string& where,
                     std::vector<Notice>& notices) {
  TierNames names{options.sign_tiers, options.phase_tiers, options.phase_labels};
  if (!names.sign_tiers.empty() && !names.phase_tiers.empty()) return names;
  const TierNames guess = guess_tier_names(document);
  if (names.sign_tiers.empty()) {
    names.sign_tiers = guess.sign_tiers;
    std::vector<std::string> ids;
    for (const TierNames::SignTier& tier : names.sign_tiers) {
      ids.push_back(tier.hand == Hand::both ? tier.id : fmt::format("{}' ({} hand)", tier.id, name_of(tier.hand)));
    }
    if (ids.empty()) {
      notices.push_back({where, "no tier looks like glosses, so no sign was found; name one with --sign-tier"});
    } else {
      notices.push_back({where, fmt::format("sign tier {} guessed", quoted_list(ids))});
    }
  }
  if (names.phase_tiers.empty()) {
    names.phase_tiers = guess.phase_tiers;
    if (!names.phase_tiers.empty()) {
      notices.push_back({where, fmt::format("phase tier {} guessed", quoted_list(names.phase_tiers))});
    }
  }
  return names;
}

/// The annotation time of frame 0 that the document itself gives for a motion file, or none.
std::optional<Seconds> linked_origin(const AnnotationDocument& document, const std::string& motion_file) {
  for (const LinkedFile& linked : document.linked_files) {
    for (const std::string& url : {linked.url, linked.relative_url}) {
      if (url.ends_with(motion_file)) return -Seconds(linked.time_origin);
    }
  }
  return std::nullopt;
}

FrameClock clock_for(const ImportJob& job, const ImportOptions& options, FrameRate rate,
                     const AnnotationDocument* document) {
  FrameClock clock{rate.frame_time(), Seconds(0)};
  if (options.sync.size() == 2) {
    const auto& [first, second] = std::pair(options.sync[0], options.sync[1]);
    if (first.frame == second.frame || (second.time - first.time) / (second.frame - first.frame) <= Seconds(0)) {
      throw Error(ErrorCode::bad_input, "--sync: the two points must be two frames, in the order of their times");
    }
    clock.frame_time = (second.time - first.time) / (second.frame - first.frame);
    clock.origin = first.time - first.frame * clock.frame_time;
    return clock;
  }
  if (!options.sync.empty()) throw Error(ErrorCode::bad_input, "--sync: give two points, or use --offset-ms");
  if (job.offset) {
    clock.origin = *job.offset;
  } else if (options.offset) {
    clock.origin = *options.offset;
  } else if (document != nullptr && job.motion) {
    clock.origin = linked_origin(*document, job.motion->filename().string()).value_or(Seconds(0));
  }
  return clock;
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
  notices.push_back(
      {where, fmt::format("{} of {} signs lie outside the motion (the first: {}); if the two do not start "
                          "together, give --offset-ms or --sync",
                          outside, signs.size(), first)});
}

}  // namespace

ImportReport import_recording(Database& database, const ImportJob& job, const ImportOptions& options,
                              const Database::Progress& progress) {
  const std::optional<RecordingInfo> known = database.info(job.name);
  const std::uint64_t motion_print = job.motion ? fingerprint(*job.motion, describe(options.motion)) : 0;
  const std::uint64_t annotation_print = job.annotation ? fingerprint(*job.annotation, describe(options, job)) : 0;
  const bool motion_known = known && known->motion;
  const bool new_motion = job.motion && (!motion_known || known->motion_fingerprint != motion_print);
  bool new_annotation =
      job.annotation && (!known || known->document == 0 || known->annotation_fingerprint != annotation_print);

  ImportReport report;
  report.frames = motion_known ? known->motion->frames : 0;
  if (!new_motion && !new_annotation) return report;
  if (new_motion && motion_known && !options.replace_motion) {
    throw Error(
        ErrorCode::conflict,
        fmt::format("{}: is not the motion that recording '{}' was imported from (or is read with other options); "
                    "--replace-motion takes it, and another file name makes another recording",
                    job.motion->string(), job.name));
  }

  Recording recording{
      .name = job.name, .signer = job.signer, .motion = {}, .annotation = {}, .clock = {}, .notices = {}};
  if (recording.signer.empty() && known) recording.signer = known->signer;
  const auto half = [](const Database::Progress& whole, double from) {
    return whole ? Database::Progress([&whole, from](double part) { whole(from + part / 2); }) : Database::Progress();
  };
  FrameRate rate = motion_known ? known->motion->rate : FrameRate{};
  if (new_motion) {
    bvh::ReadOptions read_options = options.motion;
    read_options.progress = half(progress, 0);
    bvh::File file = bvh::read(*job.motion, read_options);
    rate = file.motion.rate();
    report.frames = file.motion.frame_count();
    recording.notices = std::move(file.notices);
    recording.motion = MotionPart{.motion = std::move(file.motion),
                                  .layout = std::move(file.layout),
                                  .file = job.motion->filename().string(),
                                  .fingerprint = motion_print};
  }
  std::optional<AnnotationDocument> document;
  std::vector<Sign> signs;
  if (new_annotation) {
    const std::string where = job.annotation->string();
    eaf::File file = eaf::read(*job.annotation);
    recording.notices.insert(recording.notices.end(), file.notices.begin(), file.notices.end());
    TierNames names = tier_names(file.document, options, where, recording.notices);
    SignsFound found = [&] {
      try {
        return signs_in(file.document, names);
      } catch (const Error& error) {  // a tier that was named and is not there: say in which file
        throw Error(error.code(), fmt::format("{}: {}", where, error.what()));
      }
    }();
    for (Notice& notice : found.notices) {
      if (notice.where.empty()) notice.where = where;
      recording.notices.push_back(std::move(notice));
    }
    signs = std::move(found.signs);
    document = file.document;
    if (recording.signer.empty() && !signs.empty()) recording.signer = signs[0].signer;
    recording.annotation = AnnotationPart{.document = std::move(file.document),
                                          .tiers = std::move(names),
                                          .file = job.annotation->filename().string(),
                                          .fingerprint = annotation_print};
  } else if (known && known->document != 0) {
    document = database.document(job.name);
    signs = signs_in(*document, known->tiers).signs;
  }
  report.signs = signs.size();
  const bool has_motion = new_motion || motion_known;
  if (has_motion) {
    recording.clock = clock_for(job, options, rate, document ? &*document : nullptr);
    if (document) report_uncovered(signs, recording.clock, report.frames, job.name, recording.notices);
  }
  if (!has_motion) recording.notices.push_back({job.name, "annotation without motion: it can be searched, not signed"});
  if (!document) recording.notices.push_back({job.name, "motion without annotation: it can be read, not searched"});

  database.put(recording, half(progress, 0.5));
  report.notices = recording.notices;
  if (!known) {
    report.outcome = ImportOutcome::added;
  } else {
    report.outcome = new_motion ? ImportOutcome::motion_replaced : ImportOutcome::annotation_replaced;
  }
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
