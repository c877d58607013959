#include "signweave/query/explain.h"

#include <fmt/format.h>

#include <algorithm>

#include "signweave/query/movement_check.h"
#include "signweave/query/plan.h"
#include "signweave/query/rank.h"

namespace signweave {
namespace {

/// The places from `first` to `last` as text, without relations and groups.
std::string shown(const PhaseQuery& query, std::size_t first, std::size_t last) {
  PhaseQuery part;
  part.elements.assign(query.elements.begin() + static_cast<std::ptrdiff_t>(first),
                       query.elements.begin() + static_cast<std::ptrdiff_t>(last) + 1);
  part.gaps.assign(query.gaps.begin() + static_cast<std::ptrdiff_t>(first),
                   query.gaps.begin() + static_cast<std::ptrdiff_t>(last));
  for (Element& element : part.elements) {
    element.relations.clear();
    element.groups.clear();
  }
  const std::string text = to_string(part);
  return first == last ? text : '(' + text + ')';
}

void find_slow(const Expression& expression, std::vector<std::string>& found) {
  const Condition& condition = expression.condition;
  if (expression.kind == Expression::Kind::condition && condition.field == Field::movement &&
      !is_scannable(condition.movement)) {
    found.push_back(to_string(condition));
  }
  for (const Expression& operand : expression.operands) find_slow(operand, found);
}

/// The expression, and which of its conditions are read from the motion. The sequence inside a link reports its own.
std::string condition_text(const Expression& expression) {
  std::vector<std::string> slow;
  find_slow(expression, slow);
  std::string text = to_string(expression);
  if (slow.empty()) return text;
  if (slow.size() == 1 && slow.front() == text) return text + ", read from the motion";
  return fmt::format("{}; read from the motion if the rest does not decide: {}", text, fmt::join(slow, ", "));
}

std::string follow(const PhaseQuery& query, std::size_t from, std::size_t to) {
  const Interval& gap = query.gaps[std::min(from, to)];
  const std::string_view where = to > from ? "after" : "before";
  const std::string how = gap.direct() ? fmt::format("the row directly {}", where)
                                       : fmt::format("the rows {} within {}", where, to_string(gap));
  return fmt::format("{}: keep those with {}", how, condition_text(query.elements[to].term.expression));
}

/// The partner at this index: first the relations of an element, then those of the groups that end there.
const Term& partner(const Element& element, std::size_t relation) {
  if (relation < element.relations.size()) return element.relations[relation].term;
  relation -= element.relations.size();
  auto group = element.groups.begin();
  for (; relation >= group->relations.size(); ++group) relation -= group->relations.size();
  return group->relations[relation].term;
}

class Explainer {
 public:
  explicit Explainer(const Segments::Member& member) : member_(member) {}

  std::vector<std::string> take() { return std::move(steps_); }

  void add_plan(const PhaseQuery& query) {
    StopCheck stop_check;
    BoundQuery bound = bind(query, member_, nullptr, stop_check, false);
    const Plan chosen = plan(bound);
    for (const AccessPath& access : chosen.access_paths) {
      if (access.through.empty()) continue;
      add(fmt::format("look up about {} rows: {}", access.rows, fmt::join(access.through, " and ")));
    }
    const Element& start = query.elements[chosen.element];
    if (chosen.relation) {
      add(fmt::format("keep those with {}", condition_text(partner(start, *chosen.relation).expression)));
      add("take the rows around each of them");
    }
    add(fmt::format("keep those with {}", condition_text(start.term.expression)));
    for (std::size_t e = chosen.element + 1; e < query.elements.size(); ++e) add(follow(query, e - 1, e));
    for (std::size_t e = chosen.element; e > 0; --e) add(follow(query, e, e - 1));
    for (std::size_t e = 0; e < query.elements.size(); ++e) {
      relate(query, query.elements[e].relations, e, e);
      for (const Group& group : query.elements[e].groups) {
        const std::size_t first = e + 1 - group.places;
        for (const Condition& condition : group.conditions) {
          add(fmt::format("keep those where {} has {}", shown(query, first, e), to_string(condition)));
        }
        relate(query, group.relations, first, e);
      }
    }
  }

 private:
  void add(const std::string& step) { steps_.push_back(std::string(indent_, ' ') + step); }

  void relate(const PhaseQuery& query, const std::vector<Relation>& relations, std::size_t first, std::size_t last) {
    for (const Relation& relation : relations) {
      const std::string before =
          fmt::format("find the partner: {} {}", shown(query, first, last), word_of(relation.link));
      if (relation.sequence.empty()) {
        add(fmt::format("{} {}", before, condition_text(relation.term.expression)));
        continue;
      }
      add(fmt::format("{} a match found in its recording by:", before));
      indent_ += 3;
      add_plan(relation.sequence.front());
      indent_ -= 3;
    }
  }

  const Segments::Member& member_;
  std::vector<std::string> steps_;
  std::size_t indent_ = 0;
};

}  // namespace

std::string explain(const PhaseQuery& query, const Segments& segments) {
  const Segments::Member none;
  const auto largest =
      std::ranges::max_element(segments.members(), {}, [](const auto& one) { return one.table.size(); });
  Explainer explainer(segments.members().empty() ? none : *largest);
  explainer.add_plan(query);
  std::vector<std::string> steps = explainer.take();
  if (const std::optional<std::size_t> place = ranked_place(query)) {
    steps.push_back(fmt::format("order by the distance from {}: the nearest, {} without a limit",
                                to_string(example_at(query, *place)), kNearest));
  }
  std::string result = to_string(query) + '\n';
  for (std::size_t i = 0; i < steps.size(); ++i) result += fmt::format("{}. {}\n", i + 1, steps[i]);
  return result;
}

}  // namespace signweave
