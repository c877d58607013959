#include "signweave/drawing/contact_sheet.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <iterator>
#include <map>
#include <numbers>
#include <optional>
#include <string_view>

#include "signweave/core/error.h"
#include "signweave/core/text.h"
#include "signweave/drawing/figure.h"
#include "signweave/drawing/signing_space.h"
#include "signweave/drawing/svg_text.h"
#include "signweave/motion/blend.h"
#include "signweave/motion/kinematics.h"
#include "signweave/rig/rig_map.h"
#include "signweave/rig/signer_space.h"

namespace signweave {
namespace {

using Eigen::Vector3f;

constexpr double kCellWidth = 190;   // pixels, including the margins
constexpr double kCellHeight = 214;  // including the caption
constexpr double kCaption = 26;
constexpr double kMargin = 8;
constexpr double kCaptionSize = 11;  // pixels, as are the next two
constexpr double kTitleSize = 16;
constexpr double kNoteSize = 12;
constexpr float kBeyond = 0.2f;  // shoulder widths: above the head and below the waist
constexpr std::string_view kArrow = " → ";

/// One line of text, no wider than `room` pixels: of size `size`, or smaller if that is too wide.
struct Line {
  double x = 0, y = 0, size = 0, room = 0;
  std::string_view anchor;
};

void put_text(const Line& line, std::string_view what, std::string& out) {
  constexpr double kLeast = 5;  // pixels; smaller text is illegible
  const double wide = svg_ems(what);
  const double fits = wide > 0 ? std::floor(10 * line.room / wide) / 10 : line.size;
  const double size = std::clamp(fits, kLeast, line.size);
  const std::string squeezed =
      fits < kLeast ? fmt::format(" textLength=\"{:.1f}\" lengthAdjust=\"spacingAndGlyphs\"", line.room) : "";
  fmt::format_to(std::back_inserter(out),
                 "<text x=\"{:.1f}\" y=\"{:.1f}\" font-size=\"{}\"{} text-anchor=\"{}\" fill=\"#202226\">{}</text>\n",
                 line.x, line.y, size, squeezed, line.anchor, svg_text(what));
}

void put_caption(std::string_view caption, std::string& out) {
  Line line{.x = kCellWidth / 2,
            .y = kCellHeight - 10,
            .size = kCaptionSize,
            .room = kCellWidth - 2 * kMargin,
            .anchor = "middle"};
  const std::size_t arrow = caption.find(kArrow);
  if (arrow == std::string_view::npos || svg_ems(caption) * kCaptionSize <= line.room) {
    put_text(line, caption, out);
    return;
  }
  line.y = kCellHeight - 19;
  put_text(line, caption.substr(0, arrow + kArrow.size() - 1), out);
  line.y = kCellHeight - 7;
  put_text(line, caption.substr(arrow + kArrow.size()), out);
}

/// The extent of one figure, in metres.
struct Extent {
  double half_width = 0.1;
  double low = 0, top = 0;
  double far = 0, near = 0;
};

Extent extent_of(const std::vector<Vector3f>& points) {
  Extent extent;
  bool first = true;
  for (const Vector3f& point : points) {
    const Eigen::Vector3d at = point.cast<double>();
    extent.half_width = std::max(extent.half_width, std::abs(at.x()));
    extent.low = first ? at.y() : std::min(extent.low, at.y());
    extent.top = first ? at.y() : std::max(extent.top, at.y());
    extent.near = first ? at.z() : std::max(extent.near, at.z());
    extent.far = first ? at.z() : std::min(extent.far, at.z());
    first = false;
  }
  return extent;
}

FigureView view_of(const Extent& extent) {
  FigureView view{.left = kCellWidth / 2, .bottom = kCellHeight - kCaption - kMargin, .low = extent.low};
  view.near = extent.near;
  view.far = extent.far;
  view.scale = std::min((kCellWidth / 2 - kMargin) / extent.half_width,
                        (kCellHeight - kCaption - 2 * kMargin) / std::max(extent.top - extent.low, 1e-6));
  return view;
}

/// One extent for all cells. At each end a twentieth of the figures, at least one if there are five or more, is ignored
/// if it reaches much farther than the rest: a rest pose among them must not make the others small.
Extent common_extent(const std::vector<Extent>& figures) {
  constexpr double kMuch = 1.25;
  const std::size_t left_out = std::max<std::size_t>((figures.size() + 10) / 20, figures.size() < 5 ? 0 : 1);
  const auto sorted = [&](double Extent::*what) {
    std::vector<double> values;
    for (const Extent& figure : figures) values.push_back(figure.*what);
    std::sort(values.begin(), values.end());
    return values;
  };
  const std::vector<double> widths = sorted(&Extent::half_width);
  const std::vector<double> lows = sorted(&Extent::low);
  const std::vector<double> tops = sorted(&Extent::top);
  const std::size_t last = figures.size() - 1 - left_out;
  Extent common{.half_width = widths[last],
                .low = lows[left_out],
                .top = tops[last],
                .far = sorted(&Extent::far).front(),
                .near = sorted(&Extent::near).back()};
  if (widths.back() < kMuch * common.half_width) common.half_width = widths.back();
  if (tops.back() - lows.front() < kMuch * (common.top - common.low)) {
    common.low = lows.front();
    common.top = tops.back();
  }
  return common;
}

/// The common view, or a smaller one for a figure that would leave its cell.
FigureView view_of(const Extent& figure, const Extent& common) {
  Extent both = common;
  both.half_width = std::max(both.half_width, figure.half_width);
  both.low = std::min(both.low, figure.low);
  both.top = std::max(both.top, figure.top);
  return view_of(both);
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

struct Cell {
  std::int64_t frame = 0;
  std::size_t given = 0;  ///< index into the requested frames
};

/// At most `most` of `all`: the most important ones, spread evenly if not all of equal importance fit.
std::vector<Cell> thinned(const std::vector<Cell>& all, std::size_t most, const std::vector<int>& importance) {
  if (most == 0 || all.size() <= most) return all;
  const auto importance_of = [&](const Cell& cell) {
    return cell.given < importance.size() ? importance[cell.given] : 0;
  };
  std::map<int, std::vector<Cell>, std::greater<>> ranks;
  for (const Cell& cell : all) ranks[importance_of(cell)].push_back(cell);
  std::vector<Cell> kept;
  for (const auto& [rank, cells] : ranks) {
    const std::size_t room = std::min(most - kept.size(), cells.size());
    for (std::size_t i = 0; i < room; ++i) {
      kept.push_back(cells[room == 1 ? 0 : i * (cells.size() - 1) / (room - 1)]);
    }
  }
  std::sort(kept.begin(), kept.end(), [](const Cell& a, const Cell& b) { return a.given < b.given; });
  return kept;
}

/// Looks down on a figure that faces the viewer, who then sees its front at the bottom.
void look_from_above(ModelPose& pose, SignerSpace& space) {
  const Eigen::Quaternionf tilt(Eigen::AngleAxisf(std::numbers::pi_v<float> / 2, Vector3f::UnitX()));
  for (Vector3f& position : pose.positions) position = tilt * position;
  for (Eigen::Quaternionf& rotation : pose.rotations) rotation = tilt * rotation;
  space.origin = tilt * space.origin;
  space.model_from_signer = tilt * space.model_from_signer;
}

/// An ellipse about a point, turned so that its width is along `across`.
void put_ellipse(const FigureView& view, const Vector3f& middle, const Vector3f& across, float wide, float deep,
                 const char* fill, std::string& out) {
  const double turn =
      -std::atan2(static_cast<double>(across.y()), static_cast<double>(across.x())) * 180 / std::numbers::pi;
  fmt::format_to(std::back_inserter(out),
                 "<ellipse cx=\"{0:.1f}\" cy=\"{1:.1f}\" rx=\"{2:.1f}\" ry=\"{3:.1f}\" fill=\"{4}\" "
                 "stroke=\"#6b6a72\" transform=\"rotate({5:.1f} {0:.1f} {1:.1f})\"/>\n",
                 view.x(middle), view.y(middle), view.scale * static_cast<double>(wide),
                 view.scale * static_cast<double>(deep), fill, turn);
}

/// The trunk below a figure that is seen from above, about the middle of its shoulders.
void draw_trunk_from_above(const SignerSpace& space, const FigureView& view, std::string& out) {
  put_ellipse(view, space.origin, space.model_from_signer * Vector3f::UnitX(), 0.6f * space.unit, 0.26f * space.unit,
              "#cdd2db", out);
}

/// The head on top of a figure that is seen from above: hair, with the nose before it.
void draw_head_from_above(const FigurePlan& plan, const ModelPose& pose, float unit, const FigureView& view,
                          std::string& out) {
  if (!plan.head) return;
  const auto joint = static_cast<std::size_t>(plan.head->joint);
  const Vector3f left = pose.rotations[joint] * plan.head->left;
  const Vector3f ahead = Vector3f(left.y(), -left.x(), 0).normalized();
  const Vector3f middle = pose.positions[joint] + 0.06f * unit * ahead;
  put_ellipse(view, middle + 0.3f * unit * ahead, left, 0.05f * unit, 0.06f * unit, "#e2c4ac", out);
  put_ellipse(view, middle, left, 0.26f * unit, 0.3f * unit, "#5e493a", out);
}

/// Gives a figure room for the loci that are within reach.
void include_loci(const std::vector<MarkedLocus>& loci, const SignerSpace& space, Extent& figure) {
  for (const MarkedLocus& locus : loci) {
    if (!(locus.at.norm() <= kFarthestDrawn)) continue;
    const Eigen::Vector3d at = space.to_model(locus.at).cast<double>();
    figure.half_width = std::max(figure.half_width, std::abs(at.x()));
    figure.low = std::min(figure.low, at.y());
    figure.top = std::max(figure.top, at.y());
  }
}

/// The signer whose heights, zones or loci are to be drawn.
struct Signer {
  RigMap rig;
  SignerBody body;
};

std::optional<Signer> signer_of(const Motion& motion, const RigMap& rig, bool wanted) {
  if (!wanted) return std::nullopt;
  const std::optional<SignerBody> body = signer_body(motion, rig);
  if (body) return Signer{rig, *body};
  const std::string why = why_no_signer_space(rig);
  throw Error(ErrorCode::not_found, fmt::format("contact sheet: no signing space to draw: {}",
                                                why.empty() ? "the shoulders are in one place" : why));
}

}  // namespace

std::string contact_sheet(const Motion& motion, const ContactSheetOptions& options) {
  std::vector<Cell> all;
  for (const std::int64_t frame : frames_to_show(motion, options)) all.push_back({frame, all.size()});
  const std::vector<Cell> shown = thinned(all, options.frames.empty() ? 0 : options.most_cells, options.importance);
  std::string note = options.note;
  if (shown.size() < all.size()) {
    note += fmt::format("{}{} of {} frames shown", note.empty() ? "" : "; ", shown.size(), all.size());
  }
  const Skeleton& skeleton = motion.skeleton();
  const RigMap rig = options.rig ? *options.rig : map_rig(motion);
  const bool has_space = options.signing_space || options.from_above || !options.loci.empty();
  const std::optional<Signer> signer = signer_of(motion, rig, has_space);
  const bool zones = options.signing_space && !options.from_above;

  std::vector<ModelPose> poses;
  std::vector<SignerSpace> spaces;  // [cell]; unused without a signer
  std::vector<Extent> figures;
  const FigurePlan plan = figure_plan(motion, rig);
  for (const auto& [frame, given] : shown) {
    // Seen from the direction that the signer faces, wherever the signer is on the floor.
    Pose pose(motion.pose(frame));
    apply(align(standing_over(motion, {frame, frame + 1}), Standing{}), motion.skeleton(), pose.view());
    poses.push_back(to_model_space(skeleton, pose.view()));
    if (options.turn != 0) turn_about_vertical(options.turn, poses.back());
    spaces.push_back(signer ? signer_space(signer->body, signer->rig, poses.back()) : SignerSpace());
    const SignerSpace& space = spaces.back();
    if (options.from_above) look_from_above(poses.back(), spaces.back());
    figures.push_back(extent_of(figure_points(skeleton, plan, poses.back())));
    include_loci(options.loci, space, figures.back());
    if (zones) {  // room for the names of the highest and the lowest zone
      const auto height = [&](float y) { return static_cast<double>(space.to_model({0, y, 0}).y()); };
      Extent& figure = figures.back();
      figure.top = std::max(figure.top, height(signer->body.heights.back() + kBeyond));
      figure.low = std::min(figure.low, height(signer->body.heights[1] - 2 * kBeyond));
    }
  }
  const Extent common = common_extent(figures);

  const std::size_t columns = std::min(options.columns, shown.size());
  const std::size_t rows = (shown.size() + columns - 1) / columns;
  const double header = options.title.empty() ? kMargin : 34;
  const double footer = note.empty() ? kMargin : 28;
  const double width = kCellWidth * static_cast<double>(columns) + 2 * kMargin;
  const double height = header + kCellHeight * static_cast<double>(rows) + footer;
  std::string out = fmt::format(
      "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
      "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0:.0f}\" height=\"{1:.0f}\" viewBox=\"0 0 {0:.0f} {1:.0f}\" "
      "font-family=\"sans-serif\" stroke-linecap=\"round\" stroke-linejoin=\"round\">\n<rect width=\"{0:.0f}\" "
      "height=\"{1:.0f}\" "
      "fill=\"#ffffff\"/>\n",
      width, height);
  const double room = width - 4 * kMargin;
  if (!options.title.empty()) put_text({2 * kMargin, 23, kTitleSize, room, "start"}, options.title, out);
  for (std::size_t cell = 0; cell < shown.size(); ++cell) {
    const double x = kMargin + kCellWidth * static_cast<double>(cell % columns);
    const std::size_t row = cell / columns;
    const double y = header + kCellHeight * static_cast<double>(row);
    fmt::format_to(std::back_inserter(out),
                   "<g transform=\"translate({:.1f} {:.1f})\">\n<rect x=\"2\" y=\"2\" width=\"{:.1f}\" "
                   "height=\"{:.1f}\" fill=\"#f6f7f9\" rx=\"4\"/>\n",
                   x, y, kCellWidth - 4, kCellHeight - 4);
    const FigureView view = view_of(figures[cell], common);
    if (zones) draw_signing_space(signer->body, spaces[cell], view, kCellWidth, kCellHeight - kCaption, out);
    if (options.from_above) draw_trunk_from_above(spaces[cell], view, out);
    draw_figure(skeleton, plan, poses[cell], figure_face(motion, shown[cell].frame), view, out);
    if (options.from_above) draw_head_from_above(plan, poses[cell], spaces[cell].unit, view, out);
    if (signer) draw_loci(options.loci, spaces[cell], view, kCellWidth, kCellHeight - kCaption, out);
    const double seconds = static_cast<double>(shown[cell].frame) * motion.rate().frame_time().count();
    const std::size_t given = shown[cell].given;
    put_caption(given < options.captions.size() ? options.captions[given] : fmt::format("{:.2f} s", seconds), out);
    out += "</g>\n";
  }
  if (!note.empty()) put_text({2 * kMargin, height - 10, kNoteSize, room, "start"}, note, out);
  out += "</svg>\n";
  return out;
}

}  // namespace signweave
