#include "signweave/transition/finger_guard.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <numbers>
#include <random>

#include "signweave/core/test_allocations.h"
#include "signweave/rig/test_rig.h"
#include "signweave/transition/method.h"

namespace signweave {
namespace {

using Eigen::AngleAxisf;
using Eigen::Vector3f;

constexpr float kDegree = std::numbers::pi_v<float> / 180;

/// Gaps between two handshapes of the test person's left hand, each held for a moment.
struct Hands {
  std::shared_ptr<const Skeleton> skeleton = whole_person();
  RigMap rig = rig_of_signer(*skeleton);
  JointGroups groups = joint_groups(*skeleton, rig);
  std::mt19937 random{5};
  Motion before, after;

  float degrees(int from, int to) {
    return kDegree * static_cast<float>(from + static_cast<int>(random() % static_cast<unsigned>(to - from)));
  }
  /// An arbitrary possible handshape, without fingers inside each other.
  Motion held() {
    for (;;) {
      Motion motion = bent_anyhow();
      const FingerDepths all = depths(motion.pose(0));
      if (*std::max_element(all.begin(), all.end()) < 0.001f) return motion;
    }
  }
  Motion bent_anyhow() {
    Motion motion(skeleton, {100, 1}, 8);
    for (const Finger finger : kFingers) {
      const bool thumb = finger == Finger::thumb;
      const float bend = thumb ? degrees(-10, 50) : degrees(-5, 90);
      const float beyond = thumb ? degrees(0, 40) : degrees(0, 80);
      const float spread = thumb ? degrees(-70, 10) : degrees(-12, 12);
      for (const FingerPoint point : {FingerPoint::proximal, FingerPoint::intermediate, FingerPoint::distal}) {
        const auto joint = static_cast<std::size_t>(rig[finger_part(Side::left, finger, point)].joint);
        const bool first = point == FingerPoint::proximal;
        for (std::int64_t frame = 0; frame < motion.frame_count(); ++frame) {
          motion.pose(frame).rotations[joint] = AngleAxisf(first ? -spread : 0, Vector3f::UnitY()) *
                                                AngleAxisf(-(first ? bend : beyond), Vector3f::UnitZ());
        }
      }
    }
    return motion;
  }
  Gap gap(std::int64_t count) {
    before = held();
    after = held();
    return {.skeleton = skeleton.get(),
            .groups = &groups,
            .rate = {100, 1},
            .before = view_of(before, {0, 8}),
            .after = view_of(after, {0, 8}),
            .count = count};
  }
  Motion made(const Gap& gap) {
    Motion motion(skeleton, gap.rate, gap.count);
    GapScratch scratch;
    find_gap_method("sine")->fill({.gap = gap, .model = default_transition_model(), .scratch = scratch},
                                  motion.poses({0, gap.count}));
    return motion;
  }
  HandPoints points(PoseView pose) const {
    HandPoints points;
    HandPlaces(rig, Side::left).read(to_model_space(*skeleton, pose), points);
    return points;
  }
  /// The depth of each pair of fingers, measured without the guard.
  FingerDepths depths(PoseView pose) const {
    Phalanges phalanges;
    phalanges_of(points(pose), finger_radii(points(pose)), phalanges);
    return finger_depths(finger_pairs(phalanges));
  }
  /// The largest excess of a pair's depth in a frame over both borders, metres.
  float beyond(const Gap& gap, const Motion& motion) const {
    const FingerDepths left = depths(gap.left());
    const FingerDepths right = depths(gap.right());
    float most = 0;
    for (std::int64_t frame = 0; frame < motion.frame_count(); ++frame) {
      const FingerDepths here = depths(motion.pose(frame));
      for (std::size_t i = 0; i < here.size(); ++i) most = std::max(most, here[i] - std::max(left[i], right[i]));
    }
    return most;
  }
};

TEST(FingerGuard, FewCrossingsRemainAndNoneGetsDeeper) {
  Hands hands;
  FingerGuard guard(*hands.skeleton, hands.rig, Side::left);
  ASSERT_TRUE(guard.known());
  int crossed = 0;
  int left_over = 0;
  for (int attempt = 0; attempt < 800; ++attempt) {
    const Gap gap = hands.gap(30);
    Motion made = hands.made(gap);
    const Motion unguarded = made;
    const float before = hands.beyond(gap, unguarded);
    const bool bent = guard.repair(gap, made.poses({0, gap.count}));
    const float after = hands.beyond(gap, made);
    // Frames that are not examined may be slightly deeper.
    EXPECT_LE(after, std::max(before, kFingerDepthAllowed) + 0.0015f) << attempt;
    if (bent) EXPECT_GT(before, kFingerDepthAllowed) << attempt;
    if (before > kFingerDepthAllowed + 0.0015f) EXPECT_TRUE(bent) << attempt;
    crossed += before > 0.005f ? 1 : 0;
    left_over += before > 0.005f && after > 0.003f ? 1 : 0;
    if (!bent) {
      EXPECT_EQ(std::memcmp(made.rotations().data(), unguarded.rotations().data(), made.rotations().size_bytes()), 0);
    }
    // Only fingers of this hand are changed; the first and the last frame are nearly unchanged, so velocity is
    // continuous.
    for (std::size_t joint = 0; joint < hands.skeleton->joint_count(); ++joint) {
      for (const std::int64_t frame : {std::int64_t{0}, gap.count / 2, gap.count - 1}) {
        const Eigen::Quaternionf& is = made.pose(frame).rotations[joint];
        const Eigen::Quaternionf& was = unguarded.pose(frame).rotations[joint];
        if (hands.groups.of[joint] != JointGroup::left_fingers) EXPECT_EQ(is.coeffs(), was.coeffs());
        EXPECT_NEAR(is.norm(), 1, 1e-5f);
        if (frame != gap.count / 2) EXPECT_LT(is.angularDistance(was), 10 * kDegree) << attempt << ' ' << joint;
      }
    }
  }
  EXPECT_GT(crossed, 20);
  EXPECT_LE(left_over, crossed / 4) << crossed;
}

TEST(FingerGuard, TheSecondGapAllocatesNothing) {
  Hands hands;
  FingerGuard guard(*hands.skeleton, hands.rig, Side::left);
  int bent = 0;
  for (int attempt = 0; attempt < 40; ++attempt) {
    const Gap gap = hands.gap(30);
    Motion made = hands.made(gap);
    bool now = false;
    const auto allocated = allocations_in([&] { now = guard.repair(gap, made.poses({0, gap.count})); });
    if (bent > 0) EXPECT_EQ(allocated, 0u);
    bent += now ? 1 : 0;
  }
  EXPECT_GT(bent, 3);
}

TEST(FingerGuard, IsUnknownWithoutFingers) {
  const auto skeleton = whole_person(1, false);
  EXPECT_FALSE(FingerGuard(*skeleton, rig_of_signer(*skeleton), Side::left).known());
}

}  // namespace
}  // namespace signweave
