#pragma once

#include <Eigen/Geometry>
#include <cstddef>
#include <span>
#include <vector>

#include "signweave/formats/asf/skeleton.h"
#include "signweave/motion/motion.h"

/// From the numbers of a frame to a pose. Part of formats/asf, not for others.
namespace signweave::asf {

/// A rotation by an angle about one of the figure's axes, 0 to 2 for x to z.
Eigen::Quaterniond turn_about(int axis, double angle, bool degrees) noexcept;

/// Three angles, one after the other about fixed axes.
Eigen::Quaterniond rotation_of(const Turn& turn, bool degrees) noexcept;

/// The figure in lengths of :units (not yet metres), at rest.
struct RestFigure {
  std::vector<Joint> joints;  ///< [bone]; translated where a frame can move one
  std::vector<Tip> tips;
};
RestFigure rest_of(const Figure& figure);

/// Makes the poses of frame after frame. The figure must outlive it.
class Poser {
 public:
  /// `degrees` tells the angles of the frames, not those of the figure.
  Poser(const Figure& figure, bool degrees);

  /// Of `numbers`, [bone][dof], makes a pose in lengths of :units.
  void apply(std::span<const double> numbers, MutablePoseView pose);

 private:
  struct Piece {
    Eigen::Quaterniond axis = Eigen::Quaterniond::Identity();  ///< C, or the root's orientation
    std::size_t column = 0;
    bool turned = false;  ///< C is not the identity
  };

  const Figure& figure_;
  bool degrees_;
  std::vector<Piece> pieces_;      ///< [bone]
  std::vector<bool> translated_;   ///< [bone]
  std::vector<double> stretches_;  ///< [bone], of this frame
};

}  // namespace signweave::asf
