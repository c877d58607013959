#pragma once

// For tests: rig maps made by hand, and a person with whole hands.

#include <fmt/format.h>

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "signweave/rig/rig_map.h"

namespace signweave {

/// A map of those names that the skeleton has.
inline RigMap rig_of_names(const Skeleton& skeleton, const std::vector<std::pair<Part, std::string>>& names) {
  RigMap rig;
  for (const auto& [part, name] : names) {
    if (const auto joint = skeleton.find(name)) {
      rig[part] = {.joint = *joint, .evidence = Evidence::name, .confidence = 1};
    }
  }
  return rig;
}

/// A point that moves with a joint: that joint's first tip.
inline void place_tip(const Skeleton& skeleton, Part part, JointIndex joint, RigMap& rig) {
  for (const Tip& tip : skeleton.tips()) {
    if (tip.joint != joint) continue;
    rig[part] = {.joint = joint, .offset = tip.offset, .evidence = Evidence::structure, .confidence = 1};
    return;
  }
}

/// The map of a skeleton with the names of the made signer (demo/signer.h) or of `whole_person` below.
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
                               {of(side, Part::left_thigh), name + "UpLeg"}});
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

}  // namespace signweave
