#include "signweave/retarget/mirrored_tracks.h"

#include <gtest/gtest.h>

#include "signweave/retarget/side_names.h"

namespace signweave {
namespace {

TEST(OtherSide, IsAWordOrALetterBetweenSeparators) {
  EXPECT_EQ(other_side("browDownLeft"), "browDownRight");
  EXPECT_EQ(other_side("eyeLookInRight"), "eyeLookInLeft");
  EXPECT_EQ(other_side("leftEyeYaw"), "rightEyeYaw");
  EXPECT_EQ(other_side("mixamorig:LeftHandThumb1"), "mixamorig:RightHandThumb1");
  EXPECT_EQ(other_side("hand_l"), "hand_r");
  EXPECT_EQ(other_side("Bip01 R Finger2"), "Bip01 L Finger2");
  EXPECT_EQ(other_side("eye.L"), "eye.R");
  for (const char* name : {"jawOpen", "mouthPucker", "tongueOut", "brightness", "copyright", "cleft", "lowerback"}) {
    EXPECT_EQ(other_side(name), std::nullopt) << name;
  }
}

TEST(MirroredTracks, LeftAndRightAreExchangedInPlace) {
  const std::vector<std::string> captured = {"browDownLeft", "jawOpen", "jawLeft", "browDownRight", "jawRight"};
  const std::vector<MirroredTrack> expected = {
      {"browDownLeft", 3}, {"jawOpen", 1}, {"jawLeft", 4}, {"browDownRight", 0}, {"jawRight", 2}};
  EXPECT_EQ(mirrored_tracks(captured), expected);
}

TEST(MirroredTracks, ATrackWithoutTheOtherOneIsRenamed) {
  const std::vector<std::string> captured = {"mouthLeft", "tongueOut"};
  EXPECT_EQ(mirrored_tracks(captured), (std::vector<MirroredTrack>{{"mouthRight", 0}, {"tongueOut", 1}}));
}

TEST(MirroredTracks, RotationsToASideChangeTheirSigns) {
  const std::vector<std::string> captured = {"headYaw", "headPitch", "leftEyeRoll", "rightEyeRoll", "leftEyePitch"};
  const std::vector<MirroredTrack> expected = {{"headYaw", 0, -1},
                                               {"headPitch", 1, 1},
                                               {"leftEyeRoll", 3, -1},
                                               {"rightEyeRoll", 2, -1},
                                               {"rightEyePitch", 4, 1}};
  EXPECT_EQ(mirrored_tracks(captured), expected);
}

TEST(MirroredTracks, EachCapturedTrackIsShownOnceEvenIfNamesRepeat) {
  const std::vector<std::string> captured = {"jawLeft", "jawLeft", "jawRight"};
  const std::vector<MirroredTrack> expected = {{"jawLeft", 2}, {"jawLeft", 1}, {"jawRight", 0}};
  EXPECT_EQ(mirrored_tracks(captured), expected);
}

}  // namespace
}  // namespace signweave
