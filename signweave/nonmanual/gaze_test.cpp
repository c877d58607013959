#include "signweave/nonmanual/gaze.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <map>

#include "signweave/core/error.h"
#include "signweave/motion/degree.h"

namespace signweave {
namespace {

using testing::HasSubstr;

constexpr FrameRate kGazeRate{100, 1};
constexpr FrameRange kAt{0, 120};

/// All eye tracks of 120 frames under a gaze; captured: all 0.4.
std::map<std::string, std::vector<float>> eyes_at(GazeDirection direction) {
  std::map<std::string, std::vector<float>> tracks;
  const Curve curve = gaze_at(direction, "gaze");
  for (const std::string& name : tracks_of(curve)) tracks[name].assign(120, 0.4f);
  for (const char* name : {"leftEyeYaw", "rightEyeYaw", "leftEyePitch"}) tracks[name].assign(120, 0.4f);
  std::vector<TrackSpan> spans;
  for (auto& [name, values] : tracks) spans.push_back({name, values});
  apply(curve, kAt, kGazeRate, kAt, spans);
  return tracks;
}

float head_yaw(GazeDirection direction, std::int64_t frame) {
  const Eigen::Vector3f ahead = head_rotation(gaze_at(direction, ""), kAt, kGazeRate, frame) * Eigen::Vector3f::UnitZ();
  return std::atan2(ahead.x(), ahead.z()) / kDegree;
}

TEST(Gaze, TurnsBothEyesToTheSide) {
  auto eyes = eyes_at({.yaw = 21});
  EXPECT_FLOAT_EQ(eyes["eyeLookOutLeft"][10], 0.6f);
  EXPECT_FLOAT_EQ(eyes["eyeLookInRight"][10], 0.6f);
  EXPECT_FLOAT_EQ(eyes["eyeLookInLeft"][10], 0.0f);
  EXPECT_FLOAT_EQ(eyes["eyeLookOutRight"][10], 0.0f);
  EXPECT_NEAR(eyes["leftEyeYaw"][10], -21 * kDegree, 1e-5);  // Live Link Face: yaw to the right
  auto down = eyes_at({.pitch = -14});
  EXPECT_FLOAT_EQ(down["eyeLookDownRight"][10], 0.4f);
  EXPECT_FLOAT_EQ(down["eyeLookUpRight"][10], 0.0f);
  EXPECT_NEAR(down["leftEyePitch"][10], 14 * kDegree, 1e-5);
}

TEST(Gaze, ArrivesWithinASaccade) {
  const auto eyes = eyes_at({.yaw = 21});
  EXPECT_NE(eyes.at("eyeLookOutLeft")[2], 0.6f);
  EXPECT_FLOAT_EQ(eyes.at("eyeLookOutLeft")[4], 0.6f);
}

TEST(Gaze, TheHeadFollowsLaterAndTheEyesStayOnTheTarget) {
  auto eyes = eyes_at({.yaw = 30});
  EXPECT_FLOAT_EQ(head_yaw({.yaw = 30}, 15), 0);
  EXPECT_NEAR(head_yaw({.yaw = 30}, 40), 9, 1e-3);
  for (std::int64_t frame = 4; frame < 100; ++frame) {
    const float eye = 35 * eyes["eyeLookOutLeft"][static_cast<std::size_t>(frame)];
    EXPECT_NEAR(eye + head_yaw({.yaw = 30}, frame), 30, 1e-3) << frame;
  }
}

TEST(Gaze, ReturnsToTheCapturedGaze) {
  auto eyes = eyes_at({.yaw = 30});
  // While the head turns back, the eyes are ahead again.
  const float eye = 35 * (eyes["eyeLookOutLeft"][108] - eyes["eyeLookInLeft"][108]);
  EXPECT_NEAR(eye + head_yaw({.yaw = 30}, 108), 0, 1e-3);
  EXPECT_NEAR(eyes["eyeLookOutLeft"][119], 0.4f, 0.1f);
}

TEST(FindGaze, KnowsDirectionsAndSaysWhatItCannotDo) {
  EXPECT_GT(find_gaze("left").yaw, 0);
  EXPECT_EQ(find_gaze("addressee"), GazeDirection{});
  EXPECT_EQ(find_gaze("RD"), (GazeDirection{find_gaze("right").yaw, find_gaze("down").pitch}));
  const auto fault = [](const char* name) {
    try {
      find_gaze(name);
    } catch (const Error& error) {
      return std::string(error.what());
    }
    return std::string("no error");
  };
  EXPECT_EQ(fault("lefft"), "there is no gaze 'lefft'; did you mean left?");
  EXPECT_THAT(fault("the moon"), HasSubstr("give left, right, up"));
  EXPECT_THAT(fault("hands"), HasSubstr("not possible yet"));
}

TEST(Gaze, IsPlannedAtTheAddresseeAtBoundaries) {
  const std::vector<TimeSpan> units = {{250ms, 900ms}, {1'050ms, 2'000ms}, {2'800ms, 3'500ms}};
  EXPECT_EQ(plan_gaze({0ms, 4'000ms}, units),
            (std::vector<TimeSpan>{{0ms, 250ms}, {2'000ms, 2'800ms}, {3'500ms, 4'000ms}}));
  EXPECT_EQ(plan_gaze({0ms, 1'000ms}, {}), (std::vector<TimeSpan>{{0ms, 1'000ms}}));
  EXPECT_TRUE(plan_gaze({0ms, 1'000ms}, std::vector<TimeSpan>{{150ms, 1'200ms}}).empty());
}

}  // namespace
}  // namespace signweave
