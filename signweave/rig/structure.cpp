#include "signweave/rig/structure.h"

#include "signweave/rig/joint_at.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace signweave {
namespace {

using Eigen::Vector3f;

/// Two similar branches of one joint: legs or arms.
struct Pair {
  JointIndex from = kNoJoint;
  std::array<JointIndex, 2> roots = {kNoJoint, kNoJoint};
};

std::vector<Pair> pairs_of(const BodyShape& shape) {
  std::vector<Pair> pairs;
  for (JointIndex joint = 0; at(joint) < shape.children.size(); ++joint) {
    std::vector<JointIndex> big;
    for (const JointIndex child : shape.below(joint)) {
      if (shape.branch(child) > 0.2f * shape.size) big.push_back(child);
    }
    Pair best{.from = joint};
    float least = 0.25f;
    for (std::size_t a = 0; a < big.size(); ++a) {
      for (std::size_t b = a + 1; b < big.size(); ++b) {
        const float one = shape.branch(big[a]);
        const float other = shape.branch(big[b]);
        const float unlike = std::abs(one - other) / std::max(one, other);
        if (unlike >= least) continue;
        least = unlike;
        best.roots = {big[a], big[b]};
      }
    }
    if (best.roots[0] != kNoJoint) pairs.push_back(best);
  }
  return pairs;
}

/// The joints along a limb up to the hand or foot, where it ends or forks into branches of which none is by far the
/// longest.
std::vector<JointIndex> path_from(const BodyShape& shape, JointIndex joint) {
  std::vector<JointIndex> path = {joint};
  while (!shape.below(joint).empty()) {
    JointIndex longest = kNoJoint;
    float second = 0;
    for (const JointIndex child : shape.below(joint)) {
      if (longest == kNoJoint || shape.branch(child) > shape.branch(longest)) {
        if (longest != kNoJoint) second = std::max(second, shape.branch(longest));
        longest = child;
      } else {
        second = std::max(second, shape.branch(child));
      }
    }
    if (second > 0.5f * shape.branch(longest)) break;
    joint = longest;
    path.push_back(joint);
  }
  return path;
}

/// The largest bend at the middle one of three points over the frames. Radians.
float bend(const BodyShape& shape, JointIndex before, JointIndex joint, JointIndex after) {
  float most = 0;
  for (const ModelPose& pose : shape.poses) {
    const Vector3f in = pose.positions[at(joint)] - pose.positions[at(before)];
    const Vector3f out = pose.positions[at(after)] - pose.positions[at(joint)];
    most = std::max(most, std::atan2(in.cross(out).norm(), in.dot(out)));
  }
  return most;
}

/// The two long bones of a limb, between which the body bends.
Limb limb_of(const BodyShape& shape, JointIndex root) {
  Limb limb{.root = root};
  std::vector<JointIndex> path;
  for (const JointIndex joint : path_from(shape, root)) {
    // Of several joints at one point, the last one moves the next bone.
    if (!path.empty() && shape.bones[at(joint)] < 0.004f * shape.size) {
      path.back() = joint;
    } else {
      path.push_back(joint);
    }
  }
  // In limbs split into halves, a joint that never bends is a twist joint.
  constexpr float kStraight = 0.03f;
  for (std::size_t i = 1; i + 1 < path.size() && path.size() > 4;) {
    if (shape.poses.size() > 4 && bend(shape, path[i - 1], path[i], path[i + 1]) < kStraight) {
      path.erase(path.begin() + static_cast<std::ptrdiff_t>(i));
    } else {
      ++i;
    }
  }
  const auto length = [&](std::size_t i) { return (shape.place(path[i]) - shape.place(path[i - 1])).norm(); };
  float longest = 0.12f * shape.size;
  for (std::size_t i = 0; i + 2 < path.size(); ++i) {
    const float upper = length(i + 1);
    const float lower = length(i + 2);
    // A long collar could pass for the upper arm: prefers later bones unless they are clearly shorter, since hands and
    // feet are short.
    if (upper + lower <= 0.8f * longest || std::min(upper, lower) < 0.4f * std::max(upper, lower)) continue;
    longest = upper + lower;
    limb.collar = i > 0 ? path[0] : kNoJoint;
    limb.upper = path[i];
    limb.lower = path[i + 1];
    limb.end = path[i + 2];
    limb.toes = i + 3 < path.size() ? path[i + 3] : kNoJoint;
  }
  return limb;
}

float height_of(const BodyShape& shape, JointIndex joint) {
  float sum = 0;
  for (const ModelPose& pose : shape.poses) sum += pose.positions[at(joint)].y();
  return sum / static_cast<float>(shape.poses.size());
}

/// The branch that leads to the head: the longest other child of the joint that carries the arms, or of its nearest
/// ancestor with such a child.
JointIndex neck_of(const Skeleton& skeleton, const BodyShape& shape, const Pair& arms) {
  JointIndex came = kNoJoint;
  for (JointIndex joint = arms.from; joint != kNoJoint; came = joint, joint = skeleton.joint(joint).parent) {
    JointIndex best = kNoJoint;
    for (const JointIndex child : shape.below(joint)) {
      if (child == came || (joint == arms.from && (child == arms.roots[0] || child == arms.roots[1]))) continue;
      if (shape.branch(child) < 0.05f * shape.size) continue;
      if (best == kNoJoint || shape.branch(child) > shape.branch(best)) best = child;
    }
    if (best != kNoJoint)
      return height_of(shape, best) >= height_of(shape, joint) - 0.05f * shape.size ? best : kNoJoint;
  }
  return kNoJoint;
}

/// Follows the neck to the joint that holds the skull: the first with an end or a fork.
JointIndex head_of(const BodyShape& shape, JointIndex neck) {
  JointIndex joint = neck;
  while (shape.below(joint).size() == 1 && !shape.has_tip(joint)) {
    const JointIndex next = shape.below(joint)[0];
    const bool end = shape.below(next).empty() && !shape.has_tip(next);
    if (end && joint != neck) break;  // the skull's end as a joint
    joint = next;
  }
  return joint;
}

bool are_arms(const BodyShape& shape, const Pair& pair) {
  // A neck and head are shorter than an arm; a trunk with its arms is longer than a leg, or nearly so.
  float third = 0;
  for (const JointIndex child : shape.below(pair.from)) {
    if (child != pair.roots[0] && child != pair.roots[1]) third = std::max(third, shape.branch(child));
  }
  return third > 0 && third < 0.8f * std::min(shape.branch(pair.roots[0]), shape.branch(pair.roots[1]));
}

}  // namespace

