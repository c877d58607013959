#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <string_view>

namespace signweave {

/// What is told of a made span, compared with the captured one. docs/evaluation.md defines each.
enum class Measure : std::uint8_t {
  wrist,
  wrist_widths,
  fingertips,
  arm_angle,
  finger_angle,
  peak_speed,
  peak_speed_error,
  peak_time,
  path_length,
  path_length_error,
  jerk,
  jerk_error,
  arc_length,
  arc_length_error,
  velocity_jump,
  acceleration_jump,
  onset_lag,
  depth,
  changed_frames,
  duration,
  mean_duration,
  microseconds,
};
inline constexpr std::size_t kMeasures = 22;

/// How the scores of several spans make one figure.
enum class Pooling : std::uint8_t {
  mean,       ///< of the scores
  geometric,  ///< the scores are logarithms: the exponential of their mean
  ratio,      ///< sum of what was made over sum of what was captured
};

struct MeasureInfo {
  Measure measure;
  std::string_view name;  ///< in JSON and with --full
  std::string_view unit;  ///< "mm", "°", …; empty: a ratio or a number
  Pooling pooling = Pooling::mean;
  int decimals = 1;
};
std::span<const MeasureInfo> measures() noexcept;
inline const MeasureInfo& info_of(Measure measure) noexcept {
  return measures()[static_cast<std::size_t>(measure)];
}

/// One figure of one span: what goes on top and what goes below the fraction line of a mean. Not a number above: not
/// measured.
struct Measurement {
  double value = std::numeric_limits<double>::quiet_NaN();
  double weight = 1;
  bool known() const noexcept { return value == value && weight == weight; }
};

/// Which hand a figure is about.
enum class HandChoice : std::uint8_t { left = 0, right = 1, moving = 2 };
inline constexpr std::size_t kHandChoices = 3;
std::string_view name_of(HandChoice hand) noexcept;

/// Everything about one made span: [HandChoice][Measure].
struct SpanScores {
  std::array<std::array<Measurement, kMeasures>, kHandChoices> of;
  Measurement& at(HandChoice hand, Measure measure) noexcept {
    return of[static_cast<std::size_t>(hand)][static_cast<std::size_t>(measure)];
  }
  const Measurement& at(HandChoice hand, Measure measure) const noexcept {
    return of[static_cast<std::size_t>(hand)][static_cast<std::size_t>(measure)];
  }
};

}  // namespace signweave
