#include "signweave/drawing/body_mesh.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "signweave/rig/joint_at.h"

namespace signweave {
namespace {

using Eigen::Vector2f;
using Eigen::Vector3f;

constexpr float kPi = std::numbers::pi_v<float>;

/// One ring of a solid of revolution: its position along the axis, and its two half widths.
struct Ring {
  float along = 0;
  float wide = 0;
  float deep = 0;
};

class Builder {
 public:
  explicit Builder(JointIndex joint, BodyMesh& mesh)
      : mesh_(mesh), joint_(joint), first_(mesh.positions.size()), first_index_(mesh.indices.size()) {}

  /// Adds a solid of revolution about the unit `axis` from `base`: rings in order, the first and last of width 0.
  /// `side` is the unit direction of the first half width, perpendicular to the axis.
  void turned(const Vector3f& base, const Vector3f& axis, const Vector3f& side, const std::vector<Ring>& rings,
              std::uint32_t corners) {
    const Vector3f other = axis.cross(side);
    std::vector<std::uint32_t> begins;
    for (const Ring& ring : rings) {
      begins.push_back(vertex_count());
      const std::uint32_t count = ring.wide > 0 ? corners : 1;
      for (std::uint32_t i = 0; i < count; ++i) {
        const float angle = 2 * kPi * static_cast<float>(i) / static_cast<float>(corners);
        add(base + ring.along * axis + ring.wide * std::cos(angle) * side + ring.deep * std::sin(angle) * other);
      }
    }
    for (std::size_t k = 0; k + 1 < rings.size(); ++k) {
      const auto corner = [&](std::size_t ring, std::uint32_t i) {
        return begins[ring] + (rings[ring].wide > 0 ? i % corners : 0);
      };
      for (std::uint32_t i = 0; i < corners; ++i) {
        if (rings[k].wide > 0) triangle(corner(k, i), corner(k, i + 1), corner(k + 1, i + 1));
        if (rings[k + 1].wide > 0) triangle(corner(k, i), corner(k + 1, i + 1), corner(k + 1, i));
      }
    }
  }

  std::uint32_t add(const Vector3f& place) {
    mesh_.positions.push_back(place);
    mesh_.joints.push_back(joint_);
    return vertex_count() - 1;
  }
  void triangle(std::uint32_t a, std::uint32_t b, std::uint32_t c) {
    mesh_.indices.insert(mesh_.indices.end(), {a, b, c});
  }

  /// Sets the normal of each vertex added since construction to the mean of its triangles' normals.
  void finish() {
    mesh_.normals.resize(mesh_.positions.size(), Vector3f::Zero());
    for (std::size_t i = first_index_; i < mesh_.indices.size(); i += 3) {
      const std::uint32_t* corner = &mesh_.indices[i];
      const Vector3f normal = (mesh_.positions[corner[1]] - mesh_.positions[corner[0]])
                                  .cross(mesh_.positions[corner[2]] - mesh_.positions[corner[0]]);
      for (int k = 0; k < 3; ++k) mesh_.normals[corner[k]] += normal;
    }
    for (std::size_t i = first_; i < mesh_.normals.size(); ++i) {
      // Rounding noise must not decide: a triangle too small to have a direction gets an arbitrary one.
      const double length = mesh_.normals[i].cast<double>().norm();
      mesh_.normals[i] =
          length > 0 ? Vector3f((mesh_.normals[i].cast<double>() / length).cast<float>()) : Vector3f(Vector3f::UnitY());
    }
  }

 private:
  std::uint32_t vertex_count() const { return static_cast<std::uint32_t>(mesh_.positions.size()); }

