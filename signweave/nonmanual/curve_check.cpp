#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "signweave/core/error.h"
#include "signweave/core/text.h"
#include "signweave/nonmanual/channel.h"
#include "signweave/nonmanual/curve.h"

namespace signweave {
namespace {

constexpr std::size_t kMostWeights = 64;
constexpr std::size_t kMostSounds = 2000;
constexpr Milliseconds kLongest{60'000};
constexpr Milliseconds kLastSound{24 * 3'600'000};
constexpr float kFarthestTurn = 60;  // degrees
constexpr float kFarthestGaze = 90;  // degrees
constexpr float kFastestSwing = 10;  // hertz

/// Throws with the place and name of a curve.
class CurveChecker {
 public:
  CurveChecker(const Curve& curve, const std::string& where) : curve_(curve), where_(where) {}

  void run() const {
    number(curve_.amount, 0, 1, "the amount");
    time(curve_.onset, kLongest, "the onset");
    time(curve_.offset, kLongest, "the offset");
    if (curve_.merge > Merge::replace) fail("the merge is none of usual, maximum, sum and replace");
    weights();
    head();
    mouth();
    if (curve_.gaze) {
      number(curve_.gaze->yaw, -kFarthestGaze, kFarthestGaze, "the gaze's yaw in degrees");
      number(curve_.gaze->pitch, -kFarthestGaze, kFarthestGaze, "the gaze's pitch in degrees");
    }
  }

 private:
  [[noreturn]] void fail(const std::string& what) const {
    throw Error(ErrorCode::bad_input, fmt::format("{}: non-manual '{}': {}", where_, printable(curve_.name), what));
  }
  void number(float value, float least, float most, std::string_view what) const {
    if (!(value >= least && value <= most))
      fail(fmt::format("{} is {}; give one from {} to {}", what, value, least, most));
  }
  void time(Milliseconds value, Milliseconds most, const char* what) const {
    if (value < Milliseconds(0) || value > most) {
      fail(fmt::format("{} is {} ms; give one from 0 to {} ms", what, value.count(), most.count()));
    }
  }

  void weights() const {
    if (curve_.weights.size() > kMostWeights) {
      fail(fmt::format("{} weights, and {} is the most; remove some", curve_.weights.size(), kMostWeights));
    }
    for (std::size_t i = 0; i < curve_.weights.size(); ++i) {
      const TrackWeight& one = curve_.weights[i];
      const std::optional<NonManualChannel> channel = channel_of_track(one.track);
      if (!channel || *channel == NonManualChannel::head || one.track.starts_with("leftEye") ||
          one.track.starts_with("rightEye")) {
        fail(fmt::format("'{}' is not a weight of the face; use an ARKit name, such as browInnerUp",
                         printable(one.track)));
      }
      number(one.weight, 0, 1, printable(one.track));
      const auto same = [&](const TrackWeight& other) { return other.track == one.track; };
      if (std::any_of(curve_.weights.begin(), curve_.weights.begin() + static_cast<std::ptrdiff_t>(i), same)) {
        fail(fmt::format("track {} occurs twice; remove one", printable(one.track)));
      }
    }
  }

  void head() const {
    const HeadMovement& head = curve_.head;
    for (const HeadAngles& angles : {head.turn, head.swing}) {
      number(angles.pitch, -kFarthestTurn, kFarthestTurn, "the head's pitch in degrees");
      number(angles.yaw, -kFarthestTurn, kFarthestTurn, "the head's yaw in degrees");
      number(angles.roll, -kFarthestTurn, kFarthestTurn, "the head's roll in degrees");
    }
    number(head.hertz, 0, kFastestSwing, "the head's swings per second");
    time(head.delay, kLongest, "the head's delay");
    time(head.onset, kLongest, "the head's onset");
    time(head.offset, kLongest, "the head's offset");
  }

  void mouth() const {
    if (curve_.mouth.size() > kMostSounds) {
      fail(fmt::format("{} sounds, and {} is the most; give a shorter text", curve_.mouth.size(), kMostSounds));
    }
    Milliseconds last{0};
    for (const MouthKey& key : curve_.mouth) {
      if (static_cast<std::size_t>(key.viseme) >= kVisemeCount) fail("a sound has a viseme that does not exist");
      time(key.at, kLastSound, "a sound's time");
      time(key.held, kLastSound, "the time that a sound is held");
      number(key.strength, 0, 1, "a sound's strength");
      if (key.at < last) fail("its sounds are out of order; sort them by time");
      last = key.at;
    }
  }

  const Curve& curve_;
  const std::string& where_;
};

}  // namespace

void check(const Curve& curve, const std::string& where) {
  CurveChecker(curve, where).run();
}

}  // namespace signweave
