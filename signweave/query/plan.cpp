#include "signweave/query/plan.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>

#include "signweave/query/search.h"

namespace signweave {
namespace {

/// Estimated number of phases per sign.
constexpr std::size_t kChildrenPerRow = 3;
/// Testing this many values of a column costs about as much as one row from an index.
constexpr std::size_t kRowsPerScan = 16;

std::vector<AccessPath> access_paths_of(Matcher& matcher);

/// Chooses the access path for the answers of one scope.
class AccessPathFinder {
 public:
  AccessPathFinder(Matcher& matcher, Scopes scope) : matcher_(matcher), table_(matcher.table()), scope_(scope) {}

  AccessPath find() {
    std::optional<AccessPath> found = of(matcher_.root());
    return found ? std::move(*found) : all_in_scope();
  }

 private:
  /// nullopt if no index helps.
  std::optional<AccessPath> of(BoundExpression& expression) {
    switch (expression.kind) {
      case Expression::Kind::condition:
        // A condition of a more specific scope has no answer in this one.
        if ((expression.condition.scope & scope_) != scope_) return AccessPath();
        return of(expression.condition);
      case Expression::Kind::negation:
        if ((expression.top & scope_) != scope_) return AccessPath();
        return std::nullopt;
      case Expression::Kind::all:
        return of_all(expression);
      case Expression::Kind::any:
        return of_any(expression);
      case Expression::Kind::link:
        return of_link(expression);
    }
    return std::nullopt;
  }

  std::optional<AccessPath> of_all(BoundExpression& expression) {
    std::optional<AccessPath> best;
    for (BoundExpression& operand : expression.operands) {
      std::optional<AccessPath> other = of(operand);
      if (other && (!best || other->rows < best->rows)) best = std::move(other);
    }
    return best;
  }

  std::optional<AccessPath> of_any(BoundExpression& expression) {
    AccessPath sum;
    for (BoundExpression& operand : expression.operands) {
      std::optional<AccessPath> other = of(operand);
      if (!other) return std::nullopt;
      sum.lists.insert(sum.lists.end(), other->lists.begin(), other->lists.end());
      sum.parents.insert(sum.parents.end(), other->parents.begin(), other->parents.end());
      sum.ranges.insert(sum.ranges.end(), other->ranges.begin(), other->ranges.end());
      sum.scans.insert(sum.scans.end(), other->scans.begin(), other->scans.end());
      sum.through.insert(sum.through.end(), other->through.begin(), other->through.end());
      sum.rows += other->rows;
    }
    return sum;
  }

  /// parent(…): the children of the rows that meet the condition inside, if an index leads to those.
  std::optional<AccessPath> of_link(BoundExpression& expression) {
    if (expression.link != Link::parent) return std::nullopt;
    AccessPath result;
    for (const AccessPath& inner : access_paths_of(*expression.linked)) {
      if (!inner.ranges.empty() || !inner.parents.empty() || !inner.scans.empty()) return std::nullopt;
      result.parents.insert(result.parents.end(), inner.lists.begin(), inner.lists.end());
      result.rows += inner.rows * kChildrenPerRow;
      for (const std::string& through : inner.through) result.through.push_back("the children of " + through);
    }
    return result;
  }

  std::optional<AccessPath> of(BoundCondition& condition) {
    if (condition.field != Field::phase && condition.compare == Compare::not_equal) return std::nullopt;
    if (condition.variable) return std::nullopt;
    AccessPath access;
    switch (condition.field) {
      case Field::gloss:
        add_gloss(condition, access);
        break;
      case Field::phase:
        for (unsigned kind = 0; kind < 5; ++kind) {
          if ((condition.set >> kind & 1U) != 0) add(table_.phases(static_cast<PhaseKind>(kind)), access.lists, access);
        }
        access.through.push_back(fmt::format("the phase index ({})", to_string(*condition.source)));
        break;
      case Field::tier:
        // Only if the answers are on that tier; otherwise the condition is about annotations that overlap them.
        if (condition.scope != scope_ || condition.regex) return std::nullopt;
        for (const RowKind kind : {RowKind::annotation, RowKind::sign, RowKind::phase}) {
          add(table_.with_label(kind, condition.label), access.lists, access);
        }
        access.through.push_back(fmt::format("the label index ({})", to_string(*condition.source)));
        break;
      case Field::recording:
        for (std::uint32_t i = 0; i < condition.recordings.size(); ++i) {
          if (condition.recordings[i]) add(table_.recording_rows(i), access);
        }
        access.through.push_back(fmt::format("all rows of the recordings with {}", to_string(*condition.source)));
        break;
      case Field::unit:
        add(table_.units(), access.lists, access);
        access.through.push_back("all units");
        break;
      case Field::signer:
      case Field::hand:
      case Field::duration:
      case Field::begin:
      case Field::end:
      case Field::like:
        return std::nullopt;
      case Field::movement:
      case Field::hands:
        if (!condition.movement->scannable()) return std::nullopt;
        access.scans.push_back(condition.movement.get());
        access.rows = table_.size() / kRowsPerScan + 1;
        access.through.push_back(fmt::format("the movement column ({})", to_string(*condition.source)));
        break;
    }
    return access;
  }

