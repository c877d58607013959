#include "signweave/query/matcher.h"

#include <algorithm>

#include "signweave/core/text.h"
#include "signweave/query/neighbours.h"
#include "signweave/query/regex.h"
#include "signweave/query/search.h"

namespace signweave {
namespace {

constexpr unsigned kPhaseKindCount = 5;

/// Annotations nest a few levels deep; a damaged document may contain a cycle of parents.
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
  constexpr unsigned kAll = (1U << kPhaseKindCount) - 1;
  unsigned result = 0;
  if (const Regex* regex = std::get_if<Regex>(&condition.value)) {
    const std::unique_ptr<RE2> compiled = compile(*regex);
    for (unsigned kind = 0; kind < kPhaseKindCount; ++kind) {
      const std::string word(word_of(static_cast<PhaseKind>(kind)));
      if (RE2::FullMatch(word, *compiled)) result |= 1U << kind;
    }
    return result;
  }
  result = 1U << static_cast<unsigned>(std::get<PhaseKind>(condition.value));
  return condition.compare == Compare::equal ? result : kAll & ~result;
}

/// A sign is measured over its strokes, any other row over its span.
std::vector<TimeSpan> measured_spans_of(const SegmentTable& table, RowId row) {
  if (table.kind(row) != RowKind::sign) return {table.span(row)};
  std::vector<TimeSpan> result;
  for (const RowId child : table.children(row)) {
    if (table.kind(child) == RowKind::phase && table.phase(child) == PhaseKind::stroke) {
      result.push_back(table.span(child));
    }
  }
  return result;
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

bool holds(const Condition& condition, TimeSpan span) noexcept {
  const Milliseconds time = condition.field == Field::begin ? span.begin
                            : condition.field == Field::end ? span.end
                                                            : span.duration();
  return compares(time, condition.compare, std::get<Milliseconds>(condition.value));
}

bool reads_motion(const BoundExpression& expression) noexcept {
  const BoundCondition& condition = expression.condition;
  if (expression.kind == Expression::Kind::condition) return condition.movement && !condition.movement->scannable();
  if (expression.linked) return reads_motion(expression.linked->root());
  return std::ranges::any_of(expression.operands, reads_motion);
}

Matcher::Matcher(const Expression& expression, const Segments::Member& member, const Movement* movement,
                 StopCheck& stop_check, Plain plain)
    : member_(&member),
      table_(&member.table),
      movement_(movement),
      stop_check_(&stop_check),
      plain_(plain),
      tier_names_(tiers_named(expression)),
      scopes_(scopes_of(expression, tier_names_)) {
  for (const std::string& name : tier_names_) tiers_.push_back(tiers_called(name, *table_));
  root_ = bind(expression);
  reads_motion_ = reads_motion(root_);
}

BoundExpression Matcher::bind(const Expression& expression) {
  BoundExpression result;
  result.kind = expression.kind;
  result.link = expression.link;
  if (expression.kind == Expression::Kind::condition) {
    result.condition = bind(expression.condition);
  } else if (expression.kind == Expression::Kind::link) {
    const Plain plain = expression.link <= Link::descendant ? Plain::any : Plain::sign;
    if (!expression.sequence.empty()) {
      result.sequence = std::make_shared<Search>(expression.sequence.front(), *member_, movement_, *stop_check_, false);
    } else {
      result.linked = std::make_unique<Matcher>(expression.operands.front(), *member_, movement_, *stop_check_, plain);
    }
  } else {
    result.top = top_scope(expression, tier_names_);
    for (const Expression& operand : expression.operands) result.operands.push_back(bind(operand));
    if (expression.kind == Expression::Kind::all) {
      std::stable_partition(result.operands.begin(), result.operands.end(),
                            [](const BoundExpression& operand) { return !reads_motion(operand); });
    }
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
    case Field::signer:
      if (std::holds_alternative<QueryVariable>(condition.value)) {
        result.variable = true;
        break;
      }
      if (const Regex* regex = std::get_if<Regex>(&condition.value)) {
        stop_check_->check();
        result.regex = compile(*regex);
        result.known.resize(table_->text_count());
      } else {
        result.text = match_form(std::get<std::string>(condition.value));
        result.label = table_->find_text(result.text);
      }
      break;
    case Field::unit:
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
    case Field::movement:
    case Field::hands:
      result.movement = std::make_unique<MovementCheck>(condition, movement_);
      break;
    case Field::like:
      break;
  }
  return result;
}

bool Matcher::try_label(BoundCondition& condition, std::uint32_t label) {
  stop_check_->tick();
  const bool fits = RE2::FullMatch(table_->text_at(label), *condition.regex);
  condition.known[label] = fits ? kFits : 1;
  return fits;
}

bool Matcher::accepts(RowId row) {
  stop_check_->tick();
  if (root_.kind == Expression::Kind::condition) {  // the common case, without going through scopes
    BoundCondition& condition = root_.condition;
    if (condition.field == Field::gloss) {
      return table_->kind(row) == RowKind::sign && fits(condition, table_->label(row));
    }
    if (condition.field == Field::tier) {
      return !table_->extra(row) && std::ranges::find(condition.tiers, table_->tier(row)) != condition.tiers.end() &&
             fits(condition, table_->label(row));
    }
  }
  if (reads_motion_ && !scopes_.has(scopes_of_row(row))) return false;
  const Scopes found = holds(root_, row);
  return !found.empty() && found.has(scopes_of_row(row));
}

std::optional<std::vector<std::uint32_t>> Matcher::only_tiers() const {
  Scopes tiers = Scopes::none();
  std::vector<std::uint32_t> result;
  for (unsigned place = 0; place < tiers_.size(); ++place) {
    tiers = tiers | Scopes::tier(place);
    if (scopes_.has(Scopes::tier(place))) result.insert(result.end(), tiers_[place].begin(), tiers_[place].end());
  }
  if (!((scopes_ | tiers) == tiers)) return std::nullopt;
  std::ranges::sort(result);
  result.erase(std::unique(result.begin(), result.end()), result.end());
  return result;
}

Scopes Matcher::scopes_of_row(RowId row) const noexcept {
  const RowKind kind = table_->kind(row);
  if (kind == RowKind::unit) return Scopes::units();
  Scopes result = Scopes::linked();
  if (plain_ == Plain::any || kind == RowKind::sign) result = result | Scopes::plain();
  if (kind == RowKind::sign) result = result | Scopes::signs();
  if (kind == RowKind::phase) result = result | Scopes::phases();
  if (tiers_.empty() || table_->extra(row)) return result;
  const std::uint32_t tier = table_->tier(row);
  for (unsigned place = 0; place < tiers_.size(); ++place) {
    if (std::find(tiers_[place].begin(), tiers_[place].end(), tier) != tiers_[place].end()) {
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
      const bool found = expression.sequence ? holds_for_sequence(expression.link, *expression.sequence, row)
                                             : holds_for_linked(expression.link, *expression.linked, row);
      return found ? scope : Scopes::none();
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

bool Matcher::holds(BoundCondition& condition, RowId row) {
  switch (condition.field) {
    case Field::gloss: {
      const RowKind kind = table_->kind(row);
      if (kind != RowKind::sign && kind != RowKind::phase) return false;
      return fits(condition, table_->label(kind == RowKind::sign ? row : table_->parent(row)));
    }
    case Field::phase:
      return table_->kind(row) == RowKind::phase &&
             (condition.set >> static_cast<unsigned>(table_->phase(row)) & 1U) != 0;
    case Field::hand:
      return table_->kind(row) != RowKind::annotation &&
             (condition.set >> static_cast<unsigned>(table_->hand(row)) & 1U) != 0;
    case Field::recording:
      return condition.recordings[table_->recording(row)];
    case Field::unit:
      return table_->kind(row) == RowKind::unit;
    case Field::signer: {
      const std::string signer = match_form(table_->text_at(table_->tier_rows_of(row).signer));
      if (condition.regex) return RE2::FullMatch(signer, *condition.regex);
      return (signer == condition.text) == (condition.compare == Compare::equal);
    }
    case Field::tier:
      return holds_on_tier(condition, row);
    case Field::duration:
      return compares(table_->span(row).duration(), condition.compare, condition.time);
    case Field::begin:
      return compares(table_->begin(row), condition.compare, condition.time);
    case Field::end:
      return compares(table_->end(row), condition.compare, condition.time);
    case Field::movement:
    case Field::hands:
      return holds_moving(*condition.movement, row);
    case Field::like:
      return true;  // it only orders the answers
  }
  return false;
}

bool Matcher::holds_moving(MovementCheck& check, RowId row) {
  if (movement_ == nullptr) return false;
  const std::uint32_t recording = table_->recording(row);
  const std::uint32_t number = member_->numbers[recording];
  if (number == SegmentTable::kNone) return false;
  const RowKind kind = table_->kind(row);
  const Hand hand = table_->hand(row);
  const MovingRow moving{.row = row - table_->recording_rows(recording).begin,
                         .recording = number,
                         .any_hand = kind == RowKind::annotation || hand == Hand::both,
                         .hand = hand == Hand::left ? Side::left : Side::right};
  return check.holds(moving, [&] { return measured_spans_of(*table_, row); });
}

bool Matcher::holds_on_tier(BoundCondition& condition, RowId row) {
  const SegmentTable::TierRows& own = table_->tier_rows_of(row);
  const TimeSpan span = table_->span(row);
  for (const std::uint32_t tier : condition.tiers) {
    if (own.tier == tier && !table_->extra(row)) {
      if (fits(condition, table_->label(row))) return true;
      continue;
    }
    const SegmentTable::TierRows* rows = table_->tier_rows(own.recording, tier);
    if (rows == nullptr) continue;
    bool found = false;
    for_rows_around(*table_, *rows, rows->own(), span, [&](RowId other) {
      stop_check_->tick();
      found = span.overlaps(table_->span(other)) && fits(condition, table_->label(other));
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
  const TimeSpan span = table_->span(row);
  bool found = false;
  for_rows_around(*table_, table_->recording(row), span, [&](RowId other) {
    found = other != row && related(span, link, table_->span(other)) && linked.accepts(other);
    return !found;
  });
  return found;
}

bool Matcher::holds_for_sequence(Link link, Search& sequence, RowId row) {
  bool found = false;
  sequence.for_related(table_->recording(row), table_->span(row), link, [&](const Search::Match& match) {
    found = !sequence.has_place(match, row);
    return !found;
  });
  return found;
}

}  // namespace signweave
