#pragma once

// For tests: rig maps built by hand, and a person with complete hands.

#include <fmt/format.h>

#include <cmath>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "signweave/rig/rig_map.h"

namespace signweave {

/// A map of those of the given names that the skeleton has.
inline RigMap rig_of_names(const Skeleton& skeleton, const std::vector<std::pair<Part, std::string>>& names) {
  RigMap rig;
  for (const auto& [part, name] : names) {
    if (const auto joint = skeleton.find(name)) {
      rig[part] = {.joint = *joint, .evidence = Evidence::name, .confidence = 1};
    }
  }
  return rig;
}

/// Places a part at a joint's first tip.
inline void place_tip(const Skeleton& skeleton, Part part, JointIndex joint, RigMap& rig) {
  for (const Tip& tip : skeleton.tips()) {
    if (tip.joint != joint) continue;
    rig[part] = {.joint = joint, .offset = tip.offset, .evidence = Evidence::structure, .confidence = 1};
    return;
  }
}

/// The map of a skeleton with the names of the synthetic signer (demo/signer.h) or of `whole_person` below.
inline RigMap rig_of_signer(const Skeleton& skeleton) {
  std::vector<std::pair<Part, std::string>> names = {
      {Part::pelvis, "Hips"}, {Part::spine, "Spine"},      {Part::chest, "Spine2"},      {Part::neck, "Neck"},
      {Part::head, "Head"},   {Part::left_eye, "LeftEye"}, {Part::right_eye, "RightEye"}};
  const char* const fingers[] = {"Thumb", "Index", "Middle", "Ring", "Pinky"};
  for (const Side side : kSides) {
    const std::string name = side == Side::left ? "Left" : "Right";
    names.insert(names.end(), {{of(side, Part::left_clavicle), name + "Shoulder"},
                               {of(side, Part::left_upper_arm), name + "Arm"},
                               {of(side, Part::left_forearm), name + "ForeArm"},
                               {of(side, Part::left_hand), name + "Hand"},
                               {of(side, Part::left_thigh), name + "UpLeg"},
                               {of(side, Part::left_shin), name + "Leg"},
                               {of(side, Part::left_foot), name + "Foot"}});
    for (const Finger finger : kFingers) {
      for (int i = 1; i <= 3; ++i) {
        names.emplace_back(finger_part(side, finger, static_cast<FingerPoint>(i)),
                           fmt::format("{}Hand{}{}", name, fingers[static_cast<std::size_t>(finger)], i));
      }
    }
  }
  RigMap rig = rig_of_names(skeleton, names);
  if (rig.has(Part::head)) place_tip(skeleton, Part::head_top, rig[Part::head].joint, rig);
  for (const Side side : kSides) {
    for (const Finger finger : kFingers) {
      const PartPlace& last = rig[finger_part(side, finger, FingerPoint::distal)];
      if (last.known()) place_tip(skeleton, finger_part(side, finger, FingerPoint::tip), last.joint, rig);
    }
  }
  return rig;
}

/// A person of 1.70 m (times `scale`) who faces along z in the rest pose, arms out, palms down. Names are those of the
/// synthetic signer (demo/signer.h); the arms may be translated, as some rigs allow.
inline std::shared_ptr<const Skeleton> whole_person(float scale = 1, bool fingers = true) {
  std::vector<Joint> joints = {{"Hips", kNoJoint, {0, 0.95f, 0}, true},
                               {"Spine", 0, {0, 0.15f, 0}, false},
                               {"Spine2", 1, {0, 0.15f, 0}, false},
                               {"Neck", 2, {0, 0.19f, 0}, false},
                               {"Head", 3, {0, 0.08f, 0}, false},
                               {"LeftEye", 4, {0.03f, 0.08f, 0.08f}, false},
                               {"RightEye", 4, {-0.03f, 0.08f, 0.08f}, false}};
  std::vector<Tip> tips = {{4, {0, 0.19f, 0}}};
  const auto add = [&](const std::string& name, JointIndex parent, const Eigen::Vector3f& offset) {
    joints.push_back({name, parent, offset, false});
    return static_cast<JointIndex>(joints.size()) - 1;
  };
  const char* const names[] = {"Thumb", "Index", "Middle", "Ring", "Pinky"};
  for (const float side : {1.0f, -1.0f}) {
    const std::string name = side > 0 ? "Left" : "Right";
    const auto at = [&](float x, float y, float z) { return Eigen::Vector3f(side * x, y, z); };
    const JointIndex clavicle = add(name + "Shoulder", 2, at(0.03f, 0.13f, 0));
    const JointIndex arm = add(name + "Arm", clavicle, at(0.15f, 0, 0));
    joints.back().translated = true;
    const JointIndex hand = add(name + "Hand", add(name + "ForeArm", arm, at(0.28f, 0, 0)), at(0.25f, 0, 0));
    for (int finger = 0; fingers && finger < 5; ++finger) {
      const bool thumb = finger == 0;
      const float z = 0.04f - 0.02f * static_cast<float>(finger);
      const Eigen::Vector3f bone = thumb ? at(0.03f, 0, 0.025f) : at(0.03f, 0, 0);
      JointIndex joint = hand;
      for (int i = 1; i <= 3; ++i) {
        joint = add(fmt::format("{}Hand{}{}", name, names[finger], i), joint,
                    i > 1   ? bone
                    : thumb ? at(0.02f, 0, 0.025f)
                            : at(0.09f, 0, z));
      }
      tips.push_back({joint, 0.8f * bone});
    }
  }
  for (const float side : {1.0f, -1.0f}) add(side > 0 ? "LeftUpLeg" : "RightUpLeg", 0, {0.09f * side, -0.04f, 0});
  for (Joint& joint : joints) joint.offset *= scale;
  for (Tip& tip : tips) tip.offset *= scale;
  return std::make_shared<const Skeleton>(std::move(joints), std::move(tips));
}

/// A moving person: every joint except the root turns to and fro, each in its own pattern, the arms farthest. Equal
/// seeds give equal movement.
inline Motion moving(std::shared_ptr<const Skeleton> skeleton, std::int64_t frames, unsigned seed = 1,
                     FrameRate rate = {100, 1}) {
  Motion motion(std::move(skeleton), rate, frames);
  for (std::size_t joint = 1; joint < motion.skeleton().joint_count(); ++joint) {
    const bool arm = motion.skeleton().joints()[joint].name.find("Arm") != std::string::npos;
    const float own = static_cast<float>(joint) * 1.7f + static_cast<float>(seed % 1000) * 0.9f;
    const Eigen::Vector3f axis = Eigen::Vector3f(std::sin(own), std::sin(2 * own + 1), std::sin(3 * own)).normalized();
    for (std::int64_t frame = 0; frame < frames; ++frame) {
      const auto seconds = static_cast<float>(static_cast<double>(frame) / rate.hertz());
      motion.pose(frame).rotations[joint] = Eigen::AngleAxisf((arm ? 0.8f : 0.15f) * std::sin(own + 5 * seconds), axis);
    }
  }
  return motion;
}

/// The same motion with the whole body turned about the vertical and shifted. The root must be translated.
inline Motion placed(Motion motion, float turn, const Eigen::Vector3f& shift) {
  const Eigen::Quaternionf turned(Eigen::AngleAxisf(turn, Eigen::Vector3f::UnitY()));
  for (std::int64_t frame = 0; frame < motion.frame_count(); ++frame) {
    const auto pose = motion.pose(frame);
    pose.rotations[0] = turned * pose.rotations[0];
    pose.translations[0] = turned * pose.translations[0] + shift;
  }
  return motion;
}

/// The motion mirrored by x → −x: each joint moves as its namesake on the other side did.
inline Motion in_mirror(const Motion& motion) {
  const Skeleton& skeleton = motion.skeleton();
  const auto other = [&](std::size_t joint) {
    std::string name = skeleton.joints()[joint].name;
    if (name.starts_with("Left")) {
      name.replace(0, 4, "Right");
    } else if (name.starts_with("Right")) {
      name.replace(0, 5, "Left");
    }
    return *skeleton.find(name);
  };
  Motion result = motion;
  for (std::int64_t frame = 0; frame < motion.frame_count(); ++frame) {
    for (std::size_t joint = 0; joint < skeleton.joint_count(); ++joint) {
      const Eigen::Quaternionf& q = motion.pose(frame).rotations[static_cast<std::size_t>(other(joint))];
      result.pose(frame).rotations[joint] = {q.w(), q.x(), -q.y(), -q.z()};
    }
    for (std::size_t i = 0; i < skeleton.translation_count(); ++i) {
      const JointIndex joint = other(static_cast<std::size_t>(skeleton.translated_joints()[i]));
      Eigen::Vector3f place = motion.pose(frame).translations[*skeleton.translation_of(joint)];
      place.x() = -place.x();
      result.pose(frame).translations[i] = place;
    }
  }
  return result;
}

}  // namespace signweave
