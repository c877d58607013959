#pragma once

#include <fmt/format.h>

#include <random>
#include <string>
#include <utility>

#include "signweave/query/phase_query.h"
#include "signweave/query/scopes.h"

namespace signweave {

/// Random queries over the few labels and short times of the random corpora in find_property_test.cpp, so that they
/// have answers now and then.
class RandomQueries {
 public:
  explicit RandomQueries(std::mt19937& random) : random_(random) {}

  PhaseQuery query() {
    PhaseQuery result;
    const unsigned places = one_in(2) ? 1 : 1 + below(3);
    const unsigned kind = below(4);
    for (unsigned i = 0; i < places; ++i) {
      Element element{{expression(2), false}, {}};
      if (places > 1) element.term.expression = of_kind(kind);
      if (one_in(4)) element.relations.push_back({static_cast<Link>(4 + below(5)), {expression(1), false}});
      result.elements.push_back(element);
      if (i > 0) result.gaps.push_back(gap());
    }
    if (one_in(3)) {
      Element& element = result.elements[below(places)];
      (element.relations.empty() || one_in(2) ? element.term : element.relations[0].term).marked = true;
    }
    return result;
  }

 private:
  unsigned below(unsigned most) { return random_() % most; }
  bool one_in(unsigned n) { return below(n) == 0; }
  std::string label() {
    constexpr const char* kLabels[] = {"A", "B", "C", "", "quo\"te\\", "\xC3\xA9", " A"};
    return kLabels[below(one_in(3) ? 7 : 3)];
  }

  /// Sequences of signs (0, 1), of phases (2), of the annotations of a sign tier (3): the parser refuses the mixed.
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
      result.operands = {expression(depth - 1)};
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

  Expression condition() {
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
    condition.field = static_cast<Field>(static_cast<int>(Field::duration) + static_cast<int>(below(3)));
    constexpr Compare kCompares[] = {Compare::equal,      Compare::not_equal, Compare::less,
                                     Compare::less_equal, Compare::greater,   Compare::greater_equal};
    condition.compare = kCompares[below(6)];
    condition.value = Milliseconds(condition.field == Field::duration ? below(6) : below(40));
    return result;
  }

  std::mt19937& random_;
};

inline PhaseQuery random_query(std::mt19937& random) {
  return RandomQueries(random).query();
}

}  // namespace signweave
