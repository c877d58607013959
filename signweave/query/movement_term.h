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

namespace signweave {

// The part of the syntax tree that speaks of movement (docs/query.md, "Movement" and "Query by example").

/// A point of the signer.
struct Point {
  enum class Kind : std::uint8_t {
    hand,  ///< the palm of a hand of the segment's own: either of both where both sign; of an annotation: either
    palm,  ///< the palm of the hand on `side`
    part,  ///< where `part` begins
  };
  Kind kind = Kind::palm;
  Side side = Side::right;  ///< of a palm
  Part part = Part::head;   ///< of a part

  static constexpr Point own_hand() noexcept { return {.kind = Kind::hand}; }
  static constexpr Point palm(Side side) noexcept { return {.kind = Kind::palm, .side = side}; }
  static constexpr Point of(Part part) noexcept { return {.kind = Kind::part, .part = part}; }
  friend bool operator==(const Point&, const Point&) = default;
};

/// What is asked of a point, or of what a face does.
enum class Quantity : std::uint8_t {
  speed,  ///< the peak, or the least
  mean_speed,
  acceleration,  ///< the peak, or the least
  mean_acceleration,
  path,          ///< its length
  displacement,  ///< straight from begin to end
  distance,      ///< from another point: the least, the most, or that at begin or end
  contact,       ///< what a hand touches at some moment
  begin,         ///< a component at the first moment
  end,           ///< a component at the last moment
  max,           ///< the most that a component is at any moment
  min,           ///< the least
  any,           ///< a component at some moment, whichever
  enters,        ///< a zone that the point comes into
  track,         ///< of a scalar track: the most, or the component
  mean_track,
  gaze,  ///< of an angle of the gaze: the most, or the component
  mean_gaze,
};
inline constexpr std::array kQuantities = {
    Quantity::speed, Quantity::mean_speed,   Quantity::acceleration, Quantity::mean_acceleration,
    Quantity::path,  Quantity::displacement, Quantity::distance,     Quantity::contact,
    Quantity::begin, Quantity::end,          Quantity::max,          Quantity::min,
    Quantity::any,   Quantity::enters,       Quantity::track,        Quantity::mean_track,
    Quantity::gaze,  Quantity::mean_gaze};
/// Whether it is a scalar track or the gaze: one number a frame, without a point.
constexpr bool is_series(Quantity quantity) noexcept {
  return quantity >= Quantity::track;
}
constexpr bool is_gaze(Quantity quantity) noexcept {
  return quantity >= Quantity::gaze;
}

/// Whether a component of the point's place or of the hand belongs to it: `begin(right_hand)` says nothing yet.
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
  most
};

/// An angle of the gaze (features/gaze.h).
enum class GazeAngle : std::uint8_t { yaw, pitch };

/// QUANTITY(POINT)[.COMPONENT], distance(POINT, POINT)[.COMPONENT], track("NAME")[.COMPONENT], gaze(ANGLE)[.COMPONENT].
struct MovementTerm {
  Quantity quantity = Quantity::speed;
  Point point;
  std::optional<Point> other;  ///< of a distance only
  Component component = Component::none;
  std::string track;                 ///< name of a scalar track
  GazeAngle angle = GazeAngle::yaw;  ///< of the gaze
  friend bool operator==(const MovementTerm&, const MovementTerm&) = default;
};

/// What a number counts. All others are turned into these by the parser.
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

/// A piece of a recording that others are held against: like("meteo"@1200..3400, right_hand).
struct Example {
  std::string recording;
  TimeSpan span{};            ///< annotation time
  std::vector<Point> points;  ///< what is compared; empty: both hands, as far as the example has them
  friend bool operator==(const Example&, const Example&) = default;
};

/// What the value of a term can be.
enum class ValueKind : std::uint8_t {
  speed,         ///< an amount in m/s
  acceleration,  ///< an amount in m/s2
  length,        ///< an amount in m or sw
  height,        ///< the same, or a named height
  across,        ///< the same, or left, centre, right
  reach,         ///< the same, or near, far
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
/// Of one contact.
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

/// The point of a name: "hand", "right_hand", "left_elbow", "head", "right_index_tip", or that of a part
/// ("left_forearm"). `right_hand` is the palm; the wrist is `right_wrist`.
std::optional<Point> point_named(std::string_view word);
/// All names that `to_string` gives.
std::vector<std::string> point_words();

}  // namespace signweave
