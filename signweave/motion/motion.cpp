#include "signweave/motion/motion.h"

#include <algorithm>
#include <cassert>
#include <cstring>
#include <functional>

namespace signweave {

Motion::Motion(std::shared_ptr<const Skeleton> skeleton, FrameRate rate, std::int64_t frames)
    : skeleton_(std::move(skeleton)), rate_(rate) {
  reserve(frames);
  for (std::int64_t i = 0; i < frames; ++i) append();
}

PoseView Motion::pose(std::int64_t frame) const noexcept {
  assert(frame >= 0 && frame < frames_);
  const std::size_t joints = skeleton_->joint_count();
  const std::size_t moved = skeleton_->translation_count();
  const auto at = static_cast<std::size_t>(frame);
  return {{rotations_.data() + at * joints, joints}, {translations_.data() + at * moved, moved}};
}

MutablePoseView Motion::pose(std::int64_t frame) noexcept {
  assert(frame >= 0 && frame < frames_);
  const std::size_t joints = skeleton_->joint_count();
  const std::size_t moved = skeleton_->translation_count();
  const auto at = static_cast<std::size_t>(frame);
  return {{rotations_.data() + at * joints, joints}, {translations_.data() + at * moved, moved}};
}

MutablePoses Motion::poses(FrameRange frames) noexcept {
  assert(frames.begin >= 0 && frames.begin <= frames.end && frames.end <= frames_);
  const std::size_t joints = skeleton_->joint_count();
  const std::size_t moved = skeleton_->translation_count();
  const auto at = static_cast<std::size_t>(frames.begin);
  const auto count = static_cast<std::size_t>(frames.size());
  return {{rotations_.data() + at * joints, count * joints}, {translations_.data() + at * moved, count * moved}};
}

void Motion::reset(std::shared_ptr<const Skeleton> skeleton, FrameRate rate, std::int64_t frames) {
  skeleton_ = std::move(skeleton);
  rate_ = rate;
  frames_ = frames;
  // Cleared first, so that resizing moves no old values. Neither type initialises its values.
  rotations_.clear();
  translations_.clear();
  tracks_.clear();
  rotations_.resize(static_cast<std::size_t>(frames) * skeleton_->joint_count());
  translations_.resize(static_cast<std::size_t>(frames) * skeleton_->translation_count());
}

void Motion::append(PoseView pose) {
  assert(pose.rotations.size() == skeleton_->joint_count());
  assert(pose.translations.size() == skeleton_->translation_count());
  const std::less<> before;
  if (!before(pose.rotations.data(), rotations_.data()) &&
      before(pose.rotations.data(), rotations_.data() + rotations_.size())) {
    const Pose own(pose);  // growing would move it during the copy
    append(own.view());
    return;
  }
  rotations_.insert(rotations_.end(), pose.rotations.begin(), pose.rotations.end());
  translations_.insert(translations_.end(), pose.translations.begin(), pose.translations.end());
  ++frames_;
}

MutablePoseView Motion::append() {
  rotations_.resize(rotations_.size() + skeleton_->joint_count(), Eigen::Quaternionf::Identity());
  for (const JointIndex joint : skeleton_->translated_joints()) translations_.push_back(skeleton_->joint(joint).offset);
  ++frames_;
  return pose(frames_ - 1);
}

void Motion::reserve(std::int64_t frames) {
  rotations_.reserve(static_cast<std::size_t>(frames) * skeleton_->joint_count());
  translations_.reserve(static_cast<std::size_t>(frames) * skeleton_->translation_count());
}

void Motion::add_track(ScalarTrack track) {
  assert(static_cast<std::int64_t>(track.values.size()) == frames_);
  tracks_.push_back(std::move(track));
}

Motion Motion::slice(FrameRange range) const {
  assert(range.begin >= 0 && range.end <= frames_);
  Motion part(skeleton_, rate_);
  part.reserve(range.size());
  for (std::int64_t frame = range.begin; frame < range.end; ++frame) part.append(pose(frame));
  for (const ScalarTrack& track : tracks_) {
    part.add_track({track.name, {track.values.begin() + range.begin, track.values.begin() + range.end}});
  }
  return part;
}

void keep_hemisphere(Motion& motion) noexcept {
  for (std::int64_t frame = 1; frame < motion.frame_count(); ++frame) {
    const MutablePoseView now = motion.pose(frame);
    const PoseView before = motion.pose(frame - 1);
    for (std::size_t joint = 0; joint < now.rotations.size(); ++joint) {
      if (now.rotations[joint].dot(before.rotations[joint]) < 0) now.rotations[joint].coeffs() *= -1.0f;
    }
  }
}

bool same_bits(const Motion& a, const Motion& b) noexcept {
  const auto same = [](auto left, auto right) {
    return left.size() == right.size() &&
           (left.empty() || std::memcmp(left.data(), right.data(), left.size_bytes()) == 0);
  };
  return a.skeleton() == b.skeleton() && a.rate() == b.rate() && a.frame_count() == b.frame_count() &&
         same(a.rotations(), b.rotations()) && same(a.translations(), b.translations()) &&
         std::ranges::equal(a.tracks(), b.tracks(), [&](const ScalarTrack& left, const ScalarTrack& right) {
           return left.name == right.name && same(std::span(left.values), std::span(right.values));
         });
}

bool keeps_hemisphere(const Motion& motion) noexcept {
  const std::span<const Eigen::Quaternionf> all = motion.rotations();
  const std::size_t joints = motion.skeleton().joint_count();
  for (std::size_t i = joints; i < all.size(); ++i) {
    if (all[i].dot(all[i - joints]) < 0) return false;
  }
  return true;
}

}  // namespace signweave
