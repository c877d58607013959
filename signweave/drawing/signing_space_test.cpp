#include "signweave/drawing/signing_space.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <numbers>
#include <pugixml.hpp>
#include <string>

#include "signweave/core/error.h"
#include "signweave/drawing/contact_sheet.h"
#include "signweave/rig/test_rig.h"

namespace signweave {
namespace {

using Eigen::AngleAxisf;
using Eigen::Vector3f;
using testing::HasSubstr;
using testing::Not;

constexpr double kWidth = 190, kHeight = 188;

/// The test person in front of the viewer at 150 pixels per metre, turned by the given degrees.
struct DrawnSpace {
  SignerBody body;
  FigureView view{.left = 95, .bottom = 180, .low = 0.9, .scale = 150, .near = 0, .far = 0};
  pugi::xml_document document;

  explicit DrawnSpace(float degrees) {
    Motion motion(whole_person(), {60, 1}, 1);
    const RigMap rig = rig_of_signer(motion.skeleton());
    body = *signer_body(motion, rig);
    motion.pose(0).rotations[0] = AngleAxisf(degrees * std::numbers::pi_v<float> / 180, Vector3f::UnitY());
    const SignerSpace space = signer_space(body, rig, to_model_space(motion.skeleton(), motion.pose(0)));
    std::string out = "<svg>";
    draw_signing_space(body, space, view, kWidth, kHeight, out);
    document.load_string((out + "</svg>").c_str());
  }
  /// The positions of the horizontal or vertical lines.
  std::vector<double> lines(bool lying) const {
    std::vector<double> places;
    for (const pugi::xml_node line : document.child("svg").children("line")) {
      const bool lies = line.attribute("y1").as_double() == line.attribute("y2").as_double();
      if (lies == lying) places.push_back(line.attribute(lying ? "y1" : "x1").as_double());
    }
    return places;
  }
  std::string text() const {
    std::string all;
    for (const pugi::xml_node node : document.child("svg").children("text")) {
      all += fmt::format("{};", node.text().get());
    }
    return all;
  }
};

TEST(DrawSigningSpace, PutsALineAtEachBorderAndNamesTheHeightsFromTheTop) {
  const DrawnSpace drawn(0);
  const std::vector<double> lines = drawn.lines(true);
  ASSERT_EQ(lines.size(), 7U);
  for (std::size_t i = 0; i < 7; ++i) {
    const double y = 180 - 150 * (1.38 + 0.36 * static_cast<double>(drawn.body.heights[7 - i]) - 0.9);
    EXPECT_NEAR(lines[i], y, 0.06);
  }
  EXPECT_THAT(drawn.text(), HasSubstr("above head;forehead;mouth;chin;shoulder;chest;waist;"));
  EXPECT_THAT(drawn.text(), HasSubstr("centre;right;left;"));
}

TEST(DrawSigningSpace, ShowsTheZonesAcrossFromTheFrontAndTheReachFromTheSide) {
  const DrawnSpace front(0);
  EXPECT_THAT(front.lines(false),
              testing::ElementsAre(testing::DoubleNear(95 - 32.4, 0.06), testing::DoubleNear(95 + 32.4, 0.06)));
  EXPECT_FALSE(front.document.child("svg").child("rect"));
  const DrawnSpace side(80);
  ASSERT_EQ(side.lines(false).size(), 3U);
  EXPECT_NEAR(side.lines(false)[2], 95 + 54 * std::sin(1.3963) * static_cast<double>(side.body.near_reach), 0.1);
  EXPECT_TRUE(side.document.child("svg").child("rect"));
  EXPECT_THAT(side.text(), HasSubstr("near;far;"));
}

TEST(DrawSigningSpace, IsDrawnOnContactSheetsThatRequestIt) {
  const Motion motion = moving(whole_person(), 5);
  EXPECT_THAT(contact_sheet(motion, {.rig = rig_of_signer(motion.skeleton())}), Not(HasSubstr("forehead")));
  EXPECT_THAT(contact_sheet(motion, {.signing_space = true, .rig = rig_of_signer(motion.skeleton())}),
              HasSubstr("forehead"));
  const std::vector<Joint> joints = {{"Box", kNoJoint, {0, 1, 0}, true}, {"Lid", 0, {0, 0.2f, 0}, false}};
  const Motion box(std::make_shared<const Skeleton>(joints, std::vector<Tip>{}), {60, 1}, 3);
  try {
    contact_sheet(box, {.signing_space = true, .rig = RigMap{}});
    FAIL() << "a box has a signing space";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::not_found);
    EXPECT_STREQ(error.what(), "contact sheet: no signing space to draw: no left shoulder: name it in a mapping file");
  }
}

}  // namespace
}  // namespace signweave
