#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "signweave/core/bytes.h"
#include "signweave/core/time.h"
#include "signweave/features/from_source.h"
#include "signweave/features/hand_motion.h"
#include "signweave/features/point_track.h"
#include "signweave/rig/signer_space.h"

namespace signweave {

/// One point at one moment, in 16 bytes. Stored on disk in this layout: never change.
struct TraceSample {
  static constexpr float kPosition = 1.0f / 4096;  ///< shoulder widths
  static constexpr float kVelocity = 1e-3f;        ///< metres a second
  static constexpr float kAcceleration = 0.02f;    ///< metres a second squared
  std::array<std::int16_t, 3> position{};          ///< signer-centred; values outside the range are clamped
  std::array<std::int16_t, 3> velocity{};          ///< signer's axes
  std::uint16_t acceleration = 0;                  ///< magnitude
  std::uint16_t state = 0;  ///< bits from the lowest: 7 openness, 3 contact, 3 palm, 3 fingers; only set for a palm
  friend bool operator==(const TraceSample&, const TraceSample&) = default;
};
static_assert(sizeof(TraceSample) == 16);

/// The points that are traced.
enum class TracePoint : std::uint8_t { left_palm = 0, right_palm = 1, left_index = 2, right_index = 3 };
inline constexpr std::size_t kTracePoints = 4;
constexpr TracePoint palm_on(Side side) noexcept {
  return static_cast<TracePoint>(side);
}

/// Both hands of one recording, sampled at a fixed step in signer-centred space. Movement conditions and query by
/// example read it instead of the motion.
struct HandTrace {
  std::string why_not;       ///< empty, or the reason why nothing was measured: one line with its fix
  FrameRate rate;            ///< of the motion
  std::int64_t frames = 0;   ///< of the motion
  std::int64_t step = 1;     ///< frames from one sample to the next; the last frame also has a sample
  float shoulder_width = 0;  ///< metres; 0 if nothing was measured
  SignerBody body;           ///< only its heights and reach; no joint
  std::array<std::vector<TraceSample>, kTracePoints> points;  ///< [TracePoint]; empty: the rig lacks it

  const std::vector<TraceSample>& operator[](TracePoint point) const noexcept {
    return points[static_cast<std::size_t>(point)];
  }
  /// The number of samples of each existing point.
  std::size_t samples() const noexcept;
  /// Returns a point over some frames, which must lie within the motion; interpolated linearly between samples. Empty
  /// if the rig lacks the point.
  PointTrack track(TracePoint point, FrameRange range) const;
  /// The same into `out`, whose memory is reused.
  void track(TracePoint point, FrameRange range, PointTrack& out) const;
};

/// Maximum sampling rate, hertz; a motion with a lower frame rate has a sample for every frame.
inline constexpr double kTraceHertz = 60;
/// Increment with every change that yields other values or bytes.
inline constexpr std::uint16_t kTraceVersion = 1;

HandTrace trace_hands(const Motion& motion, const SignerModel& model);
/// The same for a motion that is not in memory, read piece by piece.
HandTrace trace_hands(const MotionSource& source, const SignerModel& model, const Pause& pause = {});

/// The stored form; the layout is described in hand_trace.cpp. `decode_trace` returns nullopt if another version wrote
/// the bytes, and throws Error{corrupt} on bytes that `encode` cannot have written.
void encode(const HandTrace& trace, ByteWriter& out);
std::optional<HandTrace> decode_trace(ByteReader& in, const Pause& pause = {});

}  // namespace signweave
