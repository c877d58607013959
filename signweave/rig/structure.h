#pragma once

#include <array>
#include <vector>

#include "signweave/rig/body_shape.h"
#include "signweave/rig/part.h"

namespace signweave {

/// An arm or a leg, told by its bones. kNoJoint where it has no such joint.
struct Limb {
  JointIndex root = kNoJoint;    ///< where it leaves the trunk; may be any of the next two
  JointIndex collar = kNoJoint;  ///< of an arm
  JointIndex upper = kNoJoint;   ///< shoulder or hip
  JointIndex lower = kNoJoint;   ///< elbow or knee
  JointIndex end = kNoJoint;     ///< wrist or ankle
  JointIndex toes = kNoJoint;    ///< of a leg
};

/// A body told from its shape alone.
struct Structure {
  std::vector<Limb> arms;  ///< two, one or none; which is the left one is not said
  std::vector<Limb> legs;
  JointIndex pelvis = kNoJoint;
  JointIndex spine = kNoJoint;
  JointIndex chest = kNoJoint;
  JointIndex neck = kNoJoint;
  JointIndex head = kNoJoint;
};
Structure structure_of(const Skeleton& skeleton, const BodyShape& shape);

/// The joints of one finger beneath a wrist, by shape: [point], kNoJoint where there is none.
using FingerChain = std::array<JointIndex, kFingerPoints>;
/// Where at least four fingers leave the palm, in no order; empty where fewer chains of joints grow from the hand.
std::vector<JointIndex> knuckles_of(const Skeleton& skeleton, const BodyShape& shape, JointIndex hand);
/// By order from the thumb. Empty where no four or five fingers are seen, or no thumb tells which end is which.
std::vector<std::pair<Finger, FingerChain>> fingers_of(const Skeleton& skeleton, const BodyShape& shape,
                                                       JointIndex hand);

}  // namespace signweave
