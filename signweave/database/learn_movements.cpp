#include <algorithm>
#include <map>

#include "signweave/database/database.h"
#include "signweave/database/learn.h"
#include "signweave/transition/joint_groups.h"
#include "signweave/transition/movements.h"

namespace signweave {
namespace {

// Limits of learning; recordings and movements are evenly spread.
constexpr std::size_t kMostMovementRecordings = 24;
constexpr std::size_t kMostMovements = 600;
constexpr double kMostSeconds = 60;  ///< of one recording, from its middle

std::vector<ResidualSpan> movements_of(const Snapshot& snapshot, const RecordingInfo& info, std::size_t most,
                                       std::size_t fold) {
  const std::unique_ptr<MotionSource> source = snapshot.motion(info);
  const auto frames = std::min(source->frame_count(), static_cast<std::int64_t>(kMostSeconds * source->rate().hertz()));
  const std::int64_t first = (source->frame_count() - frames) / 2;
  Motion motion;
  motion.reset(source->skeleton(), source->rate(), frames);
  source->read({first, first + frames}, motion.poses({0, frames}));
  const JointGroups groups = joint_groups(motion.skeleton(), snapshot.signer(info)->rig);
  ArmScratch scratch;
  return residual_spans(motion, groups, captured_movements(motion, groups, most, scratch), fold);
}

}  // namespace

ResidualModel learn_movements(const Snapshot& snapshot) {
  std::vector<const RecordingInfo*> all;
  for (const RecordingInfo& info : snapshot.contents().recordings) {
    if (info.motion && info.motion->frames > 0) all.push_back(&info);
  }
  std::vector<const RecordingInfo*> chosen;
  for (std::size_t i = 0, most = std::min(all.size(), kMostMovementRecordings); i < most; ++i) {
    chosen.push_back(all[i * all.size() / most]);
  }
  std::map<std::string, std::size_t> signers;
  for (const RecordingInfo* info : chosen) signers.try_emplace(info->signer, signers.size());
  const bool by_signer = signers.size() > 1 && !signers.contains("");
  std::vector<ResidualSpan> spans;
  std::uint64_t recordings = 0;
  for (std::size_t i = 0; i < chosen.size(); ++i) {
    try {
      const auto found = movements_of(snapshot, *chosen[i], kMostMovements / chosen.size(),
                                      by_signer ? signers.at(chosen[i]->signer) : i);
      recordings += found.empty() ? 0 : 1;
      spans.insert(spans.end(), found.begin(), found.end());
    } catch (const Error& error) {  // `check` reports it
      if (error.code() != ErrorCode::corrupt && error.code() != ErrorCode::not_found) throw;
    }
  }
  ResidualModel model = learn_residuals(spans);
  model.recordings = recordings;
  model.by_signer = by_signer;
  return model;
}

}  // namespace signweave
