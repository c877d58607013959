#include "signweave/motion/blend.h"

#include <algorithm>
#include <cmath>

namespace signweave {

Eigen::Quaternionf slerp_as_signed(const Eigen::Quaternionf& a, const Eigen::Quaternionf& b, float t) noexcept {
  if (t <= 0.0f) return a;
  if (t >= 1.0f) return b;
  const float cosine = std::clamp(a.dot(b), -1.0f, 1.0f);
  float from = 1.0f - t;
  float to = t;
  if (cosine < -0.9995f) {  // a whole turn apart: all arcs are equally long, so none is taken
    to = -to;
  } else if (cosine < 0.9995f) {  // any closer, the arc is a straight line within float precision
    const float angle = std::acos(cosine);
    const float inverse = 1.0f / std::sin(angle);
    from = std::sin(from * angle) * inverse;
    to = std::sin(to * angle) * inverse;
  }
  Eigen::Quaternionf result(from * a.coeffs() + to * b.coeffs());
  result.normalize();
  return result;
}

Eigen::Quaternionf slerp(const Eigen::Quaternionf& a, const Eigen::Quaternionf& b, float t) noexcept {
  return slerp_as_signed(a, a.dot(b) < 0 ? Eigen::Quaternionf(-b.coeffs()) : b, t);
}

void blend(PoseView a, PoseView b, float t, MutablePoseView out) noexcept {
  if (t <= 0.0f || t >= 1.0f) {  // the ends are exact
    for (std::size_t i = 0; i < out.rotations.size(); ++i) out.rotations[i] = slerp(a.rotations[i], b.rotations[i], t);
  } else {
    slerp(a.rotations, b.rotations, t, out.rotations);
  }
  for (std::size_t i = 0; i < out.translations.size(); ++i) {
    out.translations[i] = a.translations[i] + t * (b.translations[i] - a.translations[i]);
  }
}

void sample(const Motion& motion, double frame, MutablePoseView out) noexcept {
  const double last = static_cast<double>(motion.frame_count() - 1);
  const double at = std::clamp(frame, 0.0, last);
  const double whole = std::floor(at);
  const PoseView before = motion.pose(static_cast<std::int64_t>(whole));
  if (at == whole) {
    std::copy(before.rotations.begin(), before.rotations.end(), out.rotations.begin());
    std::copy(before.translations.begin(), before.translations.end(), out.translations.begin());
    return;
  }
  blend(before, motion.pose(static_cast<std::int64_t>(whole) + 1), static_cast<float>(at - whole), out);
}

Standing standing_over(const Motion& motion, FrameRange frames) noexcept {
  Eigen::Vector3d position = Eigen::Vector3d::Zero();
  double sine = 0;
  double cosine = 0;
  const bool root_moves = motion.skeleton().joint(0).translated;
  for (std::int64_t frame = frames.begin; frame < frames.end; ++frame) {
    const PoseView pose = motion.pose(frame);
    if (root_moves) position += pose.translations[0].cast<double>();
    // The twist of the root's rotation about the vertical is twice the angle whose tangent is y / w.
    const double y = static_cast<double>(pose.rotations[0].y());
    const double w = static_cast<double>(pose.rotations[0].w());
    const double square = y * y + w * w;
    if (square < 1e-12) continue;  // upside down: no heading
    const double inverse = 1.0 / square;
    sine += 2.0 * y * w * inverse;
    cosine += (w * w - y * y) * inverse;
  }
  Standing standing;
  if (!frames.empty()) {
    standing.position = (position / static_cast<double>(frames.size())).cast<float>();
    standing.position.y() = 0;
    standing.heading = static_cast<float>(std::atan2(sine, cosine));
  }
  return standing;
}

GroundTransform align(const Standing& from, const Standing& to) noexcept {
  GroundTransform transform;
  transform.turn = Eigen::AngleAxisf(to.heading - from.heading, Eigen::Vector3f::UnitY());
  transform.shift = to.position - transform.turn * from.position;
  transform.shift.y() = 0;
  return transform;
}

void apply(const GroundTransform& transform, const Skeleton& skeleton, MutablePoseView pose) noexcept {
  pose.rotations[0] = transform.turn * pose.rotations[0];
  if (skeleton.joint(0).translated) pose.translations[0] = transform.turn * pose.translations[0] + transform.shift;
}

}  // namespace signweave
