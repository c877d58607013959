#pragma once

#include <array>
#include <cstddef>
#include <memory>
#include <span>
#include <vector>

#include "signweave/features/residual_model.h"
#include "signweave/transition/curves.h"
#include "signweave/transition/model.h"

/// The contents of a model, for this module and the tool that trains it.
namespace signweave {

/// Durations in seconds at which values are learned. Values are interpolated in the logarithm of the duration; beyond
/// the ends the nearest is used.
inline constexpr std::array kKnots = {0.17, 0.28, 0.52, 0.735, 1.064};
/// Position of a duration between two knots.
struct BetweenKnots {
  std::size_t lower = 0;
  double part = 0;  ///< weight of the knot after `lower`, in [0, 1]
};
BetweenKnots between_knots(double seconds) noexcept;

/// The learned correction of the kriged trajectory is a sum of kBends functions of time, each multiplied by a weighted
/// sum of kTraits vectors measured at the borders.
inline constexpr std::size_t kBends = 4;
inline constexpr std::size_t kTraits = 3;
inline constexpr std::size_t kBendRoles = 4;  ///< trunk, shoulder, elbow, other_arm
inline constexpr std::size_t kBendsOfKnot = kBendRoles * kBends * kTraits;
using Bends = std::array<float, kBendsOfKnot>;  ///< [role − trunk][bend][trait]

/// Legendre polynomials of 2t − 1 times 16t²(1 − t)²: zero with zero slope at the borders, so that velocities are
/// continuous.
std::array<double, kBends> bends_at(double t) noexcept;
/// The difference between the borders, the continuation of the left border's velocity, and that of the right border's:
/// rotation vectors, rad.
std::array<Eigen::Vector3f, kTraits> traits_of(const Sides& sides) noexcept;

/// A derivative at a border that continues into a gap only in part.
enum class Damped : std::uint8_t {
  velocity = 0,  ///< of the cubic
  quintic_velocity = 1,
  quintic_acceleration = 2,
};
inline constexpr std::size_t kDamped = 3;
/// The share that continues, [knot][group][Damped]; 1: all.
using Damping = std::array<std::array<std::array<float, kDamped>, kJointGroups>, kKnots.size()>;
constexpr Damping undamped() noexcept {
  Damping damping{};
  for (auto& knot : damping) {
    for (auto& group : knot) group.fill(1.0f);
  }
  return damping;
}

/// A captured span, for the method `recorded`.
struct CapturedSpan {
  static constexpr std::size_t kPoints = 16;
  static constexpr std::size_t kTraitsOfJoint = 3 * kTraits;
  std::size_t recording = 0;
  float seconds = 0;
  std::vector<float> traits;            ///< [joint][trait, x y z] compared features, see describe_span
  std::vector<Eigen::Vector3f> strays;  ///< [joint][point] deviation from the kriged trajectory at equal steps, rad
};
/// Captured spans of skeletons with the same joints.
struct SpanLibrary {
  std::vector<CapturedSpan> spans;
  std::vector<Joint> joints;  ///< of the first span's skeleton
};
/// True if a skeleton's joints have the names and parents of a library's joints, so that vectors in their axes are
/// comparable.
bool is_of(const SpanLibrary& library, const Skeleton& skeleton) noexcept;

inline constexpr std::size_t kMostSpans = 4000;  ///< of a library: the first ones added
/// Adds a captured span to the library of its joints in `libraries`. Spans with non-finite values, and those beyond
/// kMostSpans, are skipped. Returns true if it was added.
bool keep_span(std::size_t recording, const Gap& gap, PosesView captured, GapScratch& scratch,
               std::vector<std::shared_ptr<SpanLibrary>>& libraries);
/// The features by which a gap is compared with captured spans: for each joint the difference between the borders, and
/// half the continuation of the velocity at each border.
void describe_span(const Gap& gap, GapScratch& scratch, std::vector<float>& traits);

struct TransitionModel {
  std::size_t spans = 0;  ///< number it was learned from
  std::array<Bends, kKnots.size()> bends{};
  Damping damping = undamped();
  std::vector<std::shared_ptr<const SpanLibrary>> libraries = {};  ///< one per set of joints
  std::size_t purged = static_cast<std::size_t>(-1);               ///< spans of this recording are ignored
  std::shared_ptr<const ResidualModel> residuals = {};             ///< null: none learned
};

/// The share of a border's velocity or acceleration that continues into a gap.
float damping_of(const TransitionModel& model, Damped which, JointGroup group, double seconds) noexcept;

/// The vectors that correct one joint's trajectory, one per bend; zero for roles without correction.
std::array<Eigen::Vector3f, kBends> corrections_of(const TransitionModel& model, const Sides& sides) noexcept;

}  // namespace signweave
