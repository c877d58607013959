#pragma once

#include <array>
#include <span>
#include <string>
#include <vector>

#include "signweave/features/phase_signals.h"

namespace signweave {

/// The probability of each phase at one frame; their sum is 1.
using PhaseProbabilities = std::array<float, kMotionPhases>;

/// Some small networks whose answers are averaged, and what is known of which phase follows which. Trained by
/// tools/train_segmenter.cpp.
struct PhaseModel {
  static constexpr std::size_t kHidden = 24;
  static constexpr std::size_t kWeights = kHidden * (kPhaseFeatures + 1) + kMotionPhases * (kHidden + 1);

  std::array<float, kPhaseFeatures> mean{};   ///< subtracted from each feature
  std::array<float, kPhaseFeatures> scale{};  ///< then multiplied by this, then held to [-4, 4]
  /// One network each: [hidden][feature, then bias], then [phase][hidden, then bias].
  std::vector<std::array<float, kWeights>> networks;
  /// [from][to] what a step from one phase to the next adds to the logarithm of the probability of a whole reading.
  std::array<std::array<float, kMotionPhases>, kMotionPhases> step{};
};

/// The model that comes with the program, from phase_weights.inc.
const PhaseModel& built_in_phase_model();

/// The probabilities at each frame of `features` (frames * kPhaseFeatures numbers).
std::vector<PhaseProbabilities> phase_probabilities(const PhaseModel& model, std::span<const float> features);

/// The likeliest reading of a stretch as a whole: Viterbi's algorithm.
std::vector<MotionPhase> likeliest_phases(const PhaseModel& model, std::span<const PhaseProbabilities> frames);

/// A network's answer to one frame that was scaled as the model says; `hidden` receives the middle layer, which
/// training needs too.
PhaseProbabilities answer_of(std::span<const float, PhaseModel::kWeights> network,
                             std::span<const float, kPhaseFeatures> scaled,
                             std::span<float, PhaseModel::kHidden> hidden) noexcept;

/// A frame's features, scaled as the model says.
std::array<float, kPhaseFeatures> scaled_features(const PhaseModel& model,
                                                  std::span<const float, kPhaseFeatures> features) noexcept;

/// The numbers of a model in a fixed order as whole multiples of 1/4096: what phase_weights.inc holds. A model made
/// from them again differs from `model` by rounding only, and is then the same however often that is done.
std::vector<int> packed(const PhaseModel& model);
PhaseModel unpacked(std::span<const int> numbers);

}  // namespace signweave
