#pragma once

#include "signweave/core/time.h"

/// For tests: the frame rate of the demo signer.
namespace signweave::demo {

inline constexpr FrameRate kRate{100, 1};

}  // namespace signweave::demo
