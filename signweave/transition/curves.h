#pragma once

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cstddef>
#include <span>
#include <type_traits>

#include "signweave/transition/method.h"
#include "signweave/transition/quieten.h"

/// How methods describe the ways that joints take: inside this module only.
///
/// A joint's rotations on both sides of a gap are looked at as rotation vectors from the rotation midway between the
/// two borders (radians), a translation as metres from the place midway. There every method is a sum of functions of
/// time, the same for all joints, each times a vector of the joint's own. What turns the axes turns the vectors: a
/// method that makes them by adding what it sees works on every rig.
namespace signweave {

/// One joint's (or translation's) way on both sides: [k] is k frames from the border, which is [0].
struct Sides {
  std::span<const Eigen::Vector3f> before;
  std::span<const Eigen::Vector3f> after;
  double hertz = 30;
  double seconds = 0;  ///< of the curve, from border to border: see GapTime
  JointRole role = JointRole::other;
  JointGroup group = JointGroup::body;
  std::size_t joint = 0;
  bool rotation = true;  ///< false: a translation

  const Eigen::Vector3f& left() const noexcept { return before[0]; }
  const Eigen::Vector3f& right() const noexcept { return after[0]; }
};

/// First and second derivative at a border, per second: of the quadratic that fits the border and what lies within
/// kVelocityWindow of it best, two more frames at least. Of two frames it is their difference, of one it is 0.
struct BorderMotion {
  Eigen::Vector3f velocity = Eigen::Vector3f::Zero();
  Eigen::Vector3f acceleration = Eigen::Vector3f::Zero();
};
inline constexpr double kVelocityWindow = 0.067;
/// `path[k]` is k frames back in time.
BorderMotion motion_before(std::span<const Eigen::Vector3f> path, double hertz) noexcept;
/// `path[k]` is k frames on in time.
BorderMotion motion_after(std::span<const Eigen::Vector3f> path, double hertz) noexcept;

/// What motion_before and motion_after give as velocity, of many paths of one length: the fit is solved once.
class BorderVelocity {
 public:
  /// Of paths of so many samples, the border first, at least one.
  BorderVelocity(std::size_t samples, double hertz) noexcept;
  /// Away from the gap, per second: minus what motion_before gives, and what motion_after gives.
  Eigen::Vector3f of(std::span<const Eigen::Vector3f> path) const noexcept {
    Eigen::Vector3f sum = Eigen::Vector3f::Zero();
    for (std::size_t i = 1; i <= last_; ++i) sum += weights_[i] * (path[i] - path[0]);
    return sum;
  }
  /// What each sample's difference from the first one is taken times for that; the first weight is not used.
  std::span<const float> weights() const noexcept { return {weights_.data(), last_ + 1}; }

 private:
  static constexpr std::size_t kMost = 255;  ///< no more samples are looked at: beyond 3,800 frames a second
  std::size_t last_ = 0;
  std::array<float, kMost + 1> weights_;  ///< [sample], the first is not used
};

/// When what happens in a gap, as curves see it. How far a curve swings out grows with its time: over a minute, a hand
/// that goes on as it came turns about itself. So a gap that is longer than kLongestWay is filled as one of that length
/// whose middle is slowed down; at the borders time goes by as it does, with its first two derivatives. (ours)
class GapTime {
 public:
  explicit GapTime(const Gap& gap) noexcept;
  /// The gap as long as it is, at one speed: for ways that do not swing.
  static GapTime even(const Gap& gap) noexcept;

  /// Of the curve, from border to border.
  double seconds() const noexcept { return way_; }
  /// Where on the curve a frame of the gap is, in (0, 1).
  double at(std::int64_t frame) const noexcept;

