#include "signweave/query/parse_movement.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <numbers>

#include "signweave/core/text.h"
#include "signweave/query/parse.h"
#include "signweave/query/parse_series.h"
#include "signweave/query/words.h"

namespace signweave {
namespace {

using Kind = QueryToken::Kind;

constexpr std::array kPlaceComponents = {Component::height, Component::x, Component::forward};
constexpr std::array kHandComponents = {Component::height, Component::x,       Component::forward, Component::openness,
                                        Component::palm,   Component::fingers, Component::contact};
constexpr std::array kExtentComponents = {Component::height, Component::x, Component::forward, Component::openness};
constexpr std::array kDistanceComponents = {Component::begin, Component::end, Component::most};
constexpr std::array kPeakComponents = {Component::least};
constexpr std::array kHeights = {Height::below_waist, Height::waist, Height::chest,    Height::shoulder,
                                 Height::chin,        Height::mouth, Height::forehead, Height::above_head};
constexpr std::array kAcross = {Across::left, Across::centre, Across::right};
constexpr std::array kReaches = {Reach::near, Reach::far};
constexpr std::array kFacings = {Facing::up, Facing::down, Facing::left, Facing::right, Facing::forward, Facing::back};
constexpr std::array kContacts = {Contact::hands, Contact::head, Contact::torso};
constexpr std::array kCompares = {Compare::equal,      Compare::not_equal, Compare::less,
                                  Compare::less_equal, Compare::greater,   Compare::greater_equal};

struct UnitName {
  std::string_view word;
  Unit unit;
  double per;  ///< so many of it make one of `unit`
};
constexpr std::array kUnits = {
    UnitName{"m", Unit::metres, 1},
    UnitName{"cm", Unit::metres, 100},
    UnitName{"mm", Unit::metres, 1000},
    UnitName{"sw", Unit::shoulder_widths, 1},
    UnitName{"m/s", Unit::metres_per_second, 1},
    UnitName{"cm/s", Unit::metres_per_second, 100},
    UnitName{"mm/s", Unit::metres_per_second, 1000},
    UnitName{"m/s2", Unit::metres_per_second_squared, 1},
    UnitName{"cm/s2", Unit::metres_per_second_squared, 100},
    UnitName{"deg", Unit::degrees, 1},
    UnitName{"rad", Unit::degrees, std::numbers::pi / 180},
    UnitName{"\xC2\xB0", Unit::degrees, 1},
    UnitName{"m/s^2", Unit::metres_per_second_squared, 1},
    UnitName{"cm/s^2", Unit::metres_per_second_squared, 100},
    UnitName{"m/s\xC2\xB2", Unit::metres_per_second_squared, 1},
    UnitName{"cm/s\xC2\xB2", Unit::metres_per_second_squared, 100},
};
constexpr std::size_t kUnitsShown = 11;  ///< the rest are other spellings

/// What a value is in words: what may stand after the comparison.
struct Allowed {
  std::vector<Unit> units;
  std::string_view number;         ///< an example of one; empty: none
  std::vector<std::string> names;  ///< of places and the like
  std::string_view compares;
};

/// What may be asked of as a whole in max(…), min(…) and any(…): one number at each moment.
constexpr std::array kMomentary = {Quantity::speed, Quantity::acceleration, Quantity::distance, Quantity::track,
                                   Quantity::gaze};

constexpr bool is_over_moments(Quantity quantity) noexcept {
  return quantity == Quantity::max || quantity == Quantity::min || quantity == Quantity::any;
}

Allowed allowed_for(ValueKind kind) {
  const std::vector<Unit> lengths = {Unit::shoulder_widths, Unit::metres, Unit::none};
  switch (kind) {
    case ValueKind::speed:
      return {{Unit::metres_per_second}, "1.5 m/s", {}, ""};
    case ValueKind::acceleration:
      return {{Unit::metres_per_second_squared}, "20 m/s2", {}, ""};
    case ValueKind::length:
      return {lengths, "10 cm or 0.3 (shoulder widths)", {}, ""};
    case ValueKind::height:
      return {lengths, "0.3 (shoulder widths)", words_of(kHeights), "= != < <= > >="};
    case ValueKind::across:
      return {lengths, "0.3 (shoulder widths to the signer's left)", words_of(kAcross), "= !="};
    case ValueKind::reach:
      return {lengths, "0.8 (shoulder widths)", words_of(kReaches), "= !="};
    case ValueKind::share:
      return {{Unit::none}, "0.5", {}, ""};
    case ValueKind::angle:
      return {{Unit::degrees}, "15 deg", {}, ""};
    case ValueKind::facing:
      return {{}, "", words_of(kFacings), "= !="};
    case ValueKind::contact:
      return {{}, "", words_of(kContacts), "="};
  }
  return {};
}

Allowed allowed_for(const MovementTerm& term) {
  Allowed allowed = allowed_for(value_kind(term));
  if (term.quantity == Quantity::enters) return {{}, "", std::move(allowed.names), "="};
  return allowed;
}

/// "write 1.5 m/s", "write one of up, down", or both.
std::string what_to_write(const Allowed& allowed) {
  if (allowed.number.empty()) return fmt::format("use one of {}", fmt::join(allowed.names, ", "));
  if (allowed.names.empty()) return fmt::format("write a number such as {}", allowed.number);
  return fmt::format("write a number such as {}, or one of {}", allowed.number, fmt::join(allowed.names, ", "));
}

bool looks_like_number(std::string_view word) noexcept {
  if (word.starts_with('-') || word.starts_with('+')) word.remove_prefix(1);
  return !word.empty() && (word.front() == '.' || (word.front() >= '0' && word.front() <= '9'));
}

class MovementParser {
 public:
  explicit MovementParser(QueryLexer& in) : in_(in) {}

