#include "signweave/motion/resample.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>

namespace signweave {
namespace {

std::shared_ptr<const Skeleton> one_bone() {
  return std::make_shared<const Skeleton>(
      std::vector<Joint>{{.name = "hips", .parent = kNoJoint, .offset = {0, 1, 0}, .translated = true},
                         {.name = "spine", .parent = 0, .offset = {0, 0.2f, 0}}},
      std::vector<Tip>{});
}

/// Turns about X and moves along Z at constant speed; a track counts the frames.
Motion turning(FrameRate rate, std::int64_t frames, double radians_per_second) {
  Motion motion(one_bone(), rate, frames);
  ScalarTrack track{.name = "count", .values = {}};
  for (std::int64_t frame = 0; frame < frames; ++frame) {
    const double seconds = static_cast<double>(frame) * rate.frame_time().count();
    const Eigen::Quaterniond turn(Eigen::AngleAxisd(seconds * radians_per_second, Eigen::Vector3d::UnitX()));
    motion.pose(frame).rotations[1] = turn.cast<float>();
    motion.pose(frame).translations[0] = Eigen::Vector3f(0, 1, static_cast<float>(seconds));
    track.values.push_back(static_cast<float>(frame));
  }
  keep_hemisphere(motion);
  motion.add_track(std::move(track));
  return motion;
}

TEST(Resampled, FramesThatCoincideWithCapturedOnesEqualThem) {
  const Motion motion = turning({120, 1}, 25, 2.0);
  for (const RateMethod method : {RateMethod::slerp, RateMethod::nearest}) {
    const Motion half = resampled(motion, {60, 1}, method);
    ASSERT_EQ(half.frame_count(), 13);
    EXPECT_EQ(half.rate(), (FrameRate{60, 1}));
    for (std::int64_t frame = 0; frame < 13; ++frame) {
      EXPECT_EQ(half.pose(frame).rotations[1].coeffs(), motion.pose(2 * frame).rotations[1].coeffs()) << frame;
      EXPECT_EQ(half.pose(frame).translations[0], motion.pose(2 * frame).translations[0]) << frame;
      EXPECT_EQ(half.tracks()[0].values[static_cast<std::size_t>(frame)], static_cast<float>(2 * frame));
    }
  }
}

TEST(Resampled, NothingIsExtrapolatedAfterTheLastCapturedFrame) {
  EXPECT_EQ(resampled(turning({30, 1}, 10, 1), {120, 1}).frame_count(), 37);  // 9 steps of 4, plus the first
  EXPECT_EQ(resampled(turning({120, 1}, 10, 1), {60, 1}).frame_count(), 5);
  EXPECT_EQ(resampled(turning({120, 1}, 1, 1), {60, 1}).frame_count(), 1);
  EXPECT_EQ(resampled(turning({120, 1}, 0, 1), {60, 1}).frame_count(), 0);
  EXPECT_EQ(resampled(turning({30'000, 1001}, 31, 1), {30, 1}).frame_count(), 31);  // the last at 1.0 s of 1.001
}

TEST(Resampled, NearestUsesCapturedPosesOnly) {
  const Motion motion = turning({10, 1}, 3, 1);
  const Motion made = resampled(motion, {40, 1}, RateMethod::nearest);
  std::vector<float> shown = made.tracks()[0].values;
  EXPECT_EQ(shown, (std::vector<float>{0, 0, 0, 1, 1, 1, 1, 2, 2}));
}

RC_GTEST_PROP(Resampled, AUniformMovementIsUnchangedAtEachTime, ()) {
  const FrameRate from =
      *rc::gen::element(FrameRate{24, 1}, FrameRate{30'000, 1001}, FrameRate{100, 1}, FrameRate{120, 1});
  const FrameRate to =
      *rc::gen::element(FrameRate{25, 1}, FrameRate{60, 1}, FrameRate{60'000, 1001}, FrameRate{240, 1});
  const std::int64_t frames = *rc::gen::inRange(2, 200);
  const double speed = *rc::gen::inRange(-300, 300) / 100.0;
  const Motion made = resampled(turning(from, frames, speed), to);
  const double last = static_cast<double>(frames - 1) * from.frame_time().count();
  RC_ASSERT(static_cast<double>(made.frame_count() - 1) * to.frame_time().count() <= last + 1e-9);
  RC_ASSERT(static_cast<double>(made.frame_count()) * to.frame_time().count() > last);
  for (std::int64_t frame = 0; frame < made.frame_count(); ++frame) {
    const double seconds = static_cast<double>(frame) * to.frame_time().count();
    const Eigen::Quaternionf turn(
        Eigen::Quaterniond(Eigen::AngleAxisd(seconds * speed, Eigen::Vector3d::UnitX())).cast<float>());
    RC_ASSERT(turn.angularDistance(made.pose(frame).rotations[1]) < 2e-3f);
    RC_ASSERT(std::abs(made.pose(frame).translations[0].z() - static_cast<float>(seconds)) < 1e-4f);
    RC_ASSERT(std::abs(made.tracks()[0].values[static_cast<std::size_t>(frame)] -
                       static_cast<float>(seconds * from.hertz())) < 1e-2f);
  }
  RC_ASSERT(keeps_hemisphere(made));
}

}  // namespace
}  // namespace signweave
