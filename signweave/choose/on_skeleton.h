#pragma once

#include <cstddef>
#include <memory>
#include <string>
#include <vector>

#include "signweave/core/error.h"
#include "signweave/database/database.h"
#include "signweave/retarget/recorded_body.h"
#include "signweave/score/motion_clip.h"

namespace signweave {

/// Retargets clips with other joints than `home`, the motion of the recording `reference`, to its skeleton, frame by
/// frame when they are read; each recording is examined once. Clips with the same joints are unchanged. The clips'
/// recordings must be in `contents`. Adds the messages of each mapping to `notices`. Throws Error{bad_input} if a
/// mapping is not safe (see match_bodies).
void put_on_skeleton(std::vector<MotionClip>& clips, const std::string& reference, const MotionSource& home,
                     const Contents& contents, std::vector<Notice>& notices);

/// True if motions of both skeletons can be joined without retargeting.
bool have_same_joints(const std::shared_ptr<const Skeleton>& a, const std::shared_ptr<const Skeleton>& b);

/// Throws Error{bad_input}, naming a joint, if a clip has other joints than the recording `reference`.
void require_same_joints(const std::string& reference, const std::shared_ptr<const Skeleton>& joints,
                         const MotionClip& clip);

/// The body of a recording of `contents`; `source` is its motion.
RecordedBody body_of(const Contents& contents, const std::string& recording, const MotionSource& source);

}  // namespace signweave
