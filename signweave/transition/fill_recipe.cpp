#include <cmath>
#include <limits>

#include "signweave/motion/blend.h"
#include "signweave/transition/fill.h"

namespace signweave {
namespace {

/// Dissimilarity of two poses: squared half angles of all joints plus squared metres.
float distance(PoseView a, PoseView b) noexcept {
  float sum = 0;
  for (std::size_t joint = 0; joint < a.rotations.size(); ++joint) {
    sum += 2 * (1 - std::abs(a.rotations[joint].dot(b.rotations[joint])));
  }
  for (std::size_t i = 0; i < a.translations.size(); ++i) sum += (a.translations[i] - b.translations[i]).squaredNorm();
  return sum;
}

/// Numbers of frames dropped on either side.
struct Cut {
  std::int64_t before = 0;
  std::int64_t after = 0;
};
Cut best_cut(const Gap& gap) noexcept {
  const auto most = static_cast<std::int64_t>(std::floor(kContext.count() * gap.rate.hertz() + 1e-6));
  Cut best;
  float least = std::numeric_limits<float>::infinity();
  for (std::int64_t i = 0; i < gap.before.frames && i <= most; ++i) {
    for (std::int64_t j = 0; j < gap.after.frames && j <= most; ++j) {
      const float one = distance(gap.before.pose(gap.before.frames - 1 - i), gap.after.pose(j));
      if (one < least) {
        least = one;
        best = {i, j};
      }
    }
  }
  return best;
}

/// The mean of three neighbours, which is a Savitzky–Golay filter with a window of 3 and order 1.
template <class Value, class Mean>
void smooth(Value before, Value after, std::int64_t count, std::size_t stride, Value* values, Mean mean) noexcept {
  for (std::int64_t frame = 0; frame < count; ++frame) {
    Value& value = values[static_cast<std::size_t>(frame) * stride];
    const Value here = value;
    value = mean(before, here, frame + 1 < count ? values[static_cast<std::size_t>(frame + 1) * stride] : after);
    before = here;
  }
}

Eigen::Quaternionf mean_turn(const Eigen::Quaternionf& a, const Eigen::Quaternionf& b,
                             const Eigen::Quaternionf& c) noexcept {
  Eigen::Quaternionf sum = b;
  for (const Eigen::Quaternionf* other : {&a, &c}) {
    sum.coeffs() += b.dot(*other) < 0 ? Eigen::Vector4f(-other->coeffs()) : other->coeffs();
  }
  return sum.normalized();
}

}  // namespace

/// What spoken-to-signed-translation does between two clips: they are cut at the pair of frames within 0.3 s of the
/// borders with the most similar poses; the frames between are interpolated linearly (0.2 s there; here the gap plus
/// the frames cut away) and smoothed (Savitzky–Golay, window 3, order 1). Only the gap is written, so the frames that
/// would be cut away on either side stay as captured.
void fill_recipe(const GapJob& job, MutablePoses out) noexcept {
  const Gap& gap = job.gap;
  const Cut cut = best_cut(gap);
  const PoseView from = gap.before.pose(gap.before.frames - 1 - cut.before);
  const PoseView to = gap.after.pose(cut.after);
  const PoseView a = gap.left();
  const PoseView b = gap.right();
  const std::size_t joints = a.rotations.size();
  const std::size_t moved = a.translations.size();
  const auto whole = static_cast<float>(gap.count + 1 + cut.before + cut.after);
  const auto share = [&](std::int64_t frame) { return static_cast<float>(cut.before + frame + 1) / whole; };
  for (std::size_t joint = 0; joint < joints; ++joint) {
    if (!job.groups.has(gap.groups->of[joint])) continue;
    Eigen::Quaternionf* values = &out.rotations[joint];
    for (std::int64_t frame = 0; frame < gap.count; ++frame) {
      values[static_cast<std::size_t>(frame) * joints] =
          slerp(from.rotations[joint], to.rotations[joint], share(frame));
    }
    smooth(a.rotations[joint], b.rotations[joint], gap.count, joints, values, mean_turn);
    Eigen::Quaternionf last = a.rotations[joint];
    for (std::int64_t frame = 0; frame < gap.count; ++frame) {
      Eigen::Quaternionf& value = values[static_cast<std::size_t>(frame) * joints];
      if (value.dot(last) < 0) value.coeffs() *= -1;
      last = value;
    }
  }
  for (std::size_t i = 0; i < moved; ++i) {
    if (!job.groups.has(gap.groups->of_translation[i])) continue;
    Eigen::Vector3f* values = &out.translations[i];
    for (std::int64_t frame = 0; frame < gap.count; ++frame) {
      values[static_cast<std::size_t>(frame) * moved] =
          from.translations[i] + share(frame) * (to.translations[i] - from.translations[i]);
    }
    smooth(a.translations[i], b.translations[i], gap.count, moved, values,
           [](const Eigen::Vector3f& x, const Eigen::Vector3f& y, const Eigen::Vector3f& z) {
             return Eigen::Vector3f((x + y + z) / 3);
           });
  }
}

}  // namespace signweave
