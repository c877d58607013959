// Each side continues its movement and comes to rest within kEase; the two are cross-faded over the whole gap with a
// weight that is flat at both ends. So position and velocity are continuous at both borders, and regardless of the
// gap's length, overshoot is at most half of the movement's distance in kEase. (ours)

#include <algorithm>
#include <cmath>
#include <numbers>

#include "signweave/motion/blend.h"
#include "signweave/transition/fill.h"

namespace signweave {
namespace {

/// Time in which a border's movement comes to rest.
constexpr Seconds kEase{0.15};
/// Time over which a border's velocity is measured: long enough to distinguish it from noise.
constexpr Seconds kVelocityContext{0.1};

/// The rotation per frame at a border, as a rotation vector in the joint's own space, limited to `most` radians.
Eigen::Vector3f velocity(const Eigen::Quaternionf& earlier, const Eigen::Quaternionf& later, std::int64_t span,
                         float most) noexcept {
  Eigen::Quaternionf step = earlier.conjugate() * later;
  if (step.w() < 0) step.coeffs() *= -1.0f;
  const float sine = step.vec().norm();
  if (sine < 1e-7f) return Eigen::Vector3f::Zero();
  const float square = sine * sine;
  // Usually the angle is small; then the series of the arcsine is accurate to 2e-6.
  const float half = sine < 0.3f
                         ? sine * (1.0f + square * (1.0f / 6.0f + square * (3.0f / 40.0f + square * (15.0f / 336.0f))))
                         : std::atan2(sine, step.w());
  const float speed = std::min(most, 2.0f * half / static_cast<float>(span));
  return step.vec() * (speed / sine);
}

/// Distance covered `frames` after moving at speed 1 per frame, with uniform deceleration to rest within `ease` frames.
float coasted(double frames, double ease) noexcept {
  return static_cast<float>(frames >= ease ? ease / 2.0 : frames - frames * frames / (2.0 * ease));
}

/// Rises smoothly from above 0 to below 1.
float weight_of(std::int64_t index, std::int64_t count) noexcept {
  const float t = static_cast<float>(index + 1) / static_cast<float>(count + 1);
  return t * t * (3.0f - 2.0f * t);
}

/// Two poses of one side: at the border, and `span` frames away from it.
struct Edge {
  PoseView border;
  PoseView context;
  std::int64_t span = 0;  ///< 0: no context, the border is treated as still
};

/// The joints to fill, in the order of a pose; if all are filled, no gathering is needed.
class Chosen {
 public:
  explicit Chosen(const GapJob& job) : groups_(job.groups), of_(job.gap.groups->of) {}
  bool has(std::size_t joint) const noexcept { return groups_.has(of_[joint]); }
  bool all() const noexcept { return groups_ == GroupSet::all(); }

 private:
  GroupSet groups_;
  std::span<const JointGroup> of_;
};

void fill_translations(const GapJob& job, const Edge& from, const Edge& to, double ease, MutablePoses out) noexcept {
  const std::size_t moved = from.border.translations.size();
  for (std::size_t i = 0; i < moved; ++i) {
    if (!job.groups.has(job.gap.groups->of_translation[i])) continue;
    const auto per_frame = [](const Eigen::Vector3f& difference, std::int64_t span) -> Eigen::Vector3f {
      return span > 0 ? Eigen::Vector3f(difference / static_cast<float>(span)) : Eigen::Vector3f::Zero();
    };
    const Eigen::Vector3f& left = from.border.translations[i];
    const Eigen::Vector3f& right = to.border.translations[i];
    const Eigen::Vector3f before = per_frame(left - from.context.translations[i], from.span);
    const Eigen::Vector3f after = per_frame(to.context.translations[i] - right, to.span);
    for (std::int64_t index = 0; index < job.gap.count; ++index) {
      const Eigen::Vector3f a = left + coasted(static_cast<double>(index + 1), ease) * before;
      const Eigen::Vector3f b = right - coasted(static_cast<double>(job.gap.count - index), ease) * after;
      out.translations[static_cast<std::size_t>(index) * moved + i] = a + weight_of(index, job.gap.count) * (b - a);
    }
  }
}

}  // namespace

void fill_coast(const GapJob& job, MutablePoses out) noexcept {
  const Gap& gap = job.gap;
  const double hertz = gap.rate.hertz();
  const std::int64_t context = std::max<std::int64_t>(1, std::llround(kVelocityContext.count() * hertz));
  const std::int64_t before = std::min(context, gap.before.frames - 1);
  const std::int64_t after = std::min(context, gap.after.frames - 1);
  const Edge from{gap.left(), gap.before.pose(gap.before.frames - 1 - before), before};
  const Edge to{gap.right(), gap.after.pose(after), after};
  const double ease = std::max(1.0, std::min(kEase.count() * hertz, static_cast<double>(gap.count + 1)));
  // No human joint turns more than half a turn before it rests.
  const float most = std::numbers::pi_v<float> / (static_cast<float>(ease) / 2.0f);

  const Chosen chosen(job);
  const std::size_t joints = from.border.rotations.size();
  std::vector<Eigen::Quaternionf>& rotations = job.scratch.turns;  // of the left border, then of the right one
  std::vector<Eigen::Vector3f>& turns = job.scratch.coefficients;
  rotations.resize(3 * joints);
  turns.resize(2 * joints);
  std::size_t count = 0;
  for (std::size_t i = 0; i < joints; ++i) {
    if (!chosen.has(i)) continue;
    const Eigen::Quaternionf& left = from.border.rotations[i];
    Eigen::Quaternionf right = to.border.rotations[i];
    // Chosen at the borders, so that the sign is the same for every frame.
    if (left.dot(right) < 0) right.coeffs() *= -1.0f;
    rotations[count] = left;
    rotations[joints + count] = right;
    turns[count] = before > 0 ? velocity(from.context.rotations[i], left, before, most) : Eigen::Vector3f::Zero();
    turns[joints + count] =
        after > 0 ? velocity(to.border.rotations[i], to.context.rotations[i], after, most) : Eigen::Vector3f::Zero();
    ++count;
  }
  auto& [a, b, a_rest, b_rest] = job.scratch.coasting;
  a.assign(std::span(rotations).first(count), std::span(turns).first(count));
  b.assign(std::span(rotations).subspan(joints, count), std::span(turns).subspan(joints, count));
  a_rest = a;
  b_rest = b;
  const float whole = coasted(ease, ease);
  a_rest.coast(whole);
  b_rest.coast(-whole);

  const std::span<Eigen::Quaternionf> gathered = std::span(rotations).subspan(2 * joints, count);
  for (std::int64_t index = 0; index < gap.count; ++index) {
    const auto since = static_cast<double>(index + 1);  // frames from the left border
    const auto until = static_cast<double>(gap.count - index);
    const std::span<Eigen::Quaternionf> pose = out.rotations.subspan(static_cast<std::size_t>(index) * joints, joints);
    slerp_coasting(since >= ease ? a_rest : a, since >= ease ? 0.0f : coasted(since, ease), until >= ease ? b_rest : b,
                   until >= ease ? 0.0f : -coasted(until, ease), weight_of(index, gap.count),
                   chosen.all() ? pose : gathered);
    if (chosen.all()) continue;
    for (std::size_t i = 0, k = 0; i < joints; ++i) {
      if (chosen.has(i)) pose[i] = gathered[k++];
    }
  }
  fill_translations(job, from, to, ease, out);
}

}  // namespace signweave
