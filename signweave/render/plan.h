#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "signweave/motion/blend.h"
#include "signweave/render/junction.h"
#include "signweave/render/placed_clip.h"
#include "signweave/score/score.h"

namespace signweave {

/// A score together with its motions: Algorithm 1 before any frame is made. Clips are borrowed.
struct Plan {
  std::vector<PlacedClip> placed;
  std::vector<JunctionCuts> cuts;  ///< [clip − 1]
  std::int64_t frames = 0;
};

/// The input for a recording of a score: its motion, in the joints of the score's skeleton, and the noise of its
/// capture if known.
struct ScoreSource {
  std::shared_ptr<const MotionSource> motion;
  std::shared_ptr<const CaptureNoise> noise;
};
using FindSource = std::function<ScoreSource(const SourceRef&)>;

/// The clips of a score with their motions. Throws what `find` throws, and Error{bad_input} if a clip refers to frames
/// that its motion does not have.
std::vector<MotionClip> clips_of(const Score& score, const FindSource& find);

/// Makes the plan of a score from its clips, which come from clips_of or the score's creator. `clips` must outlive it.
/// Throws Error{bad_input} if more frames are shown than were captured, or lanes contradict their cuts.
Plan plan_of(const Score& score, const std::vector<MotionClip>& clips);

/// The clips of a motion with gaps to be filled: the captured frames before each gap and after the last one. The gaps
/// must be sorted, inside `motion`, and separated by at least one frame from each other and from its ends.
std::vector<MotionClip> clips_around(std::span<const FrameRange> gaps, const MotionClip& motion);
/// The plan that shows such clips unchanged, with `counts` generated frames between each two.
Plan plan_with_gaps(const std::vector<MotionClip>& clips, std::span<const std::int64_t> counts);

/// The score of a plan; plan_of gives the plan back. A clip without `place` gets its number as the place.
Score score_of(const Plan& plan, const JunctionSettings& settings, const SourceRef& skeleton);

}  // namespace signweave
