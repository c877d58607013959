#pragma once

#include <optional>

#include "signweave/choose/cut_points.h"
#include "signweave/features/duration_fit.h"
#include "signweave/render/junction.h"

namespace signweave {

/// The duration of transitions. Borrowed.
struct TransitionTiming {
  const DurationFit* fit = nullptr;  ///< null: each transition has `duration`
  Milliseconds duration{0};          ///< at tempo 1, without pauses
  double tempo = 1;                  ///< above 1 is faster; positive
};

/// Chooses durations and cuts of junctions, reading the frames around them.
class JunctionTimer {
 public:
  JunctionTimer(const JunctionSettings& settings, const TransitionTiming& timing);

  /// The cuts between two placed clips, independent of their positions. `length` is given if other lanes determine it,
  /// in output frames. Throws Error{corrupt}.
  JunctionCuts cuts_between(const PlacedClip& a, const PlacedClip& b, Milliseconds pause, JunctionScratch& scratch,
                            std::optional<std::int64_t> length = {});

 private:
  JunctionSettings settings_;
  TransitionTiming timing_;
  std::optional<CutChooser> chooser_;  ///< created at the first junction whose method needs it
};

/// Positions b after a according to the cuts, and records what both keep of the transition.
void place_after(PlacedClip& a, PlacedClip& b, const JunctionCuts& cuts);

}  // namespace signweave
