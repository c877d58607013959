#include "app/cli/output.h"

#include <fmt/format.h>

#include <filesystem>
#include <nlohmann/json.hpp>

#include "signweave/core/atomic_file.h"
#include "signweave/core/text.h"
#include "signweave/formats/contact_sheet.h"
#include "signweave/formats/eaf.h"
#include "signweave/formats/face_csv.h"
#include "signweave/formats/gltf.h"
#include "signweave/formats/positions_csv.h"
#include "signweave/synthesis/provenance.h"

namespace signweave::cli {
namespace {

using nlohmann::json;
namespace fs = std::filesystem;

constexpr const char* kFace = ".face.csv";
constexpr const char* kEndings[] = {".bvh", ".glb", ".gltf", ".eaf", ".json", ".csv", kFace, ".svg"};

std::string ending_of(const std::string& path) {
  const std::string name = fold_case(fs::path(path).filename().string());
  return name.ends_with(kFace) ? kFace : fs::path(name).extension().string();
}

void write_text(const std::string& path, const std::string& text) {
  AtomicFile file(path);
  file.write(text);
  file.commit();
}

json json_of(const Motion& motion) {
  json joints = json::array();
  for (const Joint& joint : motion.skeleton().joints()) {
    joints.push_back({{"name", joint.name},
                      {"parent", joint.parent},
                      {"offset", {joint.offset.x(), joint.offset.y(), joint.offset.z()}},
                      {"translated", joint.translated}});
  }
  json rotations = json::array();
  json translations = json::array();
  for (std::int64_t frame = 0; frame < motion.frame_count(); ++frame) {
    const PoseView pose = motion.pose(frame);
    json row = json::array();
    for (const Eigen::Quaternionf& q : pose.rotations) row.insert(row.end(), {q.x(), q.y(), q.z(), q.w()});
    rotations.push_back(std::move(row));
    row = json::array();
    for (const Eigen::Vector3f& t : pose.translations) row.insert(row.end(), {t.x(), t.y(), t.z()});
    translations.push_back(std::move(row));
  }
  json tracks = json::object();
  for (const ScalarTrack& track : motion.tracks()) tracks[track.name] = track.values;
  return {{"frames_per_second", motion.rate().hertz()},
          {"frames", motion.frame_count()},
          {"joints", std::move(joints)},
          {"rotations_xyzw", std::move(rotations)},
          {"translations_m", std::move(translations)},
          {"tracks", std::move(tracks)}};
}

json declarations_json(const std::vector<std::pair<std::string, std::string>>& declarations) {
  json object = json::object();
  for (const auto& [name, value] : declarations) object[name] = value;
  return object;
}

std::string note_of(const std::vector<std::pair<std::string, std::string>>& declarations) {
  std::string note;
  for (const auto& [name, value] : declarations) note += (note.empty() ? "" : "; ") + value;
  return note;
}

json span_json(TimeSpan span) {
  return {{"begin_ms", span.begin.count()}, {"end_ms", span.end.count()}};
}

json frames_json(FrameRange frames) {
  return {{"begin", frames.begin}, {"end", frames.end}};
}

/// Before the first file is written: that each has a folder to go to.
void check_folders(const std::vector<std::string>& paths) {
  for (const std::string& path : paths) {
    const fs::path folder = fs::path(path).parent_path();
    std::error_code ignored;
    if (!folder.empty() && !fs::is_directory(folder, ignored)) {
      throw Error(ErrorCode::io, fmt::format("{}: there is no folder '{}'; make it first", path, folder.string()));
    }
  }
}

/// What a motion written without its own layout looks like.
bvh::Layout layout_for(const std::optional<bvh::Layout>& layout, const Skeleton& skeleton) {
  return layout && bvh::fits(*layout, skeleton) ? *layout : bvh::default_layout(skeleton);
}

/// One cell of a contact sheet per stroke and per junction: what a person wants to look at.
ContactSheetOptions sheet_options(const Synthesis& synthesis, const std::string& title) {
  ContactSheetOptions options;
  options.title = title;
  options.note = note_of(synthesis.declarations);
  enum class Worth { side, middle, junction };  // in a long result the last go last
  struct Cell {
    std::int64_t frame;
    std::string caption;
    Worth worth;
  };
  std::vector<Cell> cells;
  const double hertz = synthesis.motion.rate().hertz();
  const auto frame_of = [&](Milliseconds time) {
    return std::clamp<std::int64_t>(std::llround(Seconds(time).count() * hertz), 0, synthesis.motion.frame_count() - 1);
  };
  for (const PlacedSign& placed : synthesis.signs) {
    const auto stroke = placed.sign.stroke_span();
    if (!stroke) continue;
    const auto add = [&](double part, const char* mark, Worth worth) {
      const Milliseconds at =
          stroke->begin + Milliseconds(std::llround(static_cast<double>(stroke->duration().count()) * part));
      cells.push_back({frame_of(at), placed.sign.gloss + mark, worth});
    };
    add(0.1, " ·", Worth::side);
    add(0.5, " ··", Worth::middle);
    add(0.9, " ···", Worth::side);
  }
  for (std::size_t i = 0; i < synthesis.stretches.size(); ++i) {  // bare pieces have no sign to show
    const Placed& placed = synthesis.stretches[i];
    const bool bare = std::none_of(synthesis.signs.begin(), synthesis.signs.end(),
                                   [&](const PlacedSign& sign) { return sign.stretch == i; });
    for (const int part : {1, 5, 9}) {
      const Worth worth = part == 5 ? Worth::middle : Worth::side;
      if (bare) cells.push_back({placed.core.begin + placed.core.size() * part / 10, placed.recording, worth});
    }
  }
  for (const Junction& junction : synthesis.junctions) {
    const std::int64_t middle = (junction.frames.begin + junction.frames.end) / 2;
    cells.push_back({middle, junction.from + " → " + junction.to, Worth::junction});
  }
  std::stable_sort(cells.begin(), cells.end(), [](const Cell& a, const Cell& b) { return a.frame < b.frame; });
  options.most_cells = 96;  // what still can be looked at
  for (const Cell& cell : cells) {
    options.frames.push_back(cell.frame);
    options.captions.push_back(cell.caption);
    options.importance.push_back(static_cast<int>(cell.worth));
  }
  return options;
}

}  // namespace

std::string writable_endings() {
  std::string list;
  for (const char* ending : kEndings) list += (list.empty() ? "" : " ") + std::string(ending);
  return list;
}

std::string check_output(const std::string& path) {
  const std::string ending = ending_of(path);
  for (const char* known : kEndings) {
    if (ending == known) return {};
  }
  return "'" + printable(path) + "' ends in none of " + writable_endings();
}

void check_signing_space(bool wanted, const std::vector<std::string>& paths) {
  const auto is_sheet = [](const std::string& path) { return ending_of(path) == ".svg"; };
  if (!wanted || std::any_of(paths.begin(), paths.end(), is_sheet)) return;
  throw Error(ErrorCode::bad_input, "--signing-space is drawn on contact sheets: add -o FILE.svg");
}

json describe(const Synthesis& synthesis) {
  json signs = json::array();
  for (const PlacedSign& placed : synthesis.signs) {
    json phases = json::array();
    for (const Phase& phase : placed.sign.phases) {
      json one = span_json(phase.span);
      one["kind"] = name_of(phase.kind);
      phases.push_back(std::move(one));
    }
    json sign = span_json(placed.sign.span);
    sign["gloss"] = placed.sign.gloss;
    sign["recording"] = synthesis.stretches[placed.stretch].recording;
    sign["recorded"] = span_json(placed.recorded);
    sign["phases"] = std::move(phases);
    signs.push_back(std::move(sign));
  }
  json stretches = json::array();
  for (const Placed& placed : synthesis.stretches) {
    stretches.push_back({{"recording", placed.recording},
                         {"frames", frames_json(placed.output)},
                         {"kept_frames", frames_json(placed.core)},
                         {"kept_from_recorded_frame", placed.first_frame},
                         {"recorded_frames_per_frame", placed.step}});
  }
  json junctions = json::array();
  for (const Junction& junction : synthesis.junctions) {
    json parts = json::object();
    for (const Timed part : kAllTimed) {
      const TransitionCut& cut = junction.cuts[static_cast<std::size_t>(part)];
      parts[std::string(name_of(part))] = {{"retraction_frames", cut.retraction_frames},
                                           {"preparation_frames", cut.preparation_frames},
                                           {"waits", cut.waits}};
    }
    junctions.push_back({{"from", junction.from},
                         {"to", junction.to},
                         {"method", junction.method},
                         {"frames", frames_json(junction.frames)},
                         {"retraction_frames", junction.cut.retraction_frames},
                         {"preparation_frames", junction.cut.preparation_frames},
                         {"blend_frames", junction.cut.blend_frames},
                         {"parts", std::move(parts)}});
  }
  return {{"frames", synthesis.motion.frame_count()},
          {"frames_per_second", synthesis.motion.rate().hertz()},
          {"signs", std::move(signs)},
          {"stretches", std::move(stretches)},
          {"junctions", std::move(junctions)}};
}

void write_synthesis(const std::vector<std::string>& paths, const Synthesized& made,
                     const std::optional<bvh::Layout>& layout, const SheetWishes& sheet) {
  const Synthesis& result = made.result;
  std::string motion_file;
  check_folders(paths);
  for (const std::string& path : paths) {
    if (ending_of(path) == ".bvh") motion_file = fs::path(path).filename().string();
  }
  for (const std::string& path : paths) {
    const std::string ending = ending_of(path);
    if (ending == ".eaf") {
      eaf::write(path, annotation_of(result, motion_file));
    } else if (ending == ".json") {
      json document = describe(result);
      json sources = json::array();
      for (const FrameSource& source : result.sources) {
        // Each output frame: its recording's stretch and frame, or the junction that made it.
        if (source.stretch != FrameSource::kNone) {
          sources.push_back({{"stretch", source.stretch}, {"frame", source.frame}});
        } else {
          sources.push_back({{"junction", source.junction}});
        }
      }
      document["sources"] = std::move(sources);
      document["declarations"] = declarations_json(result.declarations);
      document["motion"] = json_of(result.motion);
      write_text(path, document.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace) + '\n');
    } else if (ending == ".svg") {
      ContactSheetOptions options = sheet_options(result, sheet.title);
      options.signing_space = sheet.signing_space;
      options.rig = map_rig(result.motion, sheet.rig);
      write_text(path, contact_sheet(result.motion, options));
    } else {
      write_recording(path, {.motion = &result.motion,
                             .layout = layout,
                             .title = sheet.title,
                             .rig = sheet.rig,
                             .declarations = result.declarations});
    }
  }
}

