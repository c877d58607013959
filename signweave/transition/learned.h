#pragma once

#include <array>
#include <cstddef>
#include <memory>
#include <span>
#include <vector>

#include "signweave/features/residual_model.h"
#include "signweave/transition/curves.h"
#include "signweave/transition/model.h"

/// What a model holds: for this module, and the tool that trains it.
namespace signweave {

/// Durations between which learned numbers are interpolated in the logarithm, seconds; beyond them the nearest holds.
inline constexpr std::array kKnots = {0.17, 0.28, 0.52, 0.735, 1.064};
/// Where a duration lies between two knots.
struct BetweenKnots {
  std::size_t lower = 0;
  double part = 0;  ///< of the knot after `lower`, in [0, 1]
};
BetweenKnots between_knots(double seconds) noexcept;

/// What is learned about ways: the correction of the kriged way is a sum of kBends functions of time, each times a sum
/// of kTraits vectors that are seen at the borders.
inline constexpr std::size_t kBends = 4;
inline constexpr std::size_t kTraits = 3;
inline constexpr std::size_t kBendRoles = 4;  ///< trunk, shoulder, elbow, other_arm
inline constexpr std::size_t kBendsOfKnot = kBendRoles * kBends * kTraits;
using Bends = std::array<float, kBendsOfKnot>;  ///< [role − trunk][bend][trait]

/// Legendre polynomials of 2t − 1 times 16t²(1 − t)²: nothing at the borders, and level there, so that velocities go
/// on.
std::array<double, kBends> bends_at(double t) noexcept;
/// From border to border; on as at the left border; on as at the right one: rotation vectors, rad.
std::array<Eigen::Vector3f, kTraits> traits_of(const Sides& sides) noexcept;

/// What of a border goes on into a gap only in part.
enum class Damped : std::uint8_t {
  velocity = 0,  ///< of the cubic
  quintic_velocity = 1,
  quintic_acceleration = 2,
};
inline constexpr std::size_t kDamped = 3;
/// How much of it does, [knot][group][Damped]; 1: all.
using Damping = std::array<std::array<std::array<float, kDamped>, kJointGroups>, kKnots.size()>;
constexpr Damping undamped() noexcept {
  Damping damping{};
  for (auto& knot : damping) {
    for (auto& group : knot) group.fill(1.0f);
  }
  return damping;
}

/// One captured span, as `recorded` uses it.
struct CapturedSpan {
  static constexpr std::size_t kPoints = 16;
  static constexpr std::size_t kTraitsOfJoint = 3 * kTraits;
  std::size_t recording = 0;
  float seconds = 0;
  std::vector<float> traits;            ///< [joint][trait, x y z] what is compared, see describe_span
  std::vector<Eigen::Vector3f> strays;  ///< [joint][point] how it strays from the kriged way at equal steps, rad
};
/// Captured spans of skeletons that have the same joints.
struct SpanLibrary {
  std::vector<CapturedSpan> spans;
  std::vector<Joint> joints;  ///< of the first of them
};
/// True where a skeleton's joints have the names and parents of a library's: vectors in their axes mean the same then.
bool is_of(const SpanLibrary& library, const Skeleton& skeleton) noexcept;

inline constexpr std::size_t kMostSpans = 4000;  ///< of a library: those that came first
/// Keeps a captured span in the library of its joints, in `libraries`; one whose numbers are none is left out, and so
/// are those beyond kMostSpans. True where it was kept.
bool keep_span(std::size_t recording, const Gap& gap, PosesView captured, GapScratch& scratch,
               std::vector<std::shared_ptr<SpanLibrary>>& libraries);
/// What of a gap is compared with captured spans: of each joint the way from border to border, and half of how it goes
/// on at both.
void describe_span(const Gap& gap, GapScratch& scratch, std::vector<float>& traits);

struct TransitionModel {
  std::size_t spans = 0;  ///< that it was learned from
  std::array<Bends, kKnots.size()> bends{};
  Damping damping = undamped();
  std::vector<std::shared_ptr<const SpanLibrary>> libraries = {};  ///< one for each set of joints
  std::size_t purged = static_cast<std::size_t>(-1);               ///< spans of this recording are not looked at
  std::shared_ptr<const ResidualModel> residuals = {};             ///< null: nobody taught any
};

/// How much of a border's velocity or acceleration goes on into a gap.
float damping_of(const TransitionModel& model, Damped which, JointGroup group, double seconds) noexcept;

/// The vectors that correct one joint's way, one a bend; zero for roles that have none.
std::array<Eigen::Vector3f, kBends> corrections_of(const TransitionModel& model, const Sides& sides) noexcept;

}  // namespace signweave