  BodyMesh& mesh_;
  JointIndex joint_;
  std::size_t first_;
  std::size_t first_index_;
};

/// Rings of a solid with rounded ends: half widths from (w0, d0) at 0 to (w1, d1) at `length`.
std::vector<Ring> rounded(float length, float w0, float d0, float w1, float d1) {
  constexpr float kIn = 0.8f;
  constexpr float kOut = 0.6f;
  const float low = std::min(w0, d0);
  const float high = std::min(w1, d1);
  return {{-low, 0, 0},     {-kOut * low, kIn * w0, kIn * d0},          {0, w0, d0},
          {length, w1, d1}, {length + kOut * high, kIn * w1, kIn * d1}, {length + high, 0, 0}};
}

/// Adds a limb from `from` to `to`, with its thickness at the beginning.
void add_limb(BodyMesh& mesh, JointIndex joint, const Vector3f& from, const Vector3f& to, float thick, float thin) {
  const Vector3f direction = to - from;
  const float length = direction.norm();
  const Vector3f axis = direction / length;
  Builder builder(joint, mesh);
  builder.turned(from, axis, axis.unitOrthogonal(), rounded(length, thick, thick, thin, thin), 10);
  builder.finish();
}

void add_ellipsoid(BodyMesh& mesh, const HeadShape& head) {
  constexpr int kRings = 12;
  std::vector<Ring> rings;
  for (int i = 0; i <= kRings; ++i) {
    const float angle = kPi * static_cast<float>(i) / kRings;
    // The chin is narrower than the skull.
    const float taper = 0.88f - 0.12f * std::cos(angle);
    const float round = i == 0 || i == kRings ? 0 : std::sin(angle) * taper;
    rings.push_back({-head.half.y() * std::cos(angle), head.half.x() * round, head.half.z() * round});
  }
  Builder skull(head.joint, mesh);
  // turned() goes from `side` to axis × side: from forward to up × forward, which is left.
  for (Ring& ring : rings) std::swap(ring.wide, ring.deep);
  skull.turned(head.centre, head.up, head.forward, rings, 20);
  skull.finish();
}

/// Corners of the convex hull of the points, counter-clockwise (monotone chain).
std::vector<Vector2f> hull_of(std::vector<Vector2f> points) {
  std::sort(points.begin(), points.end(),
            [](const Vector2f& a, const Vector2f& b) { return a.x() != b.x() ? a.x() < b.x() : a.y() < b.y(); });
  std::vector<Vector2f> hull;
  for (int pass = 0; pass < 2; ++pass) {
    const std::size_t base = hull.size();
    for (const Vector2f& point : points) {
      while (hull.size() >= base + 2) {
        const Vector2f a = hull.back() - hull[hull.size() - 2];
        const Vector2f b = point - hull.back();
        if (a.x() * b.y() - a.y() * b.x() > 0) break;
        hull.pop_back();
      }
      hull.push_back(point);
    }
    hull.pop_back();
    std::reverse(points.begin(), points.end());
  }
  return hull;
}

/// Adds a flat box around wrist and knuckles, so that the hand has a palm and a back.
void add_palm(BodyMesh& mesh, const BodyPlan& plan, const HandShape& hand) {
  const Vector3f wrist = plan.place(hand.joint);
  std::vector<Vector3f> points = {wrist};
  for (const JointIndex knuckle : hand.knuckles) points.push_back(plan.place(knuckle));
  Vector3f middle = Vector3f::Zero();
  for (const Vector3f& point : points) middle += point / static_cast<float>(points.size());
  Eigen::Matrix3f spread = Eigen::Matrix3f::Zero();
  for (const Vector3f& point : points) spread += (point - middle) * (point - middle).transpose();
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3f> plane(spread);
  const Vector3f along = plane.eigenvectors().col(2);
  const Vector3f across = plane.eigenvectors().col(1);
  const Vector3f normal = along.cross(across);

  std::vector<Vector2f> flat;
  const float margin = 0.0055f * plan.size;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const float around = i == 0 ? 2.2f * margin : margin;  // the wrist is wider than a knuckle
    for (int k = 0; k < 8; ++k) {
      const float angle = 2 * kPi * static_cast<float>(k) / 8;
      flat.emplace_back((points[i] - middle).dot(along) + around * std::cos(angle),
                        (points[i] - middle).dot(across) + around * std::sin(angle));
    }
  }
  const std::vector<Vector2f> hull = hull_of(std::move(flat));
  const auto corners = static_cast<std::uint32_t>(hull.size());
  const float half = 1.2f * margin;
  const auto place = [&](std::uint32_t corner, float height, float inset) {
    const Vector2f spot = hull[corner % corners] * inset;
    return Vector3f(middle + spot.x() * along + spot.y() * across + height * normal);
  };
  // Back, palm and rim are separate solids, so that their edges stay sharp.
  for (const float face : {half, -half}) {
    Builder builder(hand.joint, mesh);
    std::vector<std::uint32_t> rim;
    for (std::uint32_t i = 0; i < corners; ++i) rim.push_back(builder.add(place(i, face, 0.94f)));
    for (std::uint32_t i = 2; i < corners; ++i) {
      if (face > 0) builder.triangle(rim[0], rim[i - 1], rim[i]);
      if (face < 0) builder.triangle(rim[0], rim[i], rim[i - 1]);
    }
    builder.finish();
  }
  Builder builder(hand.joint, mesh);
  std::vector<std::uint32_t> rows[4];
  const float heights[] = {-half, -0.5f * half, 0.5f * half, half};
  for (std::size_t row = 0; row < 4; ++row) {
    const float inset = row == 0 || row == 3 ? 0.94f : 1.0f;
    for (std::uint32_t i = 0; i < corners; ++i) rows[row].push_back(builder.add(place(i, heights[row], inset)));
  }
  for (std::size_t row = 0; row < 3; ++row) {
    for (std::uint32_t i = 0; i < corners; ++i) {
      const std::uint32_t next = (i + 1) % corners;
      builder.triangle(rows[row][i], rows[row][next], rows[row + 1][next]);
      builder.triangle(rows[row][i], rows[row + 1][next], rows[row + 1][i]);
    }
  }
  builder.finish();
}

/// Adds the trunk spine joint by spine joint, from the width of the hips to that of the ribs, up to the neck.
void add_trunk(BodyMesh& mesh, const BodyPlan& plan) {
  const float hips = plan.hip_width + 0.035f * plan.size;
  const float ribs = 0.88f * plan.shoulder_width;
  const float deep = 0.62f;
  std::vector<JointIndex> joints = plan.trunk;
  joints.push_back(plan.neck);
  const float whole = (plan.place(plan.trunk.back()) - plan.place(plan.trunk.front())).norm();
  const auto width_at = [&](std::size_t i) {
    if (i + 1 == joints.size()) return 0.5f * ribs;
    const float part = (plan.place(joints[i]) - plan.place(plan.trunk.front())).norm() / std::max(whole, 1e-6f);
    return hips + (ribs - hips) * part - 0.3f * std::min(hips, ribs) * part * (1 - part);  // the waist
  };
  for (std::size_t i = 0; i + 1 < joints.size(); ++i) {
    const Vector3f from = plan.place(joints[i]);
    const Vector3f direction = plan.place(joints[i + 1]) - from;
    const float length = direction.norm();
    if (length < 1e-4f * plan.size) continue;
    const Vector3f axis = direction / length;
    const Vector3f flat = plan.left - plan.left.dot(axis) * axis;
    const Vector3f side = flat.norm() > 0.1f ? Vector3f(flat.normalized()) : Vector3f(axis.unitOrthogonal());
    const float w0 = width_at(i);
    const float w1 = width_at(i + 1);
    std::vector<Ring> rings = rounded(length, w0, deep * w0, w1, deep * w1);
    for (Ring& ring : rings) {  // flatter ends: a trunk is not a ball
      if (ring.along < 0) ring.along *= 0.4f;
      if (ring.along > length) ring.along = length + 0.4f * (ring.along - length);
    }
    Builder builder(joints[i], mesh);
    builder.turned(from, axis, side, rings, 20);
    builder.finish();
  }
}

void add_nose(BodyMesh& mesh, const HeadShape& head) {
  const float scale = head.half.y();
  // On the skull's surface, so that no gap is visible from the side.
  const auto before_skull = [&](float height, float distance) {
    const float surface = head.half.z() * std::sqrt(1 - height * height) * (0.88f + 0.12f * height);
    return Vector3f(head.centre + height * scale * head.up + (surface + distance * scale) * head.forward);
  };
  add_limb(mesh, head.joint, before_skull(0.12f, -0.02f), before_skull(-0.14f, 0.03f), 0.07f * scale, 0.12f * scale);
}

}  // namespace

