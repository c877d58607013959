#include "demo/signer.h"

#include <string>
#include <vector>

namespace signweave::demo {
namespace {

using Eigen::Vector3f;

/// Collects joints by their position in the rest pose, which is easier to check against a body than offsets are.
class Builder {
 public:
  JointIndex add(std::string name, JointIndex parent, const Vector3f& place) {
    Joint joint{.name = std::move(name), .parent = parent};
    joint.offset = parent == kNoJoint ? place : place - places_[static_cast<std::size_t>(parent)];
    joint.translated = parent == kNoJoint;
    joints_.push_back(std::move(joint));
    places_.push_back(place);
    return static_cast<JointIndex>(joints_.size()) - 1;
  }
  void tip(JointIndex joint, const Vector3f& place) {
    tips_.push_back({joint, place - places_[static_cast<std::size_t>(joint)]});
  }
  std::shared_ptr<const Skeleton> finish() {
    return std::make_shared<const Skeleton>(std::move(joints_), std::move(tips_));
  }

 private:
  std::vector<Joint> joints_;
  std::vector<Tip> tips_;
  std::vector<Vector3f> places_;
};

struct FingerShape {
  const char* name;
  Vector3f points[kPhalanges + 1];  ///< the three joints and the tip of the left hand, from the wrist
};

// Segment lengths of an adult hand of 18 cm; the palm faces −Y, the thumb side is +Z.
const FingerShape kHand[kFingers] = {
    {"Thumb",
     {{0.022f, -0.010f, 0.024f}, {0.052f, -0.020f, 0.050f}, {0.078f, -0.024f, 0.068f}, {0.100f, -0.026f, 0.081f}}},
    {"Index", {{0.088f, 0.000f, 0.026f}, {0.130f, 0.000f, 0.030f}, {0.155f, 0.000f, 0.032f}, {0.177f, 0.000f, 0.033f}}},
    {"Middle",
     {{0.090f, 0.003f, 0.005f}, {0.136f, 0.003f, 0.006f}, {0.164f, 0.003f, 0.006f}, {0.187f, 0.003f, 0.006f}}},
    {"Ring",
     {{0.085f, 0.001f, -0.015f}, {0.127f, 0.001f, -0.018f}, {0.154f, 0.001f, -0.020f}, {0.177f, 0.001f, -0.021f}}},
    {"Pinky",
     {{0.077f, -0.003f, -0.033f}, {0.109f, -0.003f, -0.039f}, {0.128f, -0.003f, -0.042f}, {0.148f, -0.003f, -0.045f}}},
};

const Vector3f kWrist = {0.705f, 1.385f, -0.010f};  // left, rest pose

Vector3f on_side(const Vector3f& place, Side side) {
  return {sign_of(side) * place.x(), place.y(), place.z()};
}

SideJoints add_arm(Builder& body, Side side, JointIndex chest) {
  const std::string name = side == Side::left ? "Left" : "Right";
  SideJoints joints{};
  joints.shoulder = body.add(name + "Shoulder", chest, on_side({0.025f, 1.375f, 0.005f}, side));
  joints.arm = body.add(name + "Arm", joints.shoulder, on_side({0.175f, 1.385f, -0.010f}, side));
  joints.fore_arm = body.add(name + "ForeArm", joints.arm, on_side({0.455f, 1.385f, -0.010f}, side));
  joints.hand = body.add(name + "Hand", joints.fore_arm, on_side(kWrist, side));
  for (std::size_t finger = 0; finger < kFingers; ++finger) {
    JointIndex parent = joints.hand;
    for (std::size_t phalanx = 0; phalanx < kPhalanges; ++phalanx) {
      parent = body.add(name + "Hand" + kHand[finger].name + std::to_string(phalanx + 1), parent,
                        on_side(kWrist + kHand[finger].points[phalanx], side));
      joints.fingers[finger][phalanx] = parent;
    }
    body.tip(parent, on_side(kWrist + kHand[finger].points[kPhalanges], side));
  }
  return joints;
}

void add_leg(Builder& body, Side side, JointIndex hips, SideJoints& joints) {
  const std::string name = side == Side::left ? "Left" : "Right";
  joints.up_leg = body.add(name + "UpLeg", hips, on_side({0.090f, 0.900f, 0.000f}, side));
  joints.leg = body.add(name + "Leg", joints.up_leg, on_side({0.095f, 0.485f, 0.005f}, side));
  joints.foot = body.add(name + "Foot", joints.leg, on_side({0.100f, 0.080f, -0.020f}, side));
  joints.toe = body.add(name + "ToeBase", joints.foot, on_side({0.110f, 0.020f, 0.110f}, side));
  body.tip(joints.toe, on_side({0.115f, 0.015f, 0.185f}, side));
}

}  // namespace

Signer make_signer() {
  Builder body;
  Signer signer{};
  signer.hips = body.add("Hips", kNoJoint, {0, 0.940f, 0});
  signer.spine = body.add("Spine", signer.hips, {0, 1.010f, -0.010f});
  signer.spine1 = body.add("Spine1", signer.spine, {0, 1.120f, -0.015f});
  signer.spine2 = body.add("Spine2", signer.spine1, {0, 1.240f, -0.020f});
  signer.neck = body.add("Neck", signer.spine2, {0, 1.420f, -0.015f});
  signer.neck1 = body.add("Neck1", signer.neck, {0, 1.465f, -0.005f});
  signer.head = body.add("Head", signer.neck1, {0, 1.510f, 0.005f});
  body.tip(signer.head, {0, 1.700f, 0.005f});
  signer.jaw = body.add("Jaw", signer.head, {0, 1.525f, 0.030f});
  body.tip(signer.jaw, {0, 1.485f, 0.095f});
  const JointIndex left_eye = body.add("LeftEye", signer.head, {0.032f, 1.590f, 0.080f});
  body.tip(left_eye, {0.032f, 1.590f, 0.095f});
  const JointIndex right_eye = body.add("RightEye", signer.head, {-0.032f, 1.590f, 0.080f});
  body.tip(right_eye, {-0.032f, 1.590f, 0.095f});
  signer.left = add_arm(body, Side::left, signer.spine2);
  signer.right = add_arm(body, Side::right, signer.spine2);
  add_leg(body, Side::left, signer.hips, signer.left);
  add_leg(body, Side::right, signer.hips, signer.right);
  signer.left.eye = left_eye;
  signer.right.eye = right_eye;
  signer.skeleton = body.finish();
  return signer;
}

Eigen::Vector3f Signer::finger_tip(std::size_t finger) const {
  return kHand[finger].points[kPhalanges] - kHand[finger].points[kPhalanges - 1];
}

Eigen::Vector3f Signer::rest_position(JointIndex joint) const {
  Vector3f place = Vector3f::Zero();
  for (JointIndex at = joint; at != kNoJoint; at = skeleton->joint(at).parent) place += skeleton->joint(at).offset;
  return place;
}

}  // namespace signweave::demo
