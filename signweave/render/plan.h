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

/// The channel of an arm.
constexpr Channel arm_channel(Side side) noexcept {
  return side == Side::left ? Channel::left : Channel::right;
}
/// The side of an arm's channel; none for others.
constexpr std::optional<Side> side_of_arm(Channel channel) noexcept {
  if (channel == Channel::left) return Side::left;
  if (channel == Channel::right) return Side::right;
  return std::nullopt;
}

struct LaneRun;

/// A score together with its motions: Algorithm 1 before any frame is made. Clips are borrowed.
struct Plan {
  std::vector<PlacedClip> placed;  ///< of the whole body
  std::vector<JunctionCuts> cuts;  ///< [clip − 1]
  std::int64_t frames = 0;
  std::vector<AuthoredCurve> curves;                    ///< as in Score
  std::vector<LaneRun> runs;                            ///< by Channel, then in time order
  std::vector<std::shared_ptr<const MotionClip>> held;  ///< owns the clips in `placed` of which poses are held
};

/// Output frames in which a channel does not show what its parent does, or for a channel without parent, the body.
struct LaneRun {
  Channel channel = Channel::left;
  FrameRange frames;            ///< between the cores of its first and last clip, or to an end of the output
  bool from_parent = false;     ///< the parent shows the first clip as well
  bool back_to_parent = false;  ///< the parent shows the last clip as well
  Plan plan;                    ///< its clips, as if they were of the whole body; without runs
  std::vector<ClipId> clips;    ///< [placed clip]
  std::vector<std::optional<HandPlace>> places;  ///< [placed clip]
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

/// A placed clip as stored in a score.
Clip clip_of(const PlacedClip& placed, ClipId id);
/// The score of a plan without runs; plan_of gives the plan back. A clip without `place` gets its number as the place.
Score score_of(const Plan& plan, const JunctionSettings& settings, const SourceRef& skeleton);

}  // namespace signweave
