#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include "signweave/inflection/learned_stroke.h"
#include "signweave/inflection/slots.h"
#include "signweave/inflection/turns.h"

namespace signweave {
namespace {

using inflection::slot;
using inflection::vector_of;
using inflection::wrapped;

using Eigen::Vector3f;

/// The palms of hands that keep to each other differ in distance by less than this. Metres. (ours)
constexpr float kRigid = 0.04f;

using Path = std::vector<PathPoint>;  ///< [phase point]

/// What takes one hand from its own points to others, without swivel.
Path path_of(const std::array<PhasePoint, kPhasePoints>& own, const std::array<PhasePoint, kPhasePoints>& wanted,
             float unit) {
  Path path(kPhasePoints);
  for (std::size_t k = 0; k < kPhasePoints; ++k) {
    path[k] = {.shift = unit * (wanted[k].palm - own[k].palm),
               .turn = vector_of(wanted[k].turn * own[k].turn.conjugate())};
  }
  // A rotation vector and the one of the full turn less are one rotation: neighbours must be near each other.
  for (std::size_t k = 1; k < kPhasePoints; ++k) {
    const float angle = path[k].turn.norm();
    if (angle < 1e-6f) continue;
    const Vector3f other = (1 - 2 * std::numbers::pi_v<float> / angle) * path[k].turn;
    if ((other - path[k - 1].turn).norm() < (path[k].turn - path[k - 1].turn).norm()) path[k].turn = other;
  }
  return path;
}

/// The hands touch, and keep to each other.
bool are_rigid(const CapturedStroke& stroke, const PhasePoints& own, float unit) {
  if (!stroke.touch) return false;
  float least = std::numeric_limits<float>::max();
  float most = 0;
  for (std::size_t k = 0; k < kPhasePoints; ++k) {
    const float apart = unit * (own.hands[0][k].palm - own.hands[1][k].palm).norm();
    least = std::min(least, apart);
    most = std::max(most, apart);
  }
  return most - least < kRigid;
}

StrokeChange change_along(bool together, const std::array<Path, 2>& paths, float share, float relief,
                          const Vector3f& pushed) {
  StrokeChange change{.arms = {}, .together = together};
  for (const Side side : kSides) {
    if (paths[slot(side)].empty()) continue;
    ArmChange arm{.path = paths[slot(side)]};
    for (PathPoint& point : arm.path) {
      point.shift = share * point.shift + pushed;
      point.turn *= share * (1 - relief);
      point.swivel *= share;
    }
    change.arms[slot(side)] = std::move(arm);
  }
  return change;
}

/// Both hands go by the mean of their paths.
void join(std::array<Path, 2>& paths) {
  for (std::size_t k = 0; k < kPhasePoints; ++k) {
    PathPoint& left = paths[0][k];
    PathPoint& right = paths[1][k];
    left.shift = right.shift = (left.shift + right.shift) / 2;
    left.turn = right.turn = (left.turn + right.turn) / 2;
  }
}

/// Sets the swivel that is missing once the hands are where they go.
void add_swivels(StrokeChanger& changer, const CapturedStroke& stroke, const PhasePoints& wanted, bool together,
                 std::array<Path, 2>& paths) {
  const StrokeChange change = change_along(together, paths, 1, 0, Vector3f::Zero());
  std::array<PathSpline, 2> splines;
  for (std::size_t side = 0; side < 2; ++side) splines[side] = PathSpline(paths[side]);
  std::array<std::vector<float>, 2> missing;  // [Side][sample]
  for (const CapturedStroke::Sample& sample : stroke.samples) {
    Pose pose = sample.pose;
    changer.apply(change, splines, stroke.space, 1, sample.time, pose.view());
    const float place = sample.time * static_cast<float>(kPhasePoints - 1);
    const auto k = std::min(static_cast<std::size_t>(place), kPhasePoints - 2);
    const float share = place - static_cast<float>(k);
    for (const Side side : kSides) {
      if (paths[slot(side)].empty()) continue;
      const float a = wanted.hands[slot(side)][k].swivel;
      const float b = wanted.hands[slot(side)][k + 1].swivel;
      const float goal = a + share * wrapped(b - a);
      const float made = swivel_of(changer.look(std::as_const(pose).view(), stroke.space, side));
      float more = wrapped(goal - made);
      if (!missing[slot(side)].empty()) {
        more = missing[slot(side)].back() + wrapped(more - missing[slot(side)].back());
      }
      missing[slot(side)].push_back(more);
    }
  }
  const std::size_t samples = stroke.samples.size();
  for (std::size_t side = 0; side < 2; ++side) {
    for (std::size_t k = 0; k < paths[side].size(); ++k) {
      const float time = static_cast<float>(k) / static_cast<float>(kPhasePoints - 1);
      std::size_t next = 0;
      while (next + 1 < samples && stroke.samples[next].time < time) ++next;
      const std::size_t before = next > 0 ? next - 1 : 0;
      const float step = stroke.samples[next].time - stroke.samples[before].time;
      const float share = step > 0 ? (time - stroke.samples[before].time) / step : 0;
      paths[side][k].swivel = missing[side][before] + share * (missing[side][next] - missing[side][before]);
    }
  }
}

}  // namespace

FittedChange change_to(StrokeChanger& changer, const CapturedStroke& stroke, const PhasePoints& own,
                       const PhasePoints& wanted) {
  std::array<Path, 2> paths;
  Vector3f before = Vector3f::Zero();
  Vector3f after = Vector3f::Zero();
  for (const Side side : kSides) {
    if (!wanted.used[slot(side)] || !changer.has(side)) continue;
    paths[slot(side)] = path_of(own.hands[slot(side)], wanted.hands[slot(side)], changer.body().shoulder_width);
    for (std::size_t k = 0; k < kPhasePoints; ++k) {
      before += own.hands[slot(side)][k].palm;
      after += wanted.hands[slot(side)][k].palm;
    }
  }
  const bool together = !paths[0].empty() && !paths[1].empty() && are_rigid(stroke, own, changer.body().shoulder_width);
  if (together) join(paths);
  add_swivels(changer, stroke, wanted, together, paths);
  const auto make = [&](float share, float relief, const Vector3f& pushed) {
    return change_along(together, paths, share, relief, pushed);
  };
  const float sideways = std::atan2(after.x(), after.z()) - std::atan2(before.x(), before.z());
  return fit_change(changer, stroke, make, wrapped(sideways));
}

}  // namespace signweave
