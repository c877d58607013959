#pragma once

#include <optional>

#include "signweave/choose/cut_points.h"
#include "signweave/features/duration_fit.h"
#include "signweave/render/junction.h"

namespace signweave {

/// How long transitions last. Borrowed.
struct TransitionTiming {
  const DurationFit* fit = nullptr;  ///< null: each transition has `duration`
  Milliseconds duration{0};          ///< at tempo 1, without pauses
  double tempo = 1;                  ///< above 1 is faster; positive
};

/// Times and cuts junctions, reading what lies around them.
class JunctionTimer {
 public:
  JunctionTimer(const JunctionSettings& settings, const TransitionTiming& timing);

  /// Of two clips that are placed, wherever they lie. Throws Error{corrupt}.
  JunctionCuts cuts_between(const PlacedClip& a, const PlacedClip& b, Milliseconds pause, JunctionScratch& scratch);

 private:
  JunctionSettings settings_;
  TransitionTiming timing_;
  std::optional<CutChooser> chooser_;  ///< from the first junction on whose method asks for it
};

/// Lays b where the cuts leave it behind a, and notes what both keep of the transition.
void place_after(PlacedClip& a, PlacedClip& b, const JunctionCuts& cuts);

}  // namespace signweave
