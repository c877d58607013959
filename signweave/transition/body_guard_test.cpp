#include "signweave/transition/body_guard.h"

#include <gtest/gtest.h>

#include "signweave/core/test_allocations.h"
#include "signweave/rig/test_rig.h"
#include "signweave/transition/method.h"

namespace signweave {
namespace {

using Eigen::AngleAxisf;
using Eigen::Quaternionf;
using Eigen::Vector3f;

/// The test person's left hand moves from one side of the trunk to the other, low and with a bent elbow: straight
/// through it.
struct ThroughTheTrunk {
  std::shared_ptr<const Skeleton> skeleton;
  Motion before, after;
  SignerModel signer;
  JointGroups groups;
  Gap gap;

  explicit ThroughTheTrunk(bool fingers, std::int64_t count = 40) : skeleton(whole_person(1, fingers)) {
    signer.rig = rig_of_signer(*skeleton);
    before = held(-0.9f);
    after = held(0.9f);
    signer.body = signer_body(before, signer.rig);
    groups = joint_groups(*skeleton, signer.rig);
    gap = {.skeleton = skeleton.get(),
           .groups = &groups,
           .rate = {100, 1},
           .before = view_of(before, {0, 8}),
           .after = view_of(after, {0, 8}),
           .count = count};
  }
  Motion held(float turn) const {
    Motion motion(skeleton, {100, 1}, 8);
    const auto set = [&](Part part, const Quaternionf& to) {
      for (std::int64_t frame = 0; frame < motion.frame_count(); ++frame) {
        motion.pose(frame).rotations[static_cast<std::size_t>(signer.rig[part].joint)] = to;
      }
    };
    set(Part::left_upper_arm, Quaternionf(AngleAxisf(-1.3f, Vector3f::UnitZ())));
    // Rotated out of the plane of the trunk: forwards for a negative angle, backwards for a positive one.
    set(Part::left_forearm,
        Quaternionf(AngleAxisf(1.2f * turn, Vector3f::UnitX())) * Quaternionf(AngleAxisf(-1.9f, Vector3f::UnitZ())));
    return motion;
  }
  Motion filled() const {
    Motion made(skeleton, gap.rate, gap.count);
    GapScratch scratch;
    find_gap_method("sine")->fill({.gap = gap, .model = default_transition_model(), .scratch = scratch},
                                  made.poses({0, gap.count}));
    return made;
  }
  /// Maximum depth of the hand in the trunk, metres.
  float deepest(const Motion& motion) const {
    float depth = 0;
    for (std::int64_t frame = 0; frame < motion.frame_count(); ++frame) {
      const ModelPose model = to_model_space(*skeleton, motion.pose(frame));
      HandPoints points;
      HandPlaces(signer.rig, Side::left).read(model, points);
      const HandShell hand = shell_of(points, position_of(signer.rig[Part::left_forearm], model), *signer.body);
      const BodyShell body = shell_of(*signer.body, signer.rig, signer_space(*signer.body, signer.rig, model), model);
      for (const Capsule& bar : hand.all()) {
        for (const Capsule& side : body.torso) depth = std::max(depth, -clearance(bar, side));
      }
    }
    return depth;
  }
};

TEST(BodyGuardOfATestPerson, GuardsHandsWithAndWithoutFingers) {
  for (const bool fingers : {true, false}) {
    const ThroughTheTrunk through(fingers);
    ASSERT_TRUE(through.signer.body);
    Motion made = through.filled();
    const float allowed = std::max(through.deepest(through.before), through.deepest(through.after)) + 0.004f;
    ASSERT_GT(through.deepest(made), allowed + 0.02f) << fingers;
    BodyGuard guard(*through.skeleton, through.signer, through.groups);
    EXPECT_TRUE(guard.repair(through.gap, GroupSet::all(), made.poses({0, made.frame_count()})));
    EXPECT_LT(through.deepest(made), allowed) << fingers;
  }
}

/// Both arms forwards and raised by an angle, with forearms turned inwards by another angle, which is smaller by `less`
/// in the first and the last frame.
Motion arms_forward(const ThroughTheTrunk& person, float raised, float most_inwards, std::int64_t frames,
                    float less = 0) {
  Motion motion(person.skeleton, {100, 1}, frames);
  for (std::int64_t frame = 0; frame < frames; ++frame) {
    const float middle = 0.5f * static_cast<float>(frames - 1);
    const float inwards =
        most_inwards - (less > 0 ? less * std::abs(static_cast<float>(frame) - middle) / middle : 0.0f);
    for (const float side : {1.0f, -1.0f}) {
      const auto turn = [&](Part part, float up, float in) {
        motion.pose(frame).rotations[static_cast<std::size_t>(person.signer.rig[part].joint)] =
            Quaternionf(AngleAxisf(-up, Vector3f::UnitX())) * Quaternionf(AngleAxisf(-side * in, Vector3f::UnitY()));
      };
      turn(side > 0 ? Part::left_upper_arm : Part::right_upper_arm, raised, 1.5f);
      turn(side > 0 ? Part::left_forearm : Part::right_forearm, 0, inwards);
    }
  }
  return motion;
}

Vector3f wrist_of(const ThroughTheTrunk& person, const Motion& motion, Part hand) {
  return position_of(person.signer.rig[hand], to_model_space(*person.skeleton, motion.pose(motion.frame_count() / 2)));
}

/// How far a guard moves the left hand, which is inside the right one with the wrists `wrists` apart, between borders
/// with the hands next to each other. Metres.
float led_apart(float wrists) {
  ThroughTheTrunk person(true);
  float inwards = 0;
  const auto apart = [&] {
    const Motion motion = arms_forward(person, 0, inwards, 1);
    return (wrist_of(person, motion, Part::left_hand) - wrist_of(person, motion, Part::right_hand)).norm();
  };
  while (apart() > wrists && inwards < 1.5f) inwards += 0.01f;
  EXPECT_LT(inwards, 1.5f);
  person.before = arms_forward(person, -0.5f, 0, 8);
  person.after = arms_forward(person, 0.5f, 0, 8);
  person.gap.before = view_of(person.before, {0, 8});
  person.gap.after = view_of(person.after, {0, 8});
  const Motion inside = arms_forward(person, 0, inwards, person.gap.count, 0.2f);
  Motion made = inside;
  BodyGuard guard(*person.skeleton, person.signer, person.groups);
  guard.repair(person.gap, {JointGroup::left_arm}, made.poses({0, made.frame_count()}));
  return (wrist_of(person, made, Part::left_hand) - wrist_of(person, inside, Part::left_hand)).norm();
}

TEST(BodyGuardOfATestPerson, MovesAHandOutOfTheOtherByAtMostItsBreadth) {
  EXPECT_GT(led_apart(0.2f), 0.05f);
  for (const float wrists : {0.2f, 0.16f, 0.12f, 0.08f}) EXPECT_LT(led_apart(wrists), 0.101f) << wrists;
}

TEST(BodyGuardOfATestPerson, TheSecondGapAllocatesNothing) {
  const ThroughTheTrunk through(true);
  BodyGuard guard(*through.skeleton, through.signer, through.groups);
  Motion first = through.filled();
  guard.repair(through.gap, GroupSet::all(), first.poses({0, first.frame_count()}));
  Motion second = through.filled();
  EXPECT_EQ(allocations_in([&] {
              guard.repair(through.gap, GroupSet::all(), second.poses({0, second.frame_count()}));
            }),
            0u);
  // The result does not depend on earlier calls.
  for (std::size_t i = 0; i < first.rotations().size(); ++i) {
    ASSERT_EQ(first.rotations()[i].coeffs(), second.rotations()[i].coeffs());
  }
}

}  // namespace
}  // namespace signweave
