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

/// A score beside the motions that it names: Algorithm 1 before any frame is made. Clips are borrowed.
struct Plan {
  std::vector<PlacedClip> placed;
  std::vector<JunctionCuts> cuts;  ///< [clip − 1]
  std::int64_t frames = 0;
};

/// What a score is rendered from: for each recording that it names its motion, in the joints of the score's skeleton,
/// and the noise of its capture where that is known.
struct ScoreSource {
  std::shared_ptr<const MotionSource> motion;
  std::shared_ptr<const CaptureNoise> noise;
};
using FindSource = std::function<ScoreSource(const SourceRef&)>;

/// The clips of a score with their motions. What `find` throws comes through; Error{bad_input} where a clip names
/// frames that its motion does not have.
std::vector<MotionClip> clips_of(const Score& score, const FindSource& find);

/// What a score says of its clips, which clips_of or the score's maker has. `clips` must outlive it. Throws
/// Error{bad_input} where more frames are shown than were captured, or lanes do not lie where their cuts put them.
Plan plan_of(const Score& score, const std::vector<MotionClip>& clips);

/// A motion in which frames are to be made: what is captured before each gap and after the last one. The gaps are
/// sorted, within `motion`, and at least one frame lies before, between and after them.
std::vector<MotionClip> clips_around(std::span<const FrameRange> gaps, const MotionClip& motion);
/// The plan in which such clips follow each other just as they are, with so many made frames between each two.
Plan plan_with_gaps(const std::vector<MotionClip>& clips, std::span<const std::int64_t> counts);

/// The score of a plan: it gives the plan back. A clip whose clip names no place has that of its number.
Score score_of(const Plan& plan, const JunctionSettings& settings, const SourceRef& skeleton);

}  // namespace signweave
