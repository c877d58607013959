#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "signweave/inflection/aim.h"
#include "signweave/inflection/gaussian_process.h"
#include "signweave/inflection/slots.h"

/// Internal to this module.
namespace signweave::inflection {

/// From nothing to beyond all reach is as far as this many degrees. (ours)
inline constexpr float kAwayDegrees = 100;
/// Loci within this angle are one. (design)
inline constexpr float kSameLocus = 10;

inline float degrees_between(const Locus& a, const Locus& b) {
  if (a.self || b.self) return a.self == b.self ? 0 : 180;
  const float cosine = a.at.normalized().dot(b.at.normalized());
  return std::acos(std::clamp(cosine, -1.0f, 1.0f)) / kDegree;
}

/// Which loci of a sign a stroke depends on, and how they become coordinates.
struct Arguments {
  bool from = false, to = false, at = false;
  bool by_side = false;    ///< of two: the one farther to the right comes first
  bool elevation = false;  ///< of one: its elevation is an argument of the mean too
  bool places = true;      ///< the mean is linear in the places besides
  float reach = 1.5f;      ///< arm length, shoulder widths
  Eigen::Vector3f shoulder =
      Eigen::Vector3f::Zero();  ///< of the hand that acts, shoulder widths; of both: between them

  std::size_t count() const noexcept {
    return static_cast<std::size_t>(from) + static_cast<std::size_t>(to) + static_cast<std::size_t>(at);
  }
  /// The loci in order; empty if one is missing.
  std::vector<Locus> of(const LociOfSign& loci) const {
    std::vector<Locus> found;
    if (from && loci.from) found.push_back(*loci.from);
    if (to && loci.to) found.push_back(*loci.to);
    if (at && (loci.at || loci.to)) found.push_back(loci.at ? *loci.at : *loci.to);
    if (found.size() != count()) return {};
    if (by_side && found.size() == 2 && is_left_of(found[0], found[1])) std::swap(found[0], found[1]);
    return found;
  }
  ProcessInput input(const std::vector<Locus>& loci) const {
    ProcessInput input;
    std::vector<double> arcs;
    std::vector<double> basis{1};
    for (const Locus& locus : loci) {
      const Eigen::Vector3d place = place_of(locus);
      input.places.push_back(place);
      if (places) basis.insert(basis.end(), {place.x(), place.y(), place.z()});
      const SpaceAngles angles = angles_of(locus.at);
      arcs.push_back(locus.self ? 0.0 : static_cast<double>(angles.azimuth) / 90);
      if (elevation) arcs.push_back(static_cast<double>(angles.elevation) / 90);
      // The signer has no place on the arc.
      basis.push_back(locus.self ? 1.0 : 0.0);
    }
    for (const double one : arcs) basis.insert(basis.end(), {one, one * one, one * one * one});
    if (arcs.size() == 2) {
      const double s = arcs[0];
      const double o = arcs[1];
      basis.insert(basis.end(), {s * o, s * s * o, s * o * o});
    }
    input.basis = Eigen::Map<const Eigen::VectorXd>(basis.data(), static_cast<Eigen::Index>(basis.size()));
    return input;
  }
  /// How far a locus is from another one, as degrees: in direction, or in distance as far as that matters.
  float away(const Locus& a, const Locus& b) const {
    if (a.self || b.self) return degrees_between(a, b);
    const float farther = std::tanh(a.at.norm() / reach) - std::tanh(b.at.norm() / reach);
    return std::max(degrees_between(a, b), std::abs(farther) * kAwayDegrees);
  }
  /// How far one radian of arc at the usual distance is between places.
  double arc() const { return static_cast<double>(std::tanh(kLocusDistance / reach)); }

 private:
  static bool is_left_of(const Locus& a, const Locus& b) {
    const float x = a.self ? 0 : angles_of(a.at).azimuth;
    const float y = b.self ? 0 : angles_of(b.at).azimuth;
    return x > y || (x == y && a.self);
  }
  /// On the line from the shoulder to the locus, at most as far as the hand reaches: farther loci differ less.
  Eigen::Vector3d place_of(const Locus& locus) const {
    const Eigen::Vector3f line = locus.at - shoulder;
    const float distance = std::max(line.norm(), 1e-3f);
    return (line * std::tanh(distance / reach) / distance).cast<double>();
  }
};

inline bool same_loci(const std::vector<Locus>& a, const std::vector<Locus>& b) {
  for (std::size_t i = 0; i < a.size(); ++i) {
    if (degrees_between(a[i], b[i]) > kSameLocus) return false;
  }
  return true;
}

}  // namespace signweave::inflection