  Condition movement(const QueryToken& name) {
    Condition result;
    result.field = Field::movement;
    MovementTerm& term = result.movement;
    term.quantity = value_of(kQuantities, name.text).value();
    if (is_over_moments(term.quantity) && measured_inside()) return over_moments(name);
    take_term(name, term);
    if (term.quantity == Quantity::enters && term.component == Component::none) {
      name_zone(result);
    } else {
      result.compare = compare(result);
    }
    return result;
  }

  Condition example(const QueryToken& name) {
    Condition result;
    result.field = Field::like;
    Example example;
    in_.expect("(", R"(name a piece of a recording: like("meteo"@1200..3400))");
    const QueryToken recording = in_.take();
    if (recording.kind != Kind::text && recording.kind != Kind::word) {
      in_.fail(recording.begin, fmt::format("expected a recording's name, found {}; write like(\"meteo\"@1200..3400)",
                                            QueryLexer::shown(recording)));
    }
    example.recording = recording.text;
    in_.expect("@", R"(tell from when to when: like("meteo"@1200..3400))");
    example.span = span();
    while (in_.accept(",")) {
      const std::size_t begin = in_.peek().begin;
      const Point added = point(true);
      if (std::find(example.points.begin(), example.points.end(), added) != example.points.end()) {
        in_.fail(begin, fmt::format("'{}' is named twice; name it once", to_string(added)));
      }
      example.points.push_back(added);
    }
    in_.expect(")", fmt::format("close the parenthesis of '{}', or name points after commas", name.text));
    result.value = std::move(example);
    return result;
  }

 private:
  /// Whether a quantity that has a number at each moment stands in the parenthesis that follows.
  bool measured_inside() {
    QueryLexer ahead = in_;
    if (!ahead.accept("(") || ahead.peek().kind != Kind::word) return false;
    return is_quantity(ahead.take().text) && ahead.next_is("(");
  }

