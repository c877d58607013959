#pragma once

#include <Eigen/Geometry>
#include <span>
#include <vector>

#include "signweave/motion/motion.h"

namespace signweave {

// Everything here works on poses of one skeleton (same counts), allocates nothing and cannot fail.

/// The shortest arc from a to b at t in [0, 1]; exactly a at 0 and ±b at 1. Unit quaternions in, unit out.
Eigen::Quaternionf slerp(const Eigen::Quaternionf& a, const Eigen::Quaternionf& b, float t) noexcept;

/// The arc from a to b as they are signed, which may be the longer one: for a series of blends whose signs the caller
/// keeps continuous. Where the shorter arc is chosen anew for each frame, two rotations that pass half a turn apart
/// make the blend jump. Exactly a at 0 and b at 1.
Eigen::Quaternionf slerp_as_signed(const Eigen::Quaternionf& a, const Eigen::Quaternionf& b, float t) noexcept;

/// The same for many joints at once, t in [0, 1]; all three of one size, `out` may be a or b. Off by less than 1e-6
/// radians from the exact arc, and so at t = 0 and 1.
void slerp(std::span<const Eigen::Quaternionf> a, std::span<const Eigen::Quaternionf> b, float t,
           std::span<Eigen::Quaternionf> out) noexcept;
void slerp_as_signed(std::span<const Eigen::Quaternionf> a, std::span<const Eigen::Quaternionf> b, float t,
                     std::span<Eigen::Quaternionf> out) noexcept;

/// Rotations that go on turning, one array per number.
class CoastingRotations {
 public:
  /// Velocities are radians a frame about an axis in the joint's own space. Allocates only where there are more joints
  /// than before.
  void assign(std::span<const Eigen::Quaternionf> rotations, std::span<const Eigen::Vector3f> velocities);
  /// Turns every joint on by so many frames.
  void coast(float frames);
  /// The numbers of all joints: 0 to 3 the rotation's x, y, z, w, 4 to 6 the velocity's x, y, z.
  const float* number(std::size_t which) const noexcept { return numbers_.data() + which * count_; }

 private:
  std::vector<float> numbers_;
  std::size_t count_ = 0;
};

/// out = the arc as signed, at t, from where a has come to in so many frames to where b has. |frames · velocity| is at
/// most pi. Off by less than 1e-5 radians.
void slerp_coasting(const CoastingRotations& a, float a_frames, const CoastingRotations& b, float b_frames, float t,
                    std::span<Eigen::Quaternionf> out) noexcept;

/// out = the pose at t between a and b: slerp of rotations, linear translations. `out` may be a or b.
void blend(PoseView a, PoseView b, float t, MutablePoseView out) noexcept;

/// The pose of a motion (of at least one frame) at a fractional frame, clamped to its first and last. A whole frame
/// gives that frame's bits.
void sample(const Motion& motion, double frame, MutablePoseView out) noexcept;

/// A motion of the ground plane: a turn about the vertical through the origin, then a shift along the ground.
struct GroundTransform {
  Eigen::Quaternionf turn = Eigen::Quaternionf::Identity();  ///< about +Y
  Eigen::Vector3f shift = Eigen::Vector3f::Zero();           ///< metres, its y is 0
  friend bool operator==(const GroundTransform& a, const GroundTransform& b) noexcept {
    return a.turn.coeffs() == b.turn.coeffs() && a.shift == b.shift;
  }
};

/// Where someone stands and faces: the root's ground position and heading over some frames.
struct Standing {
  Eigen::Vector3f position = Eigen::Vector3f::Zero();  ///< metres, model space, y is 0
  float heading = 0;                                   ///< radians about +Y, from the root's rotation
};

/// The mean standing over frames (at least one) of a motion: mean position, circular mean of the heading.
Standing standing_over(const Motion& motion, FrameRange frames) noexcept;

/// The transform that takes a signer who stands as `from` to where `to` stands.
GroundTransform align(const Standing& from, const Standing& to) noexcept;

/// Applies a transform to a pose's root; a root that only turns, where another joint may move, is turned alone. Other
/// joints keep their bits.
void apply(const GroundTransform& transform, const Skeleton& skeleton, MutablePoseView pose) noexcept;

}  // namespace signweave
