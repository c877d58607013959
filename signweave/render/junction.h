#pragma once

#include <cstdint>
#include <memory>

#include "signweave/motion/motion.h"
#include "signweave/render/placed_clip.h"
#include "signweave/score/motion_clip.h"
#include "signweave/transition/body_guard.h"

/// Makes one junction at a time from its two sides alone. `Renderer` uses it for all junctions of a score, and
/// `TransitionBuilder` for one after another while an utterance grows, so both give the same frames for the same clips.
namespace signweave {

/// Settings common to all junctions of a result. Everything is borrowed.
struct JunctionSettings {
  std::shared_ptr<const Skeleton> skeleton;
  FrameRate rate;
  const TransitionMethod* method = nullptr;  ///< not null; for junctions without their own method
  const SignerRig* rig = nullptr;            ///< not null
  const TransitionModel* model = nullptr;    ///< null: the default
};

/// The method of the junction before a placed clip.
const TransitionMethod& method_of(const JunctionSettings& settings, const PlacedClip& placed) noexcept;

struct JunctionCuts {
  TransitionCuts parts;
  TransitionCut tracks;  ///< of the scalar tracks, which do not depend on poses
};

/// The joints whose quaternions are negated, [joint].
using JointSigns = std::vector<bool>;

/// Memory of junctions, reused so that only the first ones allocate.
struct JunctionScratch {
  Motion left, right;  ///< frames around the cuts
  Motion shared;       ///< the frames of a clip that overlap the previous clip
  GapScratch gap;
};

/// Output frames in memory; the first has number `first`. Borrowed.
struct OutputWindow {
  Motion& motion;
  std::int64_t first = 0;

  FrameRange frames() const noexcept { return {first, first + motion.frame_count()}; }
  MutablePoseView pose(std::int64_t frame) const noexcept { return motion.pose(frame - first); }
  MutablePoses poses(FrameRange range) const noexcept { return motion.poses({range.begin - first, range.end - first}); }
  PosesView view(FrameRange range) const noexcept { return view_of(motion, {range.begin - first, range.end - first}); }
};

/// Generates the frames of junctions.
class JunctionFiller {
 public:
  /// Only the joints of the `shown` groups are wanted; others may stay unfilled or uncorrected.
  explicit JunctionFiller(const JunctionSettings& settings, GroupSet shown = GroupSet::all());

  /// Number of frames that b shares with a: for the whole body in a cross-fade, for different parts if each has its own
  /// cut.
  static std::int64_t shared(const PlacedClip& a, const PlacedClip& b) noexcept;
  /// Number of frames read on either side of a transition.
  std::int64_t context() const noexcept;
  /// The output frames at which a part is compared between both sides; b's quaternion signs are chosen to match a's
  /// there.
  struct Meeting {
    std::int64_t of_a = 0;
    std::int64_t of_b = 0;
  };
  static Meeting meeting(const PlacedClip& a, const PlacedClip& b, const TransitionCuts& cuts, Timed part) noexcept;

  /// Makes the transition: Algorithm 1, lines 3 to 6. The window already contains the kept frames of both sides, and
  /// `context()` frames (or all) of both cores; shared frames are a's there, and b's in `scratch.shared`. Quaternions
  /// of b in the window may be negated. Generated arms are kept anatomically possible (see BodyGuard), unless the
  /// method is offered for evaluation only.
  void fill(const PlacedClip& a, const PlacedClip& b, const TransitionCuts& cuts, OutputWindow window,
            JunctionScratch& scratch);

 private:
  void turn_signs(const PlacedClip& a, const PlacedClip& b, const TransitionCuts& cuts, OutputWindow window,
                  Motion& shared) const;
  void crossfade(const PlacedClip& b, std::int64_t frames, OutputWindow window, const Motion& shared) const;
  void take_over(const PlacedClip& b, const TransitionCuts& cuts, OutputWindow window, const Motion& shared) const;
  Gap gap_at(const PlacedClip& a, const PlacedClip& b, FrameRange frames, OutputWindow window) const;
  void fill_gap(const PlacedClip& a, const PlacedClip& b, FrameRange frames, GroupSet groups, const TransitionCut& cut,
                OutputWindow window, GapScratch& scratch) const;

  JunctionSettings settings_;
  GroupSet shown_;    ///< and what the guards of the shown joints look at
  GroupSet guarded_;  ///< the same for guards
  BodyGuard guard_;
};

}  // namespace signweave
