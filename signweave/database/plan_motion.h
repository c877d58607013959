#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "signweave/core/error.h"
#include "signweave/core/time.h"
#include "signweave/database/plan_input.h"
#include "signweave/database/recording.h"

/// Internal to `database`: the part of an import plan about the motion and its face.
namespace signweave {

/// The decision what to do with motion and face, made by checksums and options before the motion is read.
struct MotionDecision {
  bool stores = false;        ///< a motion is stored
  bool face_added = false;    ///< because the stored motion, which is the same, gets its first face
  bool face_changed = false;  ///< because its face is another, or is placed elsewhere
  Seconds face_offset{0};     ///< the motion's time of the face's first row
};

/// Decides that. Throws Error{conflict} for a changed motion or face unless options.replace_motion; also as
/// given_face_offset does.
MotionDecision decide_motion(const PlanInput& input);

/// The motion of the recording after the import.
struct PlannedMotion {
  std::optional<MotionPart> part;  ///< to be stored; none: the stored one is kept, or there is none
  FrameRate rate;                  ///< meaningful if there is a motion
  std::int64_t frames = 0;         ///< 0: no motion
  std::vector<Notice> notices;
};

/// Reads the motion to be stored. Throws as the readers of motion and face do.
PlannedMotion plan_motion(const PlanInput& input, const MotionDecision& decision);

/// Throws Error{bad_input} or Error{not_found} if the mapping file of this import, or of an earlier one, does not fit
/// the motion.
void check_rig(const PlanInput& input, const PlannedMotion& motion);

}  // namespace signweave
