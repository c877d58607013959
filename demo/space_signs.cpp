#include <fmt/format.h>

#include <map>

#include "demo/space.h"
#include "signweave/core/error.h"

// Signs of the recordings `espace_…` only. PLACEHOLDERS, invented to move like signing: the glosses name verbs of their
// kind, but no row describes a sign of LSF.

namespace signweave::demo {
namespace {

using Eigen::Vector3f;
using enum Aiming;

Vector3f vec(float x, float y, float z) {
  return {x, y, z};
}

// clang-format off
const AimedSign kSigns[] = {
    {"INDEX", pointing, Handshape::index, {}, {}, vec(0.2f, -1, 0), vec(0, 0, 1), 0},
    {"DONNER", forward, Handshape::bill, {}, {}, vec(0.75f, 0.55f, 0), vec(0, 0.1f, 1), 0.05f},
    {"ENVOYER", forward, Handshape::fist, Handshape::spread, {}, vec(0.15f, -1, 0.1f), vec(0, 0.2f, 1), 0.08f},
    {"MONTRER", forward, Handshape::two_flat, {}, {}, vec(0.9f, 0.1f, 0.1f), vec(0, 0.3f, 1), 0.02f},
    {"DIRE", mouth, Handshape::index, {}, {}, vec(0.5f, -0.8f, 0), vec(0, 0.25f, 1), 0.03f},
    {"AIDER", together, Handshape::thumb, {}, Handshape::flat, vec(1, 0, 0), vec(0.1f, 0.1f, 1), 0.03f},
    {"INVITER", backward, Handshape::flat, {}, {}, vec(0.65f, 0.65f, 0), vec(0, 0.1f, 1), -0.04f},
    {"PRENDRE", backward, Handshape::claw, Handshape::fist, {}, vec(0.3f, -0.95f, 0), vec(0, 0.1f, 1), 0.05f},
    {"COPIER", backward, Handshape::fan, Handshape::beak, {}, vec(0.2f, -0.7f, 0.6f), vec(0, 0.6f, 1), 0.03f},
    {"CHOISIR", backward, Handshape::corner_low, Handshape::pinch, {}, vec(0.5f, -0.8f, 0.2f), vec(0, 0.25f, 1), 0.06f},
    {"GRONDER", facing, Handshape::index, {}, {}, vec(0.5f, 0, 0.9f), vec(0, 1, 0.25f), 0},
    {"RENCONTRER", meeting, Handshape::index, {}, {}, vec(0.9f, 0, 0.3f), vec(0, 1, 0.35f), 0.02f},
    {"ECHANGER", crossing, Handshape::flat, {}, {}, vec(0.8f, 0.45f, 0), vec(0, 0.15f, 1), 0},
};
// clang-format on

std::map<std::string_view, SignShape> all_shapes() {
  std::map<std::string_view, SignShape> shapes;
  for (const AimedSign& sign : kSigns) {
    SignShape shape{.gloss = sign.gloss,
                    .shape = sign.shape,
                    .shape_end = sign.shape_end,
                    .palm = sign.palm,
                    .fingers = sign.fingers,
                    .place = vec(0.15f, -0.10f, 0.30f),
                    .move = vec(0, 0, 0)};
    if (acts(sign, Side::left)) shape.hands = Hands::mirrored;
    if (sign.other_shape) {
      shape.hands = Hands::on_base;
      shape.base.shape = *sign.other_shape;
    }
    shapes.emplace(sign.gloss, shape);
  }
  return shapes;
}

}  // namespace

std::span<const AimedSign> aimed_signs() {
  return kSigns;
}

const AimedSign& aimed_sign(std::string_view gloss) {
  for (const AimedSign& sign : kSigns) {
    if (sign.gloss == gloss) return sign;
  }
  throw Error(ErrorCode::not_found, fmt::format("demo/space_signs.cpp: no sign '{}'; add a row to the table", gloss));
}

bool acts(const AimedSign& sign, Side side) noexcept {
  return side == Side::right || sign.aiming == together || sign.aiming == meeting || sign.aiming == crossing;
}

Handshape handshape_of(const AimedSign& sign, Side side, int end) noexcept {
  if (side == Side::left && sign.other_shape) return *sign.other_shape;
  return end == 0 ? sign.shape : sign.shape_end.value_or(sign.shape);
}

const SignShape& shape_of(const AimedSign& sign) {
  static const std::map<std::string_view, SignShape> shapes = all_shapes();
  return shapes.at(sign.gloss);
}

}  // namespace signweave::demo
