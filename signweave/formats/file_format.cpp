#include "signweave/formats/file_format.h"

#include "signweave/core/text.h"

namespace signweave {
namespace {

constexpr std::string_view kPlainText = "text/plain; charset=utf-8";
constexpr std::string_view kCsvText = "text/csv; charset=utf-8";

constexpr FileFormat kFileFormats[] = {
    {.extension = ".bvh",
     .name = "BVH",
     .kind = FileKind::motion,
     .reads = true,
     .writes = true,
     .media_type = kPlainText,
     .holds = "skeleton and motion",
     .lost = "annotation; rotations beyond 1e-4 degrees"},
    {.extension = ".amc",
     .name = "ASF/AMC",
     .kind = FileKind::motion,
     .reads = true,
     .media_type = kPlainText,
     .holds = "motion, with the skeleton of its .asf",
     .lost = "limits, masses"},
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
     .lost = "meshes, other takes, curves between frames"},
    {.extension = ".glb",
     .name = "glTF",
     .kind = FileKind::motion,
     .reads = true,
     .writes = true,
     .media_type = "model/gltf-binary",
     .holds = "skeleton and motion of one take; written with a simple body and face",
     .lost = "annotation"},
    {.extension = ".gltf",
     .name = "glTF",
     .kind = FileKind::motion,
     .reads = true,
     .writes = true,
     .media_type = "model/gltf+json",
     .holds = "the same as text",
     .lost = "annotation"},
    {.extension = ".eaf",
     .name = "EAF",
     .kind = FileKind::annotation,
     .reads = true,
     .writes = true,
     .media_type = "application/xml",
     .holds = "annotation",
     .lost = "motion"},
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
     .writes = true,
     .media_type = "application/json",
     .holds = "a synthesis: poses, signs, sources, junctions",
     .lost = "nothing"},
    {.extension = ".csv",
     .name = "CSV",
     .kind = FileKind::product,
     .writes = true,
     .media_type = kCsvText,
     .holds = "joint positions per frame, metres",
     .lost = "rotations, annotation"},
    {.extension = ".rotations.csv",
     .name = "CSV",
     .kind = FileKind::product,
     .writes = true,
     .media_type = kCsvText,
     .holds = "joint rotations per frame, quaternions",
     .lost = "bone lengths, annotation"},
    {.extension = ".face.csv",
     .name = "Live Link Face CSV",
     .kind = FileKind::face,
     .reads = true,
     .writes = true,
     .media_type = kCsvText,
     .holds = "scalar tracks, as Live Link Face writes them",
     .lost = "everything else"},
    {.extension = ".svg",
     .name = "SVG",
     .kind = FileKind::product,
     .writes = true,
     .media_type = "image/svg+xml",
     .holds = "contact sheet: frames as pictures",
     .lost = "everything but the picture"},
};

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
    if (format.writes) extensions.push_back(format.extension);
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
