#pragma once

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cstddef>
#include <span>
#include <type_traits>

#include "signweave/transition/method.h"
#include "signweave/transition/quieten.h"

/// How methods describe joint trajectories. Internal to this module.
///
/// A joint's rotations on both sides of a gap are expressed as rotation vectors from the rotation midway between the
/// two borders (radians), a translation as metres from the midpoint. In these coordinates every method is a sum of
/// functions of time, shared by all joints, each multiplied by a vector of the joint. Rotating the axes rotates the
/// vectors, so a method whose vectors are linear in its samples works on every rig.
namespace signweave {

/// Trajectory of one joint (or translation) on both sides: [k] is k frames from the border, which is [0].
struct Sides {
  std::span<const Eigen::Vector3f> before;
  std::span<const Eigen::Vector3f> after;
  double hertz = 30;
  double seconds = 0;  ///< length of the curve from border to border, see GapTime
  JointRole role = JointRole::other;
  JointGroup group = JointGroup::body;
  std::size_t joint = 0;
  bool rotation = true;  ///< false: a translation

  const Eigen::Vector3f& left() const noexcept { return before[0]; }
  const Eigen::Vector3f& right() const noexcept { return after[0]; }
};

/// First and second derivative at a border, per second. They are those of the quadratic that best fits the border and
/// the frames within kVelocityWindow of it, at least two more frames. With two frames they come from the difference;
/// with one they are 0.
struct BorderMotion {
  Eigen::Vector3f velocity = Eigen::Vector3f::Zero();
  Eigen::Vector3f acceleration = Eigen::Vector3f::Zero();
};
inline constexpr double kVelocityWindow = 0.067;
/// `path[k]` is k frames before the border.
BorderMotion motion_before(std::span<const Eigen::Vector3f> path, double hertz) noexcept;
/// `path[k]` is k frames after the border.
BorderMotion motion_after(std::span<const Eigen::Vector3f> path, double hertz) noexcept;

/// The velocity of motion_before and motion_after for many paths of the same length; the fit is solved once.
class BorderVelocity {
 public:
  /// For paths of `samples` samples, the border first, at least one.
  BorderVelocity(std::size_t samples, double hertz) noexcept;
  /// Velocity away from the gap, per second: the negated velocity of motion_before, or the velocity of motion_after.
  Eigen::Vector3f of(std::span<const Eigen::Vector3f> path) const noexcept {
    Eigen::Vector3f sum = Eigen::Vector3f::Zero();
    for (std::size_t i = 1; i <= last_; ++i) sum += weights_[i] * (path[i] - path[0]);
    return sum;
  }
  /// The weight of each sample's difference from the first sample; the first weight is not used.
  std::span<const float> weights() const noexcept { return {weights_.data(), last_ + 1}; }

 private:
  static constexpr std::size_t kMost = 255;  ///< most samples used; reached above 3,800 frames a second
  std::size_t last_ = 0;
  std::array<float, kMost + 1> weights_;  ///< [sample], the first is not used
};

/// Maps frames of a gap to times of the curve. A curve's swing grows with its duration: over a minute, a hand that
/// keeps its velocity turns about itself. So a gap longer than kLongestWay is filled by a curve of that duration whose
/// middle is slowed down; at the borders, time and its first two derivatives are unchanged. (ours)
class GapTime {
 public:
  explicit GapTime(const Gap& gap) noexcept;
  /// Constant speed over the whole gap, for curves that do not swing.
  static GapTime even(const Gap& gap) noexcept;

  /// Duration of the curve from border to border.
  double seconds() const noexcept { return curve_seconds_; }
  /// Position of a frame of the gap on the curve, in (0, 1).
  double at(std::int64_t frame) const noexcept;

