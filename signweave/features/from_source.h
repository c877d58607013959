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

// Measures a motion that is not in memory, piece by piece. The results are bit-identical to those of measuring the
// whole motion.

/// Called between pieces of a long operation, each of which takes a few milliseconds at most. May throw to cancel the
/// operation.
using Pause = std::function<void()>;

/// Number of frames processed between two pauses.
inline constexpr std::int64_t kPiece = 512;

/// Calls `use(FrameRange)` for consecutive pieces of `frames`, and `pause` before each.
template <typename Use>
void for_pieces(FrameRange frames, const Pause& pause, Use&& use) {
  for (std::int64_t begin = frames.begin; begin < frames.end; begin += kPiece) {
    if (pause) pause();
    use(FrameRange{begin, std::min(begin + kPiece, frames.end)});
  }
}

/// Some frames of a source as a separate motion, without scalar tracks, plus the frames that smoothing needs.
struct Piece {
  Motion motion;
  std::int64_t first = 0;  ///< frame of the source that is the motion's first frame
};
/// Reads all frames that measuring `frames` needs (at least one frame, within the source). Reuses the memory of
/// `piece`.
void read_piece(const MotionSource& source, FrameRange frames, Piece& piece);

/// Same result as `model_of` of the whole motion, which must have a frame. Reads only a few frames.
SignerModel model_of(const MotionSource& source, const RigNames& names = {}, const Pause& pause = {});

/// Same result as `track_points` of the whole motion.
std::vector<PointTrack> track_points(const MotionSource& source, const SignerModel& model, std::span<const Part> parts,
                                     FrameRange range, const Pause& pause = {});

/// Same as `decode_features` (phase_features.h), with pauses.
std::optional<RecordingFeatures> decode_features(ByteReader& in, const Pause& pause);

}  // namespace signweave
