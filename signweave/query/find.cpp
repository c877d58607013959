#include "signweave/query/find.h"

#include <fmt/format.h>

#include <algorithm>
#include <tuple>

#include "signweave/query/neighbours.h"
#include "signweave/query/plan.h"

namespace signweave {
namespace {

constexpr std::size_t kMostAnswers = 5'000'000;

/// An answer before it gets its names.
struct Match {
  std::uint32_t recording = 0;
  RowId row = kNoRow;
  TimeSpan span{};
  std::vector<RowId> parts;  ///< as Segment::parts
};

auto order_of(const Match& match) noexcept {
  return std::tie(match.recording, match.span.begin, match.span.end, match.row, match.parts);
}

std::string name_of(const SegmentTable& table, RowId id) {
  const SegmentRow row = table.row(id);
  const std::string_view label = table.text_at(row.label);
  if (row.kind != RowKind::phase) return std::string(label);
  const std::string_view gloss = table.text_at(table.label(row.parent));
  return fmt::format("{} {}", gloss, row.phase == PhaseKind::other ? label : word_of(row.phase));
}

class Search {
 public:
  Search(const PhaseQuery& query, const Segments::Member& member, const FindLimits& limits)
      : member_(member), table_(member.table), limits_(limits), watch_(limits), query_(bind(query, table_, watch_)) {
    rows_.resize(query_.elements.size());
    for (const BoundQuery::BoundElement& element : query_.elements) {
      partners_.emplace_back(element.relations.size());
      marked_ = marked_ || element.marked;
      for (const BoundQuery::BoundRelation& relation : element.relations) marked_ = marked_ || relation.marked;
    }
    single_ = query_.elements.size() == 1 && query_.elements.front().relations.empty();
  }

  /// Appends what is in this table.
  void run(std::vector<Segment>& result) {
    watch_.check();
    const Plan chosen = plan(query_);
    start_ = chosen.element;
    std::uint32_t recording = 0;
    for (const RowId row : first_rows(chosen)) {
      if (const std::uint32_t next = table_.recording(row); next != recording) {
        if (full()) break;
        recording = next;
      }
      if (!member_.whole && member_.numbers[recording] == Segments::kNone) continue;
      if (!query_.elements[start_].matcher.accepts(row)) continue;
      rows_[start_] = row;
      place_after(start_ + 1);
    }
    tidy();
    result.reserve(result.size() + matches_.size());
    for (const Match& match : matches_) {
      watch_.tick();
      result.push_back(segment_of(match));
    }
  }

 private:
  std::vector<RowId> first_rows(const Plan& chosen) {
    const std::vector<RowId> found = candidates(chosen.accesses, table_);
    if (!chosen.relation) return found;
    BoundQuery::BoundRelation& relation = query_.elements[start_].relations[*chosen.relation];
    std::vector<RowId> result;
    for (const RowId partner : found) {
      if (!relation.matcher.accepts(partner)) continue;
      const SegmentRow& row = table_.row(partner);
      for_rows_around(table_, row.recording, row.span, [&](RowId other) {
        watch_.tick();
        if (other != partner && related(table_.span(other), relation.link, row.span)) result.push_back(other);
        return true;
      });
    }
    std::sort(result.begin(), result.end());
    result.erase(std::unique(result.begin(), result.end()), result.end());
    return result;
  }

  /// Fills the places from `place` to the last, then those before the first one filled.
  void place_after(std::size_t place) {
    if (place == rows_.size()) return place_before(start_);
    const Interval& gap = query_.gaps[place - 1];
    const auto use = [&](RowId row) {
      if (row == kNoRow || !query_.elements[place].matcher.accepts(row)) return;
      rows_[place] = row;
      place_after(place + 1);
    };
    if (gap.direct()) return use(next_row(table_, rows_[place - 1]));
    for (const RowId row : rows_after(table_, rows_[place - 1], gap)) use(row);
  }

  /// Fills the places before `place`.
  void place_before(std::size_t place) {
    if (place == 0) return relate(0, 0);
    const Interval& gap = query_.gaps[place - 1];
    const auto use = [&](RowId row) {
      if (!query_.elements[place - 1].matcher.accepts(row)) return;
      rows_[place - 1] = row;
      place_before(place - 1);
    };
    const RowId from = rows_[place];
    for (const RowId row : gap.direct() ? previous_rows(table_, from) : rows_before(table_, from, gap)) use(row);
  }