  /// max(speed(right_hand)): the same as a quantity with a component.
  Condition over_moments(const QueryToken& name) {
    Condition result;
    result.field = Field::movement;
    MovementTerm& term = result.movement;
    const Quantity over = value_of(kQuantities, name.text).value();
    in_.expect("(", "");
    const QueryToken inner = in_.take();
    if (!value_of(kMomentary, inner.text)) {
      in_.fail(inner.begin,
               fmt::format("'{}' is no number of a moment; {}({}) takes one of {}, or a point: {}(right_hand).height",
                           inner.text, name.text, "…", fmt::join(words_of(kMomentary), ", "), name.text));
    }
    term.quantity = value_of(kMomentary, inner.text).value();
    take_term(inner, term);
    if (term.component != Component::none) {
      in_.fail(inner.begin, fmt::format("'{}' is one moment's already; leave '{}' out", to_string(term), name.text));
    }
    in_.expect(")", fmt::format("close the parenthesis of '{}'", name.text));
    const bool is_distance = term.quantity == Quantity::distance;
    const auto ask = [&](bool most) {
      if (most) term.component = is_distance ? Component::most : Component::none;
      if (!most) term.component = is_distance ? Component::none : Component::least;
    };
    ask(over == Quantity::max);
    result.compare = compare(result);
    // At some moment above: the most is above. At some moment below: the least is.
    if (over == Quantity::any) ask(result.compare == Compare::greater || result.compare == Compare::greater_equal);
    return result;
  }

  /// What stands in parentheses behind a quantity's name, and the component behind it.
  void take_term(const QueryToken& name, MovementTerm& term) {
    if (is_series(term.quantity)) return parse_series(in_, name, term);
    in_.expect("(", fmt::format("name a point: {}(right_hand)", name.text));
    std::optional<QueryToken> inside;
    term.point = needs_component(term.quantity) ? point_and_component(inside) : point(false);
    if (term.quantity == Quantity::distance) {
      in_.expect(",", "name two points: distance(right_hand, head)");
      const std::size_t begin = in_.peek().begin;
      term.other = point(false);
      if (*term.other == term.point) in_.fail(begin, "a point is in no distance from itself; name two points");
    }
    if (term.quantity == Quantity::enters && !inside && in_.next_is(",")) return;
    in_.expect(")", term.quantity == Quantity::distance ? "close the parenthesis after the two points"
                                                        : "close the parenthesis after the point");
    if (term.quantity == Quantity::contact) require_hand(term.point, name.begin, "contact");
    term.component = component(term, name, inside ? inside : take_component(in_));
  }

  /// The rest of enters(right_hand, shoulder).
  void name_zone(Condition& condition) {
    in_.expect(",", "");
    const QueryToken token = in_.take();
    const std::string word = fold_case(token.text);
    std::vector<std::string> names = words_of(kHeights);
    for (const std::string& name : words_of(kAcross)) names.push_back(name);
    for (const std::string& name : words_of(kReaches)) names.push_back(name);
    if (const auto height = value_of(kHeights, word)) {
      condition.value = *height;
      condition.movement.component = Component::height;
    } else if (const auto across = value_of(kAcross, word == "center" ? "centre" : word)) {
      condition.value = *across;
      condition.movement.component = Component::x;
    } else if (const auto reach = value_of(kReaches, word)) {
      condition.value = *reach;
      condition.movement.component = Component::forward;
    } else {
      in_.fail(token.begin, fmt::format("expected a zone, found {}{}; use one of {}", QueryLexer::shown(token),
                                        did_you_mean(token.text, names), fmt::join(names, ", ")));
    }
    condition.compare = Compare::equal;
    in_.expect(")", "close the parenthesis after the zone");
  }

  /// A point, and the component behind it within the parenthesis: max(right_hand.height).
  Point point_and_component(std::optional<QueryToken>& component) {
    const QueryToken& next = in_.peek();
    const std::size_t dot = next.kind == Kind::word ? next.text.find('.', 1) : std::string::npos;
    if (dot == std::string::npos) {
      const Point found = point(false);
      component = take_component(in_);
      return found;
    }
    QueryToken token = in_.take();
    component = QueryToken{.kind = Kind::word, .begin = token.begin + dot, .text = token.text.substr(dot), .flags = {}};
    token.text.resize(dot);
    return point_of(token, false);
  }