 private:
  double count_;    ///< steps from border to border
  double seconds_;  ///< that the gap has
  double way_;
  bool pauses_ = false;
};
inline constexpr double kLongestWay = 1.5;  ///< seconds
/// In which a way comes to rest where the gap holds a pause, and leaves it again. Seconds. (ours)
inline constexpr double kPauseEase = 0.2;

/// The rotation vector of a unit quaternion as it is signed: its angle is in [0, 2π).
Eigen::Vector3f rotation_vector(const Eigen::Quaternionf& q) noexcept;
Eigen::Quaternionf rotation_of(const Eigen::Vector3f& vector) noexcept;

/// The rotation midway between the borders of a gap, in the left one's hemisphere.
Eigen::Quaternionf middle_of(const Eigen::Quaternionf& left, const Eigen::Quaternionf& right) noexcept;

/// What curves look at of either side.
inline constexpr double kSeen = 0.1;  ///< seconds
/// Frames of either side that are looked at: kSeen, or four where these reach farther.
std::int64_t context_frames(const PosesView& side, FrameRate rate) noexcept;

/// Fills `scratch.before` and `scratch.after` with one joint's way and gives the rotation that they are seen from.
Eigen::Quaternionf see_joint(const Gap& gap, std::size_t joint, GapScratch& scratch);
/// The same for a translation, seen from the place midway.
Eigen::Vector3f see_translation(const Gap& gap, std::size_t translation, GapScratch& scratch);

/// Sees all joints and translations of a job at once: fills `taken`, `turned`, `middles` and `seen` of its scratch. Of
/// each joint it sees what see_joint does, up to rounding.
void see_all(const GapJob& job);
/// The sides of one of them, in `scratch.before` and `scratch.after`, after see_all.
Sides sides_of(const GapJob& job, std::size_t taken, double seconds);
/// How far joints may go from what is seen of both sides: fills `reaches`.
void set_reaches(const GapJob& job);
/// Gives the joints that only fill blocks, in rows of as many numbers as are `taken`, what the last joint has.
void fill_blocks(const GapScratch& scratch, std::span<float> rows) noexcept;
/// Makes one frame: of each way the terms' vectors in `scratch.ways`, each times its number in `scratch.row`, kept
/// within `scratch.reaches` and turned by `scratch.middles`.
void make_frame(const GapJob& job, std::int64_t frame, MutablePoses out) noexcept;

/// Fills a job from a family of curves, which has
///   std::size_t terms() const                                  how many functions of time
///   void row(double t, std::int64_t frame, float* out) const   their values at a frame, at t in (0, 1) of the curve
///   void coefficients(const Sides&, Eigen::Vector3f* out)      a joint's vectors, one a term
/// or, where these are sums of what is seen, the same for all joints,
///   void ways(const GapScratch&, double seconds, float* out)   all joints' vectors, [term][x y z][taken]
/// and, where it has seen more than the sides and so may bend joints farther than JointReach lets it,
///   static constexpr bool kBeyondSides = true
template <class Family>
void fill_curves(const GapJob& job, MutablePoses out, Family&& family, const GapTime& time) {
  constexpr bool kBeyondSides = requires {
    std::remove_cvref_t<Family>::kBeyondSides;
  };
  GapScratch& scratch = job.scratch;
  see_all(job);
  const bool quiet = quieten(job);
  const std::size_t terms = family.terms();
  const std::size_t all_terms = terms + (quiet ? 2 : 0);  // the offsets of the borders, which fade out
  const std::size_t taken = scratch.taken.size();
  scratch.row.resize(all_terms);
  scratch.ways.resize(all_terms * 3 * taken);
  set_reaches(job);
  if (kBeyondSides) std::ranges::fill(scratch.reaches.margins, 0.0f);
  if constexpr (requires { family.ways(scratch, 0.0, scratch.ways.data()); }) {
    family.ways(scratch, time.seconds(), scratch.ways.data());
  } else {
    scratch.coefficients.resize(terms);
    for (std::size_t i = 0; i < taken; ++i) {
      if (scratch.fills_block(i)) continue;
      family.coefficients(sides_of(job, i, time.seconds()), scratch.coefficients.data());
      for (std::size_t term = 0; term < terms; ++term) {
        float* const way = scratch.ways.data() + term * 3 * taken + i;
        for (Eigen::Index axis = 0; axis < 3; ++axis)
          way[static_cast<std::size_t>(axis) * taken] = scratch.coefficients[term][axis];
      }
    }
    fill_blocks(scratch, std::span(scratch.ways).first(terms * 3 * taken));
  }
  for (std::size_t side = 0; quiet && side < 2; ++side) {
    std::ranges::copy(scratch.offsets[side],
                      scratch.ways.begin() + static_cast<std::ptrdiff_t>((terms + side) * 3 * taken));
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
