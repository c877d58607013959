#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

/// The table of file formats: what each is called, whether it is read and written, and what it cannot hold. `signweave
/// formats`, imports, exports and the server go by it.
namespace signweave {

/// What a file is to a recording.
enum class FileKind {
  motion,       ///< its motion half, read by `motion_file`
  motion_part,  ///< read with a motion file that is beside it
  annotation,   ///< its annotation half, read by `annotation_file`
  face,         ///< scalar tracks for a motion, read by `face_csv`
  product,      ///< only written
};

/// What writes a file. Whoever writes switches over these, so that none is forgotten.
enum class FileWriter { none, bvh, glb, gltf, eaf, json, positions_csv, rotations_csv, face_csv, svg };

struct FileFormat {
  std::string_view ending;  ///< ".bvh", ".face.csv": in small letters, unique
  std::string_view name;    ///< of the format: "BVH"
  FileKind kind;
  bool reads;
  FileWriter writer;
  std::string_view media_type;  ///< of HTTP
  std::string_view holds;
  std::string_view lost;  ///< what it cannot hold of a recording
  bool writes() const noexcept { return writer != FileWriter::none; }
};

/// Every format, in the order in which they are shown; of several motion files of one name the first is preferred.
std::span<const FileFormat> file_formats() noexcept;

/// The format that a file's name stands for, by its longest ending, whatever its case; null for none.
const FileFormat* file_format(const std::filesystem::path& path);

/// What writes files of an ending (".bvh", in small letters); `none` where nothing does.
FileWriter writer_of(std::string_view ending) noexcept;

/// Every ending that can be written: ".bvh", ".glb", ….
std::vector<std::string_view> writable_endings();

/// "(.bvh, .amc, .glb)": the endings of what can be read of a kind, for help and errors.
std::string readable_endings(FileKind kind);

}  // namespace signweave
