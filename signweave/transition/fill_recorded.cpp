#include <algorithm>
#include <cmath>

#include "signweave/transition/fill.h"
#include "signweave/transition/kriging.h"
#include "signweave/transition/learned.h"

namespace signweave {
namespace {

constexpr std::size_t kNeighbours = 12;
/// A captured span is stretched or compressed in time by at most this factor.
constexpr float kMostTimeScale = 1.5f;

/// Weight of a joint in comparisons, by its influence on the hands' positions.
float weight_of(JointRole role) noexcept {
  switch (role) {
    case JointRole::trunk:
    case JointRole::shoulder:
    case JointRole::elbow:
    case JointRole::other_arm:
      return 1.0f;
    case JointRole::finger:
      return 0.1f;
    case JointRole::other:
      return 0.0f;
  }
  return 0.0f;
}

/// The captured spans most similar to a gap, with their weights.
struct Matches {
  struct Match {
    const CapturedSpan* span = nullptr;
    float weight = 0;
  };
  std::array<Match, kNeighbours> spans;
  std::size_t count = 0;
};

Matches matches_of(const GapJob& job) {
  Matches matches;
  const Gap& gap = job.gap;
  const std::size_t joints = gap.before.joints();
  const SpanLibrary* library = nullptr;
  for (const auto& one : job.model.libraries) {
    if (is_of(*one, *gap.skeleton)) library = one.get();
  }
  if (library == nullptr) return matches;
  GapScratch& scratch = job.scratch;
  describe_span(gap, scratch, scratch.traits);
  const auto seconds = static_cast<float>(gap.duration().count());
  scratch.nearest.clear();
  float size = 0;
  const auto each_joint = [&](auto&& use) {
    for (std::size_t joint = 0; joint < joints; ++joint) {
      const float weight = weight_of(gap.groups->roles[joint]);
      if (weight > 0 && job.groups.has(gap.groups->of[joint])) use(joint * CapturedSpan::kTraitsOfJoint, weight);
    }
  };
  each_joint([&](std::size_t at, float weight) {
    for (std::size_t i = at; i < at + CapturedSpan::kTraitsOfJoint; ++i) {
      size += weight * scratch.traits[i] * scratch.traits[i];
    }
  });
  for (std::size_t index = 0; index < library->spans.size(); ++index) {
    const CapturedSpan& span = library->spans[index];
    if (span.recording == job.model.purged || span.seconds > kMostTimeScale * seconds ||
        seconds > kMostTimeScale * span.seconds) {
      continue;
    }
    float square = 0;
    each_joint([&](std::size_t at, float weight) {
      for (std::size_t i = at; i < at + CapturedSpan::kTraitsOfJoint; ++i) {
        const float off = scratch.traits[i] - span.traits[i];
        square += weight * off * off;
      }
    });
    if (std::isfinite(square)) scratch.nearest.emplace_back(square, index);
  }
  matches.count = std::min(kNeighbours, scratch.nearest.size());
  std::partial_sort(scratch.nearest.begin(), scratch.nearest.begin() + static_cast<std::ptrdiff_t>(matches.count),
                    scratch.nearest.end());
  float sum = 0;
  for (std::size_t i = 0; i < matches.count; ++i) {
    const float relative = std::sqrt(scratch.nearest[i].first / std::max(size, 1e-6f));
    matches.spans[i] = {&library->spans[scratch.nearest[i].second], 1.0f / (relative + 0.05f)};
    sum += matches.spans[i].weight;
  }
  // Dissimilar spans bend the trajectory less: if even the nearest differs by as much as the gap's size, by half.
  // (ours)
  const float nearest = matches.count > 0 ? std::sqrt(scratch.nearest[0].first / std::max(size, 1e-6f)) : 0.0f;
  const float trust = 1.0f / (1.0f + nearest * nearest);
  for (std::size_t i = 0; i < matches.count; ++i) matches.spans[i].weight *= trust / sum;
  return matches;
}

/// The kriged trajectory plus the deviations of the captured spans with the most similar borders from their own kriged
/// trajectories. So each span is warped to the borders, including its velocities.
template <class Kriged>
struct Recorded {
  static constexpr bool kBeyondSides = true;
  Kriged kriging;
  const Matches& matches;
  std::span<const float> traits;  ///< of the gap
  std::int64_t count;             ///< frames of the gap

