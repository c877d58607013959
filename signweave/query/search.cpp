#include "signweave/query/search.h"

#include <fmt/format.h>

#include <algorithm>
#include <tuple>

namespace signweave {
namespace {

constexpr std::size_t kMostAnswers = 5'000'000;
constexpr std::size_t kMostParts = 8 * kMostAnswers;  // of all answers together

/// The glosses of the signs of a unit.
std::string name_of_unit(const SegmentTable& table, RowId unit) {
  std::string name;
  const TimeSpan span = table.span(unit);
  const SegmentTable::TierRows& tier = table.tier_rows_of(unit);
  for_rows_around(table, tier, tier.own(), span, [&](RowId row) {
    if (table.kind(row) != RowKind::sign || !span.contains(table.span(row))) return true;
    if (!name.empty()) name += ' ';
    name += table.text_at(table.label(row));
    return true;
  });
  return name;
}

std::string name_of(const SegmentTable& table, RowId row) {
  const RowKind kind = table.kind(row);
  if (kind == RowKind::unit) return name_of_unit(table, row);
  const std::string_view label = table.text_at(table.label(row));
  if (kind != RowKind::phase) return std::string(label);
  const std::string_view gloss = table.text_at(table.label(table.parent(row)));
  const PhaseKind phase = table.phase(row);
  return fmt::format("{} {}", gloss, phase == PhaseKind::other ? label : word_of(phase));
}

}  // namespace

bool Search::less(const Match& a, const Match& b) const noexcept {
  if (a.recording != b.recording) return a.recording < b.recording;
  if (a.span.begin != b.span.begin) return a.span.begin < b.span.begin;
  if (a.span.end != b.span.end) return a.span.end < b.span.end;
  if (a.row != b.row) return a.row < b.row;
  return part_count_ > 0 && std::ranges::lexicographical_compare(parts_of(a), parts_of(b));
}

Search::Search(const PhaseQuery& query, const Segments::Member& member, const Movement* movement)
    : member_(member),
      table_(member.table),
      movement_(movement),
      query_(bind(query, table_, watch_, {movement, &member.numbers})),
      variables_(query, table_) {
  plan_ = plan(query_);
  start_ = plan_.element;
  rows_.resize(query_.elements.size(), kNoRow);
  for (const BoundQuery::BoundElement& element : query_.elements) {
    partners_.emplace_back(element.relations.size(), kNoRow);
    cursors_.emplace_back(element.relations.size());
    marked_ = marked_ || element.marked;
    for (const BoundQuery::BoundRelation& relation : element.relations) marked_ = marked_ || relation.marked;
  }
  single_ = query_.elements.size() == 1 && query_.elements.front().relations.empty();
  for (const BoundQuery::BoundElement& element : query_.elements) part_count_ += 1 + element.relations.size();
  if (single_) part_count_ = 0;
}

void Search::run(const FindLimits& limits) {
  limits_ = limits;
  watch_.begin(limits);
  watch_.check();
  matches_.clear();
  parts_.clear();
  counts_ = {};
  kept_ = 0;
  std::uint32_t recording = 0;
  for (const RowId row : first_rows()) {
    ++counts_.looked_at;
    if (const std::uint32_t next = table_.recording(row); next != recording) {
      if (full()) break;
      recording = next;
    }
    if (!member_.whole && member_.numbers[recording] == Segments::kNone) continue;
    if (!plan_.exact && !query_.elements[start_].matcher.accepts(row)) continue;
    if (plan_.exact) watch_.tick();
    ++counts_.kept;
    rows_[start_] = row;
    place_after(start_ + 1);
    rows_[start_] = kNoRow;
  }
  tidy();
}

void Search::append(std::vector<Segment>& segments) {
  segments.reserve(segments.size() + matches_.size());
  for (const Match& match : matches_) {
    watch_.tick();
    segments.push_back(segment_of(match));
  }
}

void Search::append(std::vector<FoundRow>& rows) const {
  rows.reserve(rows.size() + matches_.size());
  for (const Match& match : matches_) rows.push_back({match.row + member_.first, match.span});
}

std::span<const RowId> Search::first_rows() {
  if (!plan_.relation) {
    if (const auto list = one_list(plan_.accesses)) return *list;
    candidates(plan_.accesses, table_, {movement_, &member_.numbers}, candidates_);
    return candidates_;
  }
  std::vector<RowId> found;
  candidates(plan_.accesses, table_, {movement_, &member_.numbers}, found);
  BoundQuery::BoundRelation& relation = query_.elements[start_].relations[*plan_.relation];
  candidates_.clear();
  for (const RowId partner : found) {
    if (!relation.matcher.accepts(partner)) continue;
    const TimeSpan span = table_.span(partner);
    for_rows_around(table_, table_.recording(partner), span, [&](RowId other) {
      watch_.tick();
      if (other != partner && related(table_.span(other), relation.link, span)) candidates_.push_back(other);
      return true;
    });
  }
  std::sort(candidates_.begin(), candidates_.end());
  candidates_.erase(std::unique(candidates_.begin(), candidates_.end()), candidates_.end());
  return candidates_;
}

/// Fills the places from `place` to the last, then those before the first one filled.
void Search::place_after(std::size_t place) {
  if (!variables_.none() && !variables_.hold(rows_, partners_)) return;
  if (place == rows_.size()) return place_before(start_);
  const Interval& gap = query_.gaps[place - 1];
  const auto use = [&](RowId row) {
    if (row == kNoRow || !query_.elements[place].matcher.accepts(row)) return;
    rows_[place] = row;
    place_after(place + 1);
    rows_[place] = kNoRow;
  };
  if (gap.direct()) return use(next_row(table_, rows_[place - 1]));
  for (const RowId row : rows_after(table_, rows_[place - 1], gap)) use(row);
}

/// Fills the places before `place`.
void Search::place_before(std::size_t place) {
  if (!variables_.none() && !variables_.hold(rows_, partners_)) return;
  if (place == 0) return relate(0, 0);
  const Interval& gap = query_.gaps[place - 1];
  const auto use = [&](RowId row) {
    if (!query_.elements[place - 1].matcher.accepts(row)) return;
    rows_[place - 1] = row;
    place_before(place - 1);
    rows_[place - 1] = kNoRow;
  };
  const RowId from = rows_[place];
  for (const RowId row : gap.direct() ? previous_rows(table_, from) : rows_before(table_, from, gap)) use(row);
}

/// Calls `use(row)` for the partners of a row in a relation, in no order.
template <typename Use>
void Search::for_partners(RowId row, BoundQuery::BoundRelation& relation, TierCursor& cursor, Use&& use) {
  const TimeSpan span = table_.span(row);
  const auto look = [&](RowId other) {
    watch_.tick();
    if (other != row && related(span, relation.link, table_.span(other)) && relation.matcher.accepts(other)) use(other);
    return true;
  };
  const std::uint32_t recording = table_.recording(row);
  if (!relation.tiers) return for_rows_around(table_, recording, span, look);
  for (const std::uint32_t tier : *relation.tiers) {
    const bool known = cursor.tier != nullptr && cursor.tier->recording == recording && cursor.tier->tier == tier;
    const SegmentTable::TierRows* rows = known ? cursor.tier : table_.tier_rows(recording, tier);
    if (rows == nullptr) continue;
    if (!rows->apart()) {
      for_rows_around(table_, *rows, rows->own(), span, look);
      continue;
    }
    const RowId end = rows->own_end;
    for (RowId other = first_ending_at_or_after(table_, *rows, span.begin, cursor);
         other < end && table_.begin(other) <= span.end; ++other) {
      look(other);
    }
  }
}

/// Finds partners from this relation of this element on: all of them where they are the answer or a variable decides,
/// else the first in time.
void Search::relate(std::size_t e, std::size_t r) {
  if (e == rows_.size()) return keep();
  BoundQuery::BoundElement& element = query_.elements[e];
  if (r == element.relations.size()) return relate(e + 1, 0);
  BoundQuery::BoundRelation& relation = element.relations[r];
  TierCursor& cursor = cursors_[e][r];
  RowId& partner = partners_[e][r];
  if (!relation.marked && variables_.none()) {
    RowId first = kNoRow;
    for_partners(rows_[e], relation, cursor, [&](RowId other) {
      if (first == kNoRow || earlier(other, first)) first = other;
    });
    if (first == kNoRow) return;
    partner = first;
    relate(e, r + 1);
  } else {
    std::vector<RowId> all;
    for_partners(rows_[e], relation, cursor, [&](RowId other) { all.push_back(other); });
    if (!variables_.none()) std::ranges::sort(all, [this](RowId a, RowId b) { return earlier(a, b); });
    for (const RowId other : all) {
      partner = other;
      if (!variables_.none() && !variables_.hold(rows_, partners_)) continue;
      const std::size_t before = kept_;
      relate(e, r + 1);
      // The first that leads to an answer; where another part is asked for, that may need others.
      if (!marked_ && kept_ > before) break;
    }
  }
  partner = kNoRow;
}

bool Search::earlier(RowId a, RowId b) const noexcept {
  const TimeSpan one = table_.span(a);
  const TimeSpan other = table_.span(b);
  return std::tie(one.begin, one.end, a) < std::tie(other.begin, other.end, b);
}

void Search::keep() {
  Match match;
  match.recording = table_.recording(rows_.front());
  match.row = rows_.front();
  match.span = {table_.begin(rows_.front()), table_.end(rows_.back())};
  match.parts = static_cast<std::uint32_t>(parts_.size());
  for (std::size_t e = 0; e < rows_.size() && !single_; ++e) {
    parts_.push_back(rows_[e]);
    if (query_.elements[e].marked) answer_with(rows_[e], match);
    for (std::size_t r = 0; r < partners_[e].size(); ++r) {
      parts_.push_back(partners_[e][r]);
      if (query_.elements[e].relations[r].marked) answer_with(partners_[e][r], match);
    }
  }
  matches_.push_back(match);
  ++kept_;
  const std::size_t most = limits_.limit ? 2 * std::min(*limits_.limit, kMostAnswers) + 4096 : kMostAnswers;
  if (matches_.size() <= most && parts_.size() <= kMostParts) return;
  tidy();
  if ((!limits_.limit && matches_.size() >= kMostAnswers) || parts_.size() > kMostParts) {
    throw Error(ErrorCode::bad_input,
                fmt::format("query: more than {} answers; narrow it, or give a limit", kMostAnswers));
  }
}

void Search::answer_with(RowId row, Match& match) const noexcept {
  match.row = row;
  match.span = table_.span(row);
}

/// Sorts what was found, drops what is there twice, and what is past the limit.
void Search::tidy() {
  watch_.check();
  const auto before = [this](const Match& a, const Match& b) { return less(a, b); };
  if (!std::is_sorted(matches_.begin(), matches_.end(), before)) std::sort(matches_.begin(), matches_.end(), before);
  const bool by_row = one_row();
  const auto same = [&](const Match& a, const Match& b) {
    return a.row == b.row && (by_row || std::ranges::equal(parts_of(a), parts_of(b)));
  };
  matches_.erase(std::unique(matches_.begin(), matches_.end(), same), matches_.end());
  if (limits_.limit && matches_.size() > *limits_.limit) matches_.resize(*limits_.limit);
  if (part_count_ == 0 || parts_.size() <= 2 * part_count_ * matches_.size()) return;
  std::vector<RowId> kept;  // what nothing refers to any more would only grow
  kept.reserve(part_count_ * matches_.size());
  for (Match& match : matches_) {
    const std::span<const RowId> parts = parts_of(match);
    match.parts = static_cast<std::uint32_t>(kept.size());
    kept.insert(kept.end(), parts.begin(), parts.end());
  }
  parts_ = std::move(kept);
}

bool Search::full() {
  if (!limits_.limit || matches_.size() < *limits_.limit) return false;
  tidy();
  return matches_.size() >= *limits_.limit;
}

Segment Search::segment_of(const Match& match) const {
  Segment result;
  result.recording = table_.recording_at(match.recording);
  result.span = match.span;
  result.row = match.row + member_.first;
  const std::span<const RowId> parts = parts_of(match);
  for (const RowId row : parts) {
    result.parts.push_back({row + member_.first, name_of(table_, row), table_.span(row)});
  }
  if (!variables_.none()) {
    std::vector<RowId> rows = rows_;
    std::vector<std::vector<RowId>> partners = partners_;
    std::size_t part = 0;
    for (std::size_t e = 0; e < rows.size(); ++e) {
      rows[e] = single_ ? match.row : parts[part++];
      for (RowId& partner : partners[e]) partner = parts[part++];
    }
    result.bindings = variables_.values(rows, partners);
  }
  if (one_row()) {
    result.name = name_of(table_, match.row);
    return result;
  }
  std::size_t part = 0;
  for (const BoundQuery::BoundElement& element : query_.elements) {
    if (part > 0) result.name += ' ';
    result.name += result.parts[part].name;
    part += 1 + element.relations.size();
  }
  return result;
}

}  // namespace signweave
