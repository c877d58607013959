#include "signweave/drawing/face_mesh.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>

namespace signweave {
namespace {

using Eigen::Vector2f;
using Eigen::Vector3f;

enum class FacePart { brow, eye, mouth };

/// A vertex before it is placed on the head. Coordinates are in half heights of the head: x to the person's left, y up.
struct Point {
  FacePart part;
  float side = 0;  ///< 1 the person's left, −1 right, 0 the mouth
  Vector2f place;
  float along = 0;  ///< brow: 0 inner end … 1 outer; mouth: −1 right corner … 1 left
  float lower = 0;  ///< mouth: 0 upper lip … 1 lower lip
  float out = 0;    ///< distance in front of the head's surface
};

constexpr float kEyeX = 0.30f;
constexpr float kEyeY = 0.02f;
constexpr float kBrowY = 0.24f;
constexpr float kMouthY = -0.50f;

/// The effect of a target on a point, at weight 1.
struct Effect {
  const char* name;
  void (*move)(Point& point);
};

template <int kSide>
bool on_side(const Point& point) {
  return kSide == 0 || point.side * kSide > 0 || (point.part == FacePart::mouth && point.along * kSide > 0);
}

template <int kSide, FacePart kPart>
bool concerns(const Point& point) {
  return point.part == kPart && on_side<kSide>(point);
}

/// Eye: scales its height to kHeight percent.
template <int kSide, int kHeight>
void open_eye(Point& point) {
  if (!concerns<kSide, FacePart::eye>(point)) return;
  point.place.y() = kEyeY + (point.place.y() - kEyeY) * static_cast<float>(kHeight) / 100;
}
/// Brow: raises its inner and outer end by this many hundredths.
template <int kSide, int kInner, int kOuter>
void lift_brow(Point& point) {
  if (!concerns<kSide, FacePart::brow>(point)) return;
  point.place.y() += (kInner * (1 - point.along) + kOuter * point.along) / 100;
}
/// Moves a corner of the mouth out and up by this many hundredths; points nearer to the middle move less.
template <int kSide, int kOut, int kUp>
void pull_corner(Point& point) {
  if (!concerns<kSide, FacePart::mouth>(point)) return;
  const float share = std::abs(point.along);
  point.place.x() += (point.along > 0 ? 1.0f : -1.0f) * share * kOut / 100;
  point.place.y() += share * share * kUp / 100;
}
/// Scales the mouth to kWidth percent of its width, and moves its lips kApart hundredths further apart and kForward
/// further out.
template <int kWidth, int kApart, int kForward>
void round_mouth(Point& point) {
  if (point.part != FacePart::mouth) return;
  const float middle = std::sqrt(std::max(0.0f, 1 - point.along * point.along));
  point.place.x() *= static_cast<float>(kWidth) / 100;
  point.place.y() += middle * (0.5f - point.lower) * 2 * kApart / 100;
  point.out += static_cast<float>(kForward) / 100;
}
void open_jaw(Point& point) {
  if (point.part != FacePart::mouth) return;
  const float middle = std::sqrt(std::max(0.0f, 1 - point.along * point.along));
  point.place.y() -= point.lower * middle * 0.30f + 0.04f;
  point.place.x() *= 0.9f;
}
template <int kX>
void shift_mouth(Point& point) {
  if (point.part == FacePart::mouth) point.place.x() += kX / 100.0f;
}

constexpr Effect kEffects[] = {
    {"browInnerUp", lift_brow<0, 14, 2>},
    {"browDownLeft", lift_brow<1, -13, -5>},
    {"browDownRight", lift_brow<-1, -13, -5>},
    {"browOuterUpLeft", lift_brow<1, 2, 14>},
    {"browOuterUpRight", lift_brow<-1, 2, 14>},
    {"eyeBlinkLeft", open_eye<1, 8>},
    {"eyeBlinkRight", open_eye<-1, 8>},
    {"eyeSquintLeft", open_eye<1, 55>},
    {"eyeSquintRight", open_eye<-1, 55>},
    {"eyeWideLeft", open_eye<1, 145>},
    {"eyeWideRight", open_eye<-1, 145>},
    {"jawOpen", open_jaw},
    {"jawLeft", shift_mouth<8>},
    {"jawRight", shift_mouth<-8>},
    {"mouthPucker", round_mouth<45, 2, 8>},
    {"mouthFunnel", round_mouth<55, 9, 6>},
    {"mouthSmileLeft", pull_corner<1, 7, 14>},
    {"mouthSmileRight", pull_corner<-1, 7, 14>},
    {"mouthFrownLeft", pull_corner<1, 1, -13>},
    {"mouthFrownRight", pull_corner<-1, 1, -13>},
    {"mouthStretchLeft", pull_corner<1, 12, -2>},
    {"mouthStretchRight", pull_corner<-1, 12, -2>},
};

/// The position of a point on the head's front, a little in front of its surface.
Vector3f placed_on(const HeadShape& head, const Point& point) {
  const float x = point.place.x() * head.half.y();
  const float y = point.place.y() * head.half.y();
  // The same ellipsoid as the skull, which is narrower at the chin.
  const float height = std::clamp(point.place.y(), -0.95f, 0.95f);
  const float taper = 0.88f + 0.12f * height;
  const float round = std::sqrt(1 - height * height) * taper;
  const float aside = std::clamp(x / (head.half.x() * round), -0.95f, 0.95f);
  const float depth = head.half.z() * round * std::sqrt(1 - aside * aside);
  const float before = (0.03f + point.out) * head.half.y();
  return head.centre + x * head.left + y * head.up + (depth + before) * head.forward;
}

struct FaceDrawing {
  std::vector<Point> points;
  std::vector<std::uint32_t> indices;

