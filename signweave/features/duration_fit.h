#pragma once

#include <array>
#include <span>
#include <vector>

#include "signweave/core/bytes.h"
#include "signweave/core/time.h"
#include "signweave/features/hand_motion.h"
#include "signweave/features/phase_features.h"

namespace signweave {

/// What one hand has to do in a transition.
struct HandTask {
  bool known = false;          ///< false: the rig lacks this hand, and the rest is 0
  float distance = 0;          ///< metres from border to border, seen from the signer
  float speed_before = 0;      ///< metres a second at the left border, seen from the signer
  float speed_after = 0;       ///< metres a second at the right border
  float approach = 0;          ///< of the velocities along the straight way, before plus after; metres a second
  float handshape_change = 0;  ///< [0, 1], see distance(Handshape, Handshape); 0 without fingers
};

/// What tells how long a transition takes.
struct TransitionTask {
  std::array<HandTask, 2> hands;  ///< [Side]
  float shoulder_width = 0;       ///< metres
};

/// A hand at a border, seen from the signer: metres, metres a second.
struct HandThere {
  Eigen::Vector3f place = Eigen::Vector3f::Zero();
  Eigen::Vector3f velocity = Eigen::Vector3f::Zero();
  Handshape shape;
};
/// Of the hand that goes from one border to the other.
HandTask task_from(const HandThere& from, const HandThere& to) noexcept;

/// From what was measured of the last stroke before a transition and the first after it.
TransitionTask task_between(const PhaseFeatures& before, const PhaseFeatures& after, float shoulder_width) noexcept;

/// How long a captured transition took.
struct TimedTransition {
  TransitionTask task;
  Seconds duration{0};
  std::size_t recording = 0;  ///< which ones go together in cross-validation
};

/// How long transitions take: their mean, or fitted on what the hands have to do.
struct DurationFit {
  Seconds mean{0.5};
  bool median = false;         ///< `mean` is their median
  std::size_t count = 0;       ///< of transitions it was fitted on; 0: none, and the mean is an assumption
  std::vector<float> weights;  ///< of the logarithm of seconds; empty: the mean is taken for all
  Seconds mean_error{0};       ///< mean absolute error of the mean, cross-validated by recording
  Seconds fitted_error{0};     ///< of the fitted model; 0: too few transitions to fit
  Seconds least{0};            ///< the shortest and the longest that it was fitted on
  Seconds most{0};
  /// What the weights belong to is not looked at beyond these, between which lie nine tenths of what was fitted on.
  std::vector<float> inputs_least, inputs_most;
  float fastest = 0;  ///< metres a second: distance over duration of the fastest that was fitted on; 0: not known
};

/// A fit needs as many transitions whose task is known.
inline constexpr std::size_t kLeastTransitions = 20;

/// Fits; keeps the mean alone where the fitted model does not beat it in cross-validation by recording (of one
/// recording alone, by fifths of it). The logarithm of the duration is linear in what the hand that goes farther has to
/// do: the logarithm of its distance, how far its velocities at both borders lead along the way, and how fast they are;
/// and in the greater change of handshape. Absolute errors are made least, with a little ridge (ours;
/// docs/durations.md).
DurationFit fit_durations(std::span<const TimedTransition> transitions);

/// The duration that a fit gives, within the shortest and the longest that it was fitted on, and so that no hand goes
/// faster on the whole than the fastest there; the mean where neither hand's task is known.
Seconds duration_of(const DurationFit& fit, const TransitionTask& task) noexcept;

/// As it is stored: f64 mean, u64 count, f64 errors of the mean and of the fit, u8 whether there are weights; then f32
/// × 5 weights, least and most inputs, f64 shortest and longest, f32 fastest. `decode` throws Error{corrupt} on what
/// `encode` cannot have written. `median` is not stored: it is the caller's.
void encode(const DurationFit& fit, ByteWriter& out);
DurationFit decode_duration_fit(ByteReader& in);

/// True where two say the same, give or take what another compiler rounds otherwise.
bool nearly_same(const DurationFit& a, const DurationFit& b) noexcept;

}  // namespace signweave
