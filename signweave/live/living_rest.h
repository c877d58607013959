#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "signweave/live/rest_pose.h"
#include "signweave/motion/motion_source.h"
#include "signweave/rig/rig_map.h"

namespace signweave {

struct LivingRestOptions {
  /// Determines the times of blinks and the phases of swaying, so that two signers with different seeds do not move in
  /// sync.
  std::uint64_t seed = 0;
  /// Amount of movement of trunk, shoulders and head, from 0 (none) to 10 (clearly visible).
  float amount = 1;
};

/// A signer at rest who breathes, sways slightly and blinks, indefinitely. Each frame is a function of its number
/// alone, bit for bit. Frame 0 is the rest pose; movement fades in over kRestEase. Trunk,
/// shoulders and head rotate about the signer's axes, derived from the rig and the rest pose. Legs stand still, arms
/// keep hanging as they are, and the head keeps its gaze except for a drift of about a degree. Joints missing from the
/// rig map do not move; if the map does not distinguish left and right, nothing moves. Reading does not allocate or
/// throw. Several threads may read concurrently.
class LivingRest final : public MotionSource {
 public:
  /// `rig`, `rest` and `tracks` (the names of its values) must match the skeleton. The tracks eyeBlinkLeft and
  /// eyeBlinkRight blink, all others are constant. Throws Error{bad_input} if counts differ.
  LivingRest(std::shared_ptr<const Skeleton> skeleton, FrameRate rate, const RigMap& rig, RestPose rest,
             std::vector<std::string> tracks, LivingRestOptions options = {});

  const std::shared_ptr<const Skeleton>& skeleton() const noexcept override { return skeleton_; }
  FrameRate rate() const noexcept override { return rate_; }
  std::int64_t frame_count() const noexcept override { return kFrames; }
  std::span<const std::string> tracks() const noexcept override { return tracks_; }
  void read(FrameRange frames, MutablePoses out) const noexcept override;
  void read_tracks(FrameRange frames, std::span<const std::span<float>> out) const noexcept override;

  static constexpr std::int64_t kFrames = std::int64_t{1} << 40;  ///< 580 years at 60 frames a second
  static constexpr Seconds kRestEase{2.0};

 private:
  /// How a joint rotates relative to its rest rotation, in the signer's axes.
  enum class Role : std::uint8_t { spine, chest, neck, head, clavicle, upper_arm };
  static constexpr std::size_t kMostMoved = 8;
  struct Moved {
    Role role = Role::spine;
    JointIndex joint = kNoJoint;
    int above = -1;                                  ///< index in moved_ of the nearest moved ancestor; negative: none
    Eigen::Vector3f lift = Eigen::Vector3f::Zero();  ///< axis about which a clavicle rises, signer's axes; or zero
    Eigen::Matrix3f to_parent = Eigen::Matrix3f::Identity();  ///< the signer's axes in the space of the joint's parent
  };
  /// All movements at one frame; radians, signer's axes.
  struct Life {
    float breath = 0;                      ///< from 0 (exhaled) to 1 (inhaled), times the amount
    std::array<Eigen::Vector3f, 4> turns;  ///< [Role] to `head`
  };

  void add_moved(const RigMap& rig, const ModelPose& pose);
  Life life_at(std::int64_t frame) const noexcept;
  void move(const Life& life, std::span<Eigen::Quaternionf> rotations) const noexcept;
  float lids_at(std::int64_t frame) const noexcept;

  std::shared_ptr<const Skeleton> skeleton_;
  FrameRate rate_;
  RestPose rest_;
  std::vector<std::string> tracks_;
  std::array<std::size_t, 2> lids_;  ///< indices in tracks_; tracks_.size(): none
  LivingRestOptions options_;
  std::array<double, 8> phases_{};  ///< in turns: initial phase of each slow wave
  std::array<Moved, kMostMoved> moved_;
  std::size_t moved_count_ = 0;
};

}  // namespace signweave
