#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "signweave/query/matcher.h"
#include "signweave/query/neighbours.h"
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
  bool of_tier = false;                         ///< they are annotations on the tier that is asked for
  std::vector<std::string> through;             ///< for people: "the gloss index (gloss = \"VANNES\")"
};

class Search;

/// A query made ready for one table.
struct BoundQuery {
  struct BoundRelation {
    Link link = Link::overlaps;
    std::size_t places = 1;                                ///< it concerns so many, up to the element that it is of
    std::optional<Matcher> matcher = {};                   ///< of a partner that is a row
    std::shared_ptr<Search> sequence = {};                 ///< of one that is not
    bool marked = false;                                   ///< the partner, or something in it
    std::size_t part = 0;                                  ///< the first of the partner's parts
    std::optional<std::vector<std::uint32_t>> tiers = {};  ///< Matcher::only_tiers
    TierCursor cursor = {};
  };
  /// What is said of a group.
  struct BoundWhole {
    std::size_t places = 1;
    const Condition* condition = nullptr;
  };
  struct BoundElement {
    Matcher matcher;
    std::size_t part = 0;
    std::vector<BoundRelation> relations = {};  ///< its own, then those of the groups that end there
    std::vector<BoundWhole> wholes = {};
  };
  std::vector<BoundElement> elements;
  std::vector<Interval> gaps;
  std::vector<std::size_t> places;  ///< [place] its part
  std::vector<std::size_t> answer;  ///< the parts that the answer reaches over
  bool marked = false;              ///< something is
};

/// Borrows all, which must outlive the result. With `all`, every combination of the parts of partners counts.
BoundQuery bind(const PhaseQuery& query, const Segments::Member& member, const Movement* movement, StopCheck& watch,
                bool all);

/// Where a search begins: with the element, or the partner in a relation, that has the fewest rows to look at. From
/// there it goes along the sequence in both directions.
struct Plan {
  std::size_t element = 0;
  std::optional<std::size_t> relation;  ///< begin with this partner of the element, then look for the element around it
  std::vector<Access> accesses;         ///< together they hold all candidates
  std::size_t rows = 0;                 ///< about how many
  bool exact = false;                   ///< each of the candidates fulfils the element's expression
  bool on_tier = false;                 ///< each of them is one for Matcher::accepts_on_tier
};

Plan plan(BoundQuery& query);

/// Puts the rows of the accesses into `result`, ascending, each once.
void candidates(std::span<const Access> accesses, const SegmentTable& table, const MovingTable& moving,
                StopCheck& watch, std::vector<RowId>& result);
/// Makes rows of a table of so many ascending, each once. Looks at the watch.
void sort_rows(std::vector<RowId>& rows, RowId table_size, StopCheck& watch);
/// The same where it is one list of an index: that.
std::optional<std::span<const RowId>> one_list(std::span<const Access> accesses) noexcept;

}  // namespace signweave
