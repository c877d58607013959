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

/// Why a part is thought to be where it is.
enum class Evidence : std::uint8_t {
  none = 0,       ///< not found
  name = 1,       ///< the joint's name, in a table of names
  structure = 2,  ///< the shape of the hierarchy and of the captured body
  file = 3,       ///< a mapping file
};

/// Where a part is: a point that moves with a joint.
struct PartPlace {
  JointIndex joint = kNoJoint;
  Eigen::Vector3f offset = Eigen::Vector3f::Zero();  ///< from the joint, metres, joint's space; 0 but for tips
  Evidence evidence = Evidence::none;
  float confidence = 0;  ///< in [0, 1]: 1 named in a file, or by name and structure alike; 0 not found

  bool known() const noexcept { return joint != kNoJoint; }
};

/// Which joint of a skeleton plays which part of a body. One map serves every use: features, statistics, drawing, glTF.
struct RigMap {
  std::array<PartPlace, kPartCount> places;
  std::string convention;       ///< the table of names that fits: "MotionBuilder", "CMU", …; empty: none does
  std::vector<Notice> notices;  ///< what is missing or odd, one line each: "no fingers", "left and right are swapped"
  bool sides_swapped = false;   ///< names say left where the body has right; the map follows the body

  const PartPlace& operator[](Part part) const noexcept { return places[static_cast<std::size_t>(part)]; }
  PartPlace& operator[](Part part) noexcept { return places[static_cast<std::size_t>(part)]; }
  bool has(Part part) const noexcept { return (*this)[part].known(); }
};

/// What a mapping file says: joint names (verbatim) of parts. A part named with an empty joint is not there.
using RigNames = std::map<Part, std::string>;

/// The map of a motion of at least one frame: a user's names first, then tables of the names that common rigs give
/// their joints, then structure, from the skeleton and from how the body stands in the captured frames. What cannot be
/// told is absent, with a notice. Throws Error{not_found} where `names` tells a joint that the skeleton lacks, with
/// near matches; Error{bad_input} where it gives two parts one joint, or puts a hand before its forearm.
RigMap map_rig(const Motion& motion, const RigNames& names = {});

/// Reads a mapping file: a line `part = joint` each, `#` begins a comment. Throws Error{bad_input} with file and line
/// for an unknown part (with near matches), a part that comes twice, a line without `=`; Error{io}, Error{not_found}.
RigNames read_rig_names(const std::filesystem::path& path);

/// Where a part that is known is, in the model space of `pose`, metres.
inline Eigen::Vector3f position_of(const PartPlace& place, const ModelPose& pose) {
  const auto joint = static_cast<std::size_t>(place.joint);
  return pose.positions[joint] + pose.rotations[joint] * place.offset;
}

}  // namespace signweave