 private:
  double count_;    ///< steps from border to border
  double seconds_;  ///< duration of the gap
  double curve_seconds_;
  bool pauses_ = false;
};
inline constexpr double kLongestCurve = 1.5;  ///< seconds
/// Time in which a curve comes to rest before a pause in the gap, and in which it leaves it again. Seconds. (ours)
inline constexpr double kPauseEase = 0.2;

/// The rotation vector of a unit quaternion; the quaternion's sign is significant, so its angle is in [0, 2π).
Eigen::Vector3f rotation_vector(const Eigen::Quaternionf& q) noexcept;
Eigen::Quaternionf rotation_of(const Eigen::Vector3f& vector) noexcept;

/// The rotation midway between the borders of a gap, in the left one's hemisphere.
Eigen::Quaternionf middle_of(const Eigen::Quaternionf& left, const Eigen::Quaternionf& right) noexcept;

/// How much of either side curves use.
inline constexpr double kSeen = 0.1;  ///< seconds
/// Number of frames of a side that are used: kSeen, or four if that is longer.
std::int64_t context_frames(const PosesView& side, FrameRate rate) noexcept;

/// Fills `scratch.before` and `scratch.after` with one joint's trajectory. Returns the rotation that they are relative
/// to.
Eigen::Quaternionf see_joint(const Gap& gap, std::size_t joint, GapScratch& scratch);
/// The same for a translation, relative to the midpoint.
Eigen::Vector3f see_translation(const Gap& gap, std::size_t translation, GapScratch& scratch);

/// Does this for all joints and translations of a job at once: fills `taken`, `turned`, `middles` and `seen` of its
/// scratch. The values equal those of see_joint up to rounding.
void see_all(const GapJob& job);
/// The sides of one joint or translation, in `scratch.before` and `scratch.after`. Call see_all first.
Sides sides_of(const GapJob& job, std::size_t taken, double seconds);
/// Fills `reaches`: how far joints may turn, given their range on both sides.
void set_reaches(const GapJob& job);
/// Copies the last joint's values to the padding joints, in rows of `taken` values.
void fill_blocks(const GapScratch& scratch, std::span<float> rows) noexcept;
/// Makes one frame: for each joint the sum of the terms' vectors in `scratch.vectors`, weighted by `scratch.row`,
/// limited by `scratch.reaches` and applied to `scratch.middles`.
void make_frame(const GapJob& job, std::int64_t frame, MutablePoses out) noexcept;

/// Fills a job from a family of curves, which has the members
///
///     std::size_t terms() const                                   number of functions of time
///     void row(double t, std::int64_t frame, float* out) const    their values at a frame, at t in (0, 1) of the curve
///     void coefficients(const Sides&, Eigen::Vector3f* out)       a joint's vectors, one per term
///
/// or, if the vectors are linear in the samples, instead of coefficients
///
///     void vectors(const GapScratch&, double seconds, float* out) all joints' vectors, [term][x y z][taken]
///
/// and, if it uses more than the sides and so may bend joints farther than JointReach allows,
///
///     static constexpr bool kBeyondSides = true
template <class Family>
void fill_curves(const GapJob& job, MutablePoses out, Family&& family, const GapTime& time) {
  constexpr bool kBeyondSides = requires {
    std::remove_cvref_t<Family>::kBeyondSides;
  };
  GapScratch& scratch = job.scratch;
  see_all(job);
  const bool quiet = quieten(job);
  const std::size_t terms = family.terms();
  const std::size_t all_terms = terms + (quiet ? 2 : 0);  // the borders' offsets, which fade out
  const std::size_t taken = scratch.taken.size();
  scratch.row.resize(all_terms);
  scratch.vectors.resize(all_terms * 3 * taken);
  set_reaches(job);
  if (kBeyondSides) std::ranges::fill(scratch.reaches.margins, 0.0f);
  if constexpr (requires { family.vectors(scratch, 0.0, scratch.vectors.data()); }) {
    family.vectors(scratch, time.seconds(), scratch.vectors.data());
  } else {
    scratch.coefficients.resize(terms);
    for (std::size_t i = 0; i < taken; ++i) {
      if (scratch.fills_block(i)) continue;
      family.coefficients(sides_of(job, i, time.seconds()), scratch.coefficients.data());
      for (std::size_t term = 0; term < terms; ++term) {
        float* const vector = scratch.vectors.data() + term * 3 * taken + i;
        for (Eigen::Index axis = 0; axis < 3; ++axis)
          vector[static_cast<std::size_t>(axis) * taken] = scratch.coefficients[term][axis];
      }
    }
    fill_blocks(scratch, std::span(scratch.vectors).first(terms * 3 * taken));
  }
  for (std::size_t side = 0; quiet && side < 2; ++side) {
    std::ranges::copy(scratch.offsets[side],
                      scratch.vectors.begin() + static_cast<std::ptrdiff_t>((terms + side) * 3 * taken));
  }
  const double gap = job.gap.duration().count();
  for (std::int64_t frame = 0; frame < job.gap.count; ++frame) {
    family.row(time.at(frame), frame, scratch.row.data());
    if (quiet) {
      const double since = static_cast<double>(frame + 1) / job.gap.rate.hertz();
      scratch.row[terms] = offset_left(since, gap);
      scratch.row[terms + 1] = offset_left(gap - since, gap);
    }
    make_frame(job, frame, out);
  }
}

}  // namespace signweave
