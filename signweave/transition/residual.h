#pragma once

#include <array>
#include <cstddef>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "signweave/features/residual_model.h"
#include "signweave/motion/kinematics.h"
#include "signweave/transition/arm_reach.h"
#include "signweave/transition/gap.h"

namespace signweave {

/// The joints from the trunk down to one wrist, for looking at them in many poses. Its memory is used again.
struct ArmChain {
  struct Link {
    JointIndex joint = kNoJoint;
    std::ptrdiff_t translation = -1;  ///< of the pose; below 0 where the offset stands
    Eigen::Vector3f offset = Eigen::Vector3f::Zero();
  };
  JointIndex trunk = kNoJoint;  ///< kNoJoint: this arm is not known
  ArmJoints joints;
  std::vector<Link> links;  ///< below the trunk, parents first, the wrist last

  bool known() const noexcept { return trunk != kNoJoint; }
};
void find_arm(const Skeleton& skeleton, const JointGroups& groups, Side side, ArmChain& out);
/// Where the wrist is in the space of the trunk's joint, metres; `out` has the whole chain in that space.
Eigen::Vector3f place_arm(const ArmChain& chain, PoseView pose, ModelPose& out);

/// What is seen at the borders of a gap of one arm.
struct ArmSight {
  ResidualModel::Traits traits;  ///< in the space of the trunk's joint
  ResidualModel::Gates gates{};
  float length = 0;  ///< of the arm, metres
};
/// Memory that seeing takes.
struct ArmScratch {
  std::array<ArmChain, 2> chains;  ///< [Side]
  ModelPose pose;
  std::vector<Eigen::Vector3f> before, after;  ///< [k] frames from the border
};
/// None where the arm is not known, or numbers are none.
std::optional<ArmSight> see_arm(const Gap& gap, Side side, ArmScratch& scratch);

/// Legendre polynomials of 2t − 1 times 16t²(1 − t)²: nothing at the borders, and level there.
std::array<float, ResidualModel::kBends> residual_bends(double t) noexcept;
/// The vectors of the bends, arm lengths, in the space of the trunk's joint.
ResidualModel::Bends residual_of(const ResidualModel& model, const ArmSight& sight) noexcept;
/// How much of a residual is taken in a gap of so many seconds: none below 0.3 s, where the likeliest trajectory is as
/// near as captures are to each other, all from 0.5 s on. (ours)
float residual_share(double seconds) noexcept;

/// A captured movement of one wrist, as a model learns from it.
struct ResidualSpan {
  static constexpr std::size_t kSamples = 8;
  std::size_t fold = 0;
  ArmSight sight;
  double seconds = 0;
  std::array<Eigen::Vector3f, kSamples> residual;  ///< captured less kriged at equal steps, arm lengths
  ResidualModel::Bends bends;                      ///< that come nearest to it
};
/// Of the hand that goes farther in `captured`, which lies where the gap is; `kriged` is the likeliest trajectory
/// there. None where an arm is not known, hardly moves, or numbers are none.
std::optional<ResidualSpan> residual_span(std::size_t fold, const Gap& gap, PosesView captured, PosesView kriged,
                                          ArmScratch& scratch);

/// Learns from at most `most` spans, as many of each fold where there are so many. Too few teach nothing.
ResidualModel fit_residuals(std::span<const ResidualSpan* const> spans, std::size_t most);
/// The mean distance of a wrist from where it was captured, arm lengths: of the likeliest trajectory, or of that with
/// what the model adds.
float error_of(const ResidualSpan& span, const ResidualModel* model) noexcept;

/// Learns from all spans, having compared by leaving out each fold in turn (at most kMostFolds, of several folds
/// together). The figures are there where it does not win, too; its centres are not.
ResidualModel learn_residuals(std::span<const ResidualSpan> spans);
inline constexpr std::size_t kMostFolds = 8;
inline constexpr std::size_t kMostCentres = 300;
inline constexpr std::size_t kLeastSpans = 24;

}  // namespace signweave
