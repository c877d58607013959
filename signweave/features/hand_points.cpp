#include "signweave/features/hand_points.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace signweave {
namespace {

using Eigen::Vector3f;

constexpr float kRight = std::numbers::pi_v<float> / 2;

Vector3f unit(const Vector3f& vector) {
  const float length = vector.norm();
  return length > 1e-9f ? Vector3f(vector / length) : Vector3f::Zero();
}

float angle_between(const Vector3f& a, const Vector3f& b) {
  return std::atan2(a.cross(b).norm(), a.dot(b));
}

/// Returns the middle finger's knuckle, or the mean of the knuckles without one.
Vector3f middle_knuckle(const HandPoints& hand) {
  if (hand.finger(Finger::middle).count > 0) return hand.finger(Finger::middle).points[0];
  Vector3f sum = Vector3f::Zero();
  float count = 0;
  for (std::size_t i = 1; i < hand.fingers.size(); ++i) {
    if (hand.fingers[i].count == 0) continue;
    sum += hand.fingers[i].points[0];
    ++count;
  }
  return count == 0 ? hand.wrist : Vector3f(sum / count);
}

/// Returns the mean flexion of the joints beyond the first, as a fraction of a right angle.
float bend_beyond(const HandPoints::OneFinger& finger) {
  if (finger.count < 3) return 0;
  float sum = 0;
  for (std::size_t i = 2; i < finger.count; ++i) {
    sum += angle_between(finger.points[i - 1] - finger.points[i - 2], finger.points[i] - finger.points[i - 1]);
  }
  return std::min(sum / static_cast<float>(finger.count - 2) / kRight, 1.0f);
}

/// The first and the last existing finger besides the thumb; null if there is none.
struct OuterFingers {
  const HandPoints::OneFinger* first = nullptr;
  const HandPoints::OneFinger* last = nullptr;
};

OuterFingers outer_fingers(const HandPoints& hand) noexcept {
  OuterFingers outer;
  for (std::size_t i = 1; i < hand.fingers.size(); ++i) {
    if (hand.fingers[i].count == 0) continue;
    if (outer.first == nullptr) outer.first = &hand.fingers[i];
    outer.last = &hand.fingers[i];
  }
  return outer;
}

}  // namespace

HandPlaces::HandPlaces(const RigMap& rig, Side side) : wrist_(rig[of(side, Part::left_hand)]) {
  for (const Finger finger : kFingers) {
    OneFinger& row = fingers_[static_cast<std::size_t>(finger)];
    const std::size_t first = finger == Finger::thumb ? 0 : static_cast<std::size_t>(FingerPoint::proximal);
    for (std::size_t point = first; point < kFingerPoints; ++point) {
      const PartPlace& place = rig[finger_part(side, finger, static_cast<FingerPoint>(point))];
      if (place.known()) row.places[row.count++] = place;
    }
    // A single point has no direction, and points without a knuckle do not form a finger.
    if (row.count < 2 || (first > 0 && !rig.has(finger_part(side, finger, FingerPoint::proximal)))) row.count = 0;
  }
  const auto without_thumb =
      std::count_if(fingers_.begin() + 1, fingers_.end(), [](auto& row) { return row.count > 0; });
  if (without_thumb == 0) {
    why_no_fingers_ = fmt::format("no {} fingers", side == Side::left ? "left" : "right");
  } else if (without_thumb == 1 && fingers_[0].count == 0) {
    why_no_fingers_ = fmt::format("only one {} finger: a palm needs two", side == Side::left ? "left" : "right");
  }
}

void HandPlaces::read(const ModelPose& pose, HandPoints& out) const noexcept {
  out.wrist = position_of(wrist_, pose);
  for (std::size_t i = 0; i < fingers_.size(); ++i) {
    out.fingers[i].count = fingers_[i].count;
    for (std::size_t k = 0; k < fingers_[i].count; ++k) {
      const PartPlace& place = fingers_[i].places[k];
      out.fingers[i].points[k] =
          place.offset.isZero(0) ? pose.positions[static_cast<std::size_t>(place.joint)] : position_of(place, pose);
    }
  }
}

void HandPlaces::add_joints(std::vector<JointIndex>& joints) const {
  if (wrist_.known()) joints.push_back(wrist_.joint);
  for (const OneFinger& finger : fingers_) {
    for (std::size_t k = 0; k < finger.count; ++k) joints.push_back(finger.places[k].joint);
  }
}

