#include "signweave/render/place_correction.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>

#include "signweave/core/test_allocations.h"
#include "signweave/render/test_signing_person.h"

namespace signweave {
namespace {

using namespace testing_person;
using Eigen::Quaternionf;
using Eigen::Vector3f;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Optional;

constexpr float kDegrees = 180 / std::numbers::pi_v<float>;
const Person kPerson;  // NOLINT(cert-err58-cpp)

std::size_t joint(const std::string& name) {
  return slot(*kPerson.skeleton, name);
}

/// The wrist, relative to a space that the test computes itself.
struct Seen {
  Vector3f place;
  Quaternionf turn;
};
using InSpace = std::function<Seen(PoseView, Side)>;

Seen in_signer_space(PoseView pose, Side side) {
  const ModelPose model = to_model_space(*kPerson.skeleton, pose);
  const SignerSpace space = signer_space(*kPerson.signer.body, kPerson.signer.rig, model);
  const auto wrist = static_cast<std::size_t>(kPerson.arm(side).wrist);
  return {space.turn_to_signer(model.positions[wrist] - space.origin),
          space.model_from_signer.conjugate() * model.rotations[wrist]};
}
Seen in_head(PoseView pose, Side side) {
  const ModelPose model = to_model_space(*kPerson.skeleton, pose);
  const std::size_t head = joint("Head");
  const auto wrist = static_cast<std::size_t>(kPerson.arm(side).wrist);
  return {model.rotations[head].conjugate() * (model.positions[wrist] - model.positions[head]),
          model.rotations[head].conjugate() * model.rotations[wrist]};
}

float elbow_degrees(PoseView pose, Side side) {
  const ModelPose model = to_model_space(*kPerson.skeleton, pose);
  const ArmJoints arm = kPerson.arm(side);
  const auto at = [&](JointIndex which) { return model.positions[static_cast<std::size_t>(which)]; };
  const Vector3f upper = at(arm.shoulder) - at(arm.elbow);
  const Vector3f fore = at(arm.wrist) - at(arm.elbow);
  return kDegrees * std::acos(std::clamp(upper.normalized().dot(fore.normalized()), -1.0f, 1.0f));
}

/// The largest differences over all frames: millimetres and degrees.
struct Off {
  float mm = 0;
  float degrees = 0;
};
Off between(const Motion& source, const Motion& made, Side side, const InSpace& space) {
  Off off;
  for (std::int64_t frame = 0; frame < source.frame_count(); ++frame) {
    const Seen a = space(source.pose(frame), side);
    const Seen b = space(made.pose(frame), side);
    off.mm = std::max(off.mm, 1000 * (a.place - b.place).norm());
    off.degrees = std::max(off.degrees, kDegrees * a.turn.angularDistance(b.turn));
  }
  return off;
}

ComposedStroke stroke_of(const Motion& source, const Motion& composed, bool left, bool right) {
  return {.name = "X",
          .source = kPerson.all_of(source),
          .composed = kPerson.all_of(composed),
          .from_source = {left, right}};
}
void apply_all(ArmPlacer& placer, const PlaceCorrection& correction, const Motion& source, Motion& made,
               float weight = 1) {
  const std::vector<float> weights(static_cast<std::size_t>(source.frame_count()), weight);
  placer.apply(correction, kPerson.all_of(source), weights, made.poses({0, made.frame_count()}));
}
/// Corrects both arms.
Motion corrected(ArmPlacer& placer, const Motion& source, const Motion& composed,
                 const std::array<std::optional<PlaceCorrection>, 2>& corrections) {
  Motion made = composed;
  for (const auto& correction : corrections) {
    if (correction) apply_all(placer, *correction, source, made);
  }
  return made;
}

const TrunkTurn kTurned30 = [](float, MutablePoseView pose) {
  pose.rotations[joint("Spine")] = turn(30, Vector3f::UnitY());
};
const TrunkTurn kSwaying = [](float t, MutablePoseView pose) {
  pose.translations[0] += Vector3f(0.1f, 0.02f * t, 0.3f);
  pose.rotations[joint("Hips")] = turn(-25, Vector3f::UnitY());
  pose.rotations[joint("Spine")] = turn(15, Vector3f::UnitX()) * turn(20 * t, Vector3f::UnitY());
  pose.rotations[joint("Spine2")] = turn(6 * std::sin(5 * t), Vector3f::UnitZ());
};
const TrunkTurn kHeadTurned = [](float t, MutablePoseView pose) {
  pose.rotations[joint("Neck")] = turn(8, Vector3f::UnitX());
  pose.rotations[joint("Head")] = turn(20 + 5 * t, Vector3f::UnitY());
};

TEST(PlaceCorrection, EqualTrunksNeedNoneAndKeepEveryBit) {
  ArmPlacer placer = kPerson.placer();
  for (const Person::WristAt& path : {Person::WristAt(in_front), Person::WristAt(at_chin), Person::WristAt(together)}) {
    const Motion source = kPerson.stroke(path);
    const auto corrections = placer.corrections(stroke_of(source, source, true, true));
    for (const auto& correction : corrections) {
      EXPECT_TRUE(correction->none);
      EXPECT_FALSE(correction->why_not) << *correction->why_not;
    }
    EXPECT_TRUE(same_bits(corrected(placer, source, source, corrections), source));
  }
}

TEST(PlaceCorrection, AHandThatTouchesNothingKeepsItsPlaceInSignerSpace) {
  ArmPlacer placer = kPerson.placer();
  const Motion source = kPerson.stroke(in_front);
  for (const TrunkTurn& trunk : {kTurned30, kSwaying}) {
    const Motion composed = on_other_trunk(source, trunk);
    const auto corrections = placer.corrections(stroke_of(source, composed, true, true));
    const Motion made = corrected(placer, source, composed, corrections);
    for (const Side side : kSides) {
      const PlaceCorrection& correction = *corrections[static_cast<std::size_t>(side)];
      EXPECT_EQ(correction.anchor, Anchor::signer_space);
      EXPECT_FALSE(correction.why_not) << *correction.why_not;
      const Off off = between(source, made, side, in_signer_space);
      EXPECT_LT(off.mm, 0.1f);
      EXPECT_LT(off.degrees, 0.1f);
    }
  }
}

TEST(PlaceCorrection, CopyingAloneMissesThePlace) {
  const Motion source = kPerson.stroke(in_front);
  const Motion composed = on_other_trunk(source, kSwaying);
  EXPECT_GT(between(source, composed, Side::right, in_signer_space).mm, 20);
  EXPECT_GT(between(source, composed, Side::right, in_signer_space).degrees, 10);
}

TEST(PlaceCorrection, AHandAtTheHeadKeepsItsPlaceThere) {
  ArmPlacer placer = kPerson.placer();
  const Motion source = kPerson.stroke(at_chin);
  const Motion composed = on_other_trunk(source, kHeadTurned);
  const auto corrections = placer.corrections(stroke_of(source, composed, false, true));
  EXPECT_FALSE(corrections[0]);
  EXPECT_EQ(corrections[1]->anchor, Anchor::head);
  EXPECT_FALSE(corrections[1]->why_not) << *corrections[1]->why_not;
  EXPECT_TRUE(corrections[1]->out.isZero());
  const Off off = between(source, corrected(placer, source, composed, corrections), Side::right, in_head);
  EXPECT_LT(off.mm, 0.1f);
  EXPECT_LT(off.degrees, 0.1f);
  EXPECT_GT(corrections[1]->size_mm, 20);
}

TEST(PlaceCorrection, ASizeIsThatOfTheMotionFromCopiedToCorrected) {
  ArmPlacer placer = kPerson.placer();
  const Motion source = kPerson.stroke(in_front, 20, false);
  // A constant lean: the motion is the same in every frame, so it does not vary.
  const Motion composed = on_other_trunk(
      source, [](float, MutablePoseView pose) { pose.rotations[joint("Spine")] = turn(15, Vector3f::UnitX()); });
  const auto constant = placer.corrections(stroke_of(source, composed, false, true));
  EXPECT_NEAR(constant[1]->size_degrees, 15, 0.1);
  EXPECT_NEAR(constant[1]->turn.angularDistance(turn(-15, Vector3f::UnitX())), 0, 1e-3);
  EXPECT_LT(constant[1]->varies_mm, 0.2f);
  EXPECT_LT(constant[1]->varies_degrees, 0.1f);
  const Motion made = corrected(placer, source, composed, constant);
  float longest = 0;
  for (std::int64_t frame = 0; frame < made.frame_count(); ++frame) {
    HandMeter& meter = placer.meter();
    meter.look(made.pose(frame));
    const Vector3f palm = meter.palm(Side::right);
    meter.look(composed.pose(frame));
    longest = std::max(longest, 1000 * (palm - meter.palm(Side::right)).norm());
  }
  EXPECT_NEAR(constant[1]->size_mm, longest, 0.1);

  const Motion swaying = on_other_trunk(source, kSwaying);
  EXPECT_GT(placer.corrections(stroke_of(source, swaying, false, true))[1]->varies_mm, 5);
}

TEST(PlaceCorrection, OnlyShoulderElbowAndWristChange) {
  ArmPlacer placer = kPerson.placer();
  const Motion source = kPerson.stroke(in_front);
  const Motion composed = on_other_trunk(source, kSwaying);
  const Motion made = corrected(placer, source, composed, placer.corrections(stroke_of(source, composed, false, true)));
  std::array<int, 3> changed{};
  for (std::int64_t frame = 0; frame < made.frame_count(); ++frame) {
    Pose same(composed.pose(frame));
    const char* const names[] = {"RightArm", "RightForeArm", "RightHand"};
    for (std::size_t i = 0; i < 3; ++i) {
      const char* const name = names[i];
      const Quaternionf& now = made.pose(frame).rotations[joint(name)];
      EXPECT_GT(now.dot(same.rotations[joint(name)]), 0);
      if (now.coeffs() != same.rotations[joint(name)].coeffs()) ++changed[i];
      same.rotations[joint(name)] = now;
    }
    EXPECT_TRUE(std::ranges::equal(same.rotations, made.pose(frame).rotations,
                                   [](const auto& a, const auto& b) { return a.coeffs() == b.coeffs(); }));
    EXPECT_TRUE(std::ranges::equal(same.translations, made.pose(frame).translations));
  }
  EXPECT_THAT(changed, ::testing::Each(::testing::Gt(15)));
}

TEST(PlaceCorrection, TheElbowKeepsItsSwivelRelativeToTheAnchor) {
  ArmPlacer placer = kPerson.placer();
  const Motion source = kPerson.stroke(in_front, 20, false);
  // A lean about the line of the shoulders leaves both where they are, so the whole arm can stay.
  const Motion composed = on_other_trunk(
      source, [](float, MutablePoseView pose) { pose.rotations[joint("Spine")] = turn(20, Vector3f::UnitX()); });
  const Motion made = corrected(placer, source, composed, placer.corrections(stroke_of(source, composed, false, true)));
  const auto elbow = [](PoseView pose) {
    const ModelPose model = to_model_space(*kPerson.skeleton, pose);
    return signer_space(*kPerson.signer.body, kPerson.signer.rig, model)
        .to_signer(model.positions[joint("RightForeArm")]);
  };
  for (std::int64_t frame = 0; frame < made.frame_count(); ++frame) {
    EXPECT_LT((elbow(source.pose(frame)) - elbow(made.pose(frame))).norm(), 1e-3f);
  }
}

TEST(PlaceCorrection, AFrameDependsOnItselfOnly) {
  ArmPlacer placer = kPerson.placer();
  const Motion source = kPerson.stroke(at_chin);
  const Motion composed = on_other_trunk(source, kSwaying);
  const auto correction = *placer.corrections(stroke_of(source, composed, false, true))[1];
  Motion made = composed;
  apply_all(placer, correction, source, made, 0.4f);
  for (const std::int64_t frame : {13, 2, 19}) {
    Motion one = composed.slice({frame, frame + 1});
    const std::array weight = {0.4f};
    placer.apply(correction, view_of(source, {frame, frame + 1}), weight, one.poses({0, 1}));
    EXPECT_TRUE(same_bits(one, made.slice({frame, frame + 1})));
  }
}

TEST(PlaceCorrection, WeightsLeadFromTheCopiedToTheCorrectedPlace) {
  ArmPlacer placer = kPerson.placer();
  const Motion source = kPerson.stroke(in_front);
  const Motion composed = on_other_trunk(source, kSwaying);
  const auto correction = *placer.corrections(stroke_of(source, composed, false, true))[1];
  float last = std::numeric_limits<float>::max();
  for (const float weight : {0.0f, 0.25f, 0.5f, 0.75f, 1.0f}) {
    Motion made = composed;
    apply_all(placer, correction, source, made, weight);
    if (weight == 0) EXPECT_TRUE(same_bits(made, composed));
    const float now = between(source, made, Side::right, in_signer_space).mm;
    EXPECT_LT(now, last - 2);
    last = now;
  }
}

TEST(PlaceCorrection, ACorrectionThatIsNoneLeadsBackToTheCopy) {
  ArmPlacer placer = kPerson.placer();
  const Motion source = kPerson.stroke(in_front);
  const Motion composed = on_other_trunk(source, kSwaying);
  Motion made = composed;
  apply_all(placer, *placer.corrections(stroke_of(source, composed, false, true))[1], source, made);
  const PlaceCorrection none{.side = Side::right};
  const Off all = between(composed, made, Side::right, in_signer_space);
  apply_all(placer, none, source, made, 0.5f);
  EXPECT_NEAR(between(composed, made, Side::right, in_signer_space).degrees, all.degrees / 2, 2);
  apply_all(placer, none, source, made, 1);
  EXPECT_TRUE(same_bits(made, composed));
}

TEST(PlaceCorrection, APlaceBeyondReachIsRefusedInMillimetres) {
  ArmPlacer placer = kPerson.placer();
  // The right arm is nearly straight, and the other trunk leans to the right, where the shoulder is lower.
  const Motion source = kPerson.stroke(
      [](Side side, float) { return side == Side::left ? in_front(side, 0) : Vector3f(-0.15f, 1.62f, 0.44f); });
  const Motion composed = on_other_trunk(
      source, [](float, MutablePoseView pose) { pose.rotations[joint("Spine")] = turn(30, Vector3f::UnitZ()); });
  const auto correction = *placer.corrections(stroke_of(source, composed, false, true))[1];
  EXPECT_THAT(correction.why_not,
              Optional(AllOf(HasSubstr("the right hand cannot reach the place of 'X' with this trunk: "),
                             HasSubstr(" mm too far"))));
}

TEST(PlaceCorrection, APlaceThatBendsTheWristTooFarIsRefused) {
  ArmPlacer placer = kPerson.placer();
  const Motion source = kPerson.stroke(
      [](Side side, float) { return side == Side::left ? in_front(side, 0) : Vector3f(-0.15f, 1.85f, 0.2f); });
  const auto leaning = [&](float degrees) {
    const Motion composed = on_other_trunk(source, [=](float, MutablePoseView pose) {
      pose.rotations[joint("Spine")] = turn(degrees, Vector3f::UnitZ());
    });
    return placer.corrections(stroke_of(source, composed, false, true))[1]->why_not;
  };
  EXPECT_EQ(leaning(-3), std::nullopt);
  EXPECT_THAT(leaning(-30),
              Optional(AllOf(HasSubstr("the right wrist would bend "), HasSubstr("° beyond its limits"))));
}

TEST(PlaceCorrection, HandsThatTouchComeFromOneClipOrAreRefused) {
  ArmPlacer placer = kPerson.placer();
  const Motion source = kPerson.stroke(together);
  const Motion composed = on_other_trunk(source, kSwaying);
  const auto one = placer.corrections(stroke_of(source, composed, false, true));
  EXPECT_EQ(one[1]->anchor, Anchor::other_hand);
  EXPECT_THAT(one[1]->why_not,
              Optional(std::string("the right hand touches the left one in 'X': take both arms from it")));

  const auto both = placer.corrections(stroke_of(source, composed, true, true));
  EXPECT_FALSE(both[0]->why_not);
  EXPECT_FALSE(both[1]->why_not);
  const Motion made = corrected(placer, source, composed, both);
  for (std::int64_t frame = 0; frame < made.frame_count(); ++frame) {
    const auto relation = [](PoseView pose) {
      const ModelPose model = to_model_space(*kPerson.skeleton, pose);
      const Quaternionf& left = model.rotations[joint("LeftHand")];
      return Seen{left.conjugate() * (model.positions[joint("RightHand")] - model.positions[joint("LeftHand")]),
                  left.conjugate() * model.rotations[joint("RightHand")]};
    };
    const Seen a = relation(source.pose(frame));
    const Seen b = relation(made.pose(frame));
    EXPECT_LT((a.place - b.place).norm(), 1e-4f);
    EXPECT_LT(a.turn.angularDistance(b.turn), 1e-3f);
  }
}

TEST(PlaceCorrection, AHandThatWouldBeTooDeepIsMovedOutOrRefused) {
  ArmPlacer placer = kPerson.placer();
  const Motion source = kPerson.stroke([](Side side, float t) {
    return side == Side::left ? in_front(side, t) : Vector3f(-0.02f, 1.5f - 0.02f * t, 0.19f);
  });
  const auto with_head_forward = [&](float degrees) {
    return on_other_trunk(source, [&](float, MutablePoseView pose) {
      pose.rotations[joint("Neck")] = turn(degrees, {1, 0.2f, 0});
    });
  };
  const auto depth = [&](const Motion& motion) {
    return placer.meter().deepest(kPerson.all_of(motion), Side::right)[static_cast<std::size_t>(Obstacle::head)];
  };
  ASSERT_LT(depth(source), -0.03f);
  int moved = 0;
  int refused = 0;
  for (float degrees = 0; degrees < 80; degrees += 2) {
    const Motion composed = with_head_forward(degrees);
    const auto corrections = placer.corrections(stroke_of(source, composed, false, true));
    if (corrections[1]->why_not) {
      EXPECT_THAT(*corrections[1]->why_not, HasSubstr("deeper in the head than captured"));
      ++refused;
      continue;
    }
    EXPECT_LT(depth(corrected(placer, source, composed, corrections)), kDepthOfHandAllowed + 1e-4f);
    if (!corrections[1]->out.isZero()) ++moved;
  }
  EXPECT_GT(moved, 1);
  EXPECT_GT(refused, 1);
}

TEST(PlaceCorrection, AnUnknownBodyIsRefused) {
  Person headless;
  headless.signer.body.reset();
  ArmPlacer placer = headless.placer();
  const Motion source = kPerson.stroke(in_front);
  EXPECT_THAT(placer.corrections(stroke_of(source, source, true, false))[0]->why_not,
              Optional(std::string("the left arm of this body is unknown")));
}

TEST(PlaceCorrection, ASecondStrokeAllocatesNothing) {
  ArmPlacer placer = kPerson.placer();
  const Motion source = kPerson.stroke(in_front);
  Motion composed = on_other_trunk(source, kSwaying);
  const std::vector<float> weights(20, 0.7f);
  std::array<std::optional<PlaceCorrection>, 2> corrections;
  const auto correct = [&] {
    corrections = placer.corrections(stroke_of(source, composed, true, true));
    for (const auto& correction : corrections) {
      placer.apply(*correction, kPerson.all_of(source), weights, composed.poses({0, 20}));
    }
  };
  correct();
  EXPECT_EQ(allocations_in(correct), 0u);
}

RC_GTEST_PROP(PlaceCorrection, OnAnyTrunkTheLimitsHoldOrAReasonIsGiven, ()) {
  const auto random = [](int most) { return static_cast<float>(*rc::gen::inRange(-most, most + 1)); };
  const Person::WristAt path = *rc::gen::element<Person::WristAt>(in_front, at_chin, together);
  const Vector3f moved = 0.001f * Vector3f(random(80), random(80), random(80));
  const Motion source = kPerson.stroke([&](Side side, float t) { return Vector3f(path(side, t) + moved); }, 6);
  std::array<Vector3f, 4> turns;
  for (Vector3f& of_joint : turns) of_joint = {random(25), random(25), random(25)};
  const Motion composed = on_other_trunk(source, [&](float t, MutablePoseView pose) {
    pose.translations[0] += 0.01f * turns[0];
    const char* const names[] = {"Hips", "Spine2", "Neck", "Head"};
    for (std::size_t i = 0; i < 4; ++i) {
      pose.rotations[joint(names[i])] =
          turn((0.7f + 0.3f * t) * turns[i].norm() + 0.001f, turns[i] + Vector3f(0, 1e-3f, 0));
    }
  });
  ArmPlacer placer = kPerson.placer();
  const auto corrections = placer.corrections(stroke_of(source, composed, true, true));
  const Motion made = corrected(placer, source, composed, corrections);
  for (const Side side : kSides) {
    const PlaceCorrection& correction = *corrections[static_cast<std::size_t>(side)];
    for (std::int64_t frame = 0; frame < made.frame_count(); ++frame) {
      const float elbow = elbow_degrees(made.pose(frame), side);
      const float captured = elbow_degrees(source.pose(frame), side);
      RC_ASSERT(elbow > std::min(28.5f, captured - 0.1f));
      RC_ASSERT(elbow < std::max(178.0f, captured + 0.1f));
    }
    if (correction.why_not) continue;
    const InSpace space = correction.kept_in == Anchor::head ? InSpace(in_head) : InSpace(in_signer_space);
    if (correction.kept_in != Anchor::trunk) {
      const Off off = between(source, made, side, space);
      RC_ASSERT(off.mm < 1.1f + 1000 * correction.out.norm());
      RC_ASSERT(off.degrees < 0.5f);
    }
    const HandDepths before = placer.meter().deepest(kPerson.all_of(source), side);
    const HandDepths after = placer.meter().deepest(kPerson.all_of(made), side);
    for (std::size_t i = 0; i < before.size(); ++i) {
      RC_ASSERT(after[i] < std::max(before[i], 0.0f) + kDepthOfHandAllowed + 1e-4f);
    }
  }
}

TEST(WhyHandsCollide, DepthAndCrossingCountBeyondWhatWasCaptured) {
  const std::array captured = {HandsMeeting{.depth = -0.2f, .crossed = -0.1f},
                               HandsMeeting{.depth = 0.004f, .crossed = -0.3f}};
  EXPECT_EQ(why_hands_collide({.depth = 0.006f, .crossed = 0.01f}, captured), std::nullopt);
  EXPECT_THAT(why_hands_collide({.depth = 0.016f, .crossed = -0.1f}, captured),
              Optional(std::string("the hands are 12 mm deeper in each other than captured")));
  EXPECT_THAT(why_hands_collide({.depth = -0.1f, .crossed = 0.12f}, captured),
              Optional(std::string("the hands cross by 12 cm")));
}

}  // namespace
}  // namespace signweave
