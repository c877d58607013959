#pragma once

#include <algorithm>
#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "signweave/query/phase_query.h"

/// Internal to this module: the words of the language. `word_of` gives the spelling of each.
namespace signweave {

inline constexpr std::array kFields = {Field::gloss,     Field::phase, Field::hand,     Field::hands,
                                       Field::recording, Field::tier,  Field::duration, Field::begin,
                                       Field::end,       Field::unit,  Field::signer};
inline constexpr std::array kLinks = {Link::parent, Link::child,  Link::ancestor, Link::descendant, Link::overlaps,
                                      Link::during, Link::starts, Link::ends,     Link::equals};
inline constexpr std::array kCompares = {Compare::equal,      Compare::not_equal, Compare::matches,      Compare::less,
                                         Compare::less_equal, Compare::greater,   Compare::greater_equal};
inline constexpr std::array kPhaseKinds = {PhaseKind::preparation, PhaseKind::stroke, PhaseKind::retraction,
                                           PhaseKind::hold, PhaseKind::other};
inline constexpr std::array kHands = {Hand::both, Hand::right, Hand::left};

/// The value with this spelling, or nullopt.
template <typename Values>
auto value_of(const Values& values, std::string_view word) {
  const auto at = std::find_if(values.begin(), values.end(), [&](auto value) { return word_of(value) == word; });
  return at == values.end() ? std::nullopt : std::optional(*at);
}

template <typename Values>
std::vector<std::string> words_of(const Values& values) {
  std::vector<std::string> result;
  for (const auto value : values) result.emplace_back(word_of(value));
  return result;
}

}  // namespace signweave
