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

/// A stretch as it lies among the output frames of a `Weaver`. Not moved once it is laid.
struct Woven {
  Stretch stretch;
  Laid laid;                          ///< points to the stretch
  bool aligned = false;               ///< it is brought to where the home's signer stands
  std::vector<std::size_t> track_of;  ///< [track of its source] which of the result's it is; kNoTrack: none
  static constexpr std::size_t kNoTrack = static_cast<std::size_t>(-1);
  std::string key;                   ///< the caller's: tells it from others; empty where no other is like it
  std::optional<JunctionCuts> cuts;  ///< of the junction before it; none: it was not joined
  std::size_t number = 0;            ///< the caller's: of the clips of a stream

  Woven() = default;
  Woven(const Woven&) = delete;
  Woven& operator=(const Woven&) = delete;
};

/// Joins stretches one after another, while it is not known what comes: the same frames as `concatenate` makes of all
/// of them. A junction costs the same however long the utterance is. Belongs to one thread.
class Weaver {
 public:
  /// What the settings point to must outlive it. `tracks`: names of the result's scalar tracks; those of stretches that
  /// are not among them are left out. `home`: the stretch where whose signer stands all others are brought; its frames
  /// are read here, and it is not kept. Throws Error{corrupt}.
  Weaver(const JunctionSettings& settings, const TransitionTiming& timing, std::vector<std::string> tracks,
         Alignment alignment, const Stretch& home);

  const JunctionSettings& settings() const noexcept { return settings_; }
  const std::vector<std::string>& tracks() const noexcept { return tracks_; }
  const Standing& home() const noexcept { return home_; }

  /// Lays `woven.stretch` as what is signed: at the settings' tempo, core at output frame 0 for now. Throws
  /// Error{bad_input} where its skeleton differs in more than offsets.
  void lay_sign(Woven& woven) const;
  /// Lays what is in output frames already, and where it belongs.
  void lay_frames(Woven& woven) const;

  /// Where a stretch that none is before stands.
  void place(Woven& woven);
  /// No more frames are made between two stretches.
  static constexpr std::int64_t kMostMade = 20'000;
  /// Lays b behind a and makes the frames between: `made` has those from a's core's end to b's core, with the tracks.
  /// Of a, frames before its core's end stay as they are. Throws Error{corrupt},
  /// Error{bad_input} where there would be more than kMostMade.
  JunctionCuts join(Woven& a, Woven& b, Motion& made);

  /// Output frames of a stretch that is placed: of its preparation, core or retraction. `tracks`: a span for each.
  void read(const Woven& woven, FrameRange frames, MutablePoses out, std::span<const std::span<float>> tracks) const;

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
