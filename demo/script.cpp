#include "demo/script.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "signweave/core/error.h"

namespace signweave::demo {
namespace {

/// The place between two strokes.
struct Junction {
  std::size_t before = 0;   ///< index of the sign that ends here
  bool rest = false;        ///< the hands rest between
  double way = 0;           ///< metres that the farther hand travels
  double seconds = 0;       ///< retraction and preparation together
  double retraction = 0.5;  ///< its part of that
};

/// The frames on whole milliseconds: every how many frames, and how many seconds those are.
struct Grid {
  std::int64_t frames = 1;
  double seconds = 0;
  std::int64_t steps(double duration) const { return std::llround(duration / seconds); }
};

Grid grid_of(FrameRate rate) {
  const std::int64_t frames = rate.numerator / std::gcd(rate.numerator, 1000 * rate.denominator);
  const Grid grid{frames, static_cast<double>(frames) * rate.frame_time().count()};
  if (grid.seconds > 0.0501) {
    throw Error(
        ErrorCode::unsupported,
        fmt::format("--rate {}: its frames fall on whole milliseconds only every {:.0f} ms; take 100, 50 or 120",
                    to_string(rate), 1000 * grid.seconds));
  }
  return grid;
}

Eigen::Vector3f place_of(const SignShape& sign, Side side, float done) {
  return acts(sign, side) ? stroke_place(sign, side, done) : rest_place();
}

double way_between(const SignShape& from, const SignShape& to) {
  float way = 0;
  for (const Side side : kSides) way = std::max(way, (place_of(to, side, 0) - place_of(from, side, 1)).norm());
  return static_cast<double>(way);
}

double way_from_rest(const SignShape& sign, float done) {
  float way = 0;
  for (const Side side : kSides) way = std::max(way, (place_of(sign, side, done) - rest_place()).norm());
  return static_cast<double>(way);
}

/// Durations with the script's mean and deviation, the longer ones for the longer ways, not strictly: a signer is no
/// clock.
void give_durations(std::vector<Junction*> junctions, const Script& script, Random& random, double least) {
  // Between the deviation over n and the one over n − 1, so that either reading finds the paper's figure.
  const auto count = static_cast<double>(junctions.size());
  const double deviation = Seconds(script.transition_deviation).count() * (1 - 0.25 / count);
  std::vector<double> durations =
      sample_with(random, junctions.size(), Seconds(script.transition_mean).count(), deviation, least);
  std::sort(durations.begin(), durations.end());
  std::vector<std::pair<double, Junction*>> order;
  for (Junction* junction : junctions) order.emplace_back(junction->way + 0.08 * random.normal(), junction);
  std::sort(order.begin(), order.end(), [](const auto& a, const auto& b) {
    return a.first != b.first ? a.first < b.first : a.second->before < b.second->before;
  });
  for (std::size_t i = 0; i < order.size(); ++i) order[i].second->seconds = durations[i];
}

double stroke_seconds(const SignShape& sign, Random& random) {
  float length = 0;
  for (const Side side : kSides) {
    if (acts(sign, side)) length = std::max(length, stroke_length(sign, side));
  }
  // A longer way takes longer, a tenth of a second for 10 cm, and at most some 2.2 m/s in its middle.
  const double wanted = 0.38 + 0.85 * static_cast<double>(length) + 0.05 * random.normal();
  return std::clamp(std::max(wanted, 1.875 * static_cast<double>(length) / 2.2), 0.35, 0.80);
}

}  // namespace

Script meteo() {
  return {.name = "meteo",
          .units = {{"BONJOUR", "METEO", "FRANCE"},
                    {"HIER", "NORD", "VENT", "FORT", "SUD", "ORAGE"},
                    {"MONTAGNE", "NEIGE", "FROID", "METEO", "FRANCE", "NORD", "SUD"},
                    {"ATTENTION",
                     "AUJOURD'HUI",
                     "SIX JUILLET",
                     "LE-TEMPS-PREVU",  // numbers in the unit: 1 to 4
                     "BRETAGNE",
                     "MATIN",
                     "NUAGES",
                     "APRES-MIDI",
                     "PLUIE",  // 5 to 9, today's prediction
                     "DEMAIN",
                     "SOLEIL-BRILLER",
                     "CHAUD-SEC-FERA",
                     "NAGER",  // 10 to 13
                     "CE-SERA-LE-MOMENT",
                     "VENDREDI",  // 14, 15
                     "NUAGES",
                     "NUIT",
                     "EN-MER",
                     "MATIN",
                     "BROUILLARD"}},  // 16 to 20, Friday's
          .transition_mean = 735ms,
          .transition_deviation = 224ms,
          .sink = 0.12f};
}

Script villes() {
  return {.name = "villes",
          .units = {{"VANNES", "PARIS", "LYON", "BREST"},
                    {"NANTES", "MARSEILLE", "QUIMPER", "RENNES"},
                    {"LORIENT", "BORDEAUX", "LE MANS", "TOULOUSE"},
                    {"LILLE", "SAINT-MALO", "STRASBOURG", "BRETAGNE"},
                    {"RENNES", "BREST", "LE MANS", "VANNES"},
                    {"PARIS", "MARSEILLE", "NANTES", "QUIMPER"},
                    {"BORDEAUX", "VANNES", "LYON", "LE MANS"}},
          .transition_mean = 1064ms,
          .transition_deviation = 289ms,
          .sink = 0.72f};
}

Eigen::Vector3f rest_place() {
  return {0.120f, -0.405f, 0.195f};
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
      junction.way =
          junction.rest ? way_from_rest(from, 1) + way_from_rest(*shapes.back(), 0) : way_between(from, *shapes.back());
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
    if (junction.rest) junction.retraction = way_from_rest(*shapes[junction.before], 1) / junction.way;
  }

  Timeline timeline;
  timeline.rate = rate;
  std::int64_t at = grid.steps(1.2);  // steps of the grid; the recording begins with a rest
  const auto edge_steps = [&](float done, const SignShape& sign) {  // from or to the recording's first and last rest
    return grid.steps(std::max(0.45, 1.875 * way_from_rest(sign, done) / 2.0));
  };
  for (std::size_t i = 0; i < shapes.size(); ++i) {
    const Junction* before = i == 0 ? nullptr : &junctions[i - 1];
    const Junction* after = i + 1 == shapes.size() ? nullptr : &junctions[i];
    // Retraction and preparation are cut from one rounded sum, so that rounding does not add up in it.
    const auto whole = [&](const Junction& junction) { return grid.steps(junction.seconds); };
    const auto retraction = [&](const Junction& junction) {
      return grid.steps(junction.seconds * junction.retraction);
    };
    if (before != nullptr && before->rest) at += grid.steps(random.uniform(0.8, 1.4));
    PlacedSign sign{.shape = shapes[i], .begin = at * grid.frames};
    at += before == nullptr ? edge_steps(0, *shapes[i]) : whole(*before) - retraction(*before);
    sign.stroke_begin = at * grid.frames;
    at += grid.steps(stroke_seconds(*shapes[i], random));
    sign.stroke_end = at * grid.frames;
    at += after == nullptr ? edge_steps(1, *shapes[i]) : retraction(*after);
    sign.end = at * grid.frames;
    timeline.signs.push_back(sign);
  }
  timeline.frames = (at + grid.steps(1.0)) * grid.frames;
  return timeline;
}

}  // namespace signweave::demo
