#include "signweave/query/scopes.h"

#include <algorithm>

namespace signweave {
namespace {

void collect(const Expression& expression, std::vector<std::string>& tiers) {
  if (expression.kind == Expression::Kind::link) return;
  if (expression.kind == Expression::Kind::condition && expression.condition.field == Field::tier &&
      std::find(tiers.begin(), tiers.end(), expression.condition.tier) == tiers.end()) {
    tiers.push_back(expression.condition.tier);
  }
  for (const Expression& operand : expression.operands) collect(operand, tiers);
}

}  // namespace

std::vector<std::string> tiers_named(const Expression& expression) {
  std::vector<std::string> tiers;
  collect(expression, tiers);
  return tiers;
}

Scopes scope_of(const Condition& condition, const std::vector<std::string>& tiers) {
  switch (condition.field) {
    case Field::phase:
      return Scopes::phases();
    case Field::gloss:
    case Field::hand:
      return Scopes::signs();
    case Field::tier: {
      const auto at = std::find(tiers.begin(), tiers.end(), condition.tier);
      return Scopes::tier(static_cast<unsigned>(at - tiers.begin()));
    }
    case Field::unit:
      return Scopes::units();
    case Field::recording:
    case Field::signer:
    case Field::duration:
    case Field::begin:
    case Field::end:
    case Field::movement:
    case Field::hands:
    case Field::like:
      break;
  }
  return Scopes::plain();
}

Scopes scopes_of(const Expression& expression, const std::vector<std::string>& tiers) {
  switch (expression.kind) {
    case Expression::Kind::condition:
      return scope_of(expression.condition, tiers);
    case Expression::Kind::negation:
      return top_scope(expression, tiers);
    case Expression::Kind::link:
      return expression.link <= Link::descendant ? Scopes::linked() : Scopes::plain();
    case Expression::Kind::all:
    case Expression::Kind::any:
      break;
  }
  Scopes result = scopes_of(expression.operands.front(), tiers);
  for (std::size_t i = 1; i < expression.operands.size(); ++i) {
    const Scopes other = scopes_of(expression.operands[i], tiers);
    result = expression.kind == Expression::Kind::all ? result & other : result | other;
  }
  return result;
}

Scopes top_scope(const Expression& expression, const std::vector<std::string>& tiers) {
  if (expression.kind == Expression::Kind::condition || expression.kind == Expression::Kind::link) {
    return scopes_of(expression, tiers);
  }
  Scopes result = Scopes::none();
  for (const Expression& operand : expression.operands) result = result | top_scope(operand, tiers);
  return result.top();
}

}  // namespace signweave
