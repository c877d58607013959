#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "signweave/motion/motion.h"
#include "signweave/rig/rig_map.h"

/// glTF 2.0 out, for viewers and for Blender: the skeleton as a node tree, one skinned mesh that shows it as a person
/// of simple solids, and one animation.
namespace signweave::gltf {

enum class Container {
  binary,  ///< .glb: one file, at most 4 GiB
  text,    ///< .gltf: JSON with the numbers in base64, at most 64 MiB of numbers
};

struct WriteOptions {
  std::string name = "motion";  ///< of the animation, and of the node above the root; UTF-8
  /// What the sources say of themselves ("signweave:placeholder"): names and values, written to the asset's extras.
  std::vector<std::pair<std::string, std::string>> declarations;
  /// The joint that carries the face; else the one that is called Head, else the one that looks like it.
  std::optional<JointIndex> head;
  std::optional<RigMap> rig;  ///< which joint is what; where none is given, `map_rig` tells
};

/// A motion as glTF. Joints and tips are nodes, in metres, Y up; names are kept, and numbered where two are the same.
/// The bind pose is every rotation the identity, and the translations of the first frame. A joint that never moves has
/// one key or none, the others one key a frame, linearly interpolated. Scalar tracks with ARKit names that the drawn
/// face can show are its morph weights; all others are in the animation's extras as `tracks`, a list of objects with
/// name, rate (frames a second) and values.
///
/// Throws Error{bad_input} for a motion without joints or frames or with numbers that are not finite,
/// Error{unsupported} for one that is too large for the container.
std::string to_bytes(const Motion& motion, const WriteOptions& options, Container container);

/// Writes to a file, as its ending says (.gltf is text, every other binary). Whole or not at all; throws also
/// Error{io}.
void write(const std::filesystem::path& path, const Motion& motion, const WriteOptions& options);

}  // namespace signweave::gltf
