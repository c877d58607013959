#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "signweave/annotation/declarations.h"
#include "signweave/annotation/document.h"
#include "signweave/drawing/locus_marks.h"
#include "signweave/formats/bvh/bvh.h"
#include "signweave/motion/motion.h"
#include "signweave/rig/rig_map.h"
#include "signweave/score/result.h"

/// A recording or a synthesis as a file of any format that has a writer (see file_format.h).
///
///     save(synthesize(database, parse_utterance("DEMAIN MATIN")).result, {"demain.glb", "demain.eaf"});
namespace signweave {

/// What a file is written from. Everything it points to is borrowed.
struct FileContent {
  const Motion* motion = nullptr;
  const AnnotationDocument* document = nullptr;  ///< for .eaf
  const Synthesis* synthesis = nullptr;          ///< for .json, .svg and .eaf: its signs, sources and junctions
  std::optional<bvh::Layout> layout{};           ///< for .bvh; none: bvh::default_layout
  bvh::LayoutChanges layout_changes{};           ///< changes to the layout
  std::string title{};
  RigNames rig{};                     ///< joints named by a mapping file
  bool signing_space = false;         ///< for .svg: draw the signing space behind each figure
  bool from_above = false;            ///< for .svg: figures are seen from above
  std::vector<MarkedLocus> loci{};    ///< for .svg: marked in front of each figure
  Declarations declarations{};        ///< of the sources, such as "signweave:placeholder"
  std::filesystem::path character{};  ///< for .glb: the character's plain GLB, whose joints the motion has; empty: none
  std::string motion_file{};          ///< for .eaf of a synthesis: the name of the motion file that it links
  std::function<void(double fraction)> progress{};  ///< of each file; may throw to cancel
};

/// The content of a synthesis, which must outlive it.
FileContent content_of(const Synthesis& synthesis);

/// The extension of a file name, in lower case: ".bvh", ".face.csv"; empty if it has none.
std::string extension_of(const std::string& path);

/// Empty if `path` has one of these extensions (in lower case); otherwise one line that says what is wrong: the file,
/// its extension and the extensions that may be used.
std::string check_extension(const std::string& path, const std::vector<std::string_view>& extensions);

/// The content as text or bytes of the format with this extension; `where` begins the text of an error. Throws
/// Error{bad_input} for an extension without a writer, Error{not_found} if the content lacks what the format holds,
/// Error{unsupported} as the format's own writer does.
std::string file_text(std::string_view extension, const FileContent& content, const std::string& where);

/// Writes one file, by its extension, atomically. Throws as file_text, and Error{io}.
void write_file(const std::string& path, const FileContent& content);

/// Writes several. Every name and folder is checked before the first file is written; an annotation of a synthesis
/// links the BVH file among them.
void write_files(const std::vector<std::string>& paths, FileContent content);

/// Saves a synthesis in the formats of these file names. For more control, change `content_of(synthesis)` and call
/// write_files.
void save(const Synthesis& synthesis, const std::vector<std::string>& paths);

/// About how many bytes the file will take, estimated from some of its frames; 0 if that is little, or for formats
/// whose files are never large.
std::uint64_t estimated_bytes(const std::string& path, const FileContent& content);

/// Throws Error{io} if the disk that the file will be on has less free space.
void require_room(const std::string& path, std::uint64_t bytes);

}  // namespace signweave
