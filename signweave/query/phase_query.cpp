#include "signweave/query/phase_query.h"

#include <fmt/format.h>

#include <cassert>

#include "signweave/query/lexer.h"

namespace signweave {
namespace {

std::string slashed(const Regex& regex) {
  std::string result = "/";
  for (std::size_t i = 0; i < regex.pattern.size(); ++i) {
    if (regex.pattern[i] == '/') result += '\\';
    result += regex.pattern[i];
    // The byte after a backslash belongs to it: a slash that is escaped already (in a tree made by hand) stays so.
    if (regex.pattern[i] == '\\' && i + 1 < regex.pattern.size()) result += regex.pattern[++i];
  }
  return result + (regex.ignore_case ? "/i" : "/");
}

std::string in_parentheses(const Expression& expression) {
  const bool composed = expression.kind == Expression::Kind::all || expression.kind == Expression::Kind::any;
  return composed ? '(' + to_string(expression) + ')' : to_string(expression);
}

std::string joined(const Expression& expression, std::string_view between) {
  std::string result;
  for (const Expression& operand : expression.operands) {
    if (!result.empty()) result += between;
    const bool bare = expression.kind == Expression::Kind::any && operand.kind == Expression::Kind::all;
    result += bare ? to_string(operand) : in_parentheses(operand);
  }
  return result;
}

std::string to_string(const Term& term) {
  return (term.marked ? "@ " : "") + to_string(term.expression);
}

}  // namespace

std::string to_string(const Condition& condition) {
  struct Printer {
    std::string operator()(const std::string& text) const { return in_quotes(text); }
    std::string operator()(const Regex& regex) const { return slashed(regex); }
    std::string operator()(PhaseKind kind) const { return std::string(word_of(kind)); }
    std::string operator()(const QueryVariable& variable) const { return "$" + variable.name; }
    std::string operator()(Hand hand) const { return std::string(word_of(hand)); }
    std::string operator()(Milliseconds time) const { return fmt::format("{}ms", time.count()); }
    std::string operator()(const Amount& amount) const { return to_string(amount); }
    std::string operator()(Height height) const { return std::string(word_of(height)); }
    std::string operator()(Across across) const { return std::string(word_of(across)); }
    std::string operator()(Reach reach) const { return std::string(word_of(reach)); }
    std::string operator()(Facing facing) const { return std::string(word_of(facing)); }
    std::string operator()(Contact contact) const { return std::string(word_of(contact)); }
    std::string operator()(const Example& example) const { return to_string(example); }
  };
  if (condition.field == Field::unit) return std::string(word_of(condition.field));
  if (condition.field == Field::like) return std::visit(Printer(), condition.value);
  const std::string field = condition.field == Field::tier       ? fmt::format("tier({})", in_quotes(condition.tier))
                            : condition.field == Field::movement ? to_string(condition.movement)
                                                                 : std::string(word_of(condition.field));
  return fmt::format("{} {} {}", field, word_of(condition.compare), std::visit(Printer(), condition.value));
}

std::string to_string(const Expression& expression) {
  switch (expression.kind) {
    case Expression::Kind::condition:
      return to_string(expression.condition);
    case Expression::Kind::all:
      return joined(expression, " & ");
    case Expression::Kind::any:
      return joined(expression, " | ");
    case Expression::Kind::negation:
      return '!' + in_parentheses(expression.operands.front());
    case Expression::Kind::link:
      return fmt::format("{}({})", word_of(expression.link), to_string(expression.operands.front()));
  }
  assert(false);
  return {};
}

std::string to_string(const Interval& gap) {
  if (gap.direct()) return "->";
  const auto bound = [](std::optional<Milliseconds> time) {
    return time ? fmt::format("{}ms", time->count()) : std::string();
  };
  return fmt::format("->[{}..{}]", bound(gap.least), bound(gap.most));
}

std::string to_string(const PhaseQuery& query) {
  std::string result;
  for (std::size_t i = 0; i < query.elements.size(); ++i) {
    if (i > 0) result += ' ' + to_string(query.gaps[i - 1]) + ' ';
    result += to_string(query.elements[i].term);
    for (const Relation& relation : query.elements[i].relations) {
      result += fmt::format(" {} {}", word_of(relation.link), to_string(relation.term));
    }
  }
  return result;
}

std::string_view word_of(Field field) noexcept {
  constexpr std::string_view kWords[] = {"gloss", "phase", "hand",     "recording", "tier",   "duration",
                                         "begin", "end",   "movement", "unit",      "signer", "like"};
  return kWords[static_cast<std::size_t>(field)];
}

std::string_view word_of(Compare compare) noexcept {
  constexpr std::string_view kWords[] = {"=", "!=", "=~", "<", "<=", ">", ">="};
  return kWords[static_cast<std::size_t>(compare)];
}

std::string_view word_of(Link link) noexcept {
  constexpr std::string_view kWords[] = {"parent", "child",  "ancestor", "descendant", "overlaps",
                                         "during", "starts", "ends",     "equals"};
  return kWords[static_cast<std::size_t>(link)];
}

std::string_view word_of(PhaseKind kind) noexcept {
  constexpr std::string_view kWords[] = {"preparation", "stroke", "retraction", "hold", "other"};
  return kWords[static_cast<std::size_t>(kind)];
}

std::string_view word_of(Hand hand) noexcept {
  constexpr std::string_view kWords[] = {"both", "right", "left"};
  return kWords[static_cast<std::size_t>(hand)];
}

}  // namespace signweave
