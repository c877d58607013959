#include "signweave/query/neighbours.h"

#include <algorithm>
#include <cassert>
#include <cstdlib>

namespace signweave {
namespace {

using RowRange = SegmentTable::RowRange;

const SegmentTable::TierRows& tier_of(const SegmentTable& table, RowId row) noexcept {
  const std::span<const SegmentTable::TierRows> tiers = table.tiers_of(table.row(row).recording);
  const auto at = std::lower_bound(tiers.begin(), tiers.end(), table.row(row).tier,
                                   [](const auto& rows, std::uint32_t tier) { return rows.tier < tier; });
  assert(at != tiers.end());
  return *at;
}

/// The rows that may stand in a sequence with `row`: the group it lies in.
RowRange group_of(const SegmentTable& table, RowId row) noexcept {
  const SegmentTable::TierRows& tier = tier_of(table, row);
  return table.row(row).extra ? tier.extra : tier.own;
}

/// Extra rows of different sorts or of the signs of different tiers share a group: whether two are of one sort.
bool same_sort(const SegmentTable& table, RowId a, RowId b) noexcept {
  const SegmentRow& one = table.row(a);
  const SegmentRow& other = table.row(b);
  if (!one.extra) return true;
  return one.inferred == other.inferred && table.row(one.parent).tier == table.row(other.parent).tier;
}

/// One step within a group; `by` is 1 or −1.
RowId step_in_group(const SegmentTable& table, RowId row, int by) noexcept {
  const RowRange group = group_of(table, row);
  const bool sign = table.row(row).kind == RowKind::sign;
  for (std::int64_t at = std::int64_t{row} + by; at >= group.begin && at < group.end; at += by) {
    const auto other = static_cast<RowId>(at);
    if (sign && table.row(other).kind != RowKind::sign) continue;
    if (same_sort(table, row, other)) return other;
  }
  return kNoRow;
}

RowId step(const SegmentTable& table, RowId row, int by) noexcept {
  const SegmentRow& from = table.row(row);
  if (!from.extra || !from.inferred) return step_in_group(table, row, by);
  // Neighbours are the signs: an inferred stroke is not next to the one beyond a sign that has phases of its own.
  const RowId sign = step_in_group(table, from.parent, by);
  if (sign == kNoRow) return kNoRow;
  for (const RowId child : table.children(sign)) {
    if (table.row(child).extra && table.row(child).inferred) return child;
  }
  return kNoRow;
}

}  // namespace

RowId first_ending_at_or_after(std::span<const SegmentRow> rows, RowRange range, Milliseconds time) noexcept {
  const std::span<const SegmentRow> part = rows.subspan(range.begin, range.size());
  const auto at =
      std::partition_point(part.begin(), part.end(), [&](const SegmentRow& row) { return row.span.end < time; });
  return range.begin + static_cast<RowId>(at - part.begin());
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
  // A sign follows the sign before it, and the annotation between them that is no sign.
  const RowRange group = group_of(table, row);
  if (!table.row(row).extra && row > group.begin && row - 1 != stepped) offer(row - 1);
  return result;
}

std::vector<RowId> rows_after(const SegmentTable& table, RowId row, const Interval& gap) {
  const RowRange group = group_of(table, row);
  const Milliseconds end = table.row(row).span.end;
  const Milliseconds first = end + gap.least.value_or(0ms);
  const std::span<const SegmentRow> later = table.rows().subspan(row + 1, group.end - (row + 1));
  const auto begin = std::partition_point(later.begin(), later.end(),
                                          [&](const SegmentRow& other) { return other.span.begin < first; });
  std::vector<RowId> result;
  for (auto at = static_cast<RowId>(row + 1 + (begin - later.begin())); at < group.end; ++at) {
    if (gap.most && table.row(at).span.begin > end + *gap.most) break;
    if (same_sort(table, row, at)) result.push_back(at);
  }
  return result;
}

std::vector<RowId> rows_before(const SegmentTable& table, RowId row, const Interval& gap) {
  const SegmentTable::TierRows& tier = tier_of(table, row);
  const RowRange group = group_of(table, row);
  const Milliseconds begin = table.row(row).span.begin;
  const Milliseconds last = begin - gap.least.value_or(0ms);
  RowId at = group.begin;
  if (tier.apart && gap.most) at = first_ending_at_or_after(table.rows(), {at, row}, begin - *gap.most);
  std::vector<RowId> result;
  for (; at < row; ++at) {
    const Milliseconds end = table.row(at).span.end;
    if (tier.apart && end > last) break;
    if (end <= last && (!gap.most || end >= begin - *gap.most) && same_sort(table, row, at)) result.push_back(at);
  }
  return result;
}

bool related(TimeSpan one, Link link, TimeSpan other) noexcept {
  switch (link) {
    case Link::overlaps:
      return one.overlaps(other);
    case Link::during:
      return other.contains(one);
    case Link::starts:
      return one.begin == other.begin;
    case Link::ends:
      return one.end == other.end;
    case Link::equals:
      return one == other;
    case Link::parent:
    case Link::child:
    case Link::ancestor:
    case Link::descendant:
      break;
  }
  assert(false && "not a relation of time");
  return false;
}

}  // namespace signweave
