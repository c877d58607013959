#include "signweave/formats/file_format.h"

#include <algorithm>

#include "signweave/core/text.h"
#include "signweave/formats/motion_readers.h"
#include "signweave/formats/writers.h"

namespace signweave {
namespace {

using Holds = FileWriter::Holds;
constexpr std::string_view kPlainText = "text/plain; charset=utf-8";
constexpr std::string_view kCsvText = "text/csv; charset=utf-8";

constexpr FileFormat kFileFormats[] = {
    {.extension = ".bvh",
     .name = "BVH",
     .kind = FileKind::motion,
     .reads = true,
     .media_type = kPlainText,
     .holds = "skeleton and motion",
     .lost = "annotation; rotations beyond 1e-4 degrees",
     .reader = {.options = " up unit root_unit root_order mirror ",
                .read = readers::read_bvh,
                .files = readers::only_itself},
     .writer = {.text = writers::bvh_text, .write = writers::write_bvh, .grows = true}},
    {.extension = ".amc",
     .name = "ASF/AMC",
     .kind = FileKind::motion,
     .reads = true,
     .media_type = kPlainText,
     .holds = "motion, with the skeleton of its .asf",
     .lost = "limits, masses",
     .reader = {.options = " up unit source_rate skeleton ",
                .read = readers::read_asf,
                .files = readers::with_skeleton}},
    {.extension = ".asf",
     .name = "ASF/AMC",
     .kind = FileKind::motion_part,
     .reads = true,
     .media_type = kPlainText,
     .holds = "skeleton of .amc files",
     .lost = "motion"},
    {.extension = ".fbx",
     .name = "FBX",
     .kind = FileKind::motion,
     .reads = true,
     .media_type = "application/octet-stream",
     .holds = "skeleton and motion of one take",
     .lost = "meshes, other takes, curves between frames",
     .reader = {.options = " unit source_rate take ", .read = readers::read_fbx, .files = readers::only_itself}},
    {.extension = ".glb",
     .name = "glTF",
     .kind = FileKind::motion,
     .reads = true,
     .media_type = "model/gltf-binary",
     .holds = "skeleton and motion of one take; written with a simple body and face",
     .lost = "annotation",
     .reader = {.options = " unit source_rate take ", .read = readers::read_gltf, .files = readers::with_buffers},
     .writer = {.text = writers::glb_text, .write = writers::write_gltf}},
    {.extension = ".gltf",
     .name = "glTF",
     .kind = FileKind::motion,
     .reads = true,
     .media_type = "model/gltf+json",
     .holds = "the same as text",
     .lost = "annotation",
     .reader = {.options = " unit source_rate take ", .read = readers::read_gltf, .files = readers::with_buffers},
     .writer = {.text = writers::gltf_text, .write = writers::write_gltf}},
    {.extension = ".eaf",
     .name = "EAF",
     .kind = FileKind::annotation,
     .reads = true,
     .media_type = "application/xml",
     .holds = "annotation",
     .lost = "motion",
     .writer = {.holds = Holds::annotation, .text = writers::eaf_text}},
    {.extension = ".anvil",
     .name = "ANVIL",
     .kind = FileKind::annotation,
     .reads = true,
     .media_type = "application/xml",
     .holds = "annotation; written as .eaf",
     .lost = "motion"},
    {.extension = ".json",
     .name = "JSON",
     .kind = FileKind::product,
     .media_type = "application/json",
     .holds = "a synthesis: poses, signs, sources, junctions",
     .lost = "nothing",
     .writer = {.text = writers::json_text, .grows = true}},
    {.extension = ".csv",
     .name = "CSV",
     .kind = FileKind::product,
     .media_type = kCsvText,
     .holds = "joint positions per frame, metres",
     .lost = "rotations, annotation",
     .writer = {.text = writers::positions_text, .write = writers::write_positions, .grows = true}},
    {.extension = ".rotations.csv",
     .name = "CSV",
     .kind = FileKind::product,
     .media_type = kCsvText,
     .holds = "joint rotations per frame, quaternions",
     .lost = "bone lengths, annotation",
     .writer = {.text = writers::rotations_text, .write = writers::write_rotations, .grows = true}},
    {.extension = ".face.csv",
     .name = "Live Link Face CSV",
     .kind = FileKind::face,
     .reads = true,
     .media_type = kCsvText,
     .holds = "scalar tracks, as Live Link Face writes them",
     .lost = "everything else",
     .writer = {.holds = Holds::tracks, .text = writers::face_text}},
    {.extension = ".svg",
     .name = "SVG",
     .kind = FileKind::product,
     .media_type = "image/svg+xml",
     .holds = "contact sheet: frames as pictures",
     .lost = "everything but the picture",
     .writer = {.text = writers::svg_text}},
};
static_assert(std::ranges::all_of(kFileFormats, [](const FileFormat& format) {
  return (format.reader.read != nullptr) == (format.kind == FileKind::motion && format.reads);
}));

}  // namespace

std::span<const FileFormat> file_formats() noexcept {
  return kFileFormats;
}

const FileFormat* file_format(const std::filesystem::path& path) {
  const std::string name = fold_case(path.filename().string());
  const FileFormat* longest = nullptr;
  for (const FileFormat& format : kFileFormats) {
    // ".bvh" alone is the name of a hidden file, not an extension.
    if (name.size() <= format.extension.size() || !name.ends_with(format.extension)) continue;
    if (longest == nullptr || longest->extension.size() < format.extension.size()) longest = &format;
  }
  return longest;
}

std::vector<std::string_view> writable_extensions() {
  std::vector<std::string_view> extensions;
  for (const FileFormat& format : kFileFormats) {
    if (format.writes()) extensions.push_back(format.extension);
  }
  return extensions;
}

std::string readable_extensions(FileKind kind) {
  std::string list;
  for (const FileFormat& format : kFileFormats) {
    if (format.kind == kind && format.reads) list += (list.empty() ? "(" : ", ") + std::string(format.extension);
  }
  return list + ')';
}

}  // namespace signweave