  /// Adds triangles between two rows of points of equal length, the second of which follows the first directly.
  void strip(std::uint32_t first, std::uint32_t length, bool closed) {
    for (std::uint32_t i = 0; i + (closed ? 0 : 1) < length; ++i) {
      const std::uint32_t next = (i + 1) % length;
      indices.insert(indices.end(), {first + i, first + next, first + length + next});
      indices.insert(indices.end(), {first + i, first + length + next, first + length + i});
    }
  }
  std::uint32_t count() const { return static_cast<std::uint32_t>(points.size()); }
};

FaceDrawing draw() {
  FaceDrawing face;
  for (const float side : {1.0f, -1.0f}) {
    const std::uint32_t brow = face.count();
    constexpr int kSteps = 6;
    for (const float row : {-0.03f, 0.03f}) {
      for (int i = 0; i <= kSteps; ++i) {
        const float along = static_cast<float>(i) / kSteps;
        const float arch = 0.06f * std::sin(along * std::numbers::pi_v<float>);
        const float thick = 1 - 0.5f * along;
        face.points.push_back({.part = FacePart::brow,
                               .side = side,
                               .place = {side * (0.13f + 0.36f * along), kBrowY + arch + row * thick},
                               .along = along});
      }
    }
    face.strip(brow, kSteps + 1, false);
    const std::uint32_t eye = face.count();
    constexpr std::uint32_t kCorners = 16;
    face.points.push_back({.part = FacePart::eye, .side = side, .place = {side * kEyeX, kEyeY}});
    for (std::uint32_t i = 0; i < kCorners; ++i) {
      const float angle = 2 * std::numbers::pi_v<float> * static_cast<float>(i) / kCorners;
      face.points.push_back({.part = FacePart::eye,
                             .side = side,
                             .place = {side * kEyeX + 0.115f * std::cos(angle), kEyeY + 0.085f * std::sin(angle)}});
      face.indices.insert(face.indices.end(), {eye, eye + 1 + i, eye + 1 + (i + 1) % kCorners});
    }
  }
  const std::uint32_t mouth = face.count();
  constexpr std::uint32_t kCorners = 24;
  for (const float size : {1.0f, 0.55f}) {  // the outer and inner edge of the lips
    for (std::uint32_t i = 0; i < kCorners; ++i) {
      const float angle = 2 * std::numbers::pi_v<float> * static_cast<float>(i) / kCorners;
      const float high = size == 1.0f ? 0.055f : 0.004f;
      face.points.push_back(
          {.part = FacePart::mouth,
           .place = {(0.2f + 0.8f * size) * 0.27f * std::cos(angle), kMouthY + high * std::sin(angle)},
           .along = std::cos(angle),
           .lower = 0.5f - 0.5f * std::sin(angle)});
    }
  }
  face.strip(mouth, kCorners, true);
  // Left is x and up is y, so triangles that are counter-clockwise here face the front.
  for (std::size_t i = 0; i < face.indices.size(); i += 3) {
    std::uint32_t* corner = &face.indices[i];
    const Vector2f a = face.points[corner[1]].place - face.points[corner[0]].place;
    const Vector2f b = face.points[corner[2]].place - face.points[corner[0]].place;
    if (a.x() * b.y() - a.y() * b.x() < 0) std::swap(corner[1], corner[2]);
  }
  return face;
}

}  // namespace

std::span<const char* const> face_target_names() {
  static const std::vector<const char*> names = [] {
    std::vector<const char*> list;
    for (const Effect& effect : kEffects) list.push_back(effect.name);
    return list;
  }();
  return names;
}

FaceMesh face_mesh(const HeadShape& head, const std::vector<std::string>& targets) {
  const FaceDrawing face = draw();
  FaceMesh mesh;
  mesh.indices = face.indices;
  for (const Point& point : face.points) mesh.positions.push_back(placed_on(head, point));
  mesh.normals.assign(mesh.positions.size(), head.forward);
  for (const std::string& name : targets) {
    const auto* effect =
        std::find_if(std::begin(kEffects), std::end(kEffects), [&](const Effect& one) { return name == one.name; });
    assert(effect != std::end(kEffects));
    FaceTarget target{.name = name, .deltas = {}};
    for (std::size_t i = 0; i < face.points.size(); ++i) {
      Point moved = face.points[i];
      effect->move(moved);
      target.deltas.emplace_back(placed_on(head, moved) - mesh.positions[i]);
    }
    mesh.targets.push_back(std::move(target));
  }
  return mesh;
}

}  // namespace signweave