  std::size_t terms() const noexcept { return kriging.terms() + CapturedSpan::kPoints; }
  void row(double t, std::int64_t frame, float* out) const noexcept {
    kriging.row(t, frame, out);
    // A Catmull–Rom cubic between each two points, zero with zero slope at the borders, so velocities are continuous.
    constexpr std::size_t kSteps = CapturedSpan::kPoints + 1;
    const double at = static_cast<double>(frame + 1) * kSteps / static_cast<double>(count + 1);
    const std::size_t node = std::min(static_cast<std::size_t>(at), kSteps - 1);  // 0 and kSteps are the borders
    const double x = at - static_cast<double>(node);
    const double rising = x * x * (3 - 2 * x);
    const double leaving = 0.5 * x * (1 - x) * (1 - x);  // half the slope at this node
    const double arriving = 0.5 * x * x * (x - 1);       // and at the next
    float* points = out + kriging.terms();
    std::fill(points, points + CapturedSpan::kPoints, 0.0f);
    const auto add = [&](std::size_t which, double weight) {
      if (which >= 1 && which < kSteps) points[which - 1] += static_cast<float>(weight);
    };
    add(node, 1 - rising);
    add(node + 1, rising);
    if (node > 0) {
      add(node + 1, leaving);
      add(node - 1, -leaving);
    }
    if (node + 1 < kSteps) {
      add(node + 2, arriving);
      add(node, -arriving);
    }
  }
  void coefficients(const Sides& sides, Eigen::Vector3f* out) const noexcept {
    kriging.coefficients(sides, out);
    Eigen::Vector3f* strays = out + kriging.terms();
    std::fill(strays, strays + CapturedSpan::kPoints, Eigen::Vector3f::Zero());
    if (!sides.rotation) return;
    for (std::size_t i = 0; i < matches.count; ++i) {
      const Matches::Match& match = matches.spans[i];
      const float weight = match.weight * share_of(match.span->traits, sides.joint);
      for (std::size_t point = 0; point < CapturedSpan::kPoints; ++point) {
        strays[point] += weight * match.span->strays[sides.joint * CapturedSpan::kPoints + point];
      }
    }
  }
  /// The share of a captured joint's deviations that this joint takes: the ratio of its features to the captured ones,
  /// at most 1. So a resting joint of a moving body stays at rest. (ours)
  float share_of(std::span<const float> captured, std::size_t joint) const noexcept {
    const auto size = [joint](std::span<const float> all) {
      float square = 0;
      for (const float one : all.subspan(joint * CapturedSpan::kTraitsOfJoint, CapturedSpan::kTraitsOfJoint)) {
        square += one * one;
      }
      return std::sqrt(square);
    };
    const float here = size(traits);
    const float there = size(captured);
    return here < there ? here / there : 1.0f;
  }
};

}  // namespace

void fill_recorded(const GapJob& job, MutablePoses out) noexcept {
  const Matches matches = matches_of(job);
  const GapTime time(job.gap);
  const auto bent = [&](auto kriged) {
    return Recorded<decltype(kriged)>{std::move(kriged), matches, job.scratch.traits, job.gap.count};
  };
  fill_by_part(
      job, [&](const GapJob& fingers) { fill_curves(fingers, out, bent(FingerCurves(job.gap)), time); },
      [&](const GapJob& others) { fill_curves(others, out, bent(Kriging(job.gap, time, job.scratch.numbers)), time); });
}

}  // namespace signweave
