#include "signweave/transition/curves.h"

#include <algorithm>
#include <cmath>

#include "signweave/motion/blend.h"
#include "signweave/transition/curve_loops.h"

namespace signweave {
namespace {

/// Derivatives at [0] of the least-squares quadratic through [0, most] of a path with samples `step` seconds apart.
/// Sums of powers are in closed form, so only a 3 × 3 system is solved.
BorderMotion quadratic(std::span<const Eigen::Vector3f> path, double step) noexcept {
  BorderMotion motion;
  const auto wanted = static_cast<std::size_t>(std::llround(kVelocityWindow / std::abs(step)));
  const std::size_t last = std::min(path.size() - 1, std::max<std::size_t>(2, wanted));
  if (last == 0) return motion;
  if (last == 1) {
    motion.velocity = (path[1] - path[0]) / static_cast<float>(step);
    return motion;
  }
  double powers[5] = {};
  Eigen::Vector3d moments[3] = {Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero()};
  for (std::size_t i = 0; i <= last; ++i) {
    const auto t = static_cast<double>(i);
    double power = 1;
    for (int k = 0; k < 5; ++k) {
      powers[k] += power;
      if (k < 3) moments[k] += power * (path[i] - path[0]).cast<double>();
      power *= t;
    }
  }
  Eigen::Matrix3d normal;
  for (int r = 0; r < 3; ++r) {
    for (int c = 0; c < 3; ++c) normal(r, c) = powers[r + c];
  }
  Eigen::Matrix3d right;
  for (int r = 0; r < 3; ++r) right.row(r) = moments[r].transpose();
  const Eigen::Matrix3d fit = normal.inverse() * right;
  motion.velocity = (fit.row(1).transpose() / step).cast<float>();
  motion.acceleration = (2.0 * fit.row(2).transpose() / (step * step)).cast<float>();
  return motion;
}

}  // namespace

BorderMotion motion_before(std::span<const Eigen::Vector3f> path, double hertz) noexcept {
  return quadratic(path, -1.0 / hertz);
}
BorderMotion motion_after(std::span<const Eigen::Vector3f> path, double hertz) noexcept {
  return quadratic(path, 1.0 / hertz);
}

BorderVelocity::BorderVelocity(std::size_t samples, double hertz) noexcept {
  const auto wanted = static_cast<std::size_t>(std::llround(kVelocityWindow * hertz));
  last_ = std::min({samples - 1, std::max<std::size_t>(2, wanted), kMost});
  if (last_ == 0) return;
  if (last_ == 1) {
    weights_[1] = static_cast<float>(hertz);
    return;
  }
  double powers[5] = {};
  for (std::size_t i = 0; i <= last_; ++i) {
    double power = 1;
    for (double& sum : powers) {
      sum += power;
      power *= static_cast<double>(i);
    }
  }
  Eigen::Matrix3d normal;
  for (int r = 0; r < 3; ++r) {
    for (int c = 0; c < 3; ++c) normal(r, c) = powers[r + c];
  }
  const Eigen::Matrix3d inverse = normal.inverse();
  for (std::size_t i = 1; i <= last_; ++i) {
    const auto t = static_cast<double>(i);
    weights_[i] = static_cast<float>(hertz * (inverse(1, 0) + inverse(1, 1) * t + inverse(1, 2) * t * t));
  }
}

GapTime::GapTime(const Gap& gap) noexcept
    : count_(static_cast<double>(gap.count + 1)),
      seconds_(gap.duration().count()),
      curve_seconds_(std::min(seconds_, kLongestCurve)) {
  if (gap.pause <= Seconds(0)) return;
  pauses_ = true;
  curve_seconds_ = std::min(curve_seconds_, std::max(seconds_ - gap.pause.count(), gap.rate.frame_time().count()));
}

GapTime GapTime::even(const Gap& gap) noexcept {
  GapTime time(gap);
  if (!time.pauses_) time.curve_seconds_ = time.seconds_;
  return time;
}

double GapTime::at(std::int64_t frame) const noexcept {
  const double t = static_cast<double>(frame + 1) / count_;
  if (!(curve_seconds_ < seconds_)) return t;
  if (pauses_) {
    // The speed falls from 1 to 0, stays 0, and rises again, with the same easing as below.
    const double ease = std::min({kPauseEase, curve_seconds_, seconds_ - curve_seconds_});
    const double rest = seconds_ - curve_seconds_ - ease;
    const double since = t * seconds_;
    const auto eased = [&](double x) { return ease * (x - x * x * x + 0.5 * x * x * x * x); };
    if (since <= ease) return eased(since / ease) / curve_seconds_;
    if (since <= ease + rest) return 0.5 * ease / curve_seconds_;
    const double until = 2 * ease + rest;
    if (since < until) return (ease - eased((until - since) / ease)) / curve_seconds_;
    return (ease + since - until) / curve_seconds_;
  }
  if (t > 0.5) return 1 - at(static_cast<std::int64_t>(count_) - 2 - frame);
  // The speed falls from 1 to `slow` within `ease`, as 1 − 3x² + 2x³.
  const double ease = curve_seconds_ / 2;
  const double slow = ease / (seconds_ - ease);
  const double since = t * seconds_;
  const double x = std::min(1.0, since / ease);
  const double gone = ease * (x - x * x * x + 0.5 * x * x * x * x);
  return (slow * since + (1 - slow) * gone) / curve_seconds_;
}

Eigen::Vector3f rotation_vector(const Eigen::Quaternionf& q) noexcept {
  const float sine = q.vec().norm();
  if (sine < 1e-7f) return 2.0f * q.vec() * (q.w() < 0 ? -1.0f : 1.0f);
  return q.vec() * (2.0f * std::atan2(sine, q.w()) / sine);
}

Eigen::Quaternionf rotation_of(const Eigen::Vector3f& vector) noexcept {
  const float square = 0.25f * vector.squaredNorm();  // of the half angle
  const float half = std::sqrt(square);
  // For small angles sin(x) / x is replaced by its series.
  const float factor = half > 1e-4f || !(half >= 0) ? std::sin(half) / half : 1 - square / 6;
  const Eigen::Vector3f axis = vector * (0.5f * factor);
  return {std::cos(half), axis.x(), axis.y(), axis.z()};
}

Eigen::Quaternionf middle_of(const Eigen::Quaternionf& left, const Eigen::Quaternionf& right) noexcept {
  const float sign = left.dot(right) < 0 ? -1.0f : 1.0f;
  Eigen::Quaternionf middle;
  middle.coeffs() = left.coeffs() + sign * right.coeffs();
  const float length = middle.norm();
  if (length < 1e-6f) return left;
  middle.coeffs() /= length;
  return middle;
}

std::int64_t context_frames(const PosesView& side, FrameRate rate) noexcept {
  return std::min(side.frames, std::max<std::int64_t>(4, std::llround(kSeen * rate.hertz()) + 1));
}

Eigen::Quaternionf see_joint(const Gap& gap, std::size_t joint, GapScratch& scratch) {
  const Eigen::Quaternionf left = gap.left().rotations[joint];
  const Eigen::Quaternionf right = gap.right().rotations[joint];
  Eigen::Quaternionf middle = middle_of(left, right);
  const Eigen::Quaternionf back = middle.conjugate();
  // Consecutive frames are in one hemisphere, so one sign per side lets a trajectory exceed half a turn from the
  // middle.
  const auto see = [&](const PosesView& side, std::int64_t border, int step, std::vector<Eigen::Vector3f>& path) {
    const std::int64_t count = context_frames(side, gap.rate);
    const std::size_t joints = side.joints();
    path.resize(static_cast<std::size_t>(count));
    Eigen::Quaternionf last = middle;
    for (std::int64_t k = 0; k < count; ++k) {
      Eigen::Quaternionf q = side.rotations[static_cast<std::size_t>(border + k * step) * joints + joint];
      if (last.dot(q) < 0) q.coeffs() *= -1.0f;
      path[static_cast<std::size_t>(k)] = rotation_vector(back * q);
      last = q;
    }
  };
  see(gap.before, gap.before.frames - 1, -1, scratch.before);
  see(gap.after, 0, 1, scratch.after);
  return middle;
}

Eigen::Vector3f see_translation(const Gap& gap, std::size_t translation, GapScratch& scratch) {
  Eigen::Vector3f middle = 0.5f * (gap.left().translations[translation] + gap.right().translations[translation]);
  const auto see = [&](const PosesView& side, std::int64_t border, int step, std::vector<Eigen::Vector3f>& path) {
    const std::int64_t count = context_frames(side, gap.rate);
    const std::size_t moved = side.moved();
    path.resize(static_cast<std::size_t>(count));
    for (std::int64_t k = 0; k < count; ++k) {
      path[static_cast<std::size_t>(k)] =
          side.translations[static_cast<std::size_t>(border + k * step) * moved + translation] - middle;
    }
  };
  see(gap.before, gap.before.frames - 1, -1, scratch.before);
  see(gap.after, 0, 1, scratch.after);
  return middle;
}

namespace {

void see_side(const Gap& gap, const PosesView& side, std::int64_t border, int step, GapScratch& scratch,
              std::vector<float>& seen) {
  const std::size_t taken = scratch.taken.size();
  const std::size_t turned = scratch.turned;
  const auto count = static_cast<std::size_t>(context_frames(side, gap.rate));
  seen.resize(count * 3 * taken);
  scratch.last = scratch.middles;
  for (std::size_t k = 0; k < count; ++k) {
    const auto frame = static_cast<std::size_t>(border + static_cast<std::int64_t>(k) * step);
    float* const out = seen.data() + k * 3 * taken;
    curve_loops::follow(side.rotations.data() + frame * side.joints(), scratch.taken.data(), turned,
                        scratch.last.data());
    curve_loops::see_rotations(scratch.last.data(), scratch.middles.data(), turned, taken, out);
    for (std::size_t i = turned; i < taken; ++i) {
      const std::size_t at = scratch.taken[i];
      const Eigen::Vector3f middle = 0.5f * (gap.left().translations[at] + gap.right().translations[at]);
      const Eigen::Vector3f off = side.translations[frame * side.moved() + at] - middle;
      for (Eigen::Index axis = 0; axis < 3; ++axis) out[static_cast<std::size_t>(axis) * taken + i] = off[axis];
    }
  }
}

}  // namespace

void see_all(const GapJob& job) {
  const Gap& gap = job.gap;
  GapScratch& scratch = job.scratch;
  scratch.taken.clear();
  for (std::size_t joint = 0; joint < gap.before.joints(); ++joint) {
    if (job.groups.has(gap.groups->of[joint])) scratch.taken.push_back(joint);
  }
  scratch.joints = scratch.taken.size();
  while (scratch.taken.size() % curve_loops::kLanes != 0) scratch.taken.push_back(scratch.taken.back());
  scratch.turned = scratch.taken.size();
  for (std::size_t i = 0; i < gap.before.moved(); ++i) {
    if (job.groups.has(gap.groups->of_translation[i])) scratch.taken.push_back(i);
  }
  scratch.middles.resize(4 * scratch.turned);
  for (std::size_t i = 0; i < scratch.turned; ++i) {
    const Eigen::Quaternionf middle =
        middle_of(gap.left().rotations[scratch.taken[i]], gap.right().rotations[scratch.taken[i]]);
    for (Eigen::Index axis = 0; axis < 4; ++axis) {
      scratch.middles[static_cast<std::size_t>(axis) * scratch.turned + i] = middle.coeffs()[axis];
    }
  }
  // Consecutive frames are in one hemisphere, so one sign per side lets a trajectory exceed half a turn from the
  // middle.
  see_side(gap, gap.before, gap.before.frames - 1, -1, scratch, scratch.seen[0]);
  see_side(gap, gap.after, 0, 1, scratch, scratch.seen[1]);
}

Sides sides_of(const GapJob& job, std::size_t taken, double seconds) {
  GapScratch& scratch = job.scratch;
  const std::size_t width = scratch.taken.size();
  const auto copy = [&](const std::vector<float>& seen, std::vector<Eigen::Vector3f>& out) {
    out.resize(seen.size() / (3 * width));
    const float* at = seen.data() + taken;
    for (Eigen::Vector3f& vector : out) {
      vector = {at[0], at[width], at[2 * width]};
      at += 3 * width;
    }
  };
  copy(scratch.seen[0], scratch.before);
  copy(scratch.seen[1], scratch.after);
  const std::size_t at = scratch.taken[taken];
  const bool rotation = taken < scratch.turned;
  return {.before = scratch.before,
          .after = scratch.after,
          .hertz = job.gap.rate.hertz(),
          .seconds = seconds,
          .role = rotation ? job.gap.groups->roles[at] : JointRole::other,
          .group = rotation ? job.gap.groups->of[at] : job.gap.groups->of_translation[at],
          .joint = at,
          .rotation = rotation};
}

void set_reaches(const GapJob& job) {
  GapScratch& scratch = job.scratch;
  auto& [seen, margins] = scratch.reaches;
  seen.assign(scratch.turned, 0.0f);
  margins.resize(scratch.turned);
  for (const std::vector<float>& side : scratch.seen) {
    curve_loops::see_farthest(side, scratch.turned, scratch.taken.size(), seen.data());
  }
  for (std::size_t i = 0; i < scratch.turned; ++i) {
    seen[i] = std::sqrt(seen[i]);
    const JointRole role = job.gap.groups->roles[scratch.taken[i]];
    // Radians: about 10° for fingers, 45° for a shoulder, 25° for all others, such as elbow and wrist.
    margins[i] = role == JointRole::finger ? 0.17f : role == JointRole::shoulder ? 0.8f : 0.45f;
  }
}

void fill_blocks(const GapScratch& scratch, std::span<float> rows) noexcept {
  for (float* row = rows.data(); row != rows.data() + rows.size(); row += scratch.taken.size()) {
    for (std::size_t i = scratch.joints; i < scratch.turned; ++i) row[i] = row[scratch.joints - 1];
  }
}

void make_frame(const GapJob& job, std::int64_t frame, MutablePoses out) noexcept {
  const Gap& gap = job.gap;
  GapScratch& scratch = job.scratch;
  const std::size_t taken = scratch.taken.size();
  const std::size_t turned = scratch.turned;
  const std::size_t moved = taken - turned;
  scratch.made.resize(4 * turned + moved);
  float* const turns = scratch.made.data();
  curve_loops::make_turns(scratch.row,
                          {.vectors = scratch.vectors.data(),
                           .reaches = scratch.reaches,
                           .middles = scratch.middles.data(),
                           .count = turned,
                           .width = taken},
                          turns);
  Eigen::Quaternionf* const rotations = out.rotations.data() + static_cast<std::size_t>(frame) * gap.before.joints();
  for (std::size_t i = 0; i < scratch.joints; ++i) {
    rotations[scratch.taken[i]].coeffs() = {turns[i], turns[turned + i], turns[2 * turned + i], turns[3 * turned + i]};
  }
  if (moved == 0) return;
  Eigen::Vector3f* const translations = out.translations.data() + static_cast<std::size_t>(frame) * gap.before.moved();
  float* const shifts = turns + 4 * turned;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    curve_loops::add_up(scratch.row, scratch.vectors.data() + axis * taken + turned, 3 * taken, moved, shifts);
    const auto on = static_cast<Eigen::Index>(axis);
    for (std::size_t i = 0; i < moved; ++i) {
      const std::size_t at = scratch.taken[turned + i];
      translations[at][on] = 0.5f * (gap.left().translations[at][on] + gap.right().translations[at][on]) + shifts[i];
    }
  }
}

}  // namespace signweave
