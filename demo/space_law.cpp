#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <numbers>

#include "demo/arms.h"
#include "demo/space.h"
#include "signweave/core/error.h"

// The law of docs/demo.md. Everything is computed for the right hand; the left one is its mirror image.

namespace signweave::demo {
namespace {

using Eigen::Matrix3f;
using Eigen::Quaternionf;
using Eigen::Vector3f;

constexpr float kDegree = std::numbers::pi_v<float> / 180;
constexpr float kPi = std::numbers::pi_v<float>;

// Places, metres.
const Vector3f kShoulder(-0.5f * kShoulderWidth, 0, 0);
const Vector3f kSelf(-0.05f, -0.15f, 0.235f);      ///< of a palm at the signer's chest
const Vector3f kSelfOfBoth(0, -0.15f, 0.26f);      ///< of the middle of both
const Vector3f kAtMouth(-0.012f, 0.133f, 0.101f);  ///< of the tip of a finger that touches the mouth
constexpr float kReach = 0.46f;                    ///< a palm's distance from the shoulder tends to this
constexpr float kDrop = 0.13f;                     ///< a palm is lower than the line to its locus
constexpr float kNearest = 0.19f;                  ///< in front of the shoulders
constexpr float kSoft = 0.04f;

Vector3f in_mirror(const Vector3f& v) {
  return {-v.x(), v.y(), v.z()};
}

Quaternionf about_y(float radians) {
  return turn(static_cast<double>(radians), Vector3f::UnitY());
}

/// Turns a hand with fingers forward and palm down.
Quaternionf hand_of(const Vector3f& palm, const Vector3f& fingers) {
  Matrix3f axes;
  axes.col(2) = fingers.normalized();
  axes.col(1) = -(palm - palm.dot(axes.col(2)) * axes.col(2)).normalized();
  axes.col(0) = axes.col(1).cross(axes.col(2));
  return Quaternionf(axes).normalized();
}

/// 0 far below the middle, 1 far above it.
float rising(float value, float middle, float width) {
  return 1 / (1 + std::exp((middle - value) / width));
}

/// Keeps a palm in front of the body, smoothly; beside it, on the hand's own side, the palm may be farther back by that
/// share of the distance.
Vector3f in_front(Vector3f place, float back_next_to = 0.45f) {
  const float nearest = kNearest * (1 - back_next_to * rising(-place.x(), 0.30f, 0.04f));
  place.z() = nearest + kSoft * std::log1p(std::exp((place.z() - nearest) / kSoft));
  return place;
}

float saturated(float distance, float most) {
  return most * std::tanh(distance / most);
}

/// The palm of the right hand at a locus.
Vector3f place_at(const Locus& locus) {
  if (locus.self) return kSelf;
  const Vector3f line = point_of(locus) - kShoulder;
  return in_front(kShoulder + saturated(line.norm(), kReach) * line.normalized() - kDrop * Vector3f::UnitY());
}

/// The middle of both hands at a locus; they reach less far aside.
Vector3f place_of_both(const Locus& locus, float widest_degrees) {
  if (locus.self) return kSelfOfBoth;
  const float widest = widest_degrees * kDegree;
  const float azimuth = widest * std::tanh(locus.azimuth * kDegree / widest);
  const float distance = saturated(locus.distance * kShoulderWidth, 0.36f);
  const Vector3f direction =
      about_y(azimuth) * Vector3f(0, std::sin(locus.elevation * kDegree), std::cos(locus.elevation * kDegree));
  return in_front(distance * direction - kDrop * Vector3f::UnitY());
}

/// Azimuth of a place as seen from the right shoulder.
float azimuth_from_shoulder(const Vector3f& place) {
  return std::atan2(place.x() - kShoulder.x(), place.z());
}

/// The elbow rises when the hand crosses to the other side, or goes far to its own.
float swivel_at(const Vector3f& palm) {
  const float azimuth = azimuth_from_shoulder(palm) / kDegree;
  return 0.10f + 0.45f * rising(azimuth, 5, 14) + 0.18f * rising(-azimuth, 40, 10);
}

/// Yaw of a hand that moves into a direction: a right hand turns far to the left, little to the right, and aside when
/// it comes back to the signer.
float yaw_along(const Vector3f& move) {
  const float direction = std::atan2(move.x(), move.z());
  return (42.5f - 37.5f * std::cos(direction) + 42 * std::sin(direction)) * kDegree;
}

float grown(float distance) {
  return 1 - std::exp(-distance / 0.25f);
}

/// On a path that bulges up and away from the body, the more the longer it is.
Vector3f along(const Vector3f& from, const Vector3f& to, float height, float done) {
  const float much = grown((to - from).norm()) * std::sin(kPi * done);
  return from + done * (to - from) + much * Vector3f(0, height, 0.05f);
}

/// The index finger of the hand in the shape `index`, in a hand with fingers forward and palm down.
struct IndexFinger {
  Vector3f knuckle;    ///< from the centre of the palm
  Vector3f direction;  ///< from knuckle to tip
  float length = 0;
};
const IndexFinger& index_finger();

ArmSizes arm_sizes() {
  static const ArmSizes sizes = [] {
    const Signer signer = make_signer();
    return ArmSizes{signer.skeleton->joint(signer.left.fore_arm).offset.norm(),
                    signer.skeleton->joint(signer.left.hand).offset.norm()};
  }();
  return sizes;
}

/// From the right wrist to the centre of the palm, in a hand with fingers forward and palm down.
Vector3f palm_from_wrist() {
  static const Vector3f offset = [] {
    const Signer signer = make_signer();
    return in_mirror(hand_from_wrist() * (0.5f * signer.skeleton->joint(signer.left.fingers[2][0]).offset));
  }();
  return offset;
}

/// The direction of the right forearm for a palm and a hand.
Vector3f fore_arm_of(const Vector3f& palm, const Quaternionf& hand, float swivel) {
  const Vector3f wrist = in_mirror(palm - hand * palm_from_wrist());
  const WristAngles elbow{.swivel = swivel};
  const ArmPose pose = solve_arm(in_mirror(kShoulder), wrist, arm_sizes(), elbow);
  return in_mirror(pose.wrist - pose.elbow).normalized();
}

float eased_to(float angle, float middle, float most) {
  return (middle + most * std::tanh((angle / kDegree - middle) / most)) * kDegree;
}

/// The orientation that the wrist can follow comfortably: each of its angles is saturated. `palm` is fixed.
Quaternionf comfortable(const Vector3f& palm, const Quaternionf& wanted, float swivel) {
  Quaternionf hand = wanted;
  for (int round = 0; round < 4; ++round) {  // the wrist turns about the palm, and the forearm goes with it
    const Vector3f wrist = in_mirror(palm - hand * palm_from_wrist());
    const WristAngles elbow{.swivel = swivel};
    const Quaternionf fore_arm = solve_arm(in_mirror(kShoulder), wrist, arm_sizes(), elbow).fore_arm;
    const Quaternionf left = demo::mirrored(wanted) * hand_from_wrist();
    WristAngles angles = wrist_angles(fore_arm.conjugate() * left);
    angles.twist = eased_to(angles.twist, -5, 72);
    angles.flexion = eased_to(angles.flexion, 0, 50);
    angles.radial = eased_to(angles.radial, -7, 22);
    angles.swivel = swivel;
    const Quaternionf followed = solve_arm(in_mirror(kShoulder), wrist, arm_sizes(), angles).hand;
    hand = demo::mirrored(Quaternionf(followed * hand_from_wrist().conjugate()));
  }
  return hand.normalized();
}

AimedHand hand_on_path(const AimedSign& sign, const Vector3f& from, const Vector3f& to, float done) {
  AimedHand hand;
  hand.palm = along(from, to, sign.height, done);
  const float follow = azimuth_from_shoulder(from) + done * (azimuth_from_shoulder(to) - azimuth_from_shoulder(from));
  hand.hand = about_y(yaw_along(to - from) + 0.35f * follow) * hand_of(sign.palm, sign.fingers);
  return hand;
}

AimedHand hand_pointing(const AimedSign& sign, const Locus& locus, float done) {
  const Vector3f target = point_of(locus);
  const Vector3f line = target - kShoulder;
  // The tip stays in front of the locus; a preparation draws the hand back.
  const float reach = saturated(line.norm() - 0.13f, kReach) * (0.90f + 0.10f * done);
  AimedHand hand;
  hand.palm = in_front(kShoulder + reach * line.normalized() - 0.6f * kDrop * Vector3f::UnitY(), 0.9f);
  const float swivel = swivel_at(hand.palm);
  Vector3f direction = (target - hand.palm).normalized();
  hand.hand = hand_of(sign.palm, direction);
  for (int round = 0; round < 12; ++round) {  // the knuckle, from which the finger points, turns with the hand
    // The palm faces to the side to which the wrist bends.
    const Vector3f bend = direction - fore_arm_of(hand.palm, hand.hand, swivel);
    const Quaternionf base =
        round < 6 ? comfortable(hand.palm, hand_of(0.35f * sign.palm + bend, direction), swivel) : hand.hand;
    direction = (target - hand.palm - base * index_finger().knuckle).normalized();
    const Vector3f now = base * index_finger().direction;
    hand.hand = (Quaternionf::FromTwoVectors(now, direction) * base).normalized();
  }
  return hand;
}

AimedHand hand_facing(const AimedSign& sign, const Locus& locus, float done) {
  const Vector3f there = place_at(locus);
  AimedHand hand;
  hand.palm = in_front(kShoulder + (0.80f + 0.08f * done) * (there - kShoulder) + Vector3f(0, 0.07f, 0));
  const float azimuth = azimuth_from_shoulder(hand.palm);
  const float shake = std::sin(6 * kPi * done) * std::sin(kPi * done);
  hand.palm += 0.035f * shake * (about_y(azimuth) * Vector3f::UnitX());
  hand.hand = about_y(0.85f * azimuth) * hand_of(sign.palm, sign.fingers);
  return hand;
}

AimedHand hand_from_mouth(const AimedSign& sign, const Locus& locus, float done) {
  const Quaternionf begin = hand_of({1, -0.4f, -0.5f}, {0.45f, 0.8f, -0.45f});
  const Vector3f from = kAtMouth - begin * (index_finger().knuckle + index_finger().length * index_finger().direction);
  const Vector3f to = place_at(locus);
  AimedHand hand;
  hand.palm = along(from, to, sign.height, done);
  hand.hand = begin.slerp(
      done, about_y(yaw_along(to - from) + 0.35f * azimuth_from_shoulder(to)) * hand_of(sign.palm, sign.fingers));
  return hand;
}

/// The right hand of two that are rigid to each other.
AimedHand hand_together(const AimedSign& sign, const Aimed& aimed, float done) {
  constexpr float kWidest = 45;
  const Vector3f from = place_of_both(*aimed.from, kWidest);
  const Vector3f to = place_of_both(*aimed.to, kWidest);
  AimedHand hand;
  hand.palm = along(from, to, sign.height, done) + Vector3f(0, 0.04f, 0);
  hand.hand = about_y(0.8f * std::atan2(hand.palm.x(), hand.palm.z() + 0.15f)) * hand_of(sign.palm, sign.fingers);
  return hand;
}

/// The left hand below it.
AimedHand hand_below(const AimedHand& right, const AimedSign& sign) {
  const Quaternionf pair = right.hand * hand_of(sign.palm, sign.fingers).conjugate();
  AimedHand hand;
  hand.palm = right.palm + pair * Vector3f(0.01f, -0.103f, 0.01f);
  hand.hand = pair * hand_of({-0.45f, 0.9f, -0.15f}, {-0.7f, 0.05f, 0.7f});
  return hand;
}

/// The locus from which the right hand of a meeting comes: the one farther to the right. The signer's own is on the
/// other side.
bool right_from_subject(const Aimed& aimed) {
  if (aimed.from->self) return aimed.to->azimuth > 0;
  if (aimed.to->self) return aimed.from->azimuth <= 0;
  return aimed.from->azimuth <= aimed.to->azimuth;
}

AimedHand hand_meeting(const AimedSign& sign, const Aimed& aimed, Side side, float done) {
  const bool subject = right_from_subject(aimed);
  constexpr float kWidest = 60;
  const Vector3f right = place_of_both(subject ? *aimed.from : *aimed.to, kWidest) + Vector3f(-0.10f, 0, 0);
  const Vector3f left = place_of_both(subject ? *aimed.to : *aimed.from, kWidest) + Vector3f(0.10f, 0, 0);
  Vector3f middle = 0.5f * (right + left);
  middle.x() = 0.16f * std::tanh(middle.x() / 0.16f);
  // Across, so that the palms face each other.
  const Vector3f half = about_y(0.4f * std::atan2(middle.x(), middle.z())) * Vector3f(0.084f, 0, 0);
  const Vector3f from = side == Side::right ? right : in_mirror(left);
  const Vector3f to = side == Side::right ? Vector3f(middle - half) : in_mirror(middle + half);
  AimedHand hand;
  hand.palm = along(from, to, sign.height, done);
  hand.hand = about_y(0.4f * azimuth_from_shoulder(hand.palm)) * hand_of(sign.palm, sign.fingers);
  return hand;
}

AimedHand hand_crossing(const AimedSign& sign, const Aimed& aimed, Side side, float done) {
  constexpr float kWidest = 28;
  const Vector3f subject = place_of_both(*aimed.from, kWidest);
  const Vector3f object = place_of_both(*aimed.to, kWidest);
  const float over = (0.055f + 0.02f * std::sin(kPi * done)) * (side == Side::right ? 1.0f : -1.0f);
  const Vector3f from = side == Side::right ? subject : in_mirror(object);
  const Vector3f to = side == Side::right ? object : in_mirror(subject);
  AimedHand hand;
  hand.palm = along(from, to, 0, done) + Vector3f(0, over, 0);
  hand.hand = about_y(0.45f * azimuth_from_shoulder(hand.palm)) * hand_of(sign.palm, sign.fingers);
  return hand;
}

IndexFinger measure_index_finger() {
  const Signer signer = make_signer();
  const FingerRotations fingers = finger_rotations(angles_of(Handshape::index), Side::left);
  const auto offset = [&](std::size_t i) { return signer.skeleton->joint(signer.left.fingers[1][i]).offset; };
  const Vector3f middle = signer.skeleton->joint(signer.left.fingers[2][0]).offset;
  const Vector3f knuckle = offset(0);
  const Quaternionf q0 = fingers[1][0];
  const Quaternionf q1 = q0 * fingers[1][1];
  const Vector3f tip = q0 * offset(1) + q1 * offset(2) + q1 * fingers[1][2] * signer.finger_tip(1);
  const Quaternionf to_hand = hand_from_wrist();
  const auto as_right = [&](const Vector3f& v) { return in_mirror(to_hand * v); };
  return {as_right(knuckle - 0.5f * middle), as_right(tip.normalized()), tip.norm()};
}

const IndexFinger& index_finger() {
  static const IndexFinger finger = measure_index_finger();
  return finger;
}

AimedHand right_hand(const AimedSign& sign, const Aimed& aimed, float done) {
  switch (sign.aiming) {
    case Aiming::pointing:
      return hand_pointing(sign, *aimed.at, done);
    case Aiming::forward:
      return hand_on_path(sign, place_at(*aimed.from), place_at(*aimed.to), done);
    case Aiming::backward:
      return hand_on_path(sign, place_at(*aimed.to), place_at(*aimed.from), done);
    case Aiming::mouth:
      return hand_from_mouth(sign, *aimed.to, done);
    case Aiming::facing:
      return hand_facing(sign, *aimed.to, done);
    case Aiming::together:
      return hand_together(sign, aimed, done);
    case Aiming::meeting:
      return hand_meeting(sign, aimed, Side::right, done);
    case Aiming::crossing:
      return hand_crossing(sign, aimed, Side::right, done);
  }
  return {};
}

AimedHand in_mirror(AimedHand hand) {
  hand.palm = in_mirror(hand.palm);
  hand.hand = demo::mirrored(hand.hand);
  return hand;
}

/// Yaw of the chest for a locus: nothing up to 30°, then up to 15°.
float yaw_for(const Locus& locus) {
  if (locus.self) return 0;
  const float beyond = std::max(0.0f, std::abs(locus.azimuth) - 30) / 25;
  return std::copysign(15 * kDegree * (1 - std::exp(-beyond * beyond)), locus.azimuth);
}

float number(std::string_view text, std::string_view whole) {
  float value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size() || !std::isfinite(value)) {
    throw Error(ErrorCode::bad_input,
                fmt::format("locus '{}': '{}' is no number; write AZIMUTH/ELEVATION/DISTANCE", whole, text));
  }
  return value;
}

}  // namespace

