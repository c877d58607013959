// What quantising for a stream takes from a signer: told in metres where it is largest, at the fingertips.

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>

#include "demo/corpus.h"
#include "signweave/motion/kinematics.h"
#include "signweave/stream/frame_codec.h"

namespace signweave {
namespace {

TEST(StreamError, IsBelowATenthOfAMillimetreAtTheFingertips) {
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
  for (std::int64_t frame = 0; frame < motion.frame_count(); ++frame) {
    const PoseView pose = motion.pose(frame);
    encode(FrameView{pose, {}}, bytes);
    decode(bytes, {back.view(), {}});
    to_model_space(skeleton, pose, before);
    to_model_space(skeleton, back.view(), after);
    for (const Tip& tip : skeleton.tips()) {
      worst = std::max(worst, (position_of(tip, before) - position_of(tip, after)).norm());
    }
  }
  RecordProperty("worst_micrometres", static_cast<int>(worst * 1e6f));
  std::printf("the worst of %lld frames: %.1f micrometres\n", static_cast<long long>(motion.frame_count()),
              static_cast<double>(worst) * 1e6);
  EXPECT_LT(worst, 1e-4f);
  EXPECT_GT(worst, 5e-6f);  // something was quantised
}

}  // namespace
}  // namespace signweave
