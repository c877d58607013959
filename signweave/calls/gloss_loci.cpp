#include "signweave/calls/gloss_loci.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>

#include "signweave/core/text.h"

namespace signweave::calls {
namespace {

using Eigen::Vector3f;

/// A place with what metres are at its signer.
struct PalmPlace {
  Vector3f at;
  float shoulder_width;
};

double apart(const PalmPlace& a, const PalmPlace& b) {
  return static_cast<double>((a.at - b.at).norm() * 0.5f * (a.shoulder_width + b.shoulder_width));
}

/// Takes the place nearest to the middle, then always the farthest from all taken ones.
std::size_t count_places(std::span<const PalmPlace> places, const PalmPlace& middle) {
  std::vector<double> distance(places.size());
  std::ranges::transform(places, distance.begin(), [&](const PalmPlace& place) { return apart(place, middle); });
  std::size_t next = static_cast<std::size_t>(std::ranges::min_element(distance) - distance.begin());
  std::size_t count = 0;
  for (bool first = true;; first = false) {
    ++count;
    for (std::size_t i = 0; i < places.size(); ++i) {
      const double from_next = apart(places[i], places[next]);
      distance[i] = first ? from_next : std::min(distance[i], from_next);
    }
    next = static_cast<std::size_t>(std::ranges::max_element(distance) - distance.begin());
    if (!(distance[next] > static_cast<double>(kOtherPlace))) return count;
  }
}

/// Within 180 degrees of another angle.
double near_angle(double angle, double other) {
  return other + std::remainder(angle - other, 360.0);
}

std::string_view nearest_locus(const Vector3f& place, const SignerBody& body) {
  std::string_view nearest;
  float least = 0;
  for (const std::string_view name : built_in_loci()) {
    const LocusRef locus{.kind = LocusRef::Kind::name, .name = std::string(name), .numbers = {}};
    const float distance = (resolve(locus, {}, 0, body).at - place).norm();
    if (!nearest.empty() && distance >= least) continue;
    nearest = name;
    least = distance;
  }
  return nearest;
}

PlaceStats stats_of(std::span<const PalmPlace> places, const SignerBody& body) {
  PalmPlace mean{.at = Vector3f::Zero(), .shoulder_width = 0};
  for (const PalmPlace& place : places) {
    mean.at += place.at / static_cast<float>(places.size());
    mean.shoulder_width += place.shoulder_width / static_cast<float>(places.size());
  }
  const auto ahead = static_cast<double>(angles_of(mean.at).azimuth);
  std::vector<double> azimuths, elevations, distances;
  double squares = 0;
  for (const PalmPlace& place : places) {
    const SpaceAngles angles = angles_of(place.at);
    azimuths.push_back(near_angle(static_cast<double>(angles.azimuth), ahead));
    elevations.push_back(static_cast<double>(angles.elevation));
    distances.push_back(static_cast<double>(angles.distance));
    squares += apart(place, mean) * apart(place, mean);
  }
  PlaceStats stats{.azimuth = distribution_of(azimuths),
                   .elevation = distribution_of(elevations),
                   .distance = distribution_of(distances)};
  stats.middle = {.azimuth = static_cast<float>(near_angle(stats.azimuth.median(), 0)),
                  .elevation = static_cast<float>(stats.elevation.median()),
                  .distance = static_cast<float>(stats.distance.median())};
  stats.nearest = nearest_locus(point_of(stats.middle), body);
  stats.places = count_places(places, mean);
  stats.spread = std::sqrt(squares / static_cast<double>(places.size()));
  return stats;
}

/// The hand with the longer path in most tokens; of equally many, the right one.
Side hand_that_goes(std::span<const PlacedToken* const> tokens) {
  std::array<std::size_t, 2> longer{};
  const auto path = [](const std::optional<PalmStroke>& palm) { return palm ? palm->path : -1.0f; };
  for (const PlacedToken* token : tokens) ++longer[path(token->palms[1]) >= path(token->palms[0]) ? 1 : 0];
  return longer[0] > longer[1] ? Side::left : Side::right;
}

Heading heading_of(std::span<const PalmPlace> begins, std::span<const PalmPlace> ends) {
  std::vector<double> outward;
  for (std::size_t i = 0; i < begins.size(); ++i) {
    const auto level = [](const PalmPlace& place) {
      return std::hypot(place.at.x(), place.at.z()) * place.shoulder_width;
    };
    outward.push_back(static_cast<double>(level(ends[i]) - level(begins[i])));
  }
  const double median = distribution_of(outward).median();
  if (std::abs(median) <= static_cast<double>(kAwayOrToward)) return Heading::neither;
  return median > 0 ? Heading::away : Heading::toward;
}

std::optional<GlossLoci> loci_of(std::span<const PlacedToken* const> tokens, const SignerBody& body) {
  GlossLoci loci;
  loci.gloss = tokens.front()->gloss;
  const Side moving = hand_that_goes(tokens);
  const bool annotated = std::ranges::any_of(tokens, [](const PlacedToken* token) { return !token->inferred; });
  std::vector<PalmPlace> begins, ends;
  std::array<std::size_t, 2> hands{};
  for (const PlacedToken* token : tokens) {
    const Side hand = token->hand == Hand::both ? moving : token->hand == Hand::left ? Side::left : Side::right;
    const std::optional<PalmStroke>& palm = token->palms[static_cast<std::size_t>(hand)];
    if (!palm || (annotated && token->inferred)) continue;
    ++hands[static_cast<std::size_t>(hand)];
    begins.push_back({palm->begin, token->shoulder_width});
    ends.push_back({palm->end, token->shoulder_width});
    loci.tokens.push_back({token->recording, token->span, hand, *palm});
  }
  if (loci.tokens.empty()) return std::nullopt;
  loci.hand = hands[0] > hands[1] ? Side::left : Side::right;
  loci.begin = stats_of(begins, body);
  loci.end = stats_of(ends, body);
  loci.heading = heading_of(begins, ends);
  return loci;
}

}  // namespace

std::string_view name_of(Heading heading) noexcept {
  return heading == Heading::away ? "away" : heading == Heading::toward ? "toward" : "neither";
}

std::vector<GlossLoci> gloss_loci(std::span<const PlacedToken> tokens, const SignerBody& body) {
  std::map<std::string, std::vector<const PlacedToken*>> groups;
  for (const PlacedToken& token : tokens) groups[match_form(token.gloss)].push_back(&token);
  std::vector<GlossLoci> result;
  for (const auto& [name, group] : groups) {
    if (std::optional<GlossLoci> loci = loci_of(group, body)) result.push_back(*std::move(loci));
  }
  std::ranges::stable_sort(result, std::greater<>(), &GlossLoci::spread);
  return result;
}

}  // namespace signweave::calls
