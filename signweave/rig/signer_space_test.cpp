#include "signweave/rig/signer_space.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "signweave/rig/test_rig.h"

namespace signweave {
namespace {

using Eigen::AngleAxisf;
using Eigen::Quaternionf;
using Eigen::Vector3f;

constexpr float kDegree = std::numbers::pi_v<float> / 180;

/// A motion with its rig map, body and the space of one of its frames.
struct PosedPerson {
  Motion motion = Motion(whole_person(), {60, 1}, 1);
  RigMap rig = rig_of_signer(motion.skeleton());

  JointIndex joint(const char* name) const { return *motion.skeleton().find(name); }
  void turn(const char* name, const Quaternionf& rotation, std::int64_t frame = 0) {
    motion.pose(frame).rotations[static_cast<std::size_t>(joint(name))] = rotation;
  }
  SignerBody body() const { return *signer_body(motion, rig); }
  SignerSpace space(const SignerBody& body, std::int64_t frame = 0) const {
    return signer_space(body, rig, to_model_space(motion.skeleton(), motion.pose(frame)));
  }
};

float heading(const SignerSpace& space) {
  const Vector3f x = space.model_from_signer * Vector3f::UnitX();
  return std::atan2(-x.z(), x.x());
}

TEST(SignerSpaceOf, IsBetweenTheShouldersWithTheirDistanceAsUnit) {
  const PosedPerson person;
  const SignerSpace space = person.space(person.body());
  EXPECT_LT((space.origin - Vector3f(0, 1.38f, 0)).norm(), 1e-5f);
  EXPECT_NEAR(space.unit, 0.36f, 1e-5f);
  EXPECT_LT((space.to_signer({0.18f, 1.38f, 0}) - Vector3f(0.5f, 0, 0)).norm(), 1e-5f);  // the left shoulder
  EXPECT_LT((space.to_signer({0, 1.74f, 0.72f}) - Vector3f(0, 1, 2)).norm(), 1e-5f);
  EXPECT_LT((space.to_model(space.to_signer({0.1f, 0.2f, 0.3f})) - Vector3f(0.1f, 0.2f, 0.3f)).norm(), 1e-5f);
}

RC_GTEST_PROP(SignerSpaceOf, FollowsTheBodysPositionAndHeading, ()) {
  const unsigned seed = *rc::gen::inRange(0U, 1000U);
  const float turn = kDegree * static_cast<float>(*rc::gen::inRange(-180, 180));
  const Vector3f shift(static_cast<float>(*rc::gen::inRange(-50, 50)) / 10, 0.2f,
                       static_cast<float>(*rc::gen::inRange(-50, 50)) / 10);
  PosedPerson here;
  here.motion = moving(whole_person(), 3, seed);
  PosedPerson there = here;
  there.motion = placed(here.motion, turn, shift);
  const Vector3f place(0.3f, 1.2f, 0.4f);
  const Vector3f moved = AngleAxisf(turn, Vector3f::UnitY()) * place + shift;
  const Vector3f a = here.space(here.body(), 2).to_signer(place);
  const Vector3f b = there.space(there.body(), 2).to_signer(moved);
  RC_ASSERT((a - b).norm() < 1e-4f);
}

TEST(SignerSpaceOf, StaysUprightWhenTheTrunkLeans) {
  PosedPerson person;
  const SignerBody body = person.body();
  person.turn("Spine", Quaternionf(AngleAxisf(40 * kDegree, Vector3f::UnitX())));
  const SignerSpace space = person.space(body);
  EXPECT_NEAR(heading(space), 0, 1e-4f);
  EXPECT_LT((space.model_from_signer * Vector3f::UnitY() - Vector3f::UnitY()).norm(), 1e-5f);
  EXPECT_GT(space.origin.z(), 0.1f);  // it moves with the shoulders
}

TEST(SignerSpaceOf, DoesNotTurnWithAShrug) {
  PosedPerson person;
  const SignerBody body = person.body();
  person.turn("LeftShoulder", Quaternionf(AngleAxisf(30 * kDegree, Vector3f::UnitZ())));
  const SignerSpace space = person.space(body);
  EXPECT_NEAR(heading(space), 0, 1e-4f);
  EXPECT_LT((space.model_from_signer * Vector3f::UnitY() - Vector3f::UnitY()).norm(), 1e-5f);
  EXPECT_FLOAT_EQ(space.unit, body.shoulder_width);
}

TEST(SignerSpaceOf, BlendsToTheTrunksHeadingWhenOneShoulderIsAboveTheOther) {
  PosedPerson person;
  const SignerBody body = person.body();
  float before = 0;
  for (int degrees = 0; degrees <= 100; ++degrees) {
    // Turned to the left, then sideways until one shoulder is above the other and beyond.
    person.turn("Spine", AngleAxisf(25 * kDegree, Vector3f::UnitY()) *
                             AngleAxisf(static_cast<float>(degrees) * kDegree, Vector3f::UnitZ()));
    const float now = heading(person.space(body));
    if (degrees > 0) {
      EXPECT_LT(std::abs(now - before), 3 * kDegree) << degrees;
    }
    EXPECT_NEAR(now, 25 * kDegree, 1 * kDegree) << degrees;
    before = now;
  }
}

TEST(SignerSpaceOf, SurvivesAFrameInWhichTheShouldersCoincide) {
  PosedPerson person;
  person.motion = Motion(whole_person(), {60, 1}, 5);
  for (std::int64_t frame = 0; frame < 5; ++frame) {
    person.turn("Spine", Quaternionf(AngleAxisf(30 * kDegree, Vector3f::UnitY())), frame);
  }
  for (const std::size_t arm : {1U, 2U}) {  // moves both shoulders to the middle
    const float side = arm == 1 ? 1 : -1;
    person.motion.pose(2).translations[arm] = Vector3f(-0.03f * side, 0, 0);
  }
  const SignerBody body = person.body();
  EXPECT_NEAR(body.shoulder_width, 0.36f, 1e-4f);
  EXPECT_NEAR(heading(person.space(body, 1)), 30 * kDegree, 1e-3f);
  EXPECT_NEAR(heading(person.space(body, 2)), 30 * kDegree, 1e-3f);
  EXPECT_TRUE(person.space(body, 2).origin.allFinite());
}

TEST(SignerSpaceOf, NanInputStillGivesASpace) {
  PosedPerson person;
  const SignerBody body = person.body();
  person.motion.pose(0).translations[1].x() = std::numeric_limits<float>::quiet_NaN();
  const SignerSpace space = person.space(body);
  EXPECT_TRUE(space.to_signer({1, 1, 1}).allFinite());
}

TEST(SignerBodyOf, ReadsHeightsFromTheBodysOwnJoints) {
  const SignerBody body = PosedPerson().body();
  const auto metres = [&](Height height) { return 0.36f * body.heights[static_cast<std::size_t>(height)] + 1.38f; };
  EXPECT_EQ(body.heights[0], -std::numeric_limits<float>::infinity());
  EXPECT_NEAR(metres(Height::waist), 0.95f, 1e-4f);       // the hips
  EXPECT_NEAR(metres(Height::chest), 1.165f, 1e-4f);      // half way to the shoulders
  EXPECT_NEAR(metres(Height::forehead), 1.60f, 1e-4f);    // the eyes
  EXPECT_NEAR(metres(Height::above_head), 1.71f, 1e-4f);  // the head's end
  EXPECT_GT(metres(Height::mouth), metres(Height::chin));
  EXPECT_NEAR(body.arm_length, 0.53f / 0.36f, 1e-4f);
  EXPECT_GT(body.near_reach, 0);
}

TEST(SignerBodyOf, UsesHumanProportionsForMissingLandmarks) {
  PosedPerson person;
  const SignerBody whole = person.body();
  for (const Part part : {Part::pelvis, Part::left_thigh, Part::right_thigh, Part::head, Part::head_top, Part::left_eye,
                          Part::right_eye, Part::neck}) {
    person.rig[part] = {};
  }
  const SignerBody bare = person.body();
  for (std::size_t i = 1; i < bare.heights.size(); ++i) {
    EXPECT_NEAR(bare.heights[i], whole.heights[i], 0.2f) << name_of(static_cast<Height>(i));
    EXPECT_GT(bare.heights[i], bare.heights[i - 1]);
  }
  // A head top below the shoulders is not plausible.
  person.rig[Part::head_top] = person.rig[Part::left_hand];
  person.rig[Part::head_top].offset = {0, -0.6f, 0};
  EXPECT_EQ(person.body().heights, bare.heights);
}

TEST(SignerBodyOf, IsNotMisledByAFewOddFrames) {
  PosedPerson person;
  const SignerBody calm = person.body();
  person.motion = Motion(whole_person(), {60, 1}, 20);
  for (std::int64_t frame = 0; frame < 6; ++frame) person.motion.pose(frame).translations[1].x() = 5;
  const SignerBody odd = person.body();
  EXPECT_FLOAT_EQ(odd.shoulder_width, calm.shoulder_width);
  for (std::size_t i = 1; i < odd.heights.size(); ++i) EXPECT_NEAR(odd.heights[i], calm.heights[i], 1e-4f);
}

TEST(SignerBodyOf, IsEmptyWithoutShouldersAndSaysWhy) {
  PosedPerson person;
  person.rig[Part::right_upper_arm] = {};
  EXPECT_FALSE(signer_body(person.motion, person.rig));
  EXPECT_EQ(why_no_signer_space(person.rig), "no right shoulder: name it in a mapping file");
  PosedPerson joined;
  joined.rig[Part::right_upper_arm] = joined.rig[Part::left_upper_arm];
  EXPECT_FALSE(signer_body(joined.motion, joined.rig));
  EXPECT_FALSE(signer_body(Motion(whole_person(), {60, 1}, 0), PosedPerson().rig));
}

TEST(ZoneOf, HasBordersThatBelongToTheHigherZone) {
  const SignerBody body = PosedPerson().body();
  const auto height = [&](float y) { return zone_of({0, y, 0}, body).height; };
  EXPECT_EQ(height(-100), Height::below_waist);
  for (std::size_t i = 1; i < body.heights.size(); ++i) {
    EXPECT_EQ(height(body.heights[i]), static_cast<Height>(i));
    EXPECT_EQ(height(std::nextafter(body.heights[i], -10.0f)), static_cast<Height>(i - 1));
  }
  EXPECT_EQ(zone_of({0.7f, 0, 0}, body).across, Across::left);
  EXPECT_EQ(zone_of({-0.5f, 0, 0}, body).across, Across::centre);
  EXPECT_EQ(zone_of({-0.7f, 0, 0}, body).across, Across::right);
  EXPECT_EQ(zone_of({0, 0, body.near_reach}, body).reach, Reach::near);
  EXPECT_EQ(zone_of({0, 0, body.near_reach + 0.01f}, body).reach, Reach::far);
  EXPECT_EQ(name_of(Height::chin), "chin");
  EXPECT_EQ(name_of(Across::centre), "centre");
  EXPECT_EQ(name_of(Reach::far), "far");
}

}  // namespace
}  // namespace signweave
