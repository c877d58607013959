#pragma once

#include <re2/re2.h>

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "signweave/query/movement_check.h"
#include "signweave/query/phase_query.h"
#include "signweave/query/scopes.h"
#include "signweave/query/stop_check.h"
#include "signweave/semantic_db/segments.h"

namespace signweave {

/// A condition made ready for one table: names turned into the table's numbers.
struct BoundCondition {
  const Condition* source = nullptr;
  Field field = Field::gloss;
  Compare compare = Compare::equal;
  Scopes scope = Scopes::plain();
  std::uint32_t label = SegmentTable::kNone;  ///< of = and != on gloss and tier; kNone where the table lacks it
  std::unique_ptr<RE2> regex;                 ///< of =~ on gloss and tier
  std::vector<std::uint8_t> known;            ///< [label] of the regex: 0 not tried yet, 1 no, 2 yes
  std::vector<std::uint32_t> tiers;           ///< of tier: those of that name
  std::vector<bool> recordings;               ///< [recording] of recording: whether it fits
  std::string text;                           ///< of signer: its match form
  bool variable = false;                      ///< = $X or != $X
  unsigned set = 0;                           ///< of phase and hand: bit n for the enumerator n
  Milliseconds time{0};
  std::unique_ptr<MovementCheck> movement;  ///< of movement
};

class Matcher;
class Search;

/// Whether a span fulfils a condition on duration, begin or end.
bool holds(const Condition& condition, TimeSpan span) noexcept;

/// An expression made ready for one table.
struct BoundExpression {
  Expression::Kind kind = Expression::Kind::condition;
  BoundCondition condition;
  Scopes top = Scopes::none();  ///< of a negation
  Link link = Link::parent;
  std::unique_ptr<Matcher> linked;   ///< of a link
  std::shared_ptr<Search> sequence;  ///< of a link to one
  /// What is joined by `&` stands with what is read from the motion last: of most rows it need not be.
  std::vector<BoundExpression> operands;
};
/// Whether a condition on movement in it is read from the motion, which takes longer than all else.
bool reads_motion(const BoundExpression& expression) noexcept;

/// Tells for each row of a table whether an expression holds for it. Regular expressions are tried once per distinct
/// label. Borrows all that it is made of, which must outlive it. For one thread.
class Matcher {
 public:
  /// What a row must be where the expression speaks of times and recordings only.
  enum class Plain { sign, any };

  Matcher(const Expression& expression, const Segments::Member& member, const Movement* movement, StopCheck& watch,
          Plain plain = Plain::sign);

  /// Whether the expression holds for the row, and the row is of the sort that the expression ranges over.
  bool accepts(RowId row);

  Scopes scopes() const noexcept { return scopes_; }
  BoundExpression& root() noexcept { return root_; }
  const SegmentTable& table() const noexcept { return *table_; }
  /// For each tier that the expression names, in order, the tiers of the table with that name.
  const std::vector<std::vector<std::uint32_t>>& tiers() const noexcept { return tiers_; }
  /// The tiers on which all rows that it may accept lie as annotations; none where others may be accepted too.
  std::optional<std::vector<std::uint32_t>> only_tiers() const;
  /// The same as `accepts` for a row that lies as an annotation on one of `only_tiers()`.
  bool accepts_on_tier(RowId row) {
    if (root_.kind != Expression::Kind::condition || root_.condition.field != Field::tier) return accepts(row);
    return fits(root_.condition, table_->label(row));
  }
  /// Whether a label fits a gloss or tier condition.
  bool fits(BoundCondition& condition, std::uint32_t label) {
    if (condition.variable) return true;  // VariableCheck looks at all of them together
    if (!condition.regex) return (condition.label == label) == (condition.compare == Compare::equal);
    const std::uint8_t known = condition.known[label];
    return known == 0 ? try_label(condition, label) : known == kFits;
  }

 private:
  static constexpr std::uint8_t kFits = 2;

  bool try_label(BoundCondition& condition, std::uint32_t label);
  BoundExpression bind(const Expression& expression);
  BoundCondition bind(const Condition& condition);
  Scopes holds(BoundExpression& expression, RowId row);
  bool holds(BoundCondition& condition, RowId row);
  bool holds_on_tier(BoundCondition& condition, RowId row);
  bool holds_moving(MovementCheck& check, RowId row);
  bool holds_for_linked(Link link, Matcher& linked, RowId row);
  bool holds_for_sequence(Link link, Search& sequence, RowId row);
  Scopes scopes_of_row(RowId row) const noexcept;

  const Segments::Member* member_;
  const SegmentTable* table_;
  const Movement* movement_;
  StopCheck* watch_;
  Plain plain_;
  std::vector<std::string> tier_names_;
  std::vector<std::vector<std::uint32_t>> tiers_;
  Scopes scopes_;
  BoundExpression root_;
  bool reads_motion_ = false;  ///< so what a row is, is looked at before
};

}  // namespace signweave
