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

/// Where clips have other joints than `home`, which is the motion of the recording `reference`, puts them onto its
/// skeleton, frame by frame as they are read; a recording is looked at once. Those with the same joints stay as they
/// are. The clips' recordings must be of `contents`. Adds what each mapping has to say to `notices`. Throws
/// Error{bad_input} where a mapping is not safe (see match_bodies).
void put_on_skeleton(std::vector<MotionClip>& clips, const std::string& reference, const MotionSource& home,
                     const Contents& contents, std::vector<Notice>& notices);

/// True where the two are of one kind: motions of both can be joined as they are.
bool have_same_joints(const std::shared_ptr<const Skeleton>& a, const std::shared_ptr<const Skeleton>& b);

/// Throws Error{bad_input}, which names a joint, where a clip has other joints than the recording
/// `reference`.
void require_same_joints(const std::string& reference, const std::shared_ptr<const Skeleton>& joints,
                         const MotionClip& clip);

/// The body of a recording of `contents`, whose motion `source` is.
RecordedBody body_of(const Contents& contents, const std::string& recording, const MotionSource& source);

}  // namespace signweave
