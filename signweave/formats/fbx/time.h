#pragma once

#include <cstdint>
#include <vector>

#include "signweave/core/error.h"
#include "signweave/core/time.h"
#include "signweave/formats/fbx/curve.h"
#include "signweave/formats/fbx/scene.h"

/// When the frames of a take are.
namespace signweave::fbx {

struct Frames {
  FrameRate rate;
  std::vector<std::int64_t> ticks;  ///< [frame], ascending
};

/// The rate that the settings name, or none.
std::optional<FrameRate> rate_of(const Settings& settings);

/// The lowest standard rate at which all these times (ascending) stand, counted from the first, or none.
std::optional<FrameRate> rate_of(const std::vector<std::int64_t>& ticks);

/// From the take's start to its stop, where the file tells them and keys lie there; else from the first key to the
/// last. `joints` bounds their number. Notices say what was assumed. Throws Error{bad_input}.
Frames frames_of(const Source& source, const Scene& scene, const Take& take, const std::vector<std::int64_t>& keys,
                 std::optional<FrameRate> wanted, std::size_t joints, std::vector<Notice>& notices);

}  // namespace signweave::fbx
