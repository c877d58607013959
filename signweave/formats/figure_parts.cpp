#include <fmt/format.h>

#include <algorithm>
#include <string_view>

#include "signweave/core/text.h"
#include "signweave/formats/figure.h"

namespace signweave {
namespace {

bool contains(std::string_view text, std::string_view what) {
  return text.find(what) != std::string_view::npos;
}

BodySide side_of(std::string_view name, std::string_view folded) {
  if (contains(folded, "left")) return BodySide::left;
  if (contains(folded, "right")) return BodySide::right;
  // lHand, LHand, l_hand; hand_l, hand.L
  const auto apart = [](char c) { return c == '_' || c == '.' || c == '-' || c == ' '; };
  if (name.size() > 1) {
    const bool begins = apart(name[1]) || (name[1] >= 'A' && name[1] <= 'Z');
    const bool ends = apart(folded[folded.size() - 2]);
    if ((begins && folded.front() == 'l') || (ends && folded.back() == 'l')) return BodySide::left;
    if ((begins && folded.front() == 'r') || (ends && folded.back() == 'r')) return BodySide::right;
  }
  return BodySide::none;
}

/// Marks the arms that names did not tell: two long bones from each shoulder, and what is beyond them.
void arms_by_shape(const Skeleton& skeleton, const BodyPlan& body, std::vector<FigurePart>& parts) {
  const auto told = [](const FigurePart& part) { return part.arm && part.side != BodySide::none; };
  if (std::any_of(parts.begin(), parts.end(), told)) return;
  for (const JointIndex shoulder : body.shoulders) {
    std::vector<int> bones(parts.size(), -1);  // from the shoulder
    bones[static_cast<std::size_t>(shoulder)] = 0;
    const auto first = static_cast<std::size_t>(shoulder);
    const Eigen::Vector3f aside = body.place(shoulder) - body.place(body.trunk.front());
    if (parts[first].side == BodySide::none) {
      parts[first].side = aside.dot(body.left) > 0 ? BodySide::left : BodySide::right;
    }
    for (std::size_t i = first + 1; i < parts.size(); ++i) {
      const auto parent = static_cast<std::size_t>(skeleton.joints()[i].parent);
      if (bones[parent] < 0) continue;
      const bool twist = skeleton.joints()[i].offset.isZero();
      bones[i] = bones[parent] + (twist ? 0 : 1);
      parts[i].side = parts[first].side;
      parts[i].arm = bones[i] <= 2;
      parts[i].finger = bones[i] > 2;
      parts[i].palm = parts[i].finger && !parts[parent].finger;
    }
  }
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

FigurePlan figure_plan(const Motion& motion) {
  const Skeleton& skeleton = motion.skeleton();
  const BodyPlan body = plan_of(motion);
  const ModelPose& pose = body.pose;
  FigurePlan plan;
  if (!body.trunk.empty()) plan.hips = static_cast<std::size_t>(body.trunk.front());
  std::vector<bool> above_hips(skeleton.joint_count());  // what is drawn of them is nothing
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
  std::vector<bool> arm(count);  // arms stay even where they hang below the hips
  for (std::size_t i = 0; i < count; ++i) {
    const Joint& joint = skeleton.joints()[i];
    const std::string folded = fold_case(joint.name);
    FigurePart& part = parts[i];
    part.side = side_of(joint.name, folded);
    part.head = contains(folded, "head");
    part.eye = contains(folded, "eye") && !contains(folded, "eyebrow") && !contains(folded, "lid");
    if (joint.parent == kNoJoint) continue;
    const auto parent = static_cast<std::size_t>(joint.parent);
    const std::string above = fold_case(skeleton.joints()[parent].name);
    part.finger = parts[parent].finger || contains(above, "hand") || contains(above, "wrist");
    part.palm = part.finger && !parts[parent].finger;
    part.arm = !part.finger && contains(above, "arm");
    part.in_head = parts[parent].in_head || (parts[parent].head && !part.head);
    arm[i] = arm[parent] || contains(folded, "arm") || contains(folded, "shoulder") || contains(folded, "hand");
    const bool beside = body.trunk.size() > 1 && static_cast<std::size_t>(body.trunk[1]) != i;
    const bool low = highest[i] < pose.positions[plan.hips].y() + 0.03f * (top - bottom);
    const bool leg = parent == plan.hips && (low || beside);
    part.shown = (parts[parent].shown || parent == plan.hips) && !above_hips[parent] && (!leg || arm[i]);
    if (part.side == BodySide::none) part.side = parts[parent].side;
  }
  arms_by_shape(skeleton, body, parts);
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
  constexpr std::string_view kSides[] = {"Left", "Right"};
  for (std::size_t i = 0; i < 2; ++i) {
    const auto of = [&](std::string_view name) { return weight(fmt::format("{}{}", name, kSides[i])); };
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
