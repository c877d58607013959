#include "signweave/drawing/error_plot.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numeric>

#include "signweave/drawing/svg_text.h"

namespace signweave {
namespace {

// Pixels.
constexpr double kLinesLeft = 70;
constexpr double kField = 640;
constexpr double kLinesNames = 210;  // to the right of the field
constexpr double kLinesHeight = 280;
constexpr double kLinesTitle = 40;
constexpr double kLinesFoot = 40;
constexpr double kNameStep = 15;  // minimum distance between names
constexpr double kSpread = 5;     // between rows at one position
constexpr const char* kLinesInk = "#202226";
// Okabe and Ito 2008: distinguishable by colour-blind readers.
constexpr const char* kColours[] = {"#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9", "#000000"};
constexpr const char* kDashes[] = {"", "6 3", "2 3"};

double line_axis_step(double top) {
  for (int power = -4;; ++power) {
    const double step = std::pow(10, power);
    for (const double factor : {1.0, 2.0, 5.0}) {
      if (top / (step * factor) <= 6) return step * factor;
    }
  }
}

struct Style {
  const char* colour;
  const char* dash;
};
Style style_of(std::size_t row) {
  return {kColours[row % std::size(kColours)], kDashes[row / std::size(kColours) % std::size(kDashes)]};
}

class LineCanvas {
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
  std::string text;
};

double top_of(const ErrorPanel& panel) {
  double top = 0;
  for (const ErrorRow& row : panel.rows) {
    for (const ErrorMark& mark : row.marks) {
      for (const double one : {mark.value, mark.high}) {
        if (std::isfinite(one)) top = std::max(top, one);
      }
    }
  }
  return top > 0 ? top * 1.05 : 1;
}

/// The heights of the names: at the ends of their lines, spaced far enough apart for the letters.
std::vector<double> name_places(std::vector<double> wanted, double head, double bottom) {
  std::vector<std::size_t> order(wanted.size());
  std::iota(order.begin(), order.end(), 0u);
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return wanted[a] < wanted[b]; });
  double next = head;
  for (const std::size_t i : order) {
    wanted[i] = std::max(wanted[i], next);
    next = wanted[i] + kNameStep;
  }
  double last = std::max(bottom, head + kNameStep * static_cast<double>(wanted.size()));
  for (auto i = order.rbegin(); i != order.rend(); ++i) {
    wanted[*i] = std::min(wanted[*i], last);
    last = wanted[*i] - kNameStep;
  }
  return wanted;
}

double height_of(const ErrorPanel& panel) {
  return kLinesTitle + std::max(kLinesHeight, kNameStep * static_cast<double>(panel.rows.size())) + kLinesFoot;
}

void draw(LineCanvas& canvas, const ErrorPanel& panel, double y) {
  const double head = y + kLinesTitle;
  const double bottom = head + kLinesHeight;
  const double top = top_of(panel);
  const double step = line_axis_step(top);
  const auto height_at = [&](double value) { return bottom - kLinesHeight * std::clamp(value / top, -0.05, 1.0); };
  canvas.words(kLinesLeft, head - 16, 15, "start", kLinesInk, panel.title);
  const int decimals = std::max(0, static_cast<int>(std::ceil(-std::log10(step) - 1e-9)));
  for (int k = 0; k * step <= top; ++k) {
    const double at = k * step;
    canvas.put("<path d=\"M{:.1f} {:.1f}h{:.1f}\" stroke=\"#c8ccd1\" stroke-width=\"0.7\"/>", kLinesLeft, height_at(at),
               kField);
    canvas.words(kLinesLeft - 8, height_at(at) + 4, 12, "end", kLinesInk, fmt::format("{:.{}f}", at, decimals));
  }
  const double wide = kField / static_cast<double>(std::max<std::size_t>(1, panel.places.size()));
  const auto place_at = [&](std::size_t place) { return kLinesLeft + wide * (static_cast<double>(place) + 0.5); };
  for (std::size_t place = 0; place < panel.places.size(); ++place) {
    canvas.words(place_at(place), bottom + 20, 12, "middle", kLinesInk, panel.places[place]);
  }
  std::vector<double> ends;
  for (std::size_t r = 0; r < panel.rows.size(); ++r) {
    const ErrorRow& row = panel.rows[r];
    const Style style = style_of(r);
    const double aside = std::min(kSpread, wide / static_cast<double>(panel.rows.size() + 1)) *
                         (static_cast<double>(r) - 0.5 * static_cast<double>(panel.rows.size() - 1));
    std::string line;
    ends.push_back(bottom);
    canvas.put("<g stroke=\"{0}\" fill=\"{0}\">", style.colour);
    for (std::size_t place = 0; place < row.marks.size(); ++place) {
      const ErrorMark& mark = row.marks[place];
      if (!std::isfinite(mark.value)) continue;
      const double x = place_at(place) + aside;
      line += fmt::format("{}{:.1f} {:.1f}", line.empty() ? "M" : "L", x, height_at(mark.value));
      ends.back() = height_at(mark.value);
      const bool known = std::isfinite(mark.low) && std::isfinite(mark.high);
      canvas.put("<g><title>{}, {}: {:.4g}{}</title>", svg_text(row.name), svg_text(panel.places[place]), mark.value,
                 known ? fmt::format(" ({:.4g} to {:.4g})", mark.low, mark.high) : "");
      if (known) {
        canvas.put("<path d=\"M{0:.1f} {1:.1f}V{2:.1f}\" stroke-width=\"1.2\"/>", x, height_at(mark.low),
                   height_at(mark.high));
      }
      canvas.put("<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"2.6\" stroke=\"none\"/></g>", x, height_at(mark.value));
    }
    canvas.put("<path d=\"{}\" fill=\"none\" stroke-width=\"1.6\"{}/></g>", line.empty() ? "M0 0" : line,
               *style.dash == '\0' ? "" : fmt::format(" stroke-dasharray=\"{}\"", style.dash));
  }
  const std::vector<double> places = name_places(ends, head, bottom);
  for (std::size_t r = 0; r < panel.rows.size(); ++r) {
    const Style style = style_of(r);
    canvas.put("<path d=\"M{:.1f} {:.1f}L{:.1f} {:.1f}h18\" stroke=\"{}\" fill=\"none\" stroke-width=\"1\"{}/>",
               kLinesLeft + kField - 4, ends[r], kLinesLeft + kField + 12, places[r], style.colour,
               *style.dash == '\0' ? "" : fmt::format(" stroke-dasharray=\"{}\"", style.dash));
    canvas.words(kLinesLeft + kField + 34, places[r] + 4, 12, "start", style.colour, panel.rows[r].name);
  }
}

}  // namespace

std::string error_plot(const std::vector<ErrorPanel>& panels) {
  double height = 10;
  for (const ErrorPanel& panel : panels) height += height_of(panel);
  LineCanvas canvas;
  canvas.put(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0:.0f}\" height=\"{1:.0f}\" viewBox=\"0 0 {0:.0f} {1:.0f}\" "
      "font-family=\"sans-serif\">",
      kLinesLeft + kField + kLinesNames, height);
  canvas.put("<rect width=\"100%\" height=\"100%\" fill=\"#ffffff\"/>");
  double y = 0;
  for (const ErrorPanel& panel : panels) {
    draw(canvas, panel, y);
    y += height_of(panel);
  }
  canvas.put("</svg>");
  return std::move(canvas.text);
}

}  // namespace signweave
