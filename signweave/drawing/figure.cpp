#include "signweave/drawing/figure.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <numbers>
#include <optional>
#include <string_view>

namespace signweave {
namespace {

using Eigen::Quaternionf;
using Eigen::Vector3f;

struct Colour {
  double red, green, blue;
};

constexpr Colour kTrunk = {186, 192, 204};
constexpr Colour kSkin = {226, 196, 172};
constexpr double kFarAway = 1e3;  // metres
constexpr const char* kInk = "#3a3034";
constexpr const char* kRim = "#6b6a72";

/// Darkens with `near`, from 0 (far: pale) to 1.
std::string shade(const Colour& colour, double near, double palest) {
  const double pale = palest * (1 - std::clamp(near, 0.0, 1.0));
  const auto mixed = [&](double value) { return static_cast<int>(std::lround(value + pale * (255 - value))); };
  return fmt::format("#{:02x}{:02x}{:02x}", mixed(colour.red), mixed(colour.green), mixed(colour.blue));
}

Colour colour_of(const FigurePart& part) {
  if (part.side == BodySide::right) return part.finger ? Colour{20, 84, 200} : Colour{84, 120, 172};
  if (part.side == BodySide::left) return part.finger ? Colour{222, 96, 8} : Colour{196, 140, 84};
  return part.arm || part.finger ? Colour{70, 74, 82} : kTrunk;
}

/// The rim colour of a part.
Colour rim_of(const FigurePart& part) {
  const Colour colour = colour_of(part);
  return {0.46 * colour.red, 0.46 * colour.green, 0.46 * colour.blue};
}

struct Bone {
  Vector3f from, to;
  std::size_t joint;  ///< the joint it belongs to
  std::size_t chain;  ///< shared by the bones of one finger
  bool skull = false;
};

std::vector<Bone> bones_of(const Skeleton& skeleton, const FigurePlan& plan, const ModelPose& pose) {
  const std::vector<FigurePart>& parts = plan.parts;
  std::vector<Bone> bones;
  std::vector<std::size_t> chain(skeleton.joint_count());
  for (std::size_t i = 0; i < skeleton.joint_count(); ++i) {
    chain[i] = i;
    if (skeleton.joints()[i].parent == kNoJoint) continue;
    const auto parent = static_cast<std::size_t>(skeleton.joints()[i].parent);
    if (parts[i].finger && parts[parent].finger) chain[i] = chain[parent];
    if (!parts[i].shown || parts[i].in_head || skeleton.joints()[i].offset.isZero()) continue;
    bones.push_back({pose.positions[parent], pose.positions[i], i, chain[i], parts[parent].head && parts[i].head});
  }
  for (const Tip& tip : skeleton.tips()) {
    const auto joint = static_cast<std::size_t>(tip.joint);
    if (!parts[joint].shown || parts[joint].in_head) continue;
    const Vector3f& from = pose.positions[joint];
    Vector3f to = position_of(tip, pose);
    if (plan.head && plan.head->up && plan.head->joint == tip.joint) {
      to = from + (to - from).norm() * (pose.rotations[joint] * *plan.head->up);
    }
    bones.push_back({from, to, joint, chain[joint], parts[joint].head});
  }
  return bones;
}

/// Writes the elements of one figure.
class FigureDrawing {
 public:
  FigureDrawing(const FigureView& view, std::string& out) : view_(view), out_(out) {}

  double near(double z) const { return (z - view_.far) / std::max(view_.near - view_.far, 1e-6); }
  double pixels(double metres, double least) const { return std::max(least, metres * view_.scale); }

  std::string at(const Vector3f& point) const { return fmt::format("{:.1f} {:.1f}", view_.x(point), view_.y(point)); }

