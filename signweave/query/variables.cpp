#include "signweave/query/variables.h"

#include <algorithm>
#include <optional>

#include "signweave/core/text.h"
#include "signweave/query/neighbours.h"

namespace signweave {

VariableCheck::VariableCheck(const PhaseQuery& query, const SegmentTable& table, StopCheck& stop_check)
    : table_(&table), stop_check_(&stop_check) {
  std::size_t part = 0;
  for_parts(query, [&](const Term& term) { collect_uses(term.expression, part++); });
}

void VariableCheck::collect_uses(const Expression& expression, std::size_t part) {
  if (expression.kind == Expression::Kind::all) {
    for (const Expression& operand : expression.operands) collect_uses(operand, part);
    return;
  }
  if (expression.kind != Expression::Kind::condition) return;
  const Condition& condition = expression.condition;
  const QueryVariable* name = std::get_if<QueryVariable>(&condition.value);
  if (name == nullptr) return;
  Use use{.part = part, .field = condition.field, .tiers = {}, .equal = condition.compare == Compare::equal};
  if (condition.field == Field::tier) {
    for (std::uint32_t tier = 0; tier < table_->tier_count(); ++tier) {
      if (match_form(table_->tier_at(tier)) == match_form(condition.tier)) use.tiers.push_back(tier);
    }
  }
  auto at = std::ranges::find(variables_, name->name, &Variable::name);
  if (at == variables_.end()) at = variables_.insert(variables_.end(), Variable{name->name, {}});
  at->uses.push_back(std::move(use));
}

void VariableCheck::labels_of(const Use& use, RowId row, std::vector<std::uint32_t>& labels) const {
  labels.clear();
  if (use.field == Field::gloss) {
    const RowKind kind = table_->kind(row);
    if (kind == RowKind::sign) labels.push_back(table_->label(row));
    if (kind == RowKind::phase) labels.push_back(table_->label(table_->parent(row)));
    return;
  }
  const SegmentTable::TierRows& own = table_->tier_rows_of(row);
  const TimeSpan span = table_->span(row);
  for (const std::uint32_t tier : use.tiers) {
    if (own.tier == tier && !table_->extra(row)) {
      labels.push_back(table_->label(row));
      continue;
    }
    const SegmentTable::TierRows* rows = table_->tier_rows(own.recording, tier);
    if (rows == nullptr) continue;
    for_rows_around(*table_, *rows, rows->own(), span, [&](RowId other) {
      stop_check_->tick();
      if (span.overlaps(table_->span(other))) labels.push_back(table_->label(other));
      return true;
    });
  }
  std::ranges::sort(labels);
  labels.erase(std::unique(labels.begin(), labels.end()), labels.end());
}

bool VariableCheck::value_of(const Variable& variable, std::span<const RowId> parts, std::uint32_t& value) const {
  std::optional<std::vector<std::uint32_t>> possible;
  std::vector<std::uint32_t> labels;
  const auto row_of = [&](const Use& use) { return parts[use.part]; };
  for (const Use& use : variable.uses) {
    if (!use.equal || row_of(use) == kNoRow) continue;
    labels_of(use, row_of(use), labels);
    if (!possible) {
      possible = labels;
    } else {
      std::erase_if(*possible, [&](std::uint32_t one) { return !std::ranges::binary_search(labels, one); });
    }
    if (possible->empty()) return false;
  }
  value = SegmentTable::kNone;
  if (!possible) return true;  // nothing restricts its value yet
  for (const Use& use : variable.uses) {
    if (use.equal || row_of(use) == kNoRow) continue;
    labels_of(use, row_of(use), labels);
    // As for a text: some label of the tier is another; for a sign, its gloss is.
    std::erase_if(*possible, [&](std::uint32_t one) {
      return std::ranges::all_of(labels, [&](std::uint32_t label) { return label == one; });
    });
    if (possible->empty()) return false;
  }
  value = possible->front();
  return true;
}

bool VariableCheck::hold(std::span<const RowId> parts) const {
  std::uint32_t value = 0;
  return std::ranges::all_of(variables_, [&](const Variable& variable) { return value_of(variable, parts, value); });
}

std::vector<std::pair<std::string, std::string>> VariableCheck::values(std::span<const RowId> parts) const {
  std::vector<std::pair<std::string, std::string>> result;
  for (const Variable& variable : variables_) {
    std::uint32_t value = 0;
    if (!value_of(variable, parts, value) || value == SegmentTable::kNone) continue;
    result.emplace_back(variable.name, table_->text_at(value));
  }
  return result;
}

}  // namespace signweave
