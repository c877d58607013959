#include "signweave/choose/space_gaze.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "signweave/core/error.h"
#include "signweave/nonmanual/gaze.h"

namespace signweave {
namespace {

/// The eyes and the head turn at most so far to a side, and follow no locus beyond the second azimuth. Degrees. (ours)
constexpr float kMostGaze = 100;
constexpr float kMostLookedAt = 125;

bool is_direction(std::string_view name) {
  return std::ranges::any_of(named_gazes(), [&](const NamedGaze& one) { return one.name == name; });
}

/// The locus that a sign is aimed at; none: not at all, or where no gaze goes.
std::optional<LocusRef> looked_at(const Utterance& utterance, std::size_t place) {
  const SpaceChange& change = utterance.places[place].space;
  const std::optional<LocusRef>& target = change.at ? change.at : change.to;
  if (!target) return std::nullopt;
  LocusRef known = without_setups(*target, utterance.loci, place);
  if (known.kind == LocusRef::Kind::name && (known.name == "self" || known.name == "addressee")) return std::nullopt;
  return known;
}

}  // namespace

Utterance with_gazes_at_loci(Utterance utterance) {
  std::vector<bool> has_gaze(utterance.places.size(), false);
  for (NonManual& one : utterance.non_manuals) {
    if (one.kind != NonManual::Kind::gaze) continue;
    for (std::size_t place = one.first; place <= one.last && place < has_gaze.size(); ++place) has_gaze[place] = true;
    if (is_direction(one.what)) continue;
    const LocusRef ref = read_locus(one.what);
    if (ref.kind != LocusRef::Kind::name) continue;
    // What is neither set up nor a direction is refused where directions are read.
    const bool set_up =
        std::ranges::any_of(utterance.loci, [&](const LocusSetup& setup) { return setup.name == ref.name; });
    if (set_up || is_built_in_locus(ref.name)) one.what = to_string(without_setups(ref, utterance.loci, one.first));
  }
  for (std::size_t place = 0; place < utterance.places.size(); ++place) {
    if (has_gaze[place]) continue;
    const std::optional<LocusRef> target = looked_at(utterance, place);
    if (!target) continue;
    const NonManual gaze{.kind = NonManual::Kind::gaze, .what = to_string(*target), .first = place, .last = place};
    const auto after = std::ranges::upper_bound(utterance.non_manuals, place, {}, &NonManual::first);
    utterance.non_manuals.insert(after, gaze);
  }
  return utterance;
}

GazeDirection direction_of_gaze(std::string_view what) {
  if (what.empty() || std::string_view("+-.0123456789").find(what.front()) == std::string_view::npos) {
    return find_gaze(what);
  }
  const LocusRef ref = read_locus(what);
  const auto& [a, b, c] = ref.numbers;
  const Eigen::Vector3f at = ref.kind == LocusRef::Kind::point ? Eigen::Vector3f(a, b, c) : point_of({a, b, c});
  const SpaceAngles angles = angles_of(at - Eigen::Vector3f(0, kEyesUp, kEyesForward));
  if (std::abs(angles.azimuth) > kMostLookedAt) {
    throw Error(ErrorCode::bad_input, fmt::format("a gaze at '@{}' would go behind the signer; give an azimuth within "
                                                  "{:.0f}° to either side",
                                                  what, kMostGaze));
  }
  return {.yaw = std::clamp(angles.azimuth, -kMostGaze, kMostGaze), .pitch = angles.elevation};
}

}  // namespace signweave
