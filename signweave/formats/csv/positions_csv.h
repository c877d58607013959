#pragma once

#include <filesystem>
#include <functional>
#include <string>

#include "signweave/motion/motion.h"

namespace signweave {

/// Writes the position of every joint and tip: one row per frame, columns frame, time_s, then NAME.x, NAME.y, NAME.z in
/// metres, model space, Y up. Names are quoted if they contain a comma or a quote. Written atomically; throws
/// Error{io}.
void write_positions_csv(const std::filesystem::path& path, const Motion& motion,
                         const std::function<void(double fraction)>& progress = {});

/// The heading and one row, for other writers of the same table.
std::string positions_csv_heading(const Skeleton& skeleton);
std::string positions_csv_row(const Motion& motion, std::int64_t frame);

}  // namespace signweave
