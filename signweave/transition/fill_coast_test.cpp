#include <gtest/gtest.h>

#include <cmath>

#include "signweave/transition/method.h"
#include "signweave/transition/test_gap_motion.h"

namespace signweave {
namespace {

using testing_gap::angle;

std::shared_ptr<const Skeleton> skeleton() {
  return std::make_shared<const Skeleton>(std::vector<Joint>{{"Hips", kNoJoint, {0, 1, 0}, true},
                                                             {"Spine", 0, {0, 0.3f, 0}, false},
                                                             {"Arm", 1, {0.2f, 0.1f, 0}, false},
                                                             {"Hand", 2, {0.3f, 0, 0}, false}},
                                          std::vector<Tip>{});
}

/// A motion in which every joint rotates continuously, differently for each `seed`.
Motion moving(std::int64_t frames, float seed) {
  Motion motion(skeleton(), {100, 1}, frames);
  for (std::int64_t frame = 0; frame < frames; ++frame) {
    const float t = 0.01f * static_cast<float>(frame);
    for (std::size_t joint = 0; joint < 4; ++joint) {
      const float phase = seed + static_cast<float>(joint);
      const Eigen::Vector3f axis = Eigen::Vector3f(std::sin(phase), 1.0f, std::cos(phase)).normalized();
      motion.pose(frame).rotations[joint] = Eigen::AngleAxisf(0.6f * std::sin(2.0f * t + phase), axis);
    }
    motion.pose(frame).translations[0] = {seed + 0.05f * std::sin(t), 1.0f, 0.5f * seed};
  }
  return motion;
}

/// Joints 2 and 3 are the left arm, the others the body.
JointGroups arm_groups() {
  JointGroups groups;
  groups.of = {JointGroup::body, JointGroup::body, JointGroup::left_arm, JointGroup::left_arm};
  groups.all[0] = {0, 1};
  groups.all[1] = {2, 3};
  groups.of_translation = {JointGroup::body};
  return groups;
}

/// The frames of `a`, a filled gap, the frames of `b`. The groups in `parts` are filled one after the other.
Motion with_gap(const Motion& a, const Motion& b, std::int64_t count, const std::vector<GroupSet>& parts) {
  Motion all(a.shared_skeleton(), a.rate(), a.frame_count() + count + b.frame_count());
  const auto copy = [&](const Motion& from, std::int64_t at) {
    for (std::int64_t i = 0; i < from.frame_count(); ++i) {
      std::ranges::copy(from.pose(i).rotations, all.pose(at + i).rotations.begin());
      std::ranges::copy(from.pose(i).translations, all.pose(at + i).translations.begin());
    }
  };
  copy(a, 0);
  copy(b, a.frame_count() + count);
  const JointGroups joints = arm_groups();
  const FrameRange gap{a.frame_count(), a.frame_count() + count};
  GapScratch scratch;
  for (const GroupSet part : parts) {
    const Gap hole{.skeleton = &all.skeleton(),
                   .groups = &joints,
                   .rate = all.rate(),
                   .before = view_of(all, {0, gap.begin}),
                   .after = view_of(all, {gap.end, all.frame_count()}),
                   .count = count};
    find_gap_method("gap")->fill({.gap = hole, .model = default_transition_model(), .groups = part, .scratch = scratch},
                                 all.poses(gap));
  }
  return all;
}

TEST(Coasting, ContinuesPositionAndVelocityAtBothBorders) {
  const Motion a = moving(40, 0.3f);
  const Motion b = moving(40, 0.7f);
  for (const std::int64_t gap : {3, 24, 150}) {
    const Motion all = with_gap(a, b, gap, {GroupSet::all()});
    for (std::size_t joint = 0; joint < all.skeleton().joint_count(); ++joint) {
      const auto speed = [&](std::int64_t frame) {
        return angle(all.pose(frame).rotations[joint], all.pose(frame + 1).rotations[joint]);
      };
      for (const std::int64_t border : {std::int64_t{39}, std::int64_t{39 + gap}}) {
        // The change of speed across the border is limited by the first frame's share of the cross-fade and by the
        // change within a tenth of a second.
        EXPECT_NEAR(speed(border - 1), speed(border), 0.003 + 8.0 / std::pow(static_cast<double>(gap + 1), 2))
            << "joint " << joint << " at " << border;
      }
    }
  }
}

TEST(Coasting, StaysBetweenStillBorders) {
  const Motion a = moving(1, 0.3f);
  const Motion b = moving(1, 0.9f);
  const Motion all = with_gap(a, b, 50, {GroupSet::all()});
  for (std::int64_t i = 1; i <= 50; ++i) {
    for (std::size_t joint = 0; joint < all.skeleton().joint_count(); ++joint) {
      const Eigen::Quaternionf& made = all.pose(i).rotations[joint];
      const Eigen::Quaternionf& left = a.pose(0).rotations[joint];
      const Eigen::Quaternionf& right = b.pose(0).rotations[joint];
      EXPECT_NEAR(angle(left, made) + angle(made, right), angle(left, right), 1e-3);
      EXPECT_NEAR(made.norm(), 1.0f, 1e-5f);
    }
  }
}

TEST(Coasting, FillingByPartsEqualsFillingAllAtOnce) {
  const Motion a = moving(40, 0.3f);
  const Motion b = moving(40, 1.7f);
  const Motion whole = with_gap(a, b, 33, {GroupSet::all()});
  const Motion parts = with_gap(a, b, 33, {{JointGroup::left_arm}, {JointGroup::body}});
  for (std::size_t i = 0; i < whole.rotations().size(); ++i) {
    ASSERT_EQ(whole.rotations()[i].coeffs(), parts.rotations()[i].coeffs()) << i;
  }
  for (std::size_t i = 0; i < whole.translations().size(); ++i) {
    ASSERT_EQ(whole.translations()[i], parts.translations()[i]) << i;
  }
}

}  // namespace
}  // namespace signweave