Vector3f palm_of(const HandPoints& hand) noexcept {
  return 0.5f * (hand.wrist + middle_knuckle(hand));
}

HandAxes axes_of(const HandPoints& hand, Side side) noexcept {
  HandAxes axes{};
  axes.fingers = unit(middle_knuckle(hand) - hand.wrist);
  // From the last knuckle on the little finger's side to the first on the thumb's.
  auto [first, last] = outer_fingers(hand);
  if (first == last) first = &hand.fingers[0];
  const Vector3f across = first->points[0] - last->points[0];
  const Vector3f out = side == Side::left ? axes.fingers.cross(across) : across.cross(axes.fingers);
  axes.palm = unit(out);
  axes.thumb = side == Side::left ? axes.palm.cross(axes.fingers) : axes.fingers.cross(axes.palm);
  return axes;
}

Handshape handshape_of(const HandPoints& hand, const HandAxes& axes) noexcept {
  Handshape shape;
  std::array<float, kFingers.size()> aside{};  // radians, positive to the thumb's side
  for (std::size_t i = 0; i < hand.fingers.size(); ++i) {
    const HandPoints::OneFinger& finger = hand.fingers[i];
    if (finger.count == 0) continue;
    const bool thumb = i == 0;
    const Vector3f bone = unit(finger.points[1] - finger.points[0]);
    const Vector3f whole = thumb ? unit(finger.points[finger.count - 1] - finger.points[0]) : bone;
    const float out = bone.dot(axes.palm);
    const float knuckle = thumb ? std::asin(std::clamp(out, -1.0f, 1.0f)) : std::atan2(out, bone.dot(axes.fingers));
    shape.values[3 * i] = std::clamp(knuckle / kRight, 0.0f, 1.0f);
    shape.values[3 * i + 1] = bend_beyond(finger);
    aside[i] = thumb ? std::atan2(whole.dot(axes.thumb), whole.dot(axes.fingers))
                     : std::asin(std::clamp(bone.dot(axes.thumb), -1.0f, 1.0f));
  }
  // Spread: the angle of each finger from the next existing one towards the thumb.
  std::size_t before = kFingers.size();
  for (std::size_t i = 0; i < hand.fingers.size(); ++i) {
    if (hand.fingers[i].count == 0) continue;
    if (before < kFingers.size()) {
      const float whole = before == 0 ? kRight : 0.5f * kRight;
      shape.values[3 * i + 2] = std::clamp((aside[before] - aside[i]) / whole, 0.0f, 1.0f);
    }
    before = i;
  }
  // The position of the thumb's tip across the palm.
  const HandPoints::OneFinger& thumb = hand.fingers[0];
  const auto [first, last] = outer_fingers(hand);
  if (thumb.count > 0 && first != nullptr && first != last) {
    const float begin = first->points[0].dot(axes.thumb);
    const float end = last->points[0].dot(axes.thumb);
    const float at = thumb.points[thumb.count - 1].dot(axes.thumb);
    if (begin - end > 1e-6f) shape.values[2] = std::clamp((begin - at) / (begin - end), 0.0f, 1.0f);
  }
  // Missing fingers copy their neighbour.
  std::array<bool, kFingers.size()> known{};
  for (std::size_t i = 1; i < known.size(); ++i) known[i] = hand.fingers[i].count > 0;
  const auto follow = [&](std::size_t finger, std::size_t neighbour) {
    if (known[finger] || !known[neighbour]) return;
    std::copy_n(shape.values.begin() + static_cast<std::ptrdiff_t>(3 * neighbour), 3,
                shape.values.begin() + static_cast<std::ptrdiff_t>(3 * finger));
    known[finger] = true;
  };
  for (std::size_t i = 2; i < known.size(); ++i) follow(i, i - 1);
  for (std::size_t i = known.size() - 1; i > 1; --i) follow(i - 1, i);
  return shape;
}

float openness_of(const Handshape& shape) noexcept {
  float bend = 0;
  for (std::size_t i = 1; i < kFingers.size(); ++i) {
    bend += (shape.values[3 * i] + 2 * shape.values[3 * i + 1]) / 3;
  }
  return 1 - bend / static_cast<float>(kFingers.size() - 1);
}

float distance(const Handshape& a, const Handshape& b) noexcept {
  float sum = 0;
  for (std::size_t i = 0; i < Handshape::kSize; ++i) {
    sum += (a.values[i] - b.values[i]) * (a.values[i] - b.values[i]);
  }
  return std::sqrt(sum / static_cast<float>(Handshape::kSize));
}

}  // namespace signweave
