#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "signweave/choose/concatenate.h"
#include "signweave/choose/junction_timer.h"
#include "signweave/motion/blend.h"
#include "signweave/motion/motion.h"

namespace signweave {

/// A clip among the output frames of a `TransitionBuilder`. Its address must not change once it is placed.
struct LiveClip {
  MotionClip captured;
  PlacedClip placed;                  ///< points to `captured`
  bool aligned = false;               ///< it is moved to where the home clip's signer stands
  std::vector<std::size_t> track_of;  ///< [track of its source] index of the result's track, or kNoTrack
  static constexpr std::size_t kNoTrack = static_cast<std::size_t>(-1);
  std::string key;                   ///< set by the caller: identifies its frames; empty: unique
  std::optional<JunctionCuts> cuts;  ///< of the junction before it; none: not joined
  std::size_t number = 0;            ///< set by the caller: number within the stream

  LiveClip() = default;
  LiveClip(const LiveClip&) = delete;
  LiveClip& operator=(const LiveClip&) = delete;
};

/// Joins clips one after another, without knowing the following ones. Gives the same frames as `concatenate` for all of
/// them. The cost of a junction does not depend on the length of the utterance. Used by one thread.
class TransitionBuilder {
 public:
  /// Everything that the settings point to must outlive it. `tracks` are the names of the result's scalar tracks; other
  /// tracks of clips are ignored. `home` is the clip to whose signer's standing all others are moved; its frames are
  /// read here, and it is not stored. Throws Error{corrupt}.
  TransitionBuilder(const JunctionSettings& settings, const TransitionTiming& timing, std::vector<std::string> tracks,
                    Alignment alignment, const MotionClip& home);

  const JunctionSettings& settings() const noexcept { return settings_; }
  const std::vector<std::string>& tracks() const noexcept { return tracks_; }
  const Standing& home() const noexcept { return home_; }

  /// Places `clip.captured` as a sign: at the timing's tempo, with its core at output frame 0 for now. Throws
  /// Error{bad_input} if its skeleton differs in more than offsets.
  void place_sign(LiveClip& clip) const;
  /// Places a clip whose frames are output frames already, in their final position.
  void place_frames(LiveClip& clip) const;

  /// Positions a clip that has no predecessor.
  void place_first(LiveClip& clip);
  /// Maximum number of frames generated between two clips.
  static constexpr std::int64_t kMostMade = 20'000;
  /// Places b after a and makes the frames between: `made` gets those from the end of a's core to the begin of b's
  /// core, with the tracks. Frames of a before the end of its core are unchanged. Throws Error{corrupt},
  /// Error{bad_input} if there would be more than kMostMade.
  JunctionCuts join(LiveClip& a, LiveClip& b, Motion& made);

  /// Reads output frames of a placed clip: of its preparation, core or retraction. `tracks` has one span per track.
  void read(const LiveClip& clip, FrameRange frames, MutablePoses out, std::span<const std::span<float>> tracks) const;

 private:
  JunctionSettings settings_;
  double tempo_;
  std::vector<std::string> tracks_;
  Alignment alignment_;
  std::string home_recording_;
  Standing home_;
  JunctionTimer timer_;
  JunctionFiller filler_;
};

}  // namespace signweave
