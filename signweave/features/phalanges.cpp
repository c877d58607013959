#include "signweave/features/phalanges.h"

#include <algorithm>
#include <cmath>

namespace signweave {
namespace {

using Eigen::Vector3f;

constexpr float kThickness = 0.1f;  ///< radius of a finger by its length

/// Two bones where they are nearest, as `approach` of contact.h has it. Here, since most of the time is spent here.
struct NearestBones {
  Vector3f way = Vector3f::Zero();  ///< from the second to the first
  float s = 0;                      ///< along the first, 0 to 1
  float t = 0;                      ///< along the second
};

[[gnu::always_inline]] inline NearestBones nearest(const Phalanges::Bone& a, const Phalanges::Bone& b) {
  constexpr float kPoint = 1e-12f;
  const Vector3f w = a.from - b.from;
  const float uu = std::max(a.square, kPoint);
  const float vv = std::max(b.square, kPoint);
  const float uv = a.along.dot(b.along);
  const float uw = a.along.dot(w);
  const float vw = b.along.dot(w);
  const float across = uu * vv - uv * uv;
  float s = across > 1e-6f * uu * vv ? std::clamp((uv * vw - uw * vv) / across, 0.0f, 1.0f) : 0;
  float t = (uv * s + vw) / vv;
  if (t < 0 || t > 1) {
    t = std::clamp(t, 0.0f, 1.0f);
    s = std::clamp((uv * t - uw) / uu, 0.0f, 1.0f);
  }
  return {w + s * a.along - t * b.along, s, t};
}

/// Calls `look(pair, a, i, b, k, nearest)` for each two bones that are deeper in each other than their fingers' value
/// of `least`, which `look` may raise.
template <class Look>
void for_each_deeper(const Phalanges& hand, const FingerDepths& least, const Look& look) {
  std::size_t pair = 0;
  for (std::size_t a = 0; a < hand.fingers.size(); ++a) {
    for (std::size_t b = a + 1; b < hand.fingers.size(); ++b, ++pair) {
      const Phalanges::Row& one = hand.fingers[a];
      const Phalanges::Row& other = hand.fingers[b];
      const float reach = one.reach + other.reach;
      if (one.count == 0 || other.count == 0 || (one.middle - other.middle).squaredNorm() >= reach * reach) continue;
      for (std::size_t i = 0; i < one.count; ++i) {
        const Phalanges::Bone& bone = one.bones[i];
        for (std::size_t k = 0; k < other.count; ++k) {
          const Phalanges::Bone& beside = other.bones[k];
          const float both = bone.reach + beside.reach;
          if ((bone.middle - beside.middle).squaredNorm() >= both * both) continue;
          const NearestBones near = nearest(bone, beside);
          const float enough = bone.radius + beside.radius - least[pair];
          if (enough > 0 && near.way.squaredNorm() < enough * enough) look(pair, a, i, b, k, near);
        }
      }
    }
  }
}

}  // namespace

FingerRadii finger_radii(const HandPoints& hand) noexcept {
  FingerRadii radii{};
  for (std::size_t i = 0; i < radii.size(); ++i) {
    for (std::size_t k = 1; k < hand.fingers[i].count; ++k) {
      radii[i] += kThickness * (hand.fingers[i].points[k] - hand.fingers[i].points[k - 1]).norm();
    }
  }
  return radii;
}

void phalanges_of(const HandPoints& hand, const FingerRadii& radii, Phalanges& out) noexcept {
  for (std::size_t i = 0; i < out.fingers.size(); ++i) {
    const HandPoints::OneFinger& finger = hand.fingers[i];
    Phalanges::Row& row = out.fingers[i];
    row.first = i == static_cast<std::size_t>(Finger::thumb) && finger.count > 3 ? 1 : 0;
    row.count = finger.count > row.first + 1 ? finger.count - row.first - 1 : 0;
    row.middle.setZero();
    row.reach = 0;
    if (row.count == 0) continue;
    for (std::size_t k = 0; k < row.count; ++k) {
      const Vector3f& from = finger.points[row.first + k];
      const Vector3f& to = finger.points[row.first + k + 1];
      const float square = (to - from).squaredNorm();
      row.bones[k] = {from, to - from, 0.5f * (from + to), square, 0.5f * std::sqrt(square) + radii[i], radii[i]};
    }
    const Vector3f& end = finger.points[finger.count - 1];
    row.middle = 0.5f * (finger.points[row.first] + end);
    float square = (end - row.middle).squaredNorm();
    for (std::size_t k = 0; k < row.count; ++k) {
      square = std::max(square, (row.bones[k].from - row.middle).squaredNorm());
    }
    row.reach = std::sqrt(square) + radii[i];
  }
}

FingerDepths finger_depths(const Phalanges& hand) noexcept {
  FingerDepths depths{};
  for_each_deeper(
      hand, depths,
      [&](std::size_t pair, std::size_t a, std::size_t i, std::size_t b, std::size_t k, const NearestBones& near) {
        depths[pair] = hand.fingers[a].bones[i].radius + hand.fingers[b].bones[k].radius - near.way.norm();
      });
  return depths;
}

std::optional<FingerCrossing> worst_crossing(const Phalanges& hand, const FingerDepths& allowed, float least) noexcept {
  std::optional<FingerCrossing> worst;
  FingerDepths beyond = allowed;
  for (float& depth : beyond) depth += least;
  for_each_deeper(
      hand, beyond,
      [&](std::size_t pair, std::size_t a, std::size_t i, std::size_t b, std::size_t k, const NearestBones& near) {
        const Phalanges::Bone& one = hand.fingers[a].bones[i];
        const Phalanges::Bone& other = hand.fingers[b].bones[k];
        const float distance = near.way.norm();
        const float most = one.radius + other.radius - distance - allowed[pair];
        for (std::size_t p = 0; p < kFingerPairs; ++p) beyond[p] = allowed[p] + most;
        worst =
            FingerCrossing{.beyond = most,
                           .a = {static_cast<Finger>(a), hand.fingers[a].first + i, one.from + near.s * one.along},
                           .b = {static_cast<Finger>(b), hand.fingers[b].first + k, other.from + near.t * other.along},
                           .pair = pair,
                           .away = distance > 1e-6f ? Vector3f(near.way / distance) : Vector3f::Zero()};
      });
  return worst;
}

}  // namespace signweave
