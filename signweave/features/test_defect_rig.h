#pragma once

#include <initializer_list>
#include <string_view>

#include "signweave/rig/rig_map.h"

namespace signweave {

/// A rig map for tests, built by hand: the parts that defect detection needs, under the names used in the demo and the
/// real files.
inline RigMap rig_by_hand(const Skeleton& skeleton) {
  struct Row {
    Part part;
    std::initializer_list<std::string_view> names;
  };
  // Biovision names: "LeftShoulder" is the shoulder if there is a "LeftCollar"; elsewhere it is the clavicle.
  const bool collar = skeleton.find("LeftCollar").has_value();
  const Row rows[] = {
      {Part::head, {"Head", "mixamorig_Head"}},
      {Part::neck, {"Neck", "mixamorig_Neck"}},
      {Part::left_upper_arm, {collar ? "LeftShoulder" : "LeftArm", "mixamorig_LeftArm", "UpperArm_L"}},
      {Part::right_upper_arm, {collar ? "RightShoulder" : "RightArm", "mixamorig_RightArm", "UpperArm_R"}},
      {Part::left_forearm, {"LeftForeArm", "LeftElbow", "mixamorig_LeftForeArm", "LowerArm_L"}},
      {Part::right_forearm, {"RightForeArm", "RightElbow", "mixamorig_RightForeArm", "LowerArm_R"}},
      {Part::left_hand, {"LeftHand", "LeftWrist", "mixamorig_LeftHand", "Hand_L"}},
      {Part::right_hand, {"RightHand", "RightWrist", "mixamorig_RightHand", "Hand_R"}},
      {Part::left_foot, {"LeftFoot", "LeftAnkle", "mixamorig_LeftFoot", "Foot_L"}},
      {Part::right_foot, {"RightFoot", "RightAnkle", "mixamorig_RightFoot", "Foot_R"}},
  };
  RigMap rig;
  for (const Row& row : rows) {
    for (const std::string_view name : row.names) {
      const auto joint = skeleton.find(name);
      if (!joint) continue;
      rig[row.part] = {.joint = *joint, .evidence = Evidence::file, .confidence = 1};
      break;
    }
  }
  return rig;
}

}  // namespace signweave
