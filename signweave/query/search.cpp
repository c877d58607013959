#include "signweave/query/search.h"

#include <fmt/format.h>

#include <algorithm>
#include <tuple>

namespace signweave {
namespace {

constexpr std::size_t kMostAnswers = 5'000'000;
constexpr std::size_t kMostParts = 2 * kMostAnswers;  // of all answers together
constexpr std::size_t kMany = 65'536;
// Limit of the matches in one recording for a partner that is a sequence; a query may have sixteen such partners.
constexpr std::size_t kMostPartners = 400'000;
constexpr std::size_t kMostPartsOfPartners = 2 * kMostPartners;
/// A unit with more signs is named after the first of them.
constexpr int kMostNames = 64;

/// A large vector reserves its maximum size at once: address space costs nothing, while copying millions of values as
/// it grows takes longer than a search may take to stop.
template <typename Value>
void make_room(std::vector<Value>& values, std::size_t added, std::size_t most) {
  if (values.capacity() < values.size() + added && values.size() >= kMany) values.reserve(most);
}

/// The glosses of the signs of a unit.
std::string name_of_unit(const SegmentTable& table, RowId unit) {
  std::string name;
  int names = 0;
  const TimeSpan span = table.span(unit);
  const SegmentTable::TierRows& tier = table.tier_rows_of(unit);
  for_rows_around(table, tier, tier.own(), span, [&](RowId row) {
    if (table.kind(row) != RowKind::sign || !span.contains(table.span(row))) return true;
    if (!name.empty()) name += ' ';
    if (++names > kMostNames) {
      name += "…";
      return false;
    }
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

Search::Search(const PhaseQuery& query, const Segments::Member& member, const Movement* movement,
               const FindLimits& limits)
    : Search(query, member, movement, nullptr, limits, false) {}

Search::Search(const PhaseQuery& query, const Segments::Member& member, const Movement* movement, StopCheck& stop_check,
               bool all)
    : Search(query, member, movement, &stop_check, {}, all) {}

Search::Search(const PhaseQuery& query, const Segments::Member& member, const Movement* movement, StopCheck* stop_check,
               const FindLimits& limits, bool all)
    : member_(member),
      table_(member.table),
      movement_(movement),
      own_stop_check_(limits),
      stop_check_(stop_check != nullptr ? *stop_check : own_stop_check_),
      variables_(query, table_, stop_check_),
      inner_(stop_check != nullptr),
      all_rows_(all || !variables_.none()),
      exhaustive_(inner_ && (all || is_marked(query))),
      query_(bind(query, member, movement, stop_check_, all_rows_)) {
  plan_ = plan(query_);
  start_ = plan_.element;
  part_count_ = part_count(query);
  rows_.resize(part_count_, kNoRow);
  kept_parts_ = part_count_;
  if (inner_) query_.answer = query_.places;  // a partner is the whole, whatever is marked
  restricted_ = std::ranges::any_of(query_.elements, [](const auto& element) { return !element.wholes.empty(); });
  checked_ = restricted_ || !variables_.none();
}

bool Search::less(const Match& a, const Match& b) {
  stop_check_.tick();
  if (a.recording != b.recording) return a.recording < b.recording;
  if (a.span.begin != b.span.begin) return a.span.begin < b.span.begin;
  if (a.span.end != b.span.end) return a.span.end < b.span.end;
  if (a.row != b.row || kept_parts_ == 0) return a.row < b.row;
  const std::span<const RowId> one = parts_of(a);
  const std::span<const RowId> other = parts_of(b);
  for (const std::size_t part : query_.answer) {
    if (one[part] != other[part]) return one[part] < other[part];
  }
  for (std::size_t part = 0; part < one.size(); ++part) {
    if (one[part] != other[part]) return earlier(one[part], other[part]);
  }
  return false;
}

/// Whether two matches are the same answer.
bool Search::same(const Match& a, const Match& b) {
  stop_check_.tick();
  if (a.row != b.row || kept_parts_ == 0) return a.row == b.row;
  const std::span<const RowId> one = parts_of(a);
  const std::span<const RowId> other = parts_of(b);
  if (exhaustive_) return std::ranges::equal(one, other);
  return std::ranges::all_of(query_.answer, [&](std::size_t part) { return one[part] == other[part]; });
}

void Search::run(const FindLimits& limits, bool parts) {
  limits_ = limits;
  if (limits.limit && *limits.limit > kMostAnswers) limits_.limit.reset();
  kept_parts_ = part_count_ == 1 || (!parts && one_row()) ? 0 : part_count_;
  stop_check_.begin(limits);
  stop_check_.check();
  matches_.clear();
  parts_.clear();
  std::ranges::fill(rows_, kNoRow);  // an interrupted search leaves them filled
  counts_ = {};
  kept_ = 0;
  planned_ = false;
  ordered_ = true;
  bounded_ = false;
  std::uint32_t recording = 0;
  RowId end = 0;  // end of its rows
  for (const RowId row : first_rows()) {
    ++counts_.looked_at;
    if (row >= end) {
      if (full()) break;
      recording = table_.recording(row);
      end = table_.recording_rows(recording).end;
    }
    if (member_.whole || member_.numbers[recording] != Segments::kNone) look_from(row, recording);
  }
  tidy();
}

/// Finds the matches of one recording unless they are already loaded.
void Search::collect(std::uint32_t recording) {
  if (recording_ == recording) return;
  recording_.reset();
  matches_.clear();
  parts_.clear();
  std::ranges::fill(rows_, kNoRow);
  kept_ = 0;
  ordered_ = true;
  const SegmentTable::RowRange own = table_.recording_rows(recording);
  const std::span<const RowId> all = first_rows();
  for (auto row = std::ranges::lower_bound(all, own.begin); row != all.end() && *row < own.end; ++row) {
    look_from(*row, recording);
  }
  tidy();
  latest_.clear();
  for (const Match& match : matches_) {
    latest_.push_back(latest_.empty() ? match.span.end : std::max(latest_.back(), match.span.end));
  }
  recording_ = recording;
}

void Search::look_from(RowId row, std::uint32_t recording) {
  stop_check_.tick();
  Matcher& matcher = query_.elements[start_].matcher;
  if (!plan_.exact && !(plan_.on_tier ? matcher.accepts_on_tier(row) : matcher.accepts(row))) return;
  ++counts_.kept;
  current_ = recording;
  row_at(start_) = row;
  if (query_.elements.size() == 1 && !checked_ && !bounded_) {
    relate(0, 0);
  } else {
    place_after(start_ + 1);
  }
  row_at(start_) = kNoRow;
}

std::span<const RowId> Search::first_rows() {
  if (planned_) return first_;
  const MovingTable moving{movement_, &member_.numbers};
  if (!plan_.relation) {
    if (const auto list = one_list(plan_.access_paths)) {
      first_ = *list;
    } else {
      candidates(plan_.access_paths, table_, moving, stop_check_, candidates_);
      first_ = candidates_;
    }
    planned_ = true;
    return first_;
  }
  std::vector<RowId> found;
  candidates(plan_.access_paths, table_, moving, stop_check_, found);
  BoundQuery::BoundRelation& relation = query_.elements[start_].relations[*plan_.relation];
  candidates_.clear();
  for (const RowId partner : found) {
    if (!relation.matcher->accepts(partner)) continue;
    const TimeSpan span = table_.span(partner);
    for_rows_around(table_, table_.recording(partner), span, [&](RowId other) {
      stop_check_.tick();
      if (other != partner && related(table_.span(other), relation.link, span)) candidates_.push_back(other);
      return true;
    });
  }
  sort_rows(candidates_, table_.size(), stop_check_);
  planned_ = true;
  return first_ = candidates_;
}

/// Whether the chosen parts allow values for the variables and meet the conditions on groups.
bool Search::may_be() const {
  if (!checked_) return true;
  if (!variables_.none() && !variables_.hold(rows_)) return false;
  if (!restricted_) return true;
  for (std::size_t e = 0; e < query_.elements.size(); ++e) {
    for (const BoundQuery::BoundWhole& whole : query_.elements[e].wholes) {
      const RowId first = rows_[query_.elements[e + 1 - whole.places].part];
      const RowId last = rows_[query_.elements[e].part];
      if (first != kNoRow && last != kNoRow && !holds(*whole.condition, {table_.begin(first), table_.end(last)})) {
        return false;
      }
    }
  }
  return true;
}

/// Whether every match that begins with the places up to this one comes after the last match within the limit.
bool Search::too_late(std::size_t place) {
  if (!bounded_ || start_ != 0 || query_.answer != query_.places) return false;
  const TimeSpan worst = matches_[*limits_.limit - 1].span;
  const RowId row = row_at(place);
  const Milliseconds begin = table_.begin(row_at(0));
  if (begin != worst.begin) return begin > worst.begin;
  return table_.end(row) > worst.end && table_.tier_rows_of(row).apart();  // if so, the following rows end even later
}

/// Fills the places from `place` to the last, then those before the first one filled.
void Search::place_after(std::size_t place) {
  if (too_late(place - 1) || !may_be()) return;
  if (place == query_.elements.size()) return place_before(start_);
  const Interval& gap = query_.gaps[place - 1];
  const auto use = [&](RowId row) {
    if (row == kNoRow || !query_.elements[place].matcher.accepts(row)) return;
    row_at(place) = row;
    place_after(place + 1);
    row_at(place) = kNoRow;
  };
  const RowId from = row_at(place - 1);
  if (gap.direct()) return use(next_row(table_, from));
  for (const RowId row : rows_after(table_, from, gap)) use(row);
}

/// Fills the places before `place`.
void Search::place_before(std::size_t place) {
  if (!may_be()) return;
  if (place == 0) return relate(0, 0);
  const Interval& gap = query_.gaps[place - 1];
  const auto use = [&](RowId row) {
    if (!query_.elements[place - 1].matcher.accepts(row)) return;
    row_at(place - 1) = row;
    place_before(place - 1);
    row_at(place - 1) = kNoRow;
  };
  const RowId from = row_at(place);
  for (const RowId row : gap.direct() ? previous_rows(table_, from) : rows_before(table_, from, gap)) use(row);
}

/// Finds partners from this relation of this element onwards: all of them if they are the answer or a variable decides,
/// else the first in time.
void Search::relate(std::size_t e, std::size_t r) {
  if (e == query_.elements.size()) return keep();
  BoundQuery::BoundElement& element = query_.elements[e];
  if (r == element.relations.size()) return relate(e + 1, 0);
  const BoundQuery::BoundRelation& relation = element.relations[r];
  const TimeSpan span = relation.places == 1
                            ? table_.span(row_at(e))
                            : TimeSpan{table_.begin(row_at(e + 1 - relation.places)), table_.end(row_at(e))};
  if (relation.sequence) return relate_to_sequence(e, r, span);
  relate_to_row(e, r, span);
}

bool Search::is_place(std::size_t e, std::size_t places, RowId row) {
  for (std::size_t place = e + 1 - places; place <= e; ++place) {
    if (row_at(place) == row) return true;
  }
  return false;
}

/// Calls `use(row)` for the partners of the places up to an element in a relation, in no order; with `first`, only for
/// some of them, which include the first in time.
template <typename Use>
void Search::for_partners(std::size_t e, BoundQuery::BoundRelation& relation, TimeSpan span, bool first, Use&& use) {
  const RowId row = row_at(e);
  const auto is_partner = [&](RowId other) {
    stop_check_.tick();
    return other != row && related(span, relation.link, table_.span(other)) &&
           (relation.places == 1 || !is_place(e, relation.places, other));
  };
  const auto look = [&](RowId other) {
    if (is_partner(other) && relation.matcher->accepts(other)) use(other);
    return true;
  };
  if (!relation.tiers) return for_rows_around(table_, current_, span, look);
  TierCursor& cursor = relation.cursor;
  for (const std::uint32_t tier : *relation.tiers) {
    const bool known = cursor.tier != nullptr && cursor.tier->recording == current_ && cursor.tier->tier == tier;
    const SegmentTable::TierRows* rows = known ? cursor.tier : table_.tier_rows(current_, tier);
    if (rows == nullptr) continue;
    if (!rows->apart()) {
      for_rows_around(table_, *rows, rows->own(), span, look);
      continue;
    }
    const RowId end = rows->own_end;
    for (RowId other = first_with_end_at_or_after(table_, *rows, span.begin, cursor);
         other < end && table_.begin(other) <= span.end; ++other) {
      if (!is_partner(other) || !relation.matcher->accepts_on_tier(other)) continue;
      use(other);
      if (first) break;  // they are in time order
    }
  }
}

void Search::relate_to_row(std::size_t e, std::size_t r, TimeSpan span) {
  BoundQuery::BoundRelation& relation = query_.elements[e].relations[r];
  RowId& partner = rows_[relation.part];
  if (!relation.marked && !all_rows_) {
    RowId first = kNoRow;
    for_partners(e, relation, span, true, [&](RowId other) {
      if (first == kNoRow || earlier(other, first)) first = other;
    });
    if (first == kNoRow) return;
    partner = first;
    relate(e, r + 1);
  } else {
    std::vector<RowId> all;
    for_partners(e, relation, span, false, [&](RowId other) { all.push_back(other); });
    if (all_rows_) std::ranges::sort(all, [this](RowId a, RowId b) { return earlier(a, b); });
    for (const RowId other : all) {
      partner = other;
      if (!may_be()) continue;
      const std::size_t before = kept_;
      relate(e, r + 1);
      // The first partner that leads to an answer suffices, unless another part is the answer.
      if (!query_.marked && !exhaustive_ && kept_ > before) break;
    }
  }
  partner = kNoRow;
}

void Search::relate_to_sequence(std::size_t e, std::size_t r, TimeSpan span) {
  BoundQuery::BoundRelation& relation = query_.elements[e].relations[r];
  Search& sequence = *relation.sequence;
  const auto own = rows_.begin() + static_cast<std::ptrdiff_t>(relation.part);
  const std::size_t count = sequence.part_count_;
  sequence.for_related(current_, span, relation.link, [&](const Match& match) {
    for (std::size_t place = e + 1 - relation.places; place <= e; ++place) {
      if (sequence.has_place(match, row_at(place))) return true;
    }
    std::ranges::copy(sequence.parts_of(match), own);
    bool more = true;
    if (may_be()) {
      const std::size_t before = kept_;
      relate(e, r + 1);
      const bool any = relation.marked || all_rows_;
      more = any && (query_.marked || exhaustive_ || kept_ == before);
    }
    return more;
  });
  std::fill_n(own, count, kNoRow);
}

bool Search::has_place(const Match& match, RowId row) const noexcept {
  const std::span<const RowId> parts = parts_of(match);
  return std::ranges::any_of(query_.places, [&](std::size_t part) { return parts[part] == row; });
}

bool Search::earlier(RowId a, RowId b) const noexcept {
  const TimeSpan one = table_.span(a);
  const TimeSpan other = table_.span(b);
  return std::tie(one.begin, one.end, a) < std::tie(other.begin, other.end, b);
}

void Search::keep() {
  Match match;
  match.row = rows_[query_.answer.front()];
  match.recording = current_;
  match.span = {table_.begin(match.row), table_.end(rows_[query_.answer.back()])};
  match.parts = static_cast<std::uint32_t>(parts_.size());
  if (kept_parts_ > 0) {
    make_room(parts_, part_count_, (inner_ ? kMostPartsOfPartners : kMostParts) + part_count_);
    parts_.insert(parts_.end(), rows_.begin(), rows_.end());
  }
  ++kept_;
  if (bounded_ && !less(match, matches_[*limits_.limit - 1])) {
    parts_.resize(match.parts);
    return;
  }
  make_room(matches_, 1, (inner_ ? kMostPartners : kMostAnswers) + 1);
  if (ordered_ && !matches_.empty()) ordered_ = less(matches_.back(), match) && !same(matches_.back(), match);
  matches_.push_back(match);
  std::size_t most = inner_ ? kMostPartners : kMostAnswers;
  const std::size_t most_parts = inner_ ? kMostPartsOfPartners : kMostParts;
  if (limits_.limit) most = std::min(*limits_.limit, kMostAnswers) * (bounded_ ? 2 : 1) + (bounded_ ? 4096 : 64);
  if (matches_.size() <= most && parts_.size() <= most_parts) return;
  tidy();
  bounded_ = limits_.limit && matches_.size() >= *limits_.limit;
  if ((limits_.limit || matches_.size() < most) && parts_.size() <= most_parts) return;
  const std::string what =
      inner_ ? fmt::format("query: a sequence in a relation has more than {} matches in one recording; narrow it",
                           kMostPartners)
             : fmt::format("query: more than {} answers, or {} parts of them; narrow it, or give a limit", kMostAnswers,
                           kMostParts);
  throw Error(ErrorCode::bad_input, what);
}

/// Sorts the matches, removes duplicates, and drops those past the limit.
void Search::tidy() {
  stop_check_.check();
  if (!ordered_) sort_matches();
  ordered_ = true;
  if (limits_.limit && matches_.size() > *limits_.limit) matches_.resize(*limits_.limit);
  if (kept_parts_ == 0 || parts_.size() <= 2 * kept_parts_ * matches_.size()) return;
  std::vector<RowId> kept;  // parts that no match refers to would only accumulate
  kept.reserve(kept_parts_ * matches_.size());
  for (Match& match : matches_) {
    stop_check_.tick();
    const std::span<const RowId> parts = parts_of(match);
    match.parts = static_cast<std::uint32_t>(kept.size());
    kept.insert(kept.end(), parts.begin(), parts.end());
  }
  parts_ = std::move(kept);
}

/// Sorts the matches and removes duplicates.
void Search::sort_matches() {
  std::sort(matches_.begin(), matches_.end(), [this](const Match& a, const Match& b) { return less(a, b); });
  const auto same = [this](const Match& a, const Match& b) { return this->same(a, b); };
  matches_.erase(std::unique(matches_.begin(), matches_.end(), same), matches_.end());
}

bool Search::full() {
  if (!limits_.limit || matches_.size() < *limits_.limit) return false;
  tidy();
  return matches_.size() >= *limits_.limit;
}

Segment Search::segment_of(const Match& match) {
  stop_check_.tick();
  Segment result;
  result.recording = table_.recording_at(match.recording);
  result.tier = table_.tier_at(table_.tier(match.row));
  result.span = match.span;
  result.row = match.row + member_.first;
  const std::span<const RowId> parts = parts_of(match);
  for (const RowId row : parts) {
    result.parts.push_back({row + member_.first, name_of(table_, row), table_.span(row)});
  }
  if (!variables_.none()) result.bindings = variables_.values(kept_parts_ == 0 ? std::span(&match.row, 1) : parts);
  if (one_row()) {
    result.name = name_of(table_, match.row);
    return result;
  }
  for (const std::size_t part : query_.answer) {
    if (!result.name.empty()) result.name += ' ';
    result.name += result.parts[part].name;
  }
  return result;
}

}  // namespace signweave
