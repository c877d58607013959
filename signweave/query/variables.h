#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "signweave/query/phase_query.h"
#include "signweave/semantic_db/segment_table.h"

namespace signweave {

/// Whether the variables of a query have values: for each one label that all conditions `= $X` hold for, and no
/// condition `!= $X`. Such conditions stand in a part joined by `&` only, which the parser sees to, so that they can be
/// looked at apart from the others. Borrows both. For one thread.
class VariableCheck {
 public:
  VariableCheck(const PhaseQuery& query, const SegmentTable& table);

  bool none() const noexcept { return variables_.empty(); }
  /// Of the parts that are filled (kNoRow: not yet), as they stand: [place], [place][relation].
  bool hold(const std::vector<RowId>& rows, const std::vector<std::vector<RowId>>& partners) const;
  /// The names and values (match form), where they hold.
  std::vector<std::pair<std::string, std::string>> values(const std::vector<RowId>& rows,
                                                          const std::vector<std::vector<RowId>>& partners) const;

 private:
  struct Use {
    std::size_t place = 0;
    std::optional<std::size_t> relation;  ///< of the partner in that relation
    Field field = Field::gloss;
    std::vector<std::uint32_t> tiers;  ///< of Field::tier
    bool equal = true;
  };
  struct Variable {
    std::string name;
    std::vector<Use> uses;
  };

  void look_at(const Expression& expression, std::size_t place, std::optional<std::size_t> relation);
  void labels_of(const Use& use, RowId row, std::vector<std::uint32_t>& labels) const;
  bool value_of(const Variable& variable, const std::vector<RowId>& rows,
                const std::vector<std::vector<RowId>>& partners, std::uint32_t& value) const;

  const SegmentTable* table_;
  std::vector<Variable> variables_;
};

}  // namespace signweave
