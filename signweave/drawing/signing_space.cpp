#include "signweave/drawing/signing_space.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>

namespace signweave {
namespace {

constexpr float kAside = 1.5f;          // shoulder widths: extent of the lines to each side
constexpr double kEdge = 5;             // pixels left free at the cell's edges
constexpr double kText = 6.5;           // pixels
constexpr double kSeenFromTheSide = 6;  // pixels between near and far end above which a plane is more than a line

std::string readable(std::string_view name) {
  std::string text(name);
  std::replace(text.begin(), text.end(), '_', ' ');
  return text;
}

}  // namespace

void draw_signing_space(const SignerBody& body, const SignerSpace& space, const FigureView& view, double width,
                        double height, std::string& out) {
  const auto x_of = [&](float x, float z) {
    return std::clamp(view.x(space.to_model({x, 0, z})), kEdge, width - kEdge);
  };
  const auto y_of = [&](float y) { return view.y(space.to_model({0, y, 0})); };
  const auto text = [&](double x, double y, std::string_view anchor, const std::string& what) {
    fmt::format_to(std::back_inserter(out),
                   "<text x=\"{:.1f}\" y=\"{:.1f}\" font-size=\"{}\" text-anchor=\"{}\" fill=\"#5f7f6c\">{}</text>\n",
                   x, y, kText, anchor, what);
  };
  const auto upright = [&](double x, double top, double bottom, const char* dashes) {
    fmt::format_to(std::back_inserter(out),
                   "<line x1=\"{0:.1f}\" y1=\"{1:.1f}\" x2=\"{0:.1f}\" y2=\"{2:.1f}\" stroke=\"#7fa68c\" "
                   "stroke-width=\"0.7\" stroke-dasharray=\"{3}\"/>\n",
                   x, top, bottom, dashes);
  };

  // The visible bounds of the space's box from x −kAside to kAside and from z 0 to the end of the near zone.
  const double corners[] = {x_of(-kAside, 0), x_of(kAside, 0), x_of(-kAside, body.near_reach),
                            x_of(kAside, body.near_reach)};
  const auto [left, right] = std::minmax_element(std::begin(corners), std::end(corners));
  const double top = std::max(kEdge, y_of(body.heights.back()));
  const double bottom = height - kEdge;
  double above = top;
  for (std::size_t i = body.heights.size(); i-- > 0;) {
    const double border = i == 0 ? bottom : std::clamp(y_of(body.heights[i]), kEdge, bottom);
    if (i > 0 && border < bottom) {
      fmt::format_to(std::back_inserter(out),
                     "<line x1=\"{:.1f}\" y1=\"{:.1f}\" x2=\"{:.1f}\" y2=\"{:.1f}\" stroke=\"#7fa68c\" "
                     "stroke-width=\"0.7\"/>\n",
                     *left, border, *right, border);
    }
    // A name is in the middle of its zone; above the head there is little room, so that name is on the line.
    const bool highest = i + 1 == body.heights.size();
    const double middle = highest ? border - 2 : 0.5 * (above + border) + 0.35 * kText;
    if (highest ? border > kText + 2 : border - above > 0.8 * kText) {
      text(kEdge, middle, "start", readable(name_of(static_cast<Height>(i))));
    }
    above = border;
  }
  for (const float x : {-kCentre, kCentre}) {
    const double near = x_of(x, 0);
    const double far = x_of(x, body.near_reach);
    if (std::abs(far - near) > kSeenFromTheSide) {
      fmt::format_to(std::back_inserter(out),
                     "<rect x=\"{:.1f}\" y=\"{:.1f}\" width=\"{:.1f}\" height=\"{:.1f}\" fill=\"#7fa68c\" "
                     "fill-opacity=\"0.10\"/>\n",
                     std::min(near, far), top, std::abs(far - near), bottom - top);
    }
    upright(near, top, bottom, "4 3");
  }
  const double reach = x_of(0, body.near_reach);
  if (std::abs(reach - x_of(0, 0)) > 2 * kSeenFromTheSide) {
    upright(reach, top, bottom, "1 2");
    const bool to_the_right = reach > x_of(0, 0);
    text(reach - 3, top + kText + 1, "end", std::string(name_of(to_the_right ? Reach::near : Reach::far)));
    text(reach + 3, top + kText + 1, "start", std::string(name_of(to_the_right ? Reach::far : Reach::near)));
  }
  const double right_border = x_of(-kCentre, 0);
  const double left_border = x_of(kCentre, 0);
  if (left_border - right_border > 4 * kText) {
    text(0.5 * (left_border + right_border), bottom, "middle", std::string(name_of(Across::centre)));
    text(right_border - 3, bottom, "end", std::string(name_of(Across::right)));
    text(left_border + 3, bottom, "start", std::string(name_of(Across::left)));
  }
}

}  // namespace signweave
