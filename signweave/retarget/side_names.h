#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace signweave {

/// Returns the name with left and right exchanged: `browDownLeft` -> `browDownRight`, `leftEyeYaw` -> `rightEyeYaw`,
/// `hand_L` -> `hand_R`; case is kept. Empty if the name contains no word, or single letter between separators, that
/// denotes a side.
std::optional<std::string> other_side(std::string_view name);

}  // namespace signweave
