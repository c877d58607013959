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
  /// Which moments of blinking, which ways of swaying: two signers with two seeds do not move as one.
  std::uint64_t seed = 0;
  /// How much trunk, shoulders and head move; 0 for not at all, up to 10 to see it well.
  float amount = 1;
};

/// A signer at rest who breathes, sways a little and blinks, without end. Each frame is a function of its number alone:
/// the same bits whenever it is asked for. Frame 0 is the rest pose itself; life comes in over kRestEase. Trunk,
/// shoulders and head turn about the signer's own axes, told from the rig and the rest pose; legs stand, arms keep how
/// they hang, the head keeps where it looks but for a drift of about a degree. Joints that the rig map lacks keep
/// still, and so does everything where it does not tell left from right. Reading allocates nothing and throws nothing.
/// Several threads may read at once.
class LivingRest final : public MotionSource {
 public:
  /// `rest` and `tracks` (the names of its values) must be of that skeleton and the map too. The tracks eyeBlinkLeft
  /// and eyeBlinkRight blink, every other keeps its value. Throws Error{bad_input} where counts differ.
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
  /// How a joint turns beside what it has at rest, in the signer's axes.
  enum class Role : std::uint8_t { spine, chest, neck, head, clavicle, upper_arm };
  static constexpr std::size_t kMostMoved = 8;
  struct Moved {
    Role role = Role::spine;
    JointIndex joint = kNoJoint;
    int above = -1;  ///< the nearest moved joint above it, of moved_; below 0: none
    Eigen::Vector3f lift =
        Eigen::Vector3f::Zero();  ///< of a clavicle: the axis about which it rises, signer's axes, unit or zero
    Eigen::Matrix3f to_parent = Eigen::Matrix3f::Identity();  ///< the signer's axes in the space of the joint's parent
  };
  /// All that moves, at one moment; radians, signer's axes.
  struct Life {
    float breath = 0;                      ///< 0 breathed out to 1 breathed in, times the amount
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
  std::array<std::size_t, 2> lids_;  ///< of tracks_; as many as there are tracks: none
  LivingRestOptions options_;
  std::array<double, 8> phases_{};  ///< turns: where each slow wave begins
  std::array<Moved, kMostMoved> moved_;
  std::size_t moved_count_ = 0;
};

}  // namespace signweave