void write_recording(const std::string& path, const Outgoing& recording) {
  const std::string ending = ending_of(path);
  if (ending == ".eaf") {
    if (recording.document == nullptr) {
      throw Error(ErrorCode::not_found, path + ": the recording has no annotation to write");
    }
    eaf::write(path, *recording.document);
    return;
  }
  if (recording.motion == nullptr) throw Error(ErrorCode::not_found, path + ": the recording has no motion to write");
  const Motion& motion = *recording.motion;
  if (ending == ".bvh") {
    bvh::write(path, motion, layout_for(recording.layout, motion.skeleton()));
  } else if (ending == ".glb" || ending == ".gltf") {
    gltf::write(path, motion,
                {.name = recording.title,
                 .declarations = recording.declarations,
                 .head = {},
                 .rig = map_rig(motion, recording.rig)});
  } else if (ending == ".csv") {
    write_positions_csv(path, motion);
  } else if (ending == kFace) {
    if (motion.tracks().empty()) throw Error(ErrorCode::not_found, path + ": the motion has no scalar tracks to write");
    write_text(path, face_csv::write_text(motion));
  } else if (ending == ".svg") {
    ContactSheetOptions options;
    options.title = recording.title;
    options.note = note_of(recording.declarations);
    options.signing_space = recording.signing_space;
    options.rig = map_rig(motion, recording.rig);
    write_text(path, contact_sheet(motion, options));
  } else {
    json document = json_of(motion);
    document["declarations"] = declarations_json(recording.declarations);
    write_text(path, document.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace) + '\n');
  }
}

}  // namespace signweave::cli
