#pragma once

#include <array>
#include <string_view>
#include <vector>

#include "demo/random.h"
#include "signweave/motion/motion.h"

namespace signweave::demo {

struct Timeline;

// What a face does with a sign. PLACEHOLDERS like the hands: no mouthing or expression of LSF.

enum class Brows { level, raised, lowered };
enum class Mouth {
  shut,
  ah,    ///< opens and closes
  oh,    ///< a round opening
  oo,    ///< pursed
  ee,    ///< wide, teeth nearly together
  mm,    ///< lips pressed
  pah,   ///< pressed, then open
  wow,   ///< pursed, then open
  puff,  ///< full cheeks
  blow,  ///< full cheeks, then pursed
  glad,  ///< a smile
};
enum class Gaze { viewer, hand };

struct Face {
  Brows brows = Brows::level;
  Mouth mouth = Mouth::shut;
  Gaze gaze = Gaze::viewer;
};

/// The face's scalar tracks, weights from 0 to 1 under the names of ARKit's blend shapes.
enum class FaceTrack {
  browInnerUp,
  browOuterUpLeft,
  browOuterUpRight,
  browDownLeft,
  browDownRight,
  eyeBlinkLeft,
  eyeBlinkRight,
  eyeWideLeft,
  eyeWideRight,
  eyeSquintLeft,
  eyeSquintRight,
  jawOpen,
  mouthClose,
  mouthFunnel,
  mouthPucker,
  mouthSmileLeft,
  mouthSmileRight,
  mouthStretchLeft,
  mouthStretchRight,
  mouthPressLeft,
  mouthPressRight,
  cheekPuff,
};
inline constexpr std::size_t kFaceTracks = 22;
std::string_view name_of(FaceTrack track) noexcept;

/// All tracks of a recording.
struct FaceMotion {
  std::array<std::vector<float>, kFaceTracks> tracks;  ///< [track][frame]
  const std::vector<float>& of(FaceTrack track) const { return tracks[static_cast<std::size_t>(track)]; }
};

/// The face of a timeline: each sign's brows and mouth set in before its stroke and outlast it, neighbours flow into
/// each other, eyes blink now and then, mostly between signs and always after a sentence.
FaceMotion face_of(const Timeline& timeline, Random& random);

}  // namespace signweave::demo
