#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cmath>

#include "signweave/features/phase_signals.h"

namespace signweave {
namespace {

constexpr auto kRate = static_cast<float>(kSegmenterRate);

/// The path of a hand over one section, relative to the trunk, in trunk lengths; x points outwards on both sides.
struct HandPath {
  Path path;
  Signal speed;  ///< trunk lengths a second
};

void check(const UpperBodyTrack& track) {
  if (track.times.size() != track.bodies.size()) {
    throw Error(ErrorCode::bad_input, fmt::format("{} times for {} upper bodies; there must be one for each",
                                                  track.times.size(), track.bodies.size()));
  }
  for (std::size_t i = 0; i < track.times.size(); ++i) {
    const UpperBody& body = track.bodies[i];
    bool finite = std::isfinite(track.times[i].count()) && body.head.allFinite() && body.spine.allFinite();
    for (const Side side : kSides) {
      const auto s = static_cast<std::size_t>(side);
      if (track.has_hand[s]) finite = finite && body.hands[s].allFinite() && body.wrists[s].allFinite();
    }
    if (!finite) throw Error(ErrorCode::bad_input, fmt::format("moment {}: a value is not finite", i));
    if (i > 0 && track.times[i] <= track.times[i - 1]) {
      throw Error(ErrorCode::bad_input, fmt::format("moment {}: its time is not later than the previous one", i));
    }
  }
}

/// Moments [begin, end) without a gap.
struct Section {
  std::size_t begin = 0;
  std::size_t end = 0;
};

std::vector<Section> sections_of(const std::vector<Seconds>& times) {
  std::vector<Section> result;
  for (std::size_t i = 0; i < times.size(); ++i) {
    if (i == 0 || times[i] - times[i - 1] > kLongestStep) result.push_back({i, i});
    result.back().end = i + 1;
  }
  return result;
}

/// Midpoints of palm and wrist, and the spine, at the segmenter's rate.
struct Resampled {
  std::array<Path, 2> hands;
  Path spine;
};

Resampled resampled(const UpperBodyTrack& track, Section section, std::size_t frames) {
  Resampled result;
  for (Path* path : {&result.hands[0], &result.hands[1], &result.spine}) {
    for (Signal& axis : *path) axis.resize(frames);
  }
  std::size_t at = section.begin;
  for (std::size_t frame = 0; frame < frames; ++frame) {
    const Seconds time = track.times[section.begin] + Seconds(static_cast<double>(frame) / kSegmenterRate);
    while (at + 2 < section.end && track.times[at + 1] <= time) ++at;
    const std::size_t next = std::min(at + 1, section.end - 1);
    const double step = (track.times[next] - track.times[at]).count();
    const auto share =
        static_cast<float>(step > 0 ? std::clamp((time - track.times[at]).count() / step, 0.0, 1.0) : 0.0);
    const UpperBody& a = track.bodies[at];
    const UpperBody& b = track.bodies[next];
    const auto between = [share](const Eigen::Vector3f& from, const Eigen::Vector3f& to) -> Eigen::Vector3f {
      return from + share * (to - from);
    };
    const Eigen::Vector3f spine = between(a.spine, b.spine);
    for (std::size_t axis = 0; axis < 3; ++axis) result.spine[axis][frame] = spine[static_cast<Eigen::Index>(axis)];
    for (std::size_t side = 0; side < 2; ++side) {
      if (!track.has_hand[side]) continue;
      const Eigen::Vector3f hand =
          0.5F * (between(a.hands[side], b.hands[side]) + between(a.wrists[side], b.wrists[side]));
      for (std::size_t axis = 0; axis < 3; ++axis) {
        result.hands[side][axis][frame] = hand[static_cast<Eigen::Index>(axis)];
      }
    }
  }
  return result;
}

/// Returns a hand's resting position: where it is most often while slow, preferring low positions.
Eigen::Vector3f resting_position(const std::vector<HandPath>& hand) {
  std::vector<float> speeds;
  std::vector<float> heights;
  for (const HandPath& part : hand) {
    speeds.insert(speeds.end(), part.speed.begin(), part.speed.end());
    heights.insert(heights.end(), part.path[1].begin(), part.path[1].end());
  }
  const float slow = quantile(speeds, 0.5);
  const float low = quantile(heights, 0.05);
  std::vector<Eigen::Vector3f> places;
  for (const HandPath& part : hand) {
    for (std::size_t i = 0; i < part.speed.size(); ++i) {
      if (part.speed[i] <= slow) places.emplace_back(part.path[0][i], part.path[1][i], part.path[2][i]);
    }
  }
  // A few hundred positions are sufficient, and the cost is quadratic.
  const std::size_t step = std::max<std::size_t>(1, places.size() / 400);
  Eigen::Vector3f best = Eigen::Vector3f::Zero();
  float most = -1;
  for (std::size_t i = 0; i < places.size(); i += step) {
    float density = 0;
    for (std::size_t k = 0; k < places.size(); k += step) {
      density += std::exp(-(places[i] - places[k]).squaredNorm() / (2 * 0.12F * 0.12F));
    }
    density *= std::exp(-std::max(0.0F, places[i].y() - low) / 0.3F);
    if (density > most) {
      most = density;
      best = places[i];
    }
  }
  return best;
}

/// The reference values of a hand, derived from the recording itself.
struct OwnMeasures {
  Eigen::Vector3f rest;
  float speed = 1;     ///< trunk lengths a second: a high speed for this hand
  float distance = 1;  ///< trunk lengths: a large distance from the resting position for this hand
};

Signal distance_to(const Path& path, const Eigen::Vector3f& place) {
  Signal result(path[0].size());
  for (std::size_t i = 0; i < result.size(); ++i) {
    result[i] = std::hypot(path[0][i] - place.x(), path[1][i] - place.y(), path[2][i] - place.z());
  }
  return result;
}

OwnMeasures own_measures(const std::vector<HandPath>& hand) {
  OwnMeasures own{.rest = resting_position(hand)};
  std::vector<float> speeds;
  std::vector<float> distances;
  for (const HandPath& part : hand) {
    speeds.insert(speeds.end(), part.speed.begin(), part.speed.end());
    const Signal distance = distance_to(part.path, own.rest);
    distances.insert(distances.end(), distance.begin(), distance.end());
  }
  own.speed = std::max(quantile(std::move(speeds), 0.8), 0.1F);
  own.distance = std::max(quantile(std::move(distances), 0.9), 0.1F);
  return own;
}

/// Writes features column by column.
class Columns {
 public:
  Columns(std::vector<float>& values, std::size_t frames) : values_(values), frames_(frames) {
    values_.assign(frames * kPhaseFeatures, 0.0F);
  }
  ~Columns() { assert(next_ == kPhaseFeatures); }
  Columns(const Columns&) = delete;
  Columns& operator=(const Columns&) = delete;

