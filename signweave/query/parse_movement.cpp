#include "signweave/query/parse_movement.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <utility>

#include "signweave/core/text.h"
#include "signweave/query/keywords.h"
#include "signweave/query/parse.h"
#include "signweave/query/parse_point.h"
#include "signweave/query/parse_series.h"
#include "signweave/query/parse_value.h"

namespace signweave {
namespace {

using Kind = QueryToken::Kind;

constexpr std::array kPlaceComponents = {Component::height, Component::x, Component::forward};
constexpr std::array kHandComponents = {Component::height, Component::x,       Component::forward, Component::openness,
                                        Component::palm,   Component::fingers, Component::contact};
constexpr std::array kExtentComponents = {Component::height, Component::x, Component::forward, Component::openness};
constexpr std::array kAngleComponents = {Component::azimuth, Component::elevation, Component::distance};
constexpr std::array kDistanceComponents = {Component::begin, Component::end, Component::most};
constexpr std::array kPeakComponents = {Component::least};
constexpr std::array kCompares = {Compare::equal,      Compare::not_equal, Compare::less,
                                  Compare::less_equal, Compare::greater,   Compare::greater_equal};

/// The quantities allowed in max(…), min(…) and any(…): those with one value at each moment.
constexpr std::array kMomentary = {Quantity::speed, Quantity::acceleration, Quantity::distance, Quantity::track,
                                   Quantity::gaze};

constexpr bool is_over_moments(Quantity quantity) noexcept {
  return quantity == Quantity::max || quantity == Quantity::min || quantity == Quantity::any;
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
      parse_zone(in_, result);
    } else {
      result.compare = compare(result);
    }
    return result;
  }

 private:
  /// Whether the parenthesis that follows contains a quantity with a value at each moment.
  bool measured_inside() {
    QueryLexer ahead = in_;
    if (!ahead.accept("(") || ahead.peek().kind != Kind::word) return false;
    return is_quantity(ahead.take().text) && ahead.next_is("(");
  }

  /// max(speed(right_hand)): equivalent to a quantity with a component.
  Condition over_moments(const QueryToken& name) {
    Condition result;
    result.field = Field::movement;
    MovementTerm& term = result.movement;
    const Quantity over = value_of(kQuantities, name.text).value();
    in_.expect("(", "");
    const QueryToken inner = in_.take();
    if (!value_of(kMomentary, inner.text)) {
      in_.fail(
          inner.begin,
          fmt::format("'{}' has no value at a single moment; {}({}) takes one of {}, or a point: {}(right_hand).height",
                      inner.text, name.text, "…", fmt::join(words_of(kMomentary), ", "), name.text));
    }
    term.quantity = value_of(kMomentary, inner.text).value();
    take_term(inner, term);
    if (term.component != Component::none) {
      in_.fail(inner.begin,
               fmt::format("'{}' is already the value at one moment; leave '{}' out", to_string(term), name.text));
    }
    in_.expect(")", fmt::format("close the parenthesis of '{}'", name.text));
    const bool is_distance = term.quantity == Quantity::distance;
    const auto ask = [&](bool most) {
      if (most) term.component = is_distance ? Component::most : Component::none;
      if (!most) term.component = is_distance ? Component::none : Component::least;
    };
    ask(over == Quantity::max);
    result.compare = compare(result);
    // Above at some moment: the maximum is above. Below at some moment: the minimum is below.
    if (over == Quantity::any) ask(result.compare == Compare::greater || result.compare == Compare::greater_equal);
    return result;
  }

  /// Takes the parenthesis after a quantity's name, and the component after it.
  void take_term(const QueryToken& name, MovementTerm& term) {
    if (is_series(term.quantity)) return parse_series(in_, name, term);
    in_.expect("(", fmt::format("name a point: {}(right_hand)", name.text));
    std::optional<QueryToken> inside;
    term.point = needs_component(term.quantity) ? point_and_component(inside) : parse_point(in_);
    if (term.quantity == Quantity::distance) {
      in_.expect(",", "name two points: distance(right_hand, head)");
      const std::size_t begin = in_.peek().begin;
      term.other = parse_point(in_);
      if (*term.other == term.point) in_.fail(begin, "a point has no distance to itself; name two different points");
    }
    if (term.quantity == Quantity::enters && !inside && in_.next_is(",")) return;
    in_.expect(")", term.quantity == Quantity::distance ? "close the parenthesis after the two points"
                                                        : "close the parenthesis after the point");
    if (term.quantity == Quantity::contact) require_hand(term.point, name.begin, "contact");
    term.component = component(term, name, inside ? inside : take_component(in_));
  }

