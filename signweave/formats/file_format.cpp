#include "signweave/formats/file_format.h"

#include "signweave/core/text.h"

namespace signweave {
namespace {

constexpr std::string_view kPlainText = "text/plain; charset=utf-8";
constexpr std::string_view kCsvText = "text/csv; charset=utf-8";

constexpr FileFormat kFileFormats[] = {
    {".bvh", "BVH", FileKind::motion, true, true, kPlainText, "skeleton and motion",
     "annotation; rotations beyond 1e-4 degrees"},
    {".amc", "ASF/AMC", FileKind::motion, true, false, kPlainText, "motion, with the skeleton of its .asf",
     "limits, masses"},
    {".asf", "ASF/AMC", FileKind::motion_part, true, false, kPlainText, "skeleton of .amc files", "motion"},
    {".fbx", "FBX", FileKind::motion, true, false, "application/octet-stream", "skeleton and motion of one take",
     "meshes, other takes, curves between frames"},
    {".glb", "glTF", FileKind::motion, true, true, "model/gltf-binary",
     "skeleton and motion of one take; written with a simple body and face", "annotation"},
    {".gltf", "glTF", FileKind::motion, true, true, "model/gltf+json", "the same as text", "annotation"},
    {".eaf", "EAF", FileKind::annotation, true, true, "application/xml", "annotation", "motion"},
    {".anvil", "ANVIL", FileKind::annotation, true, false, "application/xml", "annotation; written as .eaf", "motion"},
    {".json", "JSON", FileKind::product, false, true, "application/json",
     "a synthesis: poses, signs, sources, junctions", "nothing"},
    {".csv", "CSV", FileKind::product, false, true, kCsvText, "joint positions per frame, metres",
     "rotations, annotation"},
    {".rotations.csv", "CSV", FileKind::product, false, true, kCsvText, "joint rotations per frame, quaternions",
     "bone lengths, annotation"},
    {".face.csv", "Live Link Face CSV", FileKind::face, true, true, kCsvText,
     "scalar tracks, as Live Link Face writes them", "everything else"},
    {".svg", "SVG", FileKind::product, false, true, "image/svg+xml", "contact sheet: frames as pictures",
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
    if (name.size() <= format.extension.size() || !name.ends_with(format.extension)) continue;
    if (longest == nullptr || longest->extension.size() < format.extension.size()) longest = &format;
  }
  return longest;
}

std::vector<std::string_view> writable_extensions() {
  std::vector<std::string_view> endings;
  for (const FileFormat& format : kFileFormats) {
    if (format.writes) endings.push_back(format.extension);
  }
  return endings;
}

std::string readable_extensions(FileKind kind) {
  std::string list;
  for (const FileFormat& format : kFileFormats) {
    if (format.kind == kind && format.reads) list += (list.empty() ? "(" : ", ") + std::string(format.extension);
  }
  return list + ')';
}

}  // namespace signweave
