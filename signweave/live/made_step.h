#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "signweave/core/error.h"
#include "signweave/live/made_cache.h"
#include "signweave/motion/blend.h"
#include "signweave/score/score.h"

/// Internal to this module.
namespace signweave {

/// What signs that were placed together show, and where (LaneStep), for any stream that signs the same.
struct MadeStep {
  /// A clip of the step, numbered as when it was made.
  struct Placed {
    std::int64_t to_core = 0;
    double step = 1;
    std::int64_t core_frames = 1;
    std::optional<GroundTransform> standing = {};
  };
  struct Link {
    std::size_t clip = 0;
    std::int64_t held = 0;
    std::optional<std::size_t> held_until;
    TransitionCut cut;
    std::optional<HandPlace> place;
  };
  std::shared_ptr<const Motion> frames;
  std::optional<Error> refused = {};  ///< these clips cannot be placed together; the rest is empty
  std::vector<Placed> clips;
  std::array<std::vector<Link>, kAllChannels.size()> lanes;
  std::vector<Notice> notices = {};  ///< of lint_channels
};
std::size_t held_bytes(const MadeStep& made) noexcept;
using StepCache = MadeCache<MadeStep>;

}  // namespace signweave
