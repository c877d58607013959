#include "signweave/choose/cut_points.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>

#include "signweave/choose/concatenate.h"
#include "signweave/rig/test_rig.h"
#include "signweave/score/test_motion.h"

namespace signweave {
namespace {

using testing_motion::angle;
using testing_motion::motion_of;

const std::shared_ptr<const Skeleton>& person() {
  static const std::shared_ptr<const Skeleton> skeleton = whole_person();
  return skeleton;
}

SignerRig rig_of_person() {
  SignerRig rig;
  rig.signer.rig = rig_of_signer(*person());
  rig.signer.body = signer_body(Motion(person(), {100, 1}, 1), rig.signer.rig);
  rig.groups = joint_groups(*person(), rig.signer.rig);
  return rig;
}

std::size_t joint(const char* name) {
  return static_cast<std::size_t>(*person()->find(name));
}

/// A sign whose hands are raised by given angles (radians) before, in and after its stroke, with minimum-jerk movements
/// in preparation and retraction.
struct Lift {
  float before = 0;
  float stroke = 0;
  float after = 0;
};
MotionClip lifted(const std::string& name, Lift left, Lift right, std::int64_t preparation = 40,
                  std::int64_t stroke = 30, std::int64_t retraction = 40) {
  const auto smooth = [](float t) { return t * t * t * (10.0f + t * (-15.0f + 6.0f * t)); };
  MotionClip result = testing_motion::clip(name, 0.0f, preparation, stroke, retraction, {100, 1}, person());
  Motion motion(person(), {100, 1}, result.source->frame_count());
  for (std::int64_t frame = 0; frame < motion.frame_count(); ++frame) {
    const auto part = [frame](std::int64_t from, std::int64_t count) {
      return std::clamp(static_cast<float>(frame - from) / static_cast<float>(std::max<std::int64_t>(1, count)), 0.0f,
                        1.0f);
    };
    const float up = smooth(part(result.whole.begin, preparation));
    const float down = smooth(part(result.core.end - 1, retraction));
    const auto lift = [&](Lift one) {
      return one.before + up * (one.stroke - one.before) + down * (one.after - one.stroke);
    };
    const auto turn = [&](const char* arm, float radians) {
      motion.pose(frame).rotations[joint(arm)] = Eigen::AngleAxisf(radians, Eigen::Vector3f::UnitZ());
    };
    turn("LeftArm", lift(left) - 1.2f);
    turn("RightArm", 1.2f - lift(right));
  }
  result.source = std::make_shared<MemorySource>(std::move(motion));
  return result;
}

Synthesis join(const std::vector<MotionClip>& clips, const GapMethod& fill, Milliseconds duration = 600ms) {
  const SignerRig rig = rig_of_person();
  const TransitionMethod method{"chosen", "", nullptr, &fill};
  return concatenate(clips, {.method = &method, .duration = duration, .rig = &rig});
}

std::vector<const GapMethod*> methods_for_signing() {
  std::vector<const GapMethod*> methods;
  for (const GapMethod& method : gap_methods()) {
    if (method.offered == Offered::signing) methods.push_back(&method);
  }
  return methods;
}

RC_GTEST_PROP(CutPoints, ACutHasTheLengthAskedForAndKeepsNoMoreThanThereIs, ()) {
  const auto lift = [] { return 0.1f * static_cast<float>(*rc::gen::inRange(-8, 15)); };
  const auto frames = [] { return *rc::gen::inRange<std::int64_t>(0, 90); };
  const std::int64_t preparation = frames();
  const std::int64_t retraction = frames();
  const MotionClip a = lifted("A", {lift(), lift(), lift()}, {lift(), lift(), lift()}, frames(), 20, retraction);
  const MotionClip b = lifted("B", {lift(), lift(), lift()}, {lift(), lift(), lift()}, preparation, 20, frames());
  const std::int64_t length = *rc::gen::inRange<std::int64_t>(1, 150);
  const Synthesis made = join({a, b}, *find_gap_method("gap"), Milliseconds(10 * length));
  const Junction& junction = made.junctions[0];
  RC_ASSERT(junction.frames.size() == length);
  for (const TransitionCut& cut : junction.cuts) {
    RC_ASSERT(cut.length == length);
    RC_ASSERT(cut.retraction_frames >= 0 && cut.retraction_frames <= retraction);
    RC_ASSERT(cut.preparation_frames >= 0 && cut.preparation_frames <= preparation);
    RC_ASSERT(cut.overlap() == 0);
    RC_ASSERT(cut.gap() >= std::min<std::int64_t>(length, 10));
    RC_ASSERT(cut.gap() + cut.kept_after() + cut.kept_before() == length);
    RC_ASSERT(junction.cut.kept_after() <= cut.kept_after());
    RC_ASSERT(junction.cut.kept_before() <= cut.kept_before());
  }
}

TEST(CutPoints, AHandAlreadyInPositionDoesNotGoDownAndUp) {
  // The right hand continues at another height; the left is raised in both signs, and at rest before and after.
  const MotionClip a = lifted("A", {0, 1.0f, 0}, {0, 0.6f, 0});
  const MotionClip b = lifted("B", {0, 1.0f, 0}, {0, 1.4f, 0});
  for (const GapMethod* method : methods_for_signing()) {
    const Synthesis made = join({a, b}, *method);
    const Junction& junction = made.junctions[0];
    const TransitionCut& left = junction.cuts[static_cast<std::size_t>(Timed::left)];
    EXPECT_TRUE(left.waits) << method->name;
    EXPECT_EQ(left.gap(), junction.frames.size()) << method->name;
    ModelPose before;
    ModelPose now;
    to_model_space(made.motion.skeleton(), made.motion.pose(junction.frames.begin - 1), before);
    for (std::int64_t frame = junction.frames.begin; frame <= junction.frames.end; ++frame) {
      to_model_space(made.motion.skeleton(), made.motion.pose(frame), now);
      EXPECT_LT((now.positions[joint("LeftHand")] - before.positions[joint("LeftHand")]).norm(), 0.001f)
          << method->name << ' ' << frame;
    }
    // The other hand moves.
    EXPECT_GT((now.positions[joint("RightHand")] - before.positions[joint("RightHand")]).norm(), 0.1f);
  }
}

TEST(CutPoints, ARetractionTowardsTheNextStrokeIsKept) {
  // Both were captured moving towards the other: A's hands go up after it, B's come from below.
  const MotionClip a = lifted("A", {0, 0.2f, 0.6f}, {0, 0.2f, 0.6f});
  const MotionClip b = lifted("B", {0.6f, 1.0f, 1.0f}, {0.6f, 1.0f, 1.0f});
  const TransitionCuts cuts = join({a, b}, *find_gap_method("gap")).junctions[0].cuts;
  for (const TransitionCut& cut : cuts) {
    EXPECT_GT(cut.retraction_frames + cut.preparation_frames, 20);
  }
}

TEST(CutPoints, ARetractionAwayFromTheNextStrokeIsNotKept) {
  const MotionClip a = lifted("A", {0, 0.6f, -0.4f}, {0, 0.6f, -0.4f});
  const MotionClip b = lifted("B", {-0.4f, 1.2f, 0}, {-0.4f, 1.2f, 0});
  const TransitionCuts cuts = join({a, b}, *find_gap_method("gap")).junctions[0].cuts;
  for (const Timed part : {Timed::left, Timed::right}) {
    const TransitionCut& cut = cuts[static_cast<std::size_t>(part)];
    EXPECT_LE(cut.retraction_frames, 8) << name_of(part);
    EXPECT_LE(cut.preparation_frames, 8) << name_of(part);
  }
}

TEST(CutPoints, EachHandHasItsOwnCutPoints) {
  // The left hand's retraction leads to the next stroke, the right hand's leads down.
  const MotionClip a = lifted("A", {0, 0.2f, 0.7f}, {0, 0.6f, -0.4f});
  const MotionClip b = lifted("B", {-0.6f, 1.0f, 0}, {-0.4f, 1.2f, 0});
  const Synthesis made = join({a, b}, *find_gap_method("gap"));
  const Junction& junction = made.junctions[0];
  const TransitionCut& left = junction.cuts[static_cast<std::size_t>(Timed::left)];
  const TransitionCut& right = junction.cuts[static_cast<std::size_t>(Timed::right)];
  ASSERT_GT(left.kept_after(), right.kept_after());
  // The left hand's kept frames are as captured while the right hand's are generated, so no recording is named.
  for (std::int64_t k = right.kept_after(); k < left.kept_after(); ++k) {
    const std::int64_t frame = junction.frames.begin + k;
    const Eigen::Quaternionf& captured = motion_of(a).pose(a.core.end + k).rotations[joint("LeftArm")];
    EXPECT_LT(angle(made.motion.pose(frame).rotations[joint("LeftArm")], captured), 1e-6) << k;
    EXPECT_EQ(made.sources[static_cast<std::size_t>(frame)].clip, FrameSource::kNone) << k;
  }
}

TEST(CutPoints, DifferentPartsMayShowBothSidesAtTheSameTime) {
  // The left hand continues as after A for long, the right hand moves as before B for long.
  const MotionClip a = lifted("A", {0, 0.0f, 0.9f}, {0, 0.6f, -0.6f}, 40, 30, 45);
  const MotionClip b = lifted("B", {-1.0f, 1.0f, 1.0f}, {0.6f, 1.6f, 0}, 45, 30, 40);
  const Synthesis made = join({a, b}, *find_gap_method("gap"));
  const Junction& junction = made.junctions[0];
  const TransitionCut& left = junction.cuts[static_cast<std::size_t>(Timed::left)];
  const TransitionCut& right = junction.cuts[static_cast<std::size_t>(Timed::right)];
  ASSERT_GT(left.kept_after() + right.kept_before(), junction.frames.size()) << "the intended case";
  for (std::int64_t k = 0; k < left.kept_after(); ++k) {
    const Eigen::Quaternionf& captured = motion_of(a).pose(a.core.end + k).rotations[joint("LeftArm")];
    EXPECT_LT(angle(made.motion.pose(junction.frames.begin + k).rotations[joint("LeftArm")], captured), 1e-6) << k;
  }
  for (std::int64_t k = 1; k <= right.kept_before(); ++k) {
    const Eigen::Quaternionf& captured = motion_of(b).pose(b.core.begin - k).rotations[joint("RightArm")];
    EXPECT_LT(angle(made.motion.pose(junction.frames.end - k).rotations[joint("RightArm")], captured), 1e-6) << k;
  }
  for (std::int64_t frame = 1; frame < made.motion.frame_count(); ++frame) {
    for (const char* arm : {"LeftArm", "RightArm"}) {
      EXPECT_LT(angle(made.motion.pose(frame - 1).rotations[joint(arm)], made.motion.pose(frame).rotations[joint(arm)]),
                0.15)
          << frame << ' ' << arm;
    }
  }
}

TEST(CutPoints, InAPauseTheHandsMoveToRestAsCaptured) {
  // The left hand rests in A; in B's recording it came down from another sign.
  MotionClip a = lifted("A", {0, 0, 0}, {0, 0.6f, 0});
  MotionClip b = lifted("B", {1.0f, 0.1f, 0}, {0, 1.4f, 0});
  b.pause_before = 800ms;
  const TransitionCuts cuts = join({a, b}, *find_gap_method("gap")).junctions[0].cuts;
  const TransitionCut& right = cuts[static_cast<std::size_t>(Timed::right)];
  EXPECT_EQ(right.length, 140);
  EXPECT_EQ(right.retraction_frames, 40);
  EXPECT_EQ(right.preparation_frames, 40);
  EXPECT_LE(cuts[static_cast<std::size_t>(Timed::left)].preparation_frames, 8);
}

}  // namespace
}  // namespace signweave
