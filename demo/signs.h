#pragma once

#include <Eigen/Core>
#include <optional>
#include <span>
#include <string_view>

#include "demo/face.h"
#include "demo/handshapes.h"

namespace signweave::demo {

// Positions and directions are relative to the acting hand, so that one description serves both sides: x away from the
// middle of the body, y up, z forward. Positions are those of the wrist, in metres, from the middle of the line between
// the shoulders. For scale: chin y 0.12, eyes 0.20, top of the head 0.31; waist −0.35; chest and face end at z 0.11;
// the shoulder is at x 0.175 and an arm reaches 0.53 from it.

enum class Hands {
  one,          ///< the right hand; the left rests
  left,         ///< the left hand; the right does something else (channels.h)
  mirrored,     ///< both, mirrored
  alternating,  ///< both, the left half a movement behind
  on_base,      ///< the right acts, the left holds `base`
};

enum class Movement {
  straight,  ///< from place to place + move
  arc,       ///< the same, bulging by `size` towards `side`
  circle,    ///< circles of radius `size` along the path, in the plane of `side` and up (or forward if `side` is up)
  repeated,  ///< there and back repeatedly: `times` strokes towards place + move, each return slightly shorter
  zigzag,    ///< straight, oscillating `times` times by `size` along `side`
  flutter,   ///< straight, with fluttering fingers
  twist,     ///< straight, the forearm twisting back and forth `times` times
  nod,       ///< straight, the wrist bending back and forth `times` times
};

/// A hand that holds still.
struct Hold {
  Handshape shape = Handshape::flat;
  Eigen::Vector3f palm, fingers;  ///< directions the palm faces and the fingers point
  Eigen::Vector3f place;
};

/// The form of one sign. PLACEHOLDERS: invented for this demo to move like signing. No sign here is one of LSF.
struct SignShape {
  std::string_view gloss;
  Face face = {};
  Hands hands = Hands::one;
  Handshape shape = Handshape::flat;
  std::optional<Handshape> shape_end = {};                         ///< if the shape changes during the stroke
  Eigen::Vector3f palm, fingers;                                   ///< at the stroke's begin
  std::optional<Eigen::Vector3f> palm_end = {}, fingers_end = {};  ///< if the orientation changes during the stroke
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

/// The sign of a gloss. Throws Error{not_found} if the table lacks it.
const SignShape& sign_for(std::string_view gloss);

/// Whether that side acts in the sign.
bool acts(const SignShape& sign, Side side) noexcept;

/// The variation of one token relative to its description: no two tokens are alike.
struct Token {
  float size = 1;            ///< of the movement, 0.85 to 1.15
  float other_size = 1;      ///< left hand relative to right hand, 0.9 to 1: the dominant hand moves more
  float small = 1;           ///< size of repeated, circling or shaking movements; below 1 in a quick context
  int fewer = 0;             ///< repetitions omitted in a quick context
  double lag = 0;            ///< seconds by which the left hand lags in the middle of a movement
  float turn = 0, bend = 0;  ///< radians by which forearm and wrist differ
  Eigen::Vector3f shift = Eigen::Vector3f::Zero();  ///< of the whole stroke, metres, at most 2 cm
};

/// How often a token's movement is repeated.
int times_of(const SignShape& sign, const Token& token) noexcept;

/// Position of the wrist of a side when a fraction of the stroke is done, in the coordinates above (x away from the
/// middle on that side). For a side that acts.
Eigen::Vector3f stroke_place(const SignShape& sign, Side side, float done, const Token& token = {});

/// The same in metres of model space, the space of the recordings.
Eigen::Vector3f to_model(const Eigen::Vector3f& place, Side side);

/// Length of the wrist's path in the stroke, metres.
float stroke_length(const SignShape& sign, Side side, const Token& token = {});

/// Whether every position of the stroke lies within an arm's reach, in front of chest and face, and on its own side.
bool within_reach(const SignShape& sign, const Token& token = {});

}  // namespace signweave::demo