  Point point(bool sided) { return point_of(in_.take(), sided); }

  Point point_of(const QueryToken& token, bool sided) {
    const bool named = token.kind == Kind::word || token.kind == Kind::text;
    const std::optional<Point> found = named ? point_named(fold_case(token.text)) : std::nullopt;
    if (found && sided && found->kind == Point::Kind::hand) {
      in_.fail(token.begin, "tell which hand is compared: right_hand or left_hand, or name none for both");
    }
    if (found) return *found;
    constexpr std::string_view kExamples = "hand, right_hand, left_elbow, head, right_index_tip";
    if (!named) {
      in_.fail(token.begin, fmt::format("expected a point of the signer, found {}; name one such as {}",
                                        QueryLexer::shown(token), kExamples));
    }
    in_.fail(token.begin, fmt::format("no point is called {}{}; name one such as {}", QueryLexer::shown(token),
                                      did_you_mean(token.text, point_words()), kExamples));
  }

  void require_hand(const Point& point, std::size_t begin, std::string_view what) {
    if (point.kind != Point::Kind::part) return;
    in_.fail(begin, fmt::format("'{}' is known of hands only; use hand, right_hand or left_hand", what));
  }

  /// `token`: that with the dot before it; none: none was written.
  Component component(const MovementTerm& term, const QueryToken& name, const std::optional<QueryToken>& token) {
    if (!token) {
      if (!needs_component(term.quantity)) return Component::none;
      const QueryToken& next = in_.peek();
      in_.fail(next.begin, fmt::format("expected a component after '{}(…)', found {}; write {}({}).height", name.text,
                                       QueryLexer::shown(next), name.text, to_string(term.point)));
    }
    const std::string word = fold_case(token->text.substr(1));
    const std::vector<std::string> known = components_of(term);
    const bool is_known = std::ranges::find(known, word) != known.end();
    const std::optional<Component> of_hand = value_of(kHandComponents, word);
    if (!is_known && !needs_component(term.quantity) && term.quantity != Quantity::distance) {
      in_.fail(token->begin,
               fmt::format("'{}' has no component '{}'; leave '{}' out, or ask for begin({}){}", name.text,
                           printable(word), printable(token->text), to_string(term.point), printable(token->text)));
    }
    if (!is_known && needs_component(term.quantity) && of_hand) {
      require_hand(term.point, token->begin, word);
      in_.fail(token->begin, fmt::format("'{}' is nothing that '{}' tells; ask for any({}).{}", word, name.text,
                                         to_string(term.point), word));
    }
    if (!is_known) refuse_component(in_, *token, known);
    if (of_hand) return *of_hand;
    if (const auto of_distance = value_of(kDistanceComponents, word)) return *of_distance;
    return Component::least;
  }

  /// The words of the components that a quantity has.
  static std::vector<std::string> components_of(const MovementTerm& term) {
    const bool hand = term.point.kind != Point::Kind::part;
    switch (term.quantity) {
      case Quantity::speed:
      case Quantity::acceleration:
        return words_of(kPeakComponents);
      case Quantity::distance:
        return words_of(kDistanceComponents);
      case Quantity::begin:
      case Quantity::end:
      case Quantity::any:
        return hand ? words_of(kHandComponents) : words_of(kPlaceComponents);
      case Quantity::max:
      case Quantity::min:
        return hand ? words_of(kExtentComponents) : words_of(kPlaceComponents);
      case Quantity::enters:
        return words_of(kPlaceComponents);
      default:
        return {};
    }
  }

