#include "demo/space_plan.h"

#include <algorithm>
#include <cmath>

namespace signweave::demo {
namespace {

using Eigen::Quaternionf;
using Eigen::Vector3f;

// Seconds.
constexpr double kLeavesRest = 0.70;
constexpr double kReturns = 0.75;

/// The fraction of a movement that is done: slow at both ends, as HandPlan::done_in.
float eased(double t) {
  return static_cast<float>(0.35 * t * t * t * (10 + t * (6 * t - 15)) + 0.65 * t * t * (3 - 2 * t));
}

AimedHand on_the_right(AimedHand hand) {
  hand.palm.x() = -hand.palm.x();
  hand.hand = mirrored(hand.hand);
  return hand;
}

/// The left hand at rest, as the other recordings have it.
AimedHand rest_of(Rest rest) {
  const Signer signer = make_signer();
  const Skeleton& skeleton = *signer.skeleton;
  const ArmSizes sizes{skeleton.joint(signer.left.fore_arm).offset.norm(),
                       skeleton.joint(signer.left.hand).offset.norm()};
  const Vector3f wrist = to_model(rest_place(rest), Side::left);
  const Vector3f shoulder_at_rest = signer.rest_position(signer.left.arm);
  const Vector3f clavicle = signer.rest_position(signer.left.shoulder);
  const Vector3f shoulder = clavicle + clavicle_rotation(wrist - shoulder_at_rest) * (shoulder_at_rest - clavicle);
  const bool hips = rest == Rest::hips;
  const Vector3f palm = hips ? Vector3f(-1, 0, -0.15f) : Vector3f(-0.2f, 0.2f, -1);
  const Vector3f fingers = hips ? Vector3f(0.05f, -1, 0.22f) : Vector3f(-0.46f, -0.68f, 0.45f);
  const WristAngles angles = comfortable_wrist(shoulder, wrist, sizes, palm, fingers);
  const ArmPose pose = solve_arm(shoulder, wrist, sizes, angles);
  const Vector3f palm_from_wrist = 0.5f * skeleton.joint(signer.left.fingers[2][0]).offset;
  return {.palm = pose.wrist + pose.hand * palm_from_wrist - to_model(Vector3f::Zero(), Side::left),
          .hand = (pose.hand * hand_from_wrist().conjugate()).normalized(),
          .swivel = angles.swivel};
}

WristAngles between(const WristAngles& from, const WristAngles& to, float done) {
  return {.twist = from.twist + done * (to.twist - from.twist),
          .flexion = from.flexion + done * (to.flexion - from.flexion),
          .radial = from.radial + done * (to.radial - from.radial),
          .swivel = from.swivel + done * (to.swivel - from.swivel)};
}

AimedHand between(const AimedHand& from, const AimedHand& to, Side side, float done) {
  AimedHand hand;
  const Vector3f line = to.palm - from.palm;
  hand.palm = from.palm + done * line;
  // Around the body, as HandPlan's movements; 0 at both ends.
  hand.palm.z() += 4 * done * (1 - done) * 0.12f * line.norm();
  // In the angles of the wrist: the shortest way between two orientations may be one that a forearm cannot turn.
  hand.hand = from.hand.slerp(done, to.hand);
  return with_wrist(hand, between(wrist_of(from, side), wrist_of(to, side), done), side);
}

}  // namespace

SpacePlan::Unrest::Unrest(Random& random)
    : place{Wander{random, 0.2, 1.1}, Wander{random, 0.2, 1.1}, Wander{random, 0.2, 1.1}},
      turn{Wander{random, 0.2, 0.9}, Wander{random, 0.2, 0.9}, Wander{random, 0.2, 0.9}},
      fingers{Wander{random, 0.1, 0.8}, Wander{random, 0.1, 0.8}, Wander{random, 0.1, 0.8}, Wander{random, 0.1, 0.8},
              Wander{random, 0.1, 0.8}} {}

SpacePlan::SpacePlan(const SpaceTimeline& timeline, Random& random, float noise)
    : timeline_(timeline), noise_(noise), unrest_{Unrest(random), Unrest(random)} {
  for (const Rest rest : {Rest::belly, Rest::hips}) {
    rests_[0][static_cast<std::size_t>(rest)] = rest_of(rest);
    rests_[1][static_cast<std::size_t>(rest)] = on_the_right(rest_of(rest));
  }
  for (const Side side : kSides) pieces_[static_cast<std::size_t>(side)] = pieces_of(side);
}

std::vector<SpacePlan::Piece> SpacePlan::pieces_of(Side side) const {
  const double fps = timeline_.rate.hertz();
  std::vector<Piece> pieces;
  End now{.rest = Rest::hips};
  double at = 0;
  const auto add = [&](double until, const End& to) {
    if (until > at) pieces.push_back({.begin = at, .end = until, .from = now, .to = to});
    at = std::max(at, until);
    now = to;
  };
  const PlacedAimed* before = nullptr;
  for (std::size_t i = 0; i < timeline_.signs.size(); ++i) {
    const PlacedAimed& sign = timeline_.signs[i];
    const bool last = i + 1 == timeline_.signs.size();
    const auto stroke_begin = static_cast<double>(sign.placed.stroke_begin);
    if (acts(aimed_sign(sign.aimed->gloss), side)) {
      const bool neighbour = i > 0 && before == &timeline_.signs[i - 1] && before->placed.end == sign.placed.begin;
      if (!neighbour) {
        if (now.sign != nullptr) add(at + kReturns * fps, {.rest = Rest::belly});
        add(std::max(at, stroke_begin - kLeavesRest * fps), now);
      }
      add(stroke_begin, {.sign = &sign});
      add(static_cast<double>(sign.placed.stroke_end), {.sign = &sign, .stroke = 1});
      before = &sign;
    }
    if (last) {
      add(std::max(at + kReturns * fps, static_cast<double>(sign.placed.end)), {.rest = Rest::hips});
    } else if (timeline_.signs[i + 1].placed.begin > sign.placed.end && now.sign != nullptr) {
      add(std::max(at + 0.65 * fps, static_cast<double>(before == &sign ? sign.placed.end : 0)), {.rest = Rest::belly});
    }
  }
  add(static_cast<double>(timeline_.frames), now);
  return pieces;
}

const SpacePlan::Piece& SpacePlan::piece_at(Side side, double frame) const {
  const std::vector<Piece>& pieces = pieces_[static_cast<std::size_t>(side)];
  const auto after = std::upper_bound(pieces.begin(), pieces.end(), frame,
                                      [](double value, const Piece& piece) { return value < piece.begin; });
  return after == pieces.begin() ? pieces.front() : *(after - 1);
}

SpacePlan::Posture SpacePlan::posture(const End& end, Side side, float done) const {
  if (end.sign == nullptr) {
    return {rests_[static_cast<std::size_t>(side)][static_cast<std::size_t>(end.rest)], Handshape::relaxed};
  }
  return {noisy_hand(*end.sign, side, done), handshape_of(aimed_sign(end.sign->aimed->gloss), side, end.stroke)};
}

AimedHand SpacePlan::hand_in(const Piece& piece, Side side, float done) const {
  if (piece.is_stroke()) return noisy_hand(*piece.from.sign, side, done);
  return between(posture(piece.from, side, static_cast<float>(piece.from.stroke)).hand,
                 posture(piece.to, side, static_cast<float>(piece.to.stroke)).hand, side, done);
}

SignerHand SpacePlan::at(Side side, double frame) const {
  const Piece& piece = piece_at(side, frame);
  const double time = std::clamp((frame - piece.begin) / (piece.end - piece.begin), 0.0, 1.0);
  const AimedHand hand = hand_in(piece, side, eased(time));
  const Unrest& unrest = unrest_[static_cast<std::size_t>(side)];
  const double seconds = frame / timeline_.rate.hertz();
  SignerHand wanted{.palm = hand.palm, .hand = hand.hand, .swivel = hand.swivel};
  Vector3f turned;
  for (std::size_t i = 0; i < 3; ++i) {
    const auto k = static_cast<Eigen::Index>(i);
    wanted.palm[k] += noise_ * 0.0006f * static_cast<float>(unrest.place[i].at(seconds));
    turned[k] = noise_ * 0.0040f * static_cast<float>(unrest.turn[i].at(seconds));
  }
  if (turned.norm() > 0) wanted.hand = turn(static_cast<double>(turned.norm()), turned.normalized()) * wanted.hand;
  // A handshape is complete slightly before the stroke.
  const double shape_end = !piece.is_stroke() && piece.to.sign != nullptr ? 0.94 : 1;
  wanted.fingers = blend(angles_of(posture(piece.from, side, 0).shape), angles_of(posture(piece.to, side, 1).shape),
                         static_cast<float>(std::min(1.0, time / shape_end)));
  for (std::size_t finger = 0; finger < kFingers; ++finger) {
    const auto bend = static_cast<float>(static_cast<double>(noise_) * 0.6 * unrest.fingers[finger].at(seconds));
    wanted.fingers[finger][finger == 0 ? 2 : 0] += bend;
    wanted.fingers[finger][finger == 0 ? 3 : 1] += 0.6f * bend;
    wanted.fingers[finger][finger == 0 ? 0 : 2] += 0.3f * bend;
    for (std::size_t i = 0; i < kFingerAngles; ++i) {
      const AngleLimits limits = limits_of(static_cast<int>(finger), static_cast<int>(i));
      wanted.fingers[finger][i] = std::clamp(wanted.fingers[finger][i], limits.least, limits.most);
    }
  }
  return wanted;
}

float SpacePlan::yaw_at(double frame) const {
  const Piece& piece = piece_at(Side::right, frame);
  const double time = std::clamp((frame - piece.begin) / (piece.end - piece.begin), 0.0, 1.0);
  const auto yaw = [](const End& end) {
    return end.sign == nullptr ? 0.0f : aimed_yaw(*end.sign->aimed, static_cast<float>(end.stroke));
  };
  return yaw(piece.from) + eased(time) * (yaw(piece.to) - yaw(piece.from));
}

std::vector<HandPlan::Touch> SpacePlan::touches() const {
  const double fps = timeline_.rate.hertz();
  std::vector<HandPlan::Touch> all;
  for (const PlacedAimed& sign : timeline_.signs) {
    if (aimed_sign(sign.aimed->gloss).aiming != Aiming::mouth) continue;
    const auto begin = static_cast<double>(sign.placed.stroke_begin);
    all.push_back({.begin = begin - 0.04 * fps, .end = begin + 0.04 * fps, .what = HandPlan::Touchable::mouth});
  }
  return all;
}

Handshape SpacePlan::handshape_at(Side side, double frame) const {
  const Piece& piece = piece_at(side, frame);
  return posture(frame < 0.5 * (piece.begin + piece.end) ? piece.from : piece.to, side, 1).shape;
}

}  // namespace signweave::demo
