#pragma once

#include <Eigen/Geometry>
#include <cstddef>
#include <span>
#include <vector>

#include "signweave/formats/asf/skeleton.h"
#include "signweave/motion/motion.h"

/// Converts the numbers of a frame to a pose. Internal to formats/asf.
namespace signweave::asf {

/// A rotation by an angle about one of the figure's axes, 0 to 2 for x to z.
Eigen::Quaterniond turn_about(int axis, double angle, bool degrees) noexcept;

/// Three rotations applied in order about fixed axes.
Eigen::Quaterniond rotation_of(const Turn& turn, bool degrees) noexcept;

/// The figure at rest, in lengths of :units (not yet metres).
struct RestFigure {
  std::vector<Joint> joints;  ///< [bone]; translated if a frame can move it
  std::vector<Tip> tips;
};
RestFigure rest_of(const Figure& figure);

/// Computes the poses of one frame after another. The figure must outlive it.
class Poser {
 public:
  /// `degrees` applies to the angles of the frames, not to those of the figure.
  Poser(const Figure& figure, bool degrees);

  /// Computes a pose in lengths of :units from `numbers`, [bone][dof].
  void apply(std::span<const double> numbers, MutablePoseView pose);

 private:
  struct Piece {
    Eigen::Quaterniond axis = Eigen::Quaterniond::Identity();  ///< C, or the root's orientation
    std::size_t column = 0;
    bool turned = false;  ///< C is not the identity
  };

  const Figure& figure_;
  bool degrees_;
  std::vector<Piece> pieces_;          ///< [bone]
  std::vector<bool> translated_;       ///< [bone]
  std::vector<double> added_lengths_;  ///< [bone], of this frame
};

}  // namespace signweave::asf
