#pragma once

#include <bit>
#include <cstdint>
#include <string>
#include <vector>

#include "signweave/query/phase_query.h"

namespace signweave {

/// Which rows an expression ranges over (docs/query.md, "Which segments a condition is about"): a set, because the
/// alternatives of an expression may differ in it. From general to specific: plain, linked, tiers, signs, phases,
/// units.
///
/// Each condition has one scope. A conjunction has the most specific scope of its conditions; `|` keeps both. A row can
/// therefore be tested without multiplying the expression out: `a | b` is the union of the two sides, and `a & b` takes
/// the more specific scope of each pair.
class Scopes {
 public:
  static constexpr unsigned kMostTiers = 56;

  static constexpr Scopes none() noexcept { return Scopes(0); }
  static constexpr Scopes plain() noexcept { return Scopes(1); }   ///< times and recordings only: signs
  static constexpr Scopes linked() noexcept { return Scopes(2); }  ///< parent(…), child(…) only: every row
  /// The annotations of the tier at index `place` among those the query names (from 0). Earlier tiers win over later
  /// ones.
  static constexpr Scopes tier(unsigned place) noexcept { return Scopes(std::uint64_t{4} << (kMostTiers - 1 - place)); }
  static constexpr Scopes signs() noexcept { return Scopes(std::uint64_t{4} << kMostTiers); }
  static constexpr Scopes phases() noexcept { return Scopes(std::uint64_t{8} << kMostTiers); }

  static constexpr Scopes units() noexcept { return Scopes(std::uint64_t{16} << kMostTiers); }

  constexpr bool empty() const noexcept { return bits_ == 0; }
  constexpr bool has(Scopes one) const noexcept { return (bits_ & one.bits_) != 0; }
  /// Either: alternatives.
  friend constexpr Scopes operator|(Scopes a, Scopes b) noexcept { return Scopes(a.bits_ | b.bits_); }
  /// Both at once: the more specific scope of each pair.
  friend constexpr Scopes operator&(Scopes a, Scopes b) noexcept {
    return Scopes((a.bits_ & at_least(b.bits_)) | (b.bits_ & at_least(a.bits_)));
  }
  /// The most specific scope.
  constexpr Scopes top() const noexcept { return Scopes(std::bit_floor(bits_)); }
  friend constexpr bool operator==(Scopes, Scopes) = default;

 private:
  explicit constexpr Scopes(std::uint64_t bits) noexcept : bits_(bits) {}
  /// All bits from the lowest set bit of `bits` upwards; 0 for 0.
  static constexpr std::uint64_t at_least(std::uint64_t bits) noexcept {
    return bits == 0 ? 0 : ~((bits & (~bits + 1)) - 1);
  }
  std::uint64_t bits_ = 0;
};

/// The tiers named by the conditions of an expression, in order, each once; not those inside links. A parsed query has
/// at most Scopes::kMostTiers of them.
std::vector<std::string> tiers_named(const Expression& expression);

/// The scope of one condition; `tiers` is the result of `tiers_named` for the whole expression.
Scopes scope_of(const Condition& condition, const std::vector<std::string>& tiers);

/// All scopes that answers of an expression may have.
Scopes scopes_of(const Expression& expression, const std::vector<std::string>& tiers);

/// The scope of an expression taken as one condition: its most specific part. The operand of `!` is treated so.
Scopes top_scope(const Expression& expression, const std::vector<std::string>& tiers);

}  // namespace signweave
