#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>

#include "signweave/core/time.h"
#include "signweave/formats/gltf/curve.h"

namespace signweave::gltf {

/// The frames of a motion.
struct Timing {
  FrameRate rate;
  double start = 0;             ///< seconds: the first key, which is frame 0
  std::int64_t frames = 1;      ///< enough to reach the last key
  bool even = true;             ///< every key is at a frame
  bool known_from_keys = true;  ///< false if there is only one key, so that the rate had to be assumed
};

/// How the keys of a file are placed.
struct KeyHabits {
  bool smooth = false;       ///< some curves are cubic
  bool key_a_frame = false;  ///< each frame has a key, so the distance between keys is that of frames: our own files
};

/// The rate of the keys: the lowest standard one that has a frame at each key, if at least every second frame has one;
/// for keys farther apart the lowest from 24 upwards (60 if `smooth` curves need more frames between keys than straight
/// ones do); otherwise any rate at which the keys are evenly spaced. Uneven keys get 120 frames a second, or the
/// standard rate nearest to theirs if they are denser or were only rounded. `given` overrides all that.
Timing timing_of(std::span<const std::shared_ptr<KeyTimes>> times, KeyHabits habits, std::optional<FrameRate> given);

/// Fills in the positions of the keys among the frames; those close to a frame are moved to it, because their times are
/// floats.
void place_keys(KeyTimes& times, const Timing& timing);

}  // namespace signweave::gltf
