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
  float rate = 3e-3F;         ///< learning rate of Adam, decreasing linearly to 0
  float decay = 0.05F;        ///< decoupled weight decay (Loshchilov and Hutter 2019)
  float noise = 0.4F;         ///< standard deviation of the noise added to each scaled feature
  float dropout = 0.3F;       ///< share of the hidden layer that a step drops
  float label_doubt = 0.05F;  ///< label smoothing: probability that a label is any of the five phases
  std::vector<double> tempos = {0.8, 0.9, 1.0, 1.1, 1.25};  ///< factors by which each recording is stretched in time
  float step_weight = 0.6F;                                 ///< weight of a transition's log frequency when decoding
};

/// One frame of the leading hand with its label. Every recording labels both hands as one.
struct TrainingExample {
  std::array<float, kPhaseFeatures> features;
  MotionPhase phase;
};

/// Trains a model on `recordings`, which must contain at least one. The model is rounded as it will be stored, so the
/// scores are those of the stored model. The same input gives the same model.
PhaseModel train(std::span<const LabelledTrack* const> recordings, const TrainingOptions& options = {});

/// A model's prediction for a recording: the phase of the leading hand at each of the recording's own moments.
std::vector<MotionPhase> predicted_phases(const PhaseModel& model, const LabelledTrack& recording);

}  // namespace signweave
