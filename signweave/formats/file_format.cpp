#include "signweave/formats/file_format.h"

#include "signweave/core/text.h"

namespace signweave {
namespace {

constexpr std::string_view kPlainText = "text/plain; charset=utf-8";
constexpr std::string_view kCsvText = "text/csv; charset=utf-8";

constexpr FileFormat kFileFormats[] = {
    {".bvh", "BVH", FileKind::motion, true, FileWriter::bvh, kPlainText, "skeleton and motion",
     "annotation; rotations beyond 1e-4 degrees"},
    {".amc", "ASF/AMC", FileKind::motion, true, FileWriter::none, kPlainText, "motion, with the skeleton of its .asf",
     "limits, masses"},
    {".asf", "ASF/AMC", FileKind::motion_part, true, FileWriter::none, kPlainText, "skeleton of .amc files", "motion"},
    {".fbx", "FBX", FileKind::motion, true, FileWriter::none, "application/octet-stream",
     "skeleton and motion of one take", "meshes, other takes, curves between frames"},
    {".glb", "glTF", FileKind::motion, true, FileWriter::glb, "model/gltf-binary",
     "skeleton and motion of one take; written with a simple body and face", "annotation"},
    {".gltf", "glTF", FileKind::motion, true, FileWriter::gltf, "model/gltf+json", "the same as text", "annotation"},
    {".eaf", "EAF", FileKind::annotation, true, FileWriter::eaf, "application/xml", "annotation", "motion"},
    {".anvil", "ANVIL", FileKind::annotation, true, FileWriter::none, "application/xml", "annotation; written as .eaf",
     "motion"},
    {".json", "JSON", FileKind::product, false, FileWriter::json, "application/json",
     "a synthesis: poses, signs, sources, junctions", "nothing"},
    {".csv", "CSV", FileKind::product, false, FileWriter::positions_csv, kCsvText, "joint positions per frame, metres",
     "rotations, annotation"},
    {".rotations.csv", "CSV", FileKind::product, false, FileWriter::rotations_csv, kCsvText,
     "joint rotations per frame, quaternions", "bone lengths, annotation"},
    {".face.csv", "Live Link Face CSV", FileKind::face, true, FileWriter::face_csv, kCsvText,
     "scalar tracks, as Live Link Face writes them", "everything else"},
    {".svg", "SVG", FileKind::product, false, FileWriter::svg, "image/svg+xml", "contact sheet: frames as pictures",
     "everything but the picture"},
};

}  // namespace

std::span<const FileFormat> file_formats() noexcept {
  return kFileFormats;
}

const FileFormat* file_format(const std::filesystem::path& path) {
  const std::string name = fold_case(path.filename().string());
  const FileFormat* longest = nullptr;
  for (const FileFormat& format : kFileFormats) {
    // ".bvh" alone is the name of a hidden file, not an ending.
    if (name.size() <= format.ending.size() || !name.ends_with(format.ending)) continue;
    if (longest == nullptr || longest->ending.size() < format.ending.size()) longest = &format;
  }
  return longest;
}

FileWriter writer_of(std::string_view ending) noexcept {
  for (const FileFormat& format : kFileFormats) {
    if (format.ending == ending) return format.writer;
  }
  return FileWriter::none;
}

std::vector<std::string_view> writable_endings() {
  std::vector<std::string_view> endings;
  for (const FileFormat& format : kFileFormats) {
    if (format.writes()) endings.push_back(format.ending);
  }
  return endings;
}

std::string readable_endings(FileKind kind) {
  std::string list;
  for (const FileFormat& format : kFileFormats) {
    if (format.kind == kind && format.reads) list += (list.empty() ? "(" : ", ") + std::string(format.ending);
  }
  return list + ')';
}

}  // namespace signweave
