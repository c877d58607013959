#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "signweave/core/error.h"
#include "signweave/core/time.h"

namespace signweave {

/// The files of one recording.
struct ImportJob {
  std::string name;  ///< of the recording: the stem of its files, prefixed with the folder's name if stems collide
  bool given_name = false;  ///< the name comes from a table of pairs
  std::optional<std::filesystem::path> motion;
  std::optional<std::filesystem::path> annotation;
  std::optional<std::filesystem::path> face;  ///< face capture
  bool no_face = false;                       ///< a table of pairs excludes the face capture next to it
  std::string signer;
  std::optional<Seconds> offset;       ///< annotation time of frame 0, from a table of pairs
  std::optional<Seconds> face_offset;  ///< the motion's time of the face's first row, from such a table
};

struct Pairing {
  std::vector<ImportJob> jobs;  ///< sorted by name
  std::vector<Notice> notices;  ///< files without a partner, files left out
};

/// Determines which files belong together. Folders are searched recursively; files are paired by the table of pairs, by
/// stem within one folder, by a stem that is unique, and by the files that an annotation links; one annotation may
/// serve several motions. A face capture STEM.face.csv belongs to the motion STEM of its folder. Throws
/// Error{not_found} for an input that does not exist, Error{unsupported} for a file of a kind that cannot be read,
/// Error{bad_input} for an invalid table.
///
/// The table is CSV with the columns motion, annotation, signer, offset (ms), face, face offset (ms), name of the
/// recording. All but the first two may be missing, and one of the first two may be empty. A face "-" means none, even
/// if one is next to the motion. Paths are relative to the table's folder. A first row "motion,annotation,…" is a
/// heading. With `plain_files` the table may only name files of its own folder: otherwise Error{bad_input}, before any
/// file is searched.
Pairing pair_files(const std::vector<std::filesystem::path>& inputs,
                   const std::optional<std::filesystem::path>& pairs_table = {}, bool plain_files = false);

/// Returns the file name in a URL, or in a path of any system: its last part, with %20 and the like decoded.
std::string linked_file_name(std::string_view url);

}  // namespace signweave
