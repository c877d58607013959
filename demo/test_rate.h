#pragma once

#include "signweave/core/time.h"

/// For tests: the rate that the demo's signer is tested at.
namespace signweave::demo {

inline constexpr FrameRate kRate{100, 1};

}  // namespace signweave::demo
