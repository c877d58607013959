#pragma once

#include <Eigen/Geometry>
#include <span>
#include <vector>

#include "signweave/motion/motion.h"

namespace signweave {

// All functions here work on poses of one skeleton (equal counts), allocate nothing and cannot fail.

/// The shortest arc from a to b at t in [0, 1]; exactly a at 0 and ±b at 1. Takes and returns unit quaternions.
Eigen::Quaternionf slerp(const Eigen::Quaternionf& a, const Eigen::Quaternionf& b, float t) noexcept;

/// The arc from a to b with their given signs, which may be the longer one: for a series of blends whose signs the
/// caller keeps continuous. If the shorter arc were chosen for each frame separately, the blend would jump where two
/// rotations pass half a turn apart. Exactly a at 0 and b at 1.
Eigen::Quaternionf slerp_as_signed(const Eigen::Quaternionf& a, const Eigen::Quaternionf& b, float t) noexcept;

/// The same for many joints at once, t in [0, 1]. All three spans have the same size; `out` may be a or b. Differs by
/// less than 1e-6 radians from the exact arc, also at t = 0 and 1.
void slerp(std::span<const Eigen::Quaternionf> a, std::span<const Eigen::Quaternionf> b, float t,
           std::span<Eigen::Quaternionf> out) noexcept;
void slerp_as_signed(std::span<const Eigen::Quaternionf> a, std::span<const Eigen::Quaternionf> b, float t,
                     std::span<Eigen::Quaternionf> out) noexcept;

/// Rotations that continue to turn at constant velocity, stored as one array per component.
class CoastingRotations {
 public:
  /// Velocities are in radians per frame about an axis in the joint's own space. Allocates only if there are more
  /// joints than before.
  void assign(std::span<const Eigen::Quaternionf> rotations, std::span<const Eigen::Vector3f> velocities);
  /// Continues the turn of every joint by `frames`.
  void coast(float frames);
  /// One component of all joints: 0 to 3 are the rotation's x, y, z, w; 4 to 6 are the velocity's x, y, z.
  const float* number(std::size_t which) const noexcept { return numbers_.data() + which * count_; }

 private:
  std::vector<float> numbers_;
  std::size_t count_ = 0;
};

/// out = the arc with the given signs, at t, from a after coasting for a_frames to b after coasting for b_frames.
/// |frames · velocity| is at most pi. The error is less than 1e-5 radians.
void slerp_coasting(const CoastingRotations& a, float a_frames, const CoastingRotations& b, float b_frames, float t,
                    std::span<Eigen::Quaternionf> out) noexcept;

/// out = the pose at t between a and b: slerp of rotations, linear interpolation of translations. `out` may be a or b.
void blend(PoseView a, PoseView b, float t, MutablePoseView out) noexcept;

/// The pose of a motion (of at least one frame) at a fractional frame, clamped to its first and last frame. A whole
/// frame number gives exactly that frame's bits.
void sample(const Motion& motion, double frame, MutablePoseView out) noexcept;

/// A rigid motion in the ground plane: a turn about the vertical through the origin, then a shift along the ground.
struct GroundTransform {
  Eigen::Quaternionf turn = Eigen::Quaternionf::Identity();  ///< about +Y
  Eigen::Vector3f shift = Eigen::Vector3f::Zero();           ///< metres, its y is 0
  friend bool operator==(const GroundTransform& a, const GroundTransform& b) noexcept {
    return a.turn.coeffs() == b.turn.coeffs() && a.shift == b.shift;
  }
};

/// Where a signer stands and faces: the root's ground position and heading over some frames.
struct Standing {
  Eigen::Vector3f position = Eigen::Vector3f::Zero();  ///< metres, model space, y is 0
  float heading = 0;                                   ///< radians about +Y, from the root's rotation
};

/// The mean position and the circular mean of the heading over some frames (at least one) of a motion.
Standing standing_over(const Motion& motion, FrameRange frames) noexcept;

/// The transform that moves a signer from the standing `from` to the standing `to`.
GroundTransform align(const Standing& from, const Standing& to) noexcept;

/// Applies a transform to a pose's root. If the root has no translation but another joint has one, only its rotation
/// changes. Other joints keep their bits.
void apply(const GroundTransform& transform, const Skeleton& skeleton, MutablePoseView pose) noexcept;

}  // namespace signweave
