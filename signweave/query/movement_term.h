#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "signweave/core/time.h"
#include "signweave/features/point_track.h"
#include "signweave/rig/part.h"
#include "signweave/rig/signer_space.h"
#include "signweave/space/locus.h"

namespace signweave {

// The part of the syntax tree that is about movement (docs/query.md, "Movement" and "Query by example").

/// A point of the signer.
struct Point {
  enum class Kind : std::uint8_t {
    hand,  ///< the palm of the segment's own hand: either one if both sign, or for an annotation
    palm,  ///< the palm of the hand on `side`
    part,  ///< the origin of `part`
  };
  Kind kind = Kind::palm;
  Side side = Side::right;  ///< for a palm
  Part part = Part::head;   ///< for a part

  static constexpr Point own_hand() noexcept { return {.kind = Kind::hand}; }
  static constexpr Point palm(Side side) noexcept { return {.kind = Kind::palm, .side = side}; }
  static constexpr Point of(Part part) noexcept { return {.kind = Kind::part, .part = part}; }
  friend bool operator==(const Point&, const Point&) = default;
};

/// What is measured of a point, of the face or of the gaze.
enum class Quantity : std::uint8_t {
  speed,  ///< peak, or minimum
  mean_speed,
  acceleration,  ///< peak, or minimum
  mean_acceleration,
  path,          ///< length
  displacement,  ///< straight line from begin to end
  distance,      ///< to another point: minimum, maximum, or at the begin or end
  contact,       ///< what a hand touches at some moment
  begin,         ///< a component at the first moment
  end,           ///< a component at the last moment
  from,          ///< an angle or the distance, from between the shoulders, at the first moment
  to,            ///< the same at the last moment
  max,           ///< maximum of a component
  min,           ///< minimum of a component
  any,           ///< a component at any one moment
  enters,        ///< a zone the point enters
  toward,        ///< of a movement: degrees between its direction and that to a locus, which it comes nearer to
  at,            ///< of an index finger at the last moment: degrees between its direction and that to a locus
  track,         ///< of a scalar track: maximum, or the component
  mean_track,
  gaze,  ///< of an angle of the gaze: maximum, or the component
  mean_gaze,
};
/// Those that are written before a parenthesis.
inline constexpr std::array kQuantities = {
    Quantity::speed, Quantity::mean_speed,   Quantity::acceleration, Quantity::mean_acceleration,
    Quantity::path,  Quantity::displacement, Quantity::distance,     Quantity::contact,
    Quantity::begin, Quantity::end,          Quantity::from,         Quantity::to,
    Quantity::max,   Quantity::min,          Quantity::any,          Quantity::enters,
    Quantity::track, Quantity::mean_track,   Quantity::gaze,         Quantity::mean_gaze};
/// Those that have a locus: right_hand moves toward @left, right_hand points at @left.
inline constexpr std::array kAims = {Quantity::toward, Quantity::at};
constexpr bool is_aim(Quantity quantity) noexcept {
  return quantity == Quantity::toward || quantity == Quantity::at;
}
constexpr bool is_place(Quantity quantity) noexcept {
  return quantity == Quantity::from || quantity == Quantity::to;
}
/// Whether its value follows from where the point is at the first and at the last moment.
constexpr bool is_of_ends(Quantity quantity) noexcept {
  return is_place(quantity) || quantity == Quantity::toward;
}
/// The tolerance of an aim if none is given, degrees. (ours)
constexpr double tolerance_of(Quantity quantity) noexcept {
  return quantity == Quantity::at ? 15 : 30;
}
/// Whether it is a scalar track or the gaze: one value per frame, without a point.
constexpr bool is_series(Quantity quantity) noexcept {
  return quantity >= Quantity::track;
}
constexpr bool is_gaze(Quantity quantity) noexcept {
  return quantity >= Quantity::gaze;
}

/// Whether it needs a component of the point's position or of the hand: `begin(right_hand)` alone is incomplete.
constexpr bool needs_component(Quantity quantity) noexcept {
  return quantity >= Quantity::begin && quantity <= Quantity::enters;
}

enum class Component : std::uint8_t {
  none,
  x,
  height,
  forward,
  openness,
  palm,
  fingers,
  contact,
  begin,
  end,
  least,
  most,
  azimuth,
  elevation,
  distance
};

/// An angle of the gaze (features/gaze.h).
enum class GazeAngle : std::uint8_t { yaw, pitch };

/// QUANTITY(POINT)[.COMPONENT], distance(POINT, POINT)[.COMPONENT], track("NAME")[.COMPONENT], gaze(ANGLE)[.COMPONENT],
/// POINT moves toward @LOCUS, POINT points at @LOCUS.
struct MovementTerm {
  Quantity quantity = Quantity::speed;
  Point point;
  std::optional<Point> other;  ///< for a distance only
  Component component = Component::none;
  std::string track;                 ///< name of a scalar track
  GazeAngle angle = GazeAngle::yaw;  ///< for the gaze
  LocusRef locus;                    ///< for an aim only; a built-in one, or numbers
  friend bool operator==(const MovementTerm&, const MovementTerm&) = default;
};

/// The unit of a number. The parser converts all other units to these.
enum class Unit : std::uint8_t {
  none,
  metres,
  shoulder_widths,
  metres_per_second,
  metres_per_second_squared,
  degrees,
};

/// A number with its unit.
struct Amount {
  double value = 0;
  Unit unit = Unit::none;
  friend bool operator==(const Amount&, const Amount&) = default;
};

/// A span of a recording that other spans are compared with: like("meteo"@1200..3400, right_hand).
struct Example {
  std::string recording;
  TimeSpan span{};            ///< annotation time
  std::vector<Point> points;  ///< points to compare; empty: both hands, as far as the example has them
  friend bool operator==(const Example&, const Example&) = default;
};

/// The kind of value a term is compared with.
enum class ValueKind : std::uint8_t {
  speed,         ///< an amount in m/s
  acceleration,  ///< an amount in m/s2
  length,        ///< an amount in m or sw
  height,        ///< a length, or a named height
  across,        ///< a length, or left, centre, right
  reach,         ///< a length, or near, far
  share,         ///< a bare number
  angle,         ///< an amount in degrees
  facing,        ///< up, down, …
  contact,       ///< hand, head, torso
};
ValueKind value_kind(const MovementTerm& term) noexcept;

std::string to_string(const MovementTerm& term);
std::string to_string(const Amount& amount);
std::string to_string(const Example& example);
std::string to_string(const Point& point);

std::string_view word_of(Quantity quantity) noexcept;
std::string_view word_of(Component component) noexcept;
std::string_view word_of(GazeAngle angle) noexcept;
std::string_view word_of(Facing facing) noexcept;
/// The word of one contact.
std::string_view word_of(Contact contact) noexcept;
inline std::string_view word_of(Height height) noexcept {
  return name_of(height);
}
inline std::string_view word_of(Across across) noexcept {
  return name_of(across);
}
inline std::string_view word_of(Reach reach) noexcept {
  return name_of(reach);
}

/// The point with a name: "hand", "right_hand", "left_elbow", "head", "right_index_tip", or that of a part
/// ("left_forearm"). `right_hand` is the palm; the wrist is `right_wrist`.
std::optional<Point> point_named(std::string_view word);
/// All names that `to_string` returns.
std::vector<std::string> point_words();

}  // namespace signweave
