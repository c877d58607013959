#include "signweave/drawing/locus_marks.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>

#include "signweave/drawing/svg_text.h"

namespace signweave {
namespace {

constexpr double kRing = 3.2;             // radius, pixels
constexpr double kInside = kRing + 2;     // from a cell's edges
constexpr const char* kMark = "#a3216f";  // distinguishable from blue, orange and green by colour-blind readers

}  // namespace

void draw_locus(const LocusMark& mark, std::string_view name, std::string& out) {
  fmt::format_to(std::back_inserter(out),
                 "<circle cx=\"{0:.1f}\" cy=\"{1:.1f}\" r=\"{2}\" fill=\"#ffffff\" fill-opacity=\"0.6\" stroke=\"{3}\" "
                 "stroke-width=\"1\"{4}/>\n<path d=\"M{5:.1f} {1:.1f}h{6:.1f}M{0:.1f} {7:.1f}v{6:.1f}\" "
                 "stroke=\"{3}\" stroke-width=\"0.8\"/>\n",
                 mark.x, mark.y, kRing, kMark, mark.outside ? " stroke-dasharray=\"1.6 1.4\"" : "",
                 mark.x - 0.6 * kRing, 1.2 * kRing, mark.y - 0.6 * kRing);
  // The white edge keeps the name readable in front of a figure.
  fmt::format_to(std::back_inserter(out),
                 "<text x=\"{:.1f}\" y=\"{:.1f}\" font-size=\"{}\" text-anchor=\"{}\" fill=\"{}\" stroke=\"#ffffff\" "
                 "stroke-width=\"2\" paint-order=\"stroke\">@{}</text>\n",
                 mark.x + (mark.name_to_left ? -1 : 1) * (kRing + 2), mark.y + 0.35 * mark.size, mark.size,
                 mark.name_to_left ? "end" : "start", kMark, svg_text(name));
}

void draw_loci(std::span<const MarkedLocus> loci, const SignerSpace& space, const FigureView& view, double width,
               double height, std::string& out) {
  for (const MarkedLocus& locus : loci) {
    if (!locus.at.allFinite()) continue;
    const Eigen::Vector3f at = space.to_model(locus.at);
    LocusMark mark{.x = std::clamp(view.x(at), kInside, width - kInside),
                   .y = std::clamp(view.y(at), kInside, height - kInside)};
    mark.outside = mark.x != view.x(at) || mark.y != view.y(at);
    mark.name_to_left = mark.x + kRing + 2 + mark.size * svg_ems("@" + locus.name) > width;
    draw_locus(mark, locus.name, out);
  }
}

}  // namespace signweave
