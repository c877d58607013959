#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <string_view>

namespace signweave {

/// Measures of a generated span, compared with the captured one; defined in docs/evaluation.md.
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

/// How the scores of several spans are combined into one figure.
enum class Pooling : std::uint8_t {
  mean,       ///< of the scores
  geometric,  ///< the scores are logarithms: the exponential of their mean
  ratio,      ///< sum over generated spans divided by sum over captured spans
};

struct MeasureInfo {
  Measure measure;
  std::string_view name;  ///< in JSON and with --full
  std::string_view unit;  ///< "mm", "°", …; empty: a ratio or a count
  Pooling pooling = Pooling::mean;
  int decimals = 1;
};
std::span<const MeasureInfo> measures() noexcept;
inline const MeasureInfo& info_of(Measure measure) noexcept {
  return measures()[static_cast<std::size_t>(measure)];
}

/// One figure of one span: numerator and denominator of a mean. A NaN value: not measured.
struct Measurement {
  double value = std::numeric_limits<double>::quiet_NaN();
  double weight = 1;
  bool known() const noexcept { return value == value && weight == weight; }
};

/// The hand that a figure describes.
enum class HandChoice : std::uint8_t { left = 0, right = 1, moving = 2 };
inline constexpr std::size_t kHandChoices = 3;
std::string_view name_of(HandChoice hand) noexcept;

/// All measurements of one generated span: [HandChoice][Measure].
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
