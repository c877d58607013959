#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

/// The table of file formats: the name of each, whether it is read and written, and what it cannot hold. `signweave
/// formats`, imports, exports and the server use it.
namespace signweave {

/// The role of a file in a recording.
enum class FileKind {
  motion,       ///< its motion half, read by `motion_file`
  motion_part,  ///< read with a motion file that is beside it
  annotation,   ///< its annotation half, read by `annotation_file`
  face,         ///< scalar tracks for a motion, read by `face_csv`
  product,      ///< only written
};

struct FileFormat {
  std::string_view extension;  ///< ".bvh", ".face.csv": in lower case, unique
  std::string_view name;       ///< of the format: "BVH"
  FileKind kind;
  bool reads = false;
  bool writes = false;
  std::string_view media_type;  ///< of HTTP
  std::string_view holds;
  std::string_view lost;  ///< what it cannot hold of a recording
};

/// Every format, in the order in which they are shown; of several motion files of one name the first is preferred.
std::span<const FileFormat> file_formats() noexcept;

/// The format of a file name, by its longest extension, case-insensitive; null if there is none.
const FileFormat* file_format(const std::filesystem::path& path);

/// Every extension that can be written: ".bvh", ".glb", ….
std::vector<std::string_view> writable_extensions();

/// "(.bvh, .amc, .glb)": the extensions of the files of a kind that can be read, for help and errors.
std::string readable_extensions(FileKind kind);

}  // namespace signweave
