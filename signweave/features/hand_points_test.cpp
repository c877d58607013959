#include "signweave/features/hand_points.h"

#include <gtest/gtest.h>

#include <numbers>

#include "signweave/rig/test_rig.h"

namespace signweave {
namespace {

using Eigen::AngleAxisf;
using Eigen::Quaternionf;
using Eigen::Vector3f;

constexpr float kDegree = std::numbers::pi_v<float> / 180;
constexpr std::size_t kKnuckle = 0, kBeyond = 1, kSpread = 2;

/// A hand of the test person: fingers bend about z and spread about y, palm down, fingers along x.
struct MadeHand {
  Side side = Side::left;
  std::shared_ptr<const Skeleton> skeleton = whole_person();
  RigMap rig = rig_of_signer(*skeleton);
  Pose pose = Pose(*skeleton);

  /// `bend` of the knuckle and of each joint beyond, and `spread` to the thumb's side, degrees.
  void set(Finger finger, float bend, float beyond, float spread = 0) {
    const float s = side == Side::left ? 1 : -1;
    for (const FingerPoint point : {FingerPoint::proximal, FingerPoint::intermediate, FingerPoint::distal}) {
      const JointIndex joint = rig[finger_part(side, finger, point)].joint;
      const bool knuckle = point == FingerPoint::proximal;
      pose.rotations[static_cast<std::size_t>(joint)] =
          AngleAxisf(-s * (knuckle ? spread : 0) * kDegree, Vector3f::UnitY()) *
          AngleAxisf(-s * (knuckle ? bend : beyond) * kDegree, Vector3f::UnitZ());
    }
  }
  void set_all(float bend, float beyond) {
    for (const Finger finger : kFingers) {
      if (finger != Finger::thumb) set(finger, bend, beyond);
    }
  }
  HandPoints points() const {
    HandPoints points;
    HandPlaces(rig, side).read(to_model_space(*skeleton, pose.view()), points);
    return points;
  }
  HandAxes axes() const { return axes_of(points(), side); }
  Handshape shape() const { return handshape_of(points(), axes()); }
  float value(Finger finger, std::size_t which) const {
    return shape().values[3 * static_cast<std::size_t>(finger) + which];
  }
  float openness() const { return openness_of(shape()); }
};

TEST(HandAxes, PointOutOfBothPalmsAndToBothThumbs) {
  for (const Side side : kSides) {
    const MadeHand hand{.side = side};
    const float s = side == Side::left ? 1 : -1;
    EXPECT_LT((hand.axes().fingers - Vector3f(s, 0, 0)).norm(), 0.02f);
    EXPECT_LT((hand.axes().palm - Vector3f(0, -1, 0)).norm(), 1e-5f);
    EXPECT_LT((hand.axes().thumb - Vector3f(0, 0, 1)).norm(), 0.02f);
  }
}

TEST(HandAxes, RotateWithTheHand) {
  for (const Side side : kSides) {
    MadeHand hand{.side = side};
    const float s = side == Side::left ? 1 : -1;
    // Arms out, thumbs up: the palms face forward.
    const JointIndex wrist = hand.rig[of(side, Part::left_hand)].joint;
    hand.pose.rotations[static_cast<std::size_t>(wrist)] = AngleAxisf(-90 * kDegree, Vector3f::UnitX());
    EXPECT_LT((hand.axes().palm - Vector3f(0, 0, 1)).norm(), 1e-5f);
    // Fingers up, palms outwards.
    hand.pose.rotations[static_cast<std::size_t>(wrist)] = AngleAxisf(90 * s * kDegree, Vector3f::UnitZ());
    EXPECT_LT((hand.axes().palm - Vector3f(s, 0, 0)).norm(), 1e-5f);
    EXPECT_LT((hand.axes().fingers - Vector3f(0, 1, 0)).norm(), 0.02f);
  }
}

TEST(HandshapeOf, MeasuresTheFlexionOfEachFinger) {
  for (const Side side : kSides) {
    MadeHand hand{.side = side};
    EXPECT_NEAR(hand.value(Finger::index, kKnuckle), 0, 0.01f);
    EXPECT_NEAR(hand.value(Finger::index, kBeyond), 0, 0.01f);
    hand.set(Finger::index, 45, 0);
    hand.set(Finger::ring, 0, 45);
    EXPECT_NEAR(hand.value(Finger::index, kKnuckle), 0.5f, 0.01f);
    EXPECT_NEAR(hand.value(Finger::index, kBeyond), 0, 0.01f);
    EXPECT_NEAR(hand.value(Finger::middle, kKnuckle), 0, 0.01f);
    EXPECT_NEAR(hand.value(Finger::ring, kKnuckle), 0, 0.01f);
    EXPECT_NEAR(hand.value(Finger::ring, kBeyond), 0.5f, 0.01f);
    hand.set(Finger::index, 100, 100);
    EXPECT_EQ(hand.value(Finger::index, kKnuckle), 1);
    EXPECT_EQ(hand.value(Finger::index, kBeyond), 1);
    hand.set(Finger::index, -20, 0);  // backwards is not bent
    EXPECT_EQ(hand.value(Finger::index, kKnuckle), 0);
  }
}

TEST(HandshapeOf, MeasuresSpreadOfStraightAndBentFingers) {
  for (const Side side : kSides) {
    MadeHand hand{.side = side};
    EXPECT_NEAR(hand.value(Finger::middle, kSpread), 0, 0.01f);
    hand.set(Finger::index, 0, 0, 22.5f);
    EXPECT_NEAR(hand.value(Finger::middle, kSpread), 0.5f, 0.02f);
    EXPECT_NEAR(hand.value(Finger::ring, kSpread), 0, 0.02f);
    EXPECT_NEAR(hand.value(Finger::little, kSpread), 0, 0.02f);
    hand.set(Finger::little, 0, 0, -45);
    EXPECT_NEAR(hand.value(Finger::little, kSpread), 1, 0.02f);
    hand.set_all(90, 90);
    for (const Finger finger : {Finger::middle, Finger::ring, Finger::little}) {
      EXPECT_NEAR(hand.value(finger, kSpread), 0, 0.02f);
    }
  }
}

TEST(HandshapeOf, MeasuresThePositionOfTheThumb) {
  MadeHand hand;
  const float away = hand.value(Finger::index, kSpread);
  EXPECT_NEAR(away, std::atan2(2.5f, 3.0f) * 2 / std::numbers::pi_v<float>, 0.02f);  // its natural position
  EXPECT_EQ(hand.value(Finger::thumb, kSpread), 0);
  const auto joint =
      static_cast<std::size_t>(hand.rig[finger_part(Side::left, Finger::thumb, FingerPoint::proximal)].joint);
  hand.pose.rotations[joint] = AngleAxisf(80 * kDegree, Vector3f::UnitY());  // across the palm
  EXPECT_EQ(hand.value(Finger::index, kSpread), 0);
  EXPECT_GT(hand.value(Finger::thumb, kSpread), 0.3f);
  hand.pose.rotations[joint] = AngleAxisf(-40 * kDegree, Vector3f::UnitY());  // straight out
  EXPECT_GT(hand.value(Finger::index, kSpread), away + 0.3f);
  EXPECT_NEAR(hand.value(Finger::thumb, kKnuckle), 0, 0.01f);
  const Vector3f bone = Vector3f(0.03f, 0, 0.025f).normalized();
  hand.pose.rotations[joint] = AngleAxisf(45 * kDegree, bone.cross(Vector3f(0, -1, 0)));  // out of the palm
  EXPECT_NEAR(hand.value(Finger::thumb, kKnuckle), 0.5f, 0.01f);
}

TEST(Openness, FallsFromAFlatHandToAFist) {
  MadeHand hand;
  EXPECT_NEAR(hand.openness(), 1, 0.01f);
  hand.set_all(45, 45);
  EXPECT_NEAR(hand.openness(), 0.5f, 0.02f);
  hand.set_all(90, 90);
  EXPECT_NEAR(hand.openness(), 0, 0.01f);
  hand.set(Finger::index, 0, 0);  // one of four fingers
  EXPECT_NEAR(hand.openness(), 0.25f, 0.02f);
}

TEST(Handshape, IsTheSameForMirroredHands) {
  MadeHand left{.side = Side::left};
  MadeHand right{.side = Side::right};
  for (MadeHand* hand : {&left, &right}) {
    hand->set(Finger::index, 10, 30, 12);
    hand->set(Finger::middle, 70, 80, -3);
    hand->set(Finger::little, 20, 0, -20);
  }
  EXPECT_LT(distance(left.shape(), right.shape()), 1e-5f);
  EXPECT_GT(distance(left.shape(), MadeHand().shape()), 0.1f);
  EXPECT_EQ(distance(left.shape(), left.shape()), 0);
  Handshape full;
  full.values.fill(1);
  EXPECT_FLOAT_EQ(distance(full, Handshape{}), 1);
}

TEST(HandshapeOf, IsTheSameForRigsWithOtherLocalAxes) {
  MadeHand hand;
  hand.set(Finger::index, 30, 50, 10);
  // The same points from a rig whose finger joints are rotated relative to their bones.
  const Quaternionf skew(AngleAxisf(1.1f, Vector3f(1, 2, 3).normalized()));
  std::vector<Joint> joints(hand.skeleton->joints().begin(), hand.skeleton->joints().end());
  std::vector<Tip> tips(hand.skeleton->tips().begin(), hand.skeleton->tips().end());
  MadeHand other = hand;
  for (std::size_t i = 0; i < joints.size(); ++i) {
    if (joints[i].name.find("HandIndex") == std::string::npos) continue;
    const bool first = joints[i].name.ends_with("1");
    if (!first) joints[i].offset = skew.conjugate() * joints[i].offset;
    other.pose.rotations[i] = (first ? Quaternionf::Identity() : skew.conjugate()) * hand.pose.rotations[i] * skew;
  }
  for (Tip& tip : tips) {
    if (joints[static_cast<std::size_t>(tip.joint)].name.find("HandIndex") != std::string::npos) {
      tip.offset = skew.conjugate() * tip.offset;
    }
  }
  other.skeleton = std::make_shared<const Skeleton>(joints, tips);
  other.rig = rig_of_signer(*other.skeleton);
  EXPECT_LT(distance(hand.shape(), other.shape()), 1e-5f);
}

TEST(HandPlaces, MissingFingersCopyTheirNeighbour) {
  MadeHand hand;
  hand.set(Finger::ring, 60, 30);
  for (const FingerPoint point :
       {FingerPoint::proximal, FingerPoint::intermediate, FingerPoint::distal, FingerPoint::tip}) {
    hand.rig[finger_part(Side::left, Finger::little, point)] = {};
    hand.rig[finger_part(Side::left, Finger::index, point)] = {};
  }
  EXPECT_EQ(hand.value(Finger::little, kKnuckle), hand.value(Finger::ring, kKnuckle));
  EXPECT_EQ(hand.value(Finger::index, kKnuckle), hand.value(Finger::middle, kKnuckle));
  EXPECT_TRUE(HandPlaces(hand.rig, Side::left).why_no_fingers().empty());
  EXPECT_LT((hand.axes().palm - Vector3f(0, -1, 0)).norm(), 1e-5f);
}

TEST(HandPlaces, ReportsWhyThereAreNoFingers) {
  MadeHand hand;
  for (const Finger finger : kFingers) {
    if (finger == Finger::middle) continue;
    for (std::size_t point = 0; point < kFingerPoints; ++point) {
      hand.rig[finger_part(Side::left, finger, static_cast<FingerPoint>(point))] = {};
    }
  }
  EXPECT_EQ(HandPlaces(hand.rig, Side::left).why_no_fingers(), "only one left finger: a palm needs two");
  hand.rig[finger_part(Side::left, Finger::middle, FingerPoint::proximal)] = {};
  EXPECT_EQ(HandPlaces(hand.rig, Side::left).why_no_fingers(), "no left fingers");
  const HandPoints points = hand.points();
  EXPECT_EQ(palm_of(points), points.wrist);
}

}  // namespace
}  // namespace signweave
