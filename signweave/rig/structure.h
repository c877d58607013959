#pragma once

#include <array>
#include <vector>

#include "signweave/rig/body_shape.h"
#include "signweave/rig/part.h"

namespace signweave {

/// An arm or a leg, identified by its bones. kNoJoint for a joint that it lacks.
struct Limb {
  JointIndex root = kNoJoint;    ///< where it leaves the trunk; may equal one of the next two
  JointIndex collar = kNoJoint;  ///< arms only
  JointIndex upper = kNoJoint;   ///< shoulder or hip
  JointIndex lower = kNoJoint;   ///< elbow or knee
  JointIndex end = kNoJoint;     ///< wrist or ankle
  JointIndex toes = kNoJoint;    ///< legs only
};

/// A body identified by its shape alone.
struct Structure {
  std::vector<Limb> arms;  ///< up to two; which one is the left is not determined
  std::vector<Limb> legs;
  JointIndex pelvis = kNoJoint;
  JointIndex spine = kNoJoint;
  JointIndex chest = kNoJoint;
  JointIndex neck = kNoJoint;
  JointIndex head = kNoJoint;
};
Structure structure_of(const Skeleton& skeleton, const BodyShape& shape);

/// The joints of one finger below a wrist, by shape: [point], kNoJoint if there is none.
using FingerChain = std::array<JointIndex, kFingerPoints>;
/// The joints at which at least four fingers leave the palm, in no order; empty if fewer chains of joints grow from the
/// hand.
std::vector<JointIndex> knuckles_of(const Skeleton& skeleton, const BodyShape& shape, JointIndex hand);
/// The fingers of a hand in order from the thumb. Empty if there are not four or five fingers, or if no thumb shows at
/// which end to start.
std::vector<std::pair<Finger, FingerChain>> fingers_of(const Skeleton& skeleton, const BodyShape& shape,
                                                       JointIndex hand);

}  // namespace signweave