  /// Takes comparison and value, which tell together what is allowed.
  Compare compare(Condition& condition) {
    const Allowed allowed = allowed_for(condition.movement);
    const std::string what = to_string(condition.movement);
    const QueryToken at = in_.peek();
    const std::optional<Compare> found = at.kind == Kind::symbol ? value_of(kCompares, at.text) : std::nullopt;
    if (!found) {
      in_.fail(at.begin, fmt::format("expected a comparison after '{}', found {}; use one of {}", what,
                                     QueryLexer::shown(at), allowed.number.empty() ? allowed.compares : "< <= > >="));
    }
    in_.take();
    const std::size_t begin = in_.peek().begin;
    condition.value = value(condition.movement, allowed, *found);
    const bool equality = *found == Compare::equal || *found == Compare::not_equal;
    if (std::holds_alternative<Amount>(condition.value)) {
      if (!equality) return *found;
      in_.fail(at.begin, fmt::format("what is measured is never exactly a number; use < <= > >= with {}",
                                     to_string(std::get<Amount>(condition.value))));
    }
    const auto padded = [](std::string_view text) { return fmt::format(" {} ", text); };
    if (padded(allowed.compares).find(padded(word_of(*found))) != std::string::npos) return *found;
    if (condition.movement.quantity == Quantity::enters && !equality)
      in_.fail(at.begin, fmt::format("a zone is entered or not; use {} = {}", what, in_value_));
    if (*found == Compare::not_equal)
      in_.fail(at.begin, fmt::format("'{}' is one of several at once; use !({} = …)", what, what));
    in_.fail(begin, fmt::format("'{}' has no order; compare it with {}", in_value_, allowed.compares));
  }

  decltype(Condition::value) value(const MovementTerm& term, const Allowed& allowed, Compare compare) {
    in_.join_slash();
    const QueryToken token = in_.peek();
    if (token.kind != Kind::word && token.kind != Kind::text) {
      in_.fail(token.begin, fmt::format("expected a value after '{}', found {}; {}", word_of(compare),
                                        QueryLexer::shown(token), what_to_write(allowed)));
    }
    in_.take();
    in_value_ = token.text;
    if (token.kind == Kind::word && looks_like_number(token.text)) return amount(token, allowed);
    const std::string word = fold_case(token.text);
    const auto named = [&](const auto& values) -> std::optional<decltype(Condition::value)> {
      if (const auto one = value_of(values, word)) return *one;
      return std::nullopt;
    };
    std::optional<decltype(Condition::value)> found;
    switch (value_kind(term)) {
      case ValueKind::height:
        found = named(kHeights);
        break;
      case ValueKind::across:
        found = word == "center" ? Across::centre : named(kAcross);
        break;
      case ValueKind::reach:
        found = named(kReaches);
        break;
      case ValueKind::facing:
        found = named(kFacings);
        break;
      case ValueKind::contact:
        found = named(kContacts);
        break;
      case ValueKind::speed:
      case ValueKind::acceleration:
      case ValueKind::length:
      case ValueKind::share:
      case ValueKind::angle:
        break;
    }
    if (found) return *std::move(found);
    in_.fail(token.begin, fmt::format("{} is no value of '{}'{}; {}", QueryLexer::shown(token), to_string(term),
                                      did_you_mean(token.text, allowed.names), what_to_write(allowed)));
  }