  /// Adds the next feature: value_of(frame) for every frame.
  template <class ValueOf>
  void add(const ValueOf& value_of) {
    assert(next_ < kPhaseFeatures);
    for (std::size_t frame = 0; frame < frames_; ++frame) values_[frame * kPhaseFeatures + next_] = value_of(frame);
    ++next_;
  }

 private:
  std::vector<float>& values_;
  std::size_t frames_;
  std::size_t next_ = 0;
};

/// Returns the frame `lag` away, clamped to the range.
std::size_t shifted(std::size_t frame, int lag, std::size_t frames) {
  const auto at = static_cast<std::ptrdiff_t>(frame) + lag;
  return static_cast<std::size_t>(std::clamp<std::ptrdiff_t>(at, 0, static_cast<std::ptrdiff_t>(frames) - 1));
}

Signal logarithm(const Signal& signal, float unit) {
  Signal result(signal.size());
  for (std::size_t i = 0; i < result.size(); ++i) result[i] = std::log(signal[i] / unit + 0.03F);
  return result;
}

/// Strokes are slower than transitions yet accelerate more (Jantunen 2013). So speed, acceleration, straightness and
/// the movement from and to the resting position are combined, at several widths: up to a second and a third on either
/// side.
std::vector<float> features_of(const HandPath& hand, const OwnMeasures& own) {
  const std::size_t frames = hand.speed.size();
  const Path& path = hand.path;
  const Signal& speed = hand.speed;
  const Signal distance = distance_to(path, own.rest);
  const Path path_3 = smoothed(path, 3);
  const Signal log_speed = logarithm(speed, own.speed);
  const Signal log_speed_3 = logarithm(speed_of(path_3), own.speed);
  const Signal speed_8 = smoothed(speed, 8);
  const Signal log_speed_8 = logarithm(speed_8, own.speed);
  const Signal log_speed_20 = logarithm(smoothed(speed, 20), own.speed);
  const Signal net_speed_8 = speed_of(smoothed(path, 8));
  Path velocity = smoothed(path, 1.5);
  for (Signal& axis : velocity) axis = difference(axis);
  Signal acceleration = speed_of(velocity);
  for (float& one : acceleration) one *= kRate;
  const Signal log_acceleration = logarithm(smoothed(acceleration, 2), 10 * own.speed);
  const Signal log_acceleration_8 = logarithm(smoothed(acceleration, 8), 10 * own.speed);
  const Signal speeding_up = difference(smoothed(log_speed, 2));
  const Signal leaving_2 = difference(smoothed(distance, 2));
  const Signal leaving_6 = difference(smoothed(distance, 6));
  const Path velocity_3 = {difference(path_3[0]), difference(path_3[1]), difference(path_3[2])};
  const float per_speed = kRate / own.speed;

  std::vector<float> values;
  Columns columns(values, frames);
  columns.add([&](std::size_t i) { return log_speed[i]; });
  columns.add([&](std::size_t i) { return log_speed_3[i]; });
  columns.add([&](std::size_t i) { return log_speed_8[i]; });
  columns.add([&](std::size_t i) { return log_speed_20[i]; });
  columns.add([&](std::size_t i) { return net_speed_8[i] / (speed_8[i] + 0.02F); });
  columns.add([&](std::size_t i) { return log_acceleration[i]; });
  columns.add([&](std::size_t i) { return log_acceleration_8[i]; });
  columns.add([&](std::size_t i) { return speeding_up[i] * kRate / 10; });
  columns.add([&](std::size_t i) { return leaving_2[i] * per_speed; });
  columns.add([&](std::size_t i) { return leaving_6[i] * per_speed; });
  columns.add([&](std::size_t i) { return distance[i] / own.distance; });
  columns.add([&](std::size_t i) { return std::log(distance[i] + 0.05F); });
  for (std::size_t axis = 0; axis < 3; ++axis) {
    columns.add([&](std::size_t i) { return path[axis][i] - own.rest[static_cast<Eigen::Index>(axis)]; });
  }
  columns.add([&](std::size_t i) { return path[1][i]; });
  for (std::size_t axis = 0; axis < 3; ++axis) {
    columns.add([&](std::size_t i) { return velocity_3[axis][i] * per_speed; });
  }
  for (const int width : {15, 40}) {
    for (const int direction : {1, -1}) {
      const auto extreme = [&](std::size_t i, bool largest) {
        float value = distance[i];
        for (int k = 1; k < width; ++k) {
          const float other = distance[shifted(i, direction * k, frames)];
          value = largest ? std::max(value, other) : std::min(value, other);
        }
        return value / own.distance;
      };
      columns.add([&](std::size_t i) { return extreme(i, false); });
      columns.add([&](std::size_t i) { return extreme(i, true); });
    }
  }
  return values;
}

/// Returns the median length of the trunk from its centre to the head: the unit of all distances.
float trunk_length(const UpperBodyTrack& track) {
  std::vector<float> lengths;
  lengths.reserve(track.bodies.size());
  for (const UpperBody& body : track.bodies) lengths.push_back((body.head - body.spine).norm());
  return std::max(quantile(std::move(lengths), 0.5), 1e-3F);
}

}  // namespace

std::vector<PhaseFrames> phase_features(const UpperBodyTrack& track) {
  check(track);
  const float trunk = trunk_length(track);
  std::vector<PhaseFrames> result;
  std::array<std::vector<HandPath>, 2> hands;
  for (const Section section : sections_of(track.times)) {
    const Seconds length = track.times[section.end - 1] - track.times[section.begin];
    const std::size_t frames = static_cast<std::size_t>(length.count() * kSegmenterRate + 1e-6) + 1;
    Resampled sampled = resampled(track, section, frames);
    const Path spine = smoothed(sampled.spine, 15);
    for (std::size_t side = 0; side < 2; ++side) {
      if (!track.has_hand[side]) continue;
      HandPath& hand = hands[side].emplace_back();
      for (std::size_t axis = 0; axis < 3; ++axis) {
        // Outwards is left for the left hand: the right hand is mirrored.
        const float scale = (axis == 0 && side == static_cast<std::size_t>(Side::right) ? -1.0F : 1.0F) / trunk;
        Signal relative = std::move(sampled.hands[side][axis]);
        for (std::size_t i = 0; i < frames; ++i) relative[i] = scale * (relative[i] - spine[axis][i]);
        hand.path[axis] = smoothed(median_of_five(relative), 1);
      }
      hand.speed = speed_of(smoothed(hand.path, 1));
    }
    result.push_back({.begin = track.times[section.begin], .frames = frames});
  }
  for (std::size_t side = 0; side < 2; ++side) {
    if (hands[side].empty()) continue;
    const OwnMeasures own = own_measures(hands[side]);
    for (std::size_t i = 0; i < result.size(); ++i) {
      const HandPath& hand = hands[side][i];
      result[i].features[side] = features_of(hand, own);
      result[i].activity[side] = smoothed(hand.speed, 20);
      const Signal distance = smoothed(distance_to(hand.path, own.rest), 20);
      for (std::size_t k = 0; k < result[i].frames; ++k) result[i].activity[side][k] += 0.5F * distance[k];
    }
  }
  return result;
}

}  // namespace signweave
