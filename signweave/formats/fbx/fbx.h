#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "signweave/core/error.h"
#include "signweave/core/time.h"
#include "signweave/motion/motion.h"

/// FBX files: the bones and one take of their animation, binary or text, versions 7.1 to 7.7. Read only. FBX' own
/// transform (pivots, offsets, pre- and post-rotation, rotation orders, scale) is confined to this module.
namespace signweave::fbx {

struct ReadOptions {
  std::string take;                 ///< name of a take, or its number from 1; if empty, the first with keys
  std::optional<FrameRate> rate{};  ///< of the motion; if not given, the file's
  std::optional<double> unit{};     ///< metres per file unit; if not given, the file's UnitScaleFactor (in centimetres)
  std::function<void(double fraction)> progress{};  ///< called from time to time; may throw to cancel
};

/// A file as read.
struct File {
  Motion motion;                ///< metres, Y up, right-handed; animated blend shapes are its scalar tracks
  std::string take;             ///< the take that was read
  std::vector<Notice> notices;  ///< what was left out, assumed or found to be unusual
};

/// Reads a file. Frame 0 is the beginning of the take. Throws Error{bad_input, "FILE:LINE: …"} (binary: "FILE: byte N:
/// …") if the file is not a complete FBX file, or if bone rotations cannot represent it exactly: a stretched or
/// mirrored node above other bones, animation in several layers; Error{unsupported} for versions before 7.1;
/// Error{not_found} for a missing take or file.
File read(const std::filesystem::path& path, const ReadOptions& options = {});
/// Reads from bytes; `name` is the file name in errors.
File read_bytes(const std::string& name, std::string_view bytes, const ReadOptions& options = {});

}  // namespace signweave::fbx
