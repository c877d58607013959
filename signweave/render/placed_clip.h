#pragma once

#include <cstdint>
#include <optional>

#include "signweave/motion/blend.h"
#include "signweave/score/motion_clip.h"

namespace signweave {

/// A clip on the output's time grid: its output frame k shows the recording's frame core.begin + k · step. Negative
/// k are its preparation, k ≥ core_frames its retraction.
struct PlacedClip {
  const MotionClip* captured = nullptr;
  double step = 1;
  std::int64_t last = 0;  ///< the recording's last frame that may be looked at: one beyond the clip, where there is one
  std::int64_t preparation = 0;  ///< output frames before the core that were captured
  std::int64_t core_frames = 1;
  std::int64_t retraction = 0;  ///< output frames after it

  // Known once the transitions are cut.
  std::int64_t before = 0;                  ///< frames of the preparation that are used
  std::int64_t after = 0;                   ///< frames of the retraction that are used
  std::int64_t core = 0;                    ///< output frame of the core's first frame
  std::optional<GroundTransform> standing;  ///< how it is brought to where the signer stands; none: it is there

  std::int64_t begin() const noexcept { return core - before; }             ///< its first output frame
  std::int64_t core_end() const noexcept { return core + core_frames; }     ///< output frame after its core
  std::int64_t end() const noexcept { return core + core_frames + after; }  ///< output frame after its last
  bool captured_as_is() const noexcept { return step == 1.0; }
  /// The recording's frame that is shown at an output frame.
  double frame_at(std::int64_t output) const noexcept;
  /// The output frame at which a frame of the recording is shown, as near as can be.
  std::int64_t frame_of(std::int64_t recorded) const noexcept;
};

/// Lays a clip on a grid of `rate` at a tempo.
PlacedClip placed_at_tempo(const MotionClip& clip, FrameRate rate, double tempo);
/// The same by the recording's frames per output frame.
PlacedClip placed_by_step(const MotionClip& clip, double step);

/// Puts some of its output frames where they are wanted, as captured, or interpolated where its own grid is another.
/// They stand where they were captured.
void read_frames(const PlacedClip& placed, FrameRange output, MutablePoses out);
/// The same of its scalar tracks: a span for each, empty where the track is not wanted.
void read_tracks(const PlacedClip& placed, FrameRange output, std::span<const std::span<float>> out);

}  // namespace signweave
