#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "signweave/query/phase_query.h"
#include "signweave/query/stop_check.h"
#include "signweave/semantic_db/segment_table.h"

namespace signweave {

/// Whether the variables of a query have values: for each variable, one label for which all conditions `= $X` hold and
/// no condition `!= $X` fails. The parser ensures that such conditions are joined by `&` only, so they can be evaluated
/// separately from the others. Borrows its arguments. For one thread.
class VariableCheck {
 public:
  VariableCheck(const PhaseQuery& query, const SegmentTable& table, StopCheck& stop_check);

  bool none() const noexcept { return variables_.empty(); }
  /// Checks the parts that are filled (kNoRow: not yet), in the order of Segment::parts.
  bool hold(std::span<const RowId> parts) const;
  /// The names and values (match form), given that they hold.
  std::vector<std::pair<std::string, std::string>> values(std::span<const RowId> parts) const;

 private:
  struct Use {
    std::size_t part = 0;
    Field field = Field::gloss;
    std::vector<std::uint32_t> tiers;  ///< for Field::tier
    bool equal = true;
  };
  struct Variable {
    std::string name;
    std::vector<Use> uses;
  };

  void collect_uses(const Expression& expression, std::size_t part);
  void labels_of(const Use& use, RowId row, std::vector<std::uint32_t>& labels) const;
  bool value_of(const Variable& variable, std::span<const RowId> parts, std::uint32_t& value) const;

  const SegmentTable* table_;
  StopCheck* stop_check_;
  std::vector<Variable> variables_;
};

}  // namespace signweave
