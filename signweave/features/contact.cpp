#include "signweave/features/contact.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace signweave {
namespace {

using Eigen::Vector3f;

// Shoulder widths.
constexpr float kTorsoRadius = 0.33f;  // half the depth of a trunk
constexpr float kTorsoAside = 0.17f;   // offset of each capsule's axis from the centre
// Fractions of the head's height from chin to top.
constexpr float kHeadRadius = 0.36f;   // between half its width and half its depth
constexpr float kHeadForward = 0.10f;  // distance of the skull's centre in front of the line from its joint to its top
// Fractions of the arm's length.
constexpr float kPalmRadius = 0.030f;
constexpr float kFingerRadius = 0.017f;
constexpr float kForearmRadius = 0.060f;
constexpr float kHandLength = 0.32f;  // wrist to finger tips: 0.108 of the stature (Drillis and Contini 1966)

/// The closest points of two line segments.
struct Nearest {
  Vector3f separation = Vector3f::Zero();  ///< vector from the second to the first
  float s = 0;                             ///< position on the first, 0 to 1
  float t = 0;                             ///< position on the second, 0 to 1
};
Nearest between(const Vector3f& a, const Vector3f& b, const Vector3f& c, const Vector3f& d) {
  const Vector3f u = b - a;
  const Vector3f v = d - c;
  const Vector3f w = a - c;
  const float uu = u.squaredNorm();
  const float vv = v.squaredNorm();
  const float uv = u.dot(v);
  const float uw = u.dot(w);
  const float vw = v.dot(w);
  constexpr float kPoint = 1e-12f;
  float s = 0;
  float t = 0;
  if (uu <= kPoint) {
    t = vv <= kPoint ? 0 : std::clamp(vw / vv, 0.0f, 1.0f);
  } else if (vv <= kPoint) {
    s = std::clamp(-uw / uu, 0.0f, 1.0f);
  } else {
    const float across = uu * vv - uv * uv;
    s = across > 1e-6f * uu * vv ? std::clamp((uv * vw - uw * vv) / across, 0.0f, 1.0f) : 0;
    t = (uv * s + vw) / vv;
    if (t < 0 || t > 1) {
      t = std::clamp(t, 0.0f, 1.0f);
      s = std::clamp((uv * t - uw) / uu, 0.0f, 1.0f);
    }
  }
  return {w + s * u - t * v, s, t};
}

}  // namespace

float clearance(const Capsule& a, const Capsule& b) noexcept {
  return between(a.from, a.to, b.from, b.to).separation.norm() - a.radius - b.radius;
}

Approach approach(const Capsule& a, const Capsule& b) noexcept {
  const Nearest nearest = between(a.from, a.to, b.from, b.to);
  const float distance = nearest.separation.norm();
  return {distance - a.radius - b.radius, distance > 1e-6f ? Vector3f(nearest.separation / distance) : Vector3f::Zero(),
          nearest.s, nearest.t};
}

HandShell shell_of(const HandPoints& hand, const std::optional<Vector3f>& elbow, const SignerBody& body) noexcept {
  const float arm = body.arm_length * body.shoulder_width;
  HandShell shell;
  const auto add = [&](const Vector3f& from, const Vector3f& to, float radius) {
    shell.bars[shell.count++] = {from, to, radius};
  };
  for (const HandPoints::OneFinger& finger : hand.fingers) {
    if (finger.count == 0) continue;
    // A finger is two capsules: one to its middle joint, one from there to its end.
    const std::size_t middle = std::min<std::size_t>(1, finger.count - 1);
    add(hand.wrist, finger.points[0], kPalmRadius * arm);
    add(finger.points[0], finger.points[middle], kFingerRadius * arm);
    if (finger.count > 2) add(finger.points[middle], finger.points[finger.count - 1], kFingerRadius * arm);
  }
  if (shell.count == 0) {
    Vector3f end = hand.wrist;
    if (elbow && (hand.wrist - *elbow).norm() > 1e-6f) {
      end += kHandLength * arm * (hand.wrist - *elbow).normalized();
    }
    add(hand.wrist, end, kPalmRadius * arm);
  }
  shell.middle = hand.wrist;
  for (const Capsule& bar : shell.all()) {
    shell.reach = std::max(
        {shell.reach, (bar.from - shell.middle).norm() + bar.radius, (bar.to - shell.middle).norm() + bar.radius});
  }
  return shell;
}

Capsule forearm_bar(const Vector3f& elbow, const Vector3f& wrist, const SignerBody& body) noexcept {
  return {elbow, wrist, kForearmRadius * body.arm_length * body.shoulder_width};
}

