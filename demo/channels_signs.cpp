#include <fmt/format.h>

#include <algorithm>
#include <deque>
#include <map>

#include "demo/channels.h"
#include "signweave/core/error.h"

// Signs of the recordings `mains` and `visage` only, read like the rows of demo/signs_table.cpp. PLACEHOLDERS, invented
// to move like signing. No row describes a sign of LSF.

namespace signweave::demo {
namespace {

using Eigen::Vector3f;
using enum Movement;

Vector3f vec(float x, float y, float z) {
  return {x, y, z};
}

const Vector3f kUpward(0, 1, 0), kAhead(0, 0, 1), kBackward(0, 0, -1), kOutward(1, 0, 0);

// clang-format off
const SignShape kChannelTable[] = {
    // Held by the left hand: a region on a map, and a list whose items the right hand touches.
    {.gloss = "REGION", .hands = Hands::left, .shape = Handshape::cup, .palm = vec(-0.7f, -0.7f, 0.2f), .fingers = vec(-0.6f, 0.35f, 0.8f),
     .place = vec(0.16f, -0.04f, 0.25f), .move = vec(0.0f, -0.05f, 0.03f), .movement = arc, .size = 0.02f, .side = kAhead},
    {.gloss = "LISTE", .hands = Hands::left, .shape = Handshape::three, .palm = kBackward, .fingers = vec(-0.9f, 0.25f, 0.35f),
     .place = vec(0.19f, -0.15f, 0.24f), .move = vec(-0.03f, 0.02f, 0.02f)},
    {.gloss = "PREMIER", .shape = Handshape::index, .palm = vec(0.1f, -1, 0.2f), .fingers = vec(-0.9f, -0.1f, 0.4f),
     .place = vec(0.08f, 0.075f, 0.19f), .move = vec(-0.03f, -0.045f, 0.02f)},
    {.gloss = "DEUXIEME", .shape = Handshape::index, .palm = vec(-0.2f, -1, 0.1f), .fingers = vec(-0.75f, -0.1f, 0.65f),
     .place = vec(0.17f, 0.03f, 0.19f), .move = vec(-0.04f, -0.05f, 0.01f)},
    {.gloss = "TROISIEME", .shape = Handshape::index, .palm = vec(-0.2f, -1, 0.1f), .fingers = vec(-0.75f, 0.0f, 0.65f),
     .place = vec(0.20f, -0.045f, 0.19f), .move = vec(-0.045f, -0.02f, 0.02f)},

    // Touching the other hand, the chin, the chest.
    {.gloss = "CARTE", .hands = Hands::mirrored, .shape = Handshape::index, .palm = vec(-0.1f, -1, 0.1f), .fingers = vec(-0.8f, 0.3f, 0.5f),
     .place = vec(0.152f, 0.02f, 0.24f), .move = vec(0.10f, -0.12f, 0.01f), .movement = arc, .size = 0.04f, .side = kOutward},
    {.gloss = "SOMMET", .hands = Hands::on_base, .shape = Handshape::index, .palm = vec(-0.1f, -1, -0.3f), .fingers = vec(-0.65f, -0.3f, 0.65f),
     .place = vec(0.157f, 0.05f, 0.212f), .move = vec(-0.05f, -0.08f, 0.015f),
     .base = {Handshape::flat, vec(-0.7f, -0.5f, 0.1f), vec(-0.5f, 0.8f, 0.3f), vec(0.16f, -0.18f, 0.25f)}},
    {.gloss = "PARLER", .shape = Handshape::index, .palm = vec(-1, -0.4f, -0.5f), .fingers = vec(-0.45f, 0.8f, -0.45f),
     .fingers_end = vec(-0.5f, 0.8f, 0.3f),
     .place = vec(0.07f, 0.003f, 0.135f), .move = vec(0.05f, 0.0f, 0.11f), .movement = arc, .size = 0.02f, .side = kUpward},
    {.gloss = "MOI", .shape = Handshape::flat, .palm = kBackward, .fingers = vec(-0.95f, 0.25f, -0.2f),
     .place = vec(0.18f, -0.16f, 0.225f), .move = vec(-0.01f, 0.0f, -0.06f)},

    // Questions and answers.
    {.gloss = "PLEUVOIR", .hands = Hands::mirrored, .shape = Handshape::fan, .palm = vec(-0.2f, -0.8f, 0.6f), .fingers = vec(-0.1f, 0.7f, 0.8f),
     .place = vec(0.17f, 0.07f, 0.26f), .move = vec(0.01f, -0.16f, 0.03f), .movement = repeated, .times = 2},
    {.gloss = "OU", .hands = Hands::mirrored, .shape = Handshape::spread, .palm = vec(-0.2f, 1, 0.1f), .fingers = vec(-0.1f, 0.1f, 1),
     .place = vec(0.18f, -0.10f, 0.24f), .move = vec(0.03f, 0.0f, 0.0f), .movement = circle, .size = 0.03f, .side = kUpward},
    {.gloss = "QUAND", .shape = Handshape::corner, .palm = vec(-0.5f, 0, 0.8f), .fingers = vec(-0.1f, 1, 0.3f),
     .place = vec(0.18f, 0.03f, 0.25f), .move = vec(0.02f, -0.02f, 0.01f), .movement = twist, .times = 2},
    {.gloss = "NON", .shape = Handshape::index, .palm = vec(-0.3f, 0, 1), .fingers = vec(-0.1f, 1, 0.1f),
     .place = vec(0.19f, 0.02f, 0.26f), .move = vec(0.02f, 0.0f, 0.02f), .movement = zigzag, .size = 0.03f, .side = kOutward, .times = 2},
    {.gloss = "OUI", .shape = Handshape::fist, .palm = vec(-0.4f, -0.2f, 0.9f), .fingers = vec(-0.1f, 1, 0.4f),
     .place = vec(0.19f, -0.01f, 0.26f), .move = vec(0.01f, -0.03f, 0.02f), .movement = nod, .times = 2},
};
// clang-format on

constexpr SignTouch kTouches[] = {
    {"CARTE", false, 1, HandPlan::Touchable::fingertip, 1},    {"SOMMET", true, 1, HandPlan::Touchable::fingertip, 2},
    {"PARLER", false, 1, HandPlan::Touchable::chin},           {"MOI", true, 2, HandPlan::Touchable::chest},
    {"PREMIER", true, 1, HandPlan::Touchable::fingertip, 0},   {"DEUXIEME", true, 1, HandPlan::Touchable::fingertip, 1},
    {"TROISIEME", true, 1, HandPlan::Touchable::fingertip, 2},
};

const SignShape& described(std::string_view gloss) {
  const auto row = std::find_if(std::begin(kChannelTable), std::end(kChannelTable),
                                [&](const SignShape& sign) { return sign.gloss == gloss; });
  return row != std::end(kChannelTable) ? *row : sign_for(gloss);
}

std::map<std::pair<std::string_view, Side>, SignShape> all_signs() {
  std::map<std::pair<std::string_view, Side>, SignShape> signs;
  const auto add = [&](const SignShape& row) {
    for (const Side side : kSides) {
      SignShape sign = row;
      sign.face = {};
      if (sign.hands == Hands::one && side == Side::left) sign.hands = Hands::left;
      signs.emplace(std::pair(row.gloss, side), sign);
    }
  };
  for (const SignShape& row : kChannelTable) add(row);
  for (const SignShape& row : sign_table()) add(row);
  return signs;
}

}  // namespace

std::span<const SignShape> channel_sign_table() {
  return kChannelTable;
}

std::span<const SignTouch> channel_touches() {
  return kTouches;
}

const SignShape& channel_sign(std::string_view gloss, Side hand) {
  static const std::map<std::pair<std::string_view, Side>, SignShape> signs = all_signs();
  const auto sign = signs.find({described(gloss).gloss, hand});
  return sign->second;
}

}  // namespace signweave::demo