  void add_gloss(BoundCondition& condition, AccessPath& access) {
    std::vector<std::span<const RowId>>& target = scope_ == Scopes::phases() ? access.parents : access.lists;
    if (condition.regex) {
      for (const std::uint32_t label : table_.labels_of(RowKind::sign)) {
        if (matcher_.fits(condition, label)) add(table_.with_label(RowKind::sign, label), target, access);
      }
    } else {
      add(table_.with_label(RowKind::sign, condition.label), target, access);
    }
    const bool phases = scope_ == Scopes::phases();
    if (phases) access.rows *= kChildrenPerRow;
    access.through.push_back(fmt::format("the gloss index{} ({})", phases ? " and the phases of its signs" : "",
                                         to_string(*condition.source)));
  }

  static void add(std::span<const RowId> rows, std::vector<std::span<const RowId>>& lists, AccessPath& access) {
    if (rows.empty()) return;
    lists.push_back(rows);
    access.rows += rows.size();
  }

  static void add(SegmentTable::RowRange range, AccessPath& access) {
    if (range.size() == 0) return;
    access.ranges.push_back(range);
    access.rows += range.size();
  }

  AccessPath all_in_scope() {
    AccessPath access;
    if (scope_ == Scopes::phases()) {
      for (unsigned kind = 0; kind < 5; ++kind) {
        add(table_.phases(static_cast<PhaseKind>(kind)), access.lists, access);
      }
      access.through.emplace_back("all phases");
      return access;
    }
    for (unsigned place = 0; place < matcher_.tiers().size(); ++place) {
      if (scope_ != Scopes::tier(place)) continue;
      for (std::uint32_t recording = 0; recording < table_.recording_count(); ++recording) {
        for (const std::uint32_t tier : matcher_.tiers()[place]) {
          const SegmentTable::TierRows* rows = table_.tier_rows(recording, tier);
          if (rows != nullptr) add(rows->own(), access);
        }
      }
      access.of_tier = true;
      access.through.emplace_back("all annotations of the tier");
      return access;
    }
    add({0, table_.size()}, access);
    access.through.emplace_back("all rows");
    return access;
  }