  void line(const Bone& bone, const std::string& colour, double width) {
    put("<line x1=\"{:.1f}\" y1=\"{:.1f}\" x2=\"{:.1f}\" y2=\"{:.1f}\" stroke=\"{}\" stroke-width=\"{:.1f}\"/>\n",
        view_.x(bone.from), view_.y(bone.from), view_.x(bone.to), view_.y(bone.to), colour, width);
  }
  void stroke(const std::string& path, std::string_view colour, double width) {
    put("<path d=\"{}\" fill=\"none\" stroke=\"{}\" stroke-width=\"{:.1f}\"/>\n", path, colour, width);
  }
  void area(const std::string& path, std::string_view colour, std::string_view edge, double width) {
    put("<path d=\"{}\" fill=\"{}\" stroke=\"{}\" stroke-width=\"{:.1f}\"/>\n", path, colour, edge, width);
  }
  void fill(const std::string& path, std::string_view colour) { put("<path d=\"{}\" fill=\"{}\"/>\n", path, colour); }
  void circle(const Vector3f& point, double radius, std::string_view colour) {
    put("<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"{:.1f}\" fill=\"{}\"/>\n", view_.x(point), view_.y(point), radius,
        colour);
  }
  void ellipse(const Vector3f& middle, const Vector3f& up, double across, double along, const std::string& colour,
               const std::string& edge) {
    const double lean = std::atan2(static_cast<double>(up.x()), static_cast<double>(up.y())) * 57.29578;
    put("<ellipse cx=\"{0:.1f}\" cy=\"{1:.1f}\" rx=\"{2:.1f}\" ry=\"{3:.1f}\" fill=\"{4}\" stroke=\"{5}\" "
        "stroke-width=\"1\" transform=\"rotate({6:.1f} {0:.1f} {1:.1f})\"/>\n",
        view_.x(middle), view_.y(middle), across, along, colour, edge, lean);
  }

 private:
  template <typename... Values>
  void put(fmt::format_string<Values...> text, Values&&... values) {
    fmt::format_to(std::back_inserter(out_), text, std::forward<Values>(values)...);
  }

