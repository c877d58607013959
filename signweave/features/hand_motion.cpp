#include "signweave/features/hand_motion.h"

#include <algorithm>
#include <cmath>

#include "signweave/features/contact.h"
#include "signweave/features/hand_points.h"
#include "signweave/features/smoothing.h"

namespace signweave {
namespace {

using Eigen::Vector3f;

/// One side of the body: its measured values and their sources.
struct Arm {
  Side side;
  HandPlaces places;
  PartPlace elbow;
  bool measured = false;
  std::vector<Vector3f> path;  ///< [frame - first of the window] signer-centred
  HandPoints points;           ///< of the current frame
  HandShell shell;             ///< of the current frame
};

float curvature_of(const PathDerivatives& at) {
  const float speed = at.velocity.norm();
  return speed < kLeastSpeed ? 0 : at.velocity.cross(at.acceleration).norm() / (speed * speed * speed);
}

/// The joints used: hands, shoulders and those that position the bodies' shells.
JointChains chains_of(const Motion& motion, const SignerModel& model, const std::array<Arm, 2>& arms) {
  std::vector<JointIndex> joints;
  for (const Part part :
       {Part::pelvis, Part::neck, Part::head, Part::head_top, Part::left_eye, Part::right_eye, Part::left_upper_arm,
        Part::right_upper_arm, Part::left_forearm, Part::right_forearm, Part::left_thigh, Part::right_thigh}) {
    if (model.rig.has(part)) joints.push_back(model.rig[part].joint);
  }
  joints.push_back(model.body->trunk);
  for (const Arm& arm : arms) arm.places.add_joints(joints);
  return JointChains(motion.skeleton(), joints);
}

TrunkFrame trunk_of(const RigMap& rig, const SignerSpace& space, const ModelPose& pose) {
  TrunkFrame trunk;
  if (rig.has(Part::pelvis)) {
    const Vector3f lean = space.turn_to_signer(space.origin - position_of(rig[Part::pelvis], pose));
    if (lean.norm() > 1e-6f) trunk.lean = lean.normalized();
  }
  if (rig.has(Part::left_thigh) && rig.has(Part::right_thigh)) {
    Vector3f across =
        space.turn_to_signer(position_of(rig[Part::left_thigh], pose) - position_of(rig[Part::right_thigh], pose));
    across.y() = 0;
    if (across.norm() > 1e-6f) trunk.twist = across.normalized().z();
  }
  return trunk;
}

/// Measures everything that does not need the path.
void measure_pose(const Arm& arm, const Arm& other, const BodyShell& body_shell, const SignerSpace& space,
                  const SignerBody& body, HandFrame& out) {
  if (arm.places.why_no_fingers().empty()) {
    const HandAxes axes = axes_of(arm.points, arm.side);
    out.palm = space.turn_to_signer(axes.palm);
    out.fingers = space.turn_to_signer(axes.fingers);
    out.handshape = handshape_of(arm.points, axes);
    out.openness = openness_of(out.handshape);
  }
  if (other.measured && touches(arm.shell, other.shell, body)) out.contact = out.contact | Contact::hands;
  if (body_shell.head && touches(arm.shell, *body_shell.head, body)) out.contact = out.contact | Contact::head;
  if (touches(arm.shell, body_shell.torso[0], body) || touches(arm.shell, body_shell.torso[1], body)) {
    out.contact = out.contact | Contact::torso;
  }
}

}  // namespace

HandMotion measure_hands(const Motion& motion, const SignerModel& model, FrameRange range) {
  HandMotion result;
  result.range = clamp(range, motion.frame_count());
  std::array<Arm, 2> arms = {Arm{.side = Side::left, .places = HandPlaces(model.rig, Side::left)},
                             Arm{.side = Side::right, .places = HandPlaces(model.rig, Side::right)}};
  std::string why_not = why_no_signer_space(model.rig);
  if (why_not.empty() && !model.body) why_not = "the shoulders are in one place, or the motion has no frames";
  for (Arm& arm : arms) {
    HandMotion::OneHand& hand = result.hands[static_cast<std::size_t>(arm.side)];
    hand.why_no_fingers = arm.places.why_no_fingers();
    hand.why_not = why_not;
    if (why_not.empty() && !arm.places.has_wrist()) {
      hand.why_not = arm.side == Side::left ? "no left wrist" : "no right wrist";
    }
    arm.measured = hand.why_not.empty();
    arm.elbow = model.rig[of(arm.side, Part::left_forearm)];
    if (arm.measured) hand.frames.resize(static_cast<std::size_t>(std::max<std::int64_t>(result.range.size(), 0)));
  }
  if (result.range.empty() || (!arms[0].measured && !arms[1].measured)) return result;

  const SignerBody& body = *model.body;
  const Smoother smoother(kSmoothing, motion.rate(), motion.frame_count());
  const FrameRange seen = smoother.window(result.range);
  const JointChains chains = chains_of(motion, model, arms);
  const bool both = arms[0].measured && arms[1].measured;
  for (Arm& arm : arms) {
    if (arm.measured) arm.path.reserve(static_cast<std::size_t>(seen.size()));
  }
  if (both) result.hands_distance.reserve(static_cast<std::size_t>(result.range.size()));
  ModelPose pose;
  for (std::int64_t frame = seen.begin; frame < seen.end; ++frame) {
    const bool wanted = frame >= result.range.begin && frame < result.range.end;
    chains.to_model_space(motion.pose(frame), pose);
    const SignerSpace space = signer_space(body, model.rig, pose);
    std::array<Vector3f, 2> palms;
    for (Arm& arm : arms) {
      if (!arm.measured) continue;
      arm.places.read(pose, arm.points);
      palms[static_cast<std::size_t>(arm.side)] = palm_of(arm.points);
      arm.path.push_back(space.to_signer(palms[static_cast<std::size_t>(arm.side)]));
      if (!wanted) continue;
      arm.shell =
          shell_of(arm.points, arm.elbow.known() ? std::optional(position_of(arm.elbow, pose)) : std::nullopt, body);
    }
    if (!wanted) continue;
    const BodyShell body_shell = shell_of(body, model.rig, space, pose);
    for (std::size_t i = 0; i < 2; ++i) {
      if (!arms[i].measured) continue;
      HandFrame& out = result.hands[i].frames[static_cast<std::size_t>(frame - result.range.begin)];
      measure_pose(arms[i], arms[1 - i], body_shell, space, body, out);
    }
    for (std::size_t i = 0; i < 2; ++i) {
      if (!arms[i].measured || !arms[i].elbow.known()) continue;
      HandFrame& out = result.hands[i].frames[static_cast<std::size_t>(frame - result.range.begin)];
      out.elbow = space.to_signer(position_of(arms[i].elbow, pose));
    }
    result.trunk.push_back(trunk_of(model.rig, space, pose));
    if (both) result.hands_distance.push_back((palms[0] - palms[1]).norm());
  }
  for (const Arm& arm : arms) {
    if (!arm.measured) continue;
    for (std::int64_t frame = result.range.begin; frame < result.range.end; ++frame) {
      HandFrame& out =
          result.hands[static_cast<std::size_t>(arm.side)].frames[static_cast<std::size_t>(frame - result.range.begin)];
      PathDerivatives at = smoother.at(frame, arm.path, seen.begin);
      at.velocity *= body.shoulder_width;
      at.acceleration *= body.shoulder_width;
      out.position = arm.path[static_cast<std::size_t>(frame - seen.begin)];
      out.velocity = at.velocity;
      out.acceleration = at.acceleration;
      out.curvature = curvature_of(at);
    }
  }
  return result;
}

}  // namespace signweave
