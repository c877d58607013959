#include "signweave/nonmanual/blinks.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "signweave/core/error.h"
#include "signweave/nonmanual/envelope.h"

namespace signweave {
namespace {

constexpr Milliseconds kLidsDown{80};
constexpr Milliseconds kLidsUp{150};
constexpr Milliseconds kNearby{300};  // how far a blink is moved out of a stroke's first third
constexpr double kMostPerMinute = 60;
static_assert(kBlinkHorizon >= kNearby + Milliseconds(400));

/// Pseudo-random bits (Steele, Lea and Flood 2014, SplitMix).
std::uint64_t mixed_bits(std::uint64_t bits) noexcept {
  bits += 0x9e3779b97f4a7c15u;
  bits = (bits ^ (bits >> 30)) * 0xbf58476d1ce4e5b9u;
  bits = (bits ^ (bits >> 27)) * 0x94d049bb133111ebu;
  return bits ^ (bits >> 31);
}

/// A number in [0, 1) for the `index`-th choice of a kind.
double chance(const BlinkOptions& options, std::uint64_t kind, std::uint64_t index) noexcept {
  return static_cast<double>(mixed_bits(mixed_bits(options.seed ^ (kind << 56)) ^ index) >> 11) * 0x1p-53;
}

struct Candidate {
  Milliseconds at;
  bool boundary;
};

/// A boundary is taken with the probability of its share of the blinks due since the boundary before it: no choice
/// depends on what comes later.
void add_at_boundaries(TimeSpan whole, std::span<const Milliseconds> boundaries, const BlinkOptions& options,
                       std::vector<Candidate>& out) {
  Milliseconds last = whole.begin;
  for (const Milliseconds at : boundaries) {
    if (at < whole.begin || at >= whole.end) continue;
    const double due = options.at_boundaries * options.per_minute * count_of(at - last) / 60'000;
    if (chance(options, 1, static_cast<std::uint64_t>(at.count())) < due) out.push_back({at, true});
    last = at;
  }
}

/// The moment itself, or a better one nearby.
Milliseconds out_of_onset(Milliseconds at, std::span<const Milliseconds> boundaries,
                          std::span<const TimeSpan> strokes) {
  for (const TimeSpan& stroke : strokes) {
    const Milliseconds third = stroke.begin + stroke.duration() / 3;
    if (at < stroke.begin || at >= third) continue;
    Milliseconds best = at - stroke.begin < third - at ? stroke.begin - Milliseconds(1) : third;
    for (const Milliseconds boundary : boundaries) {
      const bool inside = boundary >= stroke.begin && boundary < third;
      if (!inside && std::chrono::abs(boundary - at) <= kNearby) best = boundary;
    }
    return std::chrono::abs(best - at) <= kNearby ? best : at;
  }
  return at;
}

/// Independent of everything else: a Poisson process, whose waiting times are exponential.
void add_others(TimeSpan whole, std::span<const Milliseconds> boundaries, std::span<const TimeSpan> strokes,
                const BlinkOptions& options, std::vector<Candidate>& out) {
  const double per_ms = (1 - options.at_boundaries) * options.per_minute / 60'000;
  if (per_ms <= 0) return;
  double at = count_of(whole.begin);
  for (std::uint64_t i = 0;; ++i) {
    at -= std::log1p(-chance(options, 2, i)) / per_ms;
    if (at >= count_of(whole.end)) return;
    const Milliseconds moved = out_of_onset(Milliseconds(std::llround(at)), boundaries, strokes);
    if (moved >= whole.begin && moved < whole.end) out.push_back({moved, false});
  }
}

}  // namespace

std::vector<Milliseconds> plan_blinks(TimeSpan whole, std::span<const Milliseconds> boundaries,
                                      std::span<const TimeSpan> strokes, const BlinkOptions& options) {
  if (!(options.per_minute >= 0 && options.per_minute <= kMostPerMinute)) {
    throw Error(ErrorCode::bad_input,
                fmt::format("{} blinks a minute; give 0 to {}", options.per_minute, kMostPerMinute));
  }
  if (!(options.at_boundaries >= 0 && options.at_boundaries <= 1)) {
    throw Error(ErrorCode::bad_input,
                fmt::format("a share of {} of the blinks at boundaries; give one from 0 to 1", options.at_boundaries));
  }
  if (options.spacing < Milliseconds(0) || options.spacing > kBlinkHorizon - kNearby) {
    throw Error(ErrorCode::bad_input, fmt::format("{} ms between blinks; give 0 to {}", options.spacing.count(),
                                                  (kBlinkHorizon - kNearby).count()));
  }
  std::vector<Candidate> fixed;
  add_at_boundaries(whole, boundaries, options, fixed);
  std::vector<Candidate> others;
  add_others(whole, boundaries, strokes, options, others);
  // Those at boundaries first, so that none of them gives way to another blink.
  std::vector<Milliseconds> kept;
  const auto is_free = [&](Milliseconds at) {
    return std::ranges::none_of(kept,
                                [&](Milliseconds other) { return std::chrono::abs(other - at) < options.spacing; });
  };
  for (const std::vector<Candidate>* list : {&fixed, &others}) {
    for (const Candidate& one : *list) {
      if (is_free(one.at)) kept.push_back(one.at);
    }
  }
  std::ranges::sort(kept);
  return kept;
}

FrameRange blink_frames(Milliseconds shut, FrameRate rate) noexcept {
  const std::int64_t frame = Envelope::frames(shut, rate);
  return {frame - std::max<std::int64_t>(1, Envelope::frames(kLidsDown, rate)),
          frame + std::max<std::int64_t>(1, Envelope::frames(kLidsUp, rate))};
}

TimedCurve blink_at(Milliseconds shut) {
  return {.curve = {.name = "blink",
                    .onset = kLidsDown,
                    .offset = kLidsUp,
                    .weights = {{"eyeBlinkLeft", 1}, {"eyeBlinkRight", 1}},
                    .head = {},
                    .mouth = {},
                    .gaze = std::nullopt},
          .at = {shut - kLidsDown, shut + kLidsUp}};
}

}  // namespace signweave
