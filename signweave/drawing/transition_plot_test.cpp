#include "signweave/drawing/transition_plot.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <pugixml.hpp>

namespace signweave {
namespace {

using testing::HasSubstr;
using testing::Not;

TransitionPanel panel(std::size_t bars) {
  TransitionPanel made{.title = "meteo", .mean = 700, .deviation = 200};
  for (std::size_t i = 0; i < bars; ++i) {
    made.bars.push_back({.from = "A", .to = "B", .retraction = 300, .preparation = 400, .whole = 700});
  }
  return made;
}

std::size_t count(const std::string& text, const std::string& what) {
  std::size_t found = 0;
  for (std::size_t at = text.find(what); at != std::string::npos; at = text.find(what, at + 1)) ++found;
  return found;
}

pugi::xml_document parsed_plot(const std::string& text) {
  pugi::xml_document document;
  EXPECT_TRUE(document.load_string(text.c_str())) << text;
  return document;
}

TEST(TransitionPlot, ABarIsSplitIntoItsParts) {
  TransitionPanel one = panel(1);
  one.bars[0].whole = 750;  // 50 ms between the signs
  const std::string text = transition_plot({one});
  const pugi::xml_document document = parsed_plot(text);
  const pugi::xml_node bar = document.child("svg").child("g");
  std::vector<double> heights;
  std::vector<double> tops;
  for (const pugi::xml_node rect : bar.children("rect")) {
    heights.push_back(rect.attribute("height").as_double());
    tops.push_back(rect.attribute("y").as_double());
  }
  ASSERT_EQ(heights.size(), 3u);  // retraction, between, preparation
  EXPECT_NEAR(heights[2] / heights[0], 400.0 / 300, 1e-3);
  EXPECT_NEAR(heights[1] / heights[0], 50.0 / 300, 1e-3);
  EXPECT_NEAR(tops[2] + heights[2], tops[1], 0.02);  // one on top of the other
  EXPECT_NEAR(tops[1] + heights[1], tops[0], 0.02);
  EXPECT_THAT(text, HasSubstr("mean 700"));
  EXPECT_THAT(text, HasSubstr("+1 SD 900"));
  EXPECT_THAT(text, HasSubstr("<title>A → B: 750 ms (300 + 400) at 0 ms</title>"));
}

TEST(TransitionPlot, LabelsAreDrawnIfThereIsRoom) {
  EXPECT_EQ(count(transition_plot({panel(60)}), ">A → B</text>"), 60u);
  const std::string many = transition_plot({panel(200)});
  EXPECT_EQ(count(many, ">A → B</text>"), 0u);
  EXPECT_EQ(count(many, "<g>"), 200u);
  EXPECT_THAT(many, HasSubstr("width=\"3.90\""));  // 5 pixels with the gap: visible
}

TEST(TransitionPlot, ALongPanelContinuesInFurtherRows) {
  const std::string text = transition_plot({panel(401)});
  EXPECT_EQ(count(text, "<g>"), 401u);
  EXPECT_THAT(text, HasSubstr(", 1 to 134,"));
  EXPECT_THAT(text, HasSubstr(", 269 to 401,"));
}

TEST(TransitionPlot, TextOfAnyScriptIsEscaped) {
  TransitionPanel one = panel(1);
  one.title = "<b>\"&\x01";
  one.bars[0].from = "天気";
  one.bars[0].to = "</g><script>";
  const std::string text = transition_plot({one});
  parsed_plot(text);
  EXPECT_THAT(text, Not(HasSubstr("<script>")));
  EXPECT_THAT(text, HasSubstr("天気 → &lt;/g&gt;&lt;script&gt;"));
  one.bars[0].from = "caf\xe9";  // not UTF-8
  EXPECT_THAT(transition_plot({one}), HasSubstr("caf?"));
}

TEST(TransitionPlot, NoPanelsGiveAnEmptyDrawing) {
  parsed_plot(transition_plot({}));
  parsed_plot(transition_plot({{.title = "empty"}}));
}

TEST(TransitionPlot, InferredTransitionsHaveAKeyOfTheirOwn) {
  TransitionPanel one = panel(1);
  one.bars[0].retraction = one.bars[0].preparation = 0;
  one.inferred = true;
  EXPECT_THAT(transition_plot({one}), HasSubstr("parts unknown"));
  EXPECT_THAT(transition_plot({panel(1)}), Not(HasSubstr("parts unknown")));
}

}  // namespace
}  // namespace signweave
