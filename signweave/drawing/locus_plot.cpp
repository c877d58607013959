#include "signweave/drawing/locus_plot.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>

#include "signweave/drawing/svg_text.h"

namespace signweave {
namespace {

// Pixels, unless given otherwise.
constexpr double kPixelsPerWidth = 120;  // per shoulder width
constexpr double kPageEdge = 16;         // around the page, and between the views
constexpr double kKeyLine = 40;
constexpr double kPanelTitle = 44;
constexpr double kFoot = 18;   // below a view, for the names of the zones
constexpr double kSmall = 10;  // text
constexpr double kEndRadius = 3.6;
constexpr const char* kSpaceInk = "#202226";
constexpr const char* kZone = "#7fa68c";
constexpr const char* kZoneText = "#5f7f6c";
constexpr const char* kBodyFill = "#e4e7ec";
constexpr const char* kBodyRim = "#aab0ba";
// Okabe and Ito 2008; begin and end differ in shape too.
constexpr const char* kBegin = "#d55e00";
constexpr const char* kEnd = "#0072b2";

/// The part of the space that is drawn, shoulder widths: at least arm's length, and more if a token needs it.
struct Bounds {
  double aside = 1.7;
  double low = -1.6, top = 1.2;       ///< height
  double behind = -0.5, ahead = 2.0;  ///< forward

