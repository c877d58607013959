#include "signweave/drawing/error_plot.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <pugixml.hpp>

namespace signweave {
namespace {

std::vector<ErrorPanel> panels() {
  return {{.title = "wrist, mm <&>",
           .places = {"170 ms", "280 ms"},
           .rows = {{"slerp", {{10, 8, 12}, {20, 17, 24}}}, {"sine & co", {{14, 12, 17}, {}}}}}};
}

std::vector<std::string> texts(const std::string& svg, const char* path) {
  pugi::xml_document document;
  EXPECT_TRUE(document.load_string(svg.c_str()));
  std::vector<std::string> found;
  for (const auto& node : document.select_nodes(path)) found.emplace_back(node.node().text().get());
  return found;
}

TEST(ErrorPlot, ShowsEveryValueAndName) {
  const std::string svg = error_plot(panels());
  EXPECT_THAT(texts(svg, "//title"), testing::ElementsAre("slerp, 170 ms: 10 (8 to 12)", "slerp, 280 ms: 20 (17 to 24)",
                                                          "sine & co, 170 ms: 14 (12 to 17)"));
  EXPECT_THAT(texts(svg, "//text"), testing::IsSupersetOf({"wrist, mm <&>", "170 ms", "280 ms", "slerp", "sine & co"}));
}

TEST(ErrorPlot, HigherValuesAreDrawnHigher) {
  pugi::xml_document document;
  ASSERT_TRUE(document.load_string(error_plot(panels()).c_str()));
  std::vector<double> heights;
  for (const auto& node : document.select_nodes("//circle")) heights.push_back(node.node().attribute("cy").as_double());
  ASSERT_EQ(heights.size(), 3u);
  EXPECT_GT(heights[0], heights[2]);
  EXPECT_GT(heights[2], heights[1]);
  // On one scale from 0: 20 is twice as far above the axis, at 320, as 10.
  EXPECT_NEAR(320 - heights[1], 2 * (320 - heights[0]), 0.2);
}

TEST(ErrorPlot, WithoutPanelsIsAnEmptyDrawing) {
  pugi::xml_document document;
  EXPECT_TRUE(document.load_string(error_plot({}).c_str()));
  EXPECT_TRUE(document.load_string(error_plot({{.title = "none", .places = {}, .rows = {}}}).c_str()));
  EXPECT_TRUE(document.load_string(error_plot({{.title = "none", .places = {"a"}, .rows = {{"x", {{}}}}}}).c_str()));
}

}  // namespace
}  // namespace signweave