BodyMesh body_mesh(const Skeleton& skeleton, const BodyPlan& plan) {
  // Bones that are covered by a larger solid.
  std::vector<bool> covered(skeleton.joint_count());
  if (!plan.trunk.empty()) {  // up to the root: joints above the hips are not part of the body
    for (JointIndex joint = plan.neck; joint != kNoJoint; joint = skeleton.joint(joint).parent)
      covered[at(joint)] = true;
  }
  for (const HandShape& hand : plan.hands) {
    for (JointIndex joint : hand.knuckles) {
      for (; joint != hand.joint; joint = skeleton.joint(joint).parent) covered[at(joint)] = true;
    }
  }
  std::vector<bool> in_head(skeleton.joint_count());
  for (std::size_t joint = 1; plan.head && joint < skeleton.joint_count(); ++joint) {
    const JointIndex parent = skeleton.joint(static_cast<JointIndex>(joint)).parent;
    in_head[joint] = parent == plan.head->joint || in_head[at(parent)];
  }
  std::vector<bool> in_neck(skeleton.joint_count());
  if (plan.head && !plan.trunk.empty()) {
    JointIndex joint = skeleton.joint(plan.head->joint).parent;
    for (; joint > plan.neck; joint = skeleton.joint(joint).parent) in_neck[at(joint)] = true;
    if (joint == plan.neck) in_neck[at(joint)] = true;
  }

  const auto thickness = [&](JointIndex joint, float length) {
    if (in_neck[at(joint)]) return 0.031f * plan.size;
    const bool collar = std::find(plan.collars.begin(), plan.collars.end(), joint) != plan.collars.end();
    return collar ? 0.026f * plan.size : 0.12f * length + 0.0034f * plan.size;
  };
  BodyMesh mesh;
  const auto add_bone = [&](JointIndex joint, const Vector3f& end, float next) {
    const Vector3f from = plan.place(joint);
    const float length = (end - from).norm();
    if (length < 1e-4f * plan.size) return;
    const float thick = thickness(joint, length);
    add_limb(mesh, joint, from, end, thick, next > 0 ? std::clamp(next, 0.6f * thick, thick) : 0.7f * thick);
  };
  for (JointIndex joint = 1; at(joint) < skeleton.joint_count(); ++joint) {
    if (covered[at(joint)] || in_head[at(joint)]) continue;
    // A limb is as thick at its end as the next one is at its beginning.
    const auto& children = plan.children[at(joint)];
    const float next = children.size() == 1 ? thickness(joint, plan.bones[at(children[0])].norm()) : 0;
    add_bone(skeleton.joint(joint).parent, plan.place(joint), next);
  }
  for (std::size_t i = 0; i < skeleton.tips().size(); ++i) {
    const JointIndex joint = skeleton.tips()[i].joint;
    const bool skull = plan.head && (joint == plan.head->joint || in_head[at(joint)]);
    if (!skull) add_bone(joint, plan.place(joint) + plan.tip_bones[i], 0);
  }
  for (const HandShape& hand : plan.hands) add_palm(mesh, plan, hand);
  if (!plan.trunk.empty()) add_trunk(mesh, plan);
  if (plan.head) {
    add_ellipsoid(mesh, *plan.head);
    add_nose(mesh, *plan.head);
  }
  return mesh;
}

}  // namespace signweave
