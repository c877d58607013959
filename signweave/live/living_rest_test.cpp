#include "signweave/live/living_rest.h"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <functional>
#include <numbers>

#include "signweave/core/error.h"
#include "signweave/core/test_allocations.h"
#include "signweave/rig/test_rigs.h"

namespace signweave {
namespace {

using Eigen::Quaternionf;
using Eigen::Vector3f;

constexpr double kDegree = std::numbers::pi / 180;

Quaternionf about(const Vector3f& axis, double degrees) {
  return Quaternionf(Eigen::AngleAxisf(static_cast<float>(degrees * kDegree), axis));
}

JointIndex joint(const Motion& motion, std::string_view name) {
  return motion.skeleton().find(name).value_or(kNoJoint);
}

/// Lowers the arms, which rig_body holds out, to `degrees` below the horizontal.
void lower_arms(const Motion& motion, double degrees, MutablePoseView pose) {
  pose.rotations[static_cast<std::size_t>(joint(motion, "LeftArm"))] = about(Vector3f::UnitZ(), -degrees);
  pose.rotations[static_cast<std::size_t>(joint(motion, "RightArm"))] = about(Vector3f::UnitZ(), degrees);
}

/// One frame of a person standing with hanging arms.
Motion standing(const RigNaming& naming = {}) {
  Motion motion = rig_body(naming);
  const bool usual = joint(motion, "LeftArm") != kNoJoint && naming.left == "Left";
  if (usual) lower_arms(motion, 80, motion.pose(0));
  return motion;
}

/// A living rest from the first frame of a motion.
LivingRest living(const Motion& motion, FrameRate rate = {60, 1}, LivingRestOptions options = {}) {
  return LivingRest(motion.shared_skeleton(), rate, map_rig(motion), {.pose = Pose(std::as_const(motion).pose(0))}, {},
                    options);
}

/// Frames of a source as a motion without tracks.
Motion frames_of(const MotionSource& source, FrameRange range) {
  Motion motion(source.skeleton(), source.rate(), range.size());
  source.read(range, motion.poses({0, range.size()}));
  return motion;
}

/// Calls `see` for each frame of `seconds` seconds.
void watch(const LivingRest& rest, double seconds, const std::function<void(double, const ModelPose&)>& see) {
  const auto frames = static_cast<std::int64_t>(seconds * rest.rate().hertz());
  ModelPose model;
  for (std::int64_t begin = 0; begin < frames; begin += 600) {
    const Motion motion = frames_of(rest, {begin, begin + 600});
    for (std::int64_t frame = 0; frame < 600; ++frame) {
      to_model_space(motion.skeleton(), motion.pose(frame), model);
      see(static_cast<double>(begin + frame) / rest.rate().hertz(), model);
    }
  }
}

/// The eyelid values of `frames` frames.
std::vector<float> lids(const LivingRest& rest, std::int64_t frames, std::size_t track = 0) {
  std::vector<float> values(static_cast<std::size_t>(frames));
  std::vector<std::span<float>> out(rest.tracks().size());
  out[track] = values;
  rest.read_tracks({0, frames}, out);
  return values;
}

LivingRest with_face(FrameRate rate = {60, 1}, std::vector<float> open = {0, 0, 0.3f}) {
  const Motion motion = standing();
  return LivingRest(motion.shared_skeleton(), rate, map_rig(motion),
                    {.pose = Pose(std::as_const(motion).pose(0)), .tracks = std::move(open)},
                    {"eyeBlinkLeft", "eyeBlinkRight", "jawOpen"});
}

TEST(LivingRest, IsDeterministic) {
  const Motion motion = standing();
  const LivingRest rest = living(motion);
  const Motion whole = frames_of(rest, {5'000, 6'000});
  for (const std::int64_t step : {1, 7, 64}) {
    Motion parts(rest.skeleton(), rest.rate());
    for (std::int64_t begin = 5'000; begin < 6'000; begin += step) {
      const Motion part = frames_of(rest, {begin, std::min<std::int64_t>(begin + step, 6'000)});
      for (std::int64_t frame = 0; frame < part.frame_count(); ++frame) parts.append(part.pose(frame));
    }
    EXPECT_TRUE(same_bits(whole, parts)) << step;
  }
  EXPECT_TRUE(same_bits(whole, frames_of(living(motion), {5'000, 6'000})));
  EXPECT_TRUE(keeps_hemisphere(whole));

  const LivingRest face = with_face();
  const std::vector<float> all = lids(face, 600);
  for (std::int64_t frame = 599; frame >= 0; --frame) {
    float value = 7;
    face.read_tracks({frame, frame + 1}, std::vector<std::span<float>>{{&value, 1}, {}, {}});
    EXPECT_EQ(value, all[static_cast<std::size_t>(frame)]);
  }
}

TEST(LivingRest, FrameZeroIsTheRestPose) {
  const Motion motion = standing();
  const Motion first = frames_of(living(motion), {0, 1});
  for (std::size_t i = 0; i < motion.skeleton().joint_count(); ++i) {
    EXPECT_EQ(first.rotations()[i].coeffs(), motion.rotations()[i].coeffs()) << i;
  }
  EXPECT_EQ(first.translations()[0], motion.translations()[0]);
  EXPECT_EQ(lids(with_face({60, 1}, {0.25f, 0, 0}), 1)[0], 0.25f);
}

TEST(LivingRest, ReadingAllocatesNothing) {
  const LivingRest rest = with_face();
  Motion motion(rest.skeleton(), rest.rate(), 64);
  std::vector<float> left(64), jaw(64);
  const std::vector<std::span<float>> out = {left, {}, jaw};
  EXPECT_EQ(allocations_in([&] { rest.read({1'000, 1'064}, motion.poses({0, 64})); }), 0u);
  EXPECT_EQ(allocations_in([&] { rest.read_tracks({1'000, 1'064}, out); }), 0u);
}

TEST(LivingRest, NoJointRotatesFast) {
  constexpr double kFastest = 3;  // degrees a second
  for (const std::int64_t hertz : {30, 60, 120}) {
    const LivingRest rest = living(standing(), {hertz, 1});
    const Motion motion = frames_of(rest, {0, 120 * hertz});
    double fastest = 0;
    for (std::int64_t frame = 1; frame < motion.frame_count(); ++frame) {
      for (std::size_t i = 0; i < motion.skeleton().joint_count(); ++i) {
        const Quaternionf turn = motion.pose(frame - 1).rotations[i].conjugate() * motion.pose(frame).rotations[i];
        fastest = std::max(fastest, 2 * static_cast<double>(turn.vec().norm()) * static_cast<double>(hertz) / kDegree);
      }
    }
    EXPECT_LT(fastest, kFastest) << hertz;
    EXPECT_GT(fastest, 0.5) << hertz;
  }
}

TEST(LivingRest, HandsAndFeetAreStillAndTheGazeIsSteady) {
  const Motion motion = standing();
  const RigMap rig = map_rig(motion);
  ASSERT_TRUE(rig.has(Part::head) && rig.has(Part::left_foot));
  for (const std::uint64_t seed : {0u, 1u, 2u}) {
    const LivingRest rest = living(motion, {30, 1}, {.seed = seed});
    const ModelPose still = to_model_space(motion.skeleton(), std::as_const(motion).pose(0));
    float hands = 0;
    float hang = 0;
    float head = 0;
    float feet = 0;
    watch(rest, 600, [&](double, const ModelPose& pose) {
      for (const Side side : kSides) {
        const PartPlace& hand = rig[of(side, Part::left_hand)];
        const PartPlace& foot = rig[of(side, Part::left_foot)];
        hands = std::max(hands, (position_of(hand, pose) - position_of(hand, still)).norm());
        const auto wrist = static_cast<std::size_t>(hand.joint);
        hang = std::max(hang, pose.rotations[wrist].angularDistance(still.rotations[wrist]));
        feet = std::max(feet, (position_of(foot, pose) - position_of(foot, still)).norm());
      }
      const auto at = static_cast<std::size_t>(rig[Part::head].joint);
      head = std::max(head, pose.rotations[at].angularDistance(still.rotations[at]));
    });
    EXPECT_LT(hands, 0.01f);
    EXPECT_GT(hands, 0.001f);
    EXPECT_LT(static_cast<double>(head), 2 * kDegree);
    EXPECT_GT(static_cast<double>(head), 0.3 * kDegree);
    EXPECT_LT(static_cast<double>(hang), 0.1 * kDegree);  // arms keep hanging
    EXPECT_EQ(feet, 0);
  }
}

struct Breaths {
  std::vector<int> in_minute;
  double breathing_in = 0;  ///< share of the frames in which the shoulders rise
  float rise = 0;           ///< metres
};
Breaths breaths_of(const LivingRest& rest, const RigMap& rig, int minutes) {
  Breaths breaths{.in_minute = std::vector<int>(static_cast<std::size_t>(minutes))};
  std::vector<float> heights;
  watch(rest, 60 * minutes, [&](double, const ModelPose& pose) {
    heights.push_back(position_of(rig[Part::left_upper_arm], pose).y() +
                      position_of(rig[Part::right_upper_arm], pose).y());
  });
  const auto [low, high] = std::ranges::minmax(heights);
  const float lower = low + 0.35f * (high - low);
  const float upper = low + 0.5f * (high - low);
  breaths.rise = 0.5f * (high - low);
  bool in = false;
  int rising = 0;
  int falling = 0;
  for (std::size_t i = 1; i < heights.size(); ++i) {
    if (!in && heights[i] > upper) {
      in = true;
      ++breaths.in_minute[i * static_cast<std::size_t>(minutes) / heights.size()];
    }
    if (heights[i] < lower) in = false;
    const float step = (heights[i] - heights[i - 1]) / (high - low);
    if (step > 0.002f) ++rising;
    if (step < -0.002f) ++falling;
  }
  breaths.breathing_in = static_cast<double>(rising) / (rising + falling);
  return breaths;
}

TEST(LivingRest, BreathesTwelveToSixteenTimesAMinuteAndInhalesFaster) {
  const Motion motion = standing();
  for (const std::uint64_t seed : {0u, 7u}) {
    const Breaths breaths = breaths_of(living(motion, {30, 1}, {.seed = seed}), map_rig(motion), 10);
    for (const int count : breaths.in_minute) {
      EXPECT_GE(count, 12);
      EXPECT_LE(count, 16);
    }
    EXPECT_GT(breaths.rise, 0.001f);
    EXPECT_LT(breaths.rise, 0.01f);
    EXPECT_LT(breaths.breathing_in, 0.48);
    EXPECT_GT(breaths.breathing_in, 0.35);
  }
}

TEST(LivingRest, BlinksIrregularlyWithBothEyesFullyClosed) {
  for (const std::int64_t hertz : {25, 60, 120}) {
    const LivingRest rest = with_face({hertz, 1}, {0.1f, 0.2f, 0.3f});
    const std::int64_t frames = 600 * hertz;
    const std::vector<float> left = lids(rest, frames);
    const std::vector<float> right = lids(rest, frames, 1);
    std::vector<std::size_t> shut;
    std::size_t moving = 0;
    for (std::size_t i = 0; i < left.size(); ++i) {
      EXPECT_EQ(left[i] == 1, right[i] == 1) << i;
      EXPECT_NEAR((left[i] - 0.1f) / 0.9f, (right[i] - 0.2f) / 0.8f, 1e-5f);
      EXPECT_GE(left[i], 0.1f);
      EXPECT_LE(left[i], 1);
      if (left[i] == 1) shut.push_back(i);
      if (left[i] > 0.1f) ++moving;
    }
    EXPECT_GE(shut.size(), 100u);
    EXPECT_LE(shut.size(), 200u);
    double shortest = 100;
    double longest = 0;
    for (std::size_t i = 1; i < shut.size(); ++i) {
      const double gap = static_cast<double>(shut[i] - shut[i - 1]) / static_cast<double>(hertz);
      shortest = std::min(shortest, gap);
      longest = std::max(longest, gap);
      EXPECT_EQ(*std::min_element(left.begin() + static_cast<std::ptrdiff_t>(shut[i - 1]),
                                  left.begin() + static_cast<std::ptrdiff_t>(shut[i])),
                0.1f);
    }
    EXPECT_GE(shortest, 1.9);
    EXPECT_LT(shortest, 3);  // the intervals are irregular
    EXPECT_LE(longest, 6.1);
    EXPECT_GT(longest, 5);
    const double each = static_cast<double>(moving) / static_cast<double>(shut.size()) / static_cast<double>(hertz);
    EXPECT_NEAR(each, 0.23, 1.0 / static_cast<double>(hertz));
    // Other tracks are constant.
    const std::vector<float> jaw = lids(rest, 1'000, 2);
    EXPECT_EQ(std::ranges::count(jaw, 0.3f), 1'000);
  }
}

TEST(LivingRest, ASeedChangesTheMovement) {
  const Motion motion = standing();
  const Motion one = frames_of(living(motion, {60, 1}, {.seed = 1}), {0, 600});
  const Motion two = frames_of(living(motion, {60, 1}, {.seed = 2}), {0, 600});
  EXPECT_FALSE(same_bits(one, two));
  const Motion none = frames_of(living(motion, {60, 1}, {.amount = 0}), {0, 600});
  for (std::int64_t frame = 0; frame < 600; ++frame) {
    for (std::size_t i = 0; i < motion.skeleton().joint_count(); ++i) {
      EXPECT_TRUE(none.pose(frame).rotations[i].isApprox(motion.rotations()[i], 1e-6f));
    }
  }
}

/// The same body with other joint axes.
Motion with_other_axes(const Motion& motion) {
  std::vector<Quaternionf> axes;  // [joint] of this motion in the space of the other's
  std::vector<Joint> joints(motion.skeleton().joints().begin(), motion.skeleton().joints().end());
  for (std::size_t i = 0; i < joints.size(); ++i) {
    const auto turn = static_cast<float>(i);
    axes.push_back(Quaternionf(1, std::sin(turn), std::cos(2 * turn), 0.7f).normalized());
    if (joints[i].parent == kNoJoint) axes.back().setIdentity();
    if (joints[i].parent != kNoJoint) {
      joints[i].offset = axes[static_cast<std::size_t>(joints[i].parent)].conjugate() * joints[i].offset;
    }
  }
  std::vector<Tip> tips(motion.skeleton().tips().begin(), motion.skeleton().tips().end());
  for (Tip& tip : tips) tip.offset = axes[static_cast<std::size_t>(tip.joint)].conjugate() * tip.offset;
  Motion other(std::make_shared<const Skeleton>(joints, tips), motion.rate(), motion.frame_count());
  for (std::int64_t frame = 0; frame < motion.frame_count(); ++frame) {
    for (std::size_t i = 0; i < joints.size(); ++i) {
      const Quaternionf parent =
          joints[i].parent == kNoJoint ? Quaternionf::Identity() : axes[static_cast<std::size_t>(joints[i].parent)];
      other.pose(frame).rotations[i] = parent.conjugate() * motion.pose(frame).rotations[i] * axes[i];
    }
    std::ranges::copy(motion.pose(frame).translations, other.pose(frame).translations.begin());
  }
  return other;
}

/// Checks that two motions have the same joint positions, with the second rotated by `turn` about the origin.
void expect_same_places(const Motion& one, const Motion& two, const Quaternionf& turn = Quaternionf::Identity()) {
  float farthest = 0;
  for (std::int64_t frame = 0; frame < one.frame_count(); ++frame) {
    const ModelPose a = to_model_space(one.skeleton(), one.pose(frame));
    const ModelPose b = to_model_space(two.skeleton(), two.pose(frame));
    for (std::size_t i = 0; i < a.positions.size(); ++i) {
      farthest = std::max(farthest, (turn * a.positions[i] - b.positions[i]).norm());
    }
  }
  EXPECT_LT(farthest, 2e-5f);
}

TEST(LivingRest, DoesNotDependOnTheAxesOfTheRig) {
  const Motion motion = standing();
  const Motion usual = frames_of(living(motion), {0, 600});
  const Motion other = with_other_axes(motion);
  expect_same_places(usual, frames_of(living(other), {0, 600}));

  // Names that swap left and right.
  const Motion swapped = rig_body({.left = "Right", .right = "Left"});
  ASSERT_TRUE(map_rig(swapped).sides_swapped);
  expect_same_places(frames_of(living(rig_body({})), {0, 600}), frames_of(living(swapped), {0, 600}));

  // A person facing another direction.
  Motion turned = standing();
  const Quaternionf turn = about(Vector3f::UnitY(), 130);
  turned.pose(0).rotations[0] = turn;
  turned.pose(0).translations[0] = turn * turned.pose(0).translations[0];
  expect_same_places(usual, frames_of(living(turned), {0, 600}), turn);
}

TEST(LivingRest, BreathesWithTheJointsThatTheRigHas) {
  for (const RigNaming& naming : {RigNaming{.spine = ""}, RigNaming{.neck = ""}, RigNaming{.collar = ""}}) {
    const Motion motion = standing(naming);
    const LivingRest rest = living(motion, {30, 1}, {.amount = 5});
    const RigMap rig = map_rig(motion);
    const ModelPose still = to_model_space(motion.skeleton(), std::as_const(motion).pose(0));
    float shoulders = 0;
    float head = 0;
    watch(rest, 60, [&](double, const ModelPose& pose) {
      shoulders = std::max(
          shoulders,
          (position_of(rig[Part::left_upper_arm], pose) - position_of(rig[Part::left_upper_arm], still)).norm());
      const auto at = static_cast<std::size_t>(rig[Part::head].joint);
      head = std::max(head, pose.rotations[at].angularDistance(still.rotations[at]));
    });
    EXPECT_GT(shoulders, 0.005f);
    EXPECT_LT(static_cast<double>(head), 10 * kDegree);
  }
}

TEST(LivingRest, NeverRotatesAncestorsOfTheLegs) {
  const Motion motion = standing();
  RigMap rig = map_rig(motion);
  rig[Part::spine] = rig[Part::pelvis];
  const LivingRest rest(motion.shared_skeleton(), {60, 1}, rig, {.pose = Pose(std::as_const(motion).pose(0))}, {});
  const Motion moved = frames_of(rest, {0, 600});
  for (std::int64_t frame = 0; frame < 600; ++frame) {
    EXPECT_EQ(moved.pose(frame).rotations[0].coeffs(), motion.rotations()[0].coeffs());
  }
}

TEST(LivingRest, StandsStillIfTheRigIsUnknownOrSidesAreAmbiguous) {
  for (const std::vector<std::string>& names :
       {std::vector<std::string>{"a", "b", "c", "d"}, std::vector<std::string>{"Hips", "Spine", "Neck", "Head"}}) {
    std::vector<Joint> joints;
    for (const std::string& name : names) {
      joints.push_back({.name = name, .parent = static_cast<JointIndex>(joints.size()) - 1, .offset = {0, 0.3f, 0}});
    }
    joints.front().translated = true;
    const Motion motion(std::make_shared<const Skeleton>(joints, std::vector<Tip>{}), {60, 1}, 1);
    EXPECT_EQ(map_rig(motion).has(Part::head), names.front() == "Hips");
    const Motion still = frames_of(living(motion), {0, 600});
    for (std::int64_t frame = 0; frame < 600; ++frame) {
      for (std::size_t i = 0; i < joints.size(); ++i) {
        EXPECT_EQ(still.pose(frame).rotations[i].coeffs(), motion.rotations()[i].coeffs());
      }
    }
  }
}

TEST(LivingRest, RejectsARestPoseOfAnotherSkeleton) {
  const Motion motion = standing();
  EXPECT_THROW(LivingRest(motion.shared_skeleton(), {60, 1}, {}, {}, {}), Error);
  EXPECT_THROW(LivingRest(motion.shared_skeleton(), {60, 1}, {}, {.pose = Pose(motion.skeleton())}, {"jawOpen"}),
               Error);
}

}  // namespace
}  // namespace signweave
