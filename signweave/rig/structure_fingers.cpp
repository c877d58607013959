#include <algorithm>
#include <cmath>

#include "signweave/rig/joint_at.h"
#include "signweave/rig/structure.h"

namespace signweave {
namespace {

using Eigen::Vector3f;

/// The joints from a wrist to one end; joints that lead to several ends are left out.
struct Chain {
  std::vector<JointIndex> joints;
  bool ends = false;  ///< the last joint has a tip
};

std::vector<Chain> chains_of(const Skeleton& skeleton, const BodyShape& shape, JointIndex hand) {
  std::vector<Chain> chains;
  const auto leads_to_one = [&](JointIndex joint) {
    while (shape.below(joint).size() == 1) joint = shape.below(joint)[0];
    return shape.below(joint).empty();
  };
  for (JointIndex joint = hand + 1; at(joint) < shape.children.size(); ++joint) {
    if (!shape.below(joint).empty() || !grows_from(skeleton, joint, hand)) continue;
    Chain chain{.joints = {}, .ends = shape.has_tip(joint)};
    for (JointIndex at_joint = joint; at_joint != hand && leads_to_one(at_joint);
         at_joint = skeleton.joint(at_joint).parent) {
      chain.joints.insert(chain.joints.begin(), at_joint);
    }
    // A joint of the palm, a prop or a point of no length is not a finger.
    if (chain.joints.size() < 2) continue;
    chains.push_back(std::move(chain));
  }
  return chains;
}

/// The joint at which the finger leaves the palm: of four joints before a tip, the first is inside the palm.
JointIndex knuckle_of(const Chain& chain) {
  return chain.joints[chain.joints.size() > 3 && chain.ends ? chain.joints.size() - 3 : 0];
}

FingerChain points_of(const BodyShape& shape, const Chain& chain, JointIndex hand, bool thumb) {
  FingerChain points;
  points.fill(kNoJoint);
  std::vector<JointIndex> joints = chain.joints;
  const float first = (shape.place(joints[0]) - shape.place(hand)).norm();
  const float second = (shape.place(joints[1]) - shape.place(hand)).norm();
  // A joint inside the palm is nearer to the wrist than to the knuckle.
  if (!thumb && joints.size() > 3 && first < 0.6f * second) {
    points[0] = joints.front();
    joints.erase(joints.begin());
  }
  const bool tip = !chain.ends && joints.size() > 3;
  for (std::size_t i = 0; i < joints.size() && i < 3; ++i) points[i + 1] = joints[i];
  if (tip) points[4] = joints[3];
  return points;
}

}  // namespace

std::vector<JointIndex> knuckles_of(const Skeleton& skeleton, const BodyShape& shape, JointIndex hand) {
  std::vector<JointIndex> knuckles;
  for (const Chain& chain : chains_of(skeleton, shape, hand)) knuckles.push_back(knuckle_of(chain));
  if (knuckles.size() < 4) knuckles.clear();
  return knuckles;
}

std::vector<std::pair<Finger, FingerChain>> fingers_of(const Skeleton& skeleton, const BodyShape& shape,
                                                       JointIndex hand) {
  std::vector<Chain> chains = chains_of(skeleton, shape, hand);
  if (chains.size() < 4 || chains.size() > 5) return {};
  // Sorts by where each finger leaves the palm: the thumb does so nearest to the wrist, apart from the others.
  const Vector3f wrist = shape.place(hand);
  const auto knuckle = [&](const Chain& chain) { return shape.place(knuckle_of(chain)); };
  std::sort(chains.begin(), chains.end(),
            [&](const Chain& a, const Chain& b) { return (knuckle(a) - wrist).norm() < (knuckle(b) - wrist).norm(); });
  if ((knuckle(chains[0]) - wrist).norm() > 0.75f * (knuckle(chains[1]) - wrist).norm()) return {};
  // Sorts the others by their distance from the thumb's second joint, which is next to the index finger.
  const Vector3f thumb = shape.place(chains[0].joints[1]);
  std::sort(chains.begin() + 1, chains.end(),
            [&](const Chain& a, const Chain& b) { return (knuckle(a) - thumb).norm() < (knuckle(b) - thumb).norm(); });
  std::vector<std::pair<Finger, FingerChain>> fingers;
  for (std::size_t i = 0; i < chains.size(); ++i) {
    fingers.emplace_back(static_cast<Finger>(i), points_of(shape, chains[i], hand, i == 0));
  }
  return fingers;
}

}  // namespace signweave
