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

/// The skeleton of an ASF file, in the file's numbers. Part of formats/asf, not for others.
namespace signweave::asf {

/// A degree of freedom: one number a frame of a bone.
enum class Dof : std::uint8_t { tx, ty, tz, rx, ry, rz, l };

inline bool is_translation(Dof dof) noexcept {
  return dof <= Dof::tz;
}
inline bool is_rotation(Dof dof) noexcept {
  return dof >= Dof::rx && dof <= Dof::rz;
}
/// 0, 1, 2 for x, y, z; not of `l`.
inline int axis_of(Dof dof) noexcept {
  return static_cast<int>(dof) % 3;
}
/// "rx".
std::string_view name_of(Dof dof) noexcept;

/// Between which values a degree of freedom should stay; may be infinite.
struct Limit {
  double low = 0;
  double high = 0;
};

/// Three angles and in which order they turn about fixed axes.
struct Turn {
  Eigen::Vector3d angles = Eigen::Vector3d::Zero();  ///< about x, y, z; as in the file, so degrees or radians
  std::array<int, 3> order{0, 1, 2};                 ///< the axes, the one that turns first first
};

/// A bone, or the root, whose tail is its head.
struct Bone {
  std::string name;
  std::size_t line = 0;                            ///< where it begins in the file
  JointIndex parent = kNoJoint;                    ///< the root is 0 and has none
  Eigen::Vector3d tail = Eigen::Vector3d::Zero();  ///< from its head: direction · length
  Eigen::Vector3d direction = Eigen::Vector3d::Zero();
  Turn axis;                  ///< of the root: its orientation
  std::vector<Dof> dofs;      ///< as the numbers of a frame come, and as the rotations follow each other
  std::vector<Limit> limits;  ///< [dof], or none
};

/// What an ASF file holds.
struct Figure {
  std::vector<Bone> bones;                             ///< parents first, the root before all; depth first
  Eigen::Vector3d position = Eigen::Vector3d::Zero();  ///< of the root
  double length_unit = 1;                              ///< what lengths are to be divided by
  bool degrees = true;                                 ///< false: radians
};

/// Reads a file to its end; at least one bone has a dof. Throws Error{bad_input, "FILE:LINE: …"}.
Figure read_figure(TextReader& reader, std::vector<Notice>& notices);

/// Whose parent is who, as :hierarchy tells: a line of names, the first the parent of all others.
struct Kinship {
  std::vector<std::string> names;
  std::size_t line = 0;
};

/// Puts the bones, the root at 0, into an order with parents first, and tells each its parent. Throws Error{bad_input}
/// for unknown bones, those with two parents or none, and circles; `file` is named in it, and `end_line` where nothing
/// better tells the place.
void order_bones(std::vector<Bone>& bones, const std::vector<Kinship>& kinships, const std::string& file,
                 std::size_t end_line);

}  // namespace signweave::asf
