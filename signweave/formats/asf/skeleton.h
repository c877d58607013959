#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "signweave/core/error.h"
#include "signweave/core/text_reader.h"
#include "signweave/motion/skeleton.h"

/// The skeleton of an ASF file, in the file's numbers. Internal to formats/asf.
namespace signweave::asf {

/// A degree of freedom: one number of a bone per frame.
enum class Dof : std::uint8_t { tx, ty, tz, rx, ry, rz, l };

inline bool is_translation(Dof dof) noexcept {
  return dof <= Dof::tz;
}
inline bool is_rotation(Dof dof) noexcept {
  return dof >= Dof::rx && dof <= Dof::rz;
}
/// 0, 1, 2 for x, y, z; not for `l`.
inline int axis_of(Dof dof) noexcept {
  return static_cast<int>(dof) % 3;
}
/// "rx".
std::string_view name_of(Dof dof) noexcept;

/// The range in which a degree of freedom should stay; may be infinite.
struct Limit {
  double low = 0;
  double high = 0;
};

/// Three angles and the order in which they turn about fixed axes.
struct Turn {
  Eigen::Vector3d angles = Eigen::Vector3d::Zero();  ///< about x, y, z; as in the file, so degrees or radians
  std::array<int, 3> order{0, 1, 2};                 ///< the axes, in the order in which they turn
};

/// A bone, or the root, whose tail is its head.
struct Bone {
  std::string name;
  std::size_t line = 0;                            ///< where it begins in the file
  JointIndex parent = kNoJoint;                    ///< the root is 0 and has none
  Eigen::Vector3d tail = Eigen::Vector3d::Zero();  ///< from its head: direction · length
  Eigen::Vector3d direction = Eigen::Vector3d::Zero();
  Turn axis;                  ///< for the root, its orientation
  std::vector<Dof> dofs;      ///< in the order of a frame's numbers and of the rotations
  std::vector<Limit> limits;  ///< [dof]; empty if not given
};

/// The contents of an ASF file.
struct Figure {
  std::vector<Bone> bones;                             ///< parents first, the root before all; depth first
  Eigen::Vector3d position = Eigen::Vector3d::Zero();  ///< of the root
  double length_unit = 1;                              ///< divisor for lengths
  bool degrees = true;                                 ///< false: radians
};

/// Reads a file to its end; at least one bone has a dof. Throws Error{bad_input, "FILE:LINE: …"}.
Figure read_figure(TextReader& reader, std::vector<Notice>& notices);

/// A line of :hierarchy: names, of which the first is the parent of all others.
struct Kinship {
  std::vector<std::string> names;
  std::size_t line = 0;
};

/// Orders the bones with parents first and the root at 0, and sets each one's parent. Throws Error{bad_input} for
/// unknown bones, bones with two parents or none, and cycles, naming `file`, and `end_line` if no better line is known.
void order_bones(std::vector<Bone>& bones, const std::vector<Kinship>& kinships, const std::string& file,
                 std::size_t end_line);

}  // namespace signweave::asf