Structure structure_of(const Skeleton& skeleton, const BodyShape& shape) {
  Structure body;
  const std::vector<Pair> pairs = pairs_of(shape);
  std::optional<Pair> arms, legs;
  for (const Pair& pair : pairs) {
    const bool first = !arms || height_of(shape, pair.from) > height_of(shape, arms->from);
    if (are_arms(shape, pair) && first) arms = pair;
  }
  for (const Pair& pair : pairs) {
    if (arms && (pair.from == arms->from || grows_from(skeleton, pair.from, arms->roots[0]) ||
                 grows_from(skeleton, pair.from, arms->roots[1]))) {
      continue;
    }
    if (arms && height_of(shape, pair.from) > height_of(shape, arms->from)) continue;
    if (!legs) legs = pair;
  }
  const auto add = [&](const Pair& pair, std::vector<Limb>& limbs) {
    for (const JointIndex root : pair.roots) limbs.push_back(limb_of(shape, root));
    if (limbs[0].upper == kNoJoint || limbs[1].upper == kNoJoint) limbs.clear();
  };
  if (arms) add(*arms, body.arms);
  if (legs) add(*legs, body.legs);
  if (legs && !body.legs.empty()) body.pelvis = legs->from;
  if (!arms || body.arms.empty()) return body;
  body.chest = arms->from;
  body.neck = neck_of(skeleton, shape, *arms);
  if (body.neck != kNoJoint) {
    body.head = head_of(shape, body.neck);
    if (body.head == body.neck) body.neck = kNoJoint;
  }
  std::vector<JointIndex> trunk;  // from the chest down
  for (JointIndex joint = body.chest; joint != kNoJoint; joint = skeleton.joint(joint).parent) {
    trunk.push_back(joint);
    if (joint == body.pelvis) break;
  }
  if (body.pelvis == kNoJoint && trunk.size() > 1) {
    // Without legs, a root on the ground is recognised by its bone, which is longer than the whole trunk.
    const JointIndex top = body.neck != kNoJoint ? body.neck : body.chest;
    const JointIndex next = trunk[trunk.size() - 2];
    if (shape.bones[at(next)] > 1.2f * (shape.place(top) - shape.place(next)).norm() && trunk.size() > 2) {
      trunk.pop_back();
    }
    body.pelvis = trunk.back();
  }
  if (trunk.size() > 1) body.spine = trunk[trunk.size() - 2];
  return body;
}

}  // namespace signweave
