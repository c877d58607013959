#pragma once

#include <string>
#include <string_view>

#include "signweave/annotation/declarations.h"
#include "signweave/motion/motion.h"

namespace signweave::gltf {

struct CharacterOptions {
  std::string name = "motion";  ///< of the animation; UTF-8
  Declarations declarations;    ///< of the sources; written to the asset's extras
};

/// A character's own GLB with a motion as its only animation: everything in the file stays as it is, and the keys are
/// appended. The motion's joints are nodes of the file, matched by name (as `retarget` produces them), in metres; its
/// scalar tracks set the morph weights of the same name on every mesh that has them. Tracks that no mesh has, and
/// joints that the file lacks, are omitted.
///
/// `file` is the file name in errors. Throws Error{bad_input} if they are not a GLB with one buffer, or if the
/// motion has no frames or numbers that are not finite; Error{unsupported} for a packed file (EXT_meshopt_compression),
/// which most programs cannot open, and for more than 4 GiB.
std::string on_character(const std::string& file, std::string_view character, const Motion& motion,
                         const CharacterOptions& options);

}  // namespace signweave::gltf
