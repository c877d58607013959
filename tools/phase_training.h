#pragma once

#include <span>

#include "signweave/features/phase_model.h"
#include "tools/gesture_phase.h"

namespace signweave {

/// How a model is trained. The defaults are those of the model in the program.
struct TrainingOptions {
  std::size_t networks = 4;
  int epochs = 10;
  std::size_t batch = 128;
  float rate = 3e-3F;         ///< of Adam, falling to 0 in a straight line
  float decay = 0.05F;        ///< of the weights, apart from Adam's step (Loshchilov and Hutter 2019)
  float noise = 0.4F;         ///< deviation of what is added to each scaled feature
  float dropout = 0.3F;       ///< share of the middle layer that a step leaves out
  float label_doubt = 0.05F;  ///< probability that a label is any of the five
  std::vector<double> tempos = {0.8, 0.9, 1.0, 1.1, 1.25};  ///< each recording is learnt so many times as long
  float step_weight = 0.6F;  ///< how much of the logarithm of a step's frequency counts when decoding
};

/// One frame of the leading hand, and what a person calls it. Every recording labels both hands as one.
struct TrainingExample {
  std::array<float, kPhaseFeatures> features;
  MotionPhase phase;
};

/// A model for frames like those of `recordings`, which must hold at least one. Rounded as it will be stored, so what
/// is scored is what the program would have. The same input gives the same model.
PhaseModel train(std::span<const LabelledTrack* const> recordings, const TrainingOptions& options = {});

/// What a model says of a recording: the phase of the leading hand at each of the recording's own moments.
std::vector<MotionPhase> told_by(const PhaseModel& model, const LabelledTrack& recording);

}  // namespace signweave
