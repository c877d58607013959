#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "signweave/core/time.h"
#include "signweave/nonmanual/mouthing/viseme.h"

/// Authored movements of the face, the gaze and the head, as plain data, and their values at any frame.
namespace signweave {

/// How a curve and the captured face become one.
enum class Merge : std::uint8_t {
  usual,    ///< `maximum` for brows and lids, `sum` for the mouth; what opposes the curve is reduced
  maximum,  ///< the larger of both
  sum,      ///< both, at most 1
  replace,  ///< the curve, on all tracks of the channels that it has values for
};
std::string_view name_of(Merge merge) noexcept;

/// A weight of the face.
struct TrackWeight {
  std::string track;  ///< an ARKit name, such as "browInnerUp"
  float weight = 0;   ///< from 0 to 1
  friend bool operator==(const TrackWeight&, const TrackWeight&) = default;
};

/// A rotation of the head relative to its captured one; degrees.
struct HeadAngles {
  float pitch = 0;  ///< up
  float yaw = 0;    ///< to the signer's left
  float roll = 0;   ///< tilted to the signer's left
  friend bool operator==(const HeadAngles&, const HeadAngles&) = default;
};

/// A turn of the head with its own onset and offset, and an oscillation about it, which begins in the middle.
struct HeadMovement {
  HeadAngles turn;
  HeadAngles swing;  ///< amplitude
  float hertz = 0;   ///< of the swing
  Milliseconds delay{0};
  Milliseconds onset{200};
  Milliseconds offset{200};
  bool moves() const noexcept { return turn != HeadAngles{} || (swing != HeadAngles{} && hertz > 0); }
  friend bool operator==(const HeadMovement&, const HeadMovement&) = default;
};

/// A direction of gaze relative to the captured head, before the curve turns it; degrees.
struct GazeDirection {
  float yaw = 0;    ///< to the signer's left
  float pitch = 0;  ///< up
  friend bool operator==(const GazeDirection&, const GazeDirection&) = default;
};

/// An authored movement: weights that rise over `onset`, stay, and fall over `offset`. Where it is and how long it
/// lasts is not part of it. In a span shorter than both, they are shortened in proportion, so that the peak is always
/// reached, exactly at a frame.
struct Curve {
  std::string name;  ///< "brows up"; for a mouthing, its text
  Milliseconds onset{160};
  Milliseconds offset{200};
  float amount = 1;  ///< scales all weights and angles; from 0 to 1
  std::vector<TrackWeight> weights;
  HeadMovement head;
  std::vector<MouthKey> mouth;        ///< a mouthing's sounds, in order of time; the mouth is then always replaced
  std::optional<GazeDirection> gaze;  ///< the eyes look there whatever the head does; they are then always replaced
  Merge merge = Merge::usual;         ///< of `weights`
  friend bool operator==(const Curve&, const Curve&) = default;
};

/// A curve and where it is.
struct TimedCurve {
  Curve curve;
  TimeSpan at;
  friend bool operator==(const TimedCurve&, const TimedCurve&) = default;
};

/// Throws Error{bad_input, "WHERE: what is wrong, and how to fix it"} if a value is not finite or out of its range, a
/// track has no channel or occurs twice, or sounds are out of order.
void check(const Curve& curve, const std::string& where);

/// The ARKit tracks that the curve sets, each once. They must exist in a motion that is to show it.
std::vector<std::string> tracks_of(const Curve& curve);

/// A track of a window of frames; borrowed.
struct TrackSpan {
  std::string_view name;
  std::span<float> values;  ///< [frame of the window]
};

/// Adds a curve that is at the output frames `at` to the captured tracks of a window, in place. Each frame is a
/// function of the curve, `at`, `rate` and its captured values alone. Frames outside `at` and tracks that the curve
/// does not concern keep their bits. The eye rotations of Live Link Face (leftEyeYaw, …) follow a gaze where they
/// exist. `curve` must satisfy `check`. Does not allocate.
void apply(const Curve& curve, FrameRange at, FrameRate rate, FrameRange window,
           std::span<const TrackSpan> tracks) noexcept;

/// The curve's rotation of the head at an output frame, in the signer's axes (x left, y up, z forward), to be applied
/// after the captured one; the identity outside `at`.
Eigen::Quaternionf head_rotation(const Curve& curve, FrameRange at, FrameRate rate, std::int64_t frame) noexcept;

}  // namespace signweave
