#include "signweave/retarget/hand_places.h"

#include <algorithm>
#include <cmath>

#include "signweave/retarget/angles.h"

namespace signweave {
namespace {

using Eigen::Vector3f;

/// Metres for the character's size. Near the face, positions are relative to the face; two hands keep their relative
/// position fully below the first distance, not at all beyond the second.
constexpr float kFaceNear = 0.09f;
constexpr float kFaceFar = 0.22f;
constexpr float kHandsNear = 0.02f;
constexpr float kHandsFar = 0.10f;
/// Half the thickness of a finger and of the wrist, metres for a person of 1.67 m.
constexpr float kFingerRadius = 0.010f;
constexpr float kWristRadius = 0.024f;
/// How fast the weight of a pair of points decreases with its distance beyond the nearest pair's, metres.
constexpr float kBlur = 0.012f;

/// A hand's points: the source's positions, and the character's relative to its wrist.
struct Points {
  std::array<Vector3f, CharacterFingers::kMostPoints + 1> source;
  std::array<Vector3f, CharacterFingers::kMostPoints + 1> own;
  std::size_t count = 0;
};

Points points_of(const TwoHands& hand, const ModelPose& source, const ModelPose& own) noexcept {
  Points points;
  const Vector3f wrist = own.positions[static_cast<std::size_t>(hand.wrist)];
  for (std::size_t i = 0; i < hand.fingers->count(); ++i) {
    const CharacterFingers::Point& point = hand.fingers->point(i);
    points.source[points.count] = position_of(point.source, source);
    points.own[points.count++] = position_of(point.own, own) - wrist;
  }
  if (points.count == 0) {
    points.source[0] = source.positions[static_cast<std::size_t>(hand.source_wrist)];
    points.own[0] = Vector3f::Zero();
    points.count = 1;
  }
  return points;
}

/// Returns the mean of a hand's points.
Vector3f mean(const std::array<Vector3f, CharacterFingers::kMostPoints + 1>& points, std::size_t count) noexcept {
  Vector3f sum = Vector3f::Zero();
  for (std::size_t i = 0; i < count; ++i) sum += points[i];
  return sum / static_cast<float>(count);
}

/// Returns the displacement that moves a hand with its wrist at `goal` out of the body.
Vector3f hand_push_out(const Points& hand, const BodySurface& surface, const Vector3f& goal) noexcept {
  Vector3f displacement = Vector3f::Zero();
  // Each round moves the deepest point out; another one may still be inside afterwards.
  for (int round = 0; round < 3; ++round) {
    Vector3f most = surface.push_out(goal + displacement, kWristRadius * surface.scale());
    for (std::size_t i = 0; i < hand.count; ++i) {
      const Vector3f one = surface.push_out(goal + displacement + hand.own[i], kFingerRadius * surface.scale());
      if (one.squaredNorm() > most.squaredNorm()) most = one;
    }
    displacement += most;
  }
  return displacement;
}

}  // namespace

WristGoals wrist_goals(const PlacedBody& source, const std::optional<HeadSpace>& source_head, const PlacedBody& own,
                       const std::optional<HeadSpace>& own_head, const std::array<std::optional<TwoHands>, 2>& hands,
                       const BodySurface& surface, float unit_ratio) noexcept {
  WristGoals goals;
  std::array<Points, 2> points;
  for (std::size_t i = 0; i < 2; ++i) {
    if (!hands[i]) continue;
    points[i] = points_of(*hands[i], *source.pose, *own.pose);
    const Points& hand = points[i];
    // The centre of the palm, as the hand's position is defined elsewhere; with fingers, the mean of the hand's points.
    SignerSpace space = own.space;
    space.unit = source.space.unit * unit_ratio;
    const Vector3f place = space.to_model(source.space.to_signer(mean(hand.source, hand.count)));
    Vector3f goal = place - mean(hand.own, hand.count);

    if (source_head && own_head) {
      const float scale = own_head->size / source_head->size;
      float nearest = 1e9f;
      for (std::size_t k = 0; k < hand.count; ++k) {
        nearest = std::min(nearest, scale * (hand.source[k] - source_head->eyes).norm());
      }
      const float near = smooth_fall(nearest, kFaceNear, kFaceFar);
      if (near > 0) {
        Vector3f sum = Vector3f::Zero();
        float weights = 0;
        for (std::size_t k = 0; k < hand.count; ++k) {
          const Vector3f from_eyes = hand.source[k] - source_head->eyes;
          const float weight = std::exp(-(scale * from_eyes.norm() - nearest) / (2 * kBlur));
          const Vector3f mapped =
              own_head->eyes + scale * (own_head->turn * (source_head->turn.conjugate() * from_eyes));
          sum += weight * (mapped - hand.own[k] - goal);
          weights += weight;
        }
        goal += near * sum / weights;
      }
    }
    goals.wrists[i] = goal + hand_push_out(hand, surface, goal);
  }

  if (!goals.wrists[0] || !goals.wrists[1]) return goals;
  const Points& left = points[0];
  const Points& right = points[1];
  float nearest = 1e9f;
  for (std::size_t a = 0; a < left.count; ++a) {
    for (std::size_t b = 0; b < right.count; ++b) {
      nearest = std::min(nearest, (left.source[a] - right.source[b]).norm());
    }
  }
  const float near = smooth_fall(nearest, kHandsNear, kHandsFar);
  if (near <= 0) return goals;
  const Eigen::Quaternionf turn = own.space.model_from_signer * source.space.model_from_signer.conjugate();
  Vector3f sum = Vector3f::Zero();
  float weights = 0;
  for (std::size_t a = 0; a < left.count; ++a) {
    for (std::size_t b = 0; b < right.count; ++b) {
      const Vector3f apart = left.source[a] - right.source[b];
      const float weight = std::exp(-(apart.norm() - nearest) / kBlur);
      if (weight < 1e-4f) continue;
      const Vector3f now = *goals.wrists[0] + left.own[a] - *goals.wrists[1] - right.own[b];
      sum += weight * (unit_ratio * (turn * apart) - now);
      weights += weight;
    }
  }
  const Vector3f missing = near * sum / weights;
  *goals.wrists[0] += 0.5f * missing;
  *goals.wrists[1] -= 0.5f * missing;
  for (std::size_t i = 0; i < 2; ++i) *goals.wrists[i] += hand_push_out(points[i], surface, *goals.wrists[i]);
  return goals;
}

Vector3f out_of_body(const TwoHands& hand, const ModelPose& pose, const BodySurface& surface,
                     const Vector3f& goal) noexcept {
  Points points;
  const Vector3f wrist = pose.positions[static_cast<std::size_t>(hand.wrist)];
  for (std::size_t i = 0; i < hand.fingers->count(); ++i) {
    points.own[points.count++] = position_of(hand.fingers->point(i).own, pose) - wrist;
  }
  return goal + hand_push_out(points, surface, goal);
}

}  // namespace signweave
