#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <random>
#include <string>
#include <utility>

#include "signweave/query/phase_query.h"
#include "signweave/query/scopes.h"

namespace signweave {

/// Random queries over the few labels and short times of the random corpora in find_property_test.cpp, so that some of
/// them have answers.
class RandomQueries {
 public:
  /// With `movement`, some conditions are on movement, and some queries have an example.
  explicit RandomQueries(std::mt19937& random, bool movement = false) : random_(random), movement_(movement) {}

  PhaseQuery query() {
    PhaseQuery result;
    const unsigned places = one_in(2) ? 1 : 1 + below(3);
    const unsigned kind = below(4);
    for (unsigned i = 0; i < places; ++i) {
      Element element{{expression(2), false}, {}};
      if (places > 1) element.term.expression = of_kind(kind);
      if (one_in(4)) element.relations.push_back(relation());
      result.elements.push_back(element);
      if (i > 0) result.gaps.push_back(gap());
    }
    if (movement_ && one_in(4)) rank(result.elements[below(places)].term.expression);
    if (one_in(3)) add_group(result);
    if (one_in(3)) mark(result);
    return result;
  }

  /// A condition on movement.
  Expression moving() {
    Expression result;
    Condition& condition = result.condition;
    if (one_in(12)) {
      condition.field = Field::hands;
      condition.compare = one_in(3) ? Compare::not_equal : Compare::equal;
      condition.value = kHandsClasses[below(kHandsClasses.size())];
      return result;
    }
    condition.field = Field::movement;
    if (one_in(10)) return aiming(std::move(result));
    MovementTerm& term = condition.movement;
    term.quantity = kQuantities[below(kQuantities.size())];
    if (is_series(term.quantity)) return of_series(std::move(result));
    term.point = point(false);
    if (term.quantity == Quantity::contact && term.point.kind == Point::Kind::part) term.point = Point::own_hand();
    if (term.quantity == Quantity::distance) {
      do term.other = point(false);
      while (*term.other == term.point);
      constexpr Component kOfDistance[] = {Component::begin, Component::end, Component::most};
      if (one_in(2)) term.component = kOfDistance[below(3)];
    } else if (term.quantity == Quantity::speed || term.quantity == Quantity::acceleration) {
      if (one_in(2)) term.component = Component::least;
    } else if (is_place(term.quantity)) {
      constexpr Component kAngles[] = {Component::azimuth, Component::elevation, Component::distance};
      term.component = kAngles[below(3)];
    } else if (needs_component(term.quantity)) {
      const unsigned of_hand = term.quantity == Quantity::max || term.quantity == Quantity::min ? 4 : 7;
      const bool place = term.point.kind == Point::Kind::part || term.quantity == Quantity::enters;
      term.component = static_cast<Component>(1 + below(place ? 3 : of_hand));
    }
    constexpr Compare kOrder[] = {Compare::less, Compare::less_equal, Compare::greater, Compare::greater_equal};
    condition.compare = kOrder[below(4)];
    const Compare equality = one_in(2) ? Compare::equal : Compare::not_equal;
    const auto named = [&](auto value, Compare compare) {
      condition.value = value;
      condition.compare = compare;
    };
    const Unit length = one_in(2) ? Unit::metres : Unit::shoulder_widths;
    const bool enters = term.quantity == Quantity::enters;
    const bool number = !enters && one_in(2);
    switch (value_kind(term)) {
      case ValueKind::speed:
        condition.value = amount(Unit::metres_per_second);
        break;
      case ValueKind::acceleration:
        condition.value = amount(Unit::metres_per_second_squared);
        break;
      case ValueKind::share:
        condition.value = amount(Unit::none);
        break;
      case ValueKind::angle:
        condition.value = Amount{static_cast<double>(below(360)) - 180, Unit::degrees};
        break;
      case ValueKind::height:
        condition.value = amount(length);
        if (!number) named(static_cast<Height>(below(8)), one_in(2) ? equality : condition.compare);
        break;
      case ValueKind::across:
        condition.value = amount(length);
        if (!number) named(static_cast<Across>(below(3)), equality);
        break;
      case ValueKind::reach:
        condition.value = amount(length);
        if (!number) named(static_cast<Reach>(below(2)), equality);
        break;
      case ValueKind::length:
        condition.value = amount(length);
        break;
      case ValueKind::facing:
        named(static_cast<Facing>(1 + below(6)), equality);
        break;
      case ValueKind::contact:
        named(static_cast<Contact>(1U << below(3)), Compare::equal);
        break;
    }
    if (enters) condition.compare = Compare::equal;
    return result;
  }