  Amount amount(const QueryToken& token, const Allowed& allowed) {
    if (allowed.number.empty()) {
      in_.fail(token.begin, fmt::format("'{}' is a number; {}", printable(token.text), what_to_write(allowed)));
    }
    std::string_view text = token.text;
    if (text.starts_with('+')) text.remove_prefix(1);
    const std::size_t digits =
        std::min(text.find_first_not_of("0123456789.", text.starts_with('-') ? 1 : 0), text.size());
    constexpr std::size_t kMostDigits = 40;
    double value = 0;
    const auto end = std::from_chars(text.data(), text.data() + digits, value, std::chars_format::fixed);
    if (end.ec != std::errc() || end.ptr != text.data() + digits || digits > kMostDigits) {
      in_.fail(token.begin, fmt::format("'{}' is no number; {}", printable(token.text), what_to_write(allowed)));
    }
    std::string word(text.substr(digits));
    std::size_t at = token.begin;
    if (word.empty() && in_.peek().kind == Kind::word) {
      const QueryToken& next = in_.peek();
      in_.join_slash();
      if (!is_relation(next.text)) {
        at = next.begin;
        word = in_.take().text;
      }
    }
    const auto unit = std::find_if(kUnits.begin(), kUnits.end(), [&](const UnitName& row) { return row.word == word; });
    if (!word.empty() && unit == kUnits.end()) {
      in_.fail(at, fmt::format("no unit is called '{}'{}; {}", printable(word), did_you_mean(word, shown_units()),
                               what_to_write(allowed)));
    }
    const Unit meant = word.empty() ? Unit::none : unit->unit;
    if (std::find(allowed.units.begin(), allowed.units.end(), meant) == allowed.units.end()) {
      in_.fail(word.empty() ? token.begin : at,
               word.empty()
                   ? fmt::format("the number {} lacks a unit; {}", printable(token.text), what_to_write(allowed))
                   : fmt::format("'{}' is not what this is measured in; {}", printable(word), what_to_write(allowed)));
    }
    const double result = word.empty() ? value : value / unit->per;
    constexpr double kMost = 1e6;
    if (std::abs(result) > kMost) in_.fail(token.begin, "a number above a million; write a smaller one");
    const bool bare_length = meant == Unit::none && allowed.units.size() > 1;
    return {result, bare_length ? Unit::shoulder_widths : meant};
  }

  /// A relation may follow a bare number: "… > 0.5 during phase = stroke".
  static bool is_relation(std::string_view word) noexcept {
    constexpr std::array kRelations = {Link::overlaps, Link::during, Link::starts, Link::ends, Link::equals};
    return value_of(kRelations, word).has_value();
  }
  static std::vector<std::string> shown_units() {
    std::vector<std::string> result;
    for (std::size_t i = 0; i < kUnitsShown; ++i) result.emplace_back(kUnits[i].word);
    return result;
  }

  /// "1200..3400", in milliseconds unless a unit is given.
  TimeSpan span() {
    const std::size_t begin = in_.peek().begin;
    std::string text;
    while (in_.peek().kind == Kind::word) text += in_.take().text;
    const std::size_t dots = text.find("..");
    constexpr std::string_view kWrite = "write when it begins and ends in milliseconds, such as 1200..3400";
    if (dots == std::string::npos) in_.fail(begin, fmt::format("'{}' is no span of time; {}", printable(text), kWrite));
    const auto bound = [&](std::string_view part) {
      std::string_view digits = part;
      std::int64_t times = 1;
      if (digits.ends_with("ms")) {
        digits.remove_suffix(2);
      } else if (digits.ends_with("s")) {
        digits.remove_suffix(1);
        times = 1000;
      }
      double value = 0;
      const auto end = std::from_chars(digits.data(), digits.data() + digits.size(), value, std::chars_format::fixed);
      const double count = value * static_cast<double>(times);
      if (digits.empty() || end.ec != std::errc() || end.ptr != digits.data() + digits.size() ||
          std::abs(count) > 1e12 || std::abs(count - std::round(count)) > 1e-6) {
        in_.fail(begin, fmt::format("'{}' is no time in whole milliseconds; {}", printable(part), kWrite));
      }
      return Milliseconds(static_cast<std::int64_t>(std::round(count)));
    };
    const TimeSpan result{bound(std::string_view(text).substr(0, dots)),
                          bound(std::string_view(text).substr(dots + 2))};
    if (result.end <= result.begin) in_.fail(begin, "the example ends before it begins; swap the two times");
    return result;
  }

  QueryLexer& in_;
  std::string in_value_;
};

}  // namespace

bool is_quantity(std::string_view word) noexcept {
  return value_of(kQuantities, word).has_value();
}

std::vector<std::string> movement_words() {
  std::vector<std::string> result = words_of(kQuantities);
  result.emplace_back("like");
  return result;
}

Condition parse_movement(QueryLexer& in, const QueryToken& name) {
  return MovementParser(in).movement(name);
}

Condition parse_example(QueryLexer& in, const QueryToken& name) {
  return MovementParser(in).example(name);
}

}  // namespace signweave
