#include "signweave/retarget/hand_places.h"

#include <algorithm>
#include <cmath>

#include "signweave/retarget/angles.h"

namespace signweave {
namespace {

using Eigen::Vector3f;

/// Metres of the character's size. Beside the face places are the face's own; two hands keep their places beside each
/// other wholly when as near as the first, not at all past the second.
constexpr float kFaceNear = 0.09f;
constexpr float kFaceFar = 0.22f;
constexpr float kHandsNear = 0.02f;
constexpr float kHandsFar = 0.10f;
/// A finger's half thickness and the wrist's, metres of a person of 1.67 m.
constexpr float kFingerRadius = 0.010f;
constexpr float kWristRadius = 0.024f;
/// How fast a pair of points counts less than the nearest pair, metres.
constexpr float kBlur = 0.012f;

/// A hand's points: the source's places, and the character's from its wrist.
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

/// The middle of what a hand is told by.
Vector3f mean(const std::array<Vector3f, CharacterFingers::kMostPoints + 1>& points, std::size_t count) noexcept {
  Vector3f sum = Vector3f::Zero();
  for (std::size_t i = 0; i < count; ++i) sum += points[i];
  return sum / static_cast<float>(count);
}

/// The way by which a hand whose wrist is at `goal` comes out of the body.
Vector3f way_out(const Points& hand, const BodySurface& surface, const Vector3f& goal) noexcept {
  Vector3f way = Vector3f::Zero();
  // Each round takes the point that is deepest; once it is out another one may still be in.
  for (int round = 0; round < 3; ++round) {
    Vector3f most = surface.way_out(goal + way, kWristRadius * surface.scale());
    for (std::size_t i = 0; i < hand.count; ++i) {
      const Vector3f one = surface.way_out(goal + way + hand.own[i], kFingerRadius * surface.scale());
      if (one.squaredNorm() > most.squaredNorm()) most = one;
    }
    way += most;
  }
  return way;
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
    // The palm's middle, as the hand's place is told elsewhere; with fingers, the middle of the hand's points.
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
    goals.wrists[i] = goal + way_out(hand, surface, goal);
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
  for (std::size_t i = 0; i < 2; ++i) *goals.wrists[i] += way_out(points[i], surface, *goals.wrists[i]);
  return goals;
}

Vector3f out_of_body(const TwoHands& hand, const ModelPose& pose, const BodySurface& surface,
                     const Vector3f& goal) noexcept {
  Points points;
  const Vector3f wrist = pose.positions[static_cast<std::size_t>(hand.wrist)];
  for (std::size_t i = 0; i < hand.fingers->count(); ++i) {
    points.own[points.count++] = position_of(hand.fingers->point(i).own, pose) - wrist;
  }
  return goal + way_out(points, surface, goal);
}

}  // namespace signweave
