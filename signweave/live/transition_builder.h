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

/// A clip as it lies among the output frames of a `TransitionBuilder`. Not moved once it is placed.
struct LiveClip {
  MotionClip captured;
  PlacedClip placed;                  ///< points to the clip
  bool aligned = false;               ///< it is brought to where the home's signer stands
  std::vector<std::size_t> track_of;  ///< [track of its source] which of the result's it is; kNoTrack: none
  static constexpr std::size_t kNoTrack = static_cast<std::size_t>(-1);
  std::string key;                   ///< the caller's: tells it from others; empty where no other is like it
  std::optional<JunctionCuts> cuts;  ///< of the junction before it; none: it was not joined
  std::size_t number = 0;            ///< the caller's: of the clips of a stream

  LiveClip() = default;
  LiveClip(const LiveClip&) = delete;
  LiveClip& operator=(const LiveClip&) = delete;
};

/// Joins clips one after another, while it is not known what comes: the same frames as `concatenate` makes of all
/// of them. A junction costs the same however long the utterance is. Belongs to one thread.
class TransitionBuilder {
 public:
  /// What the settings point to must outlive it. `tracks`: names of the result's scalar tracks; those of clips that
  /// are not among them are left out. `home`: the clip where whose signer stands all others are brought; its frames
  /// are read here, and it is not kept. Throws Error{corrupt}.
  TransitionBuilder(const JunctionSettings& settings, const TransitionTiming& timing, std::vector<std::string> tracks,
                    Alignment alignment, const MotionClip& home);

  const JunctionSettings& settings() const noexcept { return settings_; }
  const std::vector<std::string>& tracks() const noexcept { return tracks_; }
  const Standing& home() const noexcept { return home_; }

  /// Lays `clip.captured` as what is signed: at the settings' tempo, core at output frame 0 for now. Throws
  /// Error{bad_input} where its skeleton differs in more than offsets.
  void place_sign(LiveClip& clip) const;
  /// Lays what is in output frames already, and where it belongs.
  void place_frames(LiveClip& clip) const;

  /// Where a clip that none is before stands.
  void place_first(LiveClip& clip);
  /// No more frames are made between two clips.
  static constexpr std::int64_t kMostMade = 20'000;
  /// Lays b behind a and makes the frames between: `made` has those from a's core's end to b's core, with the tracks.
  /// Of a, frames before its core's end stay as they are. Throws Error{corrupt},
  /// Error{bad_input} where there would be more than kMostMade.
  JunctionCuts join(LiveClip& a, LiveClip& b, Motion& made);

  /// Output frames of a clip that is placed: of its preparation, core or retraction. `tracks`: a span for each.
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
