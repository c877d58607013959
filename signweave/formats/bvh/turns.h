#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <span>
#include <vector>

#include "signweave/formats/bvh/bvh.h"

/// Converts the angles of a frame to rotations. Internal to formats/bvh.
namespace signweave::bvh {

/// Computes the sines and cosines of half of each angle. For angles up to ±10^9 degrees each is within 1e-15 of the
/// exact value: full turns are subtracted without rounding, then a polynomial is evaluated over half a turn, which the
/// compiler vectorizes. `sines` and `cosines` must be as long as `degrees`.
void half_angles(std::span<const double> degrees, std::span<double> sines, std::span<double> cosines) noexcept;

/// Computes the rotations of one frame after another; its buffers are reused.
class Turns {
 public:
  /// `channels` is [joint], in the column order of a frame: the rotation channels of a joint turn one after another
  /// about the joint's own axes.
  explicit Turns(const std::vector<std::vector<Channel>>& channels);

  /// Computes `rotations` [joint] from `numbers`, all columns of one frame.
  void apply(std::span<const double> numbers, std::span<Eigen::Quaternionf> rotations);

 private:
  /// The three axes about which a joint turns, first to last; those without a channel turn by 0.
  struct Axes {
    std::uint8_t first = 0, second = 1, third = 2;
    double hand = 1;  ///< −1 if their cyclic order is z → y → x
  };
  static constexpr std::uint32_t kNoColumn = 0xFFFFFFFF;

  std::vector<Axes> axes_;              ///< [joint]
  std::vector<std::uint32_t> columns_;  ///< [joint][3], or kNoColumn
  std::vector<double> degrees_, sines_, cosines_;
};

}  // namespace signweave::bvh
