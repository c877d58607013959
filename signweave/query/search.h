#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <vector>

#include "signweave/query/find.h"
#include "signweave/query/neighbours.h"
#include "signweave/query/plan.h"
#include "signweave/query/variables.h"

namespace signweave {

/// One query over one table of segments: bound and planned once, run any number of times. Borrows both. For one thread.
/// A partner that is a sequence has a search of its own, which finds the matches of one recording at a time. It has
/// more than fifteen members because each step uses both the bound plan and the search state.
class Search {
 public:
  /// Binding and planning also stop if `limits` require it.
  Search(const PhaseQuery& query, const Segments::Member& member, const Movement* movement, const FindLimits& limits);
  /// For a partner in another search, whose stop check it uses. With `all`, every combination of its parts counts, else
  /// only the first one for given places.
  Search(const PhaseQuery& query, const Segments::Member& member, const Movement* movement, StopCheck& stop_check,
         bool all);
  Search(const Search&) = delete;
  Search& operator=(const Search&) = delete;

  /// Throws Error{cancelled} if `limits` require it, Error{bad_input} for more than five million answers without a
  /// limit. Without `parts`, the parts of the matches are stored only if the search itself needs them.
  void run(const FindLimits& limits, bool parts = true);

  /// An answer before its names are resolved.
  struct Match {
    std::uint32_t recording = 0;  ///< of the table
    RowId row = kNoRow;
    TimeSpan span{};
    std::uint32_t parts = 0;  ///< offset of its parts in parts_
  };
  /// The results of the last run, in order.
  std::span<const Match> matches() const noexcept { return matches_; }
  Segment segment_of(const Match& match);
  FoundRow row_of(const Match& match) const noexcept { return {match.row + member_.first, match.span}; }
  const Segments::Member& member() const noexcept { return member_; }
  const FindCounts& counts() const noexcept { return counts_; }

  /// Calls `use(match)` for the matches of a recording that are in a relation to `span`, by begin, until it returns
  /// false.
  template <typename Use>
  void for_related(std::uint32_t recording, TimeSpan span, Link link, Use&& use);
  /// The rows of a match, in the order of Segment::parts; empty for a query of one place without relations.
  std::span<const RowId> parts_of(const Match& match) const noexcept {
    return std::span(parts_).subspan(match.parts, kept_parts_);
  }
  bool has_place(const Match& match, RowId row) const noexcept;

 private:
  Search(const PhaseQuery& query, const Segments::Member& member, const Movement* movement, StopCheck* stop_check,
         const FindLimits& limits, bool all);
  bool less(const Match& a, const Match& b);
  bool same(const Match& a, const Match& b);
  RowId& row_at(std::size_t place) noexcept { return rows_[query_.elements[place].part]; }

  std::span<const RowId> first_rows();
  void look_from(RowId row, std::uint32_t recording);
  void collect(std::uint32_t recording);
  bool may_be() const;
  bool too_late(std::size_t place);
  void place_after(std::size_t place);
  void place_before(std::size_t place);
  void relate(std::size_t element, std::size_t relation);
  void relate_to_row(std::size_t element, std::size_t relation, TimeSpan span);
  void relate_to_sequence(std::size_t element, std::size_t relation, TimeSpan span);
  template <typename Use>
  void for_partners(std::size_t element, BoundQuery::BoundRelation& relation, TimeSpan span, bool first, Use&& use);
  bool is_place(std::size_t element, std::size_t places, RowId row);
  void keep();
  bool one_row() const noexcept { return query_.answer.size() == 1; }
  void tidy();
  void sort_matches();
  bool full();
  bool earlier(RowId a, RowId b) const noexcept;

  const Segments::Member& member_;
  const SegmentTable& table_;
  const Movement* movement_;
  StopCheck own_stop_check_;
  StopCheck& stop_check_;
  VariableCheck variables_;
  bool inner_;       ///< this search is for a partner
  bool all_rows_;    ///< every partner that is a row is tried, not only the first
  bool exhaustive_;  ///< matches that differ in any part are distinct
  BoundQuery query_;
  Plan plan_;
  FindLimits limits_;
  bool restricted_ = false;  ///< a group has conditions
  bool checked_ = false;     ///< may_be() has something to check
  bool ordered_ = true;      ///< matches were found in order
  bool bounded_ = false;     ///< the limit is reached and matches are in order: only a match before the last one counts
  std::size_t start_ = 0;
  std::size_t part_count_ = 0;
  std::size_t kept_parts_ = 0;  ///< per match: all or none
  std::uint32_t current_ = 0;   ///< the recording being searched
  std::vector<RowId> rows_;     ///< [part]; kNoRow: not chosen yet
  std::vector<RowId> candidates_;
  std::span<const RowId> first_;  ///< the rows the search begins with; valid if `planned_`
  bool planned_ = false;
  std::optional<std::uint32_t> recording_;  ///< for a partner: the one whose matches are loaded
  std::vector<Milliseconds> latest_;        ///< [match] the maximum end of it and those before it
  std::vector<Match> matches_;
  FindCounts counts_;
  std::size_t kept_ = 0;  ///< answers of this run, including those dropped later
  std::vector<RowId> parts_;
};

template <typename Use>
void Search::for_related(std::uint32_t recording, TimeSpan span, Link link, Use&& use) {
  collect(recording);
  // Among those that begin before its end, the first one that has, itself or in a predecessor, an end not before its
  // begin.
  const auto begin = std::ranges::lower_bound(latest_, span.begin) - latest_.begin();
  for (auto at = matches_.begin() + begin; at != matches_.end() && at->span.begin <= span.end; ++at) {
    stop_check_.tick();
    if (related(span, link, at->span) && !use(*at)) return;
  }
}

}  // namespace signweave
