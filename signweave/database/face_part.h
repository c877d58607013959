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

/// The motion's time of a face capture's first row, where somebody says it: as an offset, or by the timecode that frame
/// 0 of the motion has on the capture's clock. Throws Error{bad_input}; with a timecode also as face_csv::read does.
std::optional<Seconds> given_face_offset(const std::filesystem::path& path, std::optional<Seconds> offset,
                                         const std::optional<std::string>& motion_timecode);

/// Adds a face capture's tracks to a motion, its first row at `offset` of the motion, its first and last values held
/// beyond it. Where the motion has tracks of the same names, the capture's stand instead. Answers how many of the
/// motion's tracks, the first, are its own. Throws Error{bad_input} for a face that lies outside of the motion, and as
/// face_csv::read does.
std::size_t add_face(const std::filesystem::path& path, Seconds offset, Motion& motion, std::vector<Notice>& notices);

}  // namespace signweave
