#include "demo/face.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "demo/script.h"

namespace signweave::demo {
namespace {

using enum FaceTrack;
using Weights = std::array<float, kFaceTracks>;

constexpr std::string_view kNames[kFaceTracks] = {
    "browInnerUp",       "browOuterUpLeft", "browOuterUpRight", "browDownLeft",   "browDownRight",   "eyeBlinkLeft",
    "eyeBlinkRight",     "eyeWideLeft",     "eyeWideRight",     "eyeSquintLeft",  "eyeSquintRight",  "jawOpen",
    "mouthClose",        "mouthFunnel",     "mouthPucker",      "mouthSmileLeft", "mouthSmileRight", "mouthStretchLeft",
    "mouthStretchRight", "mouthPressLeft",  "mouthPressRight",  "cheekPuff"};

/// The mouth at one moment.
struct Lips {
  float jaw = 0, close = 0, funnel = 0, pucker = 0, smile = 0, stretch = 0, press = 0, puff = 0;
};
/// A mouth changes from the first shape to the second during the stroke.
struct Mouthing {
  Lips first, second;
};

// In the order of the enumerators.
constexpr Mouthing kMouthings[] = {
    {{}, {}},
    {{.jaw = 0.62f, .stretch = 0.12f}, {.jaw = 0.12f}},
    {{.jaw = 0.36f, .funnel = 0.72f}, {.jaw = 0.10f, .funnel = 0.45f}},
    {{.jaw = 0.10f, .funnel = 0.15f, .pucker = 0.85f}, {.jaw = 0.05f, .pucker = 0.62f}},
    {{.jaw = 0.18f, .smile = 0.30f, .stretch = 0.55f}, {.jaw = 0.08f, .smile = 0.35f, .stretch = 0.35f}},
    {{.close = 0.20f, .press = 0.75f}, {.close = 0.15f, .press = 0.60f}},
    {{.press = 0.85f}, {.jaw = 0.66f, .stretch = 0.10f}},
    {{.jaw = 0.06f, .pucker = 0.80f}, {.jaw = 0.58f, .smile = 0.18f}},
    {{.pucker = 0.22f, .press = 0.30f, .puff = 0.85f}, {.pucker = 0.20f, .press = 0.25f, .puff = 0.80f}},
    {{.pucker = 0.25f, .press = 0.30f, .puff = 0.75f}, {.jaw = 0.12f, .funnel = 0.35f, .pucker = 0.75f}},
    {{.jaw = 0.10f, .smile = 0.62f}, {.jaw = 0.16f, .smile = 0.72f}},
};

void set(Weights& weights, FaceTrack track, float value) {
  weights[static_cast<std::size_t>(track)] = value;
}
void set(Weights& weights, FaceTrack left, FaceTrack right, float value, float lopsided) {
  set(weights, left, value * (1 + lopsided));
  set(weights, right, value * (1 - lopsided));
}

Weights weights_of(const Lips& lips, Brows brows, float lopsided) {
  Weights weights{};
  set(weights, jawOpen, lips.jaw);
  set(weights, mouthClose, lips.close);
  set(weights, mouthFunnel, lips.funnel);
  set(weights, mouthPucker, lips.pucker);
  set(weights, cheekPuff, lips.puff);
  set(weights, mouthSmileLeft, mouthSmileRight, lips.smile, lopsided);
  set(weights, mouthStretchLeft, mouthStretchRight, lips.stretch, lopsided);
  set(weights, mouthPressLeft, mouthPressRight, lips.press, lopsided);
  if (brows == Brows::raised) {
    set(weights, browInnerUp, 0.75f);
    set(weights, browOuterUpLeft, browOuterUpRight, 0.70f, lopsided);
    set(weights, eyeWideLeft, eyeWideRight, 0.38f, 0);
  }
  if (brows == Brows::lowered) {
    set(weights, browDownLeft, browDownRight, 0.80f, lopsided);
    set(weights, eyeSquintLeft, eyeSquintRight, 0.42f, 0);
  }
  return weights;
}

/// A running mean with the ends extended: for any length it keeps values within their range.
void smooth(std::vector<float>& values, std::int64_t width) {
  const auto count = static_cast<std::int64_t>(values.size());
  const std::int64_t half = std::max<std::int64_t>(1, width / 2);
  const auto at = [&](std::int64_t i) {
    return static_cast<double>(values[static_cast<std::size_t>(std::clamp<std::int64_t>(i, 0, count - 1))]);
  };
  std::vector<float> result(values.size());
  double sum = 0;
  for (std::int64_t i = -half; i <= half; ++i) sum += at(i);
  for (std::int64_t i = 0; i < count; ++i) {
    result[static_cast<std::size_t>(i)] = static_cast<float>(sum / static_cast<double>(2 * half + 1));
    sum += at(i + half + 1) - at(i - half);
  }
  values = std::move(result);
}

/// The frames at which the eyes blink.
std::vector<std::int64_t> blinks(const Timeline& timeline, Random& random) {
  const double fps = timeline.rate.hertz();
  std::vector<std::int64_t> frames;
  const auto blink = [&](double frame) {
    const auto last = static_cast<double>(frames.empty() ? -timeline.frames : frames.back());
    if (frame - last > 0.9 * fps && frame < static_cast<double>(timeline.frames) - 0.3 * fps) {
      frames.push_back(std::llround(frame));
    }
  };
  blink(random.uniform(0.4, 1.0) * fps);
  for (std::size_t i = 0; i < timeline.signs.size(); ++i) {
    const PlacedSign& sign = timeline.signs[i];
    const bool last = i + 1 == timeline.signs.size() || timeline.signs[i + 1].begin > sign.end;
    const double waited =
        (static_cast<double>(sign.stroke_end) - static_cast<double>(frames.empty() ? 0 : frames.back())) / fps;
    // The longer the eyes have been open, the more likely a blink is.
    const bool wanted = random.uniform() < 0.10 * waited;
    const double when = static_cast<double>(sign.stroke_end) + random.uniform(0.10, 0.30) * fps;
    if (last || wanted) blink(when);
    if (last) blink(static_cast<double>(sign.end) + random.uniform(0.5, 1.0) * fps);
  }
  return frames;
}

}  // namespace

std::string_view name_of(FaceTrack track) noexcept {
  return kNames[static_cast<std::size_t>(track)];
}

FaceMotion face_of(const Timeline& timeline, Random& random) {
  const double fps = timeline.rate.hertz();
  const auto count = static_cast<std::size_t>(timeline.frames);
  FaceMotion face;
  for (std::vector<float>& track : face.tracks) track.assign(count, 0.0f);

  // If two signs claim one frame, the larger weight of each track applies.
  const auto show = [&](double begin, double end, const Weights& weights) {
    const auto first = static_cast<std::size_t>(std::clamp(begin, 0.0, static_cast<double>(count)));
    const auto past = static_cast<std::size_t>(std::clamp(end, 0.0, static_cast<double>(count)));
    for (std::size_t track = 0; track < kFaceTracks; ++track) {
      if (weights[track] <= 0) continue;
      for (std::size_t frame = first; frame < past; ++frame) {
        face.tracks[track][frame] = std::max(face.tracks[track][frame], weights[track]);
      }
    }
  };
  for (const PlacedSign& sign : timeline.signs) {
    const Face& wanted = sign.shape->face;
    const auto strength = static_cast<float>(random.uniform(0.75, 1.1));
    const auto lopsided = static_cast<float>(0.10 * random.normal() * 0.5);
    const double begin = static_cast<double>(sign.stroke_begin) - random.uniform(0.10, 0.20) * fps;
    const double end = static_cast<double>(sign.stroke_end) + random.uniform(0.08, 0.22) * fps;
    const double middle = begin + random.uniform(0.42, 0.58) * (end - begin);
    const Mouthing& mouthing = kMouthings[static_cast<std::size_t>(wanted.mouth)];
    const auto scaled = [&](Weights weights) {
      for (float& weight : weights) weight = std::clamp(weight * strength, 0.0f, 0.95f);
      return weights;
    };
    show(begin, middle, scaled(weights_of(mouthing.first, Brows::level, lopsided)));
    show(middle, end, scaled(weights_of(mouthing.second, Brows::level, lopsided)));
    // Brows are slower than the mouth and last longer.
    show(begin - 0.10 * fps, end + 0.10 * fps, scaled(weights_of({}, wanted.brows, lopsided)));
  }

  const Wander brow_unrest(random, 0.05, 0.4);
  const Wander mouth_unrest(random, 0.05, 0.5);
  for (std::size_t track = 0; track < kFaceTracks; ++track) {
    std::vector<float>& values = face.tracks[track];
    const bool slow = track < static_cast<std::size_t>(jawOpen);
    for (const double seconds : {slow ? 0.16 : 0.09, slow ? 0.12 : 0.07}) smooth(values, std::llround(seconds * fps));
  }
  // A living face is never completely still.
  const auto add = [&](FaceTrack track, std::size_t frame, double value) {
    float& weight = face.tracks[static_cast<std::size_t>(track)][frame];
    weight = std::clamp(weight + static_cast<float>(value), 0.0f, 1.0f);
  };
  for (std::size_t frame = 0; frame < count; ++frame) {
    const double seconds = static_cast<double>(frame) / fps;
    add(browInnerUp, frame, 0.04 + 0.03 * brow_unrest.at(seconds));
    const double smile = 0.06 + 0.03 * mouth_unrest.at(seconds);
    add(mouthSmileLeft, frame, smile);
    add(mouthSmileRight, frame, smile);
  }
  for (const std::int64_t shut : blinks(timeline, random)) {
    const double closing = random.uniform(0.07, 0.09) * fps;
    const double opening = random.uniform(0.13, 0.18) * fps;
    for (auto frame = shut - std::llround(closing); frame <= shut + std::llround(opening); ++frame) {
      if (frame < 0 || frame >= timeline.frames) continue;
      const auto away = static_cast<double>(frame - shut);
      const double u = std::min(1.0, std::abs(away) / (away < 0 ? closing : opening));
      const auto weight = static_cast<float>(0.5 + 0.5 * std::cos(std::numbers::pi * u));
      for (const FaceTrack eye : {eyeBlinkLeft, eyeBlinkRight}) {
        float& value = face.tracks[static_cast<std::size_t>(eye)][static_cast<std::size_t>(frame)];
        value = std::max(value, weight);
      }
      for (const FaceTrack wide : {eyeWideLeft, eyeWideRight}) {
        face.tracks[static_cast<std::size_t>(wide)][static_cast<std::size_t>(frame)] *= 1 - weight;
      }
    }
  }
  return face;
}

}  // namespace signweave::demo
