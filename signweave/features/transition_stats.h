#pragma once

#include <array>
#include <cstddef>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "signweave/annotation/sign.h"
#include "signweave/core/time.h"
#include "signweave/features/distribution.h"
#include "signweave/features/phase_features.h"

namespace signweave {

/// A recorded transition: what lies between the last stroke of one sign and the first stroke of the next.
struct AnnotatedTransition {
  std::size_t from = 0;         ///< index of the first sign in the list that was looked through
  std::size_t to = 0;           ///< index of the second
  TimeSpan span;                ///< from the end of the last stroke to the begin of the next
  Milliseconds retraction{0};   ///< the first sign's retraction
  Milliseconds preparation{0};  ///< the second sign's preparation
  bool inferred = false;        ///< a sign on either side has no annotated phases, so only the gap is known
};

/// Between signs farther apart than this the hands rested: that is no transition but the end of a Unit. (ours)
inline constexpr Milliseconds kRest{1000};
/// The same between signs whose phases are annotated: there the retraction and the preparation meet, give or take what
/// an annotator leaves open. (ours)
inline constexpr Milliseconds kMeeting{100};
/// Between signs without annotated phases, a gap no longer than this tells nothing: the glosses touch, and the
/// transitions lie inside them. (ours)
inline constexpr Milliseconds kTouching{20};

/// The transitions of one recording: neighbours on one sign tier, both with a stroke, at most kMeeting (kRest where
/// either is inferred) between the end of one sign and the begin of the next. By tier, then time.
std::vector<AnnotatedTransition> transitions_in(std::span<const Sign> signs);

/// Mean and spread of transition durations (the paper, section 5.1, figure 4).
struct TransitionStats {
  std::size_t count = 0;  ///< 0: nothing was measured and every duration below is 0
  bool inferred = false;  ///< from gaps between signs without phases, for want of annotated phases
  Milliseconds mean{0};
  Milliseconds deviation{0};  ///< standard deviation of the population
  Milliseconds median{0};
  Milliseconds percentile_10{0};
  Milliseconds percentile_90{0};
  Milliseconds mean_retraction{0};
  Milliseconds mean_preparation{0};
};

/// Over the annotated transitions where there is one; else over the inferred ones.
TransitionStats summarize(std::span<const AnnotatedTransition> transitions);

/// How far a hand goes over a part of a transition.
struct HandTravel {
  bool known = false;       ///< false: not measured, and the rest is 0
  double displacement = 0;  ///< metres, straight from begin to end
  double path = 0;          ///< metres, along the way
};

/// What is measured of one transition's motion; every array is [Side].
struct TransitionMotion {
  std::array<HandTravel, 2> retraction;
  std::array<HandTravel, 2> preparation;
  std::array<HandTravel, 2> whole;  ///< from the end of one stroke to the begin of the next
};

/// How the hands go from the last stroke of one sign to the first stroke of the next, from what was measured of their
/// phases: `from_phases[i]` of `from.phases[i]`. The path is that along the phases, and straight where they do not
/// meet. None where a sign has no annotated phases, or nothing was measured of either hand.
std::optional<TransitionMotion> motion_between(const Sign& from, std::span<const PhaseFeatures> from_phases,
                                               const Sign& to, std::span<const PhaseFeatures> to_phases,
                                               float shoulder_width);

/// A transition with its names.
struct RecordedTransition {
  std::string recording;
  std::string from;  ///< gloss, verbatim
  std::string to;
  AnnotatedTransition transition;
  std::optional<TransitionMotion> motion;  ///< none: not measured
};

/// What to take for a transition's motion, whose signs are `from` and `to`; may be empty, and may answer none.
using MotionOf = std::function<std::optional<TransitionMotion>(const Sign& from, const Sign& to,
                                                               const AnnotatedTransition& transition)>;

/// The transitions of one recording, as `transitions_in` finds them, in the order of time.
std::vector<RecordedTransition> recorded_transitions(const std::string& recording, std::span<const Sign> signs,
                                                     const MotionOf& motion_of = {});

/// One hand over one part of several transitions (the paper, section 5.1).
struct TravelStats {
  Distribution displacement;  ///< metres
  Distribution path;          ///< metres
  Distribution speed;         ///< average velocity, path over duration: metres a second
};

/// One part of several transitions.
struct PartStats {
  Distribution duration;             ///< milliseconds
  std::array<TravelStats, 2> hands;  ///< [Side]; count 0 where nothing was measured
};

/// Several transitions, whole and in parts.
struct TransitionSummary {
  bool inferred = false;  ///< from gaps between signs without phases: retraction and preparation tell nothing then
  PartStats retraction;
  PartStats preparation;
  PartStats whole;
};

/// Over the annotated transitions where there is one; else over the inferred ones, whose parts have count 0.
TransitionSummary describe(std::span<const RecordedTransition> transitions);

/// Those that `describe` counts.
std::vector<RecordedTransition> counted_transitions(std::span<const RecordedTransition> transitions);

/// The transitions from one gloss to another.
struct PairStats {
  std::string from;  ///< as first written
  std::string to;
  TransitionSummary summary;
};

/// By how often they occur, then by name. Glosses are compared in match form. A pair that occurs annotated and
/// inferred is told from the annotated.
std::vector<PairStats> by_pair(std::span<const RecordedTransition> transitions);

}  // namespace signweave
