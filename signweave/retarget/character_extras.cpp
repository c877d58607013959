#include "signweave/retarget/character_extras.h"

#include <fmt/format.h>

#include <array>
#include <numbers>

#include "signweave/core/error.h"
#include "signweave/core/text.h"

namespace signweave {
namespace {

constexpr float kRadian = std::numbers::pi_v<float> / 180;
constexpr std::array<const char*, 5> kFingerNames = {"thumb", "index", "middle", "ring", "little"};

JointIndex joint_of(const JsonValue& name, const Skeleton& skeleton) {
  const std::optional<JointIndex> found = skeleton.find(name.text());
  if (!found) name.fail("no joint " + printable(name.text()));
  return *found;
}

AngleLimits limits_of(const JsonValue& pair) {
  if (pair.size() != 2) pair.fail("expected two numbers");
  const AngleLimits limits = {pair[0].number(-180, 180) * kRadian, pair[1].number(-180, 180) * kRadian};
  if (limits.least > limits.greatest) pair.fail("the lower limit exceeds the upper limit");
  return limits;
}

CharacterFinger finger_of(const JsonValue& extras, const Skeleton& skeleton) {
  CharacterFinger finger;
  const JsonValue joints = extras["joints"];
  const JsonValue rest = extras["restFlexion"];
  const JsonValue flexion = extras["limits"]["flexion"];
  for (const JsonValue& list : {joints, rest, flexion}) {
    if (list.size() != 3) list.fail("expected three entries");
  }
  for (std::size_t i = 0; i < 3; ++i) {
    finger.joints[i] = joint_of(joints[i], skeleton);
    finger.rest_flexion[i] = rest[i].number(-180, 180) * kRadian;
    finger.flexion[i] = limits_of(flexion[i]);
    const JointIndex parent = skeleton.joint(finger.joints[i]).parent;
    if (i > 0 && parent != finger.joints[i - 1])
      joints[i].fail("each joint of a finger must be the parent of the next");
  }
  finger.spread = limits_of(extras["limits"]["spread"]);
  finger.flexion_axis = extras["flexionAxis"].direction();
  finger.spread_axis = extras["spreadAxis"].direction();
  if (extras.has("metacarpal")) finger.metacarpal = joint_of(extras["metacarpal"], skeleton);
  return finger;
}

}  // namespace

void read_extras(const JsonValue& extras, Character& character) {
  if (extras["version"].number(-1e6f, 1e6f) != 1) extras["version"].fail("only version 1 is supported");
  const Skeleton& skeleton = *character.skeleton;
  character.name = extras["character"].text();
  character.height = extras["height"].number(0.1f, 5);
  character.eyes = extras["eyes"].vector(10);
  for (const Side side : kSides) {
    const JsonValue hand = extras["hands"][side == Side::left ? "left" : "right"];
    CharacterHand& own = character.hands[static_cast<std::size_t>(side)];
    own.length = hand["length"].number(0.01f, 1);
    for (std::size_t i = 0; i < hand["twist"].size(); ++i) own.twist.push_back(joint_of(hand["twist"][i], skeleton));
    for (std::size_t i = 0; i < hand["shoulder"].size(); ++i)
      own.shoulder.push_back(joint_of(hand["shoulder"][i], skeleton));
    RigMap& rig = character.rig;
    const auto put = [&](Part part, JointIndex joint, const Eigen::Vector3f& offset) {
      rig[part] = {.joint = joint, .offset = offset, .evidence = Evidence::file, .confidence = 1};
    };
    const Eigen::Vector3f none = Eigen::Vector3f::Zero();
    put(of(side, Part::left_hand), joint_of(hand["wrist"], skeleton), none);
    put(of(side, Part::left_forearm), joint_of(hand["elbow"], skeleton), none);
    for (const Finger finger : kFingers) {
      const auto f = static_cast<std::size_t>(finger);
      own.fingers[f] = finger_of(hand["fingers"][kFingerNames[f]], skeleton);
      const CharacterFinger& made = own.fingers[f];
      if (made.metacarpal != kNoJoint) put(finger_part(side, finger, FingerPoint::metacarpal), made.metacarpal, none);
      for (std::size_t i = 0; i < 3; ++i) {
        put(finger_part(side, finger, static_cast<FingerPoint>(i + 1)), made.joints[i], none);
      }
      // There are no rotations at rest: the offset is the tip's position minus its joint's.
      Eigen::Vector3f last = Eigen::Vector3f::Zero();
      for (JointIndex joint = made.joints[2]; joint != kNoJoint; joint = skeleton.joint(joint).parent) {
        last += skeleton.joint(joint).offset;
      }
      const JsonValue tip = hand["fingers"][kFingerNames[f]]["tip"];
      const Eigen::Vector3f offset = tip.vector(10) - last;
      if (offset.norm() > 0.2f || offset.norm() < 1e-4f) tip.fail("not a fingertip: too far from its joint, or at it");
      put(finger_part(side, finger, FingerPoint::tip), made.joints[2], offset);
    }
  }
  character.face_units = extras["faceUnits"]["morphs"].keys();
}

}  // namespace signweave
