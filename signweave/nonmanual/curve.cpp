#include "signweave/nonmanual/curve.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "signweave/motion/degree.h"
#include "signweave/nonmanual/channel.h"
#include "signweave/nonmanual/envelope.h"
#include "signweave/nonmanual/eye_tracks.h"

namespace signweave {
namespace {

/// Movements of which a face can only make one: what is authored takes its weight from what is captured.
struct Opposites {
  std::string_view a, b;
};
constexpr Opposites kOpposites[] = {
    {"browInnerUp", "browDownLeft"},      {"browInnerUp", "browDownRight"},
    {"browOuterUpLeft", "browDownLeft"},  {"browOuterUpRight", "browDownRight"},
    {"eyeWideLeft", "eyeSquintLeft"},     {"eyeWideRight", "eyeSquintRight"},
    {"eyeWideLeft", "eyeBlinkLeft"},      {"eyeWideRight", "eyeBlinkRight"},
    {"mouthSmileLeft", "mouthFrownLeft"}, {"mouthSmileRight", "mouthFrownRight"},
    {"mouthLeft", "mouthRight"},          {"jawLeft", "jawRight"},
    {"eyeLookUpLeft", "eyeLookDownLeft"}, {"eyeLookUpRight", "eyeLookDownRight"},
    {"eyeLookInLeft", "eyeLookOutLeft"},  {"eyeLookInRight", "eyeLookOutRight"},
};

float weight_of(const Curve& curve, std::string_view track) noexcept {
  for (const TrackWeight& one : curve.weights) {
    if (one.track == track) return one.weight;
  }
  return 0;
}

float opposing_weight(const Curve& curve, std::string_view track) noexcept {
  float most = 0;
  for (const Opposites& pair : kOpposites) {
    if (pair.a == track) most = std::max(most, weight_of(curve, pair.b));
    if (pair.b == track) most = std::max(most, weight_of(curve, pair.a));
  }
  return most;
}

bool has_weights_in(const Curve& curve, NonManualChannel channel) noexcept {
  return std::ranges::any_of(curve.weights,
                             [&](const TrackWeight& one) { return channel_of_track(one.track) == channel; });
}

Merge merge_of(const Curve& curve, NonManualChannel channel) noexcept {
  if (curve.merge != Merge::usual) return curve.merge;
  return channel == NonManualChannel::brows || channel == NonManualChannel::lids ? Merge::maximum : Merge::sum;
}

float mixed(float from, float to, float share) noexcept {
  return from + share * (to - from);
}

/// The frames of `at` that lie in a window, and a track's values there.
struct Covered {
  FrameRange frames;
  std::int64_t window_begin;
  float& of(const TrackSpan& track, std::int64_t frame) const noexcept {
    return track.values[static_cast<std::size_t>(frame - window_begin)];
  }
};

void apply_weights(const Curve& curve, const Envelope& envelope, const Covered& covered, const TrackSpan& track,
                   NonManualChannel channel) noexcept {
  const float own = weight_of(curve, track.name);
  const float opposing = opposing_weight(curve, track.name);
  const Merge merge = merge_of(curve, channel);
  const bool replaced = merge == Merge::replace && has_weights_in(curve, channel);
  if (own == 0 && opposing == 0 && !replaced) return;
  for (std::int64_t frame = covered.frames.begin; frame < covered.frames.end; ++frame) {
    const float share = envelope(frame);
    if (share == 0) continue;
    float& value = covered.of(track, frame);
    if (replaced) {
      value = mixed(value, curve.amount * own, share);
      continue;
    }
    const float weight = share * curve.amount;
    const float left = opposing > 0 ? std::max(0.0f, value - weight * opposing) : value;
    value = merge == Merge::maximum ? std::max(left, weight * own) : std::clamp(left + weight * own, 0.0f, 1.0f);
  }
}

void apply_mouth(const Curve& curve, const Envelope& envelope, const Covered& covered, FrameRange at, FrameRate rate,
                 std::span<const TrackSpan> tracks) noexcept {
  constexpr std::int64_t kChunk = 64;
  std::array<VisemeShares, kChunk> shares;
  std::array<float, kChunk> closures;
  for (std::int64_t first = covered.frames.begin; first < covered.frames.end; first += kChunk) {
    const std::int64_t last = std::min(first + kChunk, covered.frames.end);
    for (std::int64_t frame = first; frame < last; ++frame) {
      const std::int64_t in = frame - at.begin;
      const auto i = static_cast<std::size_t>(frame - first);
      shares[i] = viseme_shares(curve.mouth, static_cast<double>(in) * 1000 / rate.hertz());
      closures[i] = closure_at(curve.mouth, in, rate);
    }
    for (const TrackSpan& track : tracks) {
      if (channel_of_track(track.name) != NonManualChannel::mouth) continue;
      const std::optional<MouthWeight> weight = mouth_weight_of(track.name);
      const float own = weight_of(curve, track.name);
      for (std::int64_t frame = first; frame < last; ++frame) {
        const auto i = static_cast<std::size_t>(frame - first);
        float shape = own;
        for (std::size_t v = 0; weight && v < kVisemeCount; ++v) {
          shape += shares[i][v] * shape_of(static_cast<Viseme>(v))[static_cast<std::size_t>(*weight)];
        }
        float& value = covered.of(track, frame);
        value = mixed(value, curve.amount * std::min(shape, 1.0f), envelope(frame));
        if (weight) value = closed(*weight, value, closures[i]);
      }
    }
  }
}

HeadAngles head_angles(const Curve& curve, FrameRange at, FrameRate rate, std::int64_t frame) noexcept {
  const HeadMovement& head = curve.head;
  if (!head.moves()) return {};
  const FrameRange moved{at.begin + Envelope::frames(head.delay, rate), at.end};
  const float share = Envelope(moved, head.onset, head.offset, rate)(frame) * curve.amount;
  if (share == 0) return {};
  const double turns = static_cast<double>(head.hertz) * static_cast<double>(frame - moved.begin) / rate.hertz();
  const auto wave = static_cast<float>(std::sin(2 * std::numbers::pi * (turns - std::floor(turns))));
  return {.pitch = share * (head.turn.pitch + wave * head.swing.pitch),
          .yaw = share * (head.turn.yaw + wave * head.swing.yaw),
          .roll = share * (head.turn.roll + wave * head.swing.roll)};
}

/// The eyes look at the target from the first frame on. Where the head turns with them, they turn back in it, and they
/// leave the target when the head does.
void apply_gaze(const Curve& curve, const Envelope& envelope, const Covered& covered, FrameRange at, FrameRate rate,
                std::span<const TrackSpan> tracks) noexcept {
  const std::int64_t lag = curve.head.moves() ? Envelope::frames(curve.head.offset - curve.offset, rate) : 0;
  const std::int64_t leave = at.end - std::clamp<std::int64_t>(lag, 0, at.size() / 2);
  const Envelope looking({at.begin, leave}, Milliseconds(0), lag > 0 ? curve.offset : Milliseconds(0), rate);
  for (std::int64_t frame = covered.frames.begin; frame < covered.frames.end; ++frame) {
    const float share = envelope(frame);
    if (share == 0) continue;
    const HeadAngles head = head_angles(curve, at, rate, frame);
    const float far = looking(frame) * curve.amount;
    const GazeDirection eyes{.yaw = far * curve.gaze->yaw - head.yaw, .pitch = far * curve.gaze->pitch - head.pitch};
    for (const TrackSpan& track : tracks) {
      if (const std::optional<float> value = eye_track_value(track.name, eyes)) {
        covered.of(track, frame) = mixed(covered.of(track, frame), *value, share);
      }
    }
  }
}

}  // namespace

std::string_view name_of(Merge merge) noexcept {
  switch (merge) {
    case Merge::usual:
      return "usual";
    case Merge::maximum:
      return "maximum";
    case Merge::sum:
      return "sum";
    case Merge::replace:
      return "replace";
  }
  return "usual";
}

std::vector<std::string> tracks_of(const Curve& curve) {
  std::vector<std::string> names;
  const auto add = [&](std::string_view name) {
    if (std::ranges::find(names, name) == names.end()) names.emplace_back(name);
  };
  for (const TrackWeight& one : curve.weights) add(one.track);
  if (!curve.mouth.empty()) {
    for (const std::string_view name : viseme_tracks()) add(name);
  }
  if (curve.gaze) {
    for (const std::string_view name : look_tracks()) add(name);
  }
  return names;
}

void apply(const Curve& curve, FrameRange at, FrameRate rate, FrameRange window,
           std::span<const TrackSpan> tracks) noexcept {
  const Covered covered{.frames = {std::max(at.begin, window.begin), std::min(at.end, window.end)},
                        .window_begin = window.begin};
  if (covered.frames.empty() || curve.amount == 0) return;
  const Envelope envelope(at, curve.onset, curve.offset, rate);
  for (const TrackSpan& track : tracks) {
    const std::optional<NonManualChannel> channel = channel_of_track(track.name);
    if (!channel || (*channel == NonManualChannel::mouth && !curve.mouth.empty())) continue;
    apply_weights(curve, envelope, covered, track, *channel);
  }
  if (!curve.mouth.empty()) apply_mouth(curve, envelope, covered, at, rate, tracks);
  if (curve.gaze) apply_gaze(curve, envelope, covered, at, rate, tracks);
}

Eigen::Quaternionf head_rotation(const Curve& curve, FrameRange at, FrameRate rate, std::int64_t frame) noexcept {
  using Eigen::AngleAxisf, Eigen::Vector3f;
  const HeadAngles angles = head_angles(curve, at, rate, frame);
  if (angles == HeadAngles{}) return Eigen::Quaternionf::Identity();
  // A positive rotation about x (left) takes up to forward, one about z (forward) takes left to up.
  return Eigen::Quaternionf(AngleAxisf(angles.yaw * kDegree, Vector3f::UnitY()) *
                            AngleAxisf(-angles.pitch * kDegree, Vector3f::UnitX()) *
                            AngleAxisf(-angles.roll * kDegree, Vector3f::UnitZ()))
      .normalized();
}

}  // namespace signweave