  /// A point, and the component after it within the parenthesis: max(right_hand.height).
  Point point_and_component(std::optional<QueryToken>& component) {
    const QueryToken& next = in_.peek();
    const std::size_t dot = next.kind == Kind::word ? next.text.find('.', 1) : std::string::npos;
    if (dot == std::string::npos) {
      const Point found = parse_point(in_);
      component = take_component(in_);
      return found;
    }
    QueryToken token = in_.take();
    component = QueryToken{.kind = Kind::word, .begin = token.begin + dot, .text = token.text.substr(dot), .flags = {}};
    token.text.resize(dot);
    return point_of(in_, token);
  }

  void require_hand(const Point& point, std::size_t begin, std::string_view what) {
    if (point.kind != Point::Kind::part) return;
    in_.fail(begin, fmt::format("'{}' is known for hands only; use hand, right_hand or left_hand", what));
  }

  /// `token`: the component with its leading dot; nullopt: none was given.
  Component component(const MovementTerm& term, const QueryToken& name, const std::optional<QueryToken>& token) {
    if (!token) {
      if (!needs_component(term.quantity)) return Component::none;
      const QueryToken& next = in_.peek();
      in_.fail(next.begin, fmt::format("expected a component after '{}(…)', found {}; write {}({}).{}", name.text,
                                       QueryLexer::shown(next), name.text, to_string(term.point),
                                       is_place(term.quantity) ? "azimuth" : "height"));
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
    const std::optional<Component> of_angles = value_of(kAngleComponents, word);
    if (!is_known && is_place(term.quantity) && of_hand) refuse_in_favour(*token, term, word, false);
    if (!is_known && (term.quantity == Quantity::begin || term.quantity == Quantity::end) && of_angles) {
      refuse_in_favour(*token, term, word, true);
    }
    if (!is_known && needs_component(term.quantity) && of_hand) {
      require_hand(term.point, token->begin, word);
      in_.fail(token->begin,
               fmt::format("'{}' has no value in '{}'; use any({}).{}", word, name.text, to_string(term.point), word));
    }
    if (!is_known) refuse_component(in_, *token, known);
    if (of_hand) return *of_hand;
    if (is_place(term.quantity)) return *of_angles;
    if (const auto of_distance = value_of(kDistanceComponents, word)) return *of_distance;
    return Component::least;
  }

  /// The component belongs to from(…) and to(…), or to begin(…) and end(…).
  [[noreturn]] void refuse_in_favour(const QueryToken& token, const MovementTerm& term, std::string_view word,
                                     bool place) {
    const bool first = term.quantity == Quantity::begin || term.quantity == Quantity::from;
    const Quantity has = place ? (first ? Quantity::from : Quantity::to) : (first ? Quantity::begin : Quantity::end);
    in_.fail(token.begin, fmt::format("'{}' has no value in '{}'; use {}({}).{}", word, word_of(term.quantity),
                                      word_of(has), to_string(term.point), word));
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
      case Quantity::from:
      case Quantity::to:
        return words_of(kAngleComponents);
      case Quantity::max:
      case Quantity::min:
        return hand ? words_of(kExtentComponents) : words_of(kPlaceComponents);
      case Quantity::enters:
        return words_of(kPlaceComponents);
      default:
        return {};
    }
  }

  /// Takes comparison and value, which together determine what is allowed.
  Compare compare(Condition& condition) {
    const AllowedValue allowed = allowed_for(condition.movement);
    const std::string what = to_string(condition.movement);
    const QueryToken at = in_.peek();
    const std::optional<Compare> found = at.kind == Kind::symbol ? value_of(kCompares, at.text) : std::nullopt;
    if (!found) {
      in_.fail(at.begin, fmt::format("expected a comparison after '{}', found {}; use one of {}", what,
                                     QueryLexer::shown(at), allowed.number.empty() ? allowed.compares : "< <= > >="));
    }
    in_.take();
    const std::size_t begin = in_.peek().begin;
    ParsedValue parsed = parse_value(in_, condition.movement, allowed, *found);
    condition.value = std::move(parsed.value);
    const bool equality = *found == Compare::equal || *found == Compare::not_equal;
    if (std::holds_alternative<Amount>(condition.value)) {
      if (!equality) return *found;
      in_.fail(at.begin, fmt::format("a measured value is never exactly a number; use < <= > >= with {}",
                                     to_string(std::get<Amount>(condition.value))));
    }
    const auto padded = [](std::string_view text) { return fmt::format(" {} ", text); };
    if (padded(allowed.compares).find(padded(word_of(*found))) != std::string::npos) return *found;
    if (condition.movement.quantity == Quantity::enters && !equality)
      in_.fail(at.begin, fmt::format("a zone is either entered or not; use {} = {}", what, parsed.written));
    if (*found == Compare::not_equal)
      in_.fail(at.begin, fmt::format("'{}' can be one of several at once; use !({} = …)", what, what));
    in_.fail(begin, fmt::format("'{}' has no order; compare it with {}", parsed.written, allowed.compares));
  }

  QueryLexer& in_;
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

}  // namespace signweave
