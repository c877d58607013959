#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

/// The table of file formats, one row for each: its name, what it cannot hold, how its motion is read and its files are
/// written. `signweave formats`, imports, exports and the server use it; motion_file.h reads by it, write_file.h
/// writes.
namespace signweave {

struct FileContent;  // write_file.h
namespace motion_file {
struct File;  // motion_file.h
struct ReadOptions;
}  // namespace motion_file

/// The role of a file in a recording.
enum class FileKind {
  motion,       ///< its motion, read by `motion_file`
  motion_part,  ///< read with a motion file next to it
  annotation,   ///< its annotation, read by `annotation_file`
  face,         ///< scalar tracks for a motion, read by `face_csv`
  product,      ///< only written
};

/// How a format's motion files are read.
struct MotionReader {
  std::string_view options;  ///< the reading options that it knows, each between blanks
  motion_file::File (*read)(const std::filesystem::path&, const motion_file::ReadOptions&) = nullptr;
  /// Everything that is read.
  std::vector<std::filesystem::path> (*files)(const std::filesystem::path&, const motion_file::ReadOptions&) = nullptr;
};

/// How a format's files are written.
struct FileWriter {
  enum class Holds { motion, tracks, annotation };
  Holds holds = Holds::motion;
  std::string (*text)(const FileContent&) = nullptr;  ///< null: the format is not written
  /// Writes long files piece by piece; null: the text is written.
  void (*write)(const std::filesystem::path&, const FileContent&) = nullptr;
  bool grows = false;  ///< its files become large with the number of frames
};

struct FileFormat {
  std::string_view extension;  ///< ".bvh", ".face.csv": in lower case, unique
  std::string_view name;       ///< of the format: "BVH"
  FileKind kind;
  bool reads = false;           ///< files of kind `motion` by `reader`
  std::string_view media_type;  ///< of HTTP
  std::string_view holds;
  std::string_view lost;  ///< what it cannot hold of a recording
  MotionReader reader{};
  FileWriter writer{};

  bool writes() const noexcept { return writer.text != nullptr; }
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
