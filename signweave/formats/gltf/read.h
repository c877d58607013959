#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "signweave/core/error.h"
#include "signweave/core/time.h"
#include "signweave/motion/motion.h"

/// glTF 2.0 in: the motion of one animation of a .glb or .gltf file. No mesh and no picture is looked at.
namespace signweave::gltf {

struct ReadOptions {
  std::string take;                 ///< name or number (from 1) of the animation; the first where empty
  std::optional<FrameRate> rate{};  ///< else the standard rate at which the keys stand, else 120 frames a second
  std::optional<double> unit{};     ///< metres per unit of the file; 1, as glTF has it, where not given
  std::function<void(double fraction)> progress{};  ///< called now and then; may throw to cancel
  /// How many bytes a motion may have beyond 64 for each byte of its file: two keys may last an hour.
  std::size_t most_growth = std::size_t{512} << 20;
};

/// A file as read: metres, Y up, right-handed.
struct ReadFile {
  Motion motion;                ///< frame 0 is the first key of the animation
  std::string take;             ///< the animation's name, or its number where it has none
  std::vector<Notice> notices;  ///< what was guessed, repaired, left out, found odd
  /// What the file says of itself and must not be lost, such as that its shapes are placeholders: extras "signweave:…"
  /// of its asset, as our own writer leaves them. Name and value.
  std::vector<std::pair<std::string, std::string>> declarations;
};

/// Reads one animation. The joints are those of the skins and all nodes between them, or, where there is no skin, the
/// nodes that the animation moves and all below them. Nodes above the first joint are applied to it; constant scales
/// are multiplied into offsets and translations. Joints whose place in their parent changes are `translated`. Morph
/// weights become scalar tracks, and so do the `tracks` in the animation's extras that our own writer leaves there.
///
/// Throws Error{bad_input, "FILE: PLACE: …"} for what is no whole glTF 2.x, Error{unsupported} for extensions that are
/// required and unknown, for scales that no Motion can hold and for motions that are too large, Error{not_found} where
/// there is no such take, and as `read_file` does.
ReadFile read(const std::filesystem::path& path, const ReadOptions& options = {});
/// The same from bytes; `name` stands for the file in errors. Buffers outside of it lie in `folder` or below; where
/// that is empty, none may be read.
ReadFile read_bytes(const std::string& name, std::string_view bytes, const std::filesystem::path& folder,
                    const ReadOptions& options = {});

/// Every file that a file is read from: itself, and the buffers outside of it, whether they exist or not. Of one that
/// is no glTF, itself. Throws where `path` cannot be read.
std::vector<std::filesystem::path> files_of(const std::filesystem::path& path);

}  // namespace signweave::gltf
