#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "signweave/query/matcher.h"
#include "signweave/query/phase_query.h"
#include "signweave/semantic_db/segments.h"

namespace signweave {

/// Rows in which all answers to a condition lie, found through an index, and perhaps others too.
struct Access {
  std::vector<std::span<const RowId>> lists;    ///< rows
  std::vector<std::span<const RowId>> parents;  ///< rows, of which the children are meant
  std::vector<SegmentTable::RowRange> ranges;   ///< rows
  std::vector<MovementCheck*> scans;            ///< rows whose numbers fulfil these conditions on movement
  std::size_t rows = 0;                         ///< about how many
  std::vector<std::string> through;             ///< for people: "the gloss index (gloss = \"VANNES\")"
};

/// A query made ready for one table.
struct BoundQuery {
  struct BoundRelation {
    Link link = Link::overlaps;
    Matcher matcher;
    bool marked = false;
    std::optional<std::vector<std::uint32_t>> tiers;  ///< Matcher::only_tiers
  };
  struct BoundElement {
    Matcher matcher;
    bool marked = false;
    std::vector<BoundRelation> relations;
  };
  std::vector<BoundElement> elements;
  std::vector<Interval> gaps;
};

/// Borrows all, which must outlive the result.
BoundQuery bind(const PhaseQuery& query, const SegmentTable& table, Watch& watch, const MovingTable& moving = {});

/// Where a search begins: with the element, or the partner in a relation, that has the fewest rows to look at. From
/// there it goes along the sequence in both directions.
struct Plan {
  std::size_t element = 0;
  std::optional<std::size_t> relation;  ///< begin with this partner of the element, then look for the element around it
  std::vector<Access> accesses;         ///< together they hold all candidates
  std::size_t rows = 0;                 ///< about how many
  bool exact = false;                   ///< each of the candidates fulfils the element's expression
};

Plan plan(BoundQuery& query);

/// Puts the rows of the accesses into `rows`, ascending, each once.
void candidates(std::span<const Access> accesses, const SegmentTable& table, const MovingTable& moving,
                std::vector<RowId>& rows);
/// The same where it is one list of an index: that.
std::optional<std::span<const RowId>> one_list(std::span<const Access> accesses) noexcept;

/// The plan for a query in words, one step a line: for `query --explain`.
std::string explain(const PhaseQuery& query, const Segments& segments);

}  // namespace signweave
