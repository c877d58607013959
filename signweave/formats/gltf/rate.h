#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>

#include "signweave/core/time.h"
#include "signweave/formats/gltf/curve.h"

namespace signweave::gltf {

/// Which frames a motion has.
struct Timing {
  FrameRate rate;
  double start = 0;          ///< seconds: the first key, where frame 0 stands
  std::int64_t frames = 1;   ///< so many that the last key is reached
  bool even = true;          ///< every key stands at a frame
  bool told_by_keys = true;  ///< false where there is one key only, so that the rate had to be taken from nowhere
};

/// How a file's keys are known to be set.
struct KeyHabits {
  bool smooth = false;       ///< some curves are cubic
  bool key_a_frame = false;  ///< each frame has its key, so that the keys' distance is the frame's: our own files
};

/// The rate at which keys stand: the lowest standard one that has a frame at each key, where at least every second
/// frame has one; of keys farther apart the lowest from 24 on (60 where `smooth` curves need more frames between keys
/// than straight ones); else any rate at which keys stand evenly. Uneven keys get 120 frames a second, or the standard
/// rate nearest to theirs where they are denser or were only rounded. `told` stands instead of all that.
Timing timing_of(std::span<const std::shared_ptr<KeyTimes>> times, KeyHabits habits, std::optional<FrameRate> told);

/// Fills in where the keys are among the frames; those next to a frame are put on it, for their times are floats.
void place_keys(KeyTimes& times, const Timing& timing);

}  // namespace signweave::gltf
