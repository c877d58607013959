#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "signweave/features/segmenter.h"

namespace signweave {

inline constexpr double kSegmenterRate = 30;       ///< frames a second at which the segmenter works
inline constexpr std::size_t kPhaseFeatures = 27;  ///< numbers per hand and frame; see segment_features.cpp

/// One stretch of a recording without gaps, at kSegmenterRate.
struct PhaseFrames {
  Seconds begin{0};
  std::size_t frames = 0;
  std::array<std::vector<float>, 2> features;  ///< [Side][frame * kPhaseFeatures + feature]; empty: no such hand
  std::array<std::vector<float>, 2> activity;  ///< [Side][frame] how much the hand does around a frame: trunk lengths

  /// The hand that does more around a frame.
  Side leading(std::size_t frame) const noexcept {
    if (activity[0].empty()) return Side::right;
    if (activity[1].empty()) return Side::left;
    return activity[1][frame] > activity[0][frame] ? Side::right : Side::left;
  }
};

/// The features of a recording: positions of the hands relative to the trunk in trunk lengths, resampled, each hand
/// measured against its own resting place and its own usual speed. Throws as `propose_phases` does.
std::vector<PhaseFrames> phase_features(const UpperBodyTrack& track);

/// One number per frame.
using Signal = std::vector<float>;
/// Three numbers per frame.
using Path = std::array<Signal, 3>;

/// Weighted mean over neighbours (Gaussian of `sigma` frames), the ends continued with their last value.
Signal smoothed(const Signal& signal, double sigma);
Path smoothed(const Path& path, double sigma);
/// Median of five neighbours: takes single wild frames out.
Signal median_of_five(const Signal& signal);
/// Central difference per frame, one-sided at the ends.
Signal difference(const Signal& signal);
/// Length of the difference, per second.
Signal speed_of(const Path& path);
/// The value below which a share `q` of `values` lies; 0 for none.
float quantile(std::vector<float> values, double q);

}  // namespace signweave
