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

/// The joints from the trunk down to one wrist, to be evaluated in many poses. Its memory is reused.
struct ArmChain {
  struct Link {
    JointIndex joint = kNoJoint;
    std::ptrdiff_t translation = -1;  ///< index in the pose; negative: the joint has a fixed offset
    Eigen::Vector3f offset = Eigen::Vector3f::Zero();
  };
  JointIndex trunk = kNoJoint;  ///< kNoJoint: this arm is unknown
  ArmJoints joints;
  std::vector<Link> links;  ///< below the trunk, parents first, the wrist last

  bool known() const noexcept { return trunk != kNoJoint; }
};
void find_arm(const Skeleton& skeleton, const JointGroups& groups, Side side, ArmChain& out);
/// The wrist in the space of the trunk joint, metres; `out` gets the whole chain in that space.
Eigen::Vector3f place_arm(const ArmChain& chain, PoseView pose, ModelPose& out);

/// Features of one arm at the borders of a gap.
struct ArmSight {
  ResidualModel::Traits traits;  ///< in the space of the trunk joint
  ResidualModel::Gates gates{};
  float length = 0;  ///< of the arm, metres
};
/// Memory of see_arm.
struct ArmScratch {
  std::array<ArmChain, 2> chains;  ///< [Side]
  ModelPose pose;
  std::vector<Eigen::Vector3f> before, after;  ///< [k] frames from the border
};
/// Returns none if the arm is unknown or values are not finite.
std::optional<ArmSight> see_arm(const Gap& gap, Side side, ArmScratch& scratch);

/// Legendre polynomials of 2t − 1 times 16t²(1 − t)²: zero with zero slope at the borders.
std::array<float, ResidualModel::kBends> residual_bends(double t) noexcept;
/// The vectors of the bends, in arm lengths, in the space of the trunk joint.
ResidualModel::Bends residual_of(const ResidualModel& model, const ArmSight& sight) noexcept;
/// The share of a residual used in a gap of `seconds`: none below 0.3 s, where the most likely trajectory is as near as
/// captures are to each other; all from 0.5 s. (ours)
float residual_share(double seconds) noexcept;

/// A captured movement of one wrist, from which a model learns.
struct ResidualSpan {
  static constexpr std::size_t kSamples = 8;
  std::size_t fold = 0;
  ArmSight sight;
  double seconds = 0;
  std::array<Eigen::Vector3f, kSamples> residual;  ///< captured minus kriged at equal steps, arm lengths
  ResidualModel::Bends bends;                      ///< the best fit to `residual`
};
/// The residual of the hand that moves farther in `captured`, the frames of the gap; `kriged` is the most likely
/// trajectory there. Returns none if an arm is unknown or hardly moves, or values are not finite.
std::optional<ResidualSpan> residual_span(std::size_t fold, const Gap& gap, PosesView captured, PosesView kriged,
                                          ArmScratch& scratch);

/// Learns from at most `most` spans, taken equally from the folds as far as possible. With too few spans the model is
/// empty.
ResidualModel fit_residuals(std::span<const ResidualSpan* const> spans, std::size_t most);
/// The mean distance of a wrist from its captured position, in arm lengths: for the most likely trajectory, or with the
/// model's residual added.
float error_of(const ResidualSpan& span, const ResidualModel* model) noexcept;

/// Learns from all spans, after cross-validation that leaves out each fold in turn (folds are combined into at most
/// kMostFolds). If the model does not win, the figures are still reported but its centres are omitted.
ResidualModel learn_residuals(std::span<const ResidualSpan> spans);
inline constexpr std::size_t kMostFolds = 8;
inline constexpr std::size_t kMostCentres = 300;
inline constexpr std::size_t kLeastSpans = 24;

}  // namespace signweave
