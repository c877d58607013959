#include "signweave/render/window.h"

#include <algorithm>

#include "signweave/motion/blend.h"

namespace signweave {
namespace {

void stand(const PlacedClip& placed, const Skeleton& skeleton, MutablePoses poses) noexcept {
  if (!placed.standing) return;
  const std::size_t joints = skeleton.joint_count();
  const std::size_t moved = skeleton.translation_count();
  for (std::size_t k = 0; k * joints < poses.rotations.size(); ++k) {
    apply(*placed.standing, skeleton,
          {poses.rotations.subspan(k * joints, joints), poses.translations.subspan(k * moved, moved)});
  }
}

void turn(const JointSigns& turned, std::span<Eigen::Quaternionf> rotations) noexcept {
  for (std::size_t joint = 0; joint < turned.size(); ++joint) {
    if (!turned[joint]) continue;
    for (std::size_t at = joint; at < rotations.size(); at += turned.size()) rotations[at].coeffs() *= -1.0f;
  }
}

}  // namespace

FrameRange inside(FrameRange frames, FrameRange window) noexcept {
  const std::int64_t begin = std::max(frames.begin, window.begin);
  return {begin, std::max(begin, std::min(frames.end, window.end))};
}

FrameRange own_frames(const PlacedClip* before, const PlacedClip& placed) noexcept {
  return {placed.begin() + (before == nullptr ? 0 : JunctionFiller::shared(*before, placed)), placed.end()};
}

void read_standing(const PlacedClip& placed, const Skeleton& skeleton, FrameRange output, MutablePoses out) {
  read_frames(placed, output, out);
  stand(placed, skeleton, out);
}

void fetch(std::span<const PlacedClip> clips, OutputWindow window) {
  for (std::size_t i = 0; i < clips.size(); ++i) {
    const FrameRange own = inside(own_frames(i == 0 ? nullptr : &clips[i - 1], clips[i]), window.frames());
    read_frames(clips[i], own, window.poses(own));
  }
}

void join(const JoinedClips& joined, JunctionFiller& filler, OutputWindow window, JunctionScratch& scratch) {
  const Skeleton& skeleton = window.motion.skeleton();
  for (std::size_t i = 0; i < joined.clips.size(); ++i) {
    const PlacedClip& now = joined.clips[i];
    const PlacedClip* const before = i == 0 ? nullptr : &joined.clips[i - 1];
    const FrameRange all = own_frames(before, now);
    const MutablePoses own = window.poses(inside(all, window.frames()));
    stand(now, skeleton, own);
    if (before == nullptr) {
      if (joined.turned != nullptr) turn(*joined.turned, own.rotations);
      continue;
    }
    const std::int64_t shared = all.begin - now.begin();
    scratch.shared.reset(window.motion.shared_skeleton(), window.motion.rate(), shared);
    read_standing(now, skeleton, {now.begin(), all.begin}, scratch.shared.poses({0, shared}));
    filler.fill(*before, now, joined.cuts[i - 1].parts, window, scratch);
  }
}

}  // namespace signweave
