#include "signweave/formats/bvh/turns.h"

#include <array>
#include <bit>
#include <cstddef>

#include "signweave/formats/bvh/euler.h"

namespace signweave::bvh {
namespace {

// sin(πt/2)/t and cos(πt/2) for |t| ≤ 1 as polynomials in t², found with Remez' algorithm; the largest errors are
// 1.8e-16 and 4e-18 before rounding.
constexpr double kSine[] = {1.57079632679489644,       -0.64596409750622329147,   0.079692626245684381145,
                            -0.0046817541314531674518, 0.00016044116958054572834, -3.5988107318876887167e-6,
                            5.6883199237145605062e-8,  -6.4495243664146110058e-10};
constexpr double kCosine[] = {1.0,
                              -1.2337005501361691934,
                              0.25366950790103109675,
                              -0.020863480763179134929,
                              0.00091926027394456415239,
                              -0.000025202039784524610118,
                              4.7108307704927393579e-7,
                              -6.3822375938378088328e-9,
                              6.3317744472156721287e-11};
/// Adding and subtracting it rounds to a whole number, whose value is then in the lowest bits.
constexpr double kRounds = 0x1.8p52;

}  // namespace

void half_angles(std::span<const double> degrees, std::span<double> sines, std::span<double> cosines) noexcept {
  const double* const in = degrees.data();
  double* const sine = sines.data();
  double* const cosine = cosines.data();
  const std::size_t count = degrees.size();
  for (std::size_t i = 0; i < count; ++i) {
    const double shifted = in[i] * (1.0 / 360) + kRounds;
    const double turns = shifted - kRounds;
    const double t = (in[i] - 360 * turns) * (1.0 / 180);
    const double u = t * t;
    const double s =
        t * (kSine[0] +
             u * (kSine[1] +
                  u * (kSine[2] + u * (kSine[3] + u * (kSine[4] + u * (kSine[5] + u * (kSine[6] + u * kSine[7])))))));
    const double c =
        kCosine[0] +
        u * (kCosine[1] +
             u * (kCosine[2] +
                  u * (kCosine[3] +
                       u * (kCosine[4] + u * (kCosine[5] + u * (kCosine[6] + u * (kCosine[7] + u * kCosine[8])))))));
    // A full turn is half a turn of the half angle: an odd number of them changes both signs.
    const std::uint64_t odd = std::bit_cast<std::uint64_t>(shifted) << 63;
    sine[i] = std::bit_cast<double>(std::bit_cast<std::uint64_t>(s) ^ odd);
    cosine[i] = std::bit_cast<double>(std::bit_cast<std::uint64_t>(c) ^ odd);
  }
}

Turns::Turns(const std::vector<std::vector<Channel>>& channels) {
  std::uint32_t column = 0;
  for (const std::vector<Channel>& of_joint : channels) {
    std::array<std::uint8_t, 3> axes{};
    std::array<bool, 3> used{};
    std::size_t count = 0;
    for (const Channel channel : of_joint) {
      if (is_rotation(channel)) {
        const int axis = axis_of(channel);
        axes[count++] = static_cast<std::uint8_t>(axis);
        used[static_cast<std::size_t>(axis)] = true;
        columns_.push_back(column);
      }
      ++column;
    }
    for (std::uint8_t axis = 0; axis < 3; ++axis) {
      if (used[axis]) continue;
      axes[count++] = axis;
      columns_.push_back(kNoColumn);
    }
    axes_.push_back({axes[0], axes[1], axes[2], axes[1] == (axes[0] + 1) % 3 ? 1.0 : -1.0});
  }
  degrees_.resize(columns_.size());
  sines_.resize(columns_.size());
  cosines_.resize(columns_.size());
}

void Turns::apply(std::span<const double> numbers, std::span<Eigen::Quaternionf> rotations) {
  for (std::size_t i = 0; i < columns_.size(); ++i) {
    degrees_[i] = columns_[i] == kNoColumn ? 0.0 : numbers[columns_[i]];
  }
  half_angles(degrees_, sines_, cosines_);
  for (std::size_t joint = 0; joint < rotations.size(); ++joint) {
    const double* const s = &sines_[3 * joint];
    const double* const c = &cosines_[3 * joint];
    const Axes& axes = axes_[joint];
    const double cc = c[0] * c[1];
    const double ss = axes.hand * (s[0] * s[1]);
    const double sc = s[0] * c[1];
    const double cs = c[0] * s[1];
    // Sines and cosines are so accurate that the product has length 1 within the precision of a float.
    std::array<float, 3> vector;
    vector[axes.first] = static_cast<float>(sc * c[2] + axes.hand * (cs * s[2]));
    vector[axes.second] = static_cast<float>(cs * c[2] - axes.hand * (sc * s[2]));
    vector[axes.third] = static_cast<float>(ss * c[2] + cc * s[2]);
    rotations[joint] = {static_cast<float>(cc * c[2] - ss * s[2]), vector[0], vector[1], vector[2]};
  }
}

}  // namespace signweave::bvh