  void include(const Eigen::Vector3f& point) {
    constexpr double kRoom = 0.1;
    const Eigen::Vector3d at = point.cast<double>();
    aside = std::max(aside, std::abs(at.x()) + kRoom);
    low = std::min(low, at.y() - kRoom);
    top = std::max(top, at.y() + kRoom);
    behind = std::min(behind, at.z() - kRoom);
    ahead = std::max(ahead, at.z() + kRoom);
  }
  double width() const { return 2 * aside * kPixelsPerWidth; }
  double front_height() const { return (top - low) * kPixelsPerWidth; }
  double above_height() const { return (ahead - behind) * kPixelsPerWidth; }
  double height() const { return std::max(front_height(), above_height()); }
};

/// One of the two views, with the place of the signer's origin on the page.
struct SpaceView {
  bool above = false;
  double x0 = 0, y0 = 0;
  double left = 0, top = 0, width = 0, height = 0;
  double x(double across) const { return x0 + kPixelsPerWidth * across; }
  /// Of a height from the front, of a distance forward from above.
  double y(double value) const { return y0 + (above ? kPixelsPerWidth : -kPixelsPerWidth) * value; }
  double x(const Eigen::Vector3f& at) const { return x(static_cast<double>(at.x())); }
  double y(const Eigen::Vector3f& at) const { return y(static_cast<double>(above ? at.z() : at.y())); }
  bool shows(const Eigen::Vector3f& at) const {
    return x(at) >= left && x(at) <= left + width && y(at) >= top && y(at) <= top + height;
  }
};

class SpaceCanvas {
 public:
  template <typename... Arguments>
  void put(fmt::format_string<Arguments...> format, Arguments&&... arguments) {
    fmt::format_to(std::back_inserter(text), format, std::forward<Arguments>(arguments)...);
    text += '\n';
  }
  void words(double x, double y, double size, const char* anchor, const char* fill, std::string_view what) {
    put("<text x=\"{:.1f}\" y=\"{:.1f}\" font-size=\"{}\" text-anchor=\"{}\" fill=\"{}\">{}</text>", x, y, size, anchor,
        fill, svg_text(what));
  }
  void line(double x1, double y1, double x2, double y2, const char* dashes = "") {
    put("<path d=\"M{:.1f} {:.1f}L{:.1f} {:.1f}\" stroke=\"{}\" stroke-width=\"0.8\"{}/>", x1, y1, x2, y2, kZone,
        *dashes == '\0' ? "" : fmt::format(" stroke-dasharray=\"{}\"", dashes));
  }
  void ellipse(double x, double y, double across, double along) {
    put("<ellipse cx=\"{:.1f}\" cy=\"{:.1f}\" rx=\"{:.1f}\" ry=\"{:.1f}\" fill=\"{}\" stroke=\"{}\"/>", x, y, across,
        along, kBodyFill, kBodyRim);
  }
  void begin(double x, double y) {
    put("<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"{}\" fill=\"#ffffff\" stroke=\"{}\" stroke-width=\"1.6\"/>", x, y,
        kEndRadius - 0.4, kBegin);
  }
  void end(double x, double y) {
    put("<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"{}\" fill=\"{}\"/>", x, y, kEndRadius, kEnd);
  }
  std::string text;
};

std::string height_name(std::size_t height) {
  std::string name(name_of(static_cast<Height>(height)));
  std::replace(name.begin(), name.end(), '_', ' ');
  return name;
}

void draw_key(SpaceCanvas& canvas) {
  double x = kPageEdge + 6;
  constexpr double kLine = 20;
  const auto entry = [&](std::string_view what) {
    canvas.words(x + 10, kLine + 4, 13, "start", kSpaceInk, what);
    x += 10 + 13 * svg_ems(what) + 24;
  };
  canvas.begin(x, kLine);
  entry("begin of the stroke");
  canvas.end(x, kLine);
  entry("end of the stroke");
  draw_locus({.x = x, .y = kLine, .size = 12}, "left", canvas.text);
  x += 40;
  entry("a locus with a name");
}

/// The signer, and the borders of the zones with their names.
void draw_front(SpaceCanvas& canvas, const SpaceView& view, const SignerBody& body) {
  const auto height = [&](Height which) { return static_cast<double>(body.heights[static_cast<std::size_t>(which)]); };
  const double waist = std::max(height(Height::waist), -1.6);
  canvas.put(
      "<path d=\"M{:.1f} {:.1f}Q{:.1f} {:.1f} {:.1f} {:.1f}H{:.1f}Q{:.1f} {:.1f} {:.1f} {:.1f}L{:.1f} "
      "{:.1f}H{:.1f}Z\" fill=\"{}\" stroke=\"{}\"/>",
      view.x(-0.56), view.y(-0.12), view.x(-0.52), view.y(0.1), view.x(-0.25), view.y(0.12), view.x(0.25), view.x(0.52),
      view.y(0.1), view.x(0.56), view.y(-0.12), view.x(0.4), view.y(waist), view.x(-0.4), kBodyFill, kBodyRim);
  const double chin = height(Height::chin);
  const double crown = height(Height::above_head);
  canvas.ellipse(view.x(0.0), view.y((chin + crown) / 2), 0.36 * kPixelsPerWidth * (crown - chin),
                 kPixelsPerWidth * (crown - chin) / 2);
  double above = view.top;
  for (std::size_t i = body.heights.size(); i-- > 0;) {
    const double border = i == 0 ? view.top + view.height : view.y(static_cast<double>(body.heights[i]));
    if (i > 0) canvas.line(view.left, border, view.left + view.width, border);
    if (border - above > kSmall) {
      canvas.words(view.left + 4, 0.5 * (above + border) + 0.35 * kSmall, kSmall, "start", kZoneText, height_name(i));
    }
    above = border;
  }
}

void draw_above(SpaceCanvas& canvas, const SpaceView& view, const SignerBody& body) {
  canvas.ellipse(view.x(0.0), view.y(0.0), 0.62 * kPixelsPerWidth, 0.26 * kPixelsPerWidth);
  canvas.put("<path d=\"M{:.1f} {:.1f}L{:.1f} {:.1f}L{:.1f} {:.1f}Z\" fill=\"{}\" stroke=\"{}\"/>", view.x(-0.09),
             view.y(0.3), view.x(0.0), view.y(0.42), view.x(0.09), view.y(0.3), kBodyFill, kBodyRim);
  canvas.ellipse(view.x(0.0), view.y(0.06), 0.24 * kPixelsPerWidth, 0.29 * kPixelsPerWidth);
  const double reach = view.y(static_cast<double>(body.near_reach));
  canvas.line(view.left, reach, view.left + view.width, reach, "1 2");
  canvas.words(view.left + 4, reach - 4, kSmall, "start", kZoneText, name_of(Reach::near));
  canvas.words(view.left + 4, reach + kSmall + 1, kSmall, "start", kZoneText, name_of(Reach::far));
}

void draw_view(SpaceCanvas& canvas, const SpaceView& view, const LocusPanel& panel, const SignerBody& body,
               std::span<const MarkedLocus> loci) {
  canvas.put("<rect x=\"{:.1f}\" y=\"{:.1f}\" width=\"{:.1f}\" height=\"{:.1f}\" fill=\"#f6f7f9\" rx=\"4\"/>",
             view.left, view.top, view.width, view.height);
  view.above ? draw_above(canvas, view, body) : draw_front(canvas, view, body);
  for (const double border : {-1.0, 1.0}) {
    const double x = view.x(border * static_cast<double>(kCentre));
    canvas.line(x, view.top, x, view.top + view.height, "4 3");
  }
  const double foot = view.top + view.height + kSmall + 2;
  canvas.words(view.x(-static_cast<double>(kCentre)) - 4, foot, kSmall, "end", kZoneText, name_of(Across::right));
  canvas.words(view.x(0.0), foot, kSmall, "middle", kZoneText, name_of(Across::centre));
  canvas.words(view.x(static_cast<double>(kCentre)) + 4, foot, kSmall, "start", kZoneText, name_of(Across::left));
  for (const MarkedLocus& locus : loci) {
    if (!(locus.at.norm() <= kFarthestDrawn) || !view.shows(locus.at)) continue;
    draw_locus({.x = view.x(locus.at), .y = view.y(locus.at), .size = kSmall}, locus.name, canvas.text);
  }
  for (const StrokeEnds& token : panel.tokens) {
    canvas.put("<path d=\"M{:.1f} {:.1f}L{:.1f} {:.1f}\" stroke=\"{}\" stroke-width=\"1\" stroke-opacity=\"0.45\"/>",
               view.x(token.begin), view.y(token.begin), view.x(token.end), view.y(token.end), kSpaceInk);
  }
  for (const StrokeEnds& token : panel.tokens) {
    canvas.put("<g><title>{}</title>", svg_text(token.label));
    canvas.begin(view.x(token.begin), view.y(token.begin));
    canvas.end(view.x(token.end), view.y(token.end));
    canvas.put("</g>");
  }
}

}  // namespace

std::string locus_plot(std::span<const LocusPanel> panels, const SignerBody& body, std::span<const MarkedLocus> loci) {
  Bounds bounds;
  for (const LocusPanel& panel : panels) {
    for (const StrokeEnds& token : panel.tokens) {
      bounds.include(token.begin);
      bounds.include(token.end);
    }
  }
  const double row = kPanelTitle + bounds.height() + kFoot + kPageEdge;
  const double width = 3 * kPageEdge + 2 * bounds.width();
  SpaceCanvas canvas;
  canvas.put(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0:.0f}\" height=\"{1:.0f}\" viewBox=\"0 0 {0:.0f} {1:.0f}\" "
      "font-family=\"sans-serif\">",
      width, kKeyLine + row * static_cast<double>(panels.size()));
  canvas.put("<title>Ends of strokes in signing space</title>");
  canvas.put("<rect width=\"100%\" height=\"100%\" fill=\"#ffffff\"/>");
  draw_key(canvas);
  double y = kKeyLine;
  for (const LocusPanel& panel : panels) {
    canvas.put("<text x=\"{:.1f}\" y=\"{:.1f}\" font-size=\"15\" font-weight=\"bold\" fill=\"{}\">{}</text>", kPageEdge,
               y + 16, kSpaceInk, svg_text(panel.title));
    for (const bool above : {false, true}) {
      SpaceView view{.above = above};
      view.left = above ? 2 * kPageEdge + bounds.width() : kPageEdge;
      view.top = y + kPanelTitle;
      view.width = bounds.width();
      view.height = bounds.height();
      view.x0 = view.left + bounds.width() / 2;
      view.y0 = view.top + kPixelsPerWidth * (above ? -bounds.behind : bounds.top);
      canvas.words(view.left, view.top - 6, 12, "start", kSpaceInk, above ? "from above" : "from the front");
      draw_view(canvas, view, panel, body, loci);
    }
    y += row;
  }
  canvas.put("</svg>");
  return std::move(canvas.text);
}

}  // namespace signweave
