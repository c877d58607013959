#include "signweave/formats/contact_sheet.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numbers>
#include <string_view>

#include "signweave/core/error.h"
#include "signweave/core/text.h"
#include "signweave/formats/figure.h"
#include "signweave/motion/blend.h"
#include "signweave/motion/kinematics.h"

namespace signweave {
namespace {

using Eigen::Vector3f;

constexpr double kCellWidth = 190;   // pixels, with the margins
constexpr double kCellHeight = 214;  // with the caption
constexpr double kCaption = 26;
constexpr double kMargin = 8;

std::string xml(std::string_view text) {
  const bool readable = is_utf8(text);
  std::string result;
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    switch (c) {
      case '&':
        result += "&amp;";
        break;
      case '<':
        result += "&lt;";
        break;
      case '>':
        result += "&gt;";
        break;
      case '"':
        result += "&quot;";
        break;
      default:
        // XML allows no control characters but the white ones, not even escaped.
        if (byte < 0x20) {
          result += ' ';
        } else if (byte >= 0x7f && !readable) {
          result += '?';
        } else {
          result += c;
        }
    }
  }
  return result;
}

/// One scale for all cells.
FigureView view_of(const std::vector<std::vector<Vector3f>>& figures) {
  double half_width = 0.1;  // metres
  double top = 0;
  FigureView view;
  bool first = true;
  for (const auto& points : figures) {
    for (const Vector3f& point : points) {
      const Eigen::Vector3d at = point.cast<double>();
      half_width = std::max(half_width, std::abs(at.x()));
      view.low = first ? at.y() : std::min(view.low, at.y());
      top = first ? at.y() : std::max(top, at.y());
      view.near = first ? at.z() : std::max(view.near, at.z());
      view.far = first ? at.z() : std::min(view.far, at.z());
      first = false;
    }
  }
  view.left = kCellWidth / 2;
  view.bottom = kCellHeight - kCaption - kMargin;
  view.scale = std::min((kCellWidth / 2 - kMargin) / half_width,
                        (kCellHeight - kCaption - 2 * kMargin) / std::max(top - view.low, 1e-6));
  return view;
}

void turn_about_vertical(double degrees, ModelPose& pose) {
  const Eigen::Quaternionf turn(
      Eigen::AngleAxisf(static_cast<float>(degrees * std::numbers::pi / 180), Vector3f::UnitY()));
  for (Vector3f& position : pose.positions) position = turn * position;
  for (Eigen::Quaternionf& rotation : pose.rotations) rotation = turn * rotation;
}

std::vector<std::int64_t> frames_to_show(const Motion& motion, const ContactSheetOptions& options) {
  if (motion.frame_count() == 0) throw Error(ErrorCode::bad_input, "contact sheet: the motion has no frames to draw");
  if (options.columns == 0) throw Error(ErrorCode::bad_input, "contact sheet: 0 columns; take at least 1");
  if (options.frames.empty()) {
    const auto cells = static_cast<std::int64_t>(
        std::clamp<std::uint64_t>(options.cells, 1, static_cast<std::uint64_t>(motion.frame_count())));
    std::vector<std::int64_t> frames;
    for (std::int64_t i = 0; i < cells; ++i) {
      frames.push_back(cells == 1 ? 0 : i * (motion.frame_count() - 1) / (cells - 1));
    }
    return frames;
  }
  for (const std::int64_t frame : options.frames) {
    if (frame < 0 || frame >= motion.frame_count()) {
      throw Error(ErrorCode::bad_input, fmt::format("contact sheet: frame {} of a motion of {} frames; take 0 to {}",
                                                    frame, motion.frame_count(), motion.frame_count() - 1));
    }
  }
  return options.frames;
}

}  // namespace

std::string contact_sheet(const Motion& motion, const ContactSheetOptions& options) {
  const std::vector<std::int64_t> frames = frames_to_show(motion, options);
  const Skeleton& skeleton = motion.skeleton();

  std::vector<ModelPose> poses;
  std::vector<std::vector<Vector3f>> figures;
  std::vector<FigurePart> parts;
  for (const std::int64_t frame : frames) {
    // Seen from where the signer faces, wherever that is on the floor.
    Pose pose(motion.pose(frame));
    apply(align(standing_over(motion, {frame, frame + 1}), Standing{}), motion.skeleton(), pose.view());
    poses.push_back(to_model_space(skeleton, pose.view()));
    if (parts.empty()) parts = figure_parts(skeleton, poses.front());
    if (options.turn != 0) turn_about_vertical(options.turn, poses.back());
    figures.push_back(figure_points(skeleton, parts, poses.back()));
  }
  const FigureView view = view_of(figures);

  const std::size_t columns = std::min(options.columns, frames.size());
  const std::size_t rows = (frames.size() + columns - 1) / columns;
  const double header = options.title.empty() ? kMargin : 34;
  const double footer = options.note.empty() ? kMargin : 28;
  const double width = kCellWidth * static_cast<double>(columns) + 2 * kMargin;
  const double height = header + kCellHeight * static_cast<double>(rows) + footer;
  std::string out = fmt::format(
      "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
      "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0:.0f}\" height=\"{1:.0f}\" viewBox=\"0 0 {0:.0f} {1:.0f}\" "
      "font-family=\"sans-serif\" stroke-linecap=\"round\" stroke-linejoin=\"round\">\n<rect width=\"{0:.0f}\" "
      "height=\"{1:.0f}\" "
      "fill=\"#ffffff\"/>\n",
      width, height);
  const auto text = [&](double x, double y, int size, std::string_view anchor, std::string_view what) {
    fmt::format_to(std::back_inserter(out),
                   "<text x=\"{:.1f}\" y=\"{:.1f}\" font-size=\"{}\" text-anchor=\"{}\" fill=\"#202226\">{}</text>\n",
                   x, y, size, anchor, xml(what));
  };
  if (!options.title.empty()) text(2 * kMargin, 23, 16, "start", options.title);
  for (std::size_t cell = 0; cell < frames.size(); ++cell) {
    const double x = kMargin + kCellWidth * static_cast<double>(cell % columns);
    const double y = header + kCellHeight * static_cast<double>(cell / columns);
    fmt::format_to(std::back_inserter(out),
                   "<g transform=\"translate({:.1f} {:.1f})\">\n<rect x=\"2\" y=\"2\" width=\"{:.1f}\" "
                   "height=\"{:.1f}\" fill=\"#f6f7f9\" rx=\"4\"/>\n",
                   x, y, kCellWidth - 4, kCellHeight - 4);
    draw_figure(skeleton, parts, poses[cell], figure_face(motion, frames[cell]), view, out);
    const double seconds = static_cast<double>(frames[cell]) * motion.rate().frame_time().count();
    text(kCellWidth / 2, kCellHeight - 10, 11, "middle",
         cell < options.captions.size() ? options.captions[cell] : fmt::format("{:.2f} s", seconds));
    out += "</g>\n";
  }
  if (!options.note.empty()) text(2 * kMargin, height - 10, 12, "start", options.note);
  out += "</svg>\n";
  return out;
}

}  // namespace signweave
