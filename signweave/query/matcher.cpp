#include "signweave/query/matcher.h"

#include <algorithm>

#include "signweave/core/text.h"
#include "signweave/query/neighbours.h"
#include "signweave/query/regex.h"

namespace signweave {
namespace {

constexpr unsigned kPhaseKinds = 5;

/// Annotations nest a few levels deep; a damaged document may hold a ring of parents.
constexpr int kMostGenerations = 64;

/// The tiers of that name, compared as labels are.
std::vector<std::uint32_t> tiers_called(const std::string& name, const SegmentTable& table) {
  const std::string wanted = match_form(name);
  std::vector<std::uint32_t> result;
  for (std::uint32_t tier = 0; tier < table.tier_count(); ++tier) {
    if (table.tier_at(tier) == name || match_form(table.tier_at(tier)) == wanted) result.push_back(tier);
  }
  return result;
}

std::vector<bool> recordings_called(const Condition& condition, const SegmentTable& table) {
  const std::uint32_t count = table.recording_count();
  std::vector<bool> result(count, condition.compare == Compare::not_equal);
  if (const Regex* regex = std::get_if<Regex>(&condition.value)) {
    const std::unique_ptr<RE2> compiled = compile(*regex);
    for (std::uint32_t i = 0; i < count; ++i) result[i] = RE2::FullMatch(match_form(table.recording_at(i)), *compiled);
    return result;
  }
  const std::string& name = std::get<std::string>(condition.value);
  const bool found = condition.compare == Compare::equal;
  if (const std::uint32_t exact = table.find_recording(name); exact != SegmentTable::kNone) {
    result[exact] = found;
    return result;
  }
  const std::string wanted = match_form(name);
  for (std::uint32_t i = 0; i < count; ++i) {
    if (match_form(table.recording_at(i)) == wanted) result[i] = found;
  }
  return result;
}

unsigned phases_called(const Condition& condition) {
  constexpr unsigned kAll = (1U << kPhaseKinds) - 1;
  unsigned result = 0;
  if (const Regex* regex = std::get_if<Regex>(&condition.value)) {
    const std::unique_ptr<RE2> compiled = compile(*regex);
    for (unsigned kind = 0; kind < kPhaseKinds; ++kind) {
      const std::string word(word_of(static_cast<PhaseKind>(kind)));
      if (RE2::FullMatch(word, *compiled)) result |= 1U << kind;
    }
    return result;
  }
  result = 1U << static_cast<unsigned>(std::get<PhaseKind>(condition.value));
  return condition.compare == Compare::equal ? result : kAll & ~result;
}

bool compares(Milliseconds time, Compare compare, Milliseconds value) noexcept {
  switch (compare) {
    case Compare::equal:
      return time == value;
    case Compare::not_equal:
      return time != value;
    case Compare::less:
      return time < value;
    case Compare::less_equal:
      return time <= value;
    case Compare::greater:
      return time > value;
    case Compare::greater_equal:
      return time >= value;
    case Compare::matches:
      break;
  }
  return false;
}

}  // namespace

Matcher::Matcher(const Expression& expression, const SegmentTable& table, Watch& watch, Plain plain)
    : table_(&table),
      watch_(&watch),
      plain_(plain),
      tier_names_(tiers_named(expression)),
      scopes_(scopes_of(expression, tier_names_)) {
  for (const std::string& name : tier_names_) tiers_.push_back(tiers_called(name, table));
  root_ = bind(expression);
}

BoundExpression Matcher::bind(const Expression& expression) {
  BoundExpression result;
  result.kind = expression.kind;
  result.link = expression.link;
  if (expression.kind == Expression::Kind::condition) {
    result.condition = bind(expression.condition);
  } else if (expression.kind == Expression::Kind::link) {
    const Plain plain = expression.link <= Link::descendant ? Plain::any : Plain::sign;
    result.linked = std::make_unique<Matcher>(expression.operands.front(), *table_, *watch_, plain);
  } else {
    result.top = top_scope(expression, tier_names_);
    for (const Expression& operand : expression.operands) result.operands.push_back(bind(operand));
  }
  return result;
}

BoundCondition Matcher::bind(const Condition& condition) {
  BoundCondition result;
  result.source = &condition;
  result.field = condition.field;
  result.compare = condition.compare;
  result.scope = scope_of(condition, tier_names_);
  switch (condition.field) {
    case Field::tier: {
      const auto place = std::find(tier_names_.begin(), tier_names_.end(), condition.tier) - tier_names_.begin();
      result.tiers = tiers_[static_cast<std::size_t>(place)];
      [[fallthrough]];
    }
    case Field::gloss:
      if (const Regex* regex = std::get_if<Regex>(&condition.value)) {
        result.regex = compile(*regex);
        result.known.resize(table_->text_count());
      } else {
        result.label = table_->find_text(match_form(std::get<std::string>(condition.value)));
      }
      break;
    case Field::phase:
      result.set = phases_called(condition);
      break;
    case Field::hand:
      result.set = 1U << static_cast<unsigned>(std::get<Hand>(condition.value));
      if (condition.compare == Compare::not_equal) result.set = ~result.set;
      break;
    case Field::recording:
      result.recordings = recordings_called(condition, *table_);
      break;
    case Field::duration:
    case Field::begin:
    case Field::end:
      result.time = std::get<Milliseconds>(condition.value);
      break;
  }
  return result;
}

bool Matcher::fits(BoundCondition& condition, std::uint32_t label) {
  if (!condition.regex) return (condition.label == label) == (condition.compare == Compare::equal);
  std::uint8_t& known = condition.known[label];
  if (known == 0) {
    watch_->tick();
    known = RE2::FullMatch(table_->text_at(label), *condition.regex) ? 2 : 1;
  }
  return known == 2;
}

bool Matcher::accepts(RowId row) {
  watch_->tick();
  const Scopes found = holds(root_, row);
  return !found.empty() && found.has(scopes_of_row(row));
}

Scopes Matcher::scopes_of_row(RowId id) const noexcept {
  const SegmentRow row = table_->row(id);
  if (row.kind == RowKind::unit) return Scopes::none();
  Scopes result = Scopes::linked();
  if (plain_ == Plain::any || row.kind == RowKind::sign) result = result | Scopes::plain();
  if (row.kind == RowKind::sign) result = result | Scopes::signs();
  if (row.kind == RowKind::phase) result = result | Scopes::phases();
  if (row.extra) return result;
  for (unsigned place = 0; place < tiers_.size(); ++place) {
    if (std::find(tiers_[place].begin(), tiers_[place].end(), row.tier) != tiers_[place].end()) {
      result = result | Scopes::tier(place);
    }
  }
  return result;
}

Scopes Matcher::holds(BoundExpression& expression, RowId row) {
  switch (expression.kind) {
    case Expression::Kind::condition:
      return holds(expression.condition, row) ? expression.condition.scope : Scopes::none();
    case Expression::Kind::negation:
      return holds(expression.operands.front(), row).empty() ? expression.top : Scopes::none();
    case Expression::Kind::link: {
      const Scopes scope = expression.link <= Link::descendant ? Scopes::linked() : Scopes::plain();
      return holds_for_linked(expression.link, *expression.linked, row) ? scope : Scopes::none();
    }
    case Expression::Kind::any: {
      Scopes result = Scopes::none();
      for (BoundExpression& operand : expression.operands) result = result | holds(operand, row);
      return result;
    }
    case Expression::Kind::all:
      break;
  }
  Scopes result = holds(expression.operands.front(), row);
  for (std::size_t i = 1; i < expression.operands.size() && !result.empty(); ++i) {
    const Scopes other = holds(expression.operands[i], row);
    result = other.empty() ? other : result & other;
  }
  return result;
}

bool Matcher::holds(BoundCondition& condition, RowId id) {
  const SegmentRow row = table_->row(id);
  switch (condition.field) {
    case Field::gloss: {
      if (row.kind == RowKind::annotation || row.kind == RowKind::unit) return false;
      return fits(condition, row.kind == RowKind::sign ? row.label : table_->label(row.parent));
    }
    case Field::phase:
      return row.kind == RowKind::phase && (condition.set >> static_cast<unsigned>(row.phase) & 1U) != 0;
    case Field::hand:
      return row.kind != RowKind::annotation && (condition.set >> static_cast<unsigned>(row.hand) & 1U) != 0;
    case Field::recording:
      return condition.recordings[row.recording];
    case Field::tier:
      return holds_on_tier(condition, id);
    case Field::duration:
      return compares(row.span.duration(), condition.compare, condition.time);
    case Field::begin:
      return compares(row.span.begin, condition.compare, condition.time);
    case Field::end:
      return compares(row.span.end, condition.compare, condition.time);
  }
  return false;
}

bool Matcher::holds_on_tier(BoundCondition& condition, RowId id) {
  const SegmentRow row = table_->row(id);
  for (const std::uint32_t tier : condition.tiers) {
    if (row.tier == tier && !row.extra) {
      if (fits(condition, row.label)) return true;
      continue;
    }
    const SegmentTable::TierRows* rows = table_->tier_rows(row.recording, tier);
    if (rows == nullptr) continue;
    bool found = false;
    for_rows_around(*table_, *rows, rows->own(), row.span, [&](RowId other) {
      watch_->tick();
      found = row.span.overlaps(table_->span(other)) && fits(condition, table_->label(other));
      return !found;
    });
    if (found) return true;
  }
  return false;
}

bool Matcher::holds_for_linked(Link link, Matcher& linked, RowId row) {
  switch (link) {
    case Link::parent:
    case Link::ancestor:
      for (int generation = 0; generation < kMostGenerations; ++generation) {
        row = table_->parent(row);
        if (row == kNoRow) return false;
        if (linked.accepts(row)) return true;
        if (link == Link::parent) return false;
      }
      return false;
    case Link::child:
    case Link::descendant: {
      std::vector<RowId> generation = {row};
      for (int i = 0; i < kMostGenerations && !generation.empty(); ++i) {
        std::vector<RowId> next;
        for (const RowId each : generation) {
          for (const RowId child : table_->children(each)) {
            if (linked.accepts(child)) return true;
            next.push_back(child);
          }
        }
        if (link == Link::child) return false;
        generation = std::move(next);
      }
      return false;
    }
    case Link::overlaps:
    case Link::during:
    case Link::starts:
    case Link::ends:
    case Link::equals:
      break;
  }
  const SegmentRow from = table_->row(row);
  bool found = false;
  for_rows_around(*table_, from.recording, from.span, [&](RowId other) {
    found = other != row && related(from.span, link, table_->span(other)) && linked.accepts(other);
    return !found;
  });
  return found;
}

}  // namespace signweave
