#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "signweave/annotation/declarations.h"
#include "signweave/motion/motion.h"
#include "signweave/rig/rig_map.h"

/// glTF 2.0 output, for viewers and for Blender: the skeleton as a node tree, one skinned mesh that shows it as a
/// person of simple solids, and one animation.
namespace signweave::gltf {

enum class Container {
  binary,  ///< .glb: one file, at most 4 GiB
  text,    ///< .gltf: JSON with the numbers in base64, at most 64 MiB of numbers
};

struct WriteOptions {
  std::string name = "motion";  ///< of the animation, and of the node above the root; UTF-8
  Declarations declarations;    ///< of the sources; written to the asset's extras
  /// The joint that carries the face; if not given, the one named Head, or else the one with the shape of a head.
  std::optional<JointIndex> head;
  std::optional<RigMap> rig;  ///< which joint is which; if not given, the result of `map_rig`
};

/// Returns a motion as glTF. Joints and tips are nodes, in metres, Y up; names are preserved, and numbered if two are
/// the same. In the bind pose every rotation is the identity and the translations are those of the first frame. A joint
/// that never moves has at most one key, the others one key per frame, linearly interpolated. Scalar tracks with ARKit
/// names that the drawn face can show are its morph weights; all others are in the animation's extras as `tracks`, a
/// list of objects with name, rate (frames per second) and values.
///
/// Throws Error{bad_input} for a motion without joints or frames or with numbers that are not finite,
/// Error{unsupported} for one that is too large for the container.
std::string to_bytes(const Motion& motion, const WriteOptions& options, Container container);

/// Writes to a file, in the format of its extension (.gltf is text, any other binary). Written atomically; also throws
/// Error{io}.
void write(const std::filesystem::path& path, const Motion& motion, const WriteOptions& options);

}  // namespace signweave::gltf
