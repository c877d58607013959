#pragma once

#include <array>
#include <span>
#include <string>
#include <vector>

#include "tools/phase_training.h"

namespace signweave {

/// Confusion matrix of phases, counted per frame.
struct PhaseScore {
  std::array<std::array<std::size_t, kMotionPhases>, kMotionPhases> counts{};  ///< [label][predicted]

  void add(std::span<const MotionPhase> truth, std::span<const MotionPhase> predicted);
  std::size_t frames() const noexcept;
  /// Harmonic mean of precision and recall; 0 if the phase was neither labelled nor predicted.
  double f1(MotionPhase phase) const noexcept;
  /// Mean of the five F1 scores.
  double macro_f1() const noexcept;
  /// Share of frames correctly classified as rest, or as any other phase.
  double rest_accuracy() const noexcept;
  /// Mean of the F1 of rest and the F1 of all other phases taken as one.
  double rest_macro_f1() const noexcept;
};

/// The score of one split into training and test data.
struct SplitScore {
  std::string name;  ///< "user b left out", "file a1 left out"
  PhaseScore score;
  PhaseScore inner;  ///< of the frames that are more than kBorder from any labelled border
};
/// Two people who label the same recording place a border this far apart or more.
inline constexpr Seconds kBorder{0.1};

/// For each user, trains on all other users and tests on that user; the second function does the same for files.
std::vector<SplitScore> score_users_left_out(std::span<const LabelledTrack> recordings,
                                             const TrainingOptions& options = {});
std::vector<SplitScore> score_files_left_out(std::span<const LabelledTrack> recordings,
                                             const TrainingOptions& options = {});

/// The scores as a table with a line per split and one for the means.
std::string table_of(std::span<const SplitScore> scores);

}  // namespace signweave
