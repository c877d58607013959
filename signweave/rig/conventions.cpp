#include "signweave/rig/conventions.h"

#include <array>

namespace signweave {
namespace {

using enum Part;

// The joint names of MotionBuilder's HumanIK, which many exporters adopted.
constexpr NameRow kMotionBuilder[] = {
    {pelvis, "Hips"},
    {spine, "Spine"},
    {chest, "Spine9 Spine8 Spine7 Spine6 Spine5 Spine4 Spine3 Spine2 Spine1 Chest"},
    {neck, "Neck"},
    {head, "Head"},
    {head_top, "HeadTop_End Head_End HeadEnd HeadTop"},
    {jaw, "Jaw"},
    {left_eye, "@Eye"},
    {left_clavicle, "@Shoulder"},
    {left_upper_arm, "@Arm"},
    {left_forearm, "@ForeArm"},
    {left_hand, "@Hand"},
    {left_thigh, "@UpLeg"},
    {left_shin, "@Leg"},
    {left_foot, "@Foot"},
    {left_toes, "@ToeBase @ForeFoot"},
};
constexpr FingerNames kMotionBuilderFingers[] = {
    {"@Hand%#", "Thumb Index Middle Ring Pinky", "- 1 2 3 4"},
    {"@InHand%", "Thumb Index Middle Ring Pinky", "#"},
    {"@Hand%", "- Index Middle Ring Pinky", "#"},
};
constexpr FingerNames kRokokoFingers[] = {
    {"@Hand%#", "Thumb Index Middle Ring Pinky", "- 1 2 3 4"},
    {"@InHand%", "- Index Middle Ring Pinky", "#"},
};

// The names in Biovision's own files, which name the joint itself: the shoulder is the arm's first joint.
constexpr NameRow kBiovision[] = {
    {pelvis, "Hips"},
    {spine, "Chest Spine"},
    {chest, "Chest6 Chest5 Chest4 Chest3 Chest2"},
    {neck, "Neck"},
    {head, "Head"},
    {head_top, "HeadTop HeadEnd"},
    {jaw, "Jaw"},
    {left_eye, "@Eye"},
    {left_clavicle, "@Collar"},
    {left_upper_arm, "@Shoulder"},
    {left_forearm, "@Elbow"},
    {left_hand, "@Wrist"},
    {left_thigh, "@Hip"},
    {left_shin, "@Knee"},
    {left_foot, "@Ankle"},
    {left_toes, "@Toe"},
};
constexpr FingerNames kBiovisionFingers[] = {
    {"@Finger%#", "0 1 2 3 4", "- - 1 2 3"},
    {"@Finger%", "0 1 2 3 4", "- # - - -"},
};

// The motion capture database of Carnegie Mellon: its own names, then those of two conversions.
constexpr NameRow kCmu[] = {
    {pelvis, "root"},
    {spine, "lowerback"},
    {chest, "thorax upperback"},
    {neck, "lowerneck"},
    {head, "head"},
    {left_clavicle, "@clavicle"},
    {left_upper_arm, "@humerus"},
    {left_forearm, "@radius"},
    {left_hand, "@wrist @hand"},
    {left_thigh, "@femur"},
    {left_shin, "@tibia"},
    {left_foot, "@foot"},
    {left_toes, "@toes"},
};
constexpr NameRow kCmuBiovision[] = {
    {pelvis, "Hips"},      {spine, "lowerback"},       {chest, "Chest2 Chest"},       {neck, "lowerneck Neck"},
    {head, "Head"},        {left_clavicle, "@Collar"}, {left_upper_arm, "@Shoulder"}, {left_forearm, "@Elbow"},
    {left_hand, "@Wrist"}, {left_thigh, "@Hip"},       {left_shin, "@Knee"},          {left_foot, "@Ankle"},
    {left_toes, "@Toe"},
};
constexpr NameRow kCmuMotionBuilder[] = {
    {pelvis, "Hips"},        {spine, "LowerBack"},         {chest, "Spine1 Spine"},  {neck, "Neck"},
    {head, "Head"},          {left_clavicle, "@Shoulder"}, {left_upper_arm, "@Arm"}, {left_forearm, "@ForeArm"},
    {left_hand, "@Hand"},    {left_thigh, "@UpLeg"},       {left_shin, "@Leg"},      {left_foot, "@Foot"},
    {left_toes, "@ToeBase"},
};
// One joint for the thumb and one for all other fingers, which one of the conversions names after the index finger.
constexpr FingerNames kCmuFingers[] = {
    {"@%", "thumb - - - -", "- # - - -"},
    {"@Hand%#", "- Index - - -", "- 1 - - -"},
};

// The mannequin of the Unreal engine; MakeHuman's game rig has the same names.
constexpr NameRow kUnreal[] = {
    {pelvis, "pelvis"},
    {spine, "spine_01"},
    {chest, "spine_05 spine_04 spine_03 spine_02"},
    {neck, "neck_01"},
    {head, "head"},
    {jaw, "jaw"},
    {left_eye, "eye_@"},
    {left_clavicle, "clavicle_@"},
    {left_upper_arm, "upperarm_@"},
    {left_forearm, "lowerarm_@"},
    {left_hand, "hand_@"},
    {left_thigh, "thigh_@"},
    {left_shin, "calf_@"},
    {left_foot, "foot_@"},
    {left_toes, "ball_@"},
};
constexpr FingerNames kUnrealFingers[] = {
    {"%_#_@", "thumb index middle ring pinky", "metacarpal 01 02 03 04"},
};

// VRM's humanoid bones, which are also Unity's; then VRoid's spelling, and names with the side at the end.
constexpr NameRow kVrm[] = {
    {pelvis, "hips C_Hips"},
    {spine, "spine C_Spine"},
    {chest, "upperChest C_UpperChest chest C_Chest"},
    {neck, "neck C_Neck"},
    {head, "head C_Head"},
    {jaw, "jaw"},
    {left_eye, "@Eye @FaceEye Eye_@"},
    {left_clavicle, "@Shoulder Shoulder_@"},
    {left_upper_arm, "@UpperArm UpperArm_@"},
    {left_forearm, "@LowerArm LowerArm_@"},
    {left_hand, "@Hand Hand_@"},
    {left_thigh, "@UpperLeg UpperLeg_@"},
    {left_shin, "@LowerLeg LowerLeg_@"},
    {left_foot, "@Foot Foot_@"},
    {left_toes, "@Toes @ToeBase Toes_@"},
};
constexpr FingerNames kVrmFingers[] = {
    {"@%#", "Thumb Index Middle Ring Little", "- Proximal Intermediate Distal Tip"},
    {"@%#", "Thumb Index Middle Ring Little", "- 1 2 3 4"},
    {"%#_@", "Thumb Index Middle Ring Little", "- Proximal Intermediate Distal Tip"},
};
// Since 1.0 the names of the thumb's joints are shifted outwards by one.
constexpr FingerNames kVrm1Fingers[] = {
    {"@%#", "- Index Middle Ring Little", "- Proximal Intermediate Distal Tip"},
    {"@%#", "Thumb - - - -", "- Metacarpal Proximal Distal Tip"},
};

// MakeHuman's default rig: limbs in halves, the spine counted from above.
constexpr NameRow kMakeHuman[] = {
    {pelvis, "root"},
    {spine, "spine05"},
    {chest, "spine01 spine02 spine03 spine04"},
    {neck, "neck01"},
    {head, "head"},
    {jaw, "jaw"},
    {left_eye, "eye.@"},
    {left_clavicle, "clavicle.@"},
    {left_upper_arm, "upperarm01.@"},
    {left_forearm, "lowerarm01.@"},
    {left_hand, "wrist.@"},
    {left_thigh, "upperleg01.@"},
    {left_shin, "lowerleg01.@"},
    {left_foot, "foot.@"},
    {left_toes, "toe1-1.@"},
};
constexpr FingerNames kMakeHumanFingers[] = {
    {"finger%-#.@", "1 2 3 4 5", "- 1 2 3 -"},
    {"metacarpal%.@", "- 1 2 3 4", "#"},
};

// OptiTrack's Motive with its own names; it writes MotionBuilder's as well.
constexpr NameRow kOptiTrack[] = {
    {pelvis, "Hip"},
    {spine, "Ab"},
    {chest, "Chest"},
    {neck, "Neck"},
    {head, "Head"},
    {left_clavicle, "@Shoulder"},
    {left_upper_arm, "@UArm"},
    {left_forearm, "@FArm"},
    {left_hand, "@Hand"},
    {left_thigh, "@Thigh"},
    {left_shin, "@Shin"},
    {left_foot, "@Foot"},
    {left_toes, "@Toe"},
};
constexpr FingerNames kShortFingers[] = {
    {"@%#", "Thumb Index Mid Ring Pinky", "- 1 2 3 4"},
    {"@%#", "- - Middle - -", "- 1 2 3 4"},
};

constexpr NameRow kBiped[] = {
    {pelvis, "Pelvis"},
    {spine, "Spine"},
    {chest, "Spine4 Spine3 Spine2 Spine1"},
    {neck, "Neck"},
    {head, "Head"},
    {head_top, "HeadNub"},
    {left_clavicle, "@_Clavicle"},
    {left_upper_arm, "@_UpperArm"},
    {left_forearm, "@_Forearm"},
    {left_hand, "@_Hand"},
    {left_thigh, "@_Thigh"},
    {left_shin, "@_Calf"},
    {left_foot, "@_Foot"},
    {left_toes, "@_Toe0"},
};
constexpr FingerNames kBipedFingers[] = {
    {"@_Finger%#", "0 1 2 3 4", "- - 1 2 Nub"},
    {"@_Finger%", "0 1 2 3 4", "- # - - -"},
};

constexpr NameRow kDaz[] = {
    {pelvis, "hip"},
    {spine, "abdomen abdomenLower"},
    {chest, "chest chestUpper chestLower"},
    {neck, "neck neckLower"},
    {head, "head"},
    {jaw, "lowerJaw"},
    {left_eye, "@Eye"},
    {left_clavicle, "@Collar"},
    {left_upper_arm, "@Shldr @ShldrBend"},
    {left_forearm, "@ForeArm @ForearmBend"},
    {left_hand, "@Hand"},
    {left_thigh, "@Thigh @ThighBend"},
    {left_shin, "@Shin"},
    {left_foot, "@Foot"},
    {left_toes, "@Toe"},
};

// The body model SMPL and its variant with hands, SMPL-X: joints are named after themselves.
constexpr NameRow kSmpl[] = {
    {pelvis, "pelvis"},
    {spine, "spine1"},
    {chest, "spine3 spine2"},
    {neck, "neck"},
    {head, "head"},
    {jaw, "jaw"},
    {left_eye, "@_eye @_eye_smplhf"},
    {left_clavicle, "@_collar"},
    {left_upper_arm, "@_shoulder"},
    {left_forearm, "@_elbow"},
    {left_hand, "@_wrist"},
    {left_thigh, "@_hip"},
    {left_shin, "@_knee"},
    {left_foot, "@_ankle"},
    {left_toes, "@_foot"},
};
constexpr FingerNames kSmplFingers[] = {{"@_%#", "thumb index middle ring pinky", "- 1 2 3 -"}};

constexpr NameRow kXsens[] = {
    {pelvis, "Pelvis Hips"},
    {spine, "L5 Chest"},
    {chest, "T8 T12 Chest4"},
    {neck, "Neck"},
    {head, "Head"},
    {left_clavicle, "@Shoulder @Collar"},
    {left_upper_arm, "@UpperArm"},
    {left_forearm, "@ForeArm"},
    {left_hand, "@Hand"},
    {left_thigh, "@UpperLeg"},
    {left_shin, "@LowerLeg"},
    {left_foot, "@Foot"},
    {left_toes, "@Toe"},
};

constexpr Convention kConventions[] = {
    {"MotionBuilder", "Left", "Right", kMotionBuilder, kMotionBuilderFingers},
    {"Mixamo", "Left", "Right", kMotionBuilder, kMotionBuilderFingers, "mixamorig headtop_end"},
    {"Rokoko", "Left", "Right", kMotionBuilder, kRokokoFingers, "inhandindex"},
    {"Biovision", "Left", "Right", kBiovision, kBiovisionFingers},
    {"CMU", "l", "r", kCmu, kCmuFingers},
    {"CMU with Biovision's names", "Left L", "Right R", kCmuBiovision, kCmuFingers, "lhipjoint"},
    {"CMU with MotionBuilder's names", "Left L", "Right R", kCmuMotionBuilder, kCmuFingers, "lhipjoint"},
    {"Unreal", "l", "r", kUnreal, kUnrealFingers},
    {"VRM", "Left L", "Right R", kVrm, kVrmFingers},
    {"VRM 1.0", "Left L", "Right R", kVrm, kVrm1Fingers, "thumbmetacarpal"},
    {"Bandai-Namco", "L", "R", kVrm, kVrmFingers, "joint_root"},
    {"MakeHuman", "L", "R", kMakeHuman, kMakeHumanFingers},
    {"OptiTrack", "L Left", "R Right", kOptiTrack, kShortFingers},
    {"3ds Max Biped", "L", "R", kBiped, kBipedFingers},
    {"DAZ", "l", "r", kDaz, kShortFingers},
    {"SMPL", "left", "right", kSmpl, kSmplFingers},
    {"Xsens", "Left", "Right", kXsens, {}},
};

}  // namespace

std::span<const Convention> conventions() noexcept {
  return kConventions;
}

}  // namespace signweave
