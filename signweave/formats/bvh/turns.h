#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <span>
#include <vector>

#include "signweave/formats/bvh/bvh.h"

/// From the angles of a frame to its rotations. Part of formats/bvh, not for others.
namespace signweave::bvh {

/// Sines and cosines of half of many angles. Of degrees up to ±10^9 each lies within 1e-15 of the exact value: full
/// turns are taken off without rounding, then a polynomial over half a turn serves, so that the compiler does several
/// at once. `sines` and `cosines` must be as long as `degrees`.
void half_angles(std::span<const double> degrees, std::span<double> sines, std::span<double> cosines) noexcept;

/// Makes the rotations of frame after frame; its buffers are used again.
class Turns {
 public:
  /// `channels` is [joint], as the columns of a frame hold them: the rotation channels of a joint turn one after the
  /// other about the joint's own axes.
  explicit Turns(const std::vector<std::vector<Channel>>& channels);

  /// Of `numbers`, all columns of one frame, makes `rotations` [joint].
  void apply(std::span<const double> numbers, std::span<Eigen::Quaternionf> rotations);

 private:
  /// The three axes about which a joint turns, first to last; those that have no channel turn by 0.
  struct Axes {
    std::uint8_t first = 0, second = 1, third = 2;
    double hand = 1;  ///< −1 where they follow each other as z → y → x
  };
  static constexpr std::uint32_t kNoColumn = 0xFFFFFFFF;

  std::vector<Axes> axes_;              ///< [joint]
  std::vector<std::uint32_t> columns_;  ///< [joint][3], or kNoColumn
  std::vector<double> degrees_, sines_, cosines_;
};

}  // namespace signweave::bvh
