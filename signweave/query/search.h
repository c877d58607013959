#pragma once

#include <cstddef>
#include <vector>

#include "signweave/query/find.h"
#include "signweave/query/neighbours.h"
#include "signweave/query/plan.h"
#include "signweave/query/variables.h"

namespace signweave {

/// One query over one table of segments: bound and planned once, run as often as wanted. Borrows both. For one thread.
class Search {
 public:
  Search(const PhaseQuery& query, const Segments::Member& member, const Movement* movement = nullptr);
  Search(const Search&) = delete;
  Search& operator=(const Search&) = delete;

  /// Throws Error{cancelled} where `limits` say so, Error{bad_input} past five million answers without a limit.
  void run(const FindLimits& limits);
  /// What the last run found, in order; rows as in Segments.
  void append(std::vector<Segment>& segments);
  void append(std::vector<FoundRow>& rows) const;
  const FindCounts& counts() const noexcept { return counts_; }

 private:
  /// An answer before it gets its names.
  struct Match {
    std::uint32_t recording = 0;
    RowId row = kNoRow;
    TimeSpan span{};
    std::uint32_t parts = 0;  ///< where in parts_ its parts begin
  };
  bool less(const Match& a, const Match& b) const noexcept;
  std::span<const RowId> parts_of(const Match& match) const noexcept {
    return std::span(parts_).subspan(match.parts, part_count_);
  }

  std::span<const RowId> first_rows();
  template <typename Use>
  void for_partners(RowId row, BoundQuery::BoundRelation& relation, TierCursor& cursor, Use&& use);
  void place_after(std::size_t place);
  void place_before(std::size_t place);
  void relate(std::size_t element, std::size_t relation);
  void keep();
  void answer_with(RowId row, Match& match) const noexcept;
  bool one_row() const noexcept { return marked_ || rows_.size() == 1; }
  void tidy();
  bool full();
  Segment segment_of(const Match& match) const;
  bool earlier(RowId a, RowId b) const noexcept;

  const Segments::Member& member_;
  const SegmentTable& table_;
  FindLimits limits_;
  Watch watch_;
  const Movement* movement_;
  BoundQuery query_;
  Plan plan_;
  VariableCheck variables_;
  bool marked_ = false;
  bool single_ = false;
  std::size_t start_ = 0;
  std::vector<RowId> rows_;                       ///< [place]
  std::vector<std::vector<RowId>> partners_;      ///< [place][relation]
  std::vector<std::vector<TierCursor>> cursors_;  ///< likewise
  std::vector<RowId> candidates_;
  std::vector<Match> matches_;
  FindCounts counts_;
  std::size_t kept_ = 0;        ///< answers of this run, also those that were dropped since
  std::size_t part_count_ = 0;  ///< of every match: the rows of Segment::parts
  std::vector<RowId> parts_;
};

}  // namespace signweave