 private:
  /// The rest of a condition on where a point moves or points.
  Expression aiming(Expression result) {
    constexpr const char* kLoci[] = {"left", "right", "self", "30/10", "-100/-20/0.5", "0.3,-0.1,0.8"};
    Condition& condition = result.condition;
    MovementTerm& term = condition.movement;
    term.quantity = kAims[below(kAims.size())];
    term.point = point(false);
    if (term.quantity == Quantity::at && term.point.kind == Point::Kind::part) term.point = Point::own_hand();
    term.locus = read_locus(kLoci[below(6)]);
    condition.compare = Compare::less_equal;
    condition.value = Amount{one_in(2) ? tolerance_of(term.quantity) : 1.0 + below(179), Unit::degrees};
    return result;
  }

  /// The rest of a condition on a scalar track or the gaze.
  Expression of_series(Expression result) {
    Condition& condition = result.condition;
    MovementTerm& term = condition.movement;
    constexpr const char* kTracks[] = {"jawOpen", "browInnerUp", "cheekPuff"};
    constexpr Component kComponents[] = {Component::none, Component::least, Component::begin, Component::end};
    constexpr Compare kOrder[] = {Compare::less, Compare::less_equal, Compare::greater, Compare::greater_equal};
    if (is_gaze(term.quantity)) {
      term.angle = one_in(2) ? GazeAngle::yaw : GazeAngle::pitch;
    } else {
      term.track = kTracks[below(3)];
    }
    const bool mean = term.quantity == Quantity::mean_track || term.quantity == Quantity::mean_gaze;
    if (!mean) term.component = kComponents[below(4)];
    condition.compare = kOrder[below(4)];
    condition.value = is_gaze(term.quantity) ? Amount{static_cast<double>(below(20)) - 10, Unit::degrees}
                                             : Amount{static_cast<double>(below(21)) / 20, Unit::none};
    return result;
  }

  /// Two places, sometimes with a condition on the whole, or a relation of one of them.
  PhaseQuery pair() {
    const unsigned kind = below(4);
    PhaseQuery result;
    for (unsigned i = 0; i < 2; ++i) result.elements.push_back({{of_kind(kind), false}, {}});
    result.gaps.push_back(gap());
    if (one_in(4)) result.elements[below(2)].relations.push_back({static_cast<Link>(4 + below(5)), {gloss(), false}});
    if (one_in(3)) result.elements[1].groups.push_back({.places = 2, .conditions = {time()}});
    return result;
  }

  Relation relation() {
    Relation result{static_cast<Link>(4 + below(5)), {}, {}};
    if (one_in(3)) {
      result.sequence.push_back(pair());
    } else {
      result.term.expression = expression(1);
    }
    return result;
  }

  void add_group(PhaseQuery& query) {
    const std::size_t last = below(static_cast<unsigned>(query.elements.size()));
    Element& element = query.elements[last];
    Group group{.places = 1 + below(static_cast<unsigned>(last) + 1)};
    if (group.places == 1 && element.relations.empty()) return;
    if (one_in(2)) group.conditions.push_back(time());
    if (group.conditions.empty() || one_in(2)) group.relations.push_back(relation());
    element.groups.push_back(std::move(group));
  }

  void mark(PhaseQuery& query) {
    Element& element = query.elements[below(static_cast<unsigned>(query.elements.size()))];
    if (!element.groups.empty() && one_in(2)) {
      Group& group = element.groups.back();
      if (!group.relations.empty() && one_in(2)) return mark(group.relations.front());
      group.marked = true;
      return;
    }
    if (!element.relations.empty() && one_in(2)) return mark(element.relations.front());
    element.term.marked = true;
  }

  void mark(Relation& relation) {
    if (!relation.sequence.empty()) return mark(relation.sequence.front());
    relation.term.marked = true;
  }

  Point point(bool sided) {
    const unsigned choice = below(4);
    if (choice == 0 && !sided) return Point::own_hand();
    if (choice < 3) return Point::palm(one_in(2) ? Side::left : Side::right);
    Point result = Point::of(static_cast<Part>(below(kPartCount)));
    return result;
  }

  Amount amount(Unit unit) {
    constexpr double kDivisors[] = {1000, 700, 1000, 3000, 1};
    return {(static_cast<double>(below(4000)) - 1000) / kDivisors[below(5)], unit};
  }

  unsigned below(unsigned most) { return random_() % most; }
  bool one_in(unsigned n) { return below(n) == 0; }
  std::string label() {
    constexpr const char* kLabels[] = {"A", "B", "C", "", "quo\"te\\", "\xC3\xA9", " A"};
    return kLabels[below(one_in(3) ? 7 : 3)];
  }

