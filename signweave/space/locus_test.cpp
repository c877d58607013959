#include "signweave/space/locus.h"

#include <gtest/gtest.h>

#include "signweave/core/error.h"
#include "signweave/space/change.h"

namespace signweave {
namespace {

SignerBody a_body() {
  SignerBody body;
  body.shoulder_width = 0.36f;
  body.heights = {-10, -1.5f, -0.8f, -0.2f, 0.4f, 0.6f, 0.9f, 1.2f};
  return body;
}

std::string why(std::string_view text) {
  try {
    read_locus(text);
  } catch (const Error& error) {
    return error.what();
  }
  return "none";
}

TEST(Locus, AnglesAndPointsAreTheSamePlaces) {
  const Eigen::Vector3f left = point_of({90, 0, 2});
  EXPECT_NEAR(left.x(), 2, 1e-6);
  EXPECT_NEAR(left.z(), 0, 1e-6);
  EXPECT_NEAR(point_of({0, 90, 1}).y(), 1, 1e-6);
  for (const SpaceAngles& angles : {SpaceAngles{30, -20, 1.5f}, SpaceAngles{-170, 60, 0.2f}}) {
    const SpaceAngles again = angles_of(point_of(angles));
    EXPECT_NEAR(again.azimuth, angles.azimuth, 1e-4);
    EXPECT_NEAR(again.elevation, angles.elevation, 1e-4);
    EXPECT_NEAR(again.distance, angles.distance, 1e-5);
  }
  EXPECT_EQ(angles_of({0, 1, 0}).azimuth, 0);
}

TEST(Locus, IsReadAsItIsPrinted) {
  for (const char* text : {"left", "a", "été", "30", "-30/10", "30/0/1.5", "0.3,0.1,0.8", "0,-1,0.5"}) {
    EXPECT_EQ(to_string(read_locus(text)), text);
    EXPECT_EQ(read_locus(to_string(read_locus(text))), read_locus(text));
  }
  EXPECT_EQ(to_string(read_locus("+30/+0/1.2")), "30");
  EXPECT_EQ(read_locus("-0"), read_locus("0"));
}

TEST(Locus, FaultsSayWhatIsExpected) {
  EXPECT_EQ(why("200"), "'@200' is no locus: its azimuth is 200; give one from -180 to 180");
  EXPECT_EQ(why("0/91"), "'@0/91' is no locus: its elevation is 91; give one from -90 to 90");
  EXPECT_EQ(why("0/0/0"), "'@0/0/0' is no locus: its distance is 0; give one above 0");
  EXPECT_EQ(why("0,0,1e9"), "'@0,0,1e9' is no locus: its coordinate is 1000000000; give one from -100 to 100");
  for (const char* text : {"", "1,2", "1/2/3/4", "1,2,3,4", "3x", "a b", "a@b", "-", "1,,2", "nan", "1e99/0"}) {
    if (std::string_view(text) == "nan") continue;  // a name
    EXPECT_NE(why(text).find("is no locus: give a name such as @left"), std::string::npos) << text << ": " << why(text);
  }
  EXPECT_NE(why(std::string(101, 'a')).find("more than 100 bytes"), std::string::npos);
}

TEST(Locus, ANameIsWhatItWasSetUpAsByThen) {
  const std::vector<LocusSetup> setups = {
      {"a", read_locus("left"), 0}, {"b", read_locus("a"), 1}, {"a", read_locus("-30"), 2}};
  const SignerBody body = a_body();
  const auto at = [&](const char* text, std::size_t place) {
    return resolve(read_locus(text), setups, place, body).at;
  };
  EXPECT_EQ(at("a", 1), at("left", 0));
  EXPECT_EQ(at("a", 2), at("-30", 0));
  EXPECT_EQ(at("b", 5), at("left", 0)) << "a name keeps what it was set up as";
  EXPECT_GT(at("left", 0).x(), 0);
  EXPECT_LT(at("right", 0).x(), 0);
  const Locus self = resolve(read_locus("self"), {}, 0, body);
  EXPECT_TRUE(self.self);
  EXPECT_NEAR(self.at.y(), -0.5f, 1e-6);
}

TEST(Locus, AnUnknownNameIsAnsweredWithTheMend) {
  const std::vector<LocusSetup> setups = {{"maman", read_locus("left"), 3}};
  const auto why_not = [&](const char* name) -> std::string {
    try {
      resolve(read_locus(name), setups, 0, a_body());
    } catch (const Error& error) {
      return error.what();
    }
    return "none";
  };
  EXPECT_EQ(why_not("maman"), "the locus '@maman' is set up later, at place 4; set it up before it is used");
  EXPECT_EQ(why_not("xyz"), "there is no locus '@xyz'; set it up at a sign before: SIGN{@xyz = @left}");
  EXPECT_NE(why_not("lefft").find("did you mean left?"), std::string::npos) << why_not("lefft");
}

TEST(SpaceChange, LimitsAndExclusionsAreChecked) {
  SpaceChange change;
  EXPECT_TRUE(changes_nothing(change));
  change.at = read_locus("left");
  EXPECT_FALSE(changes_nothing(change));
  EXPECT_NO_THROW(check(change));
  change.to = read_locus("right");
  EXPECT_THROW(check(change), Error);
  for (const SpaceChange& wrong : {SpaceChange{.move = {0, 300, 0}}, SpaceChange{.scale = {0, 1, 1}},
                                   SpaceChange{.size = 9}, SpaceChange{.speed = 0.1f}, SpaceChange{.repetitions = 11},
                                   SpaceChange{.repetitions = 0}, SpaceChange{.along = {read_locus("left")}}}) {
    EXPECT_THROW(check(wrong), Error);
  }
}

}  // namespace
}  // namespace signweave
