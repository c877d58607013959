#include "signweave/features/contact.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "signweave/rig/test_rig.h"

namespace signweave {
namespace {

using Eigen::Vector3f;

Vector3f arbitrary_point() {
  const auto number = [] { return static_cast<float>(*rc::gen::inRange(-100, 100)) / 100; };
  const float x = number(), y = number(), z = number();
  return {x, y, z};
}

RC_GTEST_PROP(Clearance, MatchesTheNearestOfManyPoints, ()) {
  const Capsule a{arbitrary_point(), arbitrary_point(), 0.1f};
  const Capsule b{arbitrary_point(), arbitrary_point(), 0.2f};
  float nearest = 1e9f;
  for (int i = 0; i <= 100; ++i) {
    const Vector3f p = a.from + static_cast<float>(i) / 100 * (a.to - a.from);
    for (int j = 0; j <= 100; ++j) {
      nearest = std::min(nearest, (p - b.from - static_cast<float>(j) / 100 * (b.to - b.from)).norm());
    }
  }
  const float is = clearance(a, b) + 0.3f;
  RC_ASSERT(is <= nearest + 1e-5f);
  RC_ASSERT(is >= nearest - 0.04f);  // half a step on each line
  RC_ASSERT(std::abs(clearance(b, a) - clearance(a, b)) < 1e-5f);
}

TEST(Clearance, HandlesPointsAndParallelLines) {
  const Capsule point{{0, 0, 0}, {0, 0, 0}, 0.1f};
  const Capsule line{{-1, 1, 0}, {1, 1, 0}, 0.1f};
  EXPECT_FLOAT_EQ(clearance(point, point), -0.2f);
  EXPECT_FLOAT_EQ(clearance(point, line), 0.8f);
  EXPECT_FLOAT_EQ(clearance(line, point), 0.8f);
  EXPECT_FLOAT_EQ(clearance(line, {{5, 2, 0}, {0.5f, 2, 0}, 0}), 0.9f);
}

/// The test person in the rest pose with its shells.
struct Person {
  std::shared_ptr<const Skeleton> skeleton = whole_person();
  RigMap rig = rig_of_signer(*skeleton);
  ModelPose pose = to_model_space(*skeleton, Pose(*skeleton).view());
  SignerBody body = *signer_body(Motion(skeleton, {60, 1}, 1), rig);

  BodyShell shell() const { return shell_of(body, rig, signer_space(body, rig, pose), pose); }
  /// A hand that consists of one point.
  HandShell fingertip(const Vector3f& at) const {
    HandPoints hand{.wrist = at, .fingers = {}};
    return shell_of(hand, std::nullopt, body);
  }
  bool touches_head(const Vector3f& at) const { return touches(fingertip(at), *shell().head, body); }
  bool touches_torso(const Vector3f& at) const {
    const HandShell hand = fingertip(at);
    const BodyShell it = shell();
    return touches(hand, it.torso[0], body) || touches(hand, it.torso[1], body);
  }
};

TEST(Contact, CoversHeadAndTrunk) {
  const Person person;
  EXPECT_TRUE(person.touches_head({0, 1.72f, 0}));      // the top
  EXPECT_TRUE(person.touches_head({0, 1.55f, 0.11f}));  // the mouth
  EXPECT_TRUE(person.touches_head({0.09f, 1.60f, 0}));  // the temple
  EXPECT_FALSE(person.touches_head({0, 1.60f, 0.20f}));
  EXPECT_FALSE(person.touches_head({0.25f, 1.60f, 0}));
  EXPECT_FALSE(person.touches_head({0, 1.40f, 0.12f}));
  EXPECT_TRUE(person.touches_torso({0, 1.25f, 0.12f}));      // the breastbone
  EXPECT_TRUE(person.touches_torso({0.15f, 1.00f, 0.08f}));  // the waist
  EXPECT_FALSE(person.touches_torso({0, 1.25f, 0.22f}));
  EXPECT_FALSE(person.touches_torso({0.30f, 1.10f, 0}));
  EXPECT_FALSE(person.touches_torso({0, 1.55f, 0}));
  EXPECT_FALSE(person.touches_torso({0.26f, 0.80f, 0}));  // next to the thigh
}

TEST(Contact, OfHandsUsesTheirCapsules) {
  const Person person;
  HandPoints left, right;
  HandPlaces(person.rig, Side::left).read(person.pose, left);
  HandPlaces(person.rig, Side::right).read(person.pose, right);
  const auto moved = [](HandPoints hand, const Vector3f& by) {
    hand.wrist += by;
    for (auto& finger : hand.fingers) {
      for (Vector3f& point : finger.points) point += by;
    }
    return hand;
  };
  const auto touch = [&](const Vector3f& by) {
    return touches(shell_of(left, std::nullopt, person.body), shell_of(moved(right, by), std::nullopt, person.body),
                   person.body);
  };
  const float apart = left.wrist.x() - right.wrist.x();
  EXPECT_FALSE(touch({0, 0, 0}));
  // The tips of the middle fingers are 0.174 from the wrists: tip to tip, and a hand's width apart.
  EXPECT_TRUE(touch({apart + 2 * 0.174f, 0, 0}));
  EXPECT_FALSE(touch({apart + 2 * 0.174f + 0.06f, 0, 0}));
  EXPECT_TRUE(touch({apart, 0.02f, 0}));  // palm on back
  EXPECT_FALSE(touch({apart, 0.10f, 0}));
}

TEST(Contact, WithoutFingersTheHandContinuesTheForearm) {
  const Person person;
  const HandPoints hand{.wrist = {0, 1.25f, 0.30f}, .fingers = {}};
  const BodyShell shell = person.shell();
  EXPECT_TRUE(touches(shell_of(hand, Vector3f(0, 1.25f, 0.55f), person.body), shell.torso[0], person.body));
  EXPECT_FALSE(touches(shell_of(hand, Vector3f(0, 1.25f, 0.05f), person.body), shell.torso[0], person.body));
}

TEST(Contact, HasNoHeadIfTheRigHasNone) {
  Person person;
  person.rig[Part::head] = {};
  EXPECT_FALSE(person.shell().head);
}

}  // namespace
}  // namespace signweave