  /// Sequences of signs (0, 1), of phases (2), of the annotations of a sign tier (3): the parser rejects mixed ones.
  Expression of_kind(unsigned kind) {
    const auto first = [&] { return kind == 2 ? phase() : kind == 3 ? of_tier("Gloss") : gloss(); };
    if (!one_in(3)) return first();
    Expression result;
    result.kind = Expression::Kind::all;
    result.operands = {first(), expression(1)};
    while (kind != 2 && scopes_of(result, tiers_named(result)) == Scopes::phases()) result.operands[1] = expression(1);
    return result;
  }

  Expression of_tier(const std::string& tier) {
    Expression result = of_label(Field::tier);
    result.condition.tier = tier;
    return result;
  }

  Interval gap() {
    Interval result;
    if (one_in(2)) return result;
    if (!one_in(3)) result.least = Milliseconds(below(4));
    if (!result.least || one_in(2)) result.most = result.least.value_or(0ms) + Milliseconds(below(8));
    return result;
  }

  Expression expression(int depth) {
    Expression result;
    const unsigned choice = depth == 0 ? 0 : below(6);
    if (choice == 0 || choice == 5) return condition();
    if (choice == 3) {
      result.kind = Expression::Kind::negation;
      result.operands = {expression(depth - 1)};
    } else if (choice == 4) {
      result.kind = Expression::Kind::link;
      result.link = static_cast<Link>(below(9));
      if (result.link >= Link::overlaps && one_in(3)) {
        result.sequence.push_back(pair());
      } else {
        result.operands = {expression(depth - 1)};
      }
    } else {
      result.kind = choice == 1 ? Expression::Kind::all : Expression::Kind::any;
      for (unsigned i = 0; i < 2 + below(2); ++i) result.operands.push_back(expression(depth - 1));
      if (result.operands.size() < 2) result.operands.push_back(condition());
    }
    return result;
  }

  Expression gloss() { return of_label(Field::gloss); }

  Expression of_label(Field field) {
    Expression result;
    result.condition.field = field;
    const unsigned choice = below(4);
    result.condition.compare = choice == 0 ? Compare::matches : choice == 1 ? Compare::not_equal : Compare::equal;
    if (choice == 0) {
      constexpr const char* kPatterns[] = {".*", "[AB]", "a", "A|C", "a/b\\\\", ""};
      result.condition.value = Regex{kPatterns[below(6)], one_in(2)};
    } else {
      result.condition.value = label();
    }
    return result;
  }

  Expression phase() {
    Expression result;
    result.condition.field = Field::phase;
    result.condition.compare = one_in(3) ? Compare::not_equal : Compare::equal;
    result.condition.value = static_cast<PhaseKind>(below(5));
    return result;
  }

  /// Adds an example to the conditions of a place.
  void rank(Expression& expression) {
    Expression like;
    like.condition.field = Field::like;
    Example example;
    example.recording = one_in(3) ? "quo\"te\\" : fmt::format("r{}", below(3));
    example.span = {Milliseconds(below(20)), Milliseconds(20 + below(20))};
    for (unsigned i = 0; i < below(3); ++i) {
      const Point added = point(true);
      if (std::find(example.points.begin(), example.points.end(), added) == example.points.end()) {
        example.points.push_back(added);
      }
    }
    like.condition.value = example;
    if (expression.kind == Expression::Kind::all) {
      expression.operands.push_back(like);
      return;
    }
    Expression all;
    all.kind = Expression::Kind::all;
    all.operands = {std::move(expression), like};
    expression = std::move(all);
  }

  Expression condition() {
    if (movement_ && one_in(4)) return moving();
    Expression result;
    Condition& condition = result.condition;
    switch (below(8)) {
      case 0:
      case 1:
        return gloss();
      case 2:
        return phase();
      case 3:
        return of_tier(below(4) == 0 ? "Gloss" : one_in(4) ? "No\"ne" : one_in(2) ? "Mouth" : "Phase");
      case 4:
        result = of_label(Field::recording);
        if (result.condition.compare != Compare::matches) result.condition.value = fmt::format("r{}", below(3));
        return result;
      case 5:
        condition.field = Field::hand;
        condition.compare = one_in(3) ? Compare::not_equal : Compare::equal;
        condition.value = static_cast<Hand>(below(3));
        return result;
      default:
        break;
    }
    condition = time();
    return result;
  }

  Condition time() {
    Condition condition;
    condition.field = static_cast<Field>(static_cast<int>(Field::duration) + static_cast<int>(below(3)));
    constexpr Compare kCompares[] = {Compare::equal,      Compare::not_equal, Compare::less,
                                     Compare::less_equal, Compare::greater,   Compare::greater_equal};
    condition.compare = kCompares[below(6)];
    condition.value = Milliseconds(condition.field == Field::duration ? below(6) : below(40));
    return condition;
  }

  std::mt19937& random_;
  bool movement_;
};

inline PhaseQuery random_query(std::mt19937& random, bool movement = false) {
  return RandomQueries(random, movement).query();
}

}  // namespace signweave
