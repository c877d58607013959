#pragma once

#include <cstdint>
#include <vector>

#include "signweave/core/error.h"
#include "signweave/core/time.h"
#include "signweave/formats/fbx/curve.h"
#include "signweave/formats/fbx/scene.h"

/// The times of the frames of a take.
namespace signweave::fbx {

struct Frames {
  FrameRate rate;
  std::vector<std::int64_t> ticks;  ///< [frame], ascending
};

/// The rate that the settings name, or nullopt.
std::optional<FrameRate> rate_of(const Settings& settings);

/// The lowest standard rate that has a frame at each of these times (ascending), counted from the first, or nullopt.
std::optional<FrameRate> rate_of(const std::vector<std::int64_t>& ticks);

/// From the take's start to its stop, if the file gives them and there are keys between them; otherwise from the first
/// key to the last. `joints` bounds their number. Notices say what was assumed. Throws Error{bad_input}.
Frames frames_of(const Source& source, const Scene& scene, const Take& take, const std::vector<std::int64_t>& keys,
                 std::optional<FrameRate> wanted, std::size_t joints, std::vector<Notice>& notices);

}  // namespace signweave::fbx
