#include "signweave/query/movement_term.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>

#include "signweave/query/lexer.h"

namespace signweave {
namespace {

/// Joints whose common name differs from the part that begins there.
struct JointName {
  std::string_view joint;
  std::string_view part;
};
constexpr std::array kJoints = {
    JointName{"left_shoulder", "left_upper_arm"}, JointName{"right_shoulder", "right_upper_arm"},
    JointName{"left_elbow", "left_forearm"},      JointName{"right_elbow", "right_forearm"},
    JointName{"left_wrist", "left_hand"},         JointName{"right_wrist", "right_hand"},
    JointName{"left_hip", "left_thigh"},          JointName{"right_hip", "right_thigh"},
    JointName{"left_knee", "left_shin"},          JointName{"right_knee", "right_shin"},
    JointName{"left_ankle", "left_foot"},         JointName{"right_ankle", "right_foot"},
};

}  // namespace

ValueKind value_kind(const MovementTerm& term) noexcept {
  switch (term.quantity) {
    case Quantity::speed:
    case Quantity::mean_speed:
      return ValueKind::speed;
    case Quantity::acceleration:
    case Quantity::mean_acceleration:
      return ValueKind::acceleration;
    case Quantity::path:
    case Quantity::displacement:
    case Quantity::distance:
      return ValueKind::length;
    case Quantity::contact:
      return ValueKind::contact;
    case Quantity::track:
    case Quantity::mean_track:
      return ValueKind::share;
    case Quantity::gaze:
    case Quantity::mean_gaze:
    case Quantity::toward:
    case Quantity::at:
      return ValueKind::angle;
    case Quantity::begin:
    case Quantity::end:
    case Quantity::from:
    case Quantity::to:
    case Quantity::max:
    case Quantity::min:
    case Quantity::any:
    case Quantity::enters:
      break;
  }
  switch (term.component) {
    case Component::height:
      return ValueKind::height;
    case Component::x:
      return ValueKind::across;
    case Component::forward:
      return ValueKind::reach;
    case Component::openness:
      return ValueKind::share;
    case Component::palm:
    case Component::fingers:
      return ValueKind::facing;
    case Component::contact:
      return ValueKind::contact;
    case Component::azimuth:
    case Component::elevation:
      return ValueKind::angle;
    case Component::none:
    case Component::begin:
    case Component::end:
    case Component::least:
    case Component::most:
    case Component::distance:
      break;
  }
  return ValueKind::length;
}

std::string to_string(const MovementTerm& term) {
  if (is_aim(term.quantity)) {
    return fmt::format("{} {} @{}", to_string(term.point), word_of(term.quantity), to_string(term.locus));
  }
  const std::string of = is_gaze(term.quantity)     ? std::string(word_of(term.angle))
                         : is_series(term.quantity) ? in_quotes(term.track)
                                                    : to_string(term.point);
  std::string result = fmt::format("{}({}", word_of(term.quantity), of);
  if (term.other) result += ", " + to_string(*term.other);
  result += ')';
  if (term.component != Component::none) result += fmt::format(".{}", word_of(term.component));
  return result;
}

std::string to_string(const Amount& amount) {
  constexpr std::string_view kUnits[] = {"", " m", " sw", " m/s", " m/s2", " deg"};
  // The shortest digits that parse to the same number, never with an exponent.
  std::array<char, 400> digits{};
  const auto end = std::to_chars(digits.data(), digits.data() + digits.size(), amount.value, std::chars_format::fixed);
  return std::string(digits.data(), end.ptr).append(kUnits[static_cast<std::size_t>(amount.unit)]);
}

std::string to_string(const Example& example) {
  std::string result =
      fmt::format("like({}@{}..{}", in_quotes(example.recording), example.span.begin.count(), example.span.end.count());
  for (const Point& point : example.points) result += ", " + to_string(point);
  return result + ')';
}

std::string to_string(const Point& point) {
  if (point.kind == Point::Kind::hand) return "hand";
  if (point.kind == Point::Kind::palm) return point.side == Side::left ? "left_hand" : "right_hand";
  const std::string_view name = name_of(point.part);
  const auto at = std::find_if(kJoints.begin(), kJoints.end(), [&](const JointName& row) { return row.part == name; });
  return std::string(at == kJoints.end() ? name : at->joint);
}

std::string_view word_of(Quantity quantity) noexcept {
  constexpr std::string_view kWords[] = {"speed",        "mean_speed",   "acceleration", "mean_acceleration",
                                         "path",         "displacement", "distance",     "contact",
                                         "begin",        "end",          "from",         "to",
                                         "max",          "min",          "any",          "enters",
                                         "moves toward", "points at",    "track",        "mean_track",
                                         "gaze",         "mean_gaze"};
  return kWords[static_cast<std::size_t>(quantity)];
}

std::string_view word_of(GazeAngle angle) noexcept {
  return angle == GazeAngle::yaw ? "yaw" : "pitch";
}

std::string_view word_of(Component component) noexcept {
  constexpr std::string_view kWords[] = {"",      "x",       "height",  "forward",   "openness",
                                         "palm",  "fingers", "contact", "begin",     "end",
                                         "least", "most",    "azimuth", "elevation", "distance"};
  return kWords[static_cast<std::size_t>(component)];
}

std::string_view word_of(Facing facing) noexcept {
  constexpr std::string_view kWords[] = {"unknown", "up", "down", "left", "right", "forward", "back"};
  return kWords[static_cast<std::size_t>(facing)];
}

std::string_view word_of(Contact contact) noexcept {
  switch (contact) {
    case Contact::hands:
      return "hand";
    case Contact::head:
      return "head";
    case Contact::torso:
      return "torso";
    case Contact::none:
      break;
  }
  return "none";
}

std::optional<Point> point_named(std::string_view word) {
  if (word == "hand") return Point::own_hand();
  if (word == "left_hand") return Point::palm(Side::left);
  if (word == "right_hand") return Point::palm(Side::right);
  const auto at = std::find_if(kJoints.begin(), kJoints.end(), [&](const JointName& row) { return row.joint == word; });
  const std::optional<Part> part = part_named(at == kJoints.end() ? word : at->part);
  return part ? std::optional(Point::of(*part)) : std::nullopt;
}

std::vector<std::string> point_words() {
  std::vector<std::string> result = {"hand", "left_hand", "right_hand"};
  for (std::size_t part = 0; part < kPartCount; ++part) {
    result.push_back(to_string(Point::of(static_cast<Part>(part))));
  }
  return result;
}

}  // namespace signweave
