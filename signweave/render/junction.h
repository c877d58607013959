#pragma once

#include <cstdint>
#include <memory>

#include "signweave/motion/motion.h"
#include "signweave/render/placed_clip.h"
#include "signweave/score/motion_clip.h"
#include "signweave/transition/body_guard.h"

/// One junction at a time, from nothing but its two sides: a `Renderer` makes all those of a score with it, and
/// `TransitionBuilder` one after another while an utterance grows. So both make the same of the same clips.
namespace signweave {

/// What all junctions of a result have in common. Everything is borrowed.
struct JunctionSettings {
  std::shared_ptr<const Skeleton> skeleton;
  FrameRate rate;
  const TransitionMethod* method = nullptr;  ///< not null; of junctions that have none of their own
  const SignerRig* rig = nullptr;            ///< not null
  const TransitionModel* model = nullptr;    ///< null: the default
};

/// How the junction before a clip that is placed is made.
const TransitionMethod& method_of(const JunctionSettings& settings, const PlacedClip& placed) noexcept;

struct JunctionCuts {
  TransitionCuts parts;
  TransitionCut tracks;  ///< of the scalar tracks, which know no poses
};

/// Which joints' quaternions are turned to their negatives: [joint].
using JointSigns = std::vector<bool>;

/// Memory that junctions use; kept from one to the next, so that only the first ones allocate.
struct JunctionScratch {
  Motion left, right;  ///< what lies around the cuts
  Motion shared;       ///< the frames of a clip that the one before has too
  GapScratch gap;
};

/// Output frames in memory, the first of them number `first`. Borrowed.
struct OutputWindow {
  Motion& motion;
  std::int64_t first = 0;

  FrameRange frames() const noexcept { return {first, first + motion.frame_count()}; }
  MutablePoseView pose(std::int64_t frame) const noexcept { return motion.pose(frame - first); }
  MutablePoses poses(FrameRange range) const noexcept { return motion.poses({range.begin - first, range.end - first}); }
  PosesView view(FrameRange range) const noexcept { return view_of(motion, {range.begin - first, range.end - first}); }
};

/// Makes the frames of junctions.
class JunctionFiller {
 public:
  explicit JunctionFiller(const JunctionSettings& settings);

  /// Frames of b that a has too: of the whole body in a cross-fade, of one part here and another there where each has
  /// its own cut.
  static std::int64_t shared(const PlacedClip& a, const PlacedClip& b) noexcept;
  /// As many frames beside a transition are looked at.
  std::int64_t context() const noexcept;
  /// The output frames at which a part of both sides is compared: b's rotations are turned so that they go on from a's.
  struct Meeting {
    std::int64_t of_a = 0;
    std::int64_t of_b = 0;
  };
  static Meeting meeting(const PlacedClip& a, const PlacedClip& b, const TransitionCuts& cuts, Timed part) noexcept;

  /// The transition: Algorithm 1, lines 3 to 6. The window has what both sides keep of it already, and of both cores
  /// `context()` frames or all; the frames that they share are there as a's, and in `scratch.shared` as b's.
  /// Quaternions of b in the window may be turned to their negatives. Arms that were made are kept within what a body
  /// can do (see BodyGuard), except where the method is offered for evaluation alone.
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
  BodyGuard guard_;
};

}  // namespace signweave
