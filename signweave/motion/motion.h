#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "signweave/core/time.h"
#include "signweave/motion/skeleton.h"

namespace signweave {

/// One frame of a motion; borrows the motion's memory.
struct PoseView {
  std::span<const Eigen::Quaternionf> rotations;  ///< [joint], unit, each relative to its parent
  std::span<const Eigen::Vector3f> translations;  ///< [translated joint], the root first; metres, parent's space
};

/// A writable PoseView.
struct MutablePoseView {
  std::span<Eigen::Quaternionf> rotations;
  std::span<Eigen::Vector3f> translations;

  operator PoseView() const noexcept { return {rotations, translations}; }
};

/// Consecutive frames of a motion; writable, borrows the motion's memory.
struct MutablePoses {
  std::span<Eigen::Quaternionf> rotations;  ///< [frame][joint]
  std::span<Eigen::Vector3f> translations;  ///< [frame][translated joint]
};

/// One pose that owns its values.
struct Pose {
  std::vector<Eigen::Quaternionf> rotations;
  std::vector<Eigen::Vector3f> translations;

  Pose() = default;
  /// The rest pose: all rotations are the identity, each translation is its joint's offset.
  explicit Pose(const Skeleton& skeleton) : rotations(skeleton.joint_count(), Eigen::Quaternionf::Identity()) {
    translations.reserve(skeleton.translation_count());
    for (const JointIndex joint : skeleton.translated_joints()) translations.push_back(skeleton.joint(joint).offset);
  }
  explicit Pose(PoseView view)
      : rotations(view.rotations.begin(), view.rotations.end()),
        translations(view.translations.begin(), view.translations.end()) {}
  PoseView view() const noexcept { return {rotations, translations}; }
  MutablePoseView view() noexcept { return {rotations, translations}; }
};

/// A scalar value per frame in addition to the joints, such as a face weight.
struct ScalarTrack {
  std::string name;
  std::vector<float> values;  ///< [frame]
  friend bool operator==(const ScalarTrack&, const ScalarTrack&) = default;
};

/// Poses of one skeleton at a fixed rate. Metres, Y up, right-handed. Copying copies the poses and shares the skeleton.
class Motion {
 public:
  Motion() = default;
  /// A motion of `frames` rest poses: all rotations are the identity, each translation is its joint's offset.
  Motion(std::shared_ptr<const Skeleton> skeleton, FrameRate rate, std::int64_t frames = 0);

  const Skeleton& skeleton() const noexcept { return *skeleton_; }
  const std::shared_ptr<const Skeleton>& shared_skeleton() const noexcept { return skeleton_; }
  FrameRate rate() const noexcept { return rate_; }
  std::int64_t frame_count() const noexcept { return frames_; }
  Seconds duration() const noexcept { return static_cast<double>(frames_) * rate_.frame_time(); }

  /// The pose of a frame in [0, frame_count()). Borrowed: valid until a frame is appended or the motion is destroyed.
  PoseView pose(std::int64_t frame) const noexcept;
  MutablePoseView pose(std::int64_t frame) noexcept;

  /// The poses of some frames, which must lie within the motion. Borrowed like `pose`.
  MutablePoses poses(FrameRange frames) noexcept;

  /// Turns this into a motion of `frames` poses with unspecified values, to be written by the caller, and without
  /// tracks. Reuses memory if it suffices.
  void reset(std::shared_ptr<const Skeleton> skeleton, FrameRate rate, std::int64_t frames);

  /// Appends a pose, whose counts must match the skeleton; it may be a pose of this motion.
  void append(PoseView pose);
  /// Appends a rest pose and returns it to be filled in.
  MutablePoseView append();
  /// Reserves memory for that many frames; a hint.
  void reserve(std::int64_t frames);

  /// All rotations, [frame][joint], and all translations, [frame][translated joint].
  std::span<const Eigen::Quaternionf> rotations() const noexcept { return rotations_; }
  std::span<const Eigen::Vector3f> translations() const noexcept { return translations_; }

  const std::vector<ScalarTrack>& tracks() const noexcept { return tracks_; }
  /// Adds a track, which must have one value per frame.
  void add_track(ScalarTrack track);
  /// Moves the tracks out; the motion then has none.
  std::vector<ScalarTrack> take_tracks() noexcept { return std::exchange(tracks_, {}); }

  /// A copy of some frames, including their part of every track. `range` must lie within the motion.
  Motion slice(FrameRange range) const;

 private:
  std::shared_ptr<const Skeleton> skeleton_ = std::make_shared<const Skeleton>();
  FrameRate rate_;
  std::int64_t frames_ = 0;
  std::vector<Eigen::Quaternionf> rotations_;
  std::vector<Eigen::Vector3f> translations_;
  std::vector<ScalarTrack> tracks_;
};

/// True if two motions are bit-identical in skeleton, rate, poses and tracks; -0.0 and 0.0 differ.
bool same_bits(const Motion& a, const Motion& b) noexcept;

/// Flips signs so that every quaternion lies in the same hemisphere as the same joint's quaternion in the previous
/// frame: q and -q are the same rotation, and a blend between neighbours must take the shorter arc.
void keep_hemisphere(Motion& motion) noexcept;
/// True if all quaternions do so already.
bool keeps_hemisphere(const Motion& motion) noexcept;

}  // namespace signweave