  /// Finds partners from this relation of this element on.
  void relate(std::size_t e, std::size_t r) {
    if (e == rows_.size()) return keep();
    BoundQuery::BoundElement& element = query_.elements[e];
    if (r == element.relations.size()) return relate(e + 1, 0);
    for (const RowId partner : partners_of(rows_[e], element.relations[r])) {
      partners_[e][r] = partner;
      relate(e, r + 1);
    }
  }

  /// All partners where they are the answer, else the first in time.
  std::vector<RowId> partners_of(RowId row, BoundQuery::BoundRelation& relation) {
    const SegmentRow& from = table_.row(row);
    std::vector<RowId> result;
    for_rows_around(table_, from.recording, from.span, [&](RowId other) {
      watch_.tick();
      if (other == row || !related(from.span, relation.link, table_.span(other))) return true;
      if (!relation.marked && !result.empty() && !earlier(other, result.front())) return true;
      if (!relation.matcher.accepts(other)) return true;
      if (!relation.marked) result.clear();
      result.push_back(other);
      return true;
    });
    return result;
  }

  bool earlier(RowId a, RowId b) const noexcept {
    const TimeSpan one = table_.span(a);
    const TimeSpan other = table_.span(b);
    return std::tie(one.begin, one.end, a) < std::tie(other.begin, other.end, b);
  }

  void keep() {
    Match match;
    match.recording = table_.recording(rows_.front());
    match.row = rows_.front();
    match.span = {table_.begin(rows_.front()), table_.end(rows_.back())};
    for (std::size_t e = 0; e < rows_.size() && !single_; ++e) {
      match.parts.push_back(rows_[e]);
      if (query_.elements[e].marked) answer_with(rows_[e], match);
      for (std::size_t r = 0; r < partners_[e].size(); ++r) {
        match.parts.push_back(partners_[e][r]);
        if (query_.elements[e].relations[r].marked) answer_with(partners_[e][r], match);
      }
    }
    matches_.push_back(std::move(match));
    const std::size_t most = limits_.limit ? 2 * std::min(*limits_.limit, kMostAnswers) + 4096 : kMostAnswers;
    if (matches_.size() <= most) return;
    tidy();
    if (!limits_.limit && matches_.size() >= kMostAnswers) {
      throw Error(ErrorCode::bad_input,
                  fmt::format("query: more than {} answers; narrow it, or give a limit", kMostAnswers));
    }
  }

  void answer_with(RowId row, Match& match) const noexcept {
    match.row = row;
    match.span = table_.span(row);
  }

  /// The answer is one row, not a sequence.
  bool one_row() const noexcept { return marked_ || rows_.size() == 1; }

  /// Sorts what was found, drops what is there twice, and what is past the limit.
  void tidy() {
    watch_.check();
    const auto less = [](const Match& a, const Match& b) { return order_of(a) < order_of(b); };
    if (!std::is_sorted(matches_.begin(), matches_.end(), less)) std::sort(matches_.begin(), matches_.end(), less);
    const bool by_row = one_row();
    const auto same = [&](const Match& a, const Match& b) { return a.row == b.row && (by_row || a.parts == b.parts); };
    matches_.erase(std::unique(matches_.begin(), matches_.end(), same), matches_.end());
    if (limits_.limit && matches_.size() > *limits_.limit) matches_.resize(*limits_.limit);
  }

  bool full() {
    if (!limits_.limit || matches_.size() < *limits_.limit) return false;
    tidy();
    return matches_.size() >= *limits_.limit;
  }

  Segment segment_of(const Match& match) const {
    Segment result;
    result.recording = table_.recording_at(match.recording);
    result.span = match.span;
    result.row = match.row + member_.first;
    for (const RowId row : match.parts) {
      result.parts.push_back({row + member_.first, name_of(table_, row), table_.span(row)});
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

  const Segments::Member& member_;
  const SegmentTable& table_;
  const FindLimits& limits_;
  Watch watch_;
  BoundQuery query_;
  bool marked_ = false;
  bool single_ = false;
  std::size_t start_ = 0;
  std::vector<RowId> rows_;                   ///< [place]
  std::vector<std::vector<RowId>> partners_;  ///< [place][relation]
  std::vector<Match> matches_;
};

}  // namespace

std::vector<Segment> find(const PhaseQuery& query, const Segments& segments, const FindLimits& limits) {
  std::vector<Segment> result;
  for (const Segments::Member& member : segments.members()) Search(query, member, limits).run(result);
  if (segments.members().size() > 1) {  // each in order, each of other recordings
    std::ranges::stable_sort(result, {}, &Segment::recording);
    if (limits.limit && result.size() > *limits.limit) result.resize(*limits.limit);
  }
  return result;
}

}  // namespace signweave
