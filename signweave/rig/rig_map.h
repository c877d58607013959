#pragma once

#include <Eigen/Core>
#include <array>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "signweave/core/error.h"
#include "signweave/motion/kinematics.h"
#include "signweave/motion/motion.h"
#include "signweave/rig/part.h"

namespace signweave {

/// The evidence for the place of a part.
enum class Evidence : std::uint8_t {
  none = 0,       ///< not found
  name = 1,       ///< the joint's name is in a table of names
  structure = 2,  ///< the shape of the hierarchy and of the captured body
  file = 3,       ///< a mapping file
};

/// The place of a part: a point that moves with a joint.
struct PartPlace {
  JointIndex joint = kNoJoint;
  Eigen::Vector3f offset = Eigen::Vector3f::Zero();  ///< from the joint, metres, joint's space; nonzero only for tips
  Evidence evidence = Evidence::none;
  float confidence = 0;  ///< in [0, 1]: 1 if given by a file, or by name and shape alike; 0 if not found

  bool known() const noexcept { return joint != kNoJoint; }
};

/// Maps the parts of a body to the joints of a skeleton. One map serves every use: features, statistics, drawing, glTF.
struct RigMap {
  std::array<PartPlace, kPartCount> places;
  std::string convention;       ///< the table of names that fits: "MotionBuilder", "CMU", …; empty if none fits
  std::vector<Notice> notices;  ///< missing or unusual parts, one line each: "no fingers", "left and right are swapped"
  bool sides_swapped = false;   ///< joints named left are on the body's right side; the map follows the body

  const PartPlace& operator[](Part part) const noexcept { return places[static_cast<std::size_t>(part)]; }
  PartPlace& operator[](Part part) noexcept { return places[static_cast<std::size_t>(part)]; }
  bool has(Part part) const noexcept { return (*this)[part].known(); }
};

/// The content of a mapping file: the joint name (verbatim) of each part. An empty name means that the body lacks the
/// part.
using RigNames = std::map<Part, std::string>;

/// Maps a motion of at least one frame: first by the user's names, then by tables of the joint names of common rigs,
/// then by structure, from the skeleton and the body's posture in the captured frames. A part that cannot be determined
/// is absent, with a notice. Throws Error{not_found} with near matches if `names` contains a joint that the skeleton
/// lacks; Error{bad_input} if it assigns two parts to one joint, or puts a hand before its forearm.
RigMap map_rig(const Motion& motion, const RigNames& names = {});

/// Reads a mapping file with one line `part = joint` per part; `#` starts a comment. Throws Error{bad_input} with file
/// and line for an unknown part (with near matches), a repeated part or a line without `=`; Error{io},
/// Error{not_found}.
RigNames read_rig_names(const std::filesystem::path& path);

/// The position of a known part in the model space of `pose`, metres.
inline Eigen::Vector3f position_of(const PartPlace& place, const ModelPose& pose) {
  const auto joint = static_cast<std::size_t>(place.joint);
  return pose.positions[joint] + pose.rotations[joint] * place.offset;
}

}  // namespace signweave
