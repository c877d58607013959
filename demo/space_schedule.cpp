#include <algorithm>
#include <cmath>

#include "demo/grid.h"
#include "demo/space.h"

namespace signweave::demo {
namespace {

using Eigen::Vector3f;

// Seconds.
constexpr double kRestAtBegin = 1.2;
constexpr double kRest = 0.7;          ///< between units
constexpr double kPreparation = 0.70;  ///< from rest
constexpr double kRetraction = 0.65;   ///< to rest
constexpr double kRestAtEnd = 2.2;

/// Three numbers whose vector has that root mean square length.
Vector3f draw(Random& random, float length) {
  Vector3f drawn;
  for (float& along : drawn) {
    along = static_cast<float>(std::clamp(random.normal(), -2.5, 2.5)) * length / std::sqrt(3.0f);
  }
  return drawn;
}

PlacedAimed placed_token(const Aimed& aimed, Random& random, float noise) {
  const AimedSign& sign = aimed_sign(aimed.gloss);
  PlacedAimed token{.aimed = &aimed, .placed = {.shape = &shape_of(sign)}, .noise = {}};
  for (AimedNoise& one : token.noise) {
    one.shift = noise * draw(random, kShiftNoise);
    one.turn = noise * draw(random, kTurnNoise);
  }
  if (sign.aiming == Aiming::together) token.noise[0] = token.noise[1];
  return token;
}

double stroke_length_of(const Aimed& aimed) {
  const AimedSign& sign = aimed_sign(aimed.gloss);
  constexpr int kSteps = 16;
  float longest = 0;
  for (const Side side : kSides) {
    if (!acts(sign, side)) continue;
    float length = 0;
    Vector3f before = aimed_hand(aimed, side, 0).palm;
    for (int i = 1; i <= kSteps; ++i) {
      const Vector3f now = aimed_hand(aimed, side, static_cast<float>(i) / kSteps).palm;
      length += (now - before).norm();
      before = now;
    }
    longest = std::max(longest, length);
  }
  return static_cast<double>(longest);
}

/// Distance between the end of one token and the begin of the next, of the right hands, metres.
double gap_between(const Aimed& before, const Aimed& after) {
  const Vector3f from = aimed_hand(before, Side::right, 1).palm;
  return static_cast<double>((aimed_hand(after, Side::right, 0).palm - from).norm());
}

}  // namespace

SpaceTimeline schedule_space(const SpaceScript& script, FrameRate rate, Random& random, float noise) {
  const Grid grid = grid_of(rate);
  SpaceTimeline timeline{.rate = rate, .signs = {}};
  const auto frames = [&](double seconds) { return grid.steps(seconds) * grid.frames; };
  std::int64_t at = frames(kRestAtBegin);
  for (const std::vector<Aimed>& unit : script.units) {
    for (std::size_t i = 0; i < unit.size(); ++i) {
      PlacedAimed token = placed_token(unit[i], random, noise);
      PlacedSign& sign = token.placed;
      sign.begin = at;
      if (i == 0) {
        at += frames(kPreparation);
      } else {
        const double seconds = 0.55 + 0.55 * gap_between(unit[i - 1], unit[i]) + 0.06 * random.normal();
        const std::int64_t gap = frames(std::clamp(seconds, 0.5, 1.1));
        at = timeline.signs.back().placed.stroke_end + gap / grid.frames / 2 * grid.frames;
        timeline.signs.back().placed.end = sign.begin = at;
        at = timeline.signs.back().placed.stroke_end + gap;
      }
      sign.stroke_begin = at;
      const double tempo = std::exp(std::clamp(0.07 * random.normal(), -0.14, 0.14));
      const bool shaken = aimed_sign(unit[i].gloss).aiming == Aiming::facing;
      const double seconds = shaken ? 0.75 : 0.34 + 0.80 * stroke_length_of(unit[i]);
      at += frames(std::clamp(tempo * seconds, 0.34, 0.90));
      sign.stroke_end = at;
      at += frames(kRetraction);
      sign.end = at;
      timeline.signs.push_back(token);
    }
    at += frames(kRest);
  }
  timeline.frames = at + frames(kRestAtEnd - kRest);
  return timeline;
}

}  // namespace signweave::demo