Locus locus_of(std::string_view text) {
  Locus locus{.text = std::string(text), .distance = 1.2f};
  if (text == "left") {
    locus.azimuth = 45;
  } else if (text == "right") {
    locus.azimuth = -45;
  } else if (text == "addressee") {
    locus.elevation = 5;
    locus.distance = 3;
  } else if (text == "self") {
    locus = {.text = "self", .self = true, .elevation = -45, .distance = 0.5f};
  } else if (text != "front") {
    const std::size_t first = text.find('/');
    const std::size_t second = first == std::string_view::npos ? first : text.find('/', first + 1);
    if (second == std::string_view::npos) {
      throw Error(ErrorCode::bad_input,
                  fmt::format("locus '{}' is unknown; take left, right, front, self, addressee or "
                              "AZIMUTH/ELEVATION/DISTANCE",
                              text));
    }
    locus.azimuth = number(text.substr(0, first), text);
    locus.elevation = number(text.substr(first + 1, second - first - 1), text);
    locus.distance = number(text.substr(second + 1), text);
  }
  return locus;
}

Vector3f point_of(const Locus& locus) {
  const float up = locus.elevation * kDegree;
  return locus.distance * kShoulderWidth * (about_y(locus.azimuth * kDegree) * Vector3f(0, std::sin(up), std::cos(up)));
}

