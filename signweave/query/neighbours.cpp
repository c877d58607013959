#include "signweave/query/neighbours.h"

#include <algorithm>
#include <cstdlib>

namespace signweave {
namespace {

using RowRange = SegmentTable::RowRange;

/// The rows that may follow or precede `row` in a sequence: its group.
RowRange group_of(const SegmentTable& table, RowId row) noexcept {
  const SegmentTable::TierRows& tier = table.tier_rows_of(row);
  if (table.kind(row) == RowKind::unit) return tier.units();
  return table.extra(row) ? tier.extra() : tier.own();
}

/// Extra rows of different kinds, or of the signs of different tiers, share a group: whether two are of the same kind.
bool same_sort(const SegmentTable& table, RowId a, RowId b) noexcept {
  if (!table.extra(a) || table.kind(a) == RowKind::unit) return true;
  return table.inferred(a) == table.inferred(b) && table.tier(table.parent(a)) == table.tier(table.parent(b));
}

/// One step within a group; `by` is 1 or −1.
RowId step_in_group(const SegmentTable& table, RowId row, int by) noexcept {
  const RowRange group = group_of(table, row);
  const bool sign = table.kind(row) == RowKind::sign;
  for (std::int64_t at = std::int64_t{row} + by; at >= group.begin && at < group.end; at += by) {
    const auto other = static_cast<RowId>(at);
    if (sign && table.kind(other) != RowKind::sign) continue;
    if (same_sort(table, row, other)) return other;
  }
  return kNoRow;
}

RowId step(const SegmentTable& table, RowId row, int by) noexcept {
  if (!table.extra(row) || !table.inferred(row)) return step_in_group(table, row, by);
  // Neighbourhood is defined on the signs: an inferred stroke is not next to the one beyond a sign that has phases of
  // its own.
  const RowId sign = step_in_group(table, table.parent(row), by);
  if (sign == kNoRow) return kNoRow;
  for (const RowId child : table.children(sign)) {
    if (table.extra(child) && table.inferred(child)) return child;
  }
  return kNoRow;
}

}  // namespace

RowId first_with_end_at_or_after(const SegmentTable& table, RowRange range, Milliseconds time) noexcept {
  return first_row(range, [&](RowId row) { return table.end(row) >= time; });
}

RowId next_row(const SegmentTable& table, RowId row) {
  return step(table, row, 1);
}

std::vector<RowId> previous_rows(const SegmentTable& table, RowId row) {
  std::vector<RowId> result;
  const auto offer = [&](RowId previous) {
    if (previous != kNoRow && next_row(table, previous) == row) result.push_back(previous);
  };
  const RowId stepped = step(table, row, -1);
  offer(stepped);
  // A sign follows the previous sign, and also the annotation between them that is not a sign.
  const RowRange group = group_of(table, row);
  if (!table.extra(row) && row > group.begin && row - 1 != stepped) offer(row - 1);
  return result;
}

std::vector<RowId> rows_after(const SegmentTable& table, RowId row, const Interval& gap) {
  const RowRange group = group_of(table, row);
  const Milliseconds end = table.end(row);
  const Milliseconds first = end + gap.least.value_or(0ms);
  std::vector<RowId> result;
  for (RowId at = first_row({row + 1, group.end}, [&](RowId other) { return table.begin(other) >= first; });
       at < group.end; ++at) {
    if (gap.most && table.begin(at) > end + *gap.most) break;
    if (same_sort(table, row, at)) result.push_back(at);
  }
  return result;
}

std::vector<RowId> rows_before(const SegmentTable& table, RowId row, const Interval& gap) {
  const SegmentTable::TierRows& tier = table.tier_rows_of(row);
  const RowRange group = group_of(table, row);
  const Milliseconds begin = table.begin(row);
  const Milliseconds last = begin - gap.least.value_or(0ms);
  RowId at = group.begin;
  if (tier.apart() && gap.most) at = first_with_end_at_or_after(table, {at, row}, begin - *gap.most);
  std::vector<RowId> result;
  for (; at < row; ++at) {
    const Milliseconds end = table.end(at);
    if (tier.apart() && end > last) break;
    if (end <= last && (!gap.most || end >= begin - *gap.most) && same_sort(table, row, at)) result.push_back(at);
  }
  return result;
}

}  // namespace signweave
