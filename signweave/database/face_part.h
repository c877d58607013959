#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "signweave/core/error.h"
#include "signweave/core/time.h"
#include "signweave/motion/motion.h"

namespace signweave {

/// Returns the motion's time of a face capture's first row, if it is given: as an offset, or by the timecode of the
/// motion's frame 0 on the capture's clock. Throws Error{bad_input}; with a timecode also as face_csv::read does.
std::optional<Seconds> given_face_offset(const std::filesystem::path& path, std::optional<Seconds> offset,
                                         const std::optional<std::string>& motion_timecode);

/// Adds a face capture's tracks to a motion, its first row at `offset` of the motion. Beyond the capture its first and
/// last values are held. Tracks of the capture replace tracks of the motion of the same names. Returns how many of the
/// resulting tracks are the motion's own; they come first. Throws Error{bad_input} for a face outside of the motion,
/// and as face_csv::read does.
std::size_t add_face(const std::filesystem::path& path, Seconds offset, Motion& motion, std::vector<Notice>& notices);

}  // namespace signweave
