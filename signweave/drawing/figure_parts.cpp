#include <fmt/format.h>

#include <algorithm>
#include <string_view>

#include "signweave/drawing/figure.h"
#include "signweave/rig/body_shape.h"

namespace signweave {
namespace {

/// Copies what the map says about each joint.
void take_map(const RigMap& rig, std::vector<FigurePart>& parts) {
  const auto place_side = [&](Part part, BodySide side) {
    if (rig.has(part)) parts[static_cast<std::size_t>(rig[part].joint)].side = side;
  };
  for (const Side side : kSides) {
    const BodySide drawn = side == Side::left ? BodySide::left : BodySide::right;
    for (const Part part : {Part::left_eye, Part::left_clavicle, Part::left_upper_arm, Part::left_forearm,
                            Part::left_hand, Part::left_thigh, Part::left_shin, Part::left_foot, Part::left_toes}) {
      place_side(of(side, part), drawn);
    }
    if (rig.has(of(side, Part::left_eye))) {
      parts[static_cast<std::size_t>(rig[of(side, Part::left_eye)].joint)].eye = true;
    }
  }
  for (const Part part : {Part::head, Part::head_top}) {
    if (rig.has(part)) parts[static_cast<std::size_t>(rig[part].joint)].head = true;
  }
}

/// [joint] 'a' within an arm, 'l' within a leg or between the root and one, else ' '.
std::vector<char> limbs_of(const Skeleton& skeleton, const RigMap& rig) {
  std::vector<char> limbs(skeleton.joint_count(), ' ');
  for (const Side side : kSides) {
    for (const Part part : {Part::left_clavicle, Part::left_upper_arm, Part::left_forearm, Part::left_hand}) {
      if (rig.has(of(side, part))) limbs[static_cast<std::size_t>(rig[of(side, part)].joint)] = 'a';
    }
    if (!rig.has(Part::pelvis) || !rig.has(of(side, Part::left_thigh))) continue;
    const JointIndex thigh = rig[of(side, Part::left_thigh)].joint;
    if (!grows_from(skeleton, thigh, rig[Part::pelvis].joint)) continue;
    for (JointIndex joint = thigh; joint != rig[Part::pelvis].joint; joint = skeleton.joint(joint).parent) {
      limbs[static_cast<std::size_t>(joint)] = 'l';
    }
  }
  for (std::size_t i = 1; i < limbs.size(); ++i) {
    if (limbs[i] == ' ') limbs[i] = limbs[static_cast<std::size_t>(skeleton.joints()[i].parent)];
  }
  return limbs;
}

std::optional<FigureHead> figure_head(const Skeleton& skeleton, const BodyPlan& body) {
  if (!body.head) return std::nullopt;
  const auto joint = static_cast<std::size_t>(body.head->joint);
  const Eigen::Quaternionf back = body.pose.rotations[joint].conjugate();
  FigureHead head{.joint = body.head->joint, .left = back * body.head->left, .up = {}};
  for (std::size_t i = 0; i < skeleton.tips().size(); ++i) {
    const Eigen::Vector3f& end = body.tip_bones[i];
    if (skeleton.tips()[i].joint == head.joint && end.dot(body.head->up) < 0.5f * end.norm()) {
      head.up = back * body.head->up;
    }
  }
  return head;
}

}  // namespace

FigurePlan figure_plan(const Motion& motion, const RigMap& rig) {
  const Skeleton& skeleton = motion.skeleton();
  const BodyPlan body = plan_of(motion, rig);
  const ModelPose& pose = body.pose;
  FigurePlan plan;
  if (!body.trunk.empty()) plan.hips = static_cast<std::size_t>(body.trunk.front());
  std::vector<bool> above_hips(skeleton.joint_count());  // joints that are not drawn
  for (JointIndex joint = skeleton.joint(static_cast<JointIndex>(plan.hips)).parent; joint != kNoJoint;
       joint = skeleton.joint(joint).parent) {
    above_hips[static_cast<std::size_t>(joint)] = true;
  }
  const std::size_t count = skeleton.joint_count();
  std::vector<FigurePart>& parts = plan.parts;
  parts.resize(count);
  std::vector<float> highest(count);
  float top = pose.positions[0].y();
  float bottom = top;
  for (std::size_t i = 0; i < count; ++i) {
    highest[i] = pose.positions[i].y();
    top = std::max(top, highest[i]);
    bottom = std::min(bottom, highest[i]);
  }
  for (std::size_t i = count; i-- > 1;) {
    float& parent = highest[static_cast<std::size_t>(skeleton.joints()[i].parent)];
    parent = std::max(parent, highest[i]);
  }
  take_map(rig, parts);
  const std::vector<char> limbs = limbs_of(skeleton, rig);
  std::vector<bool> beyond_shoulder(count);
  for (std::size_t i = 0; i < count; ++i) {
    const Joint& joint = skeleton.joints()[i];
    FigurePart& part = parts[i];
    const auto plays = [&](Part left, JointIndex who) {
      return rig[of(Side::left, left)].joint == who || rig[of(Side::right, left)].joint == who;
    };
    beyond_shoulder[i] = plays(Part::left_upper_arm, static_cast<JointIndex>(i));
    if (joint.parent == kNoJoint) continue;
    const auto parent = static_cast<std::size_t>(joint.parent);
    beyond_shoulder[i] = beyond_shoulder[i] || beyond_shoulder[parent];
    part.finger = parts[parent].finger || plays(Part::left_hand, joint.parent);
    part.palm = part.finger && !parts[parent].finger;
    part.arm = !part.finger && beyond_shoulder[parent];
    part.in_head = parts[parent].in_head || (parts[parent].head && !part.head);
    // If the map has no legs, limbs that start next to the trunk and are low count as legs; arms stay arms even if they
    // hang down.
    const bool next_to_trunk = body.trunk.size() > 1 && static_cast<std::size_t>(body.trunk[1]) != i;
    const bool low = highest[i] < pose.positions[plan.hips].y() + 0.03f * (top - bottom);
    const bool leg = limbs[i] == 'l' || (parent == plan.hips && (low || next_to_trunk));
    part.shown = (parts[parent].shown || parent == plan.hips) && !above_hips[parent] && (!leg || limbs[i] == 'a');
    if (part.side == BodySide::none) part.side = parts[parent].side;
  }
  plan.head = figure_head(skeleton, body);
  return plan;
}

FigureFace figure_face(const Motion& motion, std::int64_t frame) {
  const auto weight = [&](std::string_view name) {
    for (const ScalarTrack& track : motion.tracks()) {
      if (track.name == name) return std::clamp(track.values[static_cast<std::size_t>(frame)], 0.0f, 1.0f);
    }
    return 0.0f;
  };
  FigureFace face;
  face.known = std::any_of(motion.tracks().begin(), motion.tracks().end(), [](const ScalarTrack& track) {
    return track.name == "jawOpen" || track.name == "eyeBlinkLeft" || track.name == "browInnerUp";
  });
  face.brow_inner_up = weight("browInnerUp");
  face.jaw = weight("jawOpen");
  face.close = weight("mouthClose");
  face.funnel = weight("mouthFunnel");
  face.pucker = weight("mouthPucker");
  face.puff = weight("cheekPuff");
  face.press = std::max(weight("mouthPressLeft"), weight("mouthPressRight"));
  constexpr std::string_view kSideNames[] = {"Left", "Right"};
  for (std::size_t i = 0; i < 2; ++i) {
    const auto of = [&](std::string_view name) { return weight(fmt::format("{}{}", name, kSideNames[i])); };
    face.brow_up[i] = of("browOuterUp");
    face.brow_down[i] = of("browDown");
    face.blink[i] = of("eyeBlink");
    face.wide[i] = of("eyeWide");
    face.squint[i] = of("eyeSquint");
    face.smile[i] = of("mouthSmile");
    face.stretch[i] = of("mouthStretch");
  }
  return face;
}

}  // namespace signweave