BodyShell shell_of(const SignerBody& body, const RigMap& rig, const SignerSpace& space,
                   const ModelPose& pose) noexcept {
  const float width = body.shoulder_width;
  BodyShell shell;
  const float radius = kTorsoRadius * width;
  // The trunk's axis leans with the body: from between the shoulders to between the hips.
  Vector3f hips = space.to_model({0, body.heights[static_cast<std::size_t>(Height::waist)], 0});
  if (rig.has(Part::pelvis)) hips = position_of(rig[Part::pelvis], pose);
  const Vector3f along = (hips - space.origin).normalized();
  const float length = std::max((hips - space.origin).norm(), 2 * radius);
  const Vector3f aside = kTorsoAside * width * (space.model_from_signer * Vector3f::UnitX());
  for (std::size_t i = 0; i < 2; ++i) {
    const Vector3f middle = space.origin + (i == 0 ? aside : Vector3f(-aside));
    shell.torso[i] = {middle + radius * along, middle + (length - radius) * along, radius};
  }
  if (!rig.has(Part::head)) return shell;

  const auto border = [&](Height height) { return body.heights[static_cast<std::size_t>(height)]; };
  const float face = (border(Height::forehead) - border(Height::mouth)) / 0.75f;  // chin to eyes
  const float height = width * (border(Height::above_head) - border(Height::forehead) + face);
  const Vector3f joint = position_of(rig[Part::head], pose);
  Vector3f up = Vector3f::UnitY();
  if (rig.has(Part::head_top)) {
    up = position_of(rig[Part::head_top], pose) - joint;
  } else if (rig.has(Part::neck)) {
    up = joint - position_of(rig[Part::neck], pose);
  }
  up = up.norm() > 1e-6f ? Vector3f(up.normalized()) : Vector3f::UnitY();
  const Vector3f top = rig.has(Part::head_top) ? position_of(rig[Part::head_top], pose) : joint + 0.87f * height * up;
  Vector3f forward = space.model_from_signer * Vector3f::UnitZ();
  if (rig.has(Part::left_eye) && rig.has(Part::right_eye)) {
    forward = 0.5f * (position_of(rig[Part::left_eye], pose) + position_of(rig[Part::right_eye], pose)) - joint;
  }
  forward -= forward.dot(up) * up;
  if (forward.norm() > 1e-6f) forward = kHeadForward * height * forward.normalized();
  const float head = kHeadRadius * height;
  shell.head = Capsule{top - head * up + forward, top - (height - head) * up + forward, head};
  return shell;
}

Approach approach(const HandShell& hand, const Capsule& other) noexcept {
  const float apart = clearance({hand.middle, hand.middle, hand.reach}, other);
  if (apart > 0) return {.clearance = apart};
  Approach nearest{.clearance = std::numeric_limits<float>::max()};
  for (const Capsule& bar : hand.all()) {
    const Approach here = approach(bar, other);
    if (here.clearance < nearest.clearance) nearest = here;
  }
  return nearest;
}

Approach approach(const HandShell& a, const HandShell& b) noexcept {
  const float apart = (a.middle - b.middle).norm() - a.reach - b.reach;
  if (apart > 0) return {.clearance = apart};
  Approach nearest{.clearance = std::numeric_limits<float>::max()};
  for (const Capsule& own : a.all()) {
    if (clearance(own, {b.middle, b.middle, b.reach}) >= nearest.clearance) continue;
    for (const Capsule& other : b.all()) {
      const Approach here = approach(own, other);
      if (here.clearance < nearest.clearance) nearest = here;
    }
  }
  return nearest;
}

bool touches(const HandShell& hand, const Capsule& other, const SignerBody& body) noexcept {
  const float margin = kContactGap * body.shoulder_width;
  if (clearance({hand.middle, hand.middle, hand.reach}, other) > margin) return false;
  return std::any_of(hand.bars.begin(), hand.bars.begin() + static_cast<std::ptrdiff_t>(hand.count),
                     [&](const Capsule& bar) { return clearance(bar, other) <= margin; });
}

bool touches(const HandShell& a, const HandShell& b, const SignerBody& body) noexcept {
  const float margin = kContactGap * body.shoulder_width;
  if ((a.middle - b.middle).norm() > a.reach + b.reach + margin) return false;
  return std::any_of(a.bars.begin(), a.bars.begin() + static_cast<std::ptrdiff_t>(a.count),
                     [&](const Capsule& bar) { return touches(b, bar, body); });
}

}  // namespace signweave
