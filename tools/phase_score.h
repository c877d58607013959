#pragma once

#include <array>
#include <span>
#include <string>
#include <vector>

#include "tools/phase_training.h"

namespace signweave {

/// How often each phase was called what, frame by frame.
struct PhaseScore {
  std::array<std::array<std::size_t, kMotionPhases>, kMotionPhases> counts{};  ///< [person's word][told]

  void add(std::span<const MotionPhase> truth, std::span<const MotionPhase> told);
  std::size_t frames() const noexcept;
  /// Harmonic mean of precision and recall; 0 where the phase was neither there nor told.
  double f1(MotionPhase phase) const noexcept;
  /// Mean of the five F1.
  double macro_f1() const noexcept;
  /// Share of frames told rightly as rest, or as anything but rest.
  double rest_accuracy() const noexcept;
  /// Mean of the F1 of rest and the F1 of all else.
  double rest_macro_f1() const noexcept;
};

/// What was learnt from, what it was tried on, and how well it did there.
struct SplitScore {
  std::string name;  ///< "user b left out", "file a1 left out"
  PhaseScore score;
  PhaseScore inner;  ///< of the frames that are more than kBorder from any border that the person set
};
/// Two people who mark the same recording set a border this far apart and more.
inline constexpr Seconds kBorder{0.1};

/// Trains on all users but one, for each, and on all files but one, for each; tries what was left out.
std::vector<SplitScore> score_users_left_out(std::span<const LabelledTrack> recordings,
                                             const TrainingOptions& options = {});
std::vector<SplitScore> score_files_left_out(std::span<const LabelledTrack> recordings,
                                             const TrainingOptions& options = {});

/// The scores as a table with a line for each and one for their means.
std::string table_of(std::span<const SplitScore> scores);

}  // namespace signweave
