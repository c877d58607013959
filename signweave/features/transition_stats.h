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

/// A recorded transition: the span between the last stroke of one sign and the first stroke of the next.
struct AnnotatedTransition {
  std::size_t from = 0;         ///< index of the first sign in the searched list
  std::size_t to = 0;           ///< index of the second
  TimeSpan span;                ///< from the end of the last stroke to the begin of the next
  Milliseconds retraction{0};   ///< the first sign's retraction
  Milliseconds preparation{0};  ///< the second sign's preparation
  bool inferred = false;        ///< a sign on either side has no annotated phases, so only the gap is known
};

/// If signs are farther apart than this, the hands rested: that is not a transition but the end of a Unit. (ours)
inline constexpr Milliseconds kRest{1000};
/// The same for signs with annotated phases: there retraction and preparation are adjacent, up to the annotator's
/// tolerance. (ours)
inline constexpr Milliseconds kMeeting{100};
/// Between signs without annotated phases, a gap up to this length is not informative: the glosses touch, and the
/// transitions lie inside them. (ours)
inline constexpr Milliseconds kTouching{20};

/// Returns the transitions of one recording: between adjacent signs on one tier, both with a stroke, at most kMeeting
/// (kRest if either is inferred) between the end of one sign and the begin of the next. Sorted by tier, then time.
std::vector<AnnotatedTransition> transitions_in(std::span<const Sign> signs);

/// Mean and spread of transition durations (the paper, section 5.1, figure 4).
struct TransitionStats {
  std::size_t count = 0;  ///< 0: nothing was measured, and every duration below is 0
  bool inferred = false;  ///< from gaps between signs without phases, because no phases are annotated
  Milliseconds mean{0};
  Milliseconds deviation{0};  ///< standard deviation of the population
  Milliseconds median{0};
  Milliseconds percentile_10{0};
  Milliseconds percentile_90{0};
  Milliseconds mean_retraction{0};
  Milliseconds mean_preparation{0};
};

/// Uses the annotated transitions if there are any, else the inferred ones.
TransitionStats summarize(std::span<const AnnotatedTransition> transitions);

/// The distance that a hand covers in a part of a transition.
struct HandTravel {
  bool known = false;       ///< false: not measured, and the rest is 0
  double displacement = 0;  ///< metres, straight from begin to end
  double path = 0;          ///< metres, along the path
};

/// The measured motion of one transition; every array is [Side].
struct TransitionMotion {
  std::array<HandTravel, 2> retraction;
  std::array<HandTravel, 2> preparation;
  std::array<HandTravel, 2> whole;  ///< from the end of one stroke to the begin of the next
};

/// Returns the motion of the hands from the last stroke of one sign to the first stroke of the next, from the
/// measurements of their phases: `from_phases[i]` belongs to `from.phases[i]`. The path follows the phases, and is
/// straight between phases that do not meet. Returns nullopt if a sign has no annotated phases, or if neither hand was
/// measured.
std::optional<TransitionMotion> motion_between(const Sign& from, std::span<const PhaseFeatures> from_phases,
                                               const Sign& to, std::span<const PhaseFeatures> to_phases,
                                               float shoulder_width);

/// A transition with the names of its recording and glosses.
struct RecordedTransition {
  std::string recording;
  std::string from;  ///< gloss, verbatim
  std::string to;
  AnnotatedTransition transition;
  std::optional<TransitionMotion> motion;  ///< nullopt: not measured
};

/// Returns a transition's motion, given its signs `from` and `to`. May be empty, and may return nullopt.
using MotionOf = std::function<std::optional<TransitionMotion>(const Sign& from, const Sign& to,
                                                               const AnnotatedTransition& transition)>;

/// Returns the transitions of one recording, as found by `transitions_in`, sorted by time.
std::vector<RecordedTransition> recorded_transitions(const std::string& recording, std::span<const Sign> signs,
                                                     const MotionOf& motion_of = {});

/// Statistics of one hand over one part of several transitions (the paper, section 5.1).
struct TravelStats {
  Distribution displacement;  ///< metres
  Distribution path;          ///< metres
  Distribution speed;         ///< average velocity, path over duration: metres a second
};

/// Statistics of one part of several transitions.
struct PartStats {
  Distribution duration;             ///< milliseconds
  std::array<TravelStats, 2> hands;  ///< [Side]; count 0 if nothing was measured
};

/// Statistics of several transitions, as a whole and by part.
struct TransitionSummary {
  bool inferred = false;  ///< from gaps between signs without phases: retraction and preparation are then not measured
  PartStats retraction;
  PartStats preparation;
  PartStats whole;
};

/// Uses the annotated transitions if there are any, else the inferred ones, whose parts have count 0.
TransitionSummary describe(std::span<const RecordedTransition> transitions);

/// Returns the transitions that `describe` counts.
std::vector<RecordedTransition> counted_transitions(std::span<const RecordedTransition> transitions);

/// The transitions from one gloss to another.
struct PairStats {
  std::string from;  ///< as first written
  std::string to;
  TransitionSummary summary;
};

/// Returns the pairs by descending frequency, then by name. Glosses are compared in match form. A pair that occurs both
/// annotated and inferred is described from the annotated occurrences only.
std::vector<PairStats> by_pair(std::span<const RecordedTransition> transitions);

}  // namespace signweave
