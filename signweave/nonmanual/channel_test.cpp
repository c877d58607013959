#include "signweave/nonmanual/channel.h"

#include <gtest/gtest.h>

namespace signweave {
namespace {

TEST(NonManualChannel, EveryNameOfLiveLinkFaceHasItsChannel) {
  const std::pair<NonManualChannel, std::vector<std::string_view>> all[] = {
      {NonManualChannel::head, {"headYaw", "headPitch", "headRoll"}},
      {NonManualChannel::gaze,
       {"eyeLookDownLeft", "eyeLookInLeft", "eyeLookOutRight", "eyeLookUpRight", "leftEyeYaw", "rightEyePitch"}},
      {NonManualChannel::brows,
       {"browDownLeft", "browInnerUp", "browOuterUpRight", "eyeWideLeft", "eyeSquintRight", "noseSneerLeft"}},
      {NonManualChannel::lids, {"eyeBlinkLeft", "eyeBlinkRight"}},
      {NonManualChannel::mouth,
       {"jawForward", "jawOpen", "mouthClose", "mouthPressLeft", "cheekPuff", "cheekSquintLeft", "tongueOut"}},
  };
  for (const auto& [channel, tracks] : all) {
    for (const std::string_view track : tracks) EXPECT_EQ(channel_of_track(track), channel) << track;
  }
  EXPECT_EQ(channel_of_track("tailWag"), std::nullopt);
  EXPECT_EQ(channel_of_track(""), std::nullopt);
}

}  // namespace
}  // namespace signweave
