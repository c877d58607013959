#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "signweave/live/living_rest.h"
#include "signweave/live/player.h"
#include "signweave/live/shared_signing_cache.h"
#include "signweave/live/transition_builder.h"

/// Internal to this module.
namespace signweave {

/// Settings of a stream that its first clip determines.
struct StreamSetup {
  StreamHeader header;
  SourceRef skeleton;  ///< of the header
  std::shared_ptr<const DurationFit> fit;
  std::shared_ptr<const SignerRig> rig;
  std::shared_ptr<const CapturedSpans> spans;  ///< null: the method needs none
  std::optional<TransitionBuilder> builder;    ///< never empty
  std::shared_ptr<const LivingRest> living;    ///< null with Idle::end
  std::string key;                             ///< everything that all its transitions depend on
  std::vector<Notice> notices;                 ///< about how it will be signed
};

/// Throws what `map_body`, `captured_spans` and reading throw.
std::unique_ptr<StreamSetup> set_up(SharedSigningCache& cache, const Snapshot& snapshot,
                                    const std::shared_ptr<const Contents>& contents, const MotionClip& first,
                                    const PlayerOptions& options);

/// Identifies the frames of a clip.
std::string key_of(const MotionClip& clip);

/// The signer at rest, placed from output frame 0.
std::shared_ptr<LiveClip> place_rest(const StreamSetup& setup);

}  // namespace signweave
