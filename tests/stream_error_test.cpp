// The error of quantising for a stream, in metres where it is largest: at the fingertips.

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>

#include "demo/corpus.h"
#include "signweave/live/frame_codec.h"
#include "signweave/motion/kinematics.h"

namespace signweave {
namespace {

TEST(StreamError, IsAtMostAnEighthOfAMillimetreAtTheFingertips) {
  const std::vector<demo::Script> scripts = demo::corpus_scripts(2);
  const demo::SyntheticRecording made = demo::make_recording(scripts.front(), {100, 1}, 1);
  const Motion& motion = made.motion;
  const Skeleton& skeleton = motion.skeleton();
  ASSERT_GT(skeleton.tips().size(), 10u);
  std::vector<std::byte> bytes(bytes_of({skeleton.joint_count(), skeleton.translation_count(), 0}));
  Pose back(skeleton);
  ModelPose before;
  ModelPose after;
  float worst = 0;
  double sum = 0;
  for (std::int64_t frame = 0; frame < motion.frame_count(); ++frame) {
    const PoseView pose = motion.pose(frame);
    encode(FrameView{pose, {}}, bytes);
    decode(bytes, {back.view(), {}});
    to_model_space(skeleton, pose, before);
    to_model_space(skeleton, back.view(), after);
    for (const Tip& tip : skeleton.tips()) {
      const float off = (position_of(tip, before) - position_of(tip, after)).norm();
      worst = std::max(worst, off);
      sum += static_cast<double>(off);
    }
  }
  const double mean = sum / static_cast<double>(motion.frame_count()) / static_cast<double>(skeleton.tips().size());
  std::printf("%lld frames: %.1f micrometres at worst, %.1f on average\n", static_cast<long long>(motion.frame_count()),
              static_cast<double>(worst) * 1e6, mean * 1e6);
  EXPECT_LT(mean, 5e-5);
  EXPECT_LT(worst, 1.25e-4f);
  EXPECT_GT(worst, 5e-6f);  // something was quantised
}

}  // namespace
}  // namespace signweave
