#pragma once

#include <algorithm>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "signweave/core/bytes.h"
#include "signweave/features/hand_motion.h"
#include "signweave/features/point_track.h"
#include "signweave/motion/motion_source.h"
#include "signweave/rig/rig_map.h"

namespace signweave {

struct RecordingFeatures;

// Measuring a motion that is not in memory, piece by piece: the numbers are those of measuring the whole, to the bit.

/// Called between pieces of a long work, each of a few milliseconds at most. It may throw to stop the work.
using Pause = std::function<void()>;

/// Frames that are worked on between two pauses.
inline constexpr std::int64_t kPiece = 512;

/// Calls `use(FrameRange)` for the pieces of some frames, in order, and `pause` before each.
template <typename Use>
void for_pieces(FrameRange frames, const Pause& pause, Use&& use) {
  for (std::int64_t begin = frames.begin; begin < frames.end; begin += kPiece) {
    if (pause) pause();
    use(FrameRange{begin, std::min(begin + kPiece, frames.end)});
  }
}

/// Some frames of a source as a motion of their own, without scalar tracks; and all that smoothing looks at.
struct Piece {
  Motion motion;
  std::int64_t first = 0;  ///< the frame of the source that is the motion's first
};
/// Reads what measuring some frames (at least one, within the source) looks at. Memory of `piece` is used again.
void read_piece(const MotionSource& source, FrameRange frames, Piece& piece);

/// What `model_of` gives of the whole motion, which must have a frame. Reads a few frames only.
SignerModel model_of(const MotionSource& source, const RigNames& names = {}, const Pause& pause = {});

/// What `track_points` gives of the whole motion.
std::vector<PointTrack> track_points(const MotionSource& source, const SignerModel& model, std::span<const Part> parts,
                                     FrameRange range, const Pause& pause = {});

/// What `decode_features` (phase_features.h) gives of all at once.
std::optional<RecordingFeatures> decode_features(ByteReader& in, const Pause& pause);

}  // namespace signweave
