#pragma once

#include <cstdint>
#include <optional>

#include "signweave/motion/blend.h"
#include "signweave/score/motion_clip.h"

namespace signweave {

/// A clip on the output's time grid. Its output frame k shows the recording's frame core.begin + k · step; negative k
/// are its preparation, k ≥ core_frames its retraction.
struct PlacedClip {
  const MotionClip* captured = nullptr;
  double step = 1;
  std::int64_t last = 0;         ///< the recording's last readable frame: one beyond the clip, if there is one
  std::int64_t preparation = 0;  ///< captured output frames before the core
  std::int64_t core_frames = 1;
  std::int64_t retraction = 0;  ///< captured output frames after it

  // Set once the transitions are cut.
  std::int64_t before = 0;                  ///< used frames of the preparation
  std::int64_t after = 0;                   ///< used frames of the retraction
  std::int64_t core = 0;                    ///< output frame of the core's begin
  std::optional<GroundTransform> standing;  ///< moves it to where the signer stands; none: not moved

  std::int64_t begin() const noexcept { return core - before; }             ///< its first output frame
  std::int64_t core_end() const noexcept { return core + core_frames; }     ///< one past its core
  std::int64_t end() const noexcept { return core + core_frames + after; }  ///< one past its last output frame
  bool captured_as_is() const noexcept { return step == 1.0; }
  /// The recording's frame shown at an output frame.
  double frame_at(std::int64_t output) const noexcept;
  /// The output frame nearest to a frame of the recording.
  std::int64_t frame_of(std::int64_t recorded) const noexcept;
};

/// Places a clip on a grid of `rate` at a tempo.
PlacedClip placed_at_tempo(const MotionClip& clip, FrameRate rate, double tempo);
/// The same, given the recording frames per output frame.
PlacedClip placed_by_step(const MotionClip& clip, double step);

/// Reads output frames of a clip into `out`, as captured, or interpolated if its frames are not on the grid. The signer
/// stays where captured; `standing` is not applied.
void read_frames(const PlacedClip& placed, FrameRange output, MutablePoses out);
/// The same for its scalar tracks: one span per track, empty for a track that is not needed.
void read_tracks(const PlacedClip& placed, FrameRange output, std::span<const std::span<float>> out);

}  // namespace signweave
