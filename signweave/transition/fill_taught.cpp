#include "signweave/transition/curves.h"
#include "signweave/transition/fade.h"
#include "signweave/transition/fill.h"
#include "signweave/transition/learned.h"
#include "signweave/transition/residual.h"

namespace signweave {
namespace {

void bend_arm(const GapJob& job, Side side, float share, MutablePoses out) {
  const Gap& gap = job.gap;
  ArmScratch& scratch = job.scratch.arms;
  const std::optional<ArmSight> sight = see_arm(gap, side, scratch);
  if (!sight) return;
  const ArmChain& chain = scratch.chains[static_cast<std::size_t>(side)];
  ResidualModel::Bends bends = residual_of(*job.model.residuals, *sight);
  for (Eigen::Vector3f& bend : bends) bend *= share * sight->length;
  const GapTime time(gap);
  for (std::int64_t frame = 0; frame < gap.count; ++frame) {
    const MutablePoseView pose = pose_at(*gap.skeleton, out, frame);
    place_arm(chain, pose, scratch.pose);
    const auto at = residual_bends(time.at(frame));
    Eigen::Vector3f shift = Eigen::Vector3f::Zero();
    for (std::size_t bend = 0; bend < at.size(); ++bend) shift += at[bend] * bends[bend];
    shift_wrist(*gap.skeleton, chain.joints, scratch.pose, shift, pose);
  }
}

}  // namespace

void fill_taught(const GapJob& job, MutablePoses out) noexcept {
  fill_kriging(job, out);
  if (job.model.residuals == nullptr || job.model.residuals->centres.empty() || job.gap.pause > Seconds(0)) return;
  const float share = residual_share(GapTime(job.gap).seconds());
  if (!(share > 0)) return;
  for (const Side side : kSides) {
    if (job.groups.has(arm_of(side))) bend_arm(job, side, share, out);
  }
}

}  // namespace signweave
