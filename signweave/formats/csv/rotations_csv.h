#pragma once

#include <filesystem>
#include <functional>
#include <string>

#include "signweave/motion/motion.h"

namespace signweave {

/// Writes the rotation of every joint: one row per frame, columns frame, time_s, then for each joint NAME.tx, NAME.ty,
/// NAME.tz in metres if it has a translation per frame, and NAME.qx, NAME.qy, NAME.qz, NAME.qw, a unit quaternion
/// relative to the parent, in the hemisphere of the previous frame. Y up, right-handed. Numbers have enough digits for
/// an exact float round trip. Written atomically; throws Error{io}.
void write_rotations_csv(const std::filesystem::path& path, const Motion& motion,
                         const std::function<void(double fraction)>& progress = {});

/// The heading and one row, for other writers of the same table.
std::string rotations_csv_heading(const Skeleton& skeleton);
std::string rotations_csv_row(const Motion& motion, std::int64_t frame);

}  // namespace signweave
