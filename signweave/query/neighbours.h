#pragma once

#include <algorithm>
#include <cassert>
#include <span>
#include <vector>

#include "signweave/query/phase_query.h"
#include "signweave/semantic_db/segment_table.h"

namespace signweave {

// Steps from one row of a segment table to others, by time. All are binary searches on the tiers of one recording
// (linear in the tier only if annotations of a faulty document overlap on one tier).

/// The row that directly follows. Sign: the next sign of its tier (annotations with an empty label are not signs and
/// are skipped). Other annotation: the next one of its tier. Inferred stroke: the stroke of the next sign, if that is
/// inferred too. kNoRow if there is no such row, or it is of another kind.
RowId next_row(const SegmentTable& table, RowId row);
/// The rows whose `next_row` is `row`: at most two.
std::vector<RowId> previous_rows(const SegmentTable& table, RowId row);

/// The rows of the same tier (inferred strokes among themselves) after `row` whose begin is `gap` after its end,
/// ascending. `gap` must have a bound.
std::vector<RowId> rows_after(const SegmentTable& table, RowId row, const Interval& gap);
/// The rows before `row` whose end is `gap` before its begin, ascending.
std::vector<RowId> rows_before(const SegmentTable& table, RowId row, const Interval& gap);

/// The first row of a range that ends at `time` or later. No two rows of the range may overlap.
RowId first_with_end_at_or_after(const SegmentTable& table, SegmentTable::RowRange range, Milliseconds time) noexcept;

/// The position of the last search on one tier; the next search usually continues from there.
struct TierCursor {
  const SegmentTable::TierRows* tier = nullptr;
  RowId at = 0;
};

/// The same as `first_with_end_at_or_after(table, tier.own(), time)`, starting at the cursor, which is updated.
inline RowId first_with_end_at_or_after(const SegmentTable& table, const SegmentTable::TierRows& tier,
                                        Milliseconds time, TierCursor& cursor) noexcept {
  constexpr RowId kSteps = 8;
  const SegmentTable::RowRange own = tier.own();
  RowId row = cursor.tier == &tier ? cursor.at : own.begin;
  cursor.tier = &tier;
  if (row == own.begin || table.end(row - 1) < time) {
    const RowId last = std::min(own.end, row + kSteps);
    while (row < last && table.end(row) < time) ++row;
    if (row < last || row == own.end) return cursor.at = row;
    return cursor.at = first_with_end_at_or_after(table, {row, own.end}, time);
  }
  return cursor.at = first_with_end_at_or_after(table, {own.begin, row}, time);
}

/// Whether two spans are in a relation (`Link::overlaps` and the ones after it).
inline bool related(TimeSpan one, Link link, TimeSpan other) noexcept {
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

/// Calls `use(row)` for the rows of one range of a tier that share time or a bound with `span`. Stops if `use` returns
/// false, and then returns false.
template <typename Use>
bool for_rows_around(const SegmentTable& table, const SegmentTable::TierRows& tier, SegmentTable::RowRange range,
                     TimeSpan span, Use&& use) {
  RowId row = tier.apart() ? first_with_end_at_or_after(table, range, span.begin) : range.begin;
  for (; row < range.end && table.begin(row) <= span.end; ++row) {
    if (table.end(row) >= span.begin && !use(row)) return false;
  }
  return true;
}

/// The same for all rows of a recording: a superset of the rows for which `related` holds.
template <typename Use>
void for_rows_around(const SegmentTable& table, std::uint32_t recording, TimeSpan span, Use&& use) {
  for (const SegmentTable::TierRows& tier : table.tiers_of(recording)) {
    if (!for_rows_around(table, tier, tier.own(), span, use)) return;
    if (!for_rows_around(table, tier, tier.extra(), span, use)) return;
    if (!for_rows_around(table, tier, tier.units(), span, use)) return;
  }
}

}  // namespace signweave
