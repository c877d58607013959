#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "signweave/annotation/declarations.h"
#include "signweave/core/error.h"
#include "signweave/core/time.h"
#include "signweave/motion/motion.h"

/// glTF 2.0 input: the motion of one animation of a .glb or .gltf file. Meshes and pictures are not read.
namespace signweave::gltf {

struct ReadOptions {
  std::string take;                 ///< name or number (from 1) of the animation; the first if empty
  std::optional<FrameRate> rate{};  ///< if not given, the standard rate that fits the keys, or else 120 frames a second
  std::optional<double> unit{};     ///< metres per unit of the file; if not given 1, as glTF specifies
  std::function<void(double fraction)> progress{};  ///< called from time to time; may throw to cancel
  /// The bytes a motion may have in addition to 64 for each byte of its file, because two keys may be an hour apart.
  std::size_t most_growth = std::size_t{512} << 20;
};

/// A file as read: metres, Y up, right-handed.
struct ReadFile {
  Motion motion;                ///< frame 0 is the first key of the animation
  std::string take;             ///< the animation's name, or its number if it has no name
  std::vector<Notice> notices;  ///< what was guessed, repaired, left out or found to be unusual
  Declarations declarations;    ///< extras "signweave:…" of the file's asset, as our own writer writes them
};

/// Reads one animation. The joints are those of the skins and all nodes between them or, if there is no skin, the nodes
/// that the animation moves and all below them. Transforms of nodes above the first joint are applied to it; constant
/// scales are multiplied into offsets and translations. Joints whose position in their parent changes are `translated`.
/// Morph weights become scalar tracks, and so do the `tracks` in the animation's extras that our own writer writes.
///
/// Throws Error{bad_input, "FILE: PLACE: …"} if the file is not complete glTF 2.x, Error{unsupported} for required
/// extensions that are unknown, for scales that no Motion can hold and for motions that are too large, Error{not_found}
/// if there is no such take, and as `read_file` does.
ReadFile read(const std::filesystem::path& path, const ReadOptions& options = {});
/// Reads from bytes; `name` is the file name in errors. External buffers lie in `folder` or below; if that is empty,
/// none may be read.
ReadFile read_bytes(const std::string& name, std::string_view bytes, const std::filesystem::path& folder,
                    const ReadOptions& options = {});

/// Every file that a file is read from: itself and its external buffers, whether they exist or not. If it is not glTF,
/// only itself. Throws if `path` cannot be read.
std::vector<std::filesystem::path> files_of(const std::filesystem::path& path);

}  // namespace signweave::gltf
