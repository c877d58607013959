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

/// One query over one table of segments: bound and planned once, run as often as wanted. Borrows both. For one thread.
/// A partner that is a sequence has a search of its own, which finds what there is in one recording at a time.
/// More than fifteen members: what is bound and planned once, and where the search is, each step of it uses.
class Search {
 public:
  /// Stops while it binds and plans, too, where `limits` say so.
  Search(const PhaseQuery& query, const Segments::Member& member, const Movement* movement, const FindLimits& limits);
  /// Of a partner of something else, whose watch it looks at. With `all` every combination of its parts counts, else
  /// the first that makes up its places.
  Search(const PhaseQuery& query, const Segments::Member& member, const Movement* movement, StopCheck& watch, bool all);
  Search(const Search&) = delete;
  Search& operator=(const Search&) = delete;

  /// Throws Error{cancelled} where `limits` say so, Error{bad_input} past five million answers without a limit. Without
  /// `parts` those of the matches are kept only where the search needs them itself.
  void run(const FindLimits& limits, bool parts = true);

  /// An answer before it gets its names.
  struct Match {
    std::uint32_t recording = 0;  ///< of the table
    RowId row = kNoRow;
    TimeSpan span{};
    std::uint32_t parts = 0;  ///< where in parts_ its parts begin
  };
  /// What the last run found, in order.
  std::span<const Match> matches() const noexcept { return matches_; }
  Segment segment_of(const Match& match);
  FoundRow row_of(const Match& match) const noexcept { return {match.row + member_.first, match.span}; }
  const Segments::Member& member() const noexcept { return member_; }
  const FindCounts& counts() const noexcept { return counts_; }

  /// Calls `use(match)` for those of a recording that stand in a relation to `span`, by begin, until it returns false.
  template <typename Use>
  void for_related(std::uint32_t recording, TimeSpan span, Link link, Use&& use);
  /// The rows of a match, in the order of Segment::parts; none for a query of one place without relations.
  std::span<const RowId> parts_of(const Match& match) const noexcept {
    return std::span(parts_).subspan(match.parts, kept_parts_);
  }
  bool has_place(const Match& match, RowId row) const noexcept;

 private:
  Search(const PhaseQuery& query, const Segments::Member& member, const Movement* movement, StopCheck* watch,
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
  StopCheck own_watch_;
  StopCheck& watch_;
  VariableCheck variables_;
  bool inner_;       ///< of a partner
  bool all_rows_;    ///< each partner that is a row is tried, not only the first
  bool exhaustive_;  ///< matches that differ in any part count
  BoundQuery query_;
  Plan plan_;
  FindLimits limits_;
  bool restricted_ = false;  ///< a group has conditions
  bool checked_ = false;     ///< so may_be() has something to look at
  bool ordered_ = true;      ///< each match came after the one before it
  bool bounded_ = false;     ///< as many as are asked for are there, in order: only what comes before the last counts
  std::size_t start_ = 0;
  std::size_t part_count_ = 0;
  std::size_t kept_parts_ = 0;  ///< of every match: all or none
  std::uint32_t current_ = 0;   ///< the recording that is looked at
  std::vector<RowId> rows_;     ///< [part]; kNoRow: not chosen yet
  std::vector<RowId> candidates_;
  std::span<const RowId> first_;  ///< the rows that the search begins with, once `planned_`
  bool planned_ = false;
  std::optional<std::uint32_t> recording_;  ///< whose matches are at hand, of a partner
  std::vector<Milliseconds> latest_;        ///< [match] the last end of it and those before it
  std::vector<Match> matches_;
  FindCounts counts_;
  std::size_t kept_ = 0;  ///< answers of this run, also those that were dropped since
  std::vector<RowId> parts_;
};

template <typename Use>
void Search::for_related(std::uint32_t recording, TimeSpan span, Link link, Use&& use) {
  collect(recording);
  // Of those that begin before its end the first whose end, or that of one before it, is not before its begin.
  const auto begin = std::ranges::lower_bound(latest_, span.begin) - latest_.begin();
  for (auto at = matches_.begin() + begin; at != matches_.end() && at->span.begin <= span.end; ++at) {
    watch_.tick();
    if (related(span, link, at->span) && !use(*at)) return;
  }
}

}  // namespace signweave
