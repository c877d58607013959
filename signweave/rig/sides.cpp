#include "signweave/rig/sides.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace signweave {
namespace {

using Eigen::Vector3f;
using enum Part;

/// The body in one frame, according to a map.
struct PosedBody {
  const RigMap& map;
  const ModelPose& pose;

  bool has(Part part) const { return map.has(part); }
  bool has(Side side, Part left) const { return map.has(of(side, left)); }
  Vector3f at(Part part) const { return position_of(map[part], pose); }
  Vector3f at(Side side, Part left) const { return at(of(side, left)); }

  std::optional<Vector3f> up() const {
    const bool legs = has(left_thigh) && has(right_thigh);
    const bool arms = has(left_upper_arm) && has(right_upper_arm);
    if (!legs && !has(pelvis)) return std::nullopt;
    const Vector3f low = legs ? Vector3f(0.5f * (at(left_thigh) + at(right_thigh))) : at(pelvis);
    if (!arms && !has(head)) return std::nullopt;
    const Vector3f high = arms ? Vector3f(0.5f * (at(left_upper_arm) + at(right_upper_arm))) : at(head);
    if ((high - low).norm() < 1e-4f) return std::nullopt;
    return (high - low).normalized();
  }
  /// The direction in which the body faces if the map's sides are right, from the given pair of joints.
  std::optional<Vector3f> forward(Part left) const {
    const std::optional<Vector3f> upwards = up();
    if (!upwards || !has(Side::left, left) || !has(Side::right, left)) return std::nullopt;
    const Vector3f across = at(Side::left, left) - at(Side::right, left);
    const Vector3f direction = across.cross(*upwards);
    if (direction.norm() < 0.3f * across.norm() || direction.norm() < 1e-4f) return std::nullopt;
    return direction.normalized();
  }
};

/// A weighted mean of direction cosines.
struct Mean {
  double sum = 0;
  double weight = 0;
  void add(float value, float with) {
    sum += static_cast<double>(value * with);
    weight += static_cast<double>(with);
  }
};

/// Adds the directions from the ankle to the end of the toes.
void add_feet(const PosedBody& body, const BodyShape& shape, Mean& mean) {
  const auto forward = body.forward(left_thigh);
  if (!forward) return;
  for (const Side side : kSides) {
    if (!body.has(side, left_foot)) continue;
    const JointIndex last = body.map[of(side, body.has(side, left_toes) ? left_toes : left_foot)].joint;
    Vector3f end = body.pose.positions[static_cast<std::size_t>(last)];
    if (shape.has_tip(last)) end = position_of(shape.tips[static_cast<std::size_t>(last)], body.pose);
    const Vector3f toes = end - body.at(side, left_foot);
    if (toes.norm() > 1e-4f) mean.add(toes.normalized().dot(*forward), 1);
  }
}

/// Bent knees are in front of the line from hip to ankle, bent elbows behind that from shoulder to wrist.
void add_bend(const PosedBody& body, Part from, Part middle, Part to, float ahead, Mean& mean) {
  const auto forward = body.forward(from);
  if (!forward) return;
  for (const Side side : kSides) {
    if (!body.has(side, from) || !body.has(side, middle) || !body.has(side, to)) continue;
    const Vector3f a = body.at(side, from);
    const Vector3f b = body.at(side, to);
    const Vector3f joint = body.at(side, middle);
    const Vector3f out = joint - 0.5f * (a + b);
    const float length = (joint - a).norm() + (b - joint).norm();
    if (out.norm() > 0.05f * length) mean.add(ahead * out.normalized().dot(*forward), out.norm() / length);
  }
}

void add_face(const PosedBody& body, Mean& mean) {
  const auto forward = body.forward(left_upper_arm);
  if (!forward || !body.has(head)) return;
  const Vector3f up = *body.up();
  for (const Part part : {left_eye, right_eye, jaw}) {
    if (!body.has(part)) continue;
    Vector3f direction = body.at(part) - body.at(head);
    direction -= direction.dot(up) * up;
    if (direction.norm() > 1e-3f) mean.add(direction.normalized().dot(*forward), 1);
  }
}

/// On a right hand with fingers up and palm towards the viewer, the thumb is on the viewer's right.
void add_hands(const PosedBody& body, Mean& mean) {
  for (const Side side : kSides) {
    const auto knuckle = [&](Finger finger) { return finger_part(side, finger, FingerPoint::proximal); };
    const Part index = knuckle(Finger::index);
    const Part little = body.has(knuckle(Finger::little)) ? knuckle(Finger::little) : knuckle(Finger::ring);
    if (!body.has(side, left_hand) || !body.has(index) || !body.has(little)) continue;
    const Vector3f wrist = body.at(side, left_hand);
    const Vector3f thumbwards = body.at(index) - body.at(little);
    const Vector3f along = 0.5f * (body.at(index) + body.at(little)) - wrist;
    const Vector3f back = along.cross(thumbwards);  // points out of a right hand's back and out of a left hand's palm
    if (back.norm() < 1e-7f) continue;
    for (const Finger finger : {Finger::index, Finger::middle, Finger::ring, Finger::little}) {
      const Part from = knuckle(finger);
      const Part to = finger_part(side, finger, FingerPoint::distal);
      if (!body.has(from) || !body.has(to)) continue;
      const Vector3f bent = body.at(to) - body.at(from);
      if (bent.norm() < 1e-4f) continue;
      const float out = bent.normalized().dot(back.normalized());
      const float right = out < 0 ? 1.0f : -1.0f;
      if (std::abs(out) > 0.2f) mean.add(side == Side::right ? right : -right, std::abs(out));
    }
  }
}

}  // namespace

std::vector<SideCue> side_cues(const BodyShape& shape, const RigMap& map) {
  Mean feet, knees, face, elbows, hands;
  for (const ModelPose& pose : shape.poses) {
    const PosedBody body{map, pose};
    add_feet(body, shape, feet);
    add_bend(body, left_thigh, left_shin, left_foot, 1, knees);
    add_face(body, face);
    add_bend(body, left_upper_arm, left_forearm, left_hand, -1, elbows);
    add_hands(body, hands);
  }
  std::vector<SideCue> cues;
  const auto add = [&](std::string_view what, const Mean& mean, double enough) {
    if (mean.weight < enough) return;
    cues.push_back({what, static_cast<float>(mean.sum / mean.weight)});
  };
  add("feet", feet, 0.5);
  add("knees", knees, 0.1);
  add("eyes and jaw", face, 0.5);
  add("elbows", elbows, 0.1);
  add("fingers", hands, 0.5);
  return cues;
}

float sides_score(const std::vector<SideCue>& cues) {
  float sum = 0;
  float weight = 0;
  for (const SideCue& cue : cues) {
    // Elbows move in all directions, so they count less.
    const float counts = cue.what == "elbows" ? 0.3f : 1.0f;
    sum += counts * cue.score;
    weight += counts;
  }
  return weight > 0 ? sum / weight : 0;
}

}  // namespace signweave