std::string angles_text(const Locus& locus) {
  return fmt::format("{:g}/{:g}/{:g}", locus.azimuth, locus.elevation, locus.distance);
}

AimedHand aimed_hand(const Aimed& aimed, Side side, float done) {
  const AimedSign& sign = aimed_sign(aimed.gloss);
  AimedHand hand;
  if (side == Side::right) {
    hand = right_hand(sign, aimed, done);
    hand.swivel = swivel_at(hand.palm);
    if (sign.aiming != Aiming::pointing) hand.hand = comfortable(hand.palm, hand.hand, hand.swivel);
    return hand;
  }
  if (sign.aiming == Aiming::together) {
    hand = hand_below(aimed_hand(aimed, Side::right, done), sign);
    hand.swivel = swivel_at(in_mirror(hand.palm));
    return hand;
  }
  hand =
      sign.aiming == Aiming::meeting ? hand_meeting(sign, aimed, side, done) : hand_crossing(sign, aimed, side, done);
  hand.swivel = swivel_at(hand.palm);
  hand.hand = comfortable(hand.palm, hand.hand, hand.swivel);
  return in_mirror(hand);
}

WristAngles wrist_of(const AimedHand& hand, Side side) {
  const AimedHand left = side == Side::left ? hand : in_mirror(hand);
  const Quaternionf turned = left.hand * hand_from_wrist();
  const Vector3f wrist = left.palm - left.hand * in_mirror(palm_from_wrist());
  const WristAngles elbow{.swivel = hand.swivel};
  const Quaternionf fore_arm = solve_arm(in_mirror(kShoulder), wrist, arm_sizes(), elbow).fore_arm;
  WristAngles angles = wrist_angles(fore_arm.conjugate() * turned);
  angles.swivel = hand.swivel;
  return angles;
}