  Matcher& matcher_;
  const SegmentTable& table_;
  Scopes scope_;
};

std::vector<AccessPath> access_paths_of(Matcher& matcher) {
  std::vector<AccessPath> result;
  const auto add = [&](Scopes scope) {
    if (matcher.scopes().has(scope)) result.push_back(AccessPathFinder(matcher, scope).find());
  };
  add(Scopes::units());
  add(Scopes::phases());
  add(Scopes::signs());
  for (unsigned place = 0; place < matcher.tiers().size(); ++place) add(Scopes::tier(place));
  add(Scopes::linked());
  add(Scopes::plain());
  return result;
}

/// Whether an index leads to exactly the rows for which the condition holds.
bool is_exact(const BoundExpression& expression) noexcept {
  if (expression.kind != Expression::Kind::condition || expression.condition.variable) return false;
  const Field field = expression.condition.field;
  if (field == Field::gloss) return expression.condition.compare != Compare::not_equal;
  return field == Field::phase || field == Field::unit;
}

std::size_t rows_of(std::span<const AccessPath> access_paths) noexcept {
  std::size_t result = 0;
  for (const AccessPath& access : access_paths) result += access.rows;
  return result;
}

}  // namespace

BoundQuery bind(const PhaseQuery& query, const Segments::Member& member, const Movement* movement,
                StopCheck& stop_check, bool all) {
  BoundQuery result;
  result.gaps = query.gaps;
  std::size_t part = 0;
  const auto add = [&](const std::vector<Relation>& relations, std::size_t places) {
    std::vector<BoundQuery::BoundRelation>& bound = result.elements.back().relations;
    for (const Relation& relation : relations) {
      bound.push_back({.link = relation.link, .places = places, .marked = is_marked(relation), .part = part});
      part += part_count(relation);
      if (relation.sequence.empty()) {
        bound.back().matcher.emplace(relation.term.expression, member, movement, stop_check);
        bound.back().tiers = bound.back().matcher->only_tiers();
      } else {
        const PhaseQuery& partner = relation.sequence.front();
        bound.back().sequence = std::make_shared<Search>(partner, member, movement, stop_check, all);
      }
    }
  };
  for (const Element& element : query.elements) {
    result.places.push_back(part);
    result.elements.push_back(
        {.matcher = Matcher(element.term.expression, member, movement, stop_check), .part = part++});
    add(element.relations, 1);
    for (const Group& group : element.groups) {
      for (const Condition& condition : group.conditions) {
        result.elements.back().wholes.push_back({group.places, &condition});
      }
      add(group.relations, group.places);
    }
  }
  result.answer = marked_parts(query);
  result.marked = !result.answer.empty();
  if (!result.marked) result.answer = result.places;
  return result;
}

Plan plan(BoundQuery& query) {
  // Finding the element around a partner costs about as much as testing this many rows.
  constexpr std::size_t kAround = 8;
  std::optional<Plan> best;
  const auto offer = [&](Plan offered) {
    if (!best || offered.rows < best->rows) best = std::move(offered);
  };
  const auto all_of_tiers = [](Matcher& matcher, std::span<const AccessPath> access_paths) {
    return matcher.only_tiers() && std::ranges::all_of(access_paths, &AccessPath::of_tier);
  };
  for (std::size_t e = 0; e < query.elements.size(); ++e) {
    BoundQuery::BoundElement& element = query.elements[e];
    std::vector<AccessPath> access_paths = access_paths_of(element.matcher);
    const std::size_t rows = rows_of(access_paths);
    const bool on_tier = all_of_tiers(element.matcher, access_paths);
    offer({.element = e,
           .access_paths = std::move(access_paths),
           .rows = rows,
           .exact = is_exact(element.matcher.root()),
           .on_tier = on_tier});
    for (std::size_t r = 0; r < element.relations.size(); ++r) {
      BoundQuery::BoundRelation& relation = element.relations[r];
      if (relation.sequence || relation.places > 1) continue;
      std::vector<AccessPath> around = access_paths_of(*relation.matcher);
      const std::size_t partners = rows_of(around);
      offer({.element = e, .relation = r, .access_paths = std::move(around), .rows = partners * kAround});
    }
  }
  return std::move(*best);
}

std::optional<std::span<const RowId>> one_list(std::span<const AccessPath> access_paths) noexcept {
  std::optional<std::span<const RowId>> found = std::span<const RowId>();
  for (const AccessPath& access : access_paths) {
    if (!access.parents.empty() || !access.ranges.empty() || !access.scans.empty()) return std::nullopt;
    for (const std::span<const RowId> list : access.lists) {
      if (!found->empty()) return std::nullopt;
      found = list;
    }
  }
  return found;
}

void candidates(std::span<const AccessPath> access_paths, const SegmentTable& table, const MovingTable& moving,
                StopCheck& stop_check, std::vector<RowId>& result) {
  result.clear();
  const auto add = [&](RowId row) {
    stop_check.tick();
    result.push_back(row);
  };
  for (const AccessPath& access : access_paths) {
    for (const std::span<const RowId> list : access.lists) std::ranges::for_each(list, add);
    for (const std::span<const RowId> list : access.parents) {
      for (const RowId parent : list) {
        stop_check.tick();
        const std::span<const RowId> children = table.children(parent);
        result.insert(result.end(), children.begin(), children.end());
      }
    }
    for (const SegmentTable::RowRange range : access.ranges) {
      for (RowId row = range.begin; row < range.end; ++row) add(row);
    }
    for (MovementCheck* scan : access.scans) {
      if (moving.movement == nullptr) continue;
      for (std::uint32_t recording = 0; recording < table.recording_count(); ++recording) {
        stop_check.check();
        const std::uint32_t number = (*moving.numbers)[recording];
        const SegmentTable::RowRange rows = table.recording_rows(recording);
        if (number == SegmentTable::kNone || scan->scan(number, rows.begin, result)) continue;
        for (RowId row = rows.begin; row < rows.end; ++row) add(row);  // nothing is stored for it
      }
    }
  }
  sort_rows(result, table.size(), stop_check);
}

void sort_rows(std::vector<RowId>& rows, RowId table_size, StopCheck& stop_check) {
  bool ascending = true;
  for (std::size_t i = 1; i < rows.size() && ascending; ++i) {
    stop_check.tick();
    ascending = rows[i - 1] < rows[i];
  }
  if (ascending) return;
  if (rows.size() > table_size / 64) {  // a bitmap of all rows is faster then
    std::vector<std::uint64_t> there(table_size / 64 + 1);
    for (const RowId row : rows) {
      stop_check.tick();
      there[row / 64] |= std::uint64_t{1} << row % 64;
    }
    rows.clear();
    for (std::size_t word = 0; word < there.size(); ++word) {
      stop_check.tick();
      for (std::uint64_t left = there[word]; left != 0; left &= left - 1) {
        rows.push_back(static_cast<RowId>(64 * word) + static_cast<RowId>(std::countr_zero(left)));
      }
    }
    return;
  }
  std::ranges::sort(rows, [&](RowId a, RowId b) {
    stop_check.tick();
    return a < b;
  });
  rows.erase(std::unique(rows.begin(), rows.end()), rows.end());
}

}  // namespace signweave
