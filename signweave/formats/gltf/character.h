#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "signweave/motion/motion.h"

namespace signweave::gltf {

struct CharacterOptions {
  std::string name = "motion";  ///< of the animation; UTF-8
  /// What the sources say of themselves ("signweave:placeholder"): names and values, written to the asset's extras.
  std::vector<std::pair<std::string, std::string>> declarations;
};

/// A character's own GLB with a motion as its one animation: everything that is in the file stays as it is, and keys
/// are added behind it. The motion's joints are nodes of the file by name (as `retarget` makes them), metres; its
/// scalar tracks are the morph weights of the same name, of every mesh that has such. Tracks that no mesh has, and
/// joints that the file lacks, are left out.
///
/// `file` stands for the bytes in errors. Throws Error{bad_input} where they are no GLB of one buffer, or the motion
/// has no frames or numbers that are not finite; Error{unsupported} for a packed file (EXT_meshopt_compression), which
/// most programs cannot open, and for more than 4 GiB.
std::string on_character(const std::string& file, std::string_view character, const Motion& motion,
                         const CharacterOptions& options);

}  // namespace signweave::gltf
