#include "signweave/inflection/inflected_source.h"

#include <gtest/gtest.h>

#include "signweave/core/test_allocations.h"
#include "signweave/inflection/test_stroke.h"

namespace signweave {
namespace {

using Eigen::Vector3f;
using testing_inflection::kRight;
using testing_inflection::outward;
using testing_inflection::right_alone;
using testing_inflection::Stroke;

/// Moves the right hand up and aside, turned and scaled about its first place.
StrokeChange moved(const Stroke& stroke) {
  ArmChange arm;
  arm.turn = Eigen::AngleAxisf(0.35f, Vector3f::UnitY());
  arm.linear = 1.2f * arm.turn.toRotationMatrix();
  arm.from = stroke.captured.first(Side::right).palm;
  arm.to = arm.from + Vector3f(-0.03f, 0.05f, 0.01f);
  StrokeChange change;
  change.arms[kRight] = arm;
  return change;
}

TEST(InflectedSource, ThePalmAndTheHandGoWhereTheMapTakesThem) {
  Stroke stroke(right_alone(outward));
  const StrokeChange change = moved(stroke);
  const ArmChange& arm = *change.arms[kRight];
  const auto changed = stroke.changed(change);
  for (std::int64_t frame = Stroke::kCore.begin; frame < Stroke::kCore.end; ++frame) {
    const HandInSpace before = stroke.hand(*stroke.source, frame, Side::right);
    const HandInSpace after = stroke.hand(*changed, frame, Side::right);
    EXPECT_LT((after.palm - (arm.to + arm.linear * (before.palm - arm.from))).norm(), 1e-4f) << frame;
    EXPECT_LT(after.turn.angularDistance(arm.turn * before.turn), 1e-3f) << frame;
  }
}

TEST(InflectedSource, EverythingElseKeepsItsBits) {
  Stroke stroke(right_alone(outward));
  const Motion before = stroke.all(*stroke.source);
  const Motion after = stroke.all(*stroke.changed(moved(stroke)));
  const ArmJoints arm = stroke.person.arm(Side::right);
  for (std::int64_t frame = 0; frame < before.frame_count(); ++frame) {
    const bool is_changed = frame > Stroke::kCore.begin - 15 && frame < Stroke::kCore.end + 14;
    for (std::size_t joint = 0; joint < before.skeleton().joint_count(); ++joint) {
      const auto index = static_cast<JointIndex>(joint);
      const bool in_arm = index == arm.shoulder || index == arm.elbow || index == arm.wrist;
      const bool same = before.pose(frame).rotations[joint].coeffs() == after.pose(frame).rotations[joint].coeffs();
      EXPECT_EQ(same, !(is_changed && in_arm)) << frame << " " << before.skeleton().joint(index).name;
    }
  }
}

TEST(InflectedSource, TheChangeBeginsAndEndsWithoutAJump) {
  Stroke stroke(right_alone(outward));
  const auto changed = stroke.changed(moved(stroke));
  Vector3f last = Vector3f::Zero();
  for (std::int64_t frame = 0; frame < 80; ++frame) {
    const Vector3f shift =
        stroke.hand(*changed, frame, Side::right).palm - stroke.hand(*stroke.source, frame, Side::right).palm;
    EXPECT_LT((shift - last).norm(), 0.011f) << frame;
    last = shift;
  }
}

TEST(InflectedSource, AnyFramesHaveTheBitsOfAll) {
  Stroke stroke(right_alone(outward));
  StrokeChange change = moved(stroke);
  change.trunk_yaw = 0.1f;
  change.arms[kRight]->swivel = 0.2f;
  change.arms[kRight]->path = {{}, {.shift = {0.01f, 0, 0}}, {.turn = {0, 0.1f, 0}}, {}};
  const auto changed = stroke.changed(change);
  const Motion whole = stroke.all(*changed);
  for (const FrameRange frames : {FrameRange{0, 1}, FrameRange{17, 23}, FrameRange{59, 80}}) {
    Motion some(changed->skeleton(), changed->rate(), frames.size());
    changed->read(frames, some.poses({0, frames.size()}));
    EXPECT_TRUE(same_bits(some, whole.slice(frames)));
  }
}

TEST(InflectedSource, TheTrunkTurnsWithoutTheHand) {
  Stroke stroke(right_alone(outward));
  StrokeChange change = moved(stroke);
  const auto still = stroke.changed(change);
  change.trunk_yaw = 0.2f;
  const auto turned = stroke.changed(change);
  for (const std::int64_t frame : {20, 40, 59}) {
    const HandInSpace a = stroke.hand(*still, frame, Side::right);
    const HandInSpace b = stroke.hand(*turned, frame, Side::right);
    EXPECT_LT((a.palm - b.palm).norm(), 2e-4f);
    EXPECT_LT(a.turn.angularDistance(b.turn), 1e-3f);
    EXPECT_GT((a.shoulder - b.shoulder).norm(), 0.01f);
  }
}

TEST(InflectedSource, HandsThatKeepToEachOtherDo) {
  Stroke stroke(testing_person::together);
  ASSERT_TRUE(stroke.captured.touch);
  StrokeChange change = moved(stroke);
  change.together = true;
  change.arms[kRight]->linear *= 1.1f;
  change.arms[0] = change.arms[1];
  const auto changed = stroke.changed(change);
  for (const std::int64_t frame : {20, 33, 59}) {
    const auto relation = [&](const MotionSource& of) {
      const HandInSpace left = stroke.hand(of, frame, Side::left);
      const HandInSpace right = stroke.hand(of, frame, Side::right);
      return std::pair<Vector3f, Eigen::Quaternionf>(left.turn.conjugate() * (right.palm - left.palm),
                                                     left.turn.conjugate() * right.turn);
    };
    const auto before = relation(*stroke.source);
    const auto after = relation(*changed);
    EXPECT_LT((before.first - after.first).norm(), 1e-4f);
    EXPECT_LT(before.second.angularDistance(after.second), 1e-3f);
  }
}

TEST(InflectedSource, ReadingAllocatesNothing) {
  Stroke stroke(right_alone(outward));
  const auto changed = stroke.changed(moved(stroke));
  Motion frames(changed->skeleton(), changed->rate(), 40);
  changed->read({20, 60}, frames.poses({0, 40}));
  EXPECT_EQ(allocations_in([&] { changed->read({20, 60}, frames.poses({0, 40})); }), 0u);
}

TEST(PathSpline, GoesThroughItsPointsSmoothly) {
  std::vector<PathPoint> points(6);
  for (std::size_t i = 0; i < points.size(); ++i) {
    const auto x = static_cast<float>(i) / 5;
    points[i] = {.shift = {x, x * x, std::sin(3 * x)}, .turn = {0, x, 0}, .swivel = 1 - x};
  }
  const PathSpline spline(points);
  for (std::size_t i = 0; i < points.size(); ++i) {
    EXPECT_LT((spline.at(static_cast<float>(i) / 5).shift - points[i].shift).norm(), 1e-6f);
  }
  for (float t = 0; t <= 1; t += 0.01f) {
    EXPECT_NEAR(spline.at(t).shift.x(), t, 1e-5f);
    EXPECT_NEAR(spline.at(t).shift.z(), std::sin(3 * t), 0.01f);
    EXPECT_NEAR(spline.at(t).swivel, 1 - t, 1e-5f);
  }
  EXPECT_EQ(spline.at(7).shift, points.back().shift);
  EXPECT_EQ(PathSpline().at(0.3f), PathPoint{});
}

}  // namespace
}  // namespace signweave
