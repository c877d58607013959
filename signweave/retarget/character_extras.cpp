#include "signweave/retarget/character_extras.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "signweave/core/error.h"
#include "signweave/core/text.h"

namespace signweave {
namespace {

constexpr float kRadian = std::numbers::pi_v<float> / 180;
constexpr std::array<const char*, 5> kFingerNames = {"thumb", "index", "middle", "ring", "little"};

CharacterFinger finger_of(const Extras& extras, const Skeleton& skeleton) {
  CharacterFinger finger;
  const Extras joints = extras["joints"];
  const Extras rest = extras["restFlexion"];
  const Extras flexion = extras["limits"]["flexion"];
  for (const Extras& list : {joints, rest, flexion}) {
    if (list.size() != 3) list.fail("three are expected");
  }
  for (std::size_t i = 0; i < 3; ++i) {
    finger.joints[i] = joints[i].joint(skeleton);
    finger.rest_flexion[i] = rest[i].number(-180, 180) * kRadian;
    finger.flexion[i] = flexion[i].limits();
    const JointIndex parent = skeleton.joint(finger.joints[i]).parent;
    if (i > 0 && parent != finger.joints[i - 1]) joints[i].fail("a finger's joints follow each other");
  }
  finger.spread = extras["limits"]["spread"].limits();
  finger.flexion_axis = extras["flexionAxis"].direction();
  finger.spread_axis = extras["spreadAxis"].direction();
  if (extras.has("metacarpal")) finger.metacarpal = extras["metacarpal"].joint(skeleton);
  return finger;
}

}  // namespace

void Extras::fail(const std::string& what) const {
  throw Error(ErrorCode::bad_input, fmt::format("{}: {}: {}", file_, where_, what));
}
bool Extras::has(const std::string& key) const {
  return value_->IsObject() && value_->Has(key) && value_->Get(key).Type() != tinygltf::NULL_TYPE;
}
Extras Extras::operator[](const std::string& key) const {
  if (!has(key)) fail("no " + key);
  return {file_, value_->Get(key), where_ + "." + printable(key)};
}
Extras Extras::operator[](std::size_t index) const {
  if (index >= size()) fail("too short");
  return {file_, value_->Get(index), fmt::format("{}[{}]", where_, index)};
}
std::size_t Extras::size() const {
  if (!value_->IsArray()) fail("no list");
  return value_->ArrayLen();
}
std::vector<std::string> Extras::keys() const {
  if (!value_->IsObject()) fail("no object");
  return value_->Keys();
}
float Extras::number() const {
  if (!value_->IsNumber()) fail("no number");
  const double number = value_->GetNumberAsDouble();
  if (!(std::abs(number) < 1e6)) fail("out of range");
  return static_cast<float>(number);
}
float Extras::number(float least, float most) const {
  const float value = number();
  if (value < least || value > most) fail(fmt::format("{} is not between {} and {}", value, least, most));
  return value;
}
std::string Extras::text() const {
  if (!value_->IsString()) fail("no text");
  return value_->Get<std::string>();
}
Eigen::Vector3f Extras::place() const {
  if (size() != 3) fail("three numbers are expected");
  return {(*this)[0].number(-10, 10), (*this)[1].number(-10, 10), (*this)[2].number(-10, 10)};
}
Eigen::Vector3f Extras::direction() const {
  const Eigen::Vector3f vector = place();
  if (std::abs(vector.norm() - 1) > 0.01f) fail("no unit vector");
  return vector.normalized();
}
JointIndex Extras::joint(const Skeleton& skeleton) const {
  const std::optional<JointIndex> found = skeleton.find(text());
  if (!found) fail(fmt::format("no joint {}", printable(text())));
  return *found;
}
AngleLimits Extras::limits() const {
  if (size() != 2) fail("two numbers are expected");
  const AngleLimits limits = {(*this)[0].number(-180, 180) * kRadian, (*this)[1].number(-180, 180) * kRadian};
  if (limits.least > limits.greatest) fail("the least is above the greatest");
  return limits;
}

void read_extras(const Extras& extras, Character& character) {
  if (extras["version"].number() != 1) extras["version"].fail("only version 1 is known");
  const Skeleton& skeleton = *character.skeleton;
  character.name = extras["character"].text();
  character.height = extras["height"].number(0.1f, 5);
  character.eyes = extras["eyes"].place();
  for (const Side side : kSides) {
    const Extras hand = extras["hands"][side == Side::left ? "left" : "right"];
    CharacterHand& own = character.hands[static_cast<std::size_t>(side)];
    own.length = hand["length"].number(0.01f, 1);
    for (std::size_t i = 0; i < hand["twist"].size(); ++i) own.twist.push_back(hand["twist"][i].joint(skeleton));
    for (std::size_t i = 0; i < hand["shoulder"].size(); ++i)
      own.shoulder.push_back(hand["shoulder"][i].joint(skeleton));
    RigMap& rig = character.rig;
    const auto put = [&](Part part, JointIndex joint, const Eigen::Vector3f& offset) {
      rig[part] = {.joint = joint, .offset = offset, .evidence = Evidence::file, .confidence = 1};
    };
    const Eigen::Vector3f none = Eigen::Vector3f::Zero();
    put(of(side, Part::left_hand), hand["wrist"].joint(skeleton), none);
    put(of(side, Part::left_forearm), hand["elbow"].joint(skeleton), none);
    for (const Finger finger : kFingers) {
      const auto f = static_cast<std::size_t>(finger);
      own.fingers[f] = finger_of(hand["fingers"][kFingerNames[f]], skeleton);
      const CharacterFinger& made = own.fingers[f];
      if (made.metacarpal != kNoJoint) put(finger_part(side, finger, FingerPoint::metacarpal), made.metacarpal, none);
      for (std::size_t i = 0; i < 3; ++i) {
        put(finger_part(side, finger, static_cast<FingerPoint>(i + 1)), made.joints[i], none);
      }
      // The rest has no turns: a tip's place less its joint's is the offset.
      Eigen::Vector3f last = Eigen::Vector3f::Zero();
      for (JointIndex joint = made.joints[2]; joint != kNoJoint; joint = skeleton.joint(joint).parent) {
        last += skeleton.joint(joint).offset;
      }
      const Extras tip = hand["fingers"][kFingerNames[f]]["tip"];
      const Eigen::Vector3f offset = tip.place() - last;
      if (offset.norm() > 0.2f || offset.norm() < 1e-4f) tip.fail("no fingertip: too far from its joint, or on it");
      put(finger_part(side, finger, FingerPoint::tip), made.joints[2], offset);
    }
  }
  character.face_units = extras["faceUnits"]["morphs"].keys();
  std::sort(character.face_units.begin(), character.face_units.end());
}

}  // namespace signweave
