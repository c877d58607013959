#pragma once

#include <array>
#include <span>
#include <vector>

#include "signweave/core/bytes.h"
#include "signweave/core/time.h"
#include "signweave/features/hand_motion.h"
#include "signweave/features/phase_features.h"

namespace signweave {

/// The movement that one hand makes in a transition.
struct HandTask {
  bool known = false;          ///< false: the rig lacks this hand, and the rest is 0
  float distance = 0;          ///< metres from border to border, relative to the signer
  float speed_before = 0;      ///< metres a second at the left border, relative to the signer
  float speed_after = 0;       ///< metres a second at the right border
  float approach = 0;          ///< sum of both borders' velocity components along the straight line, metres a second
  float handshape_change = 0;  ///< [0, 1], see distance(Handshape, Handshape); 0 without fingers
};

/// The inputs from which the duration of a transition is predicted.
struct TransitionTask {
  std::array<HandTask, 2> hands;  ///< [Side]
  float shoulder_width = 0;       ///< metres
};

/// A hand at a border, relative to the signer: metres, metres a second.
struct HandThere {
  Eigen::Vector3f place = Eigen::Vector3f::Zero();
  Eigen::Vector3f velocity = Eigen::Vector3f::Zero();
  Handshape shape;
};
/// Returns the task of a hand that moves from one border to the other.
HandTask task_from(const HandThere& from, const HandThere& to) noexcept;

/// Returns the task between the last stroke before a transition and the first stroke after it, from their measured
/// features.
TransitionTask task_between(const PhaseFeatures& before, const PhaseFeatures& after, float shoulder_width) noexcept;

/// A captured transition with its duration.
struct TimedTransition {
  TransitionTask task;
  Seconds duration{0};
  std::size_t recording = 0;  ///< group for cross-validation
};

/// A model of transition durations: their mean, or a fit to the hands' movements.
struct DurationFit {
  Seconds mean{0.5};
  bool median = false;         ///< `mean` holds the median
  std::size_t count = 0;       ///< number of transitions it was fitted on; 0: none, and the mean is an assumption
  std::vector<float> weights;  ///< of the logarithm of the duration in seconds; empty: the mean is used for all
  Seconds mean_error{0};       ///< mean absolute error of predicting the mean, cross-validated by recording
  Seconds fitted_error{0};     ///< the same of the fitted model; 0: too few transitions to fit
  Seconds least{0};            ///< shortest and longest duration it was fitted on
  Seconds most{0};
  /// Inputs are clamped to these bounds, which contain nine tenths of the training inputs.
  std::vector<float> inputs_least, inputs_most;
  float fastest = 0;  ///< highest ratio of distance to duration in the training data, metres a second; 0: unknown
};

/// The minimum number of transitions with a known task for a fit.
inline constexpr std::size_t kLeastTransitions = 20;

/// Fits a model to the transitions, and keeps only the mean unless the model beats it in cross-validation by recording
/// (with one recording, by fifths of it). The logarithm of the duration is linear in the movement of the hand that
/// moves farther (the logarithm of its distance, how far its velocities at both borders point along the path, and the
/// sum of its speeds) and in the larger change of handshape. Minimises absolute errors with a small ridge penalty
/// (ours; docs/durations.md).
DurationFit fit_durations(std::span<const TimedTransition> transitions);

/// Returns the predicted duration, clamped to the shortest and longest duration of the training data, and long enough
/// that no hand has a higher mean speed than the fastest there. Returns the mean if neither hand's task is known.
Seconds duration_of(const DurationFit& fit, const TransitionTask& task) noexcept;

/// The stored form: f64 mean, u64 count, f64 errors of the mean and of the fit, u8 whether there are weights; then f32
/// × 5 weights, least and most inputs, f64 shortest and longest, f32 fastest. `decode` throws Error{corrupt} on bytes
/// that `encode` cannot have written. `median` is not stored: the caller sets it.
void encode(const DurationFit& fit, ByteWriter& out);
DurationFit decode_duration_fit(ByteReader& in);

/// Returns whether two models are equal up to rounding differences between compilers.
bool nearly_same(const DurationFit& a, const DurationFit& b) noexcept;

}  // namespace signweave
