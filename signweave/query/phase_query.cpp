#include "signweave/query/phase_query.h"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>

#include "signweave/query/lexer.h"

namespace signweave {
namespace {

std::string slashed(const Regex& regex) {
  std::string result = "/";
  for (std::size_t i = 0; i < regex.pattern.size(); ++i) {
    if (regex.pattern[i] == '/') result += '\\';
    result += regex.pattern[i];
    // The byte after a backslash belongs to it: a slash that is already escaped (in a tree built by hand) stays
    // escaped.
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

/// Whether the query is already in parentheses: one group over all of it, which is in no relation.
bool is_closed(const PhaseQuery& query) noexcept {
  const std::vector<Group>& groups = query.elements.back().groups;
  return !groups.empty() && groups.back().places == query.elements.size() && groups.back().relations.empty();
}

void append(const std::vector<Relation>& relations, std::string& text) {
  for (const Relation& relation : relations) {
    text += fmt::format(" {} ", word_of(relation.link));
    if (relation.sequence.empty()) {
      text += to_string(relation.term);
    } else {
      const PhaseQuery& partner = relation.sequence.front();
      text += is_closed(partner) ? to_string(partner) : '(' + to_string(partner) + ')';
    }
  }
}

}  // namespace

std::string to_string(const Condition& condition) {
  struct Printer {
    std::string operator()(const std::string& text) const { return in_quotes(text); }
    std::string operator()(const Regex& regex) const { return slashed(regex); }
    std::string operator()(PhaseKind kind) const { return std::string(word_of(kind)); }
    std::string operator()(const QueryVariable& variable) const { return "$" + variable.name; }
    std::string operator()(Hand hand) const { return std::string(word_of(hand)); }
    std::string operator()(Hands hands) const { return std::string(word_of(hands)); }
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
  if (condition.field == Field::movement && is_aim(condition.movement.quantity)) {
    const auto& within = std::get<Amount>(condition.value);
    const bool usual = within.value == tolerance_of(condition.movement.quantity);
    return to_string(condition.movement) + (usual ? "" : " within " + to_string(within));
  }
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
      return fmt::format("{}({})", word_of(expression.link),
                         expression.sequence.empty() ? to_string(expression.operands.front())
                                                     : to_string(expression.sequence.front()));
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
  const std::size_t count = query.elements.size();
  std::vector<std::string> opened(count);  // text before each place
  for (std::size_t i = 0; i < count; ++i) {
    for (const Group& group : query.elements[i].groups) {
      std::string& before = opened[i + 1 - group.places];
      before = (group.marked ? "@ (" : "(") + before;
    }
  }
  std::string result;
  for (std::size_t i = 0; i < count; ++i) {
    const Element& element = query.elements[i];
    if (i > 0) result += ' ' + to_string(query.gaps[i - 1]) + ' ';
    result += opened[i] + to_string(element.term);
    append(element.relations, result);
    for (const Group& group : element.groups) {
      result += ')';
      for (const Condition& condition : group.conditions) result += " & " + to_string(condition);
      append(group.relations, result);
    }
  }
  return result;
}

std::size_t part_count(const Relation& relation) noexcept {
  return relation.sequence.empty() ? 1 : part_count(relation.sequence.front());
}

std::size_t part_count(const PhaseQuery& query) noexcept {
  return part_of_place(query, query.elements.size());
}

std::size_t part_of_place(const PhaseQuery& query, std::size_t place) noexcept {
  std::size_t result = 0;
  const auto add = [&](const std::vector<Relation>& relations) {
    for (const Relation& relation : relations) result += part_count(relation);
  };
  for (std::size_t i = 0; i < place; ++i) {
    ++result;
    add(query.elements[i].relations);
    for (const Group& group : query.elements[i].groups) add(group.relations);
  }
  return result;
}

std::vector<std::size_t> marked_parts(const PhaseQuery& query) {
  std::vector<std::size_t> result;
  std::size_t part = 0;
  const auto partners = [&](const std::vector<Relation>& relations) {
    for (const Relation& relation : relations) {
      if (relation.sequence.empty()) {
        if (relation.term.marked) result = {part};
      } else if (is_marked(relation)) {
        result = marked_parts(relation.sequence.front());
        for (std::size_t& one : result) one += part;
      }
      part += part_count(relation);
    }
  };
  for (std::size_t place = 0; place < query.elements.size(); ++place) {
    const Element& element = query.elements[place];
    if (element.term.marked) result = {part};
    ++part;
    partners(element.relations);
    for (const Group& group : element.groups) {
      if (group.marked) {
        result.clear();
        for (std::size_t of = place + 1 - group.places; of <= place; ++of) result.push_back(part_of_place(query, of));
      }
      partners(group.relations);
    }
  }
  return result;
}

bool is_marked(const Relation& relation) noexcept {
  return relation.sequence.empty() ? relation.term.marked : is_marked(relation.sequence.front());
}

bool is_marked(const PhaseQuery& query) noexcept {
  const auto marked = [](const auto& relation) { return is_marked(relation); };
  return std::ranges::any_of(query.elements, [&](const Element& element) {
    return element.term.marked || std::ranges::any_of(element.relations, marked) ||
           std::ranges::any_of(element.groups, [&](const Group& group) {
             return group.marked || std::ranges::any_of(group.relations, marked);
           });
  });
}

std::string_view word_of(Field field) noexcept {
  constexpr std::string_view kWords[] = {"gloss", "phase",    "hand",  "recording", "tier",   "duration", "begin",
                                         "end",   "movement", "hands", "unit",      "signer", "like"};
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

std::string_view word_of(Hands hands) noexcept {
  return name_of(hands);
}

std::string_view word_of(Hand hand) noexcept {
  constexpr std::string_view kWords[] = {"both", "right", "left"};
  return kWords[static_cast<std::size_t>(hand)];
}

}  // namespace signweave
