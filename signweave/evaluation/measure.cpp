#include "signweave/evaluation/measure.h"

namespace signweave {
namespace {

constexpr MeasureInfo kInfos[] = {
    {Measure::wrist, "wrist", "mm", Pooling::mean, 1},
    {Measure::wrist_widths, "wrist_shoulder_widths", "", Pooling::mean, 4},
    {Measure::fingertips, "fingertips", "mm", Pooling::mean, 2},
    {Measure::arm_angle, "arm_joints", "deg", Pooling::mean, 2},
    {Measure::finger_angle, "finger_joints", "deg", Pooling::mean, 2},
    {Measure::peak_speed, "peak_speed_ratio", "", Pooling::geometric, 3},
    {Measure::peak_speed_error, "abs_ln_peak_speed_ratio", "", Pooling::mean, 3},
    {Measure::peak_time, "peak_time_error", "ms", Pooling::mean, 1},
    {Measure::path_length, "path_length_ratio", "", Pooling::geometric, 3},
    {Measure::path_length_error, "abs_ln_path_length_ratio", "", Pooling::mean, 3},
    {Measure::jerk, "log_jerk_difference", "", Pooling::mean, 3},
    {Measure::jerk_error, "abs_log_jerk_difference", "", Pooling::mean, 3},
    {Measure::arc_length, "spectral_arc_difference", "", Pooling::mean, 3},
    {Measure::arc_length_error, "abs_spectral_arc_difference", "", Pooling::mean, 3},
    {Measure::velocity_jump, "seam_velocity_jump_ratio", "", Pooling::ratio, 2},
    {Measure::acceleration_jump, "seam_acceleration_jump_ratio", "", Pooling::ratio, 2},
    {Measure::onset_lag, "onset_lag_error", "ms", Pooling::mean, 1},
    {Measure::depth, "depth_beyond_captured", "mm", Pooling::mean, 2},
    {Measure::changed_frames, "captured_frames_changed", "", Pooling::mean, 0},
    {Measure::duration, "duration_error", "ms", Pooling::mean, 1},
    {Measure::mean_duration, "duration_error_of_mean", "ms", Pooling::mean, 1},
    {Measure::microseconds, "microseconds", "us", Pooling::mean, 1},
};
static_assert(std::size(kInfos) == kMeasures);

}  // namespace

std::span<const MeasureInfo> measures() noexcept {
  return kInfos;
}

std::string_view name_of(HandChoice hand) noexcept {
  switch (hand) {
    case HandChoice::left:
      return "left";
    case HandChoice::right:
      return "right";
    case HandChoice::moving:
      return "moving";
  }
  return "moving";
}

}  // namespace signweave
