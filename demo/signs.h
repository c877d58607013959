#pragma once

#include <Eigen/Core>
#include <optional>
#include <span>
#include <string_view>

#include "demo/handshapes.h"

namespace signweave::demo {

// Places and directions are told of the hand that acts, so that one description serves both sides: x away from the
// middle of the body, y up, z forward. Places are the wrist's, in metres, from the middle of the line between the
// shoulders. For scale: chin y 0.12, eyes 0.20, top of the head 0.31; waist −0.35; chest and face end at z 0.11; the
// shoulder is at x 0.175 and an arm reaches 0.53 from it.

enum class Hands {
  one,          ///< the right hand; the left rests
  mirrored,     ///< both, in the mirror
  alternating,  ///< both, the left half a movement behind
  on_base,      ///< the right acts, the left holds `base`
};

enum class Movement {
  straight,  ///< from place to place + move
  arc,       ///< the same, bulging by `size` towards `side`
  circle,    ///< turns of radius `size` on the way, in the plane of `side` and up (or forward, where side is up)
  repeated,  ///< there and back and there again: `times` strokes towards place + move
  flutter,   ///< straight, with playing fingers
};

/// A hand that holds still.
struct Hold {
  Handshape shape = Handshape::flat;
  Eigen::Vector3f palm, fingers;  ///< where the palm faces and the fingers point
  Eigen::Vector3f place;
};

/// How one sign is made. PLACEHOLDERS: invented for this demo to move like signing. No sign here is one of LSF.
struct SignShape {
  std::string_view gloss;
  Hands hands = Hands::one;
  Handshape shape = Handshape::flat;
  std::optional<Handshape> shape_end = {};                         ///< where the shape changes during the stroke
  Eigen::Vector3f palm, fingers;                                   ///< at the stroke's begin
  std::optional<Eigen::Vector3f> palm_end = {}, fingers_end = {};  ///< where the orientation changes during the stroke
  Eigen::Vector3f place;                                           ///< at the stroke's begin
  Eigen::Vector3f move;                                            ///< to the stroke's end
  Movement movement = Movement::straight;
  float size = 0;  ///< metres
  Eigen::Vector3f side = Eigen::Vector3f::UnitX();
  int times = 1;
  Hold base = {};  ///< for Hands::on_base
};

/// Every sign that the demo knows, once each.
std::span<const SignShape> sign_table();

/// The sign of a gloss. Throws Error{not_found} where the table lacks it.
const SignShape& sign_for(std::string_view gloss);

/// True where that side does something in the sign.
bool acts(const SignShape& sign, Side side) noexcept;

/// Where the wrist of a side is when a fraction of the stroke is done, in the coordinates above (x away from the
/// middle on that side). For a side that acts.
Eigen::Vector3f stroke_place(const SignShape& sign, Side side, float done);

/// The same in metres of model space, which is where the recordings put it.
Eigen::Vector3f to_model(const Eigen::Vector3f& place, Side side);

/// How far the wrist travels in the stroke, metres.
float stroke_length(const SignShape& sign, Side side);

}  // namespace signweave::demo
