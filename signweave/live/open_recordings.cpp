#include "signweave/live/open_recordings.h"

#include <fmt/format.h>

#include "signweave/core/error.h"

namespace signweave {

const Snapshot& OpenRecordings::snapshot() {
  if (!snapshot_) snapshot_ = database_.snapshot();
  return *snapshot_;
}

const MotionSource& OpenRecordings::motion(const std::string& recording, const motion_db::StoredMotion& stored) {
  std::unique_ptr<MotionSource>& motion = motions_[stored.generation];
  if (!motion) {
    const RecordingInfo* const info = snapshot().contents().find(recording);
    const auto alike = [](const motion_db::StoredMotion& a, const motion_db::StoredMotion& b) {
      return a.rate == b.rate && a.frames == b.frames && a.joints == b.joints && a.translations == b.translations &&
             a.tracks == b.tracks;
    };
    if (info == nullptr || !info->motion || !alike(*info->motion, stored)) {
      throw Error(ErrorCode::conflict,
                  fmt::format("recording '{}' was replaced or removed while it was signed", recording));
    }
    motion = snapshot().motion(*info);
  }
  return *motion;
}

void OpenRecordings::close() noexcept {
  motions_.clear();
  snapshot_.reset();
}

RecordingSource::RecordingSource(OpenRecordings& open, const RecordingInfo& recording)
    : open_(open),
      recording_(recording.name),
      stored_(*recording.motion),
      skeleton_(open.motion(recording_, stored_).skeleton()) {}

}  // namespace signweave
