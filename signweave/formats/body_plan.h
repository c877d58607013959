#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "signweave/motion/motion.h"

/// What a skeleton is a skeleton of, told from its shape alone: no table of names. For drawing only, so a wrong answer
/// makes an odd picture and nothing else.
namespace signweave {

/// The head as an ellipsoid, in its joint's space.
struct HeadShape {
  JointIndex joint = kNoJoint;
  Eigen::Vector3f centre = Eigen::Vector3f::Zero();
  Eigen::Vector3f left = Eigen::Vector3f::UnitX();  ///< of the person; unit, as are the next two
  Eigen::Vector3f up = Eigen::Vector3f::UnitY();
  Eigen::Vector3f forward = Eigen::Vector3f::UnitZ();
  Eigen::Vector3f half = Eigen::Vector3f::Zero();  ///< metres along left, up, forward
};

/// A joint from which fingers grow.
struct HandShape {
  JointIndex joint = kNoJoint;
  std::vector<JointIndex> knuckles;  ///< where fingers leave the palm; at least four
};

struct BodyPlan {
  std::vector<Eigen::Vector3f> offsets;    ///< [joint] from its parent in the bind pose, metres
  std::vector<Eigen::Vector3f> positions;  ///< [joint] in the bind pose's model space, metres
  std::vector<std::vector<JointIndex>> children;
  float size = 1;                                   ///< largest extent of the bind pose, metres; above 0
  Eigen::Vector3f left = Eigen::Vector3f::UnitX();  ///< unit, in the bind pose
  Eigen::Vector3f up = Eigen::Vector3f::UnitY();
  Eigen::Vector3f forward = Eigen::Vector3f::UnitZ();
  std::vector<JointIndex> trunk;  ///< from the hips to the chest; empty where no chest was found
  JointIndex neck = kNoJoint;     ///< child of the chest that leads to the head
  float hip_width = 0;            ///< half the distance between the legs, metres
  float shoulder_width = 0;       ///< half the distance between the arms
  std::optional<HeadShape> head;
  std::vector<HandShape> hands;
};

/// The plan of a motion of at least one frame: its bind pose has every rotation the identity and the translations of
/// frame 0. `head` says which joint is the head, where the caller knows.
BodyPlan plan_of(const Motion& motion, std::optional<JointIndex> head = {});

}  // namespace signweave
