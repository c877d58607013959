#include "signweave/formats/write_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <span>

#include "signweave/core/atomic_file.h"
#include "signweave/core/error.h"
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
#include "signweave/formats/json/synthesis_json.h"
#include "signweave/score/provenance.h"

namespace signweave {
namespace {

namespace fs = std::filesystem;

std::string note_of(const Declarations& declarations) {
  std::string note;
  for (const auto& [name, value] : declarations) note += (note.empty() ? "" : "; ") + value;
  return note;
}

/// The layout of the BVH file: that of the recording's own file if it has one, with the requested changes.
bvh::Layout layout_of(const FileContent& content) {
  const Skeleton& skeleton = content.motion->skeleton();
  const bool fits = content.layout && bvh::fits(*content.layout, skeleton);
  bvh::Layout layout = fits ? *content.layout : bvh::default_layout(skeleton);
  // A frame time printed for another rate does not apply.
  const std::optional<SnappedRate> printed = snap_frame_time(layout.frame_time);
  if (printed && printed->rate != content.motion->rate()) layout.frame_time.clear();
  return bvh::with(std::move(layout), content.layout_changes);
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

template <typename Heading, typename Row>
std::string csv_text(const Motion& motion, const Heading& heading, const Row& row) {
  std::string text = heading(motion.skeleton());
  for (std::int64_t frame = 0; frame < motion.frame_count(); ++frame) text += row(motion, frame);
  return text;
}

gltf::WriteOptions gltf_options(const FileContent& content) {
  return {.name = content.title,
          .declarations = content.declarations,
          .head = {},
          .rig = map_rig(*content.motion, content.rig)};
}

std::string bvh_text(const FileContent& content) {
  return bvh::write_text(*content.motion, layout_of(content));
}
void write_bvh(const fs::path& path, const FileContent& content) {
  bvh::write(path, *content.motion, layout_of(content), content.progress);
}

std::string glb_text(const FileContent& content) {
  if (content.character.empty()) {
    return gltf::to_bytes(*content.motion, gltf_options(content), gltf::Container::binary);
  }
  return gltf::on_character(content.character.filename().string(), read_file(content.character), *content.motion,
                            {.name = content.title, .declarations = content.declarations});
}
std::string gltf_text(const FileContent& content) {
  return gltf::to_bytes(*content.motion, gltf_options(content), gltf::Container::text);
}
void write_gltf(const fs::path& path, const FileContent& content) {
  gltf::write(path, *content.motion, gltf_options(content));
}

std::string eaf_text(const FileContent& content) {
  return eaf::write_text(content.document != nullptr ? *content.document
                                                     : annotation_of(*content.synthesis, content.motion_file));
}

std::string json_text(const FileContent& content) {
  return content.synthesis != nullptr ? synthesis_json_text(*content.synthesis)
                                      : motion_json_text(*content.motion, content.declarations);
}

std::string positions_text(const FileContent& content) {
  return csv_text(*content.motion, positions_csv_heading, positions_csv_row);
}
void write_positions(const fs::path& path, const FileContent& content) {
  write_positions_csv(path, *content.motion, content.progress);
}

std::string rotations_text(const FileContent& content) {
  return csv_text(*content.motion, rotations_csv_heading, rotations_csv_row);
}
void write_rotations(const fs::path& path, const FileContent& content) {
  write_rotations_csv(path, *content.motion, content.progress);
}

std::string face_text(const FileContent& content) {
  return face_csv::write_text(*content.motion);
}

std::string svg_text(const FileContent& content) {
  ContactSheetOptions options;
  if (content.synthesis != nullptr) options = sheet_options(*content.synthesis, content.title);
  options.title = content.title;
  options.note = note_of(content.declarations);
  options.signing_space = content.signing_space;
  options.rig = map_rig(*content.motion, content.rig);
  return contact_sheet(*content.motion, options);
}

enum class Holds { motion, tracks, annotation };

struct Writer {
  std::string_view extension;
  Holds holds;
  std::string (*text)(const FileContent&);
  /// Writes long files piece by piece; null: the text is written.
  void (*write)(const fs::path&, const FileContent&) = nullptr;
  bool grows = false;  ///< its files become large with the number of frames
};

constexpr Writer kWriters[] = {
    {.extension = ".bvh", .holds = Holds::motion, .text = bvh_text, .write = write_bvh, .grows = true},
    {.extension = ".glb", .holds = Holds::motion, .text = glb_text, .write = write_gltf},
    {.extension = ".gltf", .holds = Holds::motion, .text = gltf_text, .write = write_gltf},
    {.extension = ".eaf", .holds = Holds::annotation, .text = eaf_text},
    {.extension = ".json", .holds = Holds::motion, .text = json_text, .grows = true},
    {.extension = ".csv", .holds = Holds::motion, .text = positions_text, .write = write_positions, .grows = true},
    {.extension = ".rotations.csv",
     .holds = Holds::motion,
     .text = rotations_text,
     .write = write_rotations,
     .grows = true},
    {.extension = ".face.csv", .holds = Holds::tracks, .text = face_text},
    {.extension = ".svg", .holds = Holds::motion, .text = svg_text},
};

std::string extension_fault(std::string_view where, std::string_view extension,
                            const std::vector<std::string_view>& extensions) {
  const std::string wrong =
      extension.empty() ? "has no extension" : fmt::format("'{}' cannot be written here", printable(extension));
  return fmt::format("{}: {}; use {}", printable(where), wrong, fmt::join(extensions, " "));
}

const Writer& writer_for(std::string_view extension, std::string_view where) {
  const auto* const writer = std::ranges::find(kWriters, extension, &Writer::extension);
  if (writer != std::end(kWriters)) return *writer;
  throw Error(ErrorCode::bad_input, extension_fault(where, extension, writable_extensions()));
}

/// Throws if the content lacks what the format holds.
void require_parts(const Writer& writer, const FileContent& content, const std::string& where) {
  if (writer.holds == Holds::annotation) {
    if (content.document != nullptr || content.synthesis != nullptr) return;
    throw Error(ErrorCode::not_found, where + ": the recording has no annotation to write");
  }
  if (content.motion == nullptr) throw Error(ErrorCode::not_found, where + ": the recording has no motion to write");
  if (writer.holds == Holds::tracks && content.motion->tracks().empty()) {
    throw Error(ErrorCode::not_found, where + ": the motion has no scalar tracks to write");
  }
  if (writer.text == gltf_text && !content.character.empty()) {
    throw Error(ErrorCode::unsupported, where + ": a character is written as .glb, in one file with its pictures");
  }
}

/// Checks, before the first file is written, that each has a writer and its folder exists.
void check_outputs(const std::vector<std::string>& paths) {
  for (const std::string& path : paths) {
    writer_for(extension_of(path), path);
    const fs::path folder = fs::path(path).parent_path();
    std::error_code ignored;
    if (!folder.empty() && !fs::is_directory(folder, ignored)) {
      throw Error(ErrorCode::io, fmt::format("{}: there is no folder '{}'; make it first", path, folder.string()));
    }
  }
}

}  // namespace

FileContent content_of(const Synthesis& synthesis) {
  return {.motion = &synthesis.motion, .synthesis = &synthesis, .declarations = synthesis.declarations};
}

std::string extension_of(const std::string& path) {
  const FileFormat* format = file_format(path);
  return format != nullptr ? std::string(format->extension) : fold_case(fs::path(path).extension().string());
}

std::string check_extension(const std::string& path, const std::vector<std::string_view>& extensions) {
  const std::string extension = extension_of(path);
  const bool known = std::ranges::find(extensions, extension) != extensions.end();
  return known ? std::string() : extension_fault(path, extension, extensions);
}

std::string file_text(std::string_view extension, const FileContent& content, const std::string& where) {
  const Writer& writer = writer_for(extension, where);
  require_parts(writer, content, where);
  return writer.text(content);
}

void write_file(const std::string& path, const FileContent& content) {
  const Writer& writer = writer_for(extension_of(path), path);
  require_parts(writer, content, path);
  if (writer.write != nullptr && content.character.empty()) {
    writer.write(path, content);
    return;
  }
  const std::string text = writer.text(content);
  AtomicFile file(path);
  file.write(text);
  file.commit();
}

void write_files(const std::vector<std::string>& paths, FileContent content) {
  check_outputs(paths);
  for (const std::string& path : paths) {
    if (extension_of(path) == ".bvh") content.motion_file = fs::path(path).filename().string();
  }
  for (const std::string& path : paths) write_file(path, content);
}

void save(const Synthesis& synthesis, const std::vector<std::string>& paths) {
  write_files(paths, content_of(synthesis));
}

std::uint64_t estimated_bytes(const std::string& path, const FileContent& content) {
  constexpr std::int64_t kMany = 20'000;
  constexpr std::int64_t kSome = 32;
  const auto* const writer = std::ranges::find(kWriters, extension_of(path), &Writer::extension);
  const bool grows = writer != std::end(kWriters) && writer->grows;
  if (!grows || content.motion == nullptr || content.motion->frame_count() < kMany) return 0;
  const std::int64_t frames = content.motion->frame_count();
  const auto bytes_of_first = [&](std::int64_t count) {
    const std::int64_t begin = frames / 2;
    const Motion part = content.motion->slice({begin, begin + count});
    FileContent some = content;
    some.motion = &part;
    some.synthesis = nullptr;
    return writer->text(some).size();
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

}  // namespace signweave
