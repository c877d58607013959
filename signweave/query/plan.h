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

/// Access path: a superset of the rows that meet a condition, found through an index.
struct AccessPath {
  std::vector<std::span<const RowId>> lists;    ///< rows
  std::vector<std::span<const RowId>> parents;  ///< rows whose children are meant
  std::vector<SegmentTable::RowRange> ranges;   ///< rows
  std::vector<MovementCheck*> scans;            ///< rows whose values meet these conditions on movement
  std::size_t rows = 0;                         ///< estimated number of rows
  bool of_tier = false;                         ///< they are annotations on the requested tier
  std::vector<std::string> through;             ///< for display: "the gloss index (gloss = \"VANNES\")"
};

class Search;

/// A query bound to one table.
struct BoundQuery {
  struct BoundRelation {
    Link link = Link::overlaps;
    std::size_t places = 1;                                ///< number of places it covers, ending at its element
    std::optional<Matcher> matcher = {};                   ///< for a partner that is a row
    std::shared_ptr<Search> sequence = {};                 ///< for a partner that is a sequence
    bool marked = false;                                   ///< the partner, or something in it
    std::size_t part = 0;                                  ///< the first of the partner's parts
    std::optional<std::vector<std::uint32_t>> tiers = {};  ///< Matcher::only_tiers
    TierCursor cursor = {};
  };
  /// A condition on a group.
  struct BoundWhole {
    std::size_t places = 1;
    const Condition* condition = nullptr;
  };
  struct BoundElement {
    Matcher matcher;
    std::size_t part = 0;
    std::vector<BoundRelation> relations = {};  ///< its own, then those of the groups that end here
    std::vector<BoundWhole> wholes = {};
  };
  std::vector<BoundElement> elements;
  std::vector<Interval> gaps;
  std::vector<std::size_t> places;  ///< [place] index of its part
  std::vector<std::size_t> answer;  ///< the parts that the answer spans
  bool marked = false;              ///< something is marked
};

/// Borrows its arguments, which must outlive the result. With `all`, every combination of the parts of partners counts.
BoundQuery bind(const PhaseQuery& query, const Segments::Member& member, const Movement* movement,
                StopCheck& stop_check, bool all);

/// Where a search begins: with the element, or the partner in a relation, that has the fewest rows to examine. From
/// there it continues along the sequence in both directions.
struct Plan {
  std::size_t element = 0;
  std::optional<std::size_t> relation;   ///< begin with this partner of the element, then find the element around it
  std::vector<AccessPath> access_paths;  ///< together they hold all candidates
  std::size_t rows = 0;                  ///< estimated number of rows
  bool exact = false;                    ///< each candidate meets the element's expression
  bool on_tier = false;                  ///< Matcher::accepts_on_tier applies to each candidate
};

Plan plan(BoundQuery& query);

/// Puts the rows of the access paths into `result`, ascending, each once.
void candidates(std::span<const AccessPath> access_paths, const SegmentTable& table, const MovingTable& moving,
                StopCheck& stop_check, std::vector<RowId>& result);
/// Sorts rows of a table with `table_size` rows and removes duplicates. Polls `stop_check`.
void sort_rows(std::vector<RowId>& rows, RowId table_size, StopCheck& stop_check);
/// The same rows without a copy if they are exactly one list of an index; else nullopt.
std::optional<std::span<const RowId>> one_list(std::span<const AccessPath> access_paths) noexcept;

}  // namespace signweave
