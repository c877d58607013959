#include <algorithm>
#include <cmath>
#include <numbers>

#include "demo/channels.h"
#include "demo/mouthing.h"

namespace signweave::demo {
namespace {

using enum FaceTrack;

constexpr float kBrows = 0.85f;        ///< weight of raised or lowered brows
constexpr double kBrowRamp = 0.14;     ///< seconds in which they rise or fall
constexpr double kHalfOfRamp = 0.559;  ///< of the ramp at which the weight is 0.5
constexpr double kMouthInside = 0.03;  ///< seconds by which the mouth's shapes lie inside the annotated time
constexpr double kMouthBlend = 0.05;   ///< seconds in which one shape becomes the next

double eased(double t) {
  const double u = std::clamp(t, 0.0, 1.0);
  return u * u * (3 - 2 * u);
}

/// Writes weights into the tracks of a face.
struct Painter {
  FaceMotion& face;
  double fps;

  void raise(FaceTrack track, std::int64_t frame, double weight) {
    std::vector<float>& values = face.tracks[static_cast<std::size_t>(track)];
    if (frame < 0 || frame >= static_cast<std::int64_t>(values.size())) return;
    float& value = values[static_cast<std::size_t>(frame)];
    value = std::max(value, static_cast<float>(std::clamp(weight, 0.0, 1.0)));
  }
};

/// The weight reaches one half at both ends of the frames and is above it in between.
void move_brows(Painter& painter, const MarkedFrames& marked) {
  const double ramp = kBrowRamp * painter.fps;
  const auto margin = static_cast<std::int64_t>(ramp);
  for (std::int64_t frame = marked.begin - margin; frame <= marked.end + margin; ++frame) {
    const auto at = static_cast<double>(frame);
    const double rising = (at - static_cast<double>(marked.begin)) / ramp + kHalfOfRamp;
    const double falling = (static_cast<double>(marked.end) - at) / ramp + kHalfOfRamp;
    const double weight = static_cast<double>(kBrows) * eased(std::min(rising, falling));
    if (marked.label == "raised") {
      for (const FaceTrack track : {browInnerUp, browOuterUpLeft, browOuterUpRight})
        painter.raise(track, frame, weight);
      for (const FaceTrack track : {eyeWideLeft, eyeWideRight}) painter.raise(track, frame, 0.45 * weight);
    } else {
      for (const FaceTrack track : {browDownLeft, browDownRight}) painter.raise(track, frame, weight);
      for (const FaceTrack track : {eyeSquintLeft, eyeSquintRight}) painter.raise(track, frame, 0.45 * weight);
    }
  }
}

void shape_mouth(Painter& painter, std::int64_t frame, const MouthShape& shape, double weight) {
  const auto set = [&](FaceTrack track, float value) {
    std::vector<float>& values = painter.face.tracks[static_cast<std::size_t>(track)];
    values[static_cast<std::size_t>(frame)] += static_cast<float>(weight) * value;
  };
  set(jawOpen, shape.jaw);
  set(mouthClose, shape.close);
  set(mouthFunnel, shape.funnel);
  set(mouthPucker, shape.pucker);
  for (const FaceTrack track : {mouthStretchLeft, mouthStretchRight}) set(track, shape.wide);
  for (const FaceTrack track : {mouthPressLeft, mouthPressRight}) set(track, shape.press);
}

/// The shapes of a word share the annotated time; outside it the mouth is still.
void mouth(Painter& painter, const MarkedFrames& marked) {
  const std::vector<MouthShape> shapes = mouth_shapes(marked.label);
  double lengths = 0;
  for (const MouthShape& shape : shapes) lengths += static_cast<double>(shape.length);
  const double first = static_cast<double>(marked.begin) + kMouthInside * painter.fps;
  const double past = static_cast<double>(marked.end) - kMouthInside * painter.fps;
  const double blend = kMouthBlend * painter.fps;
  double at = first;
  for (const MouthShape& shape : shapes) {
    const double end = at + static_cast<double>(shape.length) / lengths * (past - at < 0 ? 0 : past - first);
    for (std::int64_t frame = marked.begin; frame < marked.end; ++frame) {
      const auto now = static_cast<double>(frame);
      // The sum of the weights of neighbours is 1.
      const double weight = eased((now - at) / blend + 0.5) - eased((now - end) / blend + 0.5);
      if (weight > 0) shape_mouth(painter, frame, shape, weight);
    }
    at = end;
  }
}

void shut_lids(Painter& painter, const MarkedFrames& marked) {
  const auto begin = static_cast<double>(marked.begin);
  const auto end = static_cast<double>(marked.end);
  const double shut = begin + 0.35 * (end - begin);
  for (std::int64_t frame = marked.begin; frame <= marked.end; ++frame) {
    const double away = static_cast<double>(frame) - shut;
    const double u = std::min(1.0, std::abs(away) / (away < 0 ? shut - begin : end - shut));
    const double weight = 0.5 + 0.5 * std::cos(std::numbers::pi * u);
    for (const FaceTrack eye : {eyeBlinkLeft, eyeBlinkRight}) painter.raise(eye, frame, weight);
    for (const FaceTrack wide : {eyeWideLeft, eyeWideRight}) {
      painter.face.tracks[static_cast<std::size_t>(wide)][static_cast<std::size_t>(frame)] *=
          1 - static_cast<float>(weight);
    }
  }
}

/// 1 within the frames, rising and falling in `seconds` outside them.
double within(const MarkedFrames& marked, double frame, double seconds, double fps) {
  const double rising = (frame - static_cast<double>(marked.begin)) / (seconds * fps) + 1;
  const double falling = (static_cast<double>(marked.end) - frame) / (seconds * fps) + 1;
  return eased(std::min(rising, falling));
}

/// The same, rising and falling inside them.
double inside(const MarkedFrames& marked, double frame, double seconds, double fps) {
  return within({marked.label, marked.begin + std::llround(seconds * fps), marked.end - std::llround(seconds * fps)},
                frame, seconds, fps);
}

}  // namespace

FaceMotion face_of(const ChannelTimeline& timeline, Random& random) {
  FaceMotion face;
  for (std::vector<float>& track : face.tracks) track.assign(static_cast<std::size_t>(timeline.frames), 0.0f);
  Painter painter{face, timeline.rate.hertz()};
  for (const MarkedFrames& marked : timeline.brows) move_brows(painter, marked);
  for (const MarkedFrames& marked : timeline.mouthings) mouth(painter, marked);
  for (const MarkedFrames& marked : timeline.blinks) shut_lids(painter, marked);
  // A living face is never completely still.
  const Wander brow_unrest(random, 0.05, 0.4);
  const Wander mouth_unrest(random, 0.05, 0.5);
  for (std::int64_t frame = 0; frame < timeline.frames; ++frame) {
    const double seconds = static_cast<double>(frame) / painter.fps;
    painter.raise(browInnerUp, frame, 0.04 + 0.02 * brow_unrest.at(seconds));
    const double smile = 0.06 + 0.02 * mouth_unrest.at(seconds);
    for (const FaceTrack side : {mouthSmileLeft, mouthSmileRight}) painter.raise(side, frame, smile);
  }
  return face;
}

void turn_heads(const ChannelTimeline& timeline, std::vector<BodyFrame>& body) {
  const double fps = timeline.rate.hertz();
  constexpr double kTurn = 2 * std::numbers::pi;
  for (std::size_t i = 0; i < body.size(); ++i) {
    const auto frame = static_cast<double>(i);
    BodyFrame& one = body[i];
    for (const MarkedFrames& head : timeline.heads) {
      const double weight = inside(head, frame, 0.12, fps);
      if (weight <= 0) continue;
      const double seconds = (frame - static_cast<double>(head.begin)) / fps;
      if (head.label == "shake") one.head_yaw += 0.17 * weight * std::sin(kTurn * 2.0 * seconds);
      if (head.label == "nod") one.head_pitch += 0.09 * weight * (1 - std::cos(kTurn * 1.8 * seconds));
    }
    for (const MarkedFrames& gaze : timeline.gazes) {
      const float side = gaze.label == "left" ? 1.0f : -1.0f;
      one.head_yaw += static_cast<double>(side) * 0.17 * within(gaze, frame, 0.25, fps);
      const auto weight = static_cast<float>(inside(gaze, frame, 0.05, fps));
      const Eigen::Vector3f look(side * 0.60f, -0.12f, 0.79f);
      one.look = (one.look + weight * (look.normalized() - one.look)).normalized();
    }
  }
}

}  // namespace signweave::demo
