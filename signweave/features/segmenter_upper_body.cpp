#include <algorithm>
#include <cmath>

#include "signweave/features/segmenter.h"
#include "signweave/motion/kinematics.h"

namespace signweave {
namespace {

constexpr Part kKnuckles[] = {finger_part(Side::left, Finger::index, FingerPoint::proximal),
                              finger_part(Side::left, Finger::middle, FingerPoint::proximal),
                              finger_part(Side::left, Finger::ring, FingerPoint::proximal),
                              finger_part(Side::left, Finger::little, FingerPoint::proximal)};

/// Returns the corresponding knuckle on the given side.
Part on_side(Side side, Part knuckle) {
  const std::size_t hand = kFingers.size() * kFingerPoints;
  return static_cast<Part>(static_cast<std::size_t>(knuckle) + static_cast<std::size_t>(side) * hand);
}

/// Returns the first of some parts that the map has.
std::optional<Part> first_of(const RigMap& rig, std::initializer_list<Part> parts) {
  for (const Part part : parts) {
    if (rig.has(part)) return part;
  }
  return std::nullopt;
}

/// Returns the signer's left in the model's horizontal plane: from right shoulder (else hip) to left, over the whole
/// motion.
Eigen::Vector3f left_of(const Eigen::Vector3f& across) {
  const Eigen::Vector3f level(across.x(), 0, across.z());
  return level.norm() > 1e-6F ? level.normalized() : Eigen::Vector3f::UnitX();
}

}  // namespace

UpperBodyTrack upper_body_of(const Motion& motion, const RigMap& rig) {
  UpperBodyTrack track;
  for (const Side side : kSides) track.has_hand[static_cast<std::size_t>(side)] = rig.has(of(side, Part::left_hand));
  if (!track.has_hand[0] && !track.has_hand[1]) {
    throw Error(ErrorCode::not_found,
                "no joint of the motion is known as a hand; a mapping file can name left_hand and right_hand");
  }
  const std::optional<Part> top = first_of(rig, {Part::head, Part::neck, Part::head_top});
  const std::optional<Part> low = first_of(rig, {Part::pelvis, Part::spine});
  const std::optional<Part> high = first_of(rig, {Part::neck, Part::chest, Part::spine});
  if (!top || !low || !high) {
    throw Error(
        ErrorCode::not_found,
        "no joint of the motion is known as head or trunk, relative to which hands are measured; a mapping file can "
        "name head, neck and pelvis");
  }
  const auto frames = static_cast<std::size_t>(motion.frame_count());
  track.times.reserve(frames);
  track.bodies.reserve(frames);
  Eigen::Vector3f across = Eigen::Vector3f::Zero();
  ModelPose pose;
  for (std::size_t frame = 0; frame < frames; ++frame) {
    to_model_space(motion.skeleton(), motion.pose(static_cast<std::int64_t>(frame)), pose);
    const auto at = [&](Part part) { return position_of(rig[part], pose); };
    UpperBody body;
    body.spine = 0.5F * (at(*low) + at(*high));
    body.head = at(*top);
    if (rig.has(Part::head_top)) body.head = 0.5F * (body.head + at(Part::head_top));
    for (const Side side : kSides) {
      const auto s = static_cast<std::size_t>(side);
      body.hands[s] = body.wrists[s] = Eigen::Vector3f::Zero();
      if (!track.has_hand[s]) continue;
      body.wrists[s] = at(of(side, Part::left_hand));
      Eigen::Vector3f sum = Eigen::Vector3f::Zero();
      float knuckles = 0;
      for (const Part knuckle : kKnuckles) {
        if (!rig.has(on_side(side, knuckle))) continue;
        sum += at(on_side(side, knuckle));
        ++knuckles;
      }
      body.hands[s] = knuckles > 0 ? 0.5F * (body.wrists[s] + sum / knuckles) : body.wrists[s];
    }
    for (const Part left : {Part::left_upper_arm, Part::left_clavicle, Part::left_thigh}) {
      if (!rig.has(left) || !rig.has(of(Side::right, left))) continue;
      across += at(left) - at(of(Side::right, left));
      break;
    }
    track.times.push_back(static_cast<double>(frame) * motion.rate().frame_time());
    track.bodies.push_back(body);
  }
  // A single orientation for the whole motion: the resting position must not move when the signer turns a little.
  const Eigen::Vector3f left = left_of(across);
  Eigen::Matrix3f signer_from_model;
  signer_from_model.row(0) = left;
  signer_from_model.row(1) = Eigen::Vector3f::UnitY();
  signer_from_model.row(2) = left.cross(Eigen::Vector3f::UnitY());
  for (UpperBody& body : track.bodies) {
    body.head = signer_from_model * body.head;
    body.spine = signer_from_model * body.spine;
    for (std::size_t side = 0; side < 2; ++side) {
      body.hands[side] = signer_from_model * body.hands[side];
      body.wrists[side] = signer_from_model * body.wrists[side];
    }
  }
  return track;
}

}  // namespace signweave
