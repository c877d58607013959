#include "demo/script.h"

#include <algorithm>
#include <cmath>

#include "demo/grid.h"

namespace signweave::demo {
namespace {

/// The transition between two strokes.
struct Junction {
  std::size_t before = 0;   ///< index of the sign that ends here
  bool rest = false;        ///< the hands rest in between
  double path = 0;          ///< metres travelled by the hand that moves farther
  double seconds = 0;       ///< retraction and preparation together
  double retraction = 0.5;  ///< its share of that
};

Eigen::Vector3f place_of(const SignShape& sign, Side side, float done) {
  return acts(sign, side) ? stroke_place(sign, side, done) : rest_place();
}

/// Maximum over the hands that the next sign needs; a hand that it does not need has no influence.
double path_between(const SignShape& from, const SignShape& to) {
  float path = 0;
  for (const Side side : kSides) {
    if (acts(to, side)) path = std::max(path, (stroke_place(to, side, 0) - place_of(from, side, 1)).norm());
  }
  return static_cast<double>(path);
}

double path_from_rest(const SignShape& sign, float done, Rest rest = Rest::belly) {
  float path = 0;
  for (const Side side : kSides) {
    if (acts(sign, side)) path = std::max(path, (stroke_place(sign, side, done) - rest_place(rest)).norm());
  }
  return static_cast<double>(path);
}

/// Durations with the script's mean and deviation. Longer paths get longer durations, but not strictly: a signer is not
/// a clock.
void give_durations(const std::vector<Junction*>& junctions, const Script& script, Random& random, double least) {
  // Between the deviation over n and the one over n − 1, so that either definition gives the paper's figure.
  const auto count = static_cast<double>(junctions.size());
  const double deviation = Seconds(script.transition_deviation).count() * (1 - 0.25 / count);
  std::vector<double> durations =
      sample_with(random, junctions.size(), Seconds(script.transition_mean).count(), deviation, least);
  std::sort(durations.begin(), durations.end());
  std::vector<std::pair<double, Junction*>> order;
  for (Junction* junction : junctions) order.emplace_back(junction->path + 0.08 * random.normal(), junction);
  std::sort(order.begin(), order.end(), [](const auto& a, const auto& b) {
    return a.first != b.first ? a.first < b.first : a.second->before < b.second->before;
  });
  for (std::size_t i = 0; i < order.size(); ++i) order[i].second->seconds = durations[i];
}

/// `quick` is the shorter of the transitions before and after, in seconds.
Token draw_token(const SignShape& sign, double quick, Random& random) {
  Token token;
  const auto within = [&](double deviation, double most) {
    double drawn = deviation * random.normal();
    while (std::abs(drawn) > most) drawn = deviation * random.normal();
    return static_cast<float>(drawn);
  };
  token.size = 1 + within(0.08, 0.15);
  token.other_size = static_cast<float>(random.uniform(0.90, 1.0));
  token.lag = random.uniform(0.010, 0.040);
  token.turn = within(0.06, 0.15);
  token.bend = within(0.05, 0.12);
  Eigen::Vector3f shift;
  for (float& along : shift) along = within(0.008, 0.02);
  token.shift = shift * std::min(1.0f, 0.02f / std::max(shift.norm(), 1e-6f));
  // In a quick context small movements shrink and one of several repetitions is omitted.
  token.small = static_cast<float>(std::clamp(0.72 + 0.28 * (quick - 0.45) / 0.45, 0.72, 1.0));
  token.fewer = quick < 0.6 ? 1 : 0;
  for (int round = 0; round < 6 && !within_reach(sign, token); ++round) {
    token.shift *= 0.5f;
    token.size = 1 + 0.5f * (token.size - 1);
  }
  return token;
}

double seconds_of_edge(const SignShape& sign, float done) {  // from or to the recording's first and last rest
  return std::max(0.55, 1.875 * path_from_rest(sign, done, Rest::hips) / 1.6);
}

constexpr double kFirstRest = 1.2;  // seconds
constexpr double kLastRest = 1.0;
constexpr double kShortestRest = 0.8;
constexpr double kLongestRest = 1.4;

}  // namespace

double stroke_seconds(const SignShape& sign, const Token& token) {
  float length = 0;
  for (const Side side : kSides) {
    if (acts(sign, side)) length = std::max(length, stroke_length(sign, side, token));
  }
  // A longer path takes longer, a tenth of a second for 12 cm, with at most about 2.2 m/s in its middle; a wrist turns
  // or bends back and forth at most four times per second.
  const double turns = sign.movement == Movement::repeated ? 0 : times_of(sign, token);
  const double seconds =
      std::max({0.38 + 0.85 * static_cast<double>(length), 1.875 * static_cast<double>(length) / 2.2, 0.25 * turns});
  return std::clamp(seconds, 0.38, 0.74);
}

bool ends_unit(const Timeline& timeline, std::size_t sign) noexcept {
  return sign + 1 >= timeline.signs.size() || timeline.signs[sign + 1].begin > timeline.signs[sign].end;
}

Eigen::Vector3f rest_place(Rest rest) {
  return rest == Rest::belly ? Eigen::Vector3f(0.155f, -0.385f, 0.185f) : Eigen::Vector3f(0.265f, -0.490f, 0.060f);
}

Timeline schedule(const Script& script, FrameRate rate, Random& random) {
  const Grid grid = grid_of(rate);
  std::vector<const SignShape*> shapes;
  std::vector<Junction> junctions;
  for (const auto& unit : script.units) {
    for (std::size_t i = 0; i < unit.size(); ++i) {
      shapes.push_back(&sign_for(unit[i]));
      if (shapes.size() == 1) continue;
      Junction junction{.before = shapes.size() - 2, .rest = i == 0};
      const SignShape& from = *shapes[junction.before];
      junction.path = junction.rest ? path_from_rest(from, 1) + path_from_rest(*shapes.back(), 0)
                                    : path_between(from, *shapes.back());
      junctions.push_back(junction);
    }
  }
  std::vector<Junction*> within;
  std::vector<Junction*> across;
  for (Junction& junction : junctions) (junction.rest ? across : within).push_back(&junction);
  give_durations(within, script, random, 0.36);
  give_durations(across, script, random, 0.66 * Seconds(script.transition_mean).count());
  for (Junction& junction : junctions) {
    junction.retraction = std::clamp(0.5 + 0.06 * random.normal(), 0.38, 0.62);
    if (junction.rest) junction.retraction = path_from_rest(*shapes[junction.before], 1) / junction.path;
  }

  Random tokens(random.bits());
  Timeline timeline;
  timeline.rate = rate;
  std::int64_t at = grid.steps(kFirstRest);  // steps of the grid
  for (std::size_t i = 0; i < shapes.size(); ++i) {
    const Junction* before = i == 0 ? nullptr : &junctions[i - 1];
    const Junction* after = i + 1 == shapes.size() ? nullptr : &junctions[i];
    // Retraction and preparation are split from one rounded sum, so that rounding errors do not add up.
    const auto whole = [&](const Junction& junction) { return grid.steps(junction.seconds); };
    const auto retraction = [&](const Junction& junction) {
      return grid.steps(junction.seconds * junction.retraction);
    };
    if (before != nullptr && before->rest) at += grid.steps(random.uniform(kShortestRest, kLongestRest));
    const double quick = std::min(before == nullptr ? 1.0 : before->seconds, after == nullptr ? 1.0 : after->seconds);
    PlacedSign sign{.shape = shapes[i], .token = draw_token(*shapes[i], quick, tokens), .begin = at * grid.frames};
    at += before == nullptr ? grid.steps(seconds_of_edge(*shapes[i], 0)) : whole(*before) - retraction(*before);
    sign.stroke_begin = at * grid.frames;
    const double tempo = std::exp(std::clamp(0.10 * random.normal(), -0.2, 0.2));
    at += grid.steps(std::clamp(tempo * stroke_seconds(*shapes[i], sign.token), 0.35, 0.80));
    sign.stroke_end = at * grid.frames;
    at += after == nullptr ? grid.steps(seconds_of_edge(*shapes[i], 1)) : retraction(*after);
    sign.end = at * grid.frames;
    timeline.signs.push_back(sign);
  }
  timeline.frames = (at + grid.steps(kLastRest)) * grid.frames;
  return timeline;
}

double expected_seconds(const Script& script) {
  double seconds = kFirstRest + kLastRest;
  std::size_t signs = 0;
  for (const auto& unit : script.units) {
    for (const std::string_view gloss : unit) seconds += stroke_seconds(sign_for(gloss), {});
    signs += unit.size();
  }
  if (signs == 0) return seconds;
  seconds += seconds_of_edge(sign_for(script.units.front().front()), 0);
  seconds += seconds_of_edge(sign_for(script.units.back().back()), 1);
  seconds += static_cast<double>(signs - 1) * Seconds(script.transition_mean).count();
  return seconds + static_cast<double>(script.units.size() - 1) * 0.5 * (kShortestRest + kLongestRest);
}

}  // namespace signweave::demo
