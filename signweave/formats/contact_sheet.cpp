#include "signweave/formats/contact_sheet.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <string_view>

#include "signweave/core/error.h"
#include "signweave/core/text.h"
#include "signweave/motion/blend.h"
#include "signweave/motion/kinematics.h"

namespace signweave {
namespace {

using Eigen::Vector3f;

constexpr double kCellWidth = 190;   // pixels, with the margins
constexpr double kCellHeight = 214;  // with the caption
constexpr double kCaption = 26;
constexpr double kMargin = 8;

enum class BodySide { none, left, right };

/// How a joint is drawn.
struct Part {
  BodySide side = BodySide::none;
  bool finger = false;  ///< beyond the wrist
  bool shown = true;    ///< part of the upper body
  bool head = false;
  bool in_head = false;  ///< eyes, jaw: not drawn as bones
  bool eye = false;
};

struct Bone {
  Vector3f from, to;  ///< metres, facing the viewer
  const Part* part;
  bool skull = false;  ///< from the head joint to its top
};

bool contains(std::string_view text, std::string_view what) {
  return text.find(what) != std::string_view::npos;
}

BodySide side_of(std::string_view name, std::string_view folded) {
  if (contains(folded, "left")) return BodySide::left;
  if (contains(folded, "right")) return BodySide::right;
  // lHand, LHand, l_hand; hand_l, hand.L
  const auto apart = [](char c) { return c == '_' || c == '.' || c == '-' || c == ' '; };
  if (name.size() > 1) {
    const bool begins = apart(name[1]) || (name[1] >= 'A' && name[1] <= 'Z');
    const bool ends = apart(folded[folded.size() - 2]);
    if ((begins && folded.front() == 'l') || (ends && folded.back() == 'l')) return BodySide::left;
    if ((begins && folded.front() == 'r') || (ends && folded.back() == 'r')) return BodySide::right;
  }
  return BodySide::none;
}

std::vector<Part> parts_of(const Skeleton& skeleton, const ModelPose& pose) {
  const std::size_t count = skeleton.joint_count();
  std::vector<Part> parts(count);
  std::vector<float> highest(count);
  float top = pose.positions[0].y();
  float bottom = top;
  for (std::size_t i = 0; i < count; ++i) {
    highest[i] = pose.positions[i].y();
    top = std::max(top, highest[i]);
    bottom = std::min(bottom, highest[i]);
  }
  for (std::size_t i = count; i-- > 1;) {
    float& parent = highest[static_cast<std::size_t>(skeleton.joints()[i].parent)];
    parent = std::max(parent, highest[i]);
  }
  std::vector<bool> arm(count);  // arms stay even where they hang below the hips
  for (std::size_t i = 0; i < count; ++i) {
    const Joint& joint = skeleton.joints()[i];
    const std::string folded = fold_case(joint.name);
    Part& part = parts[i];
    part.side = side_of(joint.name, folded);
    part.head = contains(folded, "head");
    part.eye = contains(folded, "eye") && !contains(folded, "eyebrow") && !contains(folded, "lid");
    if (joint.parent == kNoJoint) continue;
    const auto parent = static_cast<std::size_t>(joint.parent);
    const std::string above = fold_case(skeleton.joints()[parent].name);
    part.finger = parts[parent].finger || contains(above, "hand") || contains(above, "wrist");
    part.in_head = parts[parent].in_head || (parts[parent].head && !part.head);
    arm[i] = arm[parent] || contains(folded, "arm") || contains(folded, "shoulder") || contains(folded, "hand");
    const bool leg = joint.parent == 0 && highest[i] < pose.positions[0].y() + 0.03f * (top - bottom);
    part.shown = parts[parent].shown && (!leg || arm[i]);
    if (part.side == BodySide::none) part.side = parts[parent].side;
  }
  return parts;
}

/// One figure, turned to face the viewer and standing at the origin.
std::vector<Bone> bones_of(const Skeleton& skeleton, const std::vector<Part>& parts, const ModelPose& pose) {
  std::vector<Bone> bones;
  for (std::size_t i = 1; i < skeleton.joint_count(); ++i) {
    if (!parts[i].shown || parts[i].in_head) continue;
    const auto parent = static_cast<std::size_t>(skeleton.joints()[i].parent);
    bones.push_back({pose.positions[parent], pose.positions[i], &parts[i], parts[parent].head && parts[i].head});
  }
  for (const Tip& tip : skeleton.tips()) {
    const auto joint = static_cast<std::size_t>(tip.joint);
    if (!parts[joint].shown || parts[joint].in_head) continue;
    bones.push_back({pose.positions[joint], position_of(tip, pose), &parts[joint], parts[joint].head});
  }
  return bones;
}

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

struct Colour {
  double red, green, blue;
};

/// `near` from 0 (far: pale) to 1.
std::string shade(const Part& part, double near) {
  Colour colour{70, 74, 82};
  if (part.side == BodySide::right) colour = part.finger ? Colour{10, 70, 190} : Colour{60, 95, 150};
  if (part.side == BodySide::left) colour = part.finger ? Colour{215, 85, 0} : Colour{165, 110, 60};
  const double pale = 0.55 * (1 - std::clamp(near, 0.0, 1.0));
  const auto mixed = [&](double value) { return static_cast<int>(std::lround(value + pale * (255 - value))); };
  return fmt::format("#{:02x}{:02x}{:02x}", mixed(colour.red), mixed(colour.green), mixed(colour.blue));
}

/// One scale for all cells: metres to pixels inside a cell.
struct View {
  double half_width = 0.1;  ///< metres
  double bottom = 0, top = 0;
  double near = 0, far = 0;
  double scale = 1;

