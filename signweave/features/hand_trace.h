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

/// One point at one moment, in 16 bytes. Stored on disk as it is: never change.
struct TraceSample {
  static constexpr float kPosition = 1.0f / 4096;  ///< shoulder widths
  static constexpr float kVelocity = 1e-3f;        ///< metres a second
  static constexpr float kAcceleration = 0.02f;    ///< metres a second squared
  std::array<std::int16_t, 3> position{};          ///< signer-centred; numbers beyond the range stop at its ends
  std::array<std::int16_t, 3> velocity{};          ///< signer's axes
  std::uint16_t acceleration = 0;                  ///< its length
  std::uint16_t state = 0;  ///< bits from the lowest: 7 openness, 3 contact, 3 palm, 3 fingers; of a palm only
  friend bool operator==(const TraceSample&, const TraceSample&) = default;
};
static_assert(sizeof(TraceSample) == 16);

/// What is traced.
enum class TracePoint : std::uint8_t { left_palm = 0, right_palm = 1, left_index = 2, right_index = 3 };
inline constexpr std::size_t kTracePoints = 4;
constexpr TracePoint palm_on(Side side) noexcept {
  return static_cast<TracePoint>(side);
}

/// Both hands of one recording, every so many frames, in signer-centred space: what conditions on movement and query by
/// example read instead of the motion.
struct HandTrace {
  std::string why_not;       ///< empty, or why there is nothing: one line with its mend
  FrameRate rate;            ///< of the motion
  std::int64_t frames = 0;   ///< of the motion
  std::int64_t step = 1;     ///< frames of the motion from sample to sample; the last frame has a sample, too
  float shoulder_width = 0;  ///< metres; 0 where nothing was measured
  SignerBody body;           ///< its heights and reach; no joint
  std::array<std::vector<TraceSample>, kTracePoints> points;  ///< [TracePoint]; empty: the rig lacks it

  const std::vector<TraceSample>& operator[](TracePoint point) const noexcept {
    return points[static_cast<std::size_t>(point)];
  }
  /// Samples of each point that there is.
  std::size_t samples() const noexcept;
  /// A point over some frames, which must lie within the motion; between samples in a straight line. Empty where the
  /// rig lacks the point.
  PointTrack track(TracePoint point, FrameRange range) const;
  /// The same into `out`, of which memory is used again.
  void track(TracePoint point, FrameRange range, PointTrack& out) const;
};

/// Samples a second are at most these; a motion of fewer frames a second keeps each.
inline constexpr double kTraceHertz = 60;
/// Count it up with any change that gives other numbers or bytes.
inline constexpr std::uint16_t kTraceVersion = 1;

HandTrace trace_hands(const Motion& motion, const SignerModel& model);
/// The same of a motion that is not in memory, read piece by piece.
HandTrace trace_hands(const MotionSource& source, const SignerModel& model, const Pause& pause = {});

/// As it is stored; the layout is drawn in hand_trace.cpp. `decode_trace` gives none where another version measured,
/// and throws Error{corrupt} on bytes that `encode` cannot have written.
void encode(const HandTrace& trace, ByteWriter& out);
std::optional<HandTrace> decode_trace(ByteReader& in, const Pause& pause = {});

}  // namespace signweave
