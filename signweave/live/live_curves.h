#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "signweave/live/frame_ring.h"
#include "signweave/nonmanual/expressions.h"
#include "signweave/render/curve_renderer.h"
#include "signweave/render/junction.h"
#include "signweave/score/score.h"

/// Internal to this module.
namespace signweave {

/// The authored movements of a stream's face, gaze and head, over its output frames. Used by one thread.
class LiveCurves {
 public:
  const std::vector<AuthoredCurve>& all() const noexcept { return curves_; }
  void add(AuthoredCurve curve);
  /// Replaces all of them.
  void set(std::vector<AuthoredCurve> curves);
  /// Removes those that begin at `frame` or later.
  void cut(std::int64_t frame);
  /// Lets those of later places than `place` fall from `frame` on.
  void end_after(std::size_t place, std::int64_t frame, FrameRate rate);
  void clear() noexcept { set({}); }

  /// Frames from `frame` on show something else than when they were read.
  void change_from(std::int64_t frame) noexcept { changed_from_ = frame; }
  std::int64_t take_changed_from() noexcept {
    return std::exchange(changed_from_, std::numeric_limits<std::int64_t>::max());
  }

  /// True if one of them is at one of these frames.
  bool cover(FrameRange frames) const noexcept;
  /// Shows them over frames that have the tracks that they set, as far as they are to be seen.
  void show(OutputWindow window, const JunctionSettings& settings);
  /// Shows them over the next `count` frames of the ring, whose memory is filled. `tracks` are the ring's.
  void show(FrameRing& ring, std::int64_t count, const std::vector<std::string>& tracks,
            const JunctionSettings& settings);

 private:
  std::vector<AuthoredCurve> curves_;
  std::optional<CurveRenderer> renderer_;  ///< of curves_; none: not made yet
  Motion frames_;
  std::int64_t changed_from_ = std::numeric_limits<std::int64_t>::max();
};

/// At least one.
std::int64_t frames_of(Milliseconds time, FrameRate rate) noexcept;

/// The scalar tracks that authored movements may set: of the expressions, mouthings and gazes.
std::vector<std::string> authored_tracks(const Expressions& expressions);

}  // namespace signweave