  double x(const Vector3f& at) const { return kCellWidth / 2 + scale * static_cast<double>(at.x()); }
  double y(const Vector3f& at) const {
    return kMargin + (kCellHeight - kCaption - 2 * kMargin) - scale * (static_cast<double>(at.y()) - bottom);
  }
};

View view_of(const std::vector<std::vector<Bone>>& figures) {
  View view;
  bool first = true;
  for (const auto& bones : figures) {
    for (const Bone& bone : bones) {
      for (const Vector3f& end : {bone.from, bone.to}) {
        const Eigen::Vector3d at = end.cast<double>();
        view.half_width = std::max(view.half_width, std::abs(at.x()));
        view.bottom = first ? at.y() : std::min(view.bottom, at.y());
        view.top = first ? at.y() : std::max(view.top, at.y());
        view.near = first ? at.z() : std::max(view.near, at.z());
        view.far = first ? at.z() : std::min(view.far, at.z());
        first = false;
      }
    }
  }
  view.scale = std::min((kCellWidth / 2 - kMargin) / view.half_width,
                        (kCellHeight - kCaption - 2 * kMargin) / std::max(view.top - view.bottom, 1e-6));
  return view;
}

void draw(const std::vector<Bone>& bones, const View& view, std::string& out) {
  std::vector<const Bone*> order;
  for (const Bone& bone : bones) order.push_back(&bone);
  std::stable_sort(order.begin(), order.end(),
                   [](const Bone* a, const Bone* b) { return a->from.z() + a->to.z() < b->from.z() + b->to.z(); });
  for (const Bone* bone : order) {
    const double depth = 0.5 * static_cast<double>(bone->from.z() + bone->to.z());
    const double near = (depth - view.far) / std::max(view.near - view.far, 1e-6);
    if (bone->skull) {
      const Vector3f middle = 0.5f * (bone->from + bone->to);
      const double radius = 0.5 * view.scale * static_cast<double>((bone->to - bone->from).norm());
      fmt::format_to(std::back_inserter(out),
                     "<ellipse cx=\"{:.1f}\" cy=\"{:.1f}\" rx=\"{:.1f}\" ry=\"{:.1f}\" fill=\"#ffffff\" "
                     "fill-opacity=\"0.6\" stroke=\"{}\" stroke-width=\"1.6\"/>\n",
                     view.x(middle), view.y(middle), 0.78 * radius, radius, shade(*bone->part, near));
      continue;
    }
    fmt::format_to(std::back_inserter(out),
                   "<line x1=\"{:.1f}\" y1=\"{:.1f}\" x2=\"{:.1f}\" y2=\"{:.1f}\" stroke=\"{}\" "
                   "stroke-width=\"{}\"/>\n",
                   view.x(bone->from), view.y(bone->from), view.x(bone->to), view.y(bone->to), shade(*bone->part, near),
                   bone->part->finger ? "1.1" : "2.6");
  }
}

void draw_eyes(const std::vector<Part>& parts, const ModelPose& pose, const View& view, std::string& out) {
  for (std::size_t i = 0; i < parts.size(); ++i) {
    if (!parts[i].eye || !parts[i].shown) continue;
    fmt::format_to(std::back_inserter(out), "<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"1.2\" fill=\"#50545c\"/>\n",
                   view.x(pose.positions[i]), view.y(pose.positions[i]));
  }
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
  std::vector<std::vector<Bone>> figures;
  std::vector<Part> parts;
  for (const std::int64_t frame : frames) {
    // Seen from where the signer faces, wherever that is on the floor.
    Pose pose(motion.pose(frame));
    apply(align(standing_over(motion, {frame, frame + 1}), Standing{}), pose.view());
    poses.push_back(to_model_space(skeleton, pose.view()));
    if (parts.empty()) parts = parts_of(skeleton, poses.front());
    figures.push_back(bones_of(skeleton, parts, poses.back()));
  }
  const View view = view_of(figures);

  const std::size_t columns = std::min(options.columns, frames.size());
  const std::size_t rows = (frames.size() + columns - 1) / columns;
  const double header = options.title.empty() ? kMargin : 34;
  const double footer = options.note.empty() ? kMargin : 28;
  const double width = kCellWidth * static_cast<double>(columns) + 2 * kMargin;
  const double height = header + kCellHeight * static_cast<double>(rows) + footer;
  std::string out = fmt::format(
      "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
      "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0:.0f}\" height=\"{1:.0f}\" viewBox=\"0 0 {0:.0f} {1:.0f}\" "
      "font-family=\"sans-serif\" stroke-linecap=\"round\">\n<rect width=\"{0:.0f}\" height=\"{1:.0f}\" "
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
    draw(figures[cell], view, out);
    draw_eyes(parts, poses[cell], view, out);
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
