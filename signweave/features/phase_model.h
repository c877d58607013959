#pragma once

#include <array>
#include <span>
#include <string>
#include <vector>

#include "signweave/features/phase_signals.h"

namespace signweave {

/// The probability of each phase at one frame; the sum is 1.
using PhaseProbabilities = std::array<float, kMotionPhases>;

/// An ensemble of small networks whose outputs are averaged, and the transition scores between phases. Trained by
/// tools/train_segmenter.cpp.
struct PhaseModel {
  static constexpr std::size_t kHidden = 24;
  static constexpr std::size_t kWeights = kHidden * (kPhaseFeatures + 1) + kMotionPhases * (kHidden + 1);

  std::array<float, kPhaseFeatures> mean{};   ///< subtracted from each feature
  std::array<float, kPhaseFeatures> scale{};  ///< then multiplied by this, then clamped to [-4, 4]
  /// One network each: [hidden][feature, then bias], then [phase][hidden, then bias].
  std::vector<std::array<float, kWeights>> networks;
  /// [from][to] score that a step from one phase to the next adds to the log probability of a phase sequence.
  std::array<std::array<float, kMotionPhases>, kMotionPhases> step{};
};

/// Returns the built-in model, from phase_weights.inc.
const PhaseModel& built_in_phase_model();

/// Returns the probabilities at each frame of `features` (frames * kPhaseFeatures values).
std::vector<PhaseProbabilities> phase_probabilities(const PhaseModel& model, std::span<const float> features);

/// Returns the most likely phase sequence for consecutive frames: Viterbi's algorithm.
std::vector<MotionPhase> most_likely_phases(const PhaseModel& model, std::span<const PhaseProbabilities> frames);

/// Returns a network's output for one scaled frame; `hidden` receives the hidden layer, which training also needs.
PhaseProbabilities answer_of(std::span<const float, PhaseModel::kWeights> network,
                             std::span<const float, kPhaseFeatures> scaled,
                             std::span<float, PhaseModel::kHidden> hidden) noexcept;

/// Returns a frame's features, scaled as the model specifies.
std::array<float, kPhaseFeatures> scaled_features(const PhaseModel& model,
                                                  std::span<const float, kPhaseFeatures> features) noexcept;

/// Returns the parameters of a model in a fixed order as integer multiples of 1/4096: the content of phase_weights.inc.
/// A model unpacked from them differs from `model` only by rounding; packing and unpacking again does not change it.
std::vector<int> packed(const PhaseModel& model);
PhaseModel unpacked(std::span<const int> numbers);

}  // namespace signweave
