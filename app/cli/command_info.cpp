#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <ostream>
#include <set>

#include "app/cli/bind.h"
#include "app/cli/command.h"
#include "app/cli/info_database.h"
#include "app/cli/progress.h"
#include "app/cli/rig_report.h"
#include "app/wire/text.h"
#include "signweave/annotation/sign.h"
#include "signweave/backup/backup.h"
#include "signweave/calls/defect_report.h"
#include "signweave/calls/motion_reading.h"
#include "signweave/calls/table.h"
#include "signweave/core/atomic_file.h"
#include "signweave/core/text.h"
#include "signweave/formats/annotation_file.h"
#include "signweave/formats/face/face_csv.h"
#include "signweave/formats/file_format.h"
#include "signweave/notation/score_json.h"

namespace signweave::cli {
namespace {

using nlohmann::json;

std::string unit_name(double metres) {
  if (metres == 1.0) return "m";
  if (metres == 0.01) return "cm";
  if (metres == 0.001) return "mm";
  if (metres == 0.0254) return "in";
  return fmt::format("{:.6g} m", metres);
}

void info_of_motion(const std::string& path, const calls::MotionReading& motion_options, const std::string& rig_path,
                    Io& io) {
  motion_file::ReadOptions options = read_options(motion_options);
  Progress progress(io, "reading");
  options.progress = [&](double fraction) { progress.show(fraction); };
  const motion_file::File file = motion_file::read(path, options);
  progress.hide();
  const Skeleton& skeleton = file.motion.skeleton();
  const RigMap rig = rig_map_of(file.motion, rig_path);
  nlohmann::ordered_json fields = {{"file", path},
                                   {"format", file.format},
                                   {"frames", file.motion.frame_count()},
                                   {"frames_per_second", file.motion.rate().hertz()},
                                   {"seconds", file.motion.duration().count()},
                                   {"joints", skeleton.joint_count()},
                                   {"tips", skeleton.tips().size()},
                                   {"joints_with_translation", skeleton.translation_count()},
                                   {"scalar_tracks", file.motion.tracks().size()},
                                   {"root", skeleton.joint(0).name}};
  if (file.layout) {
    fields["up"] = file.layout->up == bvh::UpAxis::z ? "z" : "y";
    fields["unit"] = unit_name(file.layout->unit);
  }
  const std::vector<Defect> defects = find_defects(file.motion, rig);
  if (io.json) {
    auto names = nlohmann::ordered_json::array();
    for (const Joint& joint : skeleton.joints()) names.push_back(joint.name);
    fields["joint_names"] = std::move(names);
    fields["rig"] = answer_json(calls::rig_answer(skeleton, rig));
    fields["defects"] = answer_json(calls::defect_rows(defects, skeleton));
    fields["notices"] = answer_json(file.notices);
    io.out << text_of(fields);
    return;
  }
  fields["frames_per_second"] = to_string(file.motion.rate());
  fields["seconds"] = fmt::format("{:.3f}", file.motion.duration().count());
  print_pairs(io, fields);
  io.out << table_of(defects, skeleton, file.notices);
  print_notices(io, file.notices);
  print_rig(skeleton, rig, path, io);
}

/// "browInnerUp, jawOpen, mouthPucker and 49 more".
std::string short_list(const std::vector<std::string>& names) {
  constexpr std::size_t kMost = 3;
  std::string list;
  for (std::size_t i = 0; i < std::min(names.size(), kMost); ++i) list += (i > 0 ? ", " : "") + printable(names[i]);
  if (names.size() > kMost) list += fmt::format(" and {} more", names.size() - kMost);
  return list;
}

void info_of_face(const std::string& path, Io& io) {
  const face_csv::Face face = face_csv::read(path);
  std::vector<std::string> names;
  for (const ScalarTrack& track : face.tracks) names.push_back(track.name);
  const double seconds = face.times.back().count();
  const double rows_per_second = seconds > 0 ? static_cast<double>(face.times.size() - 1) / seconds : 0;
  nlohmann::ordered_json fields = {
      {"file", path},       {"format", "Live Link Face CSV"},     {"rows", face.times.size()},
      {"seconds", seconds}, {"rows_per_second", rows_per_second}, {"timecode_frames_per_second", face.rate.hertz()}};
  if (io.json) {
    fields["tracks"] = names;
    fields["notices"] = answer_json(face.notices);
    io.out << text_of(fields);
    return;
  }
  fields["rows_per_second"] = fmt::format("{:.2f}", rows_per_second);
  fields["timecode_frames_per_second"] = to_string(face.rate);
  fields["seconds"] = fmt::format("{:.3f}", seconds);
  fields["tracks"] = fmt::format("{}: {}", names.size(), short_list(names));
  print_pairs(io, fields);
  print_notices(io, face.notices);
}

void info_of_annotation(const std::string& path, Io& io) {
  const annotation_file::File file = annotation_file::read(path);
  const AnnotationDocument& document = file.document;
  const std::string format = document.source_format == SourceFormat::anvil ? "ANVIL" : "EAF " + document.format;
  const TierNames names = guess_tier_names(document);
  const SignsFound found = signs_in(document, names);
  const auto role_of = [&](const std::string& id) -> std::string {
    for (const TierNames::SignTier& tier : names.sign_tiers) {
      if (tier.id == id) return tier.hand == Hand::both ? "signs" : fmt::format("signs, {} hand", name_of(tier.hand));
    }
    return std::find(names.phase_tiers.begin(), names.phase_tiers.end(), id) != names.phase_tiers.end() ? "phases" : "";
  };
  std::vector<Notice> notices = file.notices;
  for (const Notice& notice : found.notices) {
    notices.push_back({notice.where.empty() ? path : path + ": " + notice.where, notice.text, notice.remedies});
  }
  if (io.json) {
    json tiers = json::array();
    for (const Tier& tier : document.tiers) {
      tiers.push_back({{"id", tier.id},
                       {"type", tier.type},
                       {"parent", tier.parent},
                       {"annotations", tier.annotations.size()},
                       {"role", role_of(tier.id)}});
    }
    io.out << text_of(json{{"file", path},
                           {"format", format},
                           {"tiers", std::move(tiers)},
                           {"signs", found.signs.size()},
                           {"notices", answer_json<nlohmann::json>(notices)}});
    return;
  }
  std::size_t annotations = 0;
  for (const Tier& tier : document.tiers) annotations += tier.annotations.size();
  io.out << fmt::format("{}: {}, {}, {}, {}\n", path, format, counted(document.tiers.size(), "tier"),
                        counted(annotations, "annotation"), counted(found.signs.size(), "sign"));
  std::vector<std::vector<std::string>> rows = {{"tier", "parent", "type", "annotations", "taken as"}};
  for (const Tier& tier : document.tiers) {
    rows.push_back({tier.id, tier.parent, tier.type, std::to_string(tier.annotations.size()), role_of(tier.id)});
  }
  io.out << format_table(rows);
  print_notices(io, notices);
}

/// Prints what a score contains; with --json, what it is about.
void info_of_score(const std::string& path, Io& io) {
  const Score score = score_from_json(read_file(path, kLargestScore), path);
  if (!io.json) {
    io.out << to_string(score);
    return;
  }
  std::set<std::string> recordings;
  for (const Clip& clip : score.clips) {
    if (!clip.source.recording.empty()) recordings.insert(clip.source.recording);
  }
  io.out << text_of(json{{"file", path},
                         {"format", "score"},
                         {"frames", score.frames},
                         {"frames_per_second", score.rate.hertz()},
                         {"clips", score.clips.size()},
                         {"recordings", recordings}});
}

}  // namespace

Run info(CLI::App& verb) {
  struct InfoArguments {
    std::string path;
    std::string recording;
    std::string rig;
    calls::MotionReading motion;
  };
  auto options = std::make_shared<InfoArguments>();
  verb.add_option("PATH", options->path,
                  "a database, a backup, a motion file " + readable_extensions(FileKind::motion) +
                      ", an annotation file " + readable_extensions(FileKind::annotation) +
                      ", a face capture (.face.csv) or a score (.json)")
      ->required();
  verb.add_option("RECORDING", options->recording, "of a database: everything known about this recording");
  verb.add_option("--rig", options->rig, "a mapping file (part = joint) that assigns joints to parts of the body")
      ->type_name("FILE");
  bind(verb, options->motion);
  return [options](Io& io) {
    const FileFormat* format = file_format(options->path);
    const FileKind kind = format == nullptr || !format->reads ? FileKind::product : format->kind;
    if (!options->rig.empty() && kind != FileKind::motion) {
      throw CLI::ValidationError("--rig", "is about a motion file; a recording's mapping is given by import --rig");
    }
    std::error_code ignored;
    if (std::filesystem::is_directory(options->path, ignored)) {
      if (is_backup(options->path)) {
        info_of_backup(options->path, io);
      } else if (options->recording.empty()) {
        info_of_database(options->path, io);
      } else {
        info_of_recording(options->path, options->recording, io);
      }
    } else if (!options->recording.empty()) {
      throw CLI::ValidationError(options->path + " is not a database, so it has no recording " + options->recording);
    } else if (!std::filesystem::exists(options->path, ignored)) {
      throw Error(ErrorCode::not_found, options->path + ": no such file or database");
    } else if (!std::filesystem::is_regular_file(options->path, ignored)) {
      throw Error(ErrorCode::bad_input, options->path + ": is not a file");
    } else if (kind == FileKind::motion) {
      info_of_motion(options->path, options->motion, options->rig, io);
    } else if (kind == FileKind::annotation) {
      info_of_annotation(options->path, io);
    } else if (kind == FileKind::face) {
      info_of_face(options->path, io);
    } else if (fold_case(std::filesystem::path(options->path).extension().string()) == ".json") {
      info_of_score(options->path, io);
    } else if (kind == FileKind::motion_part) {
      throw Error(ErrorCode::unsupported, options->path +
                                              ": holds no motion of its own; name a motion file next to it " +
                                              readable_extensions(FileKind::motion));
    } else {
      throw Error(ErrorCode::unsupported,
                  options->path + ": of a kind that cannot be read; signweave formats lists those that can");
    }
  };
}

}  // namespace signweave::cli
