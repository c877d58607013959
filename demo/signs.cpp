#include "demo/signs.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "signweave/core/error.h"

namespace signweave::demo {
namespace {

using Eigen::Vector3f;
using enum Hands;
using enum Movement;

constexpr float kPi = std::numbers::pi_v<float>;

/// Back and forth: 0 at the begin, 1 at the end, each return slightly shorter than the movement out.
float swings(int times, float shortened, float done) {
  const float at = std::min(done, 1.0f) * static_cast<float>(2 * times - 1);
  const float away = 0.5f - 0.5f * std::cos(kPi * at);
  return at < 1 ? away : 1 - (1 - away) * shortened;
}

}  // namespace

const SignShape& sign_for(std::string_view gloss) {
  for (const SignShape& sign : sign_table()) {
    if (sign.gloss == gloss) return sign;
  }
  throw Error(ErrorCode::not_found, fmt::format("demo/signs_table.cpp: no sign '{}'; add a row to the table", gloss));
}

bool acts(const SignShape& sign, Side side) noexcept {
  if (sign.hands == Hands::left) return side == Side::left;
  return side == Side::right || sign.hands != one;
}

int times_of(const SignShape& sign, const Token& token) noexcept {
  return std::max(sign.times > 1 ? 2 : 1, sign.times - token.fewer);
}

Vector3f stroke_place(const SignShape& sign, Side side, float done, const Token& token) {
  if (side == Side::left && sign.hands == on_base) {
    return sign.base.place + Vector3f(-token.shift.x(), token.shift.y(), token.shift.z());  // both hands to one side
  }
  const bool behind = side == Side::left && sign.hands == alternating;
  const float size = token.size * (side == Side::left ? token.other_size : 1.0f);
  // Scaled about the middle of the movement, so that neither end moves far.
  const Vector3f move = size * sign.move;
  const Vector3f place = sign.place + 0.5f * (sign.move - move) + token.shift;
  const float along = behind ? 1.0f - done : done;
  const auto times = static_cast<float>(times_of(sign, token));
  switch (sign.movement) {
    case straight:
    case flutter:
    case twist:
    case nod:
      break;
    case arc:
      return place + done * move + size * sign.size * std::sin(kPi * done) * sign.side;
    case zigzag:
      return place + along * move + (size * token.small * sign.size * std::sin(2 * kPi * times * done)) * sign.side;
    case circle: {
      const float angle = 2 * kPi * times * done + (behind ? kPi : 0.0f);
      const bool level = sign.side == Vector3f::UnitY();
      const Vector3f across = level ? Vector3f::UnitZ() : Vector3f::UnitY();
      const Vector3f plane = level ? Vector3f::UnitX() : sign.side;
      return place + done * move +
             (size * token.small * sign.size) * (std::sin(angle) * plane + std::cos(angle) * across);
    }
    case repeated: {
      const float away = swings(times_of(sign, token), 0.86f * token.small, done);
      return place + (behind ? 1.0f - away : away) * move;
    }
  }
  return place + along * move;
}

Vector3f to_model(const Vector3f& place, Side side) {
  // The middle of the line between the shoulder joints (signer.cpp).
  return {sign_of(side) * place.x(), 1.385f + place.y(), -0.010f + place.z()};
}

float stroke_length(const SignShape& sign, Side side, const Token& token) {
  constexpr int kSteps = 64;
  float length = 0;
  Vector3f before = stroke_place(sign, side, 0, token);
  for (int i = 1; i <= kSteps; ++i) {
    const Vector3f now = stroke_place(sign, side, static_cast<float>(i) / kSteps, token);
    length += (now - before).norm();
    before = now;
  }
  return length;
}

bool within_reach(const SignShape& sign, const Token& token) {
  for (const Side side : kSides) {
    if (!acts(sign, side)) continue;
    for (int i = 0; i <= 20; ++i) {
      const Vector3f place = stroke_place(sign, side, 0.05f * static_cast<float>(i), token);
      if ((place - Vector3f(0.175f, 0, 0)).norm() > 0.50f || place.z() < 0.115f || place.x() < 0.025f) return false;
    }
  }
  return true;
}

}  // namespace signweave::demo
