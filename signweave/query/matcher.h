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

/// A condition bound to one table: names are resolved to the table's numbers.
struct BoundCondition {
  const Condition* source = nullptr;
  Field field = Field::gloss;
  Compare compare = Compare::equal;
  Scopes scope = Scopes::plain();
  std::uint32_t label = SegmentTable::kNone;  ///< for = and != on gloss and tier; kNone if the table lacks it
  std::unique_ptr<RE2> regex;                 ///< for =~ on gloss and tier
  std::vector<std::uint8_t> known;            ///< [label] for the regex: 0 not tried yet, 1 no, 2 yes
  std::vector<std::uint32_t> tiers;           ///< for tier: the tiers of that name
  std::vector<bool> recordings;               ///< [recording] for recording: whether it matches
  std::string text;                           ///< for signer: the match form
  bool variable = false;                      ///< = $X or != $X
  unsigned set = 0;                           ///< for phase and hand: bit n for enumerator n
  Milliseconds time{0};
  std::unique_ptr<MovementCheck> movement;  ///< for movement and hands
};

class Matcher;
class Search;

/// Whether a span meets a condition on duration, begin or end.
bool holds(const Condition& condition, TimeSpan span) noexcept;

/// An expression bound to one table.
struct BoundExpression {
  Expression::Kind kind = Expression::Kind::condition;
  BoundCondition condition;
  Scopes top = Scopes::none();  ///< for a negation
  Link link = Link::parent;
  std::unique_ptr<Matcher> linked;   ///< for a link
  std::shared_ptr<Search> sequence;  ///< for a link to a sequence
  /// Operands of `&` that read from the motion come last: for most rows they need not be evaluated.
  std::vector<BoundExpression> operands;
};
/// Whether a condition on movement in it is read from the motion, which is slower than any other condition.
bool reads_motion(const BoundExpression& expression) noexcept;

/// Decides for each row of a table whether an expression holds for it. Regular expressions are tried once per distinct
/// label. Borrows its arguments, which must outlive it. For one thread.
class Matcher {
 public:
  /// What a row must be if the expression is only about times and recordings.
  enum class Plain { sign, any };

  Matcher(const Expression& expression, const Segments::Member& member, const Movement* movement, StopCheck& stop_check,
          Plain plain = Plain::sign);

  /// Whether the expression holds for the row and the row is of the kind that the expression ranges over.
  bool accepts(RowId row);

  Scopes scopes() const noexcept { return scopes_; }
  BoundExpression& root() noexcept { return root_; }
  const SegmentTable& table() const noexcept { return *table_; }
  /// For each tier that the expression names, in order: the tiers of the table with that name.
  const std::vector<std::vector<std::uint32_t>>& tiers() const noexcept { return tiers_; }
  /// The tiers that contain, as annotations, all rows it may accept; nullopt if it may accept other rows too.
  std::optional<std::vector<std::uint32_t>> only_tiers() const;
  /// The same as `accepts` for a row that is an annotation on one of `only_tiers()`.
  bool accepts_on_tier(RowId row) {
    if (root_.kind != Expression::Kind::condition || root_.condition.field != Field::tier) return accepts(row);
    return fits(root_.condition, table_->label(row));
  }
  /// Whether a label meets a gloss or tier condition.
  bool fits(BoundCondition& condition, std::uint32_t label) {
    if (condition.variable) return true;  // VariableCheck evaluates all of them together
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
  StopCheck* stop_check_;
  Plain plain_;
  std::vector<std::string> tier_names_;
  std::vector<std::vector<std::uint32_t>> tiers_;
  Scopes scopes_;
  BoundExpression root_;
  bool reads_motion_ = false;  ///< if so, the kind of a row is checked first
};

}  // namespace signweave
