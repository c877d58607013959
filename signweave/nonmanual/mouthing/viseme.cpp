#include "signweave/nonmanual/mouthing/viseme.h"

#include <algorithm>
#include <cmath>

namespace signweave {
namespace {

struct VisemeRow {
  std::string_view name;
  bool vowel;
  double length;       ///< relative
  float dominance;     ///< at its middle
  MouthWeights shape;  // jaw, press, roll upper and lower, upper up, lower down, tongue, spread, funnel, pucker, smile
};
// Dominances: 1 for sounds that the lips make, 0.6 for vowels, 0.3 for sounds that the lips do not make. (ours)
constexpr std::array<VisemeRow, kVisemeCount> kRows = {{
    {"sil", false, 1.00, 0.3f, {}},
    {"PP", false, 1.05, 1.0f, {0.00f, 0.50f, 0.3f, 0.3f, 0.00f, 0.00f, 0.00f, 0.0f, 0.00f, 0.00f, 0.0f}},
    {"FF", false, 1.00, 1.0f, {0.06f, 0.00f, 0.0f, 0.5f, 0.30f, 0.00f, 0.00f, 0.0f, 0.00f, 0.00f, 0.0f}},
    {"TH", false, 1.00, 0.6f, {0.14f, 0.00f, 0.0f, 0.0f, 0.00f, 0.20f, 0.35f, 0.0f, 0.00f, 0.00f, 0.0f}},
    {"DD", false, 1.05, 0.3f, {0.12f, 0.00f, 0.0f, 0.0f, 0.10f, 0.25f, 0.00f, 0.0f, 0.00f, 0.00f, 0.0f}},
    {"kk", false, 1.15, 0.3f, {0.18f, 0.00f, 0.0f, 0.0f, 0.00f, 0.20f, 0.00f, 0.0f, 0.00f, 0.00f, 0.0f}},
    {"CH", false, 1.20, 1.0f, {0.10f, 0.00f, 0.0f, 0.0f, 0.00f, 0.00f, 0.00f, 0.0f, 0.55f, 0.30f, 0.0f}},
    {"SS", false, 1.20, 0.6f, {0.04f, 0.00f, 0.0f, 0.0f, 0.15f, 0.30f, 0.00f, 0.3f, 0.00f, 0.00f, 0.0f}},
    {"nn", false, 0.90, 0.3f, {0.10f, 0.00f, 0.0f, 0.0f, 0.00f, 0.20f, 0.00f, 0.0f, 0.00f, 0.00f, 0.0f}},
    {"RR", false, 1.10, 0.6f, {0.15f, 0.00f, 0.0f, 0.0f, 0.00f, 0.00f, 0.00f, 0.0f, 0.25f, 0.00f, 0.0f}},
    {"aa", true, 1.00, 0.6f, {0.60f, 0.00f, 0.0f, 0.0f, 0.20f, 0.30f, 0.00f, 0.0f, 0.00f, 0.00f, 0.0f}},
    {"E", true, 0.95, 0.6f, {0.30f, 0.00f, 0.0f, 0.0f, 0.00f, 0.00f, 0.00f, 0.3f, 0.00f, 0.00f, 0.2f}},
    {"I", true, 0.90, 0.6f, {0.15f, 0.00f, 0.0f, 0.0f, 0.00f, 0.00f, 0.00f, 0.3f, 0.00f, 0.00f, 0.4f}},
    {"O", true, 1.00, 0.6f, {0.35f, 0.00f, 0.0f, 0.0f, 0.00f, 0.00f, 0.00f, 0.0f, 0.50f, 0.20f, 0.0f}},
    {"U", true, 0.95, 1.0f, {0.12f, 0.00f, 0.0f, 0.0f, 0.00f, 0.00f, 0.00f, 0.0f, 0.30f, 0.70f, 0.0f}},
    {"Y", true, 0.95, 1.0f, {0.06f, 0.00f, 0.0f, 0.0f, 0.00f, 0.00f, 0.00f, 0.0f, 0.30f, 0.70f, 0.0f}},
    {"OE", true, 1.00, 0.8f, {0.20f, 0.00f, 0.0f, 0.0f, 0.00f, 0.00f, 0.00f, 0.0f, 0.40f, 0.45f, 0.0f}},
}};

struct TrackRow {
  std::string_view name;
  MouthWeight weight;
};
constexpr TrackRow kTracks[] = {
    {"jawOpen", MouthWeight::jaw_open},
    {"mouthPressLeft", MouthWeight::press},
    {"mouthPressRight", MouthWeight::press},
    {"mouthRollUpper", MouthWeight::roll_upper},
    {"mouthRollLower", MouthWeight::roll_lower},
    {"mouthUpperUpLeft", MouthWeight::upper_up},
    {"mouthUpperUpRight", MouthWeight::upper_up},
    {"mouthLowerDownLeft", MouthWeight::lower_down},
    {"mouthLowerDownRight", MouthWeight::lower_down},
    {"tongueOut", MouthWeight::tongue_out},
    {"mouthStretchLeft", MouthWeight::spread},
    {"mouthStretchRight", MouthWeight::spread},
    {"mouthFunnel", MouthWeight::funnel},
    {"mouthPucker", MouthWeight::pucker},
    {"mouthSmileLeft", MouthWeight::smile},
    {"mouthSmileRight", MouthWeight::smile},
};

/// Millimetres by which each weight moves the lips apart at 1. Where the sum is negative, they are pressed together.
constexpr MouthWeights kApart = {34, -1.5f, -1.5f, -1.5f, 4, 6, 4, 0, 10, 2, 0};
constexpr float kRelaxed = 1;  // millimetres

constexpr double kHalfLife = 45;    // milliseconds of a dominance
constexpr double kFarthest = 500;   // milliseconds: a dominance there is below 0.05 %
constexpr float kNeutral = 0.001f;  // dominance of the neutral mouth
constexpr double kLipsTouch = 20;   // milliseconds before and after the middle of p, b and m
constexpr double kLipsPart = 65;    // milliseconds from the middle to the end of the closure's effect

double time_between(const MouthKey& key, double at) noexcept {
  const double begin = count_of(key.at);
  return std::max({begin - at, at - begin - count_of(key.held), 0.0});
}

std::int64_t frame_near(Milliseconds time, FrameRate rate) noexcept {
  return std::llround(count_of(time) * rate.hertz() / 1000);
}

/// How far a closure still acts at `away` frames from it, if the next sound on that side is `next` frames from it.
float closure_over(std::int64_t away, std::int64_t next, FrameRate rate) noexcept {
  const double frame = 1000 / rate.hertz();
  const double room = next > 0 ? static_cast<double>(next) * frame : kLipsPart;
  const double touch = std::min(kLipsTouch, room / 2);
  const double part = std::min(kLipsPart, room);
  const double time = static_cast<double>(away) * frame;
  if (time <= touch) return 1;
  if (time >= part) return 0;
  const double share = (part - time) / (part - touch);
  return static_cast<float>(share * share * (3 - 2 * share));
}

}  // namespace

std::string_view name_of(Viseme viseme) noexcept {
  return kRows[static_cast<std::size_t>(viseme)].name;
}

std::optional<Viseme> viseme_named(std::string_view name) noexcept {
  for (std::size_t i = 0; i < kVisemeCount; ++i) {
    if (kRows[i].name == name) return static_cast<Viseme>(i);
  }
  return std::nullopt;
}

bool is_vowel(Viseme viseme) noexcept {
  return kRows[static_cast<std::size_t>(viseme)].vowel;
}

std::optional<MouthWeight> mouth_weight_of(std::string_view track) noexcept {
  for (const TrackRow& row : kTracks) {
    if (row.name == track) return row.weight;
  }
  return std::nullopt;
}

std::span<const std::string_view> viseme_tracks() noexcept {
  static constexpr auto kNames = [] {
    std::array<std::string_view, std::size(kTracks)> names;
    for (std::size_t i = 0; i < names.size(); ++i) names[i] = kTracks[i].name;
    return names;
  }();
  return kNames;
}

const MouthWeights& shape_of(Viseme viseme) noexcept {
  return kRows[static_cast<std::size_t>(viseme)].shape;
}

double relative_length(Viseme viseme) noexcept {
  return kRows[static_cast<std::size_t>(viseme)].length;
}

float lip_gap(const MouthWeights& weights) noexcept {
  float gap = kRelaxed;
  for (std::size_t i = 0; i < kMouthWeightCount; ++i) gap += kApart[i] * weights[i];
  return std::max(0.0f, gap / kRelaxed);
}

VisemeShares viseme_shares(std::span<const MouthKey> keys, double at) noexcept {
  VisemeShares shares{};
  float sum = kNeutral;
  for (const MouthKey& key : keys) {
    if (count_of(key.at) - at > kFarthest) break;
    const double away = time_between(key, at);
    if (away > kFarthest) continue;
    const auto viseme = static_cast<std::size_t>(key.viseme);
    const float dominance = kRows[viseme].dominance * static_cast<float>(std::exp2(-away / kHalfLife));
    shares[viseme] += dominance * key.strength;
    sum += dominance;
  }
  for (float& share : shares) share /= sum;
  return shares;
}

float closure_at(std::span<const MouthKey> keys, std::int64_t frame, FrameRate rate) noexcept {
  float most = 0;
  for (std::size_t i = 0; i < keys.size(); ++i) {
    if (keys[i].viseme != Viseme::pp) continue;
    const std::int64_t first = frame_near(keys[i].at, rate);
    const std::int64_t last = frame_near(keys[i].at + keys[i].held, rate);
    if (frame < first) {
      const std::int64_t next = i == 0 ? 0 : first - frame_near(keys[i - 1].at + keys[i - 1].held, rate);
      most = std::max(most, closure_over(first - frame, next, rate));
    } else if (frame > last) {
      const std::int64_t next = i + 1 == keys.size() ? 0 : frame_near(keys[i + 1].at, rate) - last;
      most = std::max(most, closure_over(frame - last, next, rate));
    } else {
      return 1;
    }
  }
  return most;
}

float closed(MouthWeight weight, float value, float closure) noexcept {
  const auto index = static_cast<std::size_t>(weight);
  if (kApart[index] > 0) return value * (1 - closure);
  if (kApart[index] < 0) return std::max(value, closure * shape_of(Viseme::pp)[index]);
  return value;
}

}  // namespace signweave
