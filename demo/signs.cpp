#include "demo/signs.h"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "signweave/core/error.h"

namespace signweave::demo {
namespace {

using Eigen::Vector3f;
using enum Hands;
using enum Movement;

/// Eigen's constructors are not constexpr for a table, and a literal reads better with one letter.
Vector3f v(float x, float y, float z) {
  return {x, y, z};
}

const Vector3f kUp(0, 1, 0), kDown(0, -1, 0), kForward(0, 0, 1), kBack(0, 0, -1), kIn(-1, 0, 0), kOut(1, 0, 0);

// clang-format off
// Weather first, in the order of the recording `meteo`, then the cities.
const SignShape kTable[] = {
    {.gloss = "BONJOUR", .shape = Handshape::flat, .palm = kBack, .fingers = v(-0.4f, 1, 0),
     .palm_end = v(-0.2f, 0.6f, -1), .fingers_end = v(-0.5f, 0.5f, 0.6f),
     .place = v(0.08f, 0.05f, 0.23f), .move = v(0.06f, -0.08f, 0.15f), .movement = arc, .size = 0.03f, .side = kUp},
    {.gloss = "METEO", .hands = mirrored, .shape = Handshape::spread, .palm = kForward, .fingers = v(-0.1f, 1, 0.1f),
     .place = v(0.19f, 0.02f, 0.29f), .move = v(0.01f, -0.09f, 0.03f), .movement = repeated, .times = 2},
    {.gloss = "FRANCE", .shape = Handshape::ring, .palm = kForward, .fingers = kUp,
     .place = v(0.12f, 0.06f, 0.28f), .move = v(0.10f, -0.06f, 0.04f), .movement = arc, .size = 0.05f, .side = kUp},
    {.gloss = "HIER", .shape = Handshape::thumb, .palm = kIn, .fingers = v(-0.2f, 0.8f, 0.6f),
     .place = v(0.20f, 0.06f, 0.24f), .move = v(0.04f, 0.05f, -0.12f), .movement = arc, .size = 0.04f, .side = kUp},
    {.gloss = "NORD", .shape = Handshape::index, .palm = kForward, .fingers = kUp,
     .place = v(0.19f, -0.06f, 0.30f), .move = v(0.0f, 0.18f, 0.02f)},
    {.gloss = "VENT", .hands = mirrored, .shape = Handshape::spread, .palm = kIn, .fingers = v(0, 0.35f, 1),
     .place = v(0.13f, -0.04f, 0.27f), .move = v(0.12f, 0.02f, 0.0f), .movement = repeated, .times = 2},
    {.gloss = "FORT", .hands = mirrored, .shape = Handshape::fist, .palm = v(-0.6f, 0, -1), .fingers = v(-0.2f, 1, 0.3f),
     .place = v(0.20f, -0.02f, 0.22f), .move = v(0.03f, -0.10f, 0.06f)},
    {.gloss = "SUD", .shape = Handshape::index, .palm = kDown, .fingers = v(-0.2f, -0.3f, 1),
     .place = v(0.18f, 0.02f, 0.28f), .move = v(0.02f, -0.20f, 0.04f)},
    {.gloss = "ORAGE", .hands = alternating, .shape = Handshape::claw, .palm = v(-0.2f, -1, 0.3f), .fingers = v(-0.2f, 0.2f, 1),
     .place = v(0.14f, 0.06f, 0.27f), .move = v(0.02f, -0.12f, 0.03f), .movement = repeated, .times = 2},
    {.gloss = "MONTAGNE", .hands = mirrored, .shape = Handshape::flat, .palm = v(0.5f, -1, 0), .fingers = v(-0.2f, 0.3f, 1),
     .place = v(0.07f, 0.12f, 0.24f), .move = v(0.17f, -0.18f, 0.02f), .movement = arc, .size = 0.05f, .side = kUp},
    {.gloss = "NEIGE", .hands = mirrored, .shape = Handshape::spread, .palm = kDown, .fingers = v(-0.15f, 0.1f, 1),
     .place = v(0.16f, 0.10f, 0.26f), .move = v(0.03f, -0.22f, 0.03f), .movement = flutter},
    {.gloss = "FROID", .hands = mirrored, .shape = Handshape::fist, .palm = kIn, .fingers = v(-0.1f, 0.7f, 0.7f),
     .place = v(0.11f, -0.10f, 0.22f), .move = v(0.05f, 0.0f, 0.0f), .movement = repeated, .times = 3},

    {.gloss = "ATTENTION", .shape = Handshape::index, .palm = v(-0.4f, 0, 1), .fingers = kUp,
     .place = v(0.20f, 0.03f, 0.24f), .move = v(0.0f, 0.03f, 0.11f), .movement = repeated, .times = 2},
    {.gloss = "AUJOURD'HUI", .hands = mirrored, .shape = Handshape::flat, .palm = v(-0.2f, 1, 0), .fingers = v(-0.2f, 0.15f, 1),
     .place = v(0.15f, -0.10f, 0.24f), .move = v(0.0f, -0.09f, 0.02f), .movement = repeated, .times = 2},
    {.gloss = "SIX JUILLET", .hands = on_base, .shape = Handshape::thumb, .palm = v(-0.5f, 0, -1), .fingers = v(-1, 0.4f, 0.2f),
     .place = v(0.15f, -0.04f, 0.27f), .move = v(-0.02f, 0.03f, 0.07f),
     .base = {Handshape::spread, v(-0.4f, 0, -1), v(-0.5f, 1, 0.1f), v(0.15f, -0.06f, 0.26f)}},
    {.gloss = "LE-TEMPS-PREVU", .hands = mirrored, .shape = Handshape::two, .palm = v(-0.3f, -1, 0.2f), .fingers = v(-0.1f, 0.5f, 1),
     .place = v(0.10f, 0.08f, 0.20f), .move = v(0.06f, 0.02f, 0.20f), .movement = arc, .size = 0.03f, .side = kUp},
    {.gloss = "BRETAGNE", .hands = mirrored, .shape = Handshape::flat, .palm = kIn, .fingers = v(-0.1f, 1, 0.1f),
     .place = v(0.15f, 0.10f, 0.13f), .move = v(-0.01f, 0.10f, 0.02f), .movement = repeated, .times = 2},
    {.gloss = "MATIN", .hands = on_base, .shape = Handshape::flat, .palm = kBack, .fingers = v(-1, 0.4f, 0.1f),
     .palm_end = kBack, .fingers_end = v(-0.6f, 1, 0.1f),
     .place = v(0.14f, -0.16f, 0.33f), .move = v(0.04f, 0.22f, 0.01f), .movement = arc, .size = 0.05f, .side = kForward,
     .base = {Handshape::flat, kDown, v(-1, 0, 0.2f), v(0.11f, -0.16f, 0.22f)}},
    {.gloss = "NUAGES", .hands = mirrored, .shape = Handshape::claw, .palm = v(-0.6f, -0.8f, 0.3f), .fingers = v(-0.2f, 0.5f, 1),
     .place = v(0.11f, 0.13f, 0.25f), .move = v(0.10f, 0.0f, 0.0f), .movement = circle, .size = 0.045f, .side = kOut},
    {.gloss = "APRES-MIDI", .shape = Handshape::flat, .palm = kIn, .fingers = v(0, 1, 0.3f),
     .fingers_end = v(0.1f, 0.1f, 1),
     .place = v(0.18f, 0.06f, 0.24f), .move = v(0.06f, -0.14f, 0.10f), .movement = arc, .size = 0.04f, .side = kForward},
    {.gloss = "PLUIE", .hands = mirrored, .shape = Handshape::claw, .palm = kDown, .fingers = v(-0.15f, 0.0f, 1),
     .place = v(0.14f, 0.10f, 0.25f), .move = v(0.01f, -0.17f, 0.02f), .movement = repeated, .times = 2},
    {.gloss = "DEMAIN", .shape = Handshape::thumb, .palm = kIn, .fingers = v(-0.1f, 0.8f, 0.5f),
     .place = v(0.15f, 0.06f, 0.14f), .move = v(0.03f, -0.02f, 0.22f), .movement = arc, .size = 0.05f, .side = kUp},
    {.gloss = "SOLEIL-BRILLER", .shape = Handshape::beak, .shape_end = Handshape::spread, .palm = v(-0.5f, -1, 0), .fingers = v(-0.7f, 0.2f, 0.7f),
     .place = v(0.24f, 0.20f, 0.20f), .move = v(-0.03f, -0.06f, 0.08f)},
    {.gloss = "CHAUD-SEC-FERA", .shape = Handshape::claw, .shape_end = Handshape::flat, .palm = kBack, .fingers = v(-0.9f, 0.6f, 0.1f),
     .palm_end = v(0, -0.6f, -0.8f), .fingers_end = v(-0.8f, 0.0f, 0.5f),
     .place = v(0.12f, 0.05f, 0.24f), .move = v(0.07f, -0.17f, 0.09f), .movement = arc, .size = 0.03f, .side = kForward},
    {.gloss = "NAGER", .hands = mirrored, .shape = Handshape::flat, .palm = v(0.4f, -1, 0), .fingers = v(-0.2f, 0.1f, 1),
     .place = v(0.09f, -0.05f, 0.28f), .move = v(0.09f, 0.0f, 0.0f), .movement = circle, .size = 0.05f, .side = kUp, .times = 2},
    {.gloss = "CE-SERA-LE-MOMENT", .hands = on_base, .shape = Handshape::index, .palm = v(-0.4f, -1, 0), .fingers = v(-0.8f, -0.3f, 0.6f),
     .place = v(0.12f, -0.02f, 0.24f), .move = v(-0.01f, -0.07f, 0.0f), .movement = repeated, .times = 2,
     .base = {Handshape::fist, kDown, v(-1, 0.1f, 0.5f), v(0.14f, -0.17f, 0.24f)}},
    {.gloss = "VENDREDI", .shape = Handshape::two, .palm = kForward, .fingers = kUp,
     .place = v(0.20f, 0.0f, 0.27f), .move = v(0.0f, 0.0f, 0.03f), .movement = circle, .size = 0.05f, .side = kOut},
    {.gloss = "NUIT", .hands = mirrored, .shape = Handshape::flat, .palm = kBack, .fingers = v(-0.1f, 1, 0),
     .fingers_end = v(-1, 0.8f, 0.2f),
     .place = v(0.23f, 0.06f, 0.24f), .move = v(-0.08f, -0.07f, 0.02f), .movement = arc, .size = 0.03f, .side = kForward},
    {.gloss = "EN-MER", .hands = mirrored, .shape = Handshape::flat, .palm = kDown, .fingers = v(-0.1f, 0.05f, 1),
     .place = v(0.08f, -0.14f, 0.25f), .move = v(0.20f, 0.0f, 0.06f), .movement = flutter},
    {.gloss = "BROUILLARD", .hands = alternating, .shape = Handshape::spread, .palm = v(-0.2f, 0, -1), .fingers = v(-0.6f, 1, 0.1f),
     .place = v(0.15f, 0.02f, 0.26f), .move = v(0.0f, 0.0f, 0.02f), .movement = circle, .size = 0.04f, .side = kOut},

    {.gloss = "VANNES", .shape = Handshape::two, .palm = kForward, .fingers = kUp,
     .place = v(0.19f, -0.02f, 0.28f), .move = v(0.08f, 0.0f, 0.0f), .movement = repeated, .times = 2},
    {.gloss = "MARSEILLE", .hands = on_base, .shape = Handshape::three, .palm = v(-0.2f, -1, 0), .fingers = v(-0.4f, 0.1f, 1),
     .place = v(0.12f, -0.06f, 0.22f), .move = v(0.02f, 0.02f, 0.12f), .movement = arc, .size = 0.05f, .side = kUp,
     .base = {Handshape::flat, kDown, v(-1, 0, 0.4f), v(0.12f, -0.17f, 0.24f)}},
    {.gloss = "RENNES", .shape = Handshape::horns, .palm = v(-0.3f, 0, -1), .fingers = v(-0.6f, 1, 0),
     .palm_end = v(-1, 0, -0.2f), .fingers_end = v(0, 1, 0.4f),
     .place = v(0.14f, 0.03f, 0.25f), .move = v(0.08f, 0.03f, 0.04f)},
    {.gloss = "LE MANS", .hands = mirrored, .shape = Handshape::bent, .palm = v(-1, -0.2f, 0), .fingers = v(-0.1f, 0.5f, 1),
     .place = v(0.12f, -0.06f, 0.27f), .move = v(0.02f, 0.10f, 0.0f), .movement = repeated, .times = 2},
    {.gloss = "PARIS", .hands = mirrored, .shape = Handshape::two_flat, .palm = v(-1, 0, 0.3f), .fingers = v(-0.3f, 1, 0.3f),
     .place = v(0.17f, -0.06f, 0.26f), .move = v(-0.07f, 0.14f, 0.0f)},
    {.gloss = "LYON", .shape = Handshape::corner, .palm = kForward, .fingers = v(-0.1f, 1, 0),
     .place = v(0.20f, 0.03f, 0.27f), .move = v(0.02f, -0.13f, 0.04f), .movement = arc, .size = 0.05f, .side = kOut},
    {.gloss = "BREST", .shape = Handshape::flat, .shape_end = Handshape::fist, .palm = v(-0.6f, -0.2f, 0.6f), .fingers = v(-0.2f, 1, 0.5f),
     .place = v(0.24f, 0.04f, 0.22f), .move = v(-0.10f, -0.06f, 0.08f)},
    {.gloss = "NANTES", .hands = alternating, .shape = Handshape::two_flat, .palm = kDown, .fingers = v(-0.3f, 0.1f, 1),
     .place = v(0.12f, -0.10f, 0.25f), .move = v(0.01f, 0.10f, 0.02f), .movement = repeated, .times = 2},
    {.gloss = "QUIMPER", .shape = Handshape::curve, .palm = v(-1, 0, 0.2f), .fingers = v(-0.2f, 0.8f, 0.6f),
     .place = v(0.18f, 0.06f, 0.20f), .move = v(0.02f, 0.05f, 0.08f), .movement = repeated, .times = 2},
    {.gloss = "LORIENT", .hands = on_base, .shape = Handshape::corner, .palm = v(-0.2f, -0.2f, -1), .fingers = v(-1, 0.5f, 0.2f),
     .place = v(0.17f, -0.08f, 0.28f), .move = v(-0.02f, 0.09f, 0.0f), .movement = circle, .size = 0.035f, .side = kOut,
     .base = {Handshape::fist, v(-0.3f, -1, 0), v(-0.8f, 0, 0.8f), v(0.15f, -0.19f, 0.22f)}},
    {.gloss = "BORDEAUX", .shape = Handshape::ring, .palm = v(-1, 0, 0.1f), .fingers = v(-0.1f, 0.6f, 0.8f),
     .place = v(0.16f, 0.02f, 0.20f), .move = v(0.04f, -0.08f, 0.12f), .movement = arc, .size = 0.05f, .side = kUp},
    {.gloss = "TOULOUSE", .hands = mirrored, .shape = Handshape::claw, .palm = v(-1, 0.3f, 0), .fingers = v(-0.1f, 0.5f, 1),
     .palm_end = v(-0.3f, 1, 0),
     .place = v(0.14f, -0.08f, 0.26f), .move = v(0.04f, 0.06f, 0.03f)},
    {.gloss = "LILLE", .shape = Handshape::hook, .palm = v(-0.8f, 0, 0.5f), .fingers = v(-0.2f, 1, 0.3f),
     .place = v(0.17f, 0.02f, 0.22f), .move = v(0.05f, 0.0f, 0.08f), .movement = repeated, .times = 2},
    {.gloss = "SAINT-MALO", .hands = mirrored, .shape = Handshape::curve, .palm = v(-1, 0, 0), .fingers = v(-0.2f, 0.9f, 0.5f),
     .place = v(0.12f, -0.02f, 0.26f), .move = v(0.0f, -0.12f, 0.02f)},
    {.gloss = "STRASBOURG", .shape = Handshape::three, .palm = kForward, .fingers = kUp,
     .place = v(0.16f, 0.04f, 0.27f), .move = v(0.08f, -0.02f, 0.02f), .movement = flutter},
};
// clang-format on

}  // namespace

std::span<const SignShape> sign_table() {
  return kTable;
}

const SignShape& sign_for(std::string_view gloss) {
  for (const SignShape& sign : kTable) {
    if (sign.gloss == gloss) return sign;
  }
  throw Error(ErrorCode::not_found, fmt::format("demo/signs.cpp: no sign '{}'; add a row to the table", gloss));
}

bool acts(const SignShape& sign, Side side) noexcept {
  return side == Side::right || sign.hands != one;
}

Vector3f stroke_place(const SignShape& sign, Side side, float done) {
  constexpr float kPi = std::numbers::pi_v<float>;
  if (side == Side::left && sign.hands == on_base) return sign.base.place;
  const bool behind = side == Side::left && sign.hands == alternating;
  switch (sign.movement) {
    case straight:
    case flutter:
      break;
    case arc:
      return sign.place + done * sign.move + sign.size * std::sin(kPi * done) * sign.side;
    case circle: {
      const float angle = 2 * kPi * static_cast<float>(sign.times) * done + (behind ? kPi : 0.0f);
      const Vector3f across = sign.side == kUp ? kForward : kUp;
      const Vector3f plane = sign.side == kUp ? kOut : sign.side;
      return sign.place + done * sign.move + sign.size * (std::sin(angle) * plane + std::cos(angle) * across);
    }
    case repeated: {
      const float swings = static_cast<float>(2 * sign.times - 1);
      const float away = 0.5f - 0.5f * std::cos(kPi * swings * done);
      return sign.place + (behind ? 1.0f - away : away) * sign.move;
    }
  }
  return sign.place + (behind ? 1.0f - done : done) * sign.move;
}

Vector3f to_model(const Vector3f& place, Side side) {
  // The middle of the line between the shoulder joints (signer.cpp).
  return {sign_of(side) * place.x(), 1.385f + place.y(), -0.010f + place.z()};
}

float stroke_length(const SignShape& sign, Side side) {
  constexpr int kSteps = 64;
  float length = 0;
  Vector3f before = stroke_place(sign, side, 0);
  for (int i = 1; i <= kSteps; ++i) {
    const Vector3f now = stroke_place(sign, side, static_cast<float>(i) / kSteps);
    length += (now - before).norm();
    before = now;
  }
  return length;
}

}  // namespace signweave::demo
