#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "signweave/features/segmenter.h"

namespace signweave {

inline constexpr double kSegmenterRate = 30;       ///< frame rate of the segmenter, hertz
inline constexpr std::size_t kPhaseFeatures = 27;  ///< values per hand and frame; see phase_signals_features.cpp

/// A part of a recording without gaps, at kSegmenterRate.
struct PhaseFrames {
  Seconds begin{0};
  std::size_t frames = 0;
  std::array<std::vector<float>, 2> features;  ///< [Side][frame * kPhaseFeatures + feature]; empty: no such hand
  std::array<std::vector<float>, 2>
      activity;  ///< [Side][frame] amount of the hand's movement around a frame: trunk lengths

  /// Returns the hand that moves more around a frame.
  Side leading(std::size_t frame) const noexcept {
    if (activity[0].empty()) return Side::right;
    if (activity[1].empty()) return Side::left;
    return activity[1][frame] > activity[0][frame] ? Side::right : Side::left;
  }
};

/// Returns the features of a recording: positions of the hands relative to the trunk in trunk lengths, resampled, each
/// hand normalised by its own resting position and its own usual speed. Throws like `propose_phases`.
std::vector<PhaseFrames> phase_features(const UpperBodyTrack& track);

/// One value per frame.
using Signal = std::vector<float>;
/// Three values per frame.
using Path = std::array<Signal, 3>;

/// Gaussian smoothing (`sigma` in frames); the ends are padded with their last value.
Signal smoothed(const Signal& signal, double sigma);
Path smoothed(const Path& path, double sigma);
/// Median of five neighbouring frames: removes single outliers.
Signal median_of_five(const Signal& signal);
/// Central difference per frame, one-sided at the ends.
Signal difference(const Signal& signal);
/// Magnitude of the difference, per second.
Signal speed_of(const Path& path);
/// The value below which a fraction `q` of `values` lies; 0 if empty.
float quantile(std::vector<float> values, double q);

}  // namespace signweave
