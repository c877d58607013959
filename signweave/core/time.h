#pragma once

#include <chrono>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace signweave {

using Milliseconds = std::chrono::milliseconds;  ///< annotation time in whole milliseconds
using Seconds = std::chrono::duration<double>;   ///< used for all computed times
using namespace std::chrono_literals;

/// Milliseconds as a plain number, for statistics.
inline double count_of(Milliseconds time) noexcept {
  return static_cast<double>(time.count());
}

/// A half-open span of annotation time.
struct TimeSpan {
  Milliseconds begin{0};
  Milliseconds end{0};

  Milliseconds duration() const noexcept { return end - begin; }
  bool contains(TimeSpan other) const noexcept { return begin <= other.begin && other.end <= end; }
  bool overlaps(TimeSpan other) const noexcept { return begin < other.end && other.begin < end; }
  friend bool operator==(TimeSpan, TimeSpan) = default;
};

/// A half-open range of frames of one motion.
struct FrameRange {
  std::int64_t begin = 0;
  std::int64_t end = 0;

  std::int64_t size() const noexcept { return end - begin; }
  bool empty() const noexcept { return end <= begin; }
  friend bool operator==(FrameRange, FrameRange) = default;
};

/// Frames per second as a fraction, so that a long recording does not drift: 120/1, 30000/1001. Invariant if created by
/// the functions below: both parts are positive and in lowest terms.
struct FrameRate {
  std::int64_t numerator = 30;
  std::int64_t denominator = 1;

  double hertz() const noexcept { return static_cast<double>(numerator) / static_cast<double>(denominator); }
  Seconds frame_time() const noexcept {
    return Seconds(static_cast<double>(denominator) / static_cast<double>(numerator));
  }
  friend bool operator==(FrameRate, FrameRate) = default;
};

/// The frame rate that a frame time printed in a file denotes.
struct SnappedRate {
  FrameRate rate;
  bool snapped = false;  ///< the text was rounded; the rate is the standard one that rounds to it
};

/// The frame rate that `text` ("0.008333", "3.3333e-2"; seconds per frame) denotes: the standard rate that, printed
/// with the same number of digits, rounded or truncated, gives the same text; otherwise exactly the printed decimal
/// fraction. Standard rates are the whole numbers of 1 to 1000 frames per second that are in use, then the NTSC rates
/// n·1000/1001, then their decimals such as 23.976. Empty if the text is not a finite number of seconds in [1e-6, 1e4].
std::optional<SnappedRate> snap_frame_time(std::string_view text);

/// Parses a rate given by a user in frames per second: "100", "29.97", "30000/1001". Empty if it is not a rate in
/// [1e-4, 1e6].
std::optional<FrameRate> parse_frame_rate(std::string_view text);

/// Returns "120", "29.97" or "30000/1001": the shortest of these forms that identifies the rate.
std::string to_string(FrameRate rate);

/// Maps frames to annotation time. Frame i covers the half-open span of one frame_time that starts at annotation time
/// origin + i · frame_time. A media file with EAF's TIME_ORIGIN t has its frame 0 at −t.
struct FrameClock {
  Seconds frame_time{1.0 / 30.0};
  Seconds origin{0.0};  ///< annotation time of frame 0

  /// The annotation time of a (possibly fractional) frame.
  Seconds time_of(double frame) const noexcept { return origin + frame * frame_time; }
  /// The (fractional) frame at an annotation time.
  double frame_at(Seconds time) const noexcept { return (time - origin) / frame_time; }
  friend bool operator==(FrameClock, FrameClock) = default;
};

/// The frames nearest to a span. Each bound is rounded to the nearest frame, so adjacent spans neither share nor omit a
/// frame. The result may extend beyond the motion; see `clamp`.
FrameRange frames_of(TimeSpan span, const FrameClock& clock) noexcept;

/// The annotation time of a range of frames, to the nearest millisecond.
TimeSpan span_of(FrameRange frames, const FrameClock& clock) noexcept;

/// The part of `range` inside [0, frames).
FrameRange clamp(FrameRange range, std::int64_t frames) noexcept;

}  // namespace signweave
