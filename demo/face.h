#pragma once

#include <array>
#include <string_view>
#include <vector>

#include "demo/random.h"
#include "signweave/motion/motion.h"

namespace signweave::demo {

struct Timeline;

// The face during a sign. PLACEHOLDERS like the hands: no mouthing or expression of LSF.

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

/// The scalar tracks of the face: weights from 0 to 1, named as ARKit's blend shapes.
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

/// The face of a timeline: each sign's brows and mouth begin before its stroke and outlast it, neighbours blend into
/// each other, and the eyes blink occasionally, mostly between signs and always after a sentence.
FaceMotion face_of(const Timeline& timeline, Random& random);

}  // namespace signweave::demo
