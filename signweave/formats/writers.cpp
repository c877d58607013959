#include "signweave/formats/writers.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "signweave/core/atomic_file.h"
#include "signweave/core/time.h"
#include "signweave/drawing/contact_sheet.h"
#include "signweave/formats/bvh/bvh.h"
#include "signweave/formats/csv/positions_csv.h"
#include "signweave/formats/csv/rotations_csv.h"
#include "signweave/formats/eaf/eaf.h"
#include "signweave/formats/face/face_csv.h"
#include "signweave/formats/gltf/character.h"
#include "signweave/formats/gltf/gltf.h"
#include "signweave/formats/json/synthesis_json.h"
#include "signweave/score/provenance.h"

namespace signweave::writers {
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

}  // namespace

std::string bvh_text(const FileContent& content) {
  return bvh::write_text(*content.motion, layout_of(content));
}
void write_bvh(const std::filesystem::path& path, const FileContent& content) {
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
void write_gltf(const std::filesystem::path& path, const FileContent& content) {
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
void write_positions(const std::filesystem::path& path, const FileContent& content) {
  write_positions_csv(path, *content.motion, content.progress);
}

std::string rotations_text(const FileContent& content) {
  return csv_text(*content.motion, rotations_csv_heading, rotations_csv_row);
}
void write_rotations(const std::filesystem::path& path, const FileContent& content) {
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
  options.from_above = content.from_above;
  options.loci = content.loci;
  options.rig = map_rig(*content.motion, content.rig);
  return contact_sheet(*content.motion, options);
}

}  // namespace signweave::writers