AimedHand with_wrist(const AimedHand& hand, const WristAngles& angles, Side side) {
  AimedHand left = side == Side::left ? hand : in_mirror(hand);
  for (int round = 0; round < 5; ++round) {  // the wrist turns about the palm, and the forearm goes with it
    const Vector3f wrist = left.palm - left.hand * in_mirror(palm_from_wrist());
    const Quaternionf turned = solve_arm(in_mirror(kShoulder), wrist, arm_sizes(), angles).hand;
    left.hand = (turned * hand_from_wrist().conjugate()).normalized();
  }
  left.swivel = angles.swivel;
  return side == Side::left ? left : in_mirror(left);
}

float aimed_yaw(const Aimed& aimed, float done) {
  const AimedSign& sign = aimed_sign(aimed.gloss);
  const auto of = [](const std::optional<Locus>& locus) { return locus ? yaw_for(*locus) : 0.0f; };
  float from = of(aimed.from);
  float to = of(aimed.to);
  if (aimed.at) from = to = of(aimed.at);
  if (sign.aiming == Aiming::facing) from = to;
  if (sign.aiming == Aiming::backward) std::swap(from, to);
  if (sign.aiming == Aiming::meeting || sign.aiming == Aiming::crossing) from = to = 0.5f * (from + to);
  return from + done * (to - from);
}

AimedHand noisy_hand(const PlacedAimed& sign, Side side, float done) {
  const AimedNoise& noise = sign.noise[static_cast<std::size_t>(side)];
  AimedHand hand = aimed_hand(*sign.aimed, side, done);
  const float angle = noise.turn.norm();
  const Quaternionf turned = angle > 0 ? turn(static_cast<double>(angle), noise.turn / angle) : Quaternionf::Identity();
  hand.hand = (turned * hand.hand).normalized();
  if (aimed_sign(sign.aimed->gloss).aiming == Aiming::together) {
    const Vector3f pivot = aimed_hand(*sign.aimed, Side::right, done).palm;
    hand.palm = pivot + turned * (hand.palm - pivot);
  }
  hand.palm += noise.shift;
  return hand;
}

}  // namespace signweave::demo
