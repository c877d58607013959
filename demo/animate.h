#pragma once

#include "demo/arms.h"
#include "demo/body.h"
#include "demo/face.h"
#include "demo/plan.h"
#include "demo/signer.h"
#include "signweave/motion/motion.h"

namespace signweave::demo {

/// Generates the motion of a timeline with the scalar tracks of its face: arms by inverse kinematics to the wrists of
/// the plan, hands interpolated between handshapes, and a body with planted feet that breathes, follows the hands and
/// looks. `plan` must be that of `timeline`.
Motion animate(const Signer& signer, const Timeline& timeline, const HandPlan& plan, Random& random);

/// The same with a given body and face, which have one frame each for every frame of the motion.
Motion animate(const Signer& signer, FrameRate rate, std::vector<BodyFrame> body, FaceMotion face, const HandPlan& plan,
               Random& random);

/// The same with hands that are wanted in signer-centred space; `plan` only says what they touch.
Motion animate(const Signer& signer, FrameRate rate, std::vector<BodyFrame> body, FaceMotion face, const HandPlan& plan,
               SignerHands hands, Random& random);

}  // namespace signweave::demo
