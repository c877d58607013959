#include "signweave/drawing/transition_plot.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>

#include "signweave/drawing/svg_text.h"

namespace signweave {
namespace {

// Pixels.
constexpr double kBarsLeft = 66;     // the axis and its numbers
constexpr double kRight = 118;       // labels of the mean and the band
constexpr double kWidth = 1000;      // of the bars' field
constexpr double kBarsHeight = 240;  // the same
constexpr double kBarsTitle = 40;    // above a row
constexpr double kBarsFoot = 34;     // below a row without labels
constexpr double kKey = 34;          // the key, at the top
constexpr double kWidestBar = 40;    // with its gap
constexpr double kLabelStep = 13;    // minimum width of a bar with its gap for a label
constexpr double kLabelSize = 11;
constexpr double kLongestLabel = 150;
constexpr double kGap = 0.22;  // fraction of a bar's step
// Dark and light shades of blue and orange, distinguishable by lightness alone.
constexpr const char* kRetraction = "#1f4e79";
constexpr const char* kPreparation = "#f0a94a";
constexpr const char* kBetween = "#ffffff";
constexpr const char* kBand = "#d9dbde";
constexpr const char* kBarsInk = "#202226";

/// A round step that divides the axis into about five.
double bar_axis_step(double top) {
  for (int power = 0;; ++power) {
    const double step = std::pow(10, power);
    for (const double factor : {1.0, 2.0, 5.0}) {
      if (top / (step * factor) <= 6) return step * factor;
    }
  }
}

struct Row {
  const TransitionPanel* panel = nullptr;
  std::size_t begin = 0;
  std::size_t end = 0;
  double labels = 0;  ///< pixels needed below; 0: none
};

std::string label_of(const TransitionBar& bar) {
  return bar.from + " → " + bar.to;
}

double step_of(const Row& row) {
  return std::min(kWidestBar, kWidth / static_cast<double>(std::max<std::size_t>(1, row.end - row.begin)));
}

std::vector<Row> rows_of(const std::vector<TransitionPanel>& panels) {
  std::vector<Row> rows;
  for (const TransitionPanel& panel : panels) {
    const std::size_t count = std::max<std::size_t>(1, (panel.bars.size() + kBarsPerRow - 1) / kBarsPerRow);
    const std::size_t each = (panel.bars.size() + count - 1) / count;  // rows of equal length
    for (std::size_t i = 0; i < count; ++i) {
      Row row{&panel, i * each, std::min(panel.bars.size(), (i + 1) * each)};
      if (step_of(row) >= kLabelStep) {
        for (std::size_t b = row.begin; b < row.end; ++b) {
          row.labels = std::max(row.labels, std::min(kLongestLabel, kLabelSize * svg_ems(label_of(panel.bars[b]))));
        }
      }
      rows.push_back(row);
    }
  }
  return rows;
}

double height_of(const Row& row) {
  return kBarsTitle + kBarsHeight + kBarsFoot + 0.87 * row.labels;  // they are rotated by 60°
}

/// Draws into `out`.
struct BarCanvas {
  std::string& out;
  template <typename... Arguments>
  void put(fmt::format_string<Arguments...> format, Arguments&&... arguments) {
    fmt::format_to(std::back_inserter(out), format, std::forward<Arguments>(arguments)...);
    out += '\n';
  }
  void box(double x, double y, double width, double height, const char* fill) {
    if (height > 0) {
      put("<rect x=\"{:.2f}\" y=\"{:.2f}\" width=\"{:.2f}\" height=\"{:.2f}\" fill=\"{}\"/>", x, y, width, height,
          fill);
    }
  }
  void text(double x, double y, double size, const char* anchor, std::string_view what, const char* more = "") {
    put("<text x=\"{:.1f}\" y=\"{:.1f}\" font-size=\"{}\" text-anchor=\"{}\" fill=\"{}\"{}>{}</text>", x, y, size,
        anchor, kBarsInk, more, svg_text(what));
  }
};

void draw_key(BarCanvas& canvas, bool inferred) {
  double x = kBarsLeft;
  const auto entry = [&](const char* fill, const char* edge, std::string_view what) {
    canvas.put("<rect x=\"{:.1f}\" y=\"10\" width=\"14\" height=\"14\" fill=\"{}\" stroke=\"{}\"/>", x, fill, edge);
    canvas.text(x + 20, 22, 13, "start", what);
    x += 20 + 13 * svg_ems(what) + 22;
  };
  entry(kRetraction, kRetraction, "retraction");
  entry(kPreparation, kPreparation, "preparation");
  if (inferred) entry(kBetween, kBarsInk, "gap between signs, parts unknown");
  entry(kBand, kBand, "mean ± 1 SD");
}

void draw_bar(BarCanvas& canvas, const TransitionBar& bar, double x, double width, double bottom, double scale) {
  canvas.put("<g><title>{}: {:.0f} ms ({:.0f} + {:.0f}) at {:.0f} ms</title>", svg_text(label_of(bar)), bar.whole,
             bar.retraction, bar.preparation, bar.begin);
  const double whole = bar.whole * scale;
  const double retraction = std::min(whole, bar.retraction * scale);
  const double preparation = std::min(whole - retraction, bar.preparation * scale);
  const double between = whole - retraction - preparation;
  canvas.box(x, bottom - retraction, width, retraction, kRetraction);
  if (between > 0.5) {
    canvas.put(
        "<rect x=\"{:.2f}\" y=\"{:.2f}\" width=\"{:.2f}\" height=\"{:.2f}\" fill=\"{}\" stroke=\"{}\" "
        "stroke-width=\"0.6\"/>",
        x, bottom - retraction - between, width, between, kBetween, kBarsInk);
  }
  canvas.box(x, bottom - whole, width, preparation, kPreparation);
  canvas.put("</g>");
}

void draw_row(BarCanvas& canvas, const Row& row, double y, double top, double step) {
  const TransitionPanel& panel = *row.panel;
  const double scale = kBarsHeight / top;
  const double head = y + kBarsTitle;
  const double bottom = head + kBarsHeight;
  const std::string part =
      row.end - row.begin == panel.bars.size() ? std::string() : fmt::format(", {} to {}", row.begin + 1, row.end);
  canvas.text(kBarsLeft, head - 14, 15, "start",
              fmt::format("{}: {} transition{}{}, mean {:.0f} ms, SD {:.0f} ms", panel.title, panel.bars.size(),
                          panel.bars.size() == 1 ? "" : "s", part, panel.mean, panel.deviation),
              " font-weight=\"bold\"");
  const double band_top = std::min(top, panel.mean + panel.deviation);
  const double band_low = std::max(0.0, panel.mean - panel.deviation);
  canvas.box(kBarsLeft, bottom - band_top * scale, kWidth, (band_top - band_low) * scale, kBand);
  for (int k = 0; k * step <= top * 1.0001; ++k) {
    const double at = k * step;
    const double line = bottom - at * scale;
    canvas.put("<path d=\"M{:.1f} {:.1f}h{:.1f}\" stroke=\"#b4b8bd\" stroke-width=\"0.6\"/>", kBarsLeft, line, kWidth);
    canvas.text(kBarsLeft - 8, line + 4, 12, "end", fmt::format("{:.0f}", at));
  }
  canvas.put(
      "<text transform=\"translate({:.1f} {:.1f}) rotate(-90)\" font-size=\"12\" text-anchor=\"middle\" "
      "fill=\"{}\">ms</text>",
      kBarsLeft - 48, head + kBarsHeight / 2, kBarsInk);
  const double wide = step_of(row);
  for (std::size_t i = row.begin; i < row.end; ++i) {
    const double x = kBarsLeft + wide * (static_cast<double>(i - row.begin) + kGap / 2);
    draw_bar(canvas, panel.bars[i], x, wide * (1 - kGap), bottom, scale);
    if (row.labels > 0) {
      const std::string label = label_of(panel.bars[i]);
      const double at = x + wide * (1 - kGap) / 2 + 4;
      const bool long_one = kLabelSize * svg_ems(label) > kLongestLabel;
      canvas.put(
          "<text transform=\"translate({:.1f} {:.1f}) rotate(-60)\" font-size=\"{}\" text-anchor=\"end\" "
          "fill=\"{}\"{}>{}</text>",
          at, bottom + 12, kLabelSize, kBarsInk,
          long_one ? fmt::format(" textLength=\"{:.0f}\" lengthAdjust=\"spacingAndGlyphs\"", kLongestLabel) : "",
          svg_text(label));
    }
  }
  const double mean = bottom - panel.mean * scale;
  // Above the bars, with a white edge, so that it is visible on any background.
  canvas.put("<path d=\"M{:.1f} {:.1f}h{:.1f}\" stroke=\"#ffffff\" stroke-width=\"4\"/>", kBarsLeft, mean, kWidth);
  canvas.put("<path d=\"M{:.1f} {:.1f}h{:.1f}\" stroke=\"#000000\" stroke-width=\"2.2\"/>", kBarsLeft, mean, kWidth);
  canvas.text(kBarsLeft + kWidth + 6, mean + 4, 12, "start", fmt::format("mean {:.0f}", panel.mean));
  if ((band_top - panel.mean) * scale > 16) {
    canvas.text(kBarsLeft + kWidth + 6, bottom - band_top * scale + 4, 12, "start",
                fmt::format("+1 SD {:.0f}", panel.mean + panel.deviation));
  }
  if ((panel.mean - band_low) * scale > 16) {
    canvas.text(kBarsLeft + kWidth + 6, bottom - band_low * scale + 4, 12, "start",
                fmt::format("−1 SD {:.0f}", panel.mean - panel.deviation));
  }
  canvas.put("<path d=\"M{:.1f} {:.1f}v{:.1f}h{:.1f}\" fill=\"none\" stroke=\"{}\"/>", kBarsLeft, head, kBarsHeight,
             kWidth, kBarsInk);
}

}  // namespace

std::string transition_plot(const std::vector<TransitionPanel>& panels) {
  const std::vector<Row> rows = rows_of(panels);
  double top = 1;
  double height = kKey;
  bool inferred = false;
  for (const TransitionPanel& panel : panels) {
    top = std::max(top, panel.mean + panel.deviation);
    inferred = inferred || panel.inferred;
    for (const TransitionBar& bar : panel.bars) top = std::max(top, bar.whole);
  }
  const double step = bar_axis_step(top);
  top = step * std::ceil(top / step);
  for (const Row& row : rows) height += height_of(row);
  const double width = kBarsLeft + kWidth + kRight;
  std::string out;
  BarCanvas canvas{out};
  canvas.put(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0:.0f}\" height=\"{1:.0f}\" viewBox=\"0 0 {0:.0f} {1:.0f}\" "
      "font-family=\"sans-serif\">",
      width, height);
  canvas.put("<title>Durations of transitions</title>");
  canvas.box(0, 0, width, height, "#ffffff");
  draw_key(canvas, inferred);
  double y = kKey;
  for (const Row& row : rows) {
    draw_row(canvas, row, y, top, step);
    y += height_of(row);
  }
  out += "</svg>\n";
  return out;
}

}  // namespace signweave