  const FigureView& view_;
  std::string& out_;
};

/// The face's coordinate system, from two eyes and the line from the head's joint to its top.
struct FaceSpace {
  Vector3f middle;             ///< between the eyes
  Vector3f left, up, forward;  ///< unit
  float size = 1;              ///< relative to a head that reaches 0.19 m above its joint
  Vector3f point(float x, float y, float z) const { return middle + size * (x * left + y * up + z * forward); }
};

struct Eyes {
  std::optional<std::size_t> left, right;
};

Eyes eyes_of(const std::vector<FigurePart>& parts) {
  Eyes eyes;
  for (std::size_t i = 0; i < parts.size(); ++i) {
    if (!parts[i].eye || !parts[i].shown) continue;
    if (parts[i].side == BodySide::left) eyes.left = i;
    if (parts[i].side == BodySide::right) eyes.right = i;
  }
  return eyes;
}

/// Draws brows, eyes, nose and mouth, as far as they face the viewer.
void draw_face(const FaceSpace& head, const std::array<Vector3f, 2>& gaze, const FigureFace& face,
               FigureDrawing& drawing) {
  if (head.forward.z() < 0.05f) return;  // seen from behind
  const auto shows = [&](float x) { return (head.forward + 0.9f * (x / 0.05f) * head.left).z() > 0.12f; };
  constexpr float kSides[] = {1, -1};
  for (std::size_t i = 0; i < 2; ++i) {
    const float s = kSides[i];
    if (!shows(0.032f * s)) continue;
    const float open = 0.0105f * (1 - face.blink[i]) * (1 + 0.4f * face.wide[i]) * (1 - 0.4f * face.squint[i]);
    const Vector3f inner = head.point(0.017f * s, -0.001f, 0.008f);
    const Vector3f outer = head.point(0.047f * s, 0.001f, -0.002f);
    const Vector3f above = head.point(0.032f * s, 1.5f * open, 0.010f);
    const Vector3f below = head.point(0.032f * s, -1.1f * open - 0.0015f, 0.010f);
    if (open > 0.003f) {
      drawing.fill(fmt::format("M{}Q{} {}Q{} {}Z", drawing.at(inner), drawing.at(above), drawing.at(outer),
                               drawing.at(below), drawing.at(inner)),
                   "#fff");
      const Vector3f pupil = head.point(0.032f * s, 0.0f, 0.006f) + 0.024f * head.size * gaze[i];
      drawing.circle(pupil, drawing.pixels(0.0062 * static_cast<double>(head.size), 0.6), kInk);
    }
    drawing.stroke(
        fmt::format("M{}Q{} {}", drawing.at(inner), drawing.at(open > 0.003f ? above : below), drawing.at(outer)), kInk,
        drawing.pixels(0.003, 0.6));
    const float lift = 0.024f + 0.013f * face.brow_up[i] - 0.009f * face.brow_down[i];
    const float inner_lift = 0.023f + 0.013f * face.brow_inner_up - 0.012f * face.brow_down[i];
    drawing.stroke(
        fmt::format("M{}Q{} {}", drawing.at(head.point((0.014f - 0.003f * face.brow_down[i]) * s, inner_lift, 0.012f)),
                    drawing.at(head.point(0.034f * s, lift + 0.006f, 0.010f)),
                    drawing.at(head.point(0.053f * s, lift - 0.005f, -0.006f))),
        kInk, drawing.pixels(0.0065, 1.0));
  }
  drawing.stroke(
      fmt::format("M{}L{}L{}", drawing.at(head.point(0.002f, -0.006f, 0.018f)),
                  drawing.at(head.point(0.009f, -0.037f, 0.032f)), drawing.at(head.point(-0.004f, -0.041f, 0.022f))),
      "#a9826c", drawing.pixels(0.004, 0.7));
  for (const float s : kSides) {
    if (face.puff > 0.2f && shows(0.045f * s)) {
      drawing.stroke(fmt::format("M{}Q{} {}", drawing.at(head.point(0.040f * s, -0.038f, 0.01f)),
                                 drawing.at(head.point((0.040f + 0.030f * face.puff) * s, -0.060f, 0.0f)),
                                 drawing.at(head.point(0.038f * s, -0.082f, 0.005f))),
                     "#b98f78", drawing.pixels(0.004, 0.8));
    }
  }
  // The mouth: two lips between its corners.
  const float round = 1 - 0.55f * face.pucker - 0.40f * face.funnel;
  const float drop = 0.010f * face.jaw;
  const auto corner = [&](std::size_t i) {
    const float width = 0.025f * round * (1 + 0.30f * face.smile[i] + 0.35f * face.stretch[i]);
    return head.point(kSides[i] * width, -0.068f - drop + 0.010f * face.smile[i], 0.008f);
  };
  const float open = (0.034f * face.jaw * (1 - face.close) + 0.010f * face.funnel + 0.002f) * (1 - 0.8f * face.press);
  const float lips = (0.005f + 0.006f * face.pucker + 0.005f * face.funnel) * (1 - 0.7f * face.press);
  const auto lip = [&](float y) { return head.point(0, -0.068f - 0.2f * drop + y, 0.016f + 0.010f * face.pucker); };
  const Vector3f left = corner(0);
  const Vector3f right = corner(1);
  drawing.fill(fmt::format("M{}Q{} {}Q{} {}Z", drawing.at(left), drawing.at(lip(0.8f * open + 2 * lips)),
                           drawing.at(right), drawing.at(lip(-1.7f * open - 2 * lips)), drawing.at(left)),
               "#b0564f");
  drawing.fill(fmt::format("M{}Q{} {}Q{} {}Z", drawing.at(left), drawing.at(lip(0.8f * open)), drawing.at(right),
                           drawing.at(lip(-1.7f * open)), drawing.at(left)),
               "#4a1c22");
}

/// Draws the trunk from the shoulders to the hips.
void draw_trunk(const Vector3f& left, const Vector3f& right, const Vector3f& root, FigureDrawing& drawing) {
  const Vector3f across = 0.5f * (left - right);
  const Vector3f middle = 0.5f * (left + right);
  const auto at = [&](float x, float y) { return drawing.at(Vector3f(root + y * (middle - root) + x * across)); };
  const std::string path =
      fmt::format("M{}Q{} {}Q{} {}Q{} {}Q{} {}Q{} {}L{}Q{} {}Q{} {}Z", at(0.98f, 0.96f), at(0.84f, 1.07f),
                  at(0.34f, 1.11f), at(0.0f, 1.0f), at(-0.34f, 1.11f), at(-0.84f, 1.07f), at(-0.98f, 0.96f),
                  at(-0.72f, 0.62f), at(-0.64f, 0.38f), at(-0.66f, 0.2f), at(-0.75f, -0.02f), at(0.75f, -0.02f),
                  at(0.66f, 0.2f), at(0.64f, 0.38f), at(0.72f, 0.62f), at(0.98f, 0.96f));
  const std::string colour = shade(kTrunk, drawing.near(static_cast<double>(middle.z())), 0.30);
  // The depth of a trunk is about half the width of its shoulders; from the front only its rim shows that.
  const double depth = 0.95 * static_cast<double>(std::abs(across.z()));
  const double rim = drawing.pixels(0.004, 0.7);
  drawing.area(path, colour, kRim, drawing.pixels(depth, 0.0) + 2 * rim);
  drawing.area(path, colour, colour, drawing.pixels(depth, 0.0) + 0.1);
}

/// Draws skull, hair and face.
void draw_head(const Bone& skull, const ModelPose& pose, const Eyes& eyes, const std::optional<FigureHead>& shape,
               const std::array<Vector3f, 2>& gaze, const FigureFace& face, double near, double scale,
               FigureDrawing& drawing) {
  const Vector3f up = skull.to - skull.from;
  const float height = up.norm();
  const Vector3f middle = skull.from + 0.42f * up;
  const float along = 0.58f * height;
  const float across = 0.74f * along * (1 + 0.06f * face.puff);
  const std::string skin = shade(kSkin, near, 0.25);
  const auto pixels = [&](float metres) { return scale * static_cast<double>(metres); };
  const bool no_eyes = !eyes.left || !eyes.right;
  if (no_eyes && !(face.known && shape)) {
    drawing.ellipse(middle, up, pixels(across), pixels(along), skin, kRim);
    return;
  }
  FaceSpace head;
  if (no_eyes) {
    head.left = pose.rotations[static_cast<std::size_t>(shape->joint)] * shape->left;
  } else {
    head.left = (pose.positions[*eyes.left] - pose.positions[*eyes.right]).normalized();
    head.middle = 0.5f * (pose.positions[*eyes.left] + pose.positions[*eyes.right]);
  }
  head.up = (up - up.dot(head.left) * head.left).normalized();
  head.forward = head.left.cross(head.up);
  head.size = height / 0.19f;
  const float deep = 0.88f * along;
  if (no_eyes) head.middle = middle + 0.08f * up + 0.8f * deep * head.forward;
  drawing.ellipse(middle + 0.035f * up, up, 1.04 * pixels(std::hypot(across * head.left.x(), deep * head.forward.x())),
                  pixels(along), "#5e493a", kRim);
  // The face is the part of the skull not covered by hair: a cap about an axis that points forward and down. Where the
  // cap's edge is behind, it is replaced by the skull's outline.
  const Vector3f axis = Vector3f(0, -0.50f, 0.866f);  // left, up, forward
  const Vector3f aside = Vector3f::UnitX();
  const Vector3f upwards = axis.cross(aside);
  const Vector3f viewer(head.left.z(), head.up.z(), head.forward.z());
  constexpr int kPoints = 20;
  constexpr float kCap = 1.22f;  // radians
  std::string path;
  for (int i = 0; i < kPoints; ++i) {
    const float turn = 2 * std::numbers::pi_v<float> * static_cast<float>(i) / kPoints;
    Vector3f on = std::cos(kCap) * axis + std::sin(kCap) * (std::cos(turn) * aside + std::sin(turn) * upwards);
    const float towards = on.dot(viewer);
    if (towards < 0) on = (on - towards * viewer).normalized();
    path += fmt::format(
        "{}{}", i == 0 ? "M" : "L",
        drawing.at(middle + across * on.x() * head.left + along * on.y() * head.up + deep * on.z() * head.forward));
  }
  path += 'Z';
  if (axis.dot(viewer) > -std::sin(kCap)) drawing.area(path, skin, kRim, drawing.pixels(0.003, 0.5));
  draw_face(head, no_eyes ? std::array<Vector3f, 2>{head.forward, head.forward} : gaze, face, drawing);
}

}  // namespace

std::vector<Vector3f> figure_points(const Skeleton& skeleton, const FigurePlan& plan, const ModelPose& pose) {
  std::vector<Vector3f> points;
  for (const Bone& bone : bones_of(skeleton, plan, pose)) {
    points.push_back(bone.from);
    points.push_back(bone.to);
  }
  return points;
}

void draw_figure(const Skeleton& skeleton, const FigurePlan& plan, const ModelPose& pose, const FigureFace& face,
                 const FigureView& view, std::string& out) {
  FigureDrawing drawing(view, out);
  const std::vector<FigurePart>& parts = plan.parts;
  const std::vector<Bone> bones = bones_of(skeleton, plan, pose);

  // The trunk lies between the shoulders; everything that is not in front of it is behind it.
  std::optional<Vector3f> left, right;
  for (std::size_t i = 0; i < parts.size(); ++i) {
    // The first joint that is the parent of an arm's bone.
    if (!parts[i].arm || parts[i].side == BodySide::none) continue;
    const Vector3f& shoulder = pose.positions[static_cast<std::size_t>(skeleton.joints()[i].parent)];
    std::optional<Vector3f>& found = parts[i].side == BodySide::left ? left : right;
    if (!found) found = shoulder;
  }
  // A unit of drawing, sorted by depth, the farthest first: a finger, a palm, or one bone of the rest.
  struct Item {
    std::vector<const Bone*> bones;
    double depth = 0;
  };
  std::vector<Item> items;
  std::vector<std::optional<std::size_t>> finger_item(skeleton.joint_count());
  std::vector<std::optional<std::size_t>> palm_item(skeleton.joint_count());
  for (const Bone& bone : bones) {
    const FigurePart& part = parts[bone.joint];
    const bool tip_of_palm = part.palm && bone.from == pose.positions[bone.joint];  // from the first joint onwards
    std::optional<std::size_t>* group = nullptr;
    if (part.palm && !tip_of_palm) {
      group = &palm_item[static_cast<std::size_t>(skeleton.joints()[bone.joint].parent)];
    } else if (part.finger) {
      group = &finger_item[bone.chain];
    }
    if (group == nullptr || !*group) {
      if (group != nullptr) *group = items.size();
      items.push_back({});
    }
    items[group == nullptr ? items.size() - 1 : **group].bones.push_back(&bone);
  }
  for (Item& item : items) {
    for (const Bone* bone : item.bones) item.depth += 0.5 * static_cast<double>(bone->from.z() + bone->to.z());
    item.depth /= static_cast<double>(item.bones.size());
    const FigurePart& part = parts[item.bones.front()->joint];
    if (left && !part.arm && !part.finger && !item.bones.front()->skull) item.depth = -kFarAway;  // inside the trunk
  }
  std::vector<const Item*> order;
  for (const Item& item : items) order.push_back(&item);
  std::stable_sort(order.begin(), order.end(), [](const Item* a, const Item* b) { return a->depth < b->depth; });

  const Eyes eyes = eyes_of(parts);
  bool trunk_drawn = !left || !right;
  for (const Item* item : order) {
    const FigurePart& part = parts[item->bones.front()->joint];
    const double near = drawing.near(item->depth);
    const bool before_trunk = part.arm || part.finger;
    if (!trunk_drawn && (before_trunk ? item->depth > static_cast<double>(0.5f * (left->z() + right->z())) - 0.02
                                      : item->bones.front()->skull)) {
      draw_trunk(*left, *right, pose.positions[plan.hips], drawing);
      trunk_drawn = true;
    }
    if (item->bones.front()->skull) {
      const auto gaze = [&](std::optional<std::size_t> eye) {
        for (const Tip& tip : skeleton.tips()) {
          if (eye && static_cast<std::size_t>(tip.joint) == *eye) {
            return Vector3f((position_of(tip, pose) - pose.positions[*eye]).normalized());
          }
        }
        return Vector3f(Vector3f::UnitZ());
      };
      draw_head(*item->bones.front(), pose, eyes, plan.head, {gaze(eyes.left), gaze(eyes.right)}, face, near,
                view.scale, drawing);
      continue;
    }
    if (part.finger) {
      const bool palm = part.palm && item->bones.front()->from != pose.positions[item->bones.front()->joint];
      const double width = drawing.pixels(palm ? 0.021 : 0.0165, palm ? 2.2 : 1.2);
      const std::string colour = shade(colour_of(part), near, 0.35);
      // A dark rim separates overlapping parts.
      std::string path = fmt::format("M{}", drawing.at(item->bones.front()->from));
      for (const Bone* bone : item->bones) path += fmt::format("L{}", drawing.at(bone->to));
      if (palm) path += 'Z';
      drawing.area(path, palm ? colour : "none", shade(rim_of(part), near, 0.25), width + drawing.pixels(0.005, 0.8));
      for (const Bone* bone : item->bones) drawing.line(*bone, colour, width);
      continue;
    }
    const Bone& bone = *item->bones.front();
    const bool neck = !part.arm && (!left || bone.to.y() > left->y() + 0.02f);
    // Bones inside the trunk would add nothing to the picture.
    const Colour colour = part.side != BodySide::none || !neck || !left ? colour_of(part) : kSkin;
    double width = neck ? drawing.pixels(0.085, 2.0) : left ? 1.0 : drawing.pixels(0.055, 2.0);
    if (part.arm) {
      const auto parent = static_cast<std::size_t>(skeleton.joints()[bone.joint].parent);
      width = drawing.pixels(parts[parent].arm ? 0.052 : 0.070, 2.6);
    }
    if (part.arm) {
      drawing.stroke(fmt::format("M{}L{}", drawing.at(bone.from), drawing.at(bone.to)), shade(rim_of(part), near, 0.3),
                     width + drawing.pixels(0.008, 1.0));
    }
    drawing.line(bone, shade(colour, near, part.side != BodySide::none ? 0.40 : 0.30), width);
  }
}

}  // namespace signweave
