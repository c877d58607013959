// The body of a recording's signer, measured once until the database changes.
#include "signweave/database/database.h"
#include "signweave/features/from_source.h"
#include "signweave/retarget/mirroring.h"
#include "signweave/retarget/recorded_body.h"

namespace signweave {

std::shared_ptr<const SignerModel> Snapshot::signer(const RecordingInfo& recording) const {
  const Database& database = *database_;
  if (recording.motion) {
    const std::lock_guard guard(database.mutex_);
    const auto at = database.signers_.find(recording.motion->generation);
    if (database.contents_ == contents_ && at != database.signers_.end()) return at->second;
  }
  auto made = std::make_shared<const SignerModel>(model_of(*motion(recording), recording.rig));
  const std::lock_guard guard(database.mutex_);
  if (database.contents_ == contents_) database.signers_[recording.motion->generation] = made;
  return made;
}

std::shared_ptr<const Mirroring> Snapshot::mirroring(const RecordingInfo& recording) const {
  const Database& database = *database_;
  if (recording.motion) {
    const std::lock_guard guard(database.mutex_);
    const auto at = database.mirrorings_.find(recording.motion->generation);
    if (database.contents_ == contents_ && at != database.mirrorings_.end()) return at->second;
  }
  auto made =
      std::make_shared<const Mirroring>(mirroring_of(recorded_body(recording.name, *motion(recording), recording.rig)));
  const std::lock_guard guard(database.mutex_);
  if (database.contents_ == contents_) database.mirrorings_[recording.motion->generation] = made;
  return made;
}

}  // namespace signweave
