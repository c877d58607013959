#include "app/calls/files.h"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <filesystem>

#include "app/calls/json.h"
#include "app/calls/synthesis_report.h"
#include "app/calls/table.h"
#include "signweave/core/atomic_file.h"
#include "signweave/core/text.h"
#include "signweave/core/time.h"
#include "signweave/drawing/contact_sheet.h"
#include "signweave/formats/csv/positions_csv.h"
#include "signweave/formats/csv/rotations_csv.h"
#include "signweave/formats/eaf/eaf.h"
#include "signweave/formats/face/face_csv.h"
#include "signweave/formats/file_format.h"
#include "signweave/formats/gltf/character.h"
#include "signweave/formats/gltf/gltf.h"
#include "signweave/score/provenance.h"

namespace signweave::calls {
namespace {

using nlohmann::json;
namespace fs = std::filesystem;

void write_text(const std::string& path, const std::string& text) {
  AtomicFile file(path);
  file.write(text);
  file.commit();
}

json motion_json(const Motion& motion) {
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

/// A synthesis whole: what `describe` tells, every pose, and where each frame is from.
std::string synthesis_json(const Synthesis& result) {
  json document = describe(result);
  json sources = json::array();
  for (const FrameSource& source : result.sources) {
    // Each output frame: its recording's clip and frame, or the junction that made it.
    if (source.clip != FrameSource::kNone) {
      sources.push_back({{"stretch", source.clip}, {"frame", source.frame}});
    } else {
      sources.push_back({{"junction", source.junction}});
    }
  }
  document["sources"] = std::move(sources);
  document["declarations"] = declarations_json(result.declarations);
  document["motion"] = motion_json(result.motion);
  return document.dump(-1, ' ', false, json::error_handler_t::replace) + '\n';
}

template <typename Heading, typename Row>
std::string csv_text(const Motion& motion, const Heading& heading, const Row& row) {
  std::string text = heading(motion.skeleton());
  for (std::int64_t frame = 0; frame < motion.frame_count(); ++frame) text += row(motion, frame);
  return text;
}

std::string note_of(const std::vector<std::pair<std::string, std::string>>& declarations) {
  std::string note;
  for (const auto& [name, value] : declarations) note += (note.empty() ? "" : "; ") + value;
  return note;
}

std::string ending_fault(std::string_view where, std::string_view ending,
                         const std::vector<std::string_view>& endings) {
  const std::string wrong =
      ending.empty() ? "has no ending" : fmt::format("'{}' cannot be written here", printable(ending));
  return fmt::format("{}: {}; use {}", printable(where), wrong, fmt::join(endings, " "));
}

/// What writes files of this ending. Throws where nothing does.
FileWriter required_writer(std::string_view ending, std::string_view where) {
  const FileWriter writer = writer_of(ending);
  if (writer == FileWriter::none) {
    throw Error(ErrorCode::bad_input, ending_fault(where, ending, writable_endings()));
  }
  return writer;
}

/// Before the first file is written: that each has a writer and a folder to go to.
void check_outputs(const std::vector<std::string>& paths) {
  for (const std::string& path : paths) {
    required_writer(ending_of(path), path);
    const fs::path folder = fs::path(path).parent_path();
    std::error_code ignored;
    if (!folder.empty() && !fs::is_directory(folder, ignored)) {
      throw Error(ErrorCode::io, fmt::format("{}: there is no folder '{}'; make it first", path, folder.string()));
    }
  }
}

/// How a motion is written as BVH: as its own file was where it has one, but for what was asked for.
bvh::Layout layout_for(const Outgoing& recording) {
  const Skeleton& skeleton = recording.motion->skeleton();
  const bool fits = recording.layout && bvh::fits(*recording.layout, skeleton);
  bvh::Layout layout = fits ? *recording.layout : bvh::default_layout(skeleton);
  // A time that was printed for another rate is another rate's.
  const std::optional<SnappedRate> printed = snap_frame_time(layout.frame_time);
  if (printed && printed->rate != recording.motion->rate()) layout.frame_time.clear();
  return bvh::with(std::move(layout), recording.wishes);
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
  for (std::size_t i = 0; i < synthesis.clips.size(); ++i) {  // bare pieces have no sign to show
    const ShownClip& placed = synthesis.clips[i];
    const bool bare = std::none_of(synthesis.signs.begin(), synthesis.signs.end(),
                                   [&](const PlacedSign& sign) { return sign.clip == i; });
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

/// The character's own file with the motion in it.
std::string character_glb(const Outgoing& recording) {
  const std::filesystem::path& file = recording.character->plain;
  return gltf::on_character(file.filename().string(), read_file(file), *recording.motion,
                            {.name = recording.title, .declarations = recording.declarations});
}

/// Throws where what the ending asks for is not there.
void require_parts(FileWriter writer, const Outgoing& recording, const std::string& where) {
  if (writer == FileWriter::eaf) {
    if (recording.document != nullptr) return;
    throw Error(ErrorCode::not_found, where + ": the recording has no annotation to write");
  }
  if (recording.motion == nullptr) throw Error(ErrorCode::not_found, where + ": the recording has no motion to write");
  if (writer == FileWriter::face_csv && recording.motion->tracks().empty()) {
    throw Error(ErrorCode::not_found, where + ": the motion has no scalar tracks to write");
  }
  if (writer == FileWriter::gltf && recording.character) {
    throw Error(ErrorCode::unsupported, where + ": a character is written as .glb, in one file with its pictures");
  }
}

gltf::WriteOptions gltf_options(const Outgoing& recording) {
  return {.name = recording.title,
          .declarations = recording.declarations,
          .head = {},
          .rig = map_rig(*recording.motion, recording.rig)};
}

}  // namespace

Outgoing outgoing(const Synthesized& made, const SynthesisLook& look) {
  return {.motion = &made.result.motion,
          .layout = look.layout,
          .wishes = look.wishes,
          .title = look.sheet.title,
          .rig = look.sheet.rig,
          .declarations = made.result.declarations,
          .character = look.character,
          .progress = look.progress};
}

std::uint64_t estimated_bytes(const std::string& path, const Outgoing& recording) {
  constexpr std::int64_t kMany = 20'000;
  constexpr std::int64_t kSome = 32;
  const std::string ending = ending_of(path);
  const FileWriter writer = writer_of(ending);
  const bool is_long = writer == FileWriter::bvh || writer == FileWriter::positions_csv ||
                       writer == FileWriter::rotations_csv || writer == FileWriter::json;
  if (!is_long || recording.motion == nullptr || recording.motion->frame_count() < kMany) return 0;
  const std::int64_t frames = recording.motion->frame_count();
  const auto bytes_of_first = [&](std::int64_t count) {
    const std::int64_t begin = frames / 2;
    const Motion part = recording.motion->slice({begin, begin + count});
    Outgoing some = recording;
    some.motion = &part;
    return recording_text(ending, some, path).size();
  };
  const std::uint64_t one = bytes_of_first(1);
  return one + (bytes_of_first(1 + kSome) - one) * static_cast<std::uint64_t>(frames - 1) / kSome;
}

void require_room(const std::string& path, std::uint64_t bytes) {
  std::error_code error;
  const fs::space_info space = fs::space(fs::absolute(path).parent_path(), error);
  if (error || bytes <= space.available) return;
  throw Error(ErrorCode::io, fmt::format("{}: takes about {}, and the disk has {} free; name a place on another disk, "
                                         "or write a shorter part",
                                         path, size_text(bytes), size_text(space.available)));
}

std::string ending_of(const std::string& path) {
  const FileFormat* format = file_format(path);
  return format != nullptr ? std::string(format->ending) : fold_case(fs::path(path).extension().string());
}

std::string check_ending(const std::string& path, const std::vector<std::string_view>& endings) {
  const std::string ending = ending_of(path);
  const bool known = std::find(endings.begin(), endings.end(), ending) != endings.end();
  return known ? std::string() : ending_fault(path, ending, endings);
}

void check_signing_space(bool wanted, const std::vector<std::string>& paths) {
  const auto is_sheet = [](const std::string& path) { return ending_of(path) == ".svg"; };
  if (!wanted || std::any_of(paths.begin(), paths.end(), is_sheet)) return;
  throw Error(ErrorCode::bad_input, "--signing-space is drawn on contact sheets: add -o FILE.svg");
}

std::string synthesis_text(std::string_view ending, const Synthesized& made, const SynthesisLook& look,
                           const std::string& motion_file) {
  const Synthesis& result = made.result;
  switch (required_writer(ending, ending)) {
    case FileWriter::eaf:
      return eaf::write_text(annotation_of(result, motion_file));
    case FileWriter::json:
      return synthesis_json(result);
    case FileWriter::svg: {
      ContactSheetOptions options = sheet_options(result, look.sheet.title);
      options.signing_space = look.sheet.signing_space;
      options.rig = map_rig(result.motion, look.sheet.rig);
      return contact_sheet(result.motion, options);
    }
    default:
      return recording_text(ending, outgoing(made, look), std::string(ending));
  }
}

std::string recording_text(std::string_view ending, const Outgoing& recording, const std::string& where) {
  const FileWriter writer = required_writer(ending, where);
  require_parts(writer, recording, where);
  if (writer == FileWriter::eaf) return eaf::write_text(*recording.document);
  const Motion& motion = *recording.motion;
  switch (writer) {
    case FileWriter::bvh:
      return bvh::write_text(motion, layout_for(recording));
    case FileWriter::glb:
      if (recording.character) return character_glb(recording);
      return gltf::to_bytes(motion, gltf_options(recording), gltf::Container::binary);
    case FileWriter::gltf:
      return gltf::to_bytes(motion, gltf_options(recording), gltf::Container::text);
    case FileWriter::json: {
      json document = motion_json(motion);
      document["declarations"] = declarations_json(recording.declarations);
      return document.dump(-1, ' ', false, json::error_handler_t::replace) + '\n';
    }
    case FileWriter::positions_csv:
      return csv_text(motion, positions_csv_heading, positions_csv_row);
    case FileWriter::rotations_csv:
      return csv_text(motion, rotations_csv_heading, rotations_csv_row);
    case FileWriter::face_csv:
      return face_csv::write_text(motion);
    case FileWriter::svg: {
      ContactSheetOptions options;
      options.title = recording.title;
      options.note = note_of(recording.declarations);
      options.signing_space = recording.signing_space;
      options.rig = map_rig(motion, recording.rig);
      return contact_sheet(motion, options);
    }
    case FileWriter::eaf:
    case FileWriter::none:
      break;
  }
  assert(false);  // both were dealt with above
  return {};
}

void write_synthesis(const std::vector<std::string>& paths, const Synthesized& made, const SynthesisLook& look) {
  std::string motion_file;
  check_outputs(paths);
  for (const std::string& path : paths) {
    if (ending_of(path) == ".bvh") motion_file = fs::path(path).filename().string();
  }
  for (const std::string& path : paths) {
    const std::string ending = ending_of(path);
    switch (writer_of(ending)) {
      case FileWriter::eaf:
      case FileWriter::json:
      case FileWriter::svg:
        write_text(path, synthesis_text(ending, made, look, motion_file));
        break;
      default:
        write_recording(path, outgoing(made, look));
    }
  }
}

void write_recording(const std::string& path, const Outgoing& recording) {
  const std::string ending = ending_of(path);
  const FileWriter writer = required_writer(ending, path);
  require_parts(writer, recording, path);
  // The long ones go to the file piece by piece.
  switch (writer) {
    case FileWriter::bvh:
      bvh::write(path, *recording.motion, layout_for(recording), recording.progress);
      break;
    case FileWriter::glb:
    case FileWriter::gltf:
      if (recording.character) {
        write_text(path, character_glb(recording));
      } else {
        gltf::write(path, *recording.motion, gltf_options(recording));
      }
      break;
    case FileWriter::positions_csv:
      write_positions_csv(path, *recording.motion, recording.progress);
      break;
    case FileWriter::rotations_csv:
      write_rotations_csv(path, *recording.motion, recording.progress);
      break;
    default:
      write_text(path, recording_text(ending, recording, path));
  }
}

}  // namespace signweave::calls
