#pragma once

#include <filesystem>
#include <functional>
#include <string>

#include "signweave/motion/motion.h"

namespace signweave {

/// Writes where every joint and tip is: one row a frame, columns frame, time_s, then NAME.x, NAME.y, NAME.z in metres,
/// model space, Y up. Names are quoted where they hold a comma or a quote. Whole or not at all; throws Error{io}.
void write_positions_csv(const std::filesystem::path& path, const Motion& motion,
                         const std::function<void(double fraction)>& progress = {});

/// The heading, and one row: for other writers of the same table.
std::string positions_csv_heading(const Skeleton& skeleton);
std::string positions_csv_row(const Motion& motion, std::int64_t frame);

}  // namespace signweave
