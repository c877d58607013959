#include "signweave/rig/body_shape.h"

#include "signweave/rig/joint_at.h"

#include <algorithm>

namespace signweave {
namespace {

/// Approximates the stature: the longest path through the body, from a hand to a foot, is a third longer.
float size_of(const BodyShape& shape) {
  float longest = 0;
  for (std::size_t joint = 0; joint < shape.children.size(); ++joint) {
    float first = shape.has_tip(static_cast<JointIndex>(joint)) ? shape.tips[joint].offset.norm() : 0;
    float second = 0;
    for (const JointIndex child : shape.children[joint]) {
      second = std::max(second, std::min(first, shape.branch(child)));
      first = std::max(first, shape.branch(child));
    }
    longest = std::max(longest, first + second);
  }
  return std::max(0.74f * longest, 1e-3f);
}

}  // namespace

BodyShape shape_of(const Motion& motion) {
  const Skeleton& skeleton = motion.skeleton();
  const std::int64_t frames = motion.frame_count();
  const std::int64_t count = std::min(frames, kShapeFrames);
  BodyShape shape;
  for (std::int64_t i = 0; i < count; ++i) {
    shape.poses.push_back(to_model_space(skeleton, motion.pose(shape_frame(i, frames))));
  }
  shape.middle = static_cast<std::size_t>(count / 2);
  const std::size_t joints = skeleton.joint_count();
  shape.children.resize(joints);
  shape.bones.resize(joints);
  shape.reach.resize(joints);
  shape.tips.resize(joints);
  for (const Tip& tip : skeleton.tips()) {
    Tip& longest = shape.tips[at(tip.joint)];
    if (tip.offset.norm() > std::max(1e-4f, longest.offset.norm())) longest = tip;
    shape.reach[at(tip.joint)] = longest.offset.norm();
  }
  for (std::size_t joint = joints; joint-- > 1;) {
    const JointIndex parent = skeleton.joint(static_cast<JointIndex>(joint)).parent;
    shape.bones[joint] = (shape.place(static_cast<JointIndex>(joint)) - shape.place(parent)).norm();
    shape.children[at(parent)].insert(shape.children[at(parent)].begin(), static_cast<JointIndex>(joint));
    shape.reach[at(parent)] = std::max(shape.reach[at(parent)], shape.branch(static_cast<JointIndex>(joint)));
  }
  shape.size = size_of(shape);
  return shape;
}

bool grows_from(const Skeleton& skeleton, JointIndex joint, JointIndex above) {
  while (joint > above) joint = skeleton.joint(joint).parent;
  return joint == above && joint != kNoJoint;
}

}  // namespace signweave
