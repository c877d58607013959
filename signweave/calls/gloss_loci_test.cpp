#include "signweave/calls/gloss_loci.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <vector>

namespace signweave::calls {
namespace {

using Eigen::Vector3f;
using testing::ElementsAre;

constexpr float kWidth = 0.4f;  // metres

SignerBody body_of_loci() {
  SignerBody body{.shoulder_width = kWidth};
  body.heights = {-10, -1.4f, -0.7f, -0.3f, 0.3f, 0.45f, 0.6f, 0.95f};
  return body;
}

/// A token whose right hand goes from one place to another, while the left one stays at its hip.
PlacedToken token(const char* gloss, const Vector3f& begin, const Vector3f& end) {
  return {.gloss = gloss,
          .recording = "r",
          .span = {0ms, 400ms},
          .palms = {PalmStroke{.begin = {0.5f, -1.5f, 0}, .end = {0.5f, -1.5f, 0}, .path = 0.01f},
                    PalmStroke{.begin = begin, .end = end, .path = (end - begin).norm() * kWidth}},
          .shoulder_width = kWidth};
}
Vector3f at(float azimuth, float elevation = 0, float distance = 1.2f) {
  return point_of({azimuth, elevation, distance});
}
GlossLoci only(const std::vector<PlacedToken>& tokens) {
  const std::vector<GlossLoci> all = gloss_loci(tokens, body_of_loci());
  EXPECT_EQ(all.size(), 1U);
  return all.empty() ? GlossLoci() : all.front();
}

TEST(GlossLoci, DescribesBothEndsByMedianQuartilesAndNearestLocus) {
  std::vector<PlacedToken> tokens;
  for (const float azimuth : {20.0f, 30.0f, 40.0f, 50.0f, 60.0f})
    tokens.push_back(token("A", at(0, -20, 0.5f), at(azimuth)));
  const GlossLoci a = only(tokens);
  EXPECT_EQ(a.tokens.size(), 5U);
  EXPECT_EQ(a.hand, Side::right);
  EXPECT_NEAR(a.end.azimuth.median(), 40, 0.001);
  EXPECT_NEAR(a.end.azimuth.quantiles[2], 30, 0.001);
  EXPECT_NEAR(a.end.azimuth.quantiles[4], 50, 0.001);
  EXPECT_NEAR(a.end.middle.distance, 1.2, 0.001);
  EXPECT_EQ(a.end.nearest, "left");
  EXPECT_NEAR(a.begin.elevation.median(), -20, 0.001);
  EXPECT_EQ(a.begin.nearest, "self");
  EXPECT_NEAR(a.begin.spread, 0, 1e-6);
  EXPECT_EQ(a.heading, Heading::away);
}

TEST(GlossLoci, CountsThePlacesThatAreFartherApartThanFifteenCentimetres) {
  const auto places = [](std::initializer_list<float> centimetres) {
    std::vector<PlacedToken> tokens;
    for (const float cm : centimetres) tokens.push_back(token("A", {cm / 100 / kWidth, 0, 1}, {0, 0, 1}));
    const GlossLoci all = only(tokens);
    EXPECT_EQ(all.end.places, 1U);
    return all.begin.places;
  };
  EXPECT_EQ(places({0}), 1U);
  EXPECT_EQ(places({0, 0, 0}), 1U);
  EXPECT_EQ(places({0, 14}), 1U);
  EXPECT_EQ(places({0, 16}), 2U);
  EXPECT_EQ(places({-40, -38, 0, 1, 41, 42}), 3U);
}

TEST(GlossLoci, GuessesWhetherASignGoesAwayOrTowardTheSigner) {
  EXPECT_EQ(only({token("A", at(30, 0, 1.2f), at(0, 0, 0.5f))}).heading, Heading::toward);
  EXPECT_EQ(only({token("A", at(-45), at(45))}).heading, Heading::neither);
  EXPECT_EQ(only({token("A", at(0, 0, 1), at(0, 80, 1.1f))}).heading, Heading::toward) << "upwards is not outwards";
  // The median decides: 0.21 shoulder widths are 8.4 cm.
  EXPECT_EQ(only({token("A", at(0, 0, 1), at(0, 0, 1.21f))}).heading, Heading::away);
  EXPECT_EQ(only({token("A", at(0, 0, 1), at(0, 0, 1.19f))}).heading, Heading::neither);
}

TEST(GlossLoci, SortsByTheGreaterSpreadInMetres) {
  const std::vector<PlacedToken> tokens = {
      token("STILL", at(0), at(10)),     token("ENDS", at(0), at(-30)),  token("ENDS", at(0), at(30)),
      token("BEGINS", at(-60), at(0)),   token("BEGINS", at(60), at(0)), token("ENDS ", at(0), at(0)),
      token("STILL", at(0), at(10.01f)),
  };
  std::vector<std::string> order;
  const std::vector<GlossLoci> all = gloss_loci(tokens, body_of_loci());
  for (const GlossLoci& one : all) order.push_back(one.gloss);
  EXPECT_THAT(order, ElementsAre("BEGINS", "ENDS", "STILL"));
  // Both begins lie 1.2 · sin 60° shoulder widths from their mean.
  EXPECT_NEAR(all[0].spread(), 1.2 * 0.8660254 * static_cast<double>(kWidth), 1e-5);
  EXPECT_EQ(all[1].tokens.size(), 3U) << "compared in match form";
}

TEST(GlossLoci, AzimuthsBehindTheSignerStayTogether) {
  const GlossLoci behind = only({token("A", at(170), at(0)), token("A", at(-170), at(0)), token("A", at(-175), at(0))});
  EXPECT_NEAR(std::abs(behind.begin.middle.azimuth), 175, 0.01);
  EXPECT_LT(behind.begin.azimuth.most - behind.begin.azimuth.least, 30);
}

TEST(GlossLoci, TakesTheHandThatGoesOrTheAnnotatedOne) {
  PlacedToken left = token("A", at(0), at(10));
  left.palms[0]->path = 2;
  EXPECT_EQ(only({left, left, token("A", at(0), at(10))}).hand, Side::left);
  EXPECT_EQ(only({left, token("A", at(0), at(10))}).hand, Side::right);
  left.hand = Hand::right;
  EXPECT_EQ(only({left, left}).tokens[0].hand, Side::right);
  left.palms[1].reset();
  EXPECT_TRUE(gloss_loci(std::vector{left}, body_of_loci()).empty()) << "that hand was not measured";
}

TEST(GlossLoci, AnnotatedPhasesComeBeforeInferredOnes) {
  PlacedToken whole = token("A", at(-50), at(50));
  whole.inferred = true;
  EXPECT_EQ(only({whole, token("A", at(0), at(10))}).tokens.size(), 1U);
  EXPECT_EQ(only({whole, whole}).tokens.size(), 2U);
}

}  // namespace
}  // namespace signweave::calls
