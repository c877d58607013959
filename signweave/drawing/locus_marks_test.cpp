#include "signweave/drawing/locus_marks.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <memory>
#include <pugixml.hpp>

#include "signweave/core/error.h"
#include "signweave/drawing/contact_sheet.h"
#include "signweave/drawing/locus_plot.h"
#include "signweave/drawing/test_person.h"
#include "signweave/rig/test_rig.h"

namespace signweave {
namespace {

using Eigen::Vector3f;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;

/// The rings in an SVG element and everything below it: "x y", and " dashed".
std::vector<std::string> rings(const pugi::xml_node& node) {
  std::vector<std::string> found;
  for (const pugi::xpath_node& one : node.select_nodes(".//circle[@fill-opacity]")) {
    const pugi::xml_node ring = one.node();
    found.push_back(fmt::format("{} {}{}", ring.attribute("cx").value(), ring.attribute("cy").value(),
                                ring.attribute("stroke-dasharray") ? " dashed" : ""));
  }
  return found;
}

pugi::xml_document read(const std::string& svg) {
  pugi::xml_document document;
  EXPECT_TRUE(document.load_string(svg.c_str()));
  return document;
}

TEST(DrawLoci, PutsARingWhereALocusIsAndADashedOneAtTheEdge) {
  const FigureView view{.left = 100, .bottom = 180, .low = -1, .scale = 50, .near = 0, .far = 0};
  const std::vector<MarkedLocus> loci = {{"a", {0.5f, 0.4f, 1}}, {"<b>", {-1, 9, 0}}, {"c", {NAN, 0, 0}}};
  std::string out = "<svg>";
  draw_loci(loci, SignerSpace{.unit = 0.5f}, view, 200, 200, out);
  const pugi::xml_document document = read(out + "</svg>");
  // 100 + 50 · 0.5 · 0.5 pixels; 180 − 50 · (0.5 · 0.4 + 1).
  EXPECT_THAT(rings(document), ElementsAre("112.5 120.0", "75.0 5.2 dashed"));
  EXPECT_THAT(out, HasSubstr("@&lt;b&gt;</text>"));
}

TEST(DrawLoci, TurnsANameInwardsAtTheRightEdge) {
  const FigureView view{.left = 100, .bottom = 100, .low = 0, .scale = 50, .near = 0, .far = 0};
  std::string out;
  draw_loci(std::vector<MarkedLocus>{{"left", {1.8f, 0, 0}}}, SignerSpace{}, view, 200, 200, out);
  EXPECT_THAT(out, HasSubstr("text-anchor=\"end\""));
}

/// The place of the ring in the only cell of a sheet.
std::string ring_on_sheet(const Vector3f& at, ContactSheetOptions options) {
  const Motion motion(whole_person(), {60, 1}, 1);
  options.cells = 1;
  options.loci = {{"a", at}};
  const std::vector<std::string> found = rings(read(contact_sheet(motion, options)));
  return found.size() == 1 ? found.front() : fmt::format("{} rings", found.size());
}

TEST(DrawLoci, ASheetShowsDepthFromAboveOnly) {
  const ContactSheetOptions front;
  const ContactSheetOptions above{.from_above = true};
  EXPECT_EQ(ring_on_sheet({0.4f, 0, 0.2f}, front), ring_on_sheet({0.4f, 0, 0.6f}, front));
  EXPECT_NE(ring_on_sheet({0.4f, 0, 0.2f}, above), ring_on_sheet({0.4f, 0, 0.6f}, above));
  EXPECT_EQ(ring_on_sheet({0.4f, 0.1f, 0.3f}, above), ring_on_sheet({0.4f, 0.2f, 0.3f}, above));
  EXPECT_NE(ring_on_sheet({0.4f, 0.1f, 0.3f}, front), ring_on_sheet({0.4f, 0.2f, 0.3f}, front));
  // The signer's left is on the right, and what is ahead is below.
  const auto x_of = [](const std::string& ring) { return std::stod(ring); };
  const auto y_of = [](const std::string& ring) { return std::stod(ring.substr(ring.find(' '))); };
  EXPECT_GT(x_of(ring_on_sheet({0.4f, 0, 0.2f}, above)), x_of(ring_on_sheet({-0.4f, 0, 0.2f}, above)));
  EXPECT_GT(y_of(ring_on_sheet({0.4f, 0, 0.6f}, above)), y_of(ring_on_sheet({0.4f, 0, 0.2f}, above)));
}

TEST(DrawLoci, AFarLocusIsAtTheEdgeAndDoesNotShrinkTheFigure) {
  const ContactSheetOptions above{.from_above = true};
  EXPECT_THAT(ring_on_sheet({0, 0, 5}, above), HasSubstr("dashed"));
  EXPECT_THAT(ring_on_sheet({0, 0, 1.5f}, above), Not(HasSubstr("dashed")));
}

TEST(DrawLoci, ASheetWithoutShouldersHasNoPlaceForThem) {
  const std::vector<Joint> joints = {{.name = "root", .parent = kNoJoint}};
  const Motion motion(std::make_shared<const Skeleton>(joints, std::vector<Tip>{}), {60, 1}, 1);
  ContactSheetOptions options;
  options.loci = {{"a", {0, 0, 1}}};
  EXPECT_THROW(contact_sheet(motion, options), Error);
}

SignerBody some_body() {
  SignerBody body{.shoulder_width = 0.35f};
  body.heights = {-10, -1.4f, -0.7f, -0.3f, 0.3f, 0.45f, 0.6f, 0.95f};
  body.near_reach = 1;
  return body;
}

TEST(LocusPlot, ShowsBothEndsInBothViewsAndTheLociWithinThem) {
  const std::vector<LocusPanel> panels = {
      {"GIVE <2>", {{{0, -0.2f, 0.4f}, {0.6f, 0, 1}, "give & take"}, {{0, -0.2f, 0.4f}, {-0.6f, 0, 1}, "second"}}}};
  const std::vector<MarkedLocus> loci = {{"left", {0.8f, 0, 0.8f}}, {"addressee", {0, 0, 5}}};
  const std::string svg = locus_plot(panels, some_body(), loci);
  const pugi::xml_document document = read(svg);
  EXPECT_EQ(document.select_nodes("//g/circle[@fill='#0072b2']").size(), 4U);
  EXPECT_EQ(document.select_nodes("//g/circle[@stroke='#d55e00']").size(), 4U);
  EXPECT_EQ(rings(document).size(), 3U) << "in the key, and @left twice";
  EXPECT_THAT(svg, HasSubstr("GIVE &lt;2&gt;"));
  EXPECT_THAT(svg, HasSubstr("<title>give &amp; take</title>"));
  EXPECT_THAT(svg, HasSubstr(">forehead</text>"));
}

TEST(LocusPlot, MakesRoomForATokenThatIsFarAway) {
  const auto size_of = [](const Vector3f& end) {
    const std::vector<LocusPanel> panels = {{"A", {{Vector3f::Zero(), end, ""}}}};
    const pugi::xml_document document = read(locus_plot(panels, some_body(), {}));
    return std::pair(document.child("svg").attribute("width").as_int(),
                     document.child("svg").attribute("height").as_int());
  };
  EXPECT_EQ(size_of({1, 0, 1}), size_of({-1, 0.5f, 0}));
  EXPECT_GT(size_of({-2, 0, 0}).first, size_of({-1, 0, 0}).first);
  EXPECT_GT(size_of({0, -3, 0}).second, size_of({0, -1, 0}).second);
}

}  // namespace
}  // namespace signweave
