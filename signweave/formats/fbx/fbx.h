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
/// transform (pivots, offsets, pre- and post-rotation, rotation orders, scale) is known here only.
namespace signweave::fbx {

struct ReadOptions {
  std::string take;                 ///< name of a take, or its number from 1; the first with keys where empty
  std::optional<FrameRate> rate{};  ///< of the motion; the file's where not given
  std::optional<double> unit{};  ///< metres per file unit; the file's UnitScaleFactor (of centimetres) where not given
  std::function<void(double fraction)> progress{};  ///< called now and then; may throw to cancel
};

/// A file as read.
struct File {
  Motion motion;                ///< metres, Y up, right-handed; animated blend shapes are its scalar tracks
  std::string take;             ///< the take that was read
  std::vector<Notice> notices;  ///< what was left out, assumed, found odd
};

/// Reads a file. Frame 0 is the beginning of the take. Throws Error{bad_input, "FILE:LINE: …"} (binary: "FILE: byte
/// N: …") for what is no whole FBX file, and for what cannot be told exactly by turning bones: a stretched or mirrored
/// node above other bones, animation in several layers; Error{unsupported} for versions before 7.1; Error{not_found}
/// for a take that is not there, or no file.
File read(const std::filesystem::path& path, const ReadOptions& options = {});
/// The same from bytes; `name` stands for the file in errors.
File read_bytes(const std::string& name, std::string_view bytes, const ReadOptions& options = {});

}  // namespace signweave::fbx
