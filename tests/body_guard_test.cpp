// Generated arm movement stays anatomically possible: hands outside head, trunk and each other, forearms outside the
// trunk, fingers outside each other, wrists within their limits. On the demo corpus, and between poses whose straight
// path leads through the body.
#include "signweave/transition/body_guard.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <random>
#include <set>

#include "signweave/choose/synthesizer.h"
#include "signweave/database/test_signing.h"
#include "signweave/rig/signer_space.h"
#include "signweave/semantic_db/semantic_db.h"
#include "signweave/transition/method.h"
#include "tests/demo_database.h"

namespace signweave {
namespace {

using testing_database::TestFolder;

const Database& guarded_corpus() {
  static const TestFolder folder;
  static const std::unique_ptr<const Database> database = demo_database(folder / "db", 4);
  return *database;
}

/// The depth of one hand in each capsule of the body, computed without the guard.
using Depths = std::array<float, 3>;
Depths depths_of(const Motion& motion, const SignerModel& signer, Side side, PoseView pose) {
  const ModelPose model = to_model_space(motion.skeleton(), pose);
  const SignerSpace space = signer_space(*signer.body, signer.rig, model);
  const BodyShell body = shell_of(*signer.body, signer.rig, space, model);
  HandPoints points;
  HandPlaces(signer.rig, side).read(model, points);
  const HandShell hand = shell_of(points, position_of(signer.rig[of(side, Part::left_forearm)], model), *signer.body);
  Depths depths{};
  const auto depth = [&](const Capsule& part) {
    float deepest = 0;
    for (const Capsule& bar : hand.all()) deepest = std::max(deepest, -clearance(bar, part));
    return deepest;
  };
  depths = {depth(body.torso[0]), depth(body.torso[1]), body.head ? depth(*body.head) : 0.0f};
  return depths;
}

/// The other quantities that the guard limits: the depths of the forearm in each side of the trunk, of the hand in the
/// other hand, and of each pair of fingers in each other, metres; and the bend of the wrist.
struct Limbs {
  std::array<float, 2> forearm{};
  float hands = 0;
  FingerDepths fingers{};
  WristBend bend;
};
Limbs limbs_of(const Motion& motion, const SignerModel& signer, Side side, PoseView pose) {
  const ModelPose model = to_model_space(motion.skeleton(), pose);
  const SignerSpace space = signer_space(*signer.body, signer.rig, model);
  const BodyShell body = shell_of(*signer.body, signer.rig, space, model);
  std::array<HandPoints, 2> points;
  std::array<HandShell, 2> hands;
  std::array<Eigen::Vector3f, 2> elbows;
  for (const Side each : kSides) {
    const auto i = static_cast<std::size_t>(each);
    HandPlaces(signer.rig, each).read(model, points[i]);
    elbows[i] = position_of(signer.rig[of(each, Part::left_forearm)], model);
    hands[i] = shell_of(points[i], elbows[i], *signer.body);
  }
  const auto own = static_cast<std::size_t>(side);
  Limbs limbs;
  const Capsule forearm = forearm_bar(elbows[own], points[own].wrist, *signer.body);
  for (std::size_t i = 0; i < 2; ++i) limbs.forearm[i] = std::max(0.0f, -clearance(forearm, body.torso[i]));
  for (const Capsule& a : hands[0].all()) {
    for (const Capsule& b : hands[1].all()) limbs.hands = std::max(limbs.hands, -clearance(a, b));
  }
  Phalanges phalanges;
  phalanges_of(points[own], finger_radii(points[own]), phalanges);
  limbs.fingers = finger_depths(finger_pairs(phalanges));
  limbs.bend = wrist_bend((points[own].wrist - elbows[own]).normalized(), axes_of(points[own], side));
  return limbs;
}
/// How much deeper a generated frame is than both borders, in millimetres: forearm, hands, fingers.
std::array<float, 3> deeper(const Limbs& made, const Limbs& left, const Limbs& right) {
  std::array<float, 3> most{};
  const auto look = [](float is, float a, float b, float& out) { out = std::max(out, 1000 * (is - std::max(a, b))); };
  for (std::size_t i = 0; i < 2; ++i) look(made.forearm[i], left.forearm[i], right.forearm[i], most[0]);
  look(made.hands, left.hands, right.hands, most[1]);
  for (std::size_t i = 0; i < kFingerPairs; ++i) look(made.fingers[i], left.fingers[i], right.fingers[i], most[2]);
  return most;
}
/// True if a wrist is bent beyond human limits, widened to five degrees beyond those at the borders (rigid palms).
bool is_beyond(const WristBend& bend, const WristBend& left, const WristBend& right) {
  const WristLimits limits = widened(widened(human_wrist(), left), right);
  return bend.flexion > limits.flexion.most || -bend.flexion > limits.extension.most ||
         bend.deviation > limits.radial.most || -bend.deviation > limits.ulnar.most;
}

float deeper(const Depths& made, const Depths& left, const Depths& right) {
  float most = 0;
  for (std::size_t i = 0; i < made.size(); ++i) most = std::max(most, made[i] - std::max(left[i], right[i]));
  return most;
}

TEST(BodyGuardOnTheDemo, NoMadeFrameIsDeeperThanFiveMillimetresInsideTheBody) {
  std::set<std::string> names;
  for (const Sign& sign : main_signs_of(guarded_corpus().contents()->segments, 0)) {
    if (sign.stroke_span()) names.insert(sign.gloss);
  }
  const std::vector<std::string> glosses(names.begin(), names.end());
  std::mt19937 random(7);
  std::size_t looked_at = 0;
  std::size_t gaps = 0;
  std::size_t crossed = 0;  // gaps in which hands or fingers penetrate each other by more than 5 mm
  for (int utterance = 0; utterance < 12; ++utterance) {
    Utterance asked;
    for (int i = 0; i < 8; ++i) {
      asked.places.push_back(place_of({glosses[random() % glosses.size()], 0}));
    }
    const Synthesized made = synthesize(guarded_corpus(), asked);
    const Motion& motion = made.result.motion;
    const SignerModel signer = model_of(motion);
    ASSERT_TRUE(signer.body);
    for (const Junction& junction : made.result.junctions) {
      for (const Side side : kSides) {
        const TransitionCut& cut =
            junction.cuts[static_cast<std::size_t>(side == Side::left ? Timed::left : Timed::right)];
        const FrameRange frames{junction.frames.begin + cut.kept_after(), junction.frames.end - cut.kept_before()};
        if (frames.empty()) continue;
        const Depths left = depths_of(motion, signer, side, motion.pose(frames.begin - 1));
        const Depths right = depths_of(motion, signer, side, motion.pose(frames.end));
        const Limbs from = limbs_of(motion, signer, side, motion.pose(frames.begin - 1));
        const Limbs to = limbs_of(motion, signer, side, motion.pose(frames.end));
        std::array<float, 3> deepest{};
        for (std::int64_t frame = frames.begin; frame < frames.end; ++frame) {
          EXPECT_LT(deeper(depths_of(motion, signer, side, motion.pose(frame)), left, right), 0.005f)
              << to_string(asked) << ", frame " << frame;
          const Limbs limbs = limbs_of(motion, signer, side, motion.pose(frame));
          EXPECT_FALSE(is_beyond(limbs.bend, from.bend, to.bend)) << to_string(asked) << ", frame " << frame;
          const std::array<float, 3> here = deeper(limbs, from, to);
          for (std::size_t i = 0; i < here.size(); ++i) deepest[i] = std::max(deepest[i], here[i]);
          ++looked_at;
        }
        EXPECT_LT(deepest[0], 5) << "forearm: " << to_string(asked) << ", from frame " << frames.begin;
        ++gaps;
        for (std::size_t i = 1; i < deepest.size(); ++i) crossed += deepest[i] > 5 ? 1 : 0;
      }
    }
  }
  EXPECT_GT(looked_at, 2000u);
  // Thin parts may have to pass through each other: a few cases remain.
  EXPECT_LT(crossed, gaps / 50) << gaps;
}

TEST(BodyGuard, LeadsAHandAroundTheBodyAndLeavesTheBordersAlone) {
  const Motion motion = guarded_corpus().read(guarded_corpus().contents()->recordings.front().name);
  const SignerModel signer = model_of(motion);
  const JointGroups groups = joint_groups(motion.skeleton(), signer.rig);
  BodyGuard guard(motion.skeleton(), signer, groups);
  GapScratch scratch;
  std::mt19937 random(3);
  int led_around = 0;
  int forearms_inside = 0;
  const auto number = [&] { return static_cast<float>(random() % 2001) / 1000.0f - 1.0f; };
  // A captured pose held still, with its right arm rotated at random.
  const auto anywhere = [&] {
    Motion held = motion.slice({100, 106});
    const Eigen::Vector3f shoulder = 1.2f * Eigen::Vector3f(number(), number(), number());
    const Eigen::Vector3f elbow = 0.7f * Eigen::Vector3f(number(), number(), number());
    const auto turn = [&](Part part, const Eigen::Vector3f& by) {
      const Eigen::Quaternionf turned(Eigen::AngleAxisf(by.norm(), by.normalized()));
      for (std::int64_t frame = 0; frame < held.frame_count(); ++frame) {
        Eigen::Quaternionf& q = held.pose(frame).rotations[static_cast<std::size_t>(signer.rig[part].joint)];
        q = q * turned;
      }
    };
    turn(Part::right_upper_arm, shoulder);
    turn(Part::right_forearm, elbow);
    return held;
  };
  for (int attempt = 0; attempt < 3000 && led_around < 6; ++attempt) {
    const Motion before = anywhere();
    const Motion after = anywhere();
    const Gap gap{.skeleton = &motion.skeleton(),
                  .groups = &groups,
                  .rate = motion.rate(),
                  .before = view_of(before, {0, 6}),
                  .after = view_of(after, {0, 6}),
                  .count = 40};
    // Both borders are outside the body, as in captured poses.
    const auto inside = [&](PoseView pose) {
      const Depths depths = depths_of(motion, signer, Side::right, pose);
      return *std::max_element(depths.begin(), depths.end()) > 0.01f;
    };
    if (inside(gap.left()) || inside(gap.right())) continue;
    Motion made(motion.shared_skeleton(), motion.rate(), gap.count);
    find_gap_method("sine")->fill({.gap = gap, .model = default_transition_model(), .scratch = scratch},
                                  made.poses({0, gap.count}));
    const auto deepest = [&](const Motion& frames) {
      float most = 0;
      for (const Side side : kSides) {
        const Depths left = depths_of(motion, signer, side, gap.left());
        const Depths right = depths_of(motion, signer, side, gap.right());
        for (std::int64_t frame = 0; frame < frames.frame_count(); ++frame) {
          most = std::max(most, deeper(depths_of(motion, signer, side, frames.pose(frame)), left, right));
        }
      }
      return most;
    };
    const Motion unguarded = made;
    const bool was_inside = deepest(unguarded) > 0.02f;
    const bool bent = guard.repair(gap, GroupSet::all(), made.poses({0, gap.count}));
    if (!was_inside) continue;
    ++led_around;
    EXPECT_TRUE(bent);
    EXPECT_LT(deepest(made), 0.005f) << attempt;
    const Limbs from = limbs_of(motion, signer, Side::right, gap.left());
    const Limbs to = limbs_of(motion, signer, Side::right, gap.right());
    float forearm = 0;
    for (std::int64_t frame = 0; frame < gap.count; ++frame) {
      const Limbs limbs = limbs_of(motion, signer, Side::right, made.pose(frame));
      EXPECT_FALSE(is_beyond(limbs.bend, from.bend, to.bend)) << attempt << ", frame " << frame;
      forearm = std::max(forearm, deeper(limbs, from, to)[0]);
    }
    forearms_inside += forearm > 5 ? 1 : 0;
    // Smooth: no step of a wrist is much longer than the longest one without the guard, and the first and last frames
    // hardly change.
    const auto wrist = [&](PoseView pose, Side side) {
      const ModelPose model = to_model_space(motion.skeleton(), pose);
      return model.positions[static_cast<std::size_t>(groups.wrists[static_cast<std::size_t>(side)])];
    };
    for (const Side side : kSides) {
      float longest = 0;
      float longest_before = 0;
      for (std::int64_t frame = 1; frame < gap.count; ++frame) {
        longest = std::max(longest, (wrist(made.pose(frame), side) - wrist(made.pose(frame - 1), side)).norm());
        longest_before = std::max(longest_before,
                                  (wrist(unguarded.pose(frame), side) - wrist(unguarded.pose(frame - 1), side)).norm());
      }
      EXPECT_LT(longest, 2 * longest_before + 0.02f);
      EXPECT_LT((wrist(made.pose(0), side) - wrist(unguarded.pose(0), side)).norm(), 0.01f);
      EXPECT_LT((wrist(made.pose(39), side) - wrist(unguarded.pose(39), side)).norm(), 0.01f);
    }
    for (const Eigen::Quaternionf& q : made.rotations()) EXPECT_NEAR(q.norm(), 1, 1e-4);
    for (std::size_t joint = 0; joint < motion.skeleton().joint_count(); ++joint) {
      const JointRole role = groups.roles[joint];
      if (role == JointRole::shoulder || role == JointRole::elbow || role == JointRole::other_arm) continue;
      if (role == JointRole::finger) continue;  // crossing fingers are bent
      EXPECT_EQ(made.pose(20).rotations[joint].coeffs(), unguarded.pose(20).rotations[joint].coeffs());
    }
  }
  EXPECT_GE(led_around, 3);
  EXPECT_LE(forearms_inside, 1);  // a whole arm moving from behind to the front passes through
}

TEST(BodyGuard, WhereNothingIsTooDeepEveryBitStays) {
  const Motion motion = guarded_corpus().read(guarded_corpus().contents()->recordings.front().name);
  const SignerModel signer = model_of(motion);
  const JointGroups groups = joint_groups(motion.skeleton(), signer.rig);
  BodyGuard guard(motion.skeleton(), signer, groups);
  Motion made = motion.slice({100, 101});
  const Gap gap{.skeleton = &motion.skeleton(),
                .groups = &groups,
                .rate = motion.rate(),
                .before = view_of(motion, {90, 100}),
                .after = view_of(motion, {101, 110}),
                .count = 1};
  EXPECT_FALSE(guard.repair(gap, GroupSet::all(), made.poses({0, 1})));
  EXPECT_EQ(std::memcmp(made.rotations().data(), motion.pose(100).rotations.data(), made.rotations().size_bytes()), 0);
}

}  // namespace
}  // namespace signweave
