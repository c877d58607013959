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

/// Whether the variables of a query have values: for each one label that all conditions `= $X` hold for, and no
/// condition `!= $X`. Such conditions stand in a part joined by `&` only, which the parser sees to, so that they can be
/// looked at apart from the others. Borrows all. For one thread.
class VariableCheck {
 public:
  VariableCheck(const PhaseQuery& query, const SegmentTable& table, StopCheck& watch);

  bool none() const noexcept { return variables_.empty(); }
  /// Of the parts that are filled (kNoRow: not yet), as Segment::parts lists them.
  bool hold(std::span<const RowId> parts) const;
  /// The names and values (match form), where they hold.
  std::vector<std::pair<std::string, std::string>> values(std::span<const RowId> parts) const;

 private:
  struct Use {
    std::size_t part = 0;
    Field field = Field::gloss;
    std::vector<std::uint32_t> tiers;  ///< of Field::tier
    bool equal = true;
  };
  struct Variable {
    std::string name;
    std::vector<Use> uses;
  };

  void look_at(const Expression& expression, std::size_t part);
  void labels_of(const Use& use, RowId row, std::vector<std::uint32_t>& labels) const;
  bool value_of(const Variable& variable, std::span<const RowId> parts, std::uint32_t& value) const;

  const SegmentTable* table_;
  StopCheck* watch_;
  std::vector<Variable> variables_;
};

}  // namespace signweave
